"""Laws of elasticity: stress from an energy of principal stretches, closed forms, limits; bodies of
quadratic elements, neo-Hookean ones on curved elements."""

import numpy as np
import pytest
from blocks import structured_block
from pressed_bodies import neo_hookean_energy

from analytic.material import LAWS, Law, Material
from fem.body.elasticity import Support, elastic_body
from fem.body.surface import straight_down
from fem.body.triangle import collapsed_gauss, jacobians
from fem.nonlinear.hyperelastic import CauchyRecovery, HyperelasticBody
from fem.nonlinear.laws import SERIES_TO, cauchy_stress
from fem.solver.mumps import FemError
from fem.stress.recovery import recovered_stress
from fem.stress.surface_load import SurfaceLoad

MATERIAL = Material(2.0, 0.3)
MU = MATERIAL.shear_modulus
LAME = 2.0 * MU * 0.3 / 0.4
L, M, N = -3.0, -7.0, -8.0
NEO_HOOKEAN, *_ = EVERY = [Law(name, (L, M, N) if name == "murnaghan" else None) for name in LAWS]
GRADIENTS = ([[0.1, -0.2], [0.15, -0.1]], [[0.0, 0.08], [0.0, 0.0]], [[-0.05, 0.0], [0.0, -0.05]])
X, Z = np.linspace(-1.0, 1.0, 5), np.linspace(0.0, 1.0, 4)


@pytest.fixture(scope="module", params=EVERY, ids=LAWS)
def law(request):
    return request.param


@pytest.fixture(scope="module")
def straight(law):
    """A body of straight elements without symmetry that follows a law."""
    return elastic_body(structured_block(X, Z, seed=3), Material(2.0, 0.3, law), Support())


def density(law, stretches):
    """W of three principal stretches."""
    stretches = np.asarray(stretches)
    volume = stretches.prod()
    if law.name == "neo-hookean":
        log = np.log(volume)
        return 0.5 * MU * ((stretches**2).sum() - 3.0) - MU * log + 0.5 * LAME * log**2
    if law.name == "hencky":
        log = np.log(stretches)
        return MU * (log**2).sum() + 0.5 * LAME * log.sum() ** 2
    green = 0.5 * (stretches**2 - 1.0)
    if law.name == "st-venant-kirchhoff":
        return MU * (green**2).sum() + 0.5 * LAME * green.sum() ** 2
    a, b, c = green
    first, second, third = a + b + c, a * b + b * c + c * a, a * b * c
    whole = (0.5 * LAME + MU) * first**2 - 2.0 * MU * second + (L + 2 * M) / 3 * first**3
    return whole - 2.0 * M * first * second + N * third


def energy(law, gradient, across=1.0):
    return density(law, [*np.linalg.svd(np.eye(2) + gradient, compute_uv=False), across])


def first_piola(law, gradient):
    """dW/dF by differences."""
    stress, h = np.empty((2, 2)), 1e-6
    for i, j in np.ndindex(2, 2):
        step = np.zeros((2, 2))
        step[i, j] = h
        stress[i, j] = (energy(law, gradient + step) - energy(law, gradient - step)) / (2 * h)
    return stress


@pytest.mark.parametrize("gradient", GRADIENTS)
def test_stress_is_the_energys_derivative(law, gradient):
    f = np.eye(2) + gradient
    volume = np.linalg.det(f)
    sigma = first_piola(law, np.array(gradient)) @ f.T / volume
    h = 1e-6  # the stretch across the plane is one
    across = (energy(law, gradient, 1 + h) - energy(law, gradient, 1 - h)) / (2 * h) / volume
    wanted = [sigma[0, 0], sigma[1, 1], sigma[0, 1], across]
    stress = cauchy_stress(np.array(gradient), MU, LAME, law)
    np.testing.assert_allclose(stress, wanted, atol=1e-8 * MU)


@pytest.mark.parametrize("gradient", GRADIENTS)
def test_the_bodys_forces_are_those_of_the_stress(straight, law, gradient):
    """Virtual work of any linear displacement on a block of straight elements: P times its area."""
    moved = straight.nodes @ np.array(gradient).T
    force, tangent = HyperelasticBody(straight).linearised(moved)
    piola = first_piola(law, np.array(gradient))
    np.testing.assert_allclose(force.T @ straight.nodes, 2.0 * piola, atol=1e-7 * MU)
    assert abs(tangent - tangent.T).max() < 1e-13 * abs(tangent).max()


def some_displacement(body, size):
    x, z = body.nodes.T
    return size * np.column_stack([np.sin(2 * x + z), np.cos(x - 2 * z) - z * x])


def test_the_tangent_is_the_forces_derivative(straight):
    """At rest and next to it, where stretches are equal, as well as far from it."""
    response, (x, z), h = HyperelasticBody(straight), straight.nodes.T, 1e-6
    step = np.column_stack([np.cos(x - 2 * z), np.sin(2 * x + z)])
    for size in (0.0, 1e-7, 1e-2, 0.05):
        at = some_displacement(straight, size)
        _, tangent = response.linearised(at)
        ahead, behind = (response.linearised(at + way * h * step)[0] for way in (1, -1))
        wanted = (ahead - behind).ravel() / (2 * h)
        np.testing.assert_allclose(tangent @ step.ravel(), wanted, atol=1e-7 * np.abs(wanted).max())


