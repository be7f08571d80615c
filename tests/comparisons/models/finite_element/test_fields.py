"""The displacements of a field file: against the deformed height of contact.csv, and exact ones.
Where friction makes the largest shear stand on the surface: stresses up to the ends of contact."""

import pickle
from unittest.mock import patch

import numpy as np
import pytest
from scenes import STEEL, STEEL_PAIR, changed, finite_elements, problem

from analytic.contact.end_stress import EndStress
from analytic.material import Material
from comparisons.common.tasks import Tasks
from comparisons.figures.quantity import MODELS
from comparisons.judging.study import unsolved
from comparisons.models.finite_element.loaded import stresses_of
from comparisons.models.level import MeshField, RecoverableField, deformed_height
from comparisons.models.plan import make_plan
from comparisons.models.window import window_of
from comparisons.runs.refinement import refined
from fem.body.coating import Coating
from fem.body.nodes import nodes_of
from meshes.block import structured

SCENE = {
    "roller": {"radius": 10e-3, **STEEL},
    "body": STEEL,
    "load": {"hertz_peak_pressure": 1.5e9},
    "stress": {"points": [20, 10]},
}
WAVES = {"profile": {"kind": "sinusoid", "wavelength": 60e-6, "amplitude": 0.05e-6}}
SCENES = {
    "smooth": {},
    "layer": {"body": {"thickness": 300e-6, "base": "bonded"}},
    "coated": {"coating": {"thickness": 60e-6, "youngs_modulus": 4e11, "poissons_ratio": 0.2}},
    "finite deformation": WAVES
    | {"finite_element": {"deformation": "finite"}, "load": {"hertz_peak_pressure": 4e9}},
    "flowing": {
        "body": {"yield_stress": 0.8e9, "hardening_modulus": 10e9},
        "finite_element": {"plastic": True},
    },
    "linear elements": WAVES | {"finite_element": {"element": "P1"}},
}


@pytest.mark.parametrize("name", SCENES)
def test_the_surface_moved_by_them_is_the_deformed_height(name):
    """But for the datum of contact.csv, one constant; to what the hats' averages leave, 0.003 of
    the surface's own range of displacements (linear elements, whose surface is bent: 0.02). It goes
    into the body, +z, and only the base and the sides stay where they were."""
    posed = problem(changed(SCENE, **SCENES[name]))
    level = finite_elements(posed, fields=True)
    field, flat = level.field_on_mesh, level.mesh.points[:, 1]
    moved = field.displacement[0.0]
    assert moved.shape == field.points.shape
    if name == "coated":  # points of its interface stand twice among those of the field
        flat = field.points[:, 1]
    top = np.flatnonzero(flat == 0.0)
    top = top[np.argsort(field.points[top, 0])]
    low, high = level.patches[[0, -1], [0, 1]]
    near = np.abs(level.grid.x - 0.5 * (low + high)) < high - low
    x, z = (field.points + moved)[top].T
    off = np.interp(level.grid.x[near], x, -z) - deformed_height(posed, level)[near]
    assert np.ptp(off) < (0.02 if name == "linear elements" else 0.003) * np.ptp(moved[top, 1])
    lowest = moved[field.points[:, 1] == field.points[:, 1].max()]
    assert np.ptp(lowest, axis=0) == pytest.approx(0.0, abs=1e-20) and not lowest[:, 1].any()
    assert moved[top, 1].max() > 0.0


@pytest.mark.parametrize("coating", [None, Coating(Material(4e11, 0.2), 1e-3)])
@pytest.mark.parametrize("degree", [1, 2, 3])
def test_a_rigid_motion_reaches_every_node_and_strains_nothing(degree, coating):
    """Midpoints of edges and both sides of an interface among them, whatever the elements."""
    mesh = structured(np.linspace(-4e-3, 4e-3, 9), np.linspace(0.0, 4e-3, 5))
    x, z = nodes_of(mesh, degree).real.T
    turned = np.column_stack([1e-6 + 1e-3 * z, 2e-6 - 1e-3 * x])
    moved = np.stack([turned, -2.0 * turned], axis=1)
    hats = np.linspace(-1e-3, 1e-3, 11)
    pressure, frictions = np.zeros(9), (0.0, 0.1)
    ends = EndStress(hats[1:-1], pressure, ())
    field_of = mesh, Material(2e11, 0.3), coating, degree, moved, hats, pressure, frictions, ends
    field = RecoverableField(*field_of).recovered
    assert len(field.points) == len(mesh.points) + (0 if coating is None else 17)
    x, z = field.points.T
    turned = np.column_stack([1e-6 + 1e-3 * z, 2e-6 - 1e-3 * x])
    for friction, times in ((0.0, 1.0), (0.1, -2.0)):
        assert field.displacement[friction] == pytest.approx(times * turned, abs=1e-18)
        assert np.abs(field.stresses[friction].von_mises(0.3)).max() < 1e-12 * 1e-3 * 2e11


FRICTION = 0.5
TABLES = STEEL_PAIR | {
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
    """The values found go to other processes; the largest alone are the same."""
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
