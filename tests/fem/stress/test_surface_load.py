"""What acts on an inclined surface: tractions, kinks, and the turn into the surface's axes."""

import numpy as np

from analytic.material import Material
from fem.body.elasticity import Support, elastic_body
from fem.stress.kinks import Weights
from fem.stress.surface_load import SurfaceLoad, from_surface, normal, to_surface


def inclined(structured_block, rise, hats, pressure):
    line = np.linspace(-1, 1, 17)
    mesh = structured_block(line, np.linspace(0, 1, 5), lambda x: -rise * x)
    body = elastic_body(mesh, Material(1.0, 0.3), Support())

    def direction(x):
        return 0.1 + 0.0 * x, np.ones_like(x)

    return SurfaceLoad(body, hats, pressure, 0.25, direction)


def test_the_kinks_exert_the_load(structured_block):
    """Along a straight surface, kinks alone: the force of the load, by length of arc."""
    rise, hats, pressure = 0.3, np.array([-0.6, -0.3, 0.1, 0.5]), np.array([2.0, 3.0])
    load = inclined(structured_block, rise, hats, pressure)
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


def test_only_bends_of_the_pressure_are_kinks(structured_block):
    hats, pressure = np.array([-0.5, -0.25, 0.0, 0.25, 0.5]), np.array([1.0, 2.0, 1.0])
    load = inclined(structured_block, 0.0, hats, pressure)
    np.testing.assert_array_equal(load.kinks.place, [-0.5, 0.0, 0.5])


def test_turning_to_the_surface_and_back():
    random = np.random.default_rng(7)
    angle, stress = random.uniform(-1, 1, 9), random.normal(size=(9, 3))
    t = np.column_stack([np.cos(angle), np.sin(angle)])
    np.testing.assert_allclose(from_surface(t, *to_surface(t, stress)), stress, atol=1e-14)
    s_tt, s_nn, s_nt = to_surface(np.array([[1.0, 0.0]]), np.array([[1.0, 2.0, 3.0]]))
    np.testing.assert_array_equal([s_tt, s_nn, s_nt], [[1.0], [2.0], [-3.0]])
