"""Laws of elasticity: stress from an energy of principal stretches, closed forms, limits; bodies
of quadratic elements, neo-Hookean ones on curved elements. The metal at finite strains: Hencky's
law until it flows, its tangent, rotations, volume."""

from dataclasses import replace

import numpy as np
import pytest
from blocks import moved, structured_block
from pressed_bodies import neo_hookean_energy
from scipy.linalg import logm

from analytic.material import LAWS, Law, Material
from analytic.material.hardening import Hardening
from fem.body.coating import Coating
from fem.body.elasticity import Support, elastic_body
from fem.body.surface import straight_down
from fem.body.triangle import collapsed_gauss, jacobians
from fem.nonlinear import hyperelastic
from fem.nonlinear.finite_plasticity import FinitePlasticBody
from fem.nonlinear.hyperelastic import CauchyRecovery, HyperelasticBody
from fem.nonlinear.laws import SERIES_TO, cauchy_stress
from fem.nonlinear.log_strain import LogStrain
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody
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


@pytest.fixture(scope="module")
def body():
    """Curved elements without symmetry."""
    mesh = structured_block(X, Z, lambda x: 0.1 * np.cos(2.0 * x), seed=3)
    return elastic_body(mesh, MATERIAL, Support())


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


HENCKY = Material(200.0, 0.3, Law("hencky"))
RANDOM = np.random.default_rng(11)
# from far beyond the series' end to within it and to no strain at all
SIZES = np.array([0.4, 0.2, 0.11, 0.09, 0.02, 1e-4, 1e-9, 0.0])
FLOWING = SIZES[:, None, None] * RANDOM.uniform(-1.0, 1.0, (8, 2, 2))


def test_strain_is_half_the_logarithm_of_c():
    strains = LogStrain(FLOWING).strain
    for gradient, (xx, zz, shear) in zip(FLOWING, strains, strict=True):
        f = np.eye(2) + gradient
        strain, exact = [[xx, shear / 2], [shear / 2, zz]], 0.5 * logm(f.T @ f)
        np.testing.assert_allclose(strain, exact, atol=2e-16, rtol=1e-13)


def test_stress_and_tangent_are_derivatives_of_the_strain():
    """T : E at a fixed T as an energy of Green's strain: its gradient, and that one's."""
    conjugate = RANDOM.normal(size=(8, 3))
    matrix = RANDOM.normal(size=(3, 3))
    matrix = matrix + matrix.T
    base = 0.5 * (FLOWING + FLOWING.transpose(0, 2, 1))  # a gradient for Green's strain

    def at(green):
        """Strain of the stretch U = sqrt(I + 2 E), E (8, 3) Green's."""
        tensor = np.eye(2) + 2.0 * green[:, [[0, 2], [2, 1]]] * [[1.0, 0.5], [0.5, 1.0]]
        size, axes = np.linalg.eigh(tensor)
        return LogStrain((axes * np.sqrt(size)[:, None]) @ axes.transpose(0, 2, 1) - np.eye(2))

    f = np.eye(2) + base
    c = f.transpose(0, 2, 1) @ f - np.eye(2)
    green = 0.5 * np.column_stack([c[:, 0, 0], c[:, 1, 1], 2.0 * c[:, 0, 1]])
    here, h = at(green), 1e-6
    stress = conjugate + here.strain @ matrix
    piola, tangent = here.piola(stress), here.tangent(stress, matrix)
    for i, way in enumerate(h * np.eye(3)):
        up, down = at(green + way), at(green - way)
        slope = ((up.strain - down.strain) / (2 * h) * stress).sum(axis=1)
        np.testing.assert_allclose(piola[:, i], slope, atol=1e-8)
        stresses = [one.piola(conjugate + one.strain @ matrix) for one in (up, down)]
        difference = (stresses[0] - stresses[1]) / (2 * h)
        np.testing.assert_allclose(tangent[:, :, i], difference, atol=2e-8)
    np.testing.assert_allclose(tangent, tangent.transpose(0, 2, 1), atol=1e-12)


def made(height=None, coating=None):
    seed = None if coating else 2  # which moves vertices off the coating's lower side
    mesh = structured_block(np.linspace(-1.0, 1.0, 7), np.linspace(0.0, 1.0, 5), height, seed)
    return elastic_body(mesh, HENCKY, Support("bonded", "free"), coating=coating)


HARD = Material(500.0, 0.2, Law("hencky"))


