"""The loaded side is found and ordered; the nodal forces of hat pressures are exact."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from blocks import structured_block
from numpy.polynomial import Polynomial
from scenes import hat_nodes
from scipy.interpolate import lagrange

from fem.body.nodes import nodes_of
from fem.body.surface import boundary_points, hat_forces, surface_of

LINE = np.array([-2.0, -1.1, -0.4, -0.3, 0.1, 0.15, 0.9, 2.0])


@pytest.fixture(scope="module")
def mesh():
    return structured_block(LINE, np.linspace(0, 1, 4), seed=1)


@pytest.fixture(scope="module")
def surface(mesh, degree):
    return surface_of(mesh, nodes_of(mesh, degree))


def bent(mesh):
    """Block whose top is stretched along x: edges on which x is quadratic."""
    x, z = mesh.points.T
    return replace(
        mesh, shift=np.column_stack([0.1 * np.sin(1.7 * x) * (1 - z), 0.1 * x * (1 - z)])
    )


def test_surface_is_sorted_and_has_degree_minus_one_inner_nodes_to_an_edge(mesh, surface, degree):
    exact = np.concatenate([np.linspace(a, b, degree, endpoint=False) for a, b in pairwise(LINE)])
    np.testing.assert_allclose(surface.x, np.append(exact, LINE[-1]), atol=1e-15)
    np.testing.assert_array_equal(surface.edges[:, [0, 2]], np.column_stack([LINE[:-1], LINE[1:]]))
    np.testing.assert_array_equal(surface.x, nodes_of(mesh, degree).real[surface.point, 0])
    assert not nodes_of(mesh, degree).real[surface.point, 1].any()


def test_sides_hold_their_points_and_corners_belong_to_two():
    mesh = structured_block(np.linspace(-1, 1, 5), np.linspace(0, 3, 4), lambda x: 0.1 + 0 * x)
    sides = boundary_points(mesh.points, mesh.spec)
    for side, axis, value in (("top", 1, 0), ("bottom", 1, 3), ("left", 0, -1), ("right", 0, 1)):
        points = np.flatnonzero(mesh.points[:, axis] == value)
        np.testing.assert_array_equal(getattr(sides, side), points)
    assert len(np.intersect1d(sides.top, sides.left)) == 1


def test_a_top_that_is_not_of_edges_and_their_middles_is_refused():
    mesh = structured_block(np.linspace(-1, 1, 5), np.linspace(0, 1, 3))
    nodes = nodes_of(mesh, 2)
    third = surface_of(mesh, nodes).point[3]
    over = mesh.shift.copy()
    over[third, 0] = 0.13
    with pytest.raises(ValueError, match="overhangs"):
        surface_of(replace(mesh, shift=over), nodes)
    mesh.points[third, 0] += 0.01
    with pytest.raises(ValueError, match="not in the middle"):
        surface_of(mesh, nodes)


def integral(polynomials, start, end):
    """Integral of a product of polynomials, in exact arithmetic but for round-off."""
    whole = np.prod(polynomials).integ()
    return whole(end) - whole(start)


@pytest.mark.parametrize(
    "hats",
    [
        hat_nodes(-0.9, 0.05, 37),
        hat_nodes(-0.5, 0.9, 2),
        np.array([-1.9, -1.85, -1.2, -0.35, -0.3, 0.02, 0.12, 0.13, 1.1, 1.9]),
    ],
    ids=["fine", "coarse", "uneven"],
)
def test_hat_forces_are_exact(surface, degree, hats):
    """Against integrals of the polynomials' coefficients, piece by piece."""
    forces = hat_forces(surface, hats).toarray()
    count = len(hats) - 2
    assert forces.shape == (2 * len(surface.x), count)
    assert np.all(forces[0::2] == 0.0)
    exact = np.zeros((len(surface.x), count))
    for start, end in pairwise(np.unique(np.clip(np.append(hats, LINE), hats[0], hats[-1]))):
        edge = np.searchsorted(LINE, 0.5 * (start + end)) - 1
        nodes = degree * edge + np.arange(degree + 1)
        left = np.searchsorted(hats, 0.5 * (start + end)) - 1
        for a, values in zip(nodes, np.eye(degree + 1), strict=True):
            shape = Polynomial(lagrange(surface.x[nodes], values).coef[::-1])
            for i, values in ((left, [1.0, 0.0]), (left + 1, [0.0, 1.0])):
                hat = Polynomial(lagrange(hats[left : left + 2], values).coef[::-1])
                if 1 <= i <= count:
                    exact[a, i - 1] += integral([shape, hat], start, end)
    np.testing.assert_allclose(forces[1::2], exact, atol=1e-12)


def test_on_a_bent_surface_too_pressure_is_a_force_per_length_of_x(mesh, degree):
    """Sum of the forces, and their work on a displacement that is linear in x: exact only from
    degree 2 on, whose elements hold the surface's own shape."""
    surface = surface_of(bent(mesh), nodes_of(bent(mesh), degree))
    assert np.abs(surface.edges @ [0.5, -1.0, 0.5]).max() > 1e-3
    hats = np.array([-1.5, -1.3, -0.2, 0.1, 0.7, 1.5])
    pressure = np.array([1.0, 0.3, 2.0, 0.4])
    weight = 0.5 * (hats[2:] - hats[:-2])
    moment = weight * (hats[2:] + hats[1:-1] + hats[:-2]) / 3.0
    force = (hat_forces(surface, hats) @ pressure)[1::2]
    assert force.sum() == pytest.approx(weight @ pressure, rel=1e-13)
    assert force @ surface.x == pytest.approx(moment @ pressure, rel=1e-12 if degree > 1 else 1e-1)


def test_hats_may_touch_the_ends_of_the_surface_but_not_pass_them(surface):
    pitch = 4.0 / 11
    hat_forces(surface, hat_nodes(-2.0 + pitch, pitch, 10))
    for beside in (0.99, 1.01):
        with pytest.raises(ValueError, match="the surface only from -2 m to 2 m"):
            hat_forces(surface, hat_nodes(-2.0 + beside * pitch, pitch, 10))


@pytest.mark.parametrize(
    "hats", [[0.0, 0.1], [0.0, 0.2, 0.2, 0.3], [0.0, np.nan, 0.3], [[0, 1, 2]]]
)
def test_hats_that_do_not_ascend_are_refused(surface, hats):
    with pytest.raises(ValueError, match="three or more numbers that ascend"):
        hat_forces(surface, np.array(hats))


def test_a_varying_direction_is_integrated_with_the_pressure(surface):
    """A linear direction under any pressure: the resultant is the integral of their product."""
    pitch, count = 0.05, 41
    hats = hat_nodes(-1.0, pitch, count)
    forces = hat_forces(surface, hats, lambda x: (0.3 * x - 0.1, 1.0 + 0.2 * x))
    node = hats[1:-1]
    pressure = np.exp(node)
    load = forces @ pressure
    assert load[0::2].sum() == pytest.approx(pitch * pressure @ (0.3 * node - 0.1), rel=1e-12)
    assert load[1::2].sum() == pytest.approx(pitch * pressure @ (1.0 + 0.2 * node), rel=1e-12)
