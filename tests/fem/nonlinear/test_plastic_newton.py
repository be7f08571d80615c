"""Newton's method by whole linear contacts: its order, and one answer from any start."""

from itertools import pairwise

import numpy as np
import pytest

from analytic.material import Material
from analytic.material.hardening import Hardening
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import state_at_rest
from fem.contact.terms import LinearContact
from fem.nonlinear.newton import newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody

PITCH = 1.0 / 6.0
HATS = PITCH * np.arange(-11, 12)
X = HATS[1:-1]
WEIGHTS = np.full(len(X), PITCH)
STEEL = Material(200.0, 0.3)
# elastic half-width 1 and peak pressure 2.4 Y under the load 1.2 pi
GAP = PITCH * X**2 * 2.4 / STEEL.plane_strain_modulus
LOAD = 1.2 * np.pi


@pytest.fixture(scope="module")
def pressed(small_block):
    return FiniteElementCompliance(elastic_body(small_block, STEEL, Support()), HATS)


def problem(pressed, hardening):
    body = PlasticBody(pressed.body, ElasticPlastic(STEEL, Hardening(1.0, hardening)))
    contact = LinearContact(pressed)
    return body, [(body, contact)]


@pytest.mark.parametrize("hardening", [0.0, 10.0])
def test_convergence_is_quadratic(pressed, hardening):
    """Each residual is 0.1 to 2.6 times the square of the one before, once the points that flow are
    settled: which do on the way there hangs on rounding."""
    body, bodies = problem(pressed, hardening)
    state, seen = state_at_rest(bodies, 1.0 * (np.abs(X) < 0.7)), []
    for part in (0.5, 0.7, 0.9):
        state, history = newton_by_contacts(bodies, GAP, WEIGHTS, state, part * LOAD)
        body.accept(state.displacements[0])
        pairs = pairwise(history)
        seen += [after / before**2 for before, after in pairs if before < 1e-3 and after > 1e-12]
    assert len(seen) >= 2
    assert min(seen) > 0.05
    assert max(seen) < 5.0


def test_one_answer_from_any_start(pressed):
    """Far beyond first yield in one step, from hats that are all pressed and from a single one."""
    states = []
    for guess in (np.ones(len(X)), 1.0 * (np.abs(X) < 0.5 * PITCH)):
        body, bodies = problem(pressed, 0.0)
        start = state_at_rest(bodies, guess)
        state, _ = newton_by_contacts(bodies, GAP, WEIGHTS, start, LOAD)
        assert np.mean(body.step(state.displacements[0]).yields) > 0.1
        assert not body.state.equivalent.any()
        states.append(state)
    np.testing.assert_allclose(states[0].pressure, states[1].pressure, atol=1e-6)
    assert states[0].approach == pytest.approx(states[1].approach, rel=1e-8)


def test_load_and_approach_lead_to_the_same(pressed):
    _, bodies = problem(pressed, 0.0)
    rest = state_at_rest(bodies, 1.0 * (np.abs(X) < 1.0))
    by_load, _ = newton_by_contacts(bodies, GAP, WEIGHTS, rest, load=LOAD)
    by_approach, _ = newton_by_contacts(bodies, GAP, WEIGHTS, rest, approach=by_load.approach)
    np.testing.assert_allclose(by_approach.pressure, by_load.pressure, atol=1e-7)
    assert by_approach.load == pytest.approx(LOAD, rel=1e-8)


def test_what_rounding_leaves_is_the_end(pressed):
    _, bodies = problem(pressed, 0.0)
    rest = state_at_rest(bodies, 1.0 * (np.abs(X) < 1.0))
    exact, history = newton_by_contacts(bodies, GAP, WEIGHTS, rest, LOAD, residual=0.0)
    near, _ = newton_by_contacts(bodies, GAP, WEIGHTS, rest, LOAD)
    assert history[-1] < 1e-9
    np.testing.assert_allclose(exact.pressure, near.pressure, atol=1e-7)
