"""Stresses against Hertz's exact field, exact tractions at the surface, and evaluation."""

import numpy as np
import pytest
from scipy.integrate import trapezoid

from analytic.exact.hertz import hertz_stress
from analytic.material import Material
from analytic.plane_stress import PlaneStress
from analytic.stress import stress_at
from fem.compliance import FiniteElementCompliance
from fem.elasticity import Support, elastic_body
from fem.stress import along_surface, evaluate, nodal_stress
from fem.surface import hat_nodes
from meshes.block import BlockSpec
from meshes.build import build_block

MATERIAL = Material(1.0, 0.3)
X, Z = np.meshgrid(np.linspace(-1.5, 1.5, 61), np.linspace(0.0, 1.5, 41))
NEAR, DEEP = Z < 0.15, Z >= 0.15


def parts(stress: PlaneStress) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return stress.sx, stress.sz, stress.txz


def error(case, friction, where):
    """Relative L2 error of the three stresses on a part of the window."""
    exact = hertz_stress(case.hertz, X, Z, friction)
    exact = np.stack([exact.sx, exact.sz, exact.txz])[:, where]
    found = np.stack(parts(evaluate(case.body, case.stress(friction), X, Z)))[:, where]
    return np.sqrt(np.sum((found - exact) ** 2) / np.sum(exact**2))


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_stresses_are_hertzs(pressed, friction):
    case = pressed(20)
    assert error(case, friction, DEEP) < 1e-3
    assert error(case, friction, NEAR) < 1.1e-2


def test_stresses_under_a_rough_pressure_are_those_of_its_hats():
    """Asperities of six hats, two edges to a hat: error of tau1 in the first layer and below."""
    edge, pitch = 0.005, 0.01
    spec = BlockSpec(4000.0, 4000.0, np.array([[-1.1, 1.1]]), edge, 0.2)
    body = elastic_body(build_block(spec), MATERIAL, Support())
    x = pitch * np.arange(-99, 100)
    heights = np.random.default_rng(1).normal(size=34)
    pressure = np.maximum(0.0, np.interp(x, np.linspace(-1, 1, 34), heights))
    moved = FiniteElementCompliance(body, hat_nodes(x[0], pitch, len(x))).displacement(
        pressure, 0.1
    )
    nodal = nodal_stress(body, moved, lambda at: np.interp(at, x, pressure), 0.1)

    def tau1_error(depths):
        at_x, at_z = np.meshgrid(np.linspace(-0.999, 0.999, 1301), depths)
        exact = stress_at(x, pressure, 0.1, at_x, at_z)
        sx, sz, txz = parts(evaluate(body, nodal, at_x, at_z))
        difference = np.hypot(0.5 * (sx - sz), txz) - exact.tau1
        return np.sqrt(np.mean(difference**2) / np.mean(exact.tau1**2))

    assert tau1_error(edge * np.array([0.3, 0.6, 0.9])) < 3.3e-2
    assert tau1_error(edge * np.array([3.0, 5.0, 10.0])) < 1.5e-3


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_the_errors_fall_with_the_elements(pressed, friction):
    """First order where the pressure's square-root edge rules, second below it."""
    coarse, fine = pressed(10, 0.2), pressed(20, 0.1)
    near = np.log2(error(coarse, friction, NEAR) / error(fine, friction, NEAR))
    deep = np.log2(error(coarse, friction, DEEP) / error(fine, friction, DEEP))
    assert 0.5 < near < 1.3
    assert 1.5 < deep < 2.4


def test_tractions_at_a_flat_surface_are_exact(pressed):
    case = pressed(20)
    x = np.linspace(-2.0, 2.0, 4001)
    _, sz, txz = parts(evaluate(case.body, case.stress(0.3), x, 0.0 * x))
    np.testing.assert_allclose(sz, -case.pressure_at(x), atol=1e-12)
    np.testing.assert_allclose(txz, -0.3 * case.pressure_at(x), atol=1e-12)


def test_stress_along_the_surface_is_minus_the_pressure_without_friction(pressed):
    """Under any normal pressure on a half-plane sx = sz at the surface (Johnson 1985, eq. 2.22)."""
    case = pressed(40)
    x = np.linspace(-0.9, 0.9, 721)
    sx, sz, _ = parts(evaluate(case.body, case.stress(0.0), x, 0.0 * x))
    assert np.abs(sx - sz).max() < 2e-2
    assert np.sqrt(np.mean((sx - sz) ** 2)) < 5e-3


def test_friction_superposes(pressed):
    case = pressed(10)
    none, some, more = (case.stress(friction) for friction in (0.0, 0.2, 0.5))
    for part in ("sx", "sz", "txz"):
        base = getattr(none, part)
        expected = base + 2.5 * (getattr(some, part) - base)
        np.testing.assert_allclose(getattr(more, part), expected, atol=1e-10)


