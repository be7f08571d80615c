"""Points are found in the element that holds them; the quadrature rule on the triangle."""

import numpy as np
import pytest
from blocks import graded, structured_block, widened

from fem.body.triangle import Locator, collapsed_gauss, shapes
from meshes.block import real_points


def wavy(x):
    """Fades out where the elements of a graded mesh could no longer follow it."""
    return 0.12 * np.cos(9.0 * x) * np.exp(-((x / 0.6) ** 4))


@pytest.fixture(scope="module", params=["straight", "curved"])
def case(request):
    outer = graded(2.0, 0.05, 1.3)
    curved, x = request.param == "curved", widened(np.linspace(-1, 1, 41), outer)
    mesh = structured_block(x, outer, wavy if curved else None, seed=11)
    return real_points(mesh), mesh.triangles, Locator(real_points(mesh), mesh.triangles, curved)


def test_points_come_back_from_their_element(case):
    """Those of the mesh, on its boundary too, and others."""
    points, triangles, locator = case
    random = np.random.default_rng(3)
    others = np.column_stack([random.uniform(-3, 3, 20_000), random.uniform(0.13, 2, 20_000)])
    where = np.vstack([others, points])
    element, at = locator(where)
    assert np.all(element >= 0)
    back = np.einsum("kac,ka->kc", points[triangles[element]], shapes(at))
    np.testing.assert_allclose(back, where, atol=1e-12)
    assert at.min() > -1e-9 and at.sum(axis=1).max() < 1.0 + 1e-9


def test_points_outside_belong_to_no_element(case):
    _, _, locator = case
    where = np.array([[0.0, -0.2], [3.1, 1.0], [-3.001, 1.0], [0.0, 2.001], [50.0, 50.0]])
    np.testing.assert_array_equal(locator(where)[0], -1)


def test_points_just_below_and_above_a_rough_surface():
    line = np.linspace(-1, 1, 41)
    mesh = structured_block(line, np.linspace(0, 1, 11), wavy, seed=2)
    assert np.abs(np.gradient(wavy(line), line)).max() > 0.9
    locator = Locator(real_points(mesh), mesh.triangles, True)
    x = np.linspace(-0.99, 0.99, 997)
    assert np.all(locator(np.column_stack([x, -wavy(x) + 1e-3]))[0] >= 0)
    assert np.all(locator(np.column_stack([x, -wavy(x) - 1e-3]))[0] == -1)


def test_a_block_bent_along_x_too():
    """A sector of a ring: points just inside and outside of its curved sides and its top."""
    mesh = structured_block(np.linspace(-1, 1, 33), np.linspace(0, 1, 17), seed=6)
    angle, radius = mesh.points[:, 0], 2.0 - mesh.points[:, 1]
    points = np.column_stack([radius * np.sin(angle), 2.0 - radius * np.cos(angle)])
    locator = Locator(points, mesh.triangles, True)
    random = np.random.default_rng(5)
    angle, radius = random.uniform(-1, 1, 5000), random.uniform(0.9, 2.1, 5000)
    inside = np.abs(radius - 1.5) < 0.499
    outside = np.abs(radius - 1.5) > 0.501
    where = np.column_stack([radius * np.sin(angle), 2.0 - radius * np.cos(angle)])
    element, at = locator(where)
    assert np.all(element[outside] == -1)
    assert np.all(element[inside & (np.abs(angle) < 0.999)] >= 0)
    within = element >= 0
    back = np.einsum("kac,ka->kc", points[mesh.triangles[element[within]]], shapes(at[within]))
    np.testing.assert_allclose(back, where[within], atol=1e-12)


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_the_rule_on_the_triangle_is_exact_to_its_degree_and_not_beyond(degree):
    """Integral of r^a s^b over the triangle: a! b! / (a + b + 2)!."""
    at, weight = collapsed_gauss(degree)
    exact = 2 * degree - 2
    assert weight @ at[:, 1] ** exact == pytest.approx(1 / (exact + 1) / (exact + 2), rel=1e-14)
    assert weight @ (at[:, 0] ** exact) == pytest.approx(1 / (exact + 1) / (exact + 2), rel=1e-14)
    beyond = 2 * degree
    assert weight @ at[:, 1] ** beyond != pytest.approx(1 / (beyond + 1) / (beyond + 2), rel=1e-6)
