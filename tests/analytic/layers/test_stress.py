"""Stresses in a layer: surface and base conditions, equilibrium, waves, images, limits."""

import numpy as np
import pytest
from exact_stresses import wave_stress
from layer_stresses import layer_field

from analytic.layers.layered import LayeredBody
from analytic.layers.operator import PeriodicLayeredSurface
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


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("base", BASES)
def test_surface_carries_the_given_tractions(base, periodic):
    body = LayeredBody(LAYER, 1.0, BASES[base])
    window = (NODES[0], NODES[-1])
    field = layer_field(body, NODES, RAGGED, window, LEVELS, periodic=periodic)
    stress = field.at(0.3).stress
    assert np.array_equal(stress.sz[0], -RAGGED)
    assert np.array_equal(stress.txz[0], -0.3 * RAGGED)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("pitch", [0.02, 0.5, 5.0])
def test_base_holds_the_layer(pitch, periodic):
    """Bonded: no strain along the base, (1 - nu) sx = nu sz. Frictionless: no shear."""
    nu, nodes = LAYER.poissons_ratio, pitch * np.arange(COUNT)
    window = (-3.0 * pitch, 50.0 * pitch)
    for base in ("bonded", "frictionless"):
        body = LayeredBody(LAYER, 1.0, base)
        field = layer_field(body, nodes, RAGGED, window, np.array([0.2, 1.0]), periodic=periodic)
        for stress in (field.normal, field.traction):
            if base == "bonded":
                strain = (1.0 - nu) * stress.sx[1] - nu * stress.sz[1]
                assert np.max(np.abs(strain)) < 1e-14
            else:
                assert np.max(np.abs(stress.txz[1])) < 1e-13
            assert np.max(np.abs(stress.sx[0])) > 1e-3


@pytest.mark.parametrize("base", BASES)
def test_every_level_carries_the_load_of_a_period(base):
    """But for the traction along a frictionless base, which the layer itself takes up."""
    body = LayeredBody(LAYER, 1.0, BASES[base])
    window = (NODES[0], NODES[-1] + 0.75 * PITCH)
    field = layer_field(body, NODES, RAGGED, window, LEVELS[2:], 4, periodic=True)
    mean = np.mean(RAGGED)
    means = components(field).mean(axis=2)
    shear = mean * (1.0 - LEVELS[2:]) if base == "frictionless" else mean
    assert means[1] == pytest.approx(np.full(4, -mean), rel=1e-12)
    assert means[5] == pytest.approx(-shear + np.zeros(4), rel=1e-12, abs=1e-14)
    assert np.all(np.abs(means[[2, 4]]) < 1e-13)


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


@pytest.mark.parametrize("base", ["bonded", "frictionless"])
def test_strain_adds_up_to_the_displacement_of_the_operator(base):
    """uz of the surface is what the layer is compressed by, averaged over hats as there."""
    count, thickness, nu = 32, 3.0, LAYER.poissons_ratio
    body = LayeredBody(LAYER, thickness, base)
    points, weights = np.polynomial.legendre.leggauss(60)
    # points crowd at the surface, where hats leave ln z in the strain
    ease = (0.5 * (1.0 + points)) ** 3
    levels = thickness * ease
    weights = weights * 1.5 * thickness * (0.5 * (1.0 + points)) ** 2
    pressure = 1.0 + np.cos(2.0 * np.pi * np.arange(count) / count) + 0.3 * RAGGED[:count]
    parts = 16
    nodes = np.arange(count, dtype=float)
    window = (0.0, count - 1.0 / parts)
    field = layer_field(body, nodes, pressure, window, levels, parts, periodic=True)
    strain = (1.0 - nu) * field.normal.sz - nu * field.normal.sx
    sunk = -weights @ strain / (2.0 * LAYER.shear_modulus)
    shape = 1.0 - np.abs(np.arange(-parts + 1, parts)) / parts
    averaged = [
        shape @ np.take(sunk, i * parts + np.arange(-parts + 1, parts), mode="wrap") / parts
        for i in range(count)
    ]
    expected = PeriodicLayeredSurface(count, 1.0, body).apply(pressure)
    assert np.array(averaged) == pytest.approx(expected, rel=2e-4)


@pytest.mark.parametrize("base", BASES)
def test_a_wave_of_hats_is_the_wave(base):
    """Below the surface the aliases are gone and sinc^2 of the pressure's wave is left."""
    count, waves = 48, 2
    nodes = np.arange(count) / count
    k = 2.0 * np.pi * waves
    body = LayeredBody(LAYER, 0.4, BASES[base])
    levels = np.array([0.15, 0.25, 0.4])
    seen = np.sinc(waves / count) ** 2
    under_p, under_q = wave_stress(body, k, levels)
    field = layer_field(body, nodes, np.cos(k * nodes), (0.0, 1.0), levels, periodic=True)
    cosine, sine = seen * np.cos(k * field.x), seen * np.sin(k * field.x)
    assert field.normal.sx == pytest.approx(np.outer(under_p.sx, cosine), abs=1e-13)
    assert field.normal.sz == pytest.approx(np.outer(under_p.sz, cosine), abs=1e-13)
    assert field.normal.txz == pytest.approx(np.outer(under_p.txz, sine), abs=1e-13)
    field = layer_field(body, nodes, np.sin(k * nodes), (0.0, 1.0), levels, periodic=True)
    assert field.traction.sx == pytest.approx(np.outer(under_q.sx, cosine), abs=1e-13)
    assert field.traction.sz == pytest.approx(np.outer(under_q.sz, cosine), abs=1e-13)
    assert field.traction.txz == pytest.approx(np.outer(under_q.txz, sine), abs=1e-13)


@pytest.mark.parametrize("pitch", [0.02, 0.3, 4.0])
def test_integral_over_waves_is_the_limit_of_long_periods(pitch):
    """A narrow window is integrated, a padded period summed; and a wide window as a narrow one."""
    body, nodes = LayeredBody(LAYER, 1.0, "bonded"), pitch * np.arange(COUNT)
    window = (-4.0 * pitch, 44.0 * pitch)
    free = layer_field(body, nodes, RAGGED, window, LEVELS, 3)
    count = COUNT + int(60.0 / pitch) + 8
    padded = np.concatenate([RAGGED, np.zeros(count - COUNT)])
    places = pitch * np.arange(count)
    period = layer_field(body, places, padded, window, LEVELS, 3, periodic=True)
    assert components(free) == pytest.approx(components(period), abs=2e-14)
    # a substrate so stiff that it is rigid is never summed by a period
    stiff = LayeredBody(LAYER, 1.0, Material(1e30, 0.3))
    integrated = layer_field(stiff, nodes, RAGGED, window, LEVELS, 3)
    assert components(free) == pytest.approx(components(integrated), abs=2e-14)


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


@pytest.mark.parametrize("periodic", [False, True])
def test_coating_of_the_same_material_is_a_half_plane(periodic):
    body = LayeredBody(LAYER, 1.0, LAYER)
    half_plane = friction_field(NODES, RAGGED, (-0.2, 1.0), LEVELS, periodic=periodic).stress
    field = layer_field(body, NODES, RAGGED, (-0.2, 1.0), LEVELS, periodic=periodic)
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
