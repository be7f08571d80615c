"""Laws of elasticity: stress from an energy of principal stretches, closed forms, limits."""

import numpy as np
import pytest

from analytic.material import LAWS, Law, Material
from fem.body.elasticity import Support, elastic_body
from fem.nonlinear.hyperelastic import HyperelasticBody
from fem.nonlinear.laws import SERIES_TO, cauchy_stress
from fem.solver.mumps import FemError

MATERIAL = Material(2.0, 0.3)
MU = MATERIAL.shear_modulus
LAME = 2.0 * MU * 0.3 / 0.4
L, M, N = -3.0, -7.0, -8.0
EVERY = [Law(name, (L, M, N) if name == "murnaghan" else None) for name in LAWS]
every_law = pytest.mark.parametrize("law", EVERY, ids=LAWS)
GRADIENTS = ([[0.1, -0.2], [0.15, -0.1]], [[0.0, 0.08], [0.0, 0.0]], [[-0.05, 0.0], [0.0, -0.05]])


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
    found, h = np.empty((2, 2)), 1e-6
    for i, j in np.ndindex(2, 2):
        step = np.zeros((2, 2))
        step[i, j] = h
        found[i, j] = (energy(law, gradient + step) - energy(law, gradient - step)) / (2 * h)
    return found


@every_law
@pytest.mark.parametrize("gradient", GRADIENTS)
def test_stress_is_the_energys_derivative(law, gradient):
    f = np.eye(2) + gradient
    volume = np.linalg.det(f)
    sigma = first_piola(law, np.array(gradient)) @ f.T / volume
    h = 1e-6  # the stretch across the plane is one
    across = (energy(law, gradient, 1 + h) - energy(law, gradient, 1 - h)) / (2 * h) / volume
    wanted = [sigma[0, 0], sigma[1, 1], sigma[0, 1], across]
    found = cauchy_stress(np.array(gradient), MU, LAME, law)
    np.testing.assert_allclose(found, wanted, atol=1e-8 * MU)


@every_law
@pytest.mark.parametrize("gradient", GRADIENTS)
def test_the_bodys_forces_are_those_of_the_stress(structured_block, law, gradient):
    """Virtual work of any linear displacement on a block of straight elements: P times its area."""
    mesh = structured_block(np.linspace(-1.0, 1.0, 5), np.linspace(0.0, 1.0, 4), seed=3)
    body = elastic_body(mesh, Material(2.0, 0.3, law), Support())
    f = np.eye(2) + gradient
    force, tangent = HyperelasticBody(body).linearised(body.nodes @ np.array(gradient).T)
    piola = first_piola(law, np.array(gradient))
    np.testing.assert_allclose(force.T @ body.nodes, 2.0 * piola, atol=1e-7 * MU)
    assert abs(tangent - tangent.T).max() < 1e-13 * abs(tangent).max()
    sx, sz, txz, _ = cauchy_stress(np.array(gradient), MU, LAME, law)
    sigma = np.array([[sx, txz], [txz, sz]])
    own = np.linalg.det(f) * sigma @ np.linalg.inv(f).T
    np.testing.assert_allclose(own, piola, atol=1e-8 * MU)


@every_law
def test_the_tangent_is_the_forces_derivative(structured_block, law):
    """At rest and next to it, where stretches are equal, as well as far from it."""
    mesh = structured_block(np.linspace(-1.0, 1.0, 5), np.linspace(0.0, 1.0, 4), seed=3)
    body = elastic_body(mesh, Material(2.0, 0.3, law), Support())
    response, (x, z), h = HyperelasticBody(body), body.nodes.T, 1e-6
    step = np.column_stack([np.cos(x - 2 * z), np.sin(2 * x + z)])
    for size in (0.0, 1e-7, 1e-2, 0.05):
        at = size * np.column_stack([np.sin(2 * x + z), np.cos(x - 2 * z) - z * x])
        _, tangent = response.linearised(at)
        ahead, behind = (response.linearised(at + way * h * step)[0] for way in (1, -1))
        wanted = (ahead - behind).ravel() / (2 * h)
        np.testing.assert_allclose(tangent @ step.ravel(), wanted, atol=1e-7 * np.abs(wanted).max())


@every_law
def test_small_strains_are_hookes(law):
    gradient = 1e-7 * np.array([[1.0, -2.0], [0.5, -0.7]])
    strain = 0.5 * (gradient + gradient.T)
    hooke = 2 * MU * strain + LAME * np.trace(strain) * np.eye(2)
    wanted = [hooke[0, 0], hooke[1, 1], hooke[0, 1], LAME * np.trace(strain)]
    found = cauchy_stress(gradient, MU, LAME, law)
    np.testing.assert_allclose(found, wanted, rtol=2e-6)


@every_law
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


@every_law
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
        found = cauchy_stress(np.diag(np.expm1([d, -d])), MU, LAME, Law("hencky"))
        np.testing.assert_allclose(found[:2], [2 * MU * d, -2 * MU * d], rtol=1e-12)


@every_law
def test_inverted_elements_are_refused(structured_block, law):
    mesh = structured_block(np.linspace(-1.0, 1.0, 5), np.linspace(0.0, 1.0, 4))
    body = elastic_body(mesh, Material(2.0, 0.3, law), Support())
    with pytest.raises(FemError, match="inverted"):
        HyperelasticBody(body).linearised(body.nodes @ np.diag([-1.5, 0.0]))


def test_constants_belong_to_murnaghan():
    with pytest.raises(ValueError, match="Murnaghan"):
        Law("hencky", (1.0, 1.0, 1.0))
    with pytest.raises(ValueError, match="Murnaghan"):
        Law("murnaghan")
    with pytest.raises(ValueError, match="one of"):
        Law("hooke")
