"""The loaded side is found and ordered; the nodal forces of hat pressures are exact."""

from itertools import pairwise

import numpy as np
import pytest

from fem.surface import boundary_points, hat_forces, hat_nodes, surface_of


@pytest.fixture(scope="module")
def surface(structured_block):
    line = np.array([-2.0, -1.1, -0.4, -0.3, 0.1, 0.15, 0.9, 2.0])
    return surface_of(structured_block(line, np.linspace(0, 1, 4), seed=1))


def test_surface_is_sorted_vertices_and_midpoints(surface):
    assert np.all(np.diff(surface.x) > 0.0)
    np.testing.assert_allclose(surface.x[1::2], 0.5 * (surface.x[:-1:2] + surface.x[2::2]))
    assert len(surface.x) == 15


def test_sides_hold_their_points_and_corners_belong_to_two(structured_block):
    mesh = structured_block(np.linspace(-1, 1, 5), np.linspace(0, 3, 4), lambda x: 0.1 + 0 * x)
    sides = boundary_points(mesh)
    for side, axis, value in (("top", 1, 0), ("bottom", 1, 3), ("left", 0, -1), ("right", 0, 1)):
        found = np.flatnonzero(mesh.points[:, axis] == value)
        np.testing.assert_array_equal(getattr(sides, side), found)
    assert len(np.intersect1d(sides.top, sides.left)) == 1


def test_a_top_whose_midpoints_are_off_the_middle_is_refused(structured_block):
    mesh = structured_block(np.linspace(-1, 1, 5), np.linspace(0, 1, 3))
    surface = surface_of(mesh)
    mesh.points[surface.point[3], 0] += 0.01
    with pytest.raises(ValueError, match="not in the middle"):
        surface_of(mesh)


@pytest.mark.parametrize("pitch", [0.011, 0.13, 0.9])
def test_hat_forces_are_exact(surface, pitch):
    """Forces against an adaptive quadrature of shape function times hat, piece by piece."""
    from scipy.integrate import quad

    count = int(2.4 / pitch)
    x0 = -0.5 * pitch * (count - 1) + 0.03
    forces = hat_forces(surface, x0, pitch, count).toarray()
    assert forces.shape == (2 * len(surface.x), count)
    assert np.all(forces[0::2] == 0.0)
    node = hat_nodes(x0, pitch, count)
    for i in (0, count // 2, count - 1):
        support = np.clip([node[i] - pitch, node[i], node[i] + pitch], *surface.x[[0, -1]])
        for a in range(len(surface.x)):
            around = surface.x[max(0, a - 2) : a + 3]
            cut = np.unique(np.concatenate([support, surface.x[::2]]))
            value = np.eye(len(surface.x))[a]
            exact = sum(
                quad(product, start, end, args=(surface.x, value, node[i], pitch))[0]
                for start, end in pairwise(cut)
                if end > support[0]
                and start < support[-1]
                and end > around[0]
                and start < around[-1]
            )
            assert forces[2 * a + 1, i] == pytest.approx(exact, abs=1e-14)


def product(x, nodes, value, centre, pitch):
    return quadratic_at(nodes, value, x) * hat(x - centre, pitch)


def hat(x, pitch):
    return max(0.0, 1.0 - abs(x) / pitch)


def quadratic_at(nodes, value, x):
    e = min(max(int(np.searchsorted(nodes[::2], x)) - 1, 0), len(nodes) // 2 - 1)
    x0, xm, x1 = nodes[2 * e : 2 * e + 3]
    v0, vm, v1 = value[2 * e : 2 * e + 3]
    return (
        v0 * (x - xm) * (x - x1) / ((x0 - xm) * (x0 - x1))
        + vm * (x - x0) * (x - x1) / ((xm - x0) * (xm - x1))
        + v1 * (x - x0) * (x - xm) / ((x1 - x0) * (x1 - xm))
    )


def test_resultant_and_moment_are_the_pressures(surface):
    pressure = np.array([0.0, 2.0, 1.0, 5.0, 0.5])
    pitch, x0 = 0.17, -0.41
    force = (hat_forces(surface, x0, pitch, 5) @ pressure)[1::2]
    assert force.sum() == pytest.approx(pitch * pressure.sum(), rel=1e-13)
    node = hat_nodes(x0, pitch, 5)
    assert force @ surface.x == pytest.approx(pitch * pressure @ node, rel=1e-13)


def test_hats_may_touch_the_ends_of_the_surface_but_not_pass_them(surface):
    pitch = 4.0 / 11
    hat_forces(surface, -2.0 + pitch, pitch, 10)
    with pytest.raises(ValueError, match="the surface only from -2 m to 2 m"):
        hat_forces(surface, -2.0 + 0.99 * pitch, pitch, 10)
    with pytest.raises(ValueError, match="the surface only"):
        hat_forces(surface, -2.0 + 1.01 * pitch, pitch, 10)


def test_a_varying_direction_is_integrated_with_the_pressure(surface):
    """A linear direction on a constant pressure: the resultant is its mean times the load."""
    pitch, x0, count = 0.05, -1.0, 41
    forces = hat_forces(surface, x0, pitch, count, lambda x: (0.3 * x - 0.1, 1.0 + 0.2 * x))
    node = hat_nodes(x0, pitch, count)
    pressure = np.exp(node)
    load = forces @ pressure
    assert load[0::2].sum() == pytest.approx(pitch * pressure @ (0.3 * node - 0.1), rel=1e-12)
    assert load[1::2].sum() == pytest.approx(pitch * pressure @ (1.0 + 0.2 * node), rel=1e-12)
