"""Model variants solved by several processes: the same solutions, and what becomes of failures."""

import os
import pickle
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

from comparisons.assessment.effects import solutions as solve
from comparisons.assessment.effects.contributions import (
    NotComputedError,
    contributions_of,
    split_variants,
)
from comparisons.assessment.effects.selection import EffectSelection
from comparisons.assessment.effects.solutions import SolvedVariants, processes_beside
from comparisons.assessment.effects.variants import ModelVariant
from comparisons.assessment.refinement import refined
from comparisons.common.processes import ProcessEnded, fresh_process
from comparisons.common.progress import no_progress
from comparisons.common.quantities import MODELS
from comparisons.models.level_cache import level_cache
from comparisons.models.plan import make_plan

RIGID = {"rigid": True}
SELECTION = EffectSelection(frozenset(), frozenset({"exact_circle", "finite_strain"}), {}, {}, {})


@pytest.fixture(scope="module")
def made(problem_with):
    """A small scene's bodies, yet to be solved, with given processes beside."""
    problem = problem_with(roller=RIGID)
    plan = make_plan(problem, MODELS)
    keeps_nothing = level_cache(None, problem.scene, plan)
    runs, _ = refined(problem, plan, None, keeps_nothing, no_progress)

    def bodies(beside, own=runs["finite_element"]) -> SolvedVariants:
        return SolvedVariants(problem, None, own, keeps_nothing, no_progress, beside)

    return bodies


@pytest.fixture
def always(monkeypatch):
    monkeypatch.setattr(solve, "WORTH_A_PROCESS", 0.0)


def test_bodies_beside_answer_as_here(made, always):
    alone, shared, answered = made(()), made(()), []
    with fresh_process() as call:

        def seen(*given):
            answered.append(given[3])
            return call(*given)

        shared.beside = [seen]
        split = split_variants(shared.problem, SELECTION, 0.0)
        shared.keep([split.whole])
        shared.prepare(split.all, 1)
    assert answered and len(split.all) == 4
    solved = {variant for variant, _, _ in shared.solved}
    assert solved == {*split.all} - {split.nothing}  # which is the scene's own
    assert shared.finest(split.whole) is shared.wholes[split.whole] is not None
    one, two = (contributions_of(bodies, split, 0.0, 1) for bodies in (alone, shared))
    for name, values in one.not_contained.figures.items():
        np.testing.assert_array_equal(values, two.not_contained.figures[name])
    np.testing.assert_array_equal(one.not_contained.pressure, two.not_contained.pressure)
    assert alone.expected_of(1) == shared.expected_of(1) > 0.0 == shared.expected_of(2)


def test_what_a_process_cannot_finish_is_solved_here(made, always):
    def ends(*given):
        raise ProcessEnded

    bodies = made([ends])
    bodies.prepare(
        [ModelVariant(frozenset({"deformed_gap"})), ModelVariant(frozenset({"exact_circle"}))], 1
    )
    assert {body.effects for body, _, _ in bodies.solved} == {
        frozenset({"deformed_gap"}),
        frozenset({"exact_circle"}),
    }


def test_a_body_without_an_answer_is_heard_of_when_it_is_asked(made, always):
    gap, circle = (
        ModelVariant(frozenset({"deformed_gap"})),
        ModelVariant(frozenset({"exact_circle"})),
    )
    bodies = made(())
    with patch.object(solve, "_solved", side_effect=NotComputedError(gap, "no\nmesh")):
        bodies.prepare([gap], 1)
    bodies.prepare([gap, circle], 1)  # is not tried again
    assert bodies.solution(circle, 1, 0.0)
    with pytest.raises(NotComputedError, match=r"^no mesh$") as caught:
        bodies.solution(gap, 1, 0.0)
    copied = pickle.loads(pickle.dumps(caught.value))  # as it comes from another process
    assert (copied.variant, str(copied)) == (gap, "no mesh")


def test_processes_are_begun_where_they_pay_and_memory_allows(made):
    bodies = made([len, len, len])
    dear = replace(
        bodies.own.levels[0], expected_seconds=solve.WORTH_A_PROCESS / 3.0, expected_memory=1.0
    )

    def helpers(count, **others):
        bodies.own = replace(bodies.own, levels=(replace(dear, **others),))
        return len(bodies._helpers(1, count))

    assert helpers(3) == 2 and helpers(9) == 3
    assert helpers(2) == 0  # too little to do
    assert helpers(9, expected_memory=1e18) == 0
    budget = bodies.problem.scene.budget.memory
    assert helpers(9, expected_memory=0.99 * budget / (3.0 * solve.LARGEST)) == 2


def test_one_of_several_processes_begins_none(monkeypatch):
    cores = len(os.sched_getaffinity(0))
    with processes_beside() as beside:
        assert len(beside) == cores - 1
    with fresh_process() as call:
        assert call(_beside) == 0
    monkeypatch.setattr(solve, "is_several", lambda: True)
    with processes_beside() as beside:
        assert len(beside) == 0


def _beside() -> int:
    with processes_beside() as beside:
        return len(beside)


def test_a_problem_can_be_handed_on(problem_with):
    """With its gap, which is what the other process presses on."""
    wavy = {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.1e-6}
    problem = problem_with(profile=wavy)
    copied = pickle.loads(pickle.dumps(problem))
    x = np.linspace(*problem.extent, 50)
    np.testing.assert_array_equal(copied.gap(x), problem.gap(x))
    np.testing.assert_array_equal(copied.finite_element_gap(x), problem.finite_element_gap(x))
    assert Path(copied.scene.source) == Path(problem.scene.source)
