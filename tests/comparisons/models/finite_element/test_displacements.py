"""The displacements of a field file: against the deformed height of contact.csv, and exact ones."""

import numpy as np
import pytest
from scenes import STEEL, changed, finite_elements, problem

from analytic.contact.end_stress import EndStress
from analytic.material import Material
from comparisons.models.level import RecoverableField, deformed_height
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
