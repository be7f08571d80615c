"""How far refinement goes: by laws, not by the clock."""

import time

import numpy as np
import pytest
from scenes import SMOOTH, problem

from comparisons.common.tasks import Tasks
from comparisons.models.plan import make_plan
from comparisons.runs.refinement import refined
from comparisons.studies.study import Solved


def half_plane(**budget):
    """The half-plane on ever finer levels, and why they ended: none is fine enough."""
    made = problem(SMOOTH | {"tolerance": {"peak_pressure": 1e-6}, "budget": budget})
    plan = make_plan(made, ("half_plane",))
    solved = refined(Solved(made, plan, None, {}), Tasks())
    return solved.runs["half_plane"], solved.refinement


@pytest.mark.parametrize(
    ("budget", "limit"), [({"time": 0.05}, "0.05 s"), ({"memory": 5e5}, "500000 bytes")]
)
def test_a_model_keeps_to_its_budget(budget, limit):
    """Levels of 55, 111, … nodes at 35 microseconds and 700 bytes each."""
    run, why = half_plane(**budget)
    assert limit in why
    assert 3 <= len(run.levels) <= 5


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
