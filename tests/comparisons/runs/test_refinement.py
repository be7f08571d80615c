"""How far refinement goes: by laws, not by the clock. Where a run's finished levels are, and
what change of the program they survive."""

import time
from dataclasses import replace
from functools import partial
from itertools import compress
from pathlib import Path

import numpy as np
import pytest
from scenes import SMOOTH, problem

from comparisons.campaigns.cases import Trial, answers_of, carry_out
from comparisons.common import provenance
from comparisons.common.errors import SceneError
from comparisons.common.progress import no_progress
from comparisons.common.tasks import Tasks
from comparisons.figures.quantity import MODELS
from comparisons.grid import map as map_of_groups
from comparisons.judging.study import unsolved
from comparisons.models.analytic import analytic_level, expected_with
from comparisons.models.finite_element import level
from comparisons.models.plan import make_plan
from comparisons.runs.refinement import refined
from comparisons.runs.run import CODE, level_cache
from fem.solver.mumps import FemError


def half_plane(**budget):
    """The half-plane on ever finer levels, and why they ended: none is fine enough."""
    made = problem(SMOOTH | {"tolerance": {"peak_pressure": 1e-6}, "budget": budget})
    plan = make_plan(made, ("half_plane",))
    solved = refined(unsolved(made, plan), Tasks())
    return solved.runs["half_plane"], solved.refinement


@pytest.mark.parametrize(
    ("budget", "limit"), [({"time": 0.05}, "0.05 s"), ({"memory": 5e5}, "500000 bytes")]
)
def test_a_model_keeps_to_its_budget(budget, limit):
    """Levels of 55, 111, … nodes at 35 microseconds and 700 bytes each."""
    run, why = half_plane(**budget)
    assert limit in why
    assert 3 <= len(run.levels) <= 5


def test_a_half_plane_that_would_not_fit_is_refused_before_it_is_solved():
    with pytest.raises(SceneError, match=r"budget\.memory: is 1e\+05 bytes, but half-plane"):
        half_plane(memory=1e5)


def test_stresses_far_beyond_a_small_contact_count_in_memory_and_time():
    """Heights in metres that are micrometres: the contact is a thousandth of the window."""
    rough = {"kind": "self-affine", "hurst": 0.8, "samples": 2048, "length": 6e-3, "seed": 1}
    made = problem(SMOOTH | {"profile": rough | {"rms_slope": 1000.0}, "stress": {"depth": 1.0}})
    posed = replace(made, window=None), made
    alone, cost = (expected_with(one, made.pitches[-1]) for one in posed)
    assert cost.unknowns == alone.unknowns
    assert cost.seconds > 30.0 * alone.seconds and cost.memory > 30.0 * alone.memory
    # of a contact as wide as the window the same counts as ever
    made = problem(SMOOTH | {"stress": {"depth": 1.0}})
    posed = replace(made, window=None), made
    costs = (expected_with(one, made.pitches[-1]) for one in posed)
    assert len({cost.seconds for cost in costs}) == 1


def test_no_clock_decides(monkeypatch):
    """Not even one that runs a million times too fast."""
    usual, _ = half_plane(time=0.05)
    monkeypatch.setattr(
        "comparisons.common.progress.perf_counter", lambda: 1e6 * time.perf_counter()
    )
    hurried, _ = half_plane(time=0.05)
    assert sum(hurried.seconds.values()) > 100.0
    assert len(usual.levels) == len(hurried.levels)
    np.testing.assert_array_equal(usual.finest.solution.pressure, hurried.finest.solution.pressure)


