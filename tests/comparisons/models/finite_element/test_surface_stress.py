"""Where friction makes the largest shear stand on the surface, up to the ends of contact."""

import pickle
from unittest.mock import patch

import numpy as np
import pytest
from scenes import STEEL, problem

from comparisons.assessment.refinement import refined
from comparisons.common.progress import no_progress
from comparisons.common.quantities import MODELS
from comparisons.models.level_cache import level_cache
from comparisons.models.plan import make_plan
from comparisons.models.window import window_of

FRICTION = 0.5
TABLES = {
    "roller": {"radius": 8e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"hertz_peak_pressure": 1e9, "friction": FRICTION},
    "stress": {"points": [41, 11]},
    "resolution": {"levels": 2},
    "finite_element": {"far_field": "half-plane"},
    "budget": {"effects": False, "time": 1e-6},
}


@pytest.fixture(scope="module")
def runs():
    posed = problem(TABLES)
    plan = make_plan(posed, MODELS)
    return refined(
        posed, plan, window_of(posed), level_cache(None, posed.scene, plan), no_progress
    )[0]


@pytest.mark.parametrize(("model", "most"), [("half_plane", 1e-3), ("finite_element", 7e-3)])
def test_the_largest_shear_is_friction_times_the_peak_pressure(runs, model, most):
    """Exact (Johnson 1985, section 7.1); hats alone are 1 to 5 % too high."""
    for level in runs[model].levels:
        found = level.stress(FRICTION).extremes["tau1"]
        assert found.value == pytest.approx(FRICTION * 1e9, rel=most)
        assert found.z == pytest.approx(0.0, abs=1e-3 * level.grid.pitch)


def test_both_fields_have_the_curve_next_to_the_ends(runs):
    """On the surface the field's sz is minus the pressure's square root, which no hats follow."""
    half_width = problem(TABLES).hertz.half_width
    window = window_of(problem(TABLES))
    near = np.abs(np.abs(window.x) / half_width - 1.0) < 0.1
    exact = -1e9 * np.sqrt(np.maximum(1.0 - (window.x[near] / half_width) ** 2, 0.0))
    for model in MODELS:
        sz = runs[model].finest.stress(FRICTION).field.sz[0, near]
        assert near.sum() >= 2
        np.testing.assert_allclose(sz, exact, atol=2e-3 * 1e9)


def test_stresses_go_from_one_process_to_another():
    """With what is beside them: a body's factor cannot."""
    posed = problem(TABLES)
    plan, kept = make_plan(posed, ("finite_element",)), []
    with patch("comparisons.models.finite_element.level.stresses_of") as stresses:
        stresses.side_effect = lambda pressed, *_: (
            kept.append(pressed.stress(FRICTION)),
            ((), None),
        )[1]
        cache = level_cache(None, posed.scene, plan)
        refined(posed, plan, window_of(posed), cache, no_progress)
    there = pickle.loads(pickle.dumps(kept[0]))
    assert there.further is not None
    np.testing.assert_array_equal(there.values, kept[0].values)
