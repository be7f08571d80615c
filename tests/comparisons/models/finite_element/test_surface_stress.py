"""Where friction makes the largest shear stand on the surface, up to the ends of contact."""

import pickle
from unittest.mock import patch

import numpy as np
import pytest
from scenes import STEEL, problem

from comparisons.common.tasks import Tasks
from comparisons.figures.quantity import MODELS
from comparisons.judging.study import unsolved
from comparisons.models.finite_element.loaded import stresses_of
from comparisons.models.level import MeshField
from comparisons.models.plan import make_plan
from comparisons.models.window import window_of
from comparisons.runs.refinement import refined

FRICTION = 0.5
TABLES = {
    "roller": {"radius": 8e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"hertz_peak_pressure": 1e9, "friction": FRICTION},
    "stress": {"points": [41, 11]},
    "resolution": {"levels": 2},
    "budget": {"effects": False, "time": 1e-6},
}


@pytest.fixture(scope="module")
def runs():
    posed = problem(TABLES)
    return refined(unsolved(posed, make_plan(posed, MODELS)), Tasks()).runs


@pytest.mark.parametrize(("model", "most"), [("half_plane", 1e-3), ("finite_element", 7e-3)])
def test_the_largest_shear_is_friction_times_the_peak_pressure(runs, model, most):
    """Exact (Johnson 1985, section 7.1); hats alone are 1 to 5 % too high."""
    for level in runs[model].levels:
        largest = level.stress.extremes["tau1"]
        assert largest.value == pytest.approx(FRICTION * 1e9, rel=most)
        assert largest.z == pytest.approx(0.0, abs=1e-3 * level.grid.pitch)


def test_both_fields_have_the_curve_next_to_the_ends(runs):
    """On the surface the field's sz is minus the pressure's square root, which no hats follow."""
    half_width = problem(TABLES).hertz.half_width
    window = window_of(problem(TABLES))
    near = np.abs(np.abs(window.x) / half_width - 1.0) < 0.1
    exact = -1e9 * np.sqrt(np.maximum(1.0 - (window.x[near] / half_width) ** 2, 0.0))
    for model in MODELS:
        sz = runs[model].finest.stress.field.sz[0, near]
        assert near.sum() >= 2
        np.testing.assert_allclose(sz, exact, atol=2e-3 * 1e9)


def test_figures_are_those_of_a_body_whose_stresses_are_known_everywhere():
    """What is found goes to other processes; where it is the largest alone, it is the same."""
    posed, pairs = problem(TABLES), []
    plan = make_plan(posed, ("finite_element",))

    def both(pressed, frictions, window, asperities, *_):
        asked = pressed, frictions, window, asperities
        results = [stresses_of(*asked, fields) for fields in (False, True)]
        [all_known], linear = results[1]
        known = linear.on(pressed.body), linear.displacement, {}
        at_once = MeshField.of(pressed.body, frictions, *known)
        results.append(([all_known], at_once))
        pairs.append([pickle.loads(pickle.dumps(result)) for result in results])
        return results[0]

    with patch("comparisons.models.finite_element.level.stresses_of", both):
        refined(unsolved(posed, plan), Tasks())
    for ((without,), nothing), (_, later), ((all_known,), at_once) in pairs:
        assert nothing is None
        for part in ("sx", "sz", "txz"):
            there, expected = (
                getattr(result.stresses[FRICTION], part) for result in (later.recovered, at_once)
            )
            np.testing.assert_allclose(there, expected, rtol=1e-9, atol=1e-3)
        for name, most in all_known.extremes.items():
            assert without.extremes[name].value == pytest.approx(most.value, rel=1e-12)
        assert without.field is None


def test_the_last_level_has_the_stresses_at_all_points_of_its_mesh(runs):
    """Also where the budget ends the refinement earlier than asked for."""
    assert len(runs["finite_element"].levels) < 2
    field = runs["finite_element"].finest.field_on_mesh
    assert len(field.stresses[FRICTION].sx) == len(field.points)
