"""Model variants solved by several processes: the same solutions, and what becomes of failures."""

import pickle
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

from comparisons.common.processes import ProcessWorker
from comparisons.common.tasks import Tasks, tasks_here
from comparisons.figures.quantity import MODELS
from comparisons.judging.effects.catalogue import model_with
from comparisons.judging.effects.selection import EffectSelection
from comparisons.judging.model_error.refinement import EffectRefinement, NotComputedError
from comparisons.judging.study import unsolved
from comparisons.models.model import Model
from comparisons.models.plan import make_plan
from comparisons.runs.refinement import refined
from meshes.block import MeshError

RIGID = {"rigid": True}
SELECTION = EffectSelection(frozenset(), frozenset({"exact_circle", "finite_strain"}), {}, {})


@pytest.fixture(scope="module")
def made(problem_with):
    """A small scene's variants, yet to be solved, by given tasks."""
    problem = problem_with(roller=RIGID)
    plan = make_plan(problem, MODELS)
    solved = refined(unsolved(problem, plan), Tasks())
    return lambda tasks: EffectRefinement(solved, tasks, SELECTION)


def test_variants_of_other_processes_are_as_here(made, monkeypatch):
    for name in ("WORTH_A_START", "WORTH_A_FORK"):
        monkeypatch.setattr(f"comparisons.common.tasks.{name}", 0.0)
    alone, stages = made(Tasks()), []
    with tasks_here(stages.append) as tasks:
        tasks.opens, tasks.at_once = ProcessWorker, 2
        shared = made(tasks)
        [split] = shared.splits
        assert len(shared.announce(split.all, 1)) == 3
        shared.prepare(split.all, 1)
        assert len(tasks._workers) == 2
    told = {stage.partition(", with ")[2] for stage in stages}  # of which variant and level
    assert len(told) == 3 and len(split.all) == 4
    solved = {variant for variant, _ in shared.solved}
    assert solved == {*split.all} - {split.nothing}  # which is the scene's own
    assert list(shared.finest) == [split.whole] and list(shared.finest[split.whole]) == [0.0]
    [case], _ = shared.scene.cases, alone.prepare(split.all, 1)
    for variant in split.all:
        one, two = (bodies.solution(variant, 1, case).figures for bodies in (alone, shared))
        assert one.keys() == two.keys()
        for name, values in one.items():
            np.testing.assert_array_equal(values, two[name])
    assert alone.spent() == shared.spent() > alone.spent(below=1) == shared.spent(below=1)


def test_a_body_without_an_answer_is_heard_of_when_it_is_asked(made):
    bodies = made(Tasks())
    disc, circle = (
        model_with(bodies.problem, frozenset({n})) for n in ("finite_roller", "exact_circle")
    )
    with patch.object(Model, "solve", side_effect=MeshError("no\nmesh")):
        bodies.prepare([disc], 1)
    bodies.prepare([disc, circle], 1)  # is not tried again
    assert bodies.solution(circle, 1, bodies.scene.cases[0])
    assert bodies.failed == {(disc, 1): "no mesh"}


def test_of_a_whole_without_a_solution_nothing_is_known(made):
    refused = patch.object(Model, "solve", side_effect=MeshError("no mesh"))
    with refused, pytest.raises(NotComputedError, match="no mesh"):
        made(Tasks()).budget()


def test_a_problem_can_be_handed_on(problem_with):
    """Its gap goes with it, which is what the other process presses on."""
    wavy = {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.1e-6}
    problem = problem_with(profile=wavy)
    copied = pickle.loads(pickle.dumps(problem))
    x = np.linspace(*problem.extent, 50)
    np.testing.assert_array_equal(copied.gap(x), problem.gap(x))
    np.testing.assert_array_equal(copied.finite_element_gap(x), problem.finite_element_gap(x))
    assert Path(copied.scene.source) == Path(problem.scene.source)
