"""Neo-Hookean bodies: exact homogeneous deformations, an energy, the linear body as their limit."""

import numpy as np
import pytest

from analytic.material import Material
from fem.body.elasticity import Coating, Support, elastic_body
from fem.body.surface import straight_down
from fem.body.triangle import collapsed_gauss, gradients, jacobians
from fem.nonlinear.hyperelastic import (
    CauchyRecovery,
    HyperelasticBody,
    along_surface,
    cauchy_stress,
)
from fem.solver.mumps import FemError
from fem.stress.recovery import recovered_stress
from fem.stress.surface_load import SurfaceLoad

MATERIAL = Material(2.0, 0.3)
MU = MATERIAL.shear_modulus
LAME = 2.0 * MU * 0.3 / 0.4
X = np.linspace(-1.0, 1.0, 5)
Z = np.linspace(0.0, 1.0, 4)


def bent(x):
    return 0.1 * np.cos(2.0 * x)


@pytest.fixture(scope="module")
def body(structured_block):
    """Curved elements without symmetry."""
    return elastic_body(structured_block(X, Z, bent, seed=3), MATERIAL, Support())


@pytest.fixture(scope="module")
def response(body):
    return HyperelasticBody(body)


def quadrature(body):
    """Reference points (q, 2) and what area (m, q) belongs to each."""
    at, share = collapsed_gauss(6)
    return at, np.linalg.det(jacobians(body.points[body.mesh.triangles], at)) * share


def deformed_by(body, gradient):
    """Displacement of a homogeneous deformation."""
    return body.nodes @ np.asarray(gradient, dtype=float).T


def first_piola(gradient):
    """P = mu (F - F^-T) + lambda ln J F^-T, written out by cofactors."""
    f = np.eye(2) + gradient
    volume = f[0, 0] * f[1, 1] - f[0, 1] * f[1, 0]
    inverse = np.array([[f[1, 1], -f[1, 0]], [-f[0, 1], f[0, 0]]]) / volume
    return MU * (f - inverse) + LAME * np.log(volume) * inverse


GRADIENTS = {
    "shear": [[0.0, 0.7], [0.0, 0.0]],
    "stretch": [[0.4, 0.0], [0.0, -0.3]],
    "all": [[0.3, -0.2], [0.5, -0.1]],
}


@pytest.mark.parametrize("gradient", GRADIENTS.values(), ids=GRADIENTS.keys())
def test_homogeneous_deformations_are_exact(body, response, gradient):
    """Forces on the boundary are those of P, none inside; Cauchy's stress is P F' / J."""
    gradient = np.array(gradient)
    force, _ = response.linearised(deformed_by(body, gradient))
    piola = first_piola(gradient)
    boundary = np.unique(np.concatenate(list(vars(body.sides).values())))
    inside = np.setdiff1d(np.arange(len(body.nodes)), boundary)
    scale = np.abs(force).max()
    assert np.abs(force[inside]).max() < 1e-2 * scale  # curved elements: by quadrature
    # virtual work of any linear displacement: P times the area
    area = quadrature(body)[1].sum()
    np.testing.assert_allclose(force.T @ body.nodes, piola * area, rtol=2e-3, atol=2e-3 * MU)
    f = np.eye(2) + gradient
    sigma = piola @ f.T / np.linalg.det(f)
    found = cauchy_stress(gradient, MU, LAME)[:3]
    np.testing.assert_allclose(found, [sigma[0, 0], sigma[1, 1], sigma[0, 1]], rtol=1e-13)


def test_simple_shear_by_the_textbook():
    """mu g^2 along, nothing across, mu g: the volume stays (Bonet and Wood, section 6.4)."""
    np.testing.assert_allclose(
        cauchy_stress(np.array([[0.0, 0.7], [0.0, 0.0]]), MU, LAME),
        [MU * 0.49, 0.0, MU * 0.7, 0.0],
        atol=1e-15,
    )