def test_every_level_bears_the_whole_load(pressed):
    """Integral of sz and txz over a horizontal cut; what passes beyond the cut is far smaller."""
    case, friction = pressed(20), 0.3
    x = np.sinh(np.linspace(-7.5, 7.5, 6001))
    for depth in (0.2, 1.0, 5.0):
        _, sz, txz = parts(evaluate(case.body, case.stress(friction), x, depth + 0.0 * x))
        load = case.hertz.load_per_length
        assert -trapezoid(sz, x) == pytest.approx(load, rel=4e-3)
        assert -trapezoid(txz, x) == pytest.approx(friction * load, rel=5e-3)


def hydrostatic(height, slope, cells, structured_block, exact_forces):
    """A rough block under sz = -1 and confined sides: sx = sz nu/(1-nu) everywhere, txz = 0."""
    line = np.linspace(-1, 1, cells + 1)
    mesh = structured_block(line, np.linspace(0, 1, cells // 2 + 1), height)
    body = elastic_body(mesh, MATERIAL, Support("frictionless", "rollers"))
    ratio = MATERIAL.poissons_ratio / (1.0 - MATERIAL.poissons_ratio)
    moved = body.solve(exact_forces(mesh, lambda x, z: (-ratio + 0 * x, -1.0, 0.0)))
    nodal = nodal_stress(
        body, moved, np.ones_like, direction=lambda x: (ratio * slope(x), np.ones_like(x))
    )
    return max(
        np.abs(nodal.sx + ratio).max(), np.abs(nodal.sz + 1.0).max(), np.abs(nodal.txz).max()
    )


def test_uniform_stress_under_a_rough_surface(structured_block, exact_forces):
    """Exact but for the surface's slope at its nodes, which is of second order."""
    assert hydrostatic(None, np.zeros_like, 8, structured_block, exact_forces) < 1e-8
    errors = [
        hydrostatic(
            lambda x: 0.05 * np.cos(3 * x),
            lambda x: -0.15 * np.sin(3 * x),
            cells,
            structured_block,
            exact_forces,
        )
        for cells in (16, 32, 64)
    ]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert errors[-1] < 1e-3
    assert np.all(np.abs(orders - 2.0) < 0.3), orders


def test_a_tilted_pressure_and_its_friction_act_on_the_inclined_face(structured_block):
    """Traction vector of the nodal stresses on the face equals the force that was applied."""
    line = np.linspace(-1, 1, 65)
    mesh = structured_block(line, np.linspace(0, 1, 17), lambda x: 0.2 * x)
    body = elastic_body(mesh, MATERIAL, Support())

    def direction(x):
        return 0.1 + 0.0 * x, np.ones_like(x)

    operator = FiniteElementCompliance(body, hat_nodes(-0.5, 1 / 16, 17), direction)
    node = -0.5 + np.arange(17) / 16
    pressure = 1.0 - node**2
    moved = operator.displacement(pressure, 0.25)

    def pressure_at(x):
        return np.interp(x, node, pressure)

    nodal = nodal_stress(body, moved, pressure_at, 0.25, direction)
    at, x = body.surface.point, body.surface.x
    inside = np.abs(x) < 0.49
    normal = np.array([-0.2, -1.0])  # out of the body, times the face's length per x
    force = np.column_stack(
        [
            nodal.sx[at] * normal[0] + nodal.txz[at] * normal[1],
            nodal.txz[at] * normal[0] + nodal.sz[at] * normal[1],
        ]
    )
    expected = pressure_at(x)[:, None] * [0.1 + 0.25, 1.0 - 0.25 * 0.1]
    np.testing.assert_allclose(force[inside], expected[inside], atol=1e-12)


def test_slopes_along_uneven_edges():
    vertex = np.array([0.0, 1.0, 1.5, 4.0])
    x = np.sort(np.concatenate([vertex, 0.5 * (vertex[1:] + vertex[:-1])]))
    np.testing.assert_allclose(along_surface(x, x**2), 2 * x, atol=1e-12)
    both = along_surface(x, np.column_stack([3 * x, -x]))
    np.testing.assert_allclose(both, np.tile([3.0, -1.0], (7, 1)), atol=1e-12)


def test_evaluation_is_quadratic_and_keeps_shapes(structured_block):
    mesh = structured_block(np.linspace(-1, 1, 7), np.linspace(0, 1, 4), seed=4)
    body = elastic_body(mesh, MATERIAL, Support())
    x, z = body.points.T
    nodal = PlaneStress(x**2, x * z - 1, z**2 + x)
    where = np.array([[-1.0, 0.3, 1.0], [0.0, 0.5, 2.0]]), np.array([[0.0, 0.3, 1.0]])
    sx, sz, txz = parts(evaluate(body, nodal, *where))
    a, b = np.broadcast_arrays(*where)
    inside = a <= 1.0
    np.testing.assert_array_equal(np.isnan(sx), ~inside)
    np.testing.assert_allclose(sx[inside], (a**2)[inside], atol=1e-12)
    np.testing.assert_allclose(sz[inside], (a * b - 1)[inside], atol=1e-12)
    np.testing.assert_allclose(txz[inside], (b**2 + a)[inside], atol=1e-12)
    assert evaluate(body, nodal, 0.25, 0.5).sx == pytest.approx(0.0625)
