"""How far refinement goes: by laws, not by the clock."""

import time
from pathlib import Path

import numpy as np

from comparisons.assessment.refinement import refined
from comparisons.common.progress import no_progress
from comparisons.common.quantities import MODELS
from comparisons.models.level_cache import level_cache
from comparisons.models.plan import make_plan
from comparisons.models.problem import problem_of
from comparisons.scenes.resolve import resolve_tables

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
SCENE = {
    "roller": {"radius": 8e-3, **STEEL},
    "body": STEEL,
    "load": {"hertz_peak_pressure": 2e9},
    "tolerance": {"peak_pressure": 1e-6},
}


def levels(models, **budget):
    """The models' runs on ever finer levels, and why they ended."""
    tables = SCENE | {"budget": budget}
    scene = resolve_tables(tables, name="made", folder=Path("."), source="made.toml")
    problem = problem_of(scene)
    plan = make_plan(problem, models)
    return refined(problem, plan, None, level_cache(None, scene, plan), no_progress)


def test_no_clock_decides(monkeypatch):
    """Not even one that runs ten thousand times too fast."""
    usual, why = levels(MODELS, time=3.0)
    assert "3 s (budget.time)" in why
    monkeypatch.setattr(
        "comparisons.common.progress.perf_counter", lambda: 1e4 * time.perf_counter()
    )
    hurried, _ = levels(MODELS, time=3.0)
    assert sum(hurried["finite_element"].seconds.values()) > 100.0
    for name, run in usual.items():
        assert len(run.levels) == len(hurried[name].levels) == 4
        pressures = (found.finest.solution.pressure for found in (run, hurried[name]))
        np.testing.assert_array_equal(*pressures)


def test_the_half_plane_alone_keeps_to_its_budget():
    """Levels of 55, 111, … nodes at 35 microseconds and 700 bytes each."""
    for budget, limit in (({"time": 0.05}, "0.05 s"), ({"memory": 5e5}, "500000 bytes")):
        runs, why = levels(("half_plane",), **budget)
        assert limit in why
        assert 3 <= len(runs["half_plane"].levels) <= 5
