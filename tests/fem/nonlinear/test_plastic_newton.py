"""Newton's method by whole linear contacts: its order, and one answer from any start."""

from itertools import pairwise

import numpy as np
import pytest
from pressed_bodies import STEEL, MetalScene

from analytic.material.hardening import Hardening
from fem.body.elasticity import Support
from fem.contact.nonlinear import state_at_rest
from fem.contact.terms import LinearContact
from fem.nonlinear.newton import newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody

LOAD = 1.2 * np.pi  # of elastic half-width 1 and peak pressure 2.4 Y


@pytest.fixture(scope="module")
def scene(small_block):
    return MetalScene(small_block, 2.4, 6, support=Support())


def problem(scene, hardening, inside):
    """The body that flows; bodies, gap, weights and a start from the hats `inside` of |x|."""
    body = PlasticBody(scene.pressed.body, ElasticPlastic(STEEL, Hardening(1.0, hardening)))
    bodies = [(body, LinearContact(scene.pressed))]
    start = state_at_rest(bodies, 1.0 * (np.abs(scene.x) < inside))
    return body, (bodies, scene.gap, scene.weights), start


@pytest.mark.parametrize("hardening", [0.0, 10.0])
def test_convergence_is_quadratic(scene, hardening):
    """Each residual is 0.1 to 2.6 times the square of the one before, once the points that flow are
    settled: which do on the way there hangs on rounding."""
    (body, contact, state), seen = problem(scene, hardening, 0.7), []
    for part in (0.5, 0.7, 0.9):
        state, history = newton_by_contacts(*contact, state, part * LOAD)
        body.accept(state.displacements[0])
        pairs = pairwise(history)
        seen += [after / before**2 for before, after in pairs if before < 1e-3 and after > 1e-12]
    assert len(seen) >= 2
    assert min(seen) > 0.05
    assert max(seen) < 5.0


def test_one_answer_from_any_start(scene):
    """Far beyond first yield in one step, from hats that are all pressed and from a single one."""
    states = []
    for inside in (np.inf, 1.0 / 12.0):
        body, contact, start = problem(scene, 0.0, inside)
        state, _ = newton_by_contacts(*contact, start, LOAD)
        assert np.mean(body.step(state.displacements[0]).yields) > 0.1
        assert not body.state.equivalent.any()
        states.append(state)
    np.testing.assert_allclose(states[0].pressure, states[1].pressure, atol=1e-6)
    assert states[0].approach == pytest.approx(states[1].approach, rel=1e-8)


def test_load_and_approach_lead_to_the_same(scene):
    _, contact, rest = problem(scene, 0.0, 1.0)
    by_load, _ = newton_by_contacts(*contact, rest, load=LOAD)
    by_approach, _ = newton_by_contacts(*contact, rest, approach=by_load.approach)
    np.testing.assert_allclose(by_approach.pressure, by_load.pressure, atol=1e-7)
    assert by_approach.load == pytest.approx(LOAD, rel=1e-8)


def test_what_rounding_leaves_is_the_end(scene):
    _, contact, rest = problem(scene, 0.0, 1.0)
    exact, history = newton_by_contacts(*contact, rest, LOAD, residual=0.0)
    near, _ = newton_by_contacts(*contact, rest, LOAD)
    assert history[-1] < 1e-9
    np.testing.assert_allclose(exact.pressure, near.pressure, atol=1e-7)
