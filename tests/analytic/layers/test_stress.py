"""Stresses in a layer: surface and base conditions, equilibrium, waves, images, limits."""

import numpy as np
import pytest
from layer_stresses import layer_field

from analytic.layers.layered import LayeredBody
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


def components(field):
    """sx, sz, txz under p and under q (6, levels, columns)."""
    return np.array(
        [getattr(part, n) for part in (field.normal, field.traction) for n in ("sx", "sz", "txz")]
    )


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


@pytest.mark.parametrize("pitch", [0.02, 1.0])
def test_net_traction_on_a_frictionless_base_is_held_at_both_ends(pitch):
    body, nodes = LayeredBody(LAYER, 1.0, "frictionless"), pitch * np.arange(COUNT)
    end = 30.0
    window = (-end, nodes[-1] + end)
    field = layer_field(body, nodes, RAGGED, window, LEVELS[2:])
    half = 0.5 * pitch * np.sum(RAGGED)
    assert field.traction.sx[:, 0] == pytest.approx(np.full(4, half), rel=1e-11)
    assert field.traction.sx[:, -1] == pytest.approx(np.full(4, -half), rel=1e-11)
    assert np.max(np.abs(field.normal.sx[:, [0, -1]])) < 1e-12


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


def test_coating_of_the_same_material_is_a_half_plane():
    body = LayeredBody(LAYER, 1.0, LAYER)
    half_plane = friction_field(NODES, RAGGED, (-0.2, 1.0), LEVELS).stress
    field = layer_field(body, NODES, RAGGED, (-0.2, 1.0), LEVELS)
    for part, expected in (
        (field.normal, half_plane.normal),
        (field.traction, half_plane.traction),
    ):
        assert part.sx == pytest.approx(expected.sx, abs=1e-14)
        assert part.txz == pytest.approx(expected.txz, abs=1e-14)


def test_stresses_scale_and_mirror():
    body = LayeredBody(LAYER, 1.0, "bonded")
    field = layer_field(body, NODES, RAGGED, (NODES[0], NODES[-1]), LEVELS)
    small = layer_field(
        LayeredBody(LAYER, 1e-6, "bonded"),
        1e-6 * NODES,
        1e9 * RAGGED,
        (1e-6 * NODES[0], 1e-6 * NODES[-1]),
        1e-6 * LEVELS,
    )
    assert components(small) / 1e9 == pytest.approx(components(field), abs=1e-12)
    mirrored = layer_field(body, NODES, RAGGED[::-1], (NODES[0], NODES[-1]), LEVELS)
    signs = np.array([1.0, 1.0, -1.0, -1.0, -1.0, 1.0])[:, None, None]
    assert signs * components(mirrored)[:, :, ::-1] == pytest.approx(components(field), abs=1e-13)


def test_levels_below_the_layer_are_refused():
    with pytest.raises(ValueError, match="layer"):
        layer_field(LayeredBody(LAYER, 0.5, "bonded"), NODES, RAGGED, (0.0, 1.0), LEVELS)
