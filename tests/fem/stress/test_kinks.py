"""The field of a kink against 30-digit values of hats, Hooke's law; loads on inclined faces."""

import numpy as np
import pytest
from blocks import hooke, structured_block
from scenes import reference

from analytic.material import Material
from fem.body.elasticity import Support, elastic_body
from fem.stress.kinks import Kinks, Weights
from fem.stress.surface_load import SurfaceLoad, normal, to_surface

POINTS = reference("hat_stress")["points"]
MATERIAL = Material(3.0, 0.3)


def all_of(kinks, count):
    """Weights 1 of every kink for `count` patches."""
    number = len(kinks.place)
    first, start = np.zeros(count, dtype=int), number * np.arange(count + 1)
    return Weights(first, start, np.ones(start[-1]))


def as_table(weights, number):
    """Weights (n, each) of all kinks, 0 where a patch does not see them."""
    table = np.zeros((len(weights.first), number))
    for row, first, count, start in zip(
        table, weights.first, weights.count, weights.start, strict=False
    ):
        row[first : first + count] = weights.value[start : start + count]
    return table


def stress(kinks, place):
    every = np.arange(len(place))
    return kinks.stress(all_of(kinks, len(place)), every, place, every[:, None])[:, 0]


def displacement(kinks, place):
    every = np.arange(len(place))
    weights = all_of(kinks, len(place))
    moved = kinks.displacement(weights, every, place, every[:, None], MATERIAL.poissons_ratio)
    return moved[:, 0] / MATERIAL.shear_modulus


def hat(friction, tangent=1.0):
    """Three kinks: pressure 1 at the origin, 0 at a distance of 1 along the tangent."""
    bend = np.array([1.0, -2.0, 1.0])
    place = np.array([-1.0, 0.0, 1.0]) * tangent
    return Kinks(place, np.full(3, tangent, dtype=complex), bend * (-1.0 + 1j * friction))


@pytest.mark.parametrize("friction", [0.0, 0.4])
def test_three_kinks_make_a_hat(friction):
    near = [p for p in POINTS if abs(float(p["x_over_pitch"])) < 10 > float(p["z_over_pitch"])]
    assert len(near) > 20
    place, sx, sz, txz, sliding = (
        np.array([[float(p[name]) for name in names] for p in near])
        for names in (["x_over_pitch", "z_over_pitch"], ["sx"], ["sz"], ["txz"], ["sx_traction"])
    )
    exact = np.column_stack([sx + friction * sliding, sz + friction * txz, txz + friction * sx])
    np.testing.assert_allclose(stress(hat(friction), place), exact, atol=1e-13)


def test_the_displacement_has_the_kinks_stress():
    kinks = hat(0.4, np.exp(0.3j))
    place = np.random.default_rng(3).uniform([-2.0, 0.7], [2.0, 2.0], (20, 2))
    step = 1e-5

    def slope(axis):
        shift = step * np.eye(2)[axis]
        return (displacement(kinks, place + shift) - displacement(kinks, place - shift)) / (
            2 * step
        )

    (exx, uz_x), (ux_z, ezz) = slope(0).T, slope(1).T
    stresses = np.column_stack(hooke(MATERIAL, exx, ezz, ux_z + uz_x))
    np.testing.assert_allclose(stresses, stress(kinks, place), atol=1e-8)


def test_a_turned_surface_turns_stresses_and_displacements():
    turn = np.exp(0.4j)
    c, s = turn.real, turn.imag
    matrix = np.array([[c, -s], [s, c]])
    place = np.random.default_rng(4).uniform([-2.0, 0.1], [2.0, 2.0], (20, 2))
    flat, turned = hat(0.2), hat(0.2, turn)
    sx, sz, txz = stress(flat, place).T
    tensor = matrix @ np.moveaxis(np.array([[sx, txz], [txz, sz]]), -1, 0) @ matrix.T
    expected = np.column_stack([tensor[:, 0, 0], tensor[:, 1, 1], tensor[:, 0, 1]])
    np.testing.assert_allclose(stress(turned, place @ matrix.T), expected, atol=1e-13)
    moved = displacement(flat, place) @ matrix.T
    np.testing.assert_allclose(displacement(turned, place @ matrix.T), moved, atol=1e-13)


def test_sums_over_the_kinks_are_those_of_a_table():
    """Whichever patches share a place."""
    rng = np.random.default_rng(5)
    x = np.sort(rng.uniform(-20.0, 20.0, 30))
    kinks = Kinks(x + 0j, np.ones(30, dtype=complex), rng.normal(size=30) + 1j)
    centre = np.column_stack([rng.uniform(-30.0, 30.0, 40), rng.uniform(0.0, 9.0, 40)])
    weights = kinks.weights(centre, rng.uniform(0.2, 2.0, 40), rng.random(40) < 0.8)
    assert 0 < np.count_nonzero(weights.count) < 40
    place = np.column_stack([rng.uniform(-20.0, 20.0, 50), rng.uniform(0.1, 5.0, 50)])
    patch, point = rng.integers(0, 40, 60), rng.integers(0, 50, (60, 6))
    sums = kinks.stress(weights, patch, place, point)

    single = [
        Kinks(k[:1], k[1:2], k[2:])
        for k in np.column_stack([kinks.place, kinks.tangent, kinks.jump])
    ]
    by_kink = np.array([stress(one, place) for one in single])
    expected = np.einsum("rk,krqc->rqc", as_table(weights, 30)[patch], by_kink[:, point])
    np.testing.assert_allclose(sums, expected, atol=1e-13 * np.abs(expected).max())


def test_the_kinks_exert_the_load():
    """Along a straight surface, kinks alone: the force of the load, by length of arc."""
    rise, hats, pressure = 0.3, np.array([-0.6, -0.3, 0.1, 0.5]), np.array([2.0, 3.0])
    line = np.linspace(-1, 1, 17)
    mesh = structured_block(line, np.linspace(0, 1, 5), lambda x: -rise * x)
    body = elastic_body(mesh, Material(1.0, 0.3), Support())
    load = SurfaceLoad(body, hats, pressure, 0.25, lambda x: (0.1 + 0.0 * x, np.ones_like(x)))
    x = np.array([-0.8, -0.5, -0.2, 0.3, 0.7])
    place, every = np.column_stack([x, rise * x]), np.arange(len(x))
    count = len(load.kinks.place)
    weights = Weights(0 * every, count * np.arange(len(x) + 1), np.ones(count * len(x)))
    sx, sz, txz = load.kinks.stress(weights, every, place, every[:, None])[:, 0].T
    n = normal(load.tangent(x))
    force = np.column_stack([sx * n[:, 0] + txz * n[:, 1], txz * n[:, 0] + sz * n[:, 1]])
    applied = np.interp(x, hats, [0.0, *pressure, 0.0])[:, None] * [0.1 + 0.25, 1.0 - 0.25 * 0.1]
    np.testing.assert_allclose(force, applied / np.hypot(1.0, rise), atol=1e-12)
    s_nn, s_nt = load.across(x)
    _, kinks_nn, kinks_nt = to_surface(load.tangent(x), np.column_stack([sx, sz, txz]))
    np.testing.assert_allclose([kinks_nn, kinks_nt], [s_nn, s_nt], atol=1e-12)