def test_small_strains_are_hookes(law):
    gradient = 1e-7 * np.array([[1.0, -2.0], [0.5, -0.7]])
    strain = 0.5 * (gradient + gradient.T)
    hooke = 2 * MU * strain + LAME * np.trace(strain) * np.eye(2)
    wanted = [hooke[0, 0], hooke[1, 1], hooke[0, 1], LAME * np.trace(strain)]
    stress = cauchy_stress(gradient, MU, LAME, law)
    np.testing.assert_allclose(stress, wanted, rtol=2e-6)


def test_rotations_turn_the_stress(law):
    gradient = np.array(GRADIENTS[0])
    c, s = np.cos(0.8), np.sin(0.8)
    turn = np.array([[c, s], [-s, c]])

    def tensor(of):
        sx, sz, txz, across = cauchy_stress(of, MU, LAME, law)
        return np.array([[sx, txz], [txz, sz]]), across

    before, across = tensor(gradient)
    after, same = tensor(turn @ (np.eye(2) + gradient) - np.eye(2))
    np.testing.assert_allclose(after, turn @ before @ turn.T, atol=1e-13 * MU)
    assert same == pytest.approx(across, rel=1e-12)


@pytest.mark.parametrize("stretch", [0.8, 0.97, 1.1])
def test_a_column_held_at_its_sides(law, stretch):
    """Closed forms of the stress along the only stretch."""
    plane, log, green = LAME + 2 * MU, np.log(stretch), 0.5 * (stretch**2 - 1.0)
    wanted = {
        "neo-hookean": (MU * (stretch**2 - 1.0) + LAME * log) / stretch,
        "hencky": plane * log / stretch,
        "st-venant-kirchhoff": plane * green * stretch,
        "murnaghan": (plane * green + (L + 2 * M) * green**2) * stretch,
    }[law.name]
    _, sz, txz, _ = cauchy_stress(np.diag([0.0, stretch - 1.0]), MU, LAME, law)
    assert sz == pytest.approx(wanted, rel=1e-12)
    assert txz == 0.0


def test_henckys_series_meets_the_closed_form():
    """Both sides of SERIES_TO: y = tanh(2 d)^2 of a pure shear by stretches exp(d), exp(-d)."""
    limit = np.arctanh(np.sqrt(SERIES_TO)) / 2
    for d in limit * np.array([1 - 1e-9, 1 + 1e-9]):
        stress = cauchy_stress(np.diag(np.expm1([d, -d])), MU, LAME, Law("hencky"))
        np.testing.assert_allclose(stress[:2], [2 * MU * d, -2 * MU * d], rtol=1e-12)


def test_inverted_elements_are_refused(straight):
    with pytest.raises(FemError, match="inverted"):
        HyperelasticBody(straight).linearised(straight.nodes @ np.diag([-1.5, 0.0]))


@pytest.mark.parametrize("fields", [("hencky", (1.0, 1.0, 1.0)), ("murnaghan",), ("hooke",)])
def test_laws_without_sense_are_refused(fields):
    with pytest.raises(ValueError):
        Law(*fields)


def bent(x):
    return 0.1 * np.cos(2.0 * x)


@pytest.fixture(scope="module")
def body():
    """Curved elements without symmetry."""
    return elastic_body(structured_block(X, Z, bent, seed=3), MATERIAL, Support())


@pytest.fixture(scope="module")
def response(body):
    return HyperelasticBody(body)


HOMOGENEOUS = {
    "shear": [[0.0, 0.7], [0.0, 0.0]],
    "stretch": [[0.4, 0.0], [0.0, -0.3]],
    "all": [[0.3, -0.2], [0.5, -0.1]],
}


@pytest.mark.parametrize("gradient", HOMOGENEOUS.values(), ids=HOMOGENEOUS)
def test_homogeneous_deformations_of_curved_elements(body, response, gradient):
    """Forces on the boundary are those of P, none inside; by quadrature."""
    gradient = np.array(gradient)
    force, _ = response.linearised(body.nodes @ gradient.T)
    boundary = np.unique(np.concatenate(list(vars(body.sides).values())))
    inside = np.setdiff1d(np.arange(len(body.nodes)), boundary)
    assert np.abs(force[inside]).max() < 1e-2 * np.abs(force).max()
    # virtual work of any linear displacement: P times the area
    at, share = collapsed_gauss(6)
    area = (np.linalg.det(jacobians(body.points[body.mesh.triangles], at)) * share).sum()
    piola = first_piola(NEO_HOOKEAN, gradient) * area
    np.testing.assert_allclose(force.T @ body.nodes, piola, rtol=2e-3, atol=2e-3 * MU)


def test_rigid_motions_give_no_stress(body, response):
    c, s = np.cos(1.1), np.sin(1.1)
    moved = body.nodes @ np.array([[c - 1.0, -s], [s, c - 1.0]]) + [0.3, -0.2]
    force, _ = response.linearised(moved)
    assert np.abs(force).max() < 1e-13 * MU
    nothing = SurfaceLoad(body, body.top.x[[0, 2, -1]], np.zeros(1), 0.0, straight_down)
    none = np.zeros(len(body.top.x))
    nodal = CauchyRecovery(body, moved, nothing, none).nodal
    linear = recovered_stress(body, moved)
    assert np.abs(linear).max() > 0.1 * MU  # the linear stress takes it for a strain
    assert np.abs(nodal.values).max() < 1e-12 * MU


def test_force_is_the_energys_derivative(body, response):
    at, step = some_displacement(body, 0.05), some_displacement(body, 1.0)[::-1]
    force, _ = response.linearised(at)
    h = 1e-4
    ahead, behind = (neo_hookean_energy(body, at + way * h * step, 6) for way in (1, -1))
    difference = (ahead - behind) / (2.0 * h)
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