def test_rigid_motions_give_no_stress(body, response):
    c, s = np.cos(1.1), np.sin(1.1)
    moved = deformed_by(body, [[c - 1.0, s], [-s, c - 1.0]]) + np.array([0.3, -0.2])
    force, _ = response.linearised(moved)
    assert np.abs(force).max() < 1e-13 * MU
    nothing = SurfaceLoad(body, body.top.x[[0, 2, -1]], np.zeros(1), 0.0, straight_down)
    found = CauchyRecovery(body, moved, nothing, np.zeros(len(body.top.x))).nodal
    linear = recovered_stress(body, moved)
    assert np.abs(linear).max() > 0.1 * MU  # the linear stress takes it for a strain
    assert np.abs(found.values).max() < 1e-12 * MU


def some_displacement(body, size):
    x, z = body.nodes.T
    return size * np.column_stack([np.sin(2 * x + z), np.cos(x - 2 * z) - z * x])


def test_tangent_is_the_forces_derivative_and_symmetric(body, response):
    at = some_displacement(body, 0.05)
    _, tangent = response.linearised(at)
    assert abs(tangent - tangent.T).max() < 1e-13 * abs(tangent).max()
    step = some_displacement(body, 1.0)[::-1]
    h = 1e-5
    ahead, behind = (response.linearised(at + way * h * step)[0] for way in (1, -1))
    difference = (ahead - behind).ravel() / (2.0 * h)
    np.testing.assert_allclose(
        tangent @ step.ravel(), difference, atol=1e-6 * abs(difference).max()
    )


def energy(body, displacement):
    """W over the body, by a quadrature of its own."""
    at, area = quadrature(body)
    nodes = body.points[body.mesh.triangles]
    f = np.eye(2) + gradients(nodes, displacement[body.elements], at)
    volume = np.linalg.det(f)
    density = 0.5 * MU * ((f**2).sum(axis=(2, 3)) - 2.0) - MU * np.log(volume)
    density += 0.5 * LAME * np.log(volume) ** 2
    return (density * area).sum()


def test_force_is_the_energys_derivative(body, response):
    at, step = some_displacement(body, 0.05), some_displacement(body, 1.0)[::-1]
    force, _ = response.linearised(at)
    h = 1e-4
    difference = (energy(body, at + h * step) - energy(body, at - h * step)) / (2.0 * h)
    # the code's quadrature is of degree 4 where the integrand is no polynomial
    assert (force * step).sum() == pytest.approx(difference, rel=2e-3)


def test_small_strains_are_the_linear_bodys(body, response):
    """The difference vanishes with the square of the displacement."""
    stiffness = body.stiffness()
    free = ~body.held
    left = []
    for size in (1e-2, 1e-3, 1e-4):
        at = np.where(free, some_displacement(body, size), 0.0)
        linear = (stiffness @ at.ravel()).reshape(-1, 2)
        force, _ = response.linearised(at)
        left.append(np.abs(force - linear)[free].max() / np.abs(linear[free]).max() * size)
    orders = np.log10(np.divide(left[:-1], left[1:]))
    assert np.all(np.abs(orders - 2.0) < 0.05), orders


def test_a_material_of_each_triangle(structured_block):
    """A coating is as stiff as it is in the linear body."""
    body = elastic_body(
        structured_block(X, Z), MATERIAL, Support(), coating=Coating(Material(6.0, 0.2), Z[1])
    )
    at = np.where(body.held, 0.0, some_displacement(body, 1e-6))
    force, _ = HyperelasticBody(body).linearised(at)
    linear = (body.stiffness() @ at.ravel()).reshape(-1, 2)
    free = ~body.held
    assert np.abs(force - linear)[free].max() < 1e-5 * np.abs(linear[free]).max()


def test_inverted_elements_are_refused(body, response):
    with pytest.raises(FemError, match="inverted"):
        response.linearised(deformed_by(body, [[-1.5, 0.0], [0.0, 0.0]]))


def test_slopes_along_quadratic_edges():
    x = np.array([0.0, 0.5, 1.0, 1.2, 1.4, 2.0, 2.6])
    value = np.column_stack([x**2, 3 * x])
    np.testing.assert_allclose(
        along_surface(x, value), np.column_stack([2 * x, np.full_like(x, 3.0)]), atol=1e-12
    )