def test_a_finer_level_without_a_solution_ends_the_refinement(monkeypatch):
    """Finite elements that are half-planes, but for the finest one. What is then the finest, whose
    norm alone was wanted, has all of its fields."""
    made = problem(SMOOTH | {"tolerance": {"peak_pressure": 1e-6}, "stress": {"points": [90, 40]}})

    def solve(finest, problem, refinement, stages, *rest, fields):
        if refinement.pitch <= 1.01 * made.pitches[finest - 1]:
            raise FemError("it did not converge")
        grid = problem.grid(refinement.pitch)
        return analytic_level(problem, frozenset(), grid, stages, fields)

    def solved(finest):
        monkeypatch.setattr(level, "finite_element_level", partial(solve, finest))
        return refined(unsolved(made, make_plan(made, MODELS)), Tasks())

    runs = solved(3)
    assert {name: len(run.levels) for name, run in runs.runs.items()} == dict.fromkeys(MODELS, 2)
    assert runs.refinement.endswith("to a third of the tolerance: level 3: it did not converge")
    columns = [level.stress.tau1.shape[1] for level in runs.runs["finite_element"].levels]
    assert columns == [len(made.window.every(4).x), len(made.window.x)]
    with pytest.raises(FemError, match="did not converge"):
        solved(2)


def test_levels_are_inside_a_folder_that_exists(tmp_path, smooth_outcome):
    out = tmp_path / "out"
    out.mkdir()
    cache = level_cache(out, smooth_outcome.problem, smooth_outcome.plan)
    cache.save("first", smooth_outcome.runs["half_plane"].levels[0])
    assert [*tmp_path.rglob("*.npz")] == [out / ".unfinished/run/first.npz"]
    cache.discard()
    assert [*tmp_path.rglob("*")] == [out]


def test_the_end_of_another_command_leaves_levels_alone(tmp_path, smooth_outcome):
    """Into the folder of a run that was stopped; and the end of that run the other's answers."""
    out, cases = tmp_path / "out", [Trial("tests", "nothing", "half_plane", tuple)]
    levels = level_cache(out, smooth_outcome.problem, smooth_outcome.plan)
    levels.save("first", smooth_outcome.runs["half_plane"].levels[0])
    carry_out("stability", cases, out, None, no_progress)
    assert levels.load("first") is not None
    answers = answers_of(out, "verify", cases)
    answers.save("1", ((), None, 0.0))
    carry_out("stability", cases, out, None, no_progress)
    levels.discard()
    assert levels.load("first") is None and answers.load("1") == ((), None, 0.0)
    answers.discard()
    assert [path.name for path in tmp_path.rglob("*")] == ["out", "stability.json"]


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A project with one function in every module that shapes a cached result, and in two more."""
    places = {
        *CODE,
        *map_of_groups.CODE,
        "comparisons/output",
        "comparisons/cli.py",
    }
    for place in places:
        path = tmp_path / place
        path = path if path.suffix else path / "law.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(LAW)
    monkeypatch.setattr(provenance, "PROJECT", tmp_path)
    yield tmp_path
    provenance.program_code.cache_clear()


LAW = '"""A law."""\n\ndef half(x):\n    """Of x."""\n    return x / 2\n'


def keys() -> tuple[str, str]:
    """Keys of levels, and of a map."""
    posed = problem(SMOOTH)
    provenance.program_code.cache_clear()
    levels = level_cache(Path("out"), posed, make_plan(posed, ("half_plane",))).key()
    return levels, provenance.program_code(*map_of_groups.CODE)


@pytest.mark.parametrize(
    ("place", "loses"),
    [
        ("comparisons/output/law.py", ""),
        ("comparisons/cli.py", ""),
        ("comparisons/models/law.py", "levels map"),
        ("analytic/law.py", "levels map"),
        ("comparisons/studies/law.py", "levels map"),
        ("comparisons/grid/map_error.py", "map"),
    ],
)
def test_what_is_cached_is_lost_to_a_change_of_what_shapes_it_alone(project, place, loses):
    before = keys()
    (project / place).write_text(LAW.replace("2", "3"))
    lost = [one != other for one, other in zip(before, keys(), strict=True)]
    assert list(compress(("levels", "map"), lost)) == loses.split()


def test_every_place_that_shapes_a_result_is_there():
    for place in {*CODE, *map_of_groups.CODE}:
        assert (provenance.PROJECT / place).exists(), place