@pytest.mark.parametrize(
    ("height", "coating"),
    [(None, None), (lambda x: 0.05 * np.cos(3.0 * x), None), (None, Coating(HARD, 0.25))],
    ids=["flat", "curved", "coated"],
)
def test_below_yield_it_is_henckys_law(monkeypatch, height, coating):
    """Forces, tangents and stresses of dolfinx's energy at the same three points, to rounding; its
    tangent differs by the terms that the series of its energy leaves out."""
    monkeypatch.setattr(hyperelastic, "quadrature_degree", lambda *_: 2)
    body = made(height, coating)
    metal = FinitePlasticBody(body, ElasticPlastic(HENCKY, Hardening(1e4)))
    law, at, free = HyperelasticBody(body), moved(body, 0.06, 1), ~body.held.ravel()
    (force, tangent), (wanted, exact) = metal.linearised(at), law.linearised(at)
    assert np.abs(metal.strain(at)).max() > 0.1
    np.testing.assert_allclose(force.ravel()[free], wanted.ravel()[free], atol=1e-12)
    np.testing.assert_allclose(metal.force(at), force, rtol=0.0)
    off = abs(tangent[free][:, free] - exact[free][:, free])
    assert off.max() < 2e-12 * abs(exact).max()
    inside, across = metal.stress(at, metal.state)
    lame, shear = HENCKY.lame_constants
    if coating:
        pairs = zip(HARD.lame_constants, HENCKY.lame_constants, strict=True)
        lame, shear = (np.repeat(np.where(body.coated, *pair), 3) for pair in pairs)
    stress = cauchy_stress(metal.gradient(at), shear, lame, HENCKY.law)
    np.testing.assert_allclose(np.column_stack([inside, across]), stress, atol=1e-11)


VOCE = Hardening(0.5, voce=(0.9, 30.0))


def flowing(hardening=VOCE):
    body = made()
    plastic = FinitePlasticBody(body, ElasticPlastic(HENCKY, hardening))
    plastic.accept(moved(body, 0.03, 1))
    assert 0.02 < plastic.state.equivalent.max() < 0.5
    return plastic


@pytest.mark.parametrize("kinematic", [0.0, 8.0])
def test_tangent_is_the_derivative_of_the_force(kinematic):
    plastic = flowing(replace(VOCE, kinematic=kinematic))
    at, way, h = moved(plastic.body, 0.05, 4), moved(plastic.body, 0.01, 5), 1e-5
    _, tangent = plastic.linearised(at)
    assert plastic.step(at).yields.all()
    slope = (plastic.force(at + h * way) - plastic.force(at - h * way)).ravel() / (2.0 * h)
    np.testing.assert_allclose(tangent @ way.ravel(), slope, atol=1e-6 * np.abs(slope).max())
    assert abs(tangent - tangent.T).max() < 1e-12 * abs(tangent).max()


def test_it_is_objective_and_keeps_the_volume():
    """A turned body has turned forces; what flows far changes its volume by its pressure alone."""
    plastic = flowing()
    at = moved(plastic.body, 0.06, 4)
    angle = 0.7
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    place = plastic.body.nodes
    turned = (place + at) @ turn.T - place
    force_at = plastic.force(at)
    scale = np.abs(force_at).max()
    np.testing.assert_allclose(plastic.force(turned), force_at @ turn.T, atol=1e-12 * scale)
    state = plastic.step(at).state
    inside, across = plastic.stress(at, state)
    volume = LogStrain(plastic.gradient(at)).volume
    mean = (inside[:, 0] + inside[:, 1] + across) / 3.0 * volume
    force, _ = plastic.linearised(at)
    plastic.accept(at)  # what the step ends with bears the same
    np.testing.assert_allclose(plastic.force(at), force, atol=1e-12 * scale)
    np.testing.assert_allclose(mean, HENCKY.bulk_modulus * np.log(volume), atol=1e-11)


def test_shear_bears_the_yield_stress_however_far_it_goes():
    """Simple shear g of a nearly rigid metal without hardening: Y / sqrt 3, over a plastic strain
    of g / sqrt 3, in turned axes as well."""
    body, turn = made(), np.array([[0.6, -0.8], [0.8, 0.6]])
    plastic = FinitePlasticBody(body, ElasticPlastic(HENCKY, Hardening(0.02)))
    for sheared in np.linspace(0.0, 3.0, 151)[1:]:
        gradient = turn @ [[0.0, sheared], [0.0, 0.0]] @ turn.T
        plastic.accept(body.nodes @ gradient.T)
    inside, _ = plastic.stress(body.nodes @ gradient.T, plastic.state)
    shear = turn[:, 0] @ inside[:, [[0, 2], [2, 1]]] @ turn[:, 1]
    np.testing.assert_allclose(shear, 0.02 / np.sqrt(3.0), rtol=2e-4)
    np.testing.assert_allclose(plastic.state.equivalent, np.sqrt(3.0), rtol=1e-3)


def test_small_strains_are_the_small_strain_body():
    """The difference falls with the square of the strains, of which rotations are a part."""
    body, left = made(), []
    for size in (4e-4, 2e-4, 1e-4):
        metal = ElasticPlastic(HENCKY, Hardening(100.0 * size, 20.0))
        at = moved(body, size, 1)
        small, finite = (kind(body, metal) for kind in (PlasticBody, FinitePlasticBody))
        assert 0.2 < small.step(at).yields.mean() < 1.0
        left.append(np.abs(small.force(at) - finite.force(at))[~body.held].max())
    orders = np.log2(np.divide(left[:-1], left[1:]))
    assert np.all(np.abs(orders - 2.0) < 0.1), orders


def test_inverted_elements_are_an_error():
    plastic = flowing()
    with pytest.raises(FemError, match="inverted"):
        plastic.force([-1.5, 0.0] * plastic.body.nodes)
