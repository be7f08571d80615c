"""Stresses in a layer: surface and base conditions, equilibrium, half-planes as limits."""

import numpy as np
import pytest
from layer_stresses import layer_field

from analytic.layers.layered import LayeredBody
from analytic.layers.stress import AddedStress
from analytic.material import Material
from analytic.stress.field import friction_field

LAYER = Material(210e9, 0.3)
BASES = {
    "bonded": "bonded",
    "frictionless": "frictionless",
    "stiffer": Material(1e12, 0.2),
    "softer": Material(20e9, 0.4),
}
PITCH, COUNT = 0.02, 41
NODES = PITCH * np.arange(COUNT)
RAGGED = np.random.default_rng(8).random(COUNT)
LEVELS = np.array([0.0, 1e-3, 0.1, 0.4, 0.9, 1.0])


@pytest.mark.parametrize("base", BASES)
def test_surface_carries_the_given_tractions(base):
    body = LayeredBody(LAYER, 1.0, BASES[base])
    window = (NODES[0], NODES[-1])
    field = layer_field(body, NODES, RAGGED, window, LEVELS)
    stress = field.at(0.3).stress
    assert np.array_equal(stress.sz[0], -RAGGED)
    assert np.array_equal(stress.txz[0], -0.3 * RAGGED)


@pytest.mark.parametrize("pitch", [0.02, 0.5, 5.0])
def test_base_holds_the_layer(pitch):
    """Bonded: no strain along the base, (1 - nu) sx = nu sz. Frictionless: no shear."""
    nu, nodes = LAYER.poissons_ratio, pitch * np.arange(COUNT)
    window = (-3.0 * pitch, 50.0 * pitch)
    for base in ("bonded", "frictionless"):
        body = LayeredBody(LAYER, 1.0, base)
        field = layer_field(body, nodes, RAGGED, window, np.array([0.2, 1.0]))
        for stress in (field.normal, field.traction):
            if base == "bonded":
                strain = (1.0 - nu) * stress.sx[1] - nu * stress.sz[1]
                assert np.max(np.abs(strain)) < 1e-14
            else:
                assert np.max(np.abs(stress.txz[1])) < 1e-13
            assert np.max(np.abs(stress.sx[0])) > 1e-3


@pytest.mark.parametrize("base", BASES)
def test_stresses_are_in_equilibrium(base):
    """sx,x + txz,z = 0 and txz,x + sz,z = 0 by central differences, of second order."""
    body, errors = LayeredBody(LAYER, 1.0, BASES[base]), []
    for parts in (4, 8):
        step = PITCH / parts
        levels = 0.3 + step * np.arange(-2, 3)
        field = layer_field(body, NODES, RAGGED, (-0.2, 1.0), levels, parts)
        worst = 0.0
        for s in (field.normal, field.traction):
            along = s.sx[2, 2:] - s.sx[2, :-2] + s.txz[3, 1:-1] - s.txz[1, 1:-1]
            across = s.txz[2, 2:] - s.txz[2, :-2] + s.sz[3, 1:-1] - s.sz[1, 1:-1]
            worst = max(worst, np.abs(along).max(), np.abs(across).max())
        errors.append(worst / step)
    assert errors[1] < 2e-3
    assert 1.9 < np.log2(errors[0] / errors[1]) < 2.1


def test_thick_layer_is_a_half_plane():
    half_plane = friction_field(NODES, RAGGED, (-0.2, 1.0), LEVELS).stress
    distances = []
    for thickness in (200.0, 400.0):
        body = LayeredBody(LAYER, thickness, "bonded")
        field = layer_field(body, NODES, RAGGED, (-0.2, 1.0), LEVELS)
        distances.append(np.max(np.abs(field.normal.sx - half_plane.normal.sx)))
        assert np.max(np.abs(field.normal.sz - half_plane.normal.sz)) < 10.0 / thickness**2
    assert distances[1] < 2e-3
    assert distances[0] / distances[1] == pytest.approx(2.0, rel=0.05)


@pytest.mark.parametrize(
    ("depths", "below"), [(LEVELS, False), (np.array([1.0, 1.5, 4.0]), True)], ids=["layer", "base"]
)
def test_coating_and_base_of_one_material_are_a_half_plane(depths, below):
    body, window = LayeredBody(LAYER, 1.0, LAYER), (-0.2, 1.0)
    field = layer_field(body, NODES, RAGGED, window, depths, below=below)
    plain = friction_field(NODES, RAGGED, window, depths).stress
    for part, expected in ((field.normal, plain.normal), (field.traction, plain.traction)):
        assert part.parts == pytest.approx(expected.parts, abs=1e-14)


@pytest.mark.parametrize("base", ["stiffer", "softer"])
def test_layer_and_base_hold_together(base):
    """sz and txz are continuous at the interface, and so is the strain along it,
    ex E = (1 + nu) ((1 - nu) sx - nu sz), whatever the constants on either side."""
    body, window = LayeredBody(LAYER, 1.0, BASES[base]), (-0.2, 1.0)
    sides = [
        layer_field(body, NODES, RAGGED, window, np.array([1.0]), below=below)
        for below in (False, True)
    ]
    for part in ("normal", "traction"):
        above, below = (getattr(side, part) for side in sides)
        assert below.sz == pytest.approx(above.sz, abs=1e-13)
        assert below.txz == pytest.approx(above.txz, abs=1e-13)
        strain = [
            (1.0 + m.poissons_ratio)
            / m.youngs_modulus
            * ((1.0 - m.poissons_ratio) * s.sx - m.poissons_ratio * s.sz)
            for m, s in ((LAYER, above), (BASES[base], below))
        ]
        assert strain[1] == pytest.approx(strain[0], rel=1e-10, abs=1e-13 / LAYER.youngs_modulus)
        assert np.max(np.abs(above.sx - below.sx)) > 1e-3


def test_places_and_grids_agree():
    """At single points as on the grid, in the layer and below."""
    body, x = LayeredBody(LAYER, 1.0, BASES["softer"]), np.array([0.1, 0.4])
    added = AddedStress.of(body, NODES, RAGGED, (0.0, 1.0))
    for below, depth in ((False, 0.3), (True, 1.2)):
        grid = added.field(x, np.array([depth]), below)
        state = added.at(0.2, x, np.full(2, depth), below)
        expected = grid[:3, 0] + 0.2 * grid[3:, 0]
        assert state.parts == pytest.approx(expected, rel=1e-12, abs=1e-14)
    with pytest.raises(ValueError, match="depths must lie in the base"):
        added.field(x, np.array([0.5]), below=True)
