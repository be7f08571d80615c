"""The metal at finite strains: Hencky's law until it flows, its tangent, rotations, volume."""

from dataclasses import replace

import numpy as np
import pytest
from blocks import moved, structured_block
from scipy.linalg import logm

from analytic.material import Law, Material
from analytic.material.hardening import Hardening
from fem.body.elasticity import Support, elastic_body
from fem.nonlinear import hyperelastic
from fem.nonlinear.finite_plasticity import FinitePlasticBody
from fem.nonlinear.hyperelastic import HyperelasticBody
from fem.nonlinear.laws import cauchy_stress
from fem.nonlinear.log_strain import LogStrain
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody
from fem.solver.mumps import FemError

HENCKY = Material(200.0, 0.3, Law("hencky"))
RANDOM = np.random.default_rng(11)
# from far beyond the series' end to within it and to no strain at all
SIZES = np.array([0.4, 0.2, 0.11, 0.09, 0.02, 1e-4, 1e-9, 0.0])
GRADIENTS = SIZES[:, None, None] * RANDOM.uniform(-1.0, 1.0, (8, 2, 2))


def test_strain_is_half_the_logarithm_of_c():
    strains = LogStrain(GRADIENTS).strain
    for gradient, (xx, zz, shear) in zip(GRADIENTS, strains, strict=True):
        f = np.eye(2) + gradient
        np.testing.assert_allclose(
            [[xx, shear / 2], [shear / 2, zz]], 0.5 * logm(f.T @ f), atol=2e-16, rtol=1e-13
        )


def test_stress_and_tangent_are_derivatives_of_the_strain():
    """T : E at a fixed T as an energy of Green's strain: its gradient, and that one's."""
    conjugate = RANDOM.normal(size=(8, 3))
    matrix = RANDOM.normal(size=(3, 3))
    matrix = matrix + matrix.T
    base = 0.5 * (GRADIENTS + GRADIENTS.transpose(0, 2, 1))  # a gradient for Green's strain

    def at(green):
        """Of the stretch U = sqrt(I + 2 E), E (8, 3) Green's."""
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


def made(height=None):
    mesh = structured_block(np.linspace(-1.0, 1.0, 7), np.linspace(0.0, 1.0, 5), height, seed=2)
    return elastic_body(mesh, HENCKY, Support("bonded", "free"))


@pytest.mark.parametrize("height", [None, lambda x: 0.05 * np.cos(3.0 * x)])
def test_below_yield_it_is_henckys_law(monkeypatch, height):
    """Forces, tangents and stresses of dolfinx's energy at the same three points, to rounding; its
    tangent differs by the terms that the series of its energy leaves out."""
    monkeypatch.setattr(hyperelastic, "quadrature_degree", lambda *_: 2)
    body = made(height)
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
    scale = np.abs(plastic.force(at)).max()
    np.testing.assert_allclose(
        plastic.force(turned), plastic.force(at) @ turn.T, atol=1e-12 * scale
    )
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
