"""Elastic contact on a dense compliance, and bodies of which nothing else is left."""

import numpy as np
import pytest

from analytic.material import Material
from analytic.material.hardening import Hardening
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import solve_nonlinear_contact, state_at_rest
from fem.contact.terms import LinearContact, LinearResponse
from fem.nonlinear import condensed
from fem.nonlinear.condensed import ElasticContact, ShiftInvariant
from fem.nonlinear.newton import newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody
from fem.solver.mumps import FemError

HATS = np.linspace(-1.0, 1.0, 18)
X = HATS[1:-1]
WEIGHTS = np.full(len(X), HATS[1] - HATS[0])
GAP = WEIGHTS * 0.02 * X**2


@pytest.fixture(scope="module")
def compliance(structured_block):
    mesh = structured_block(np.linspace(-2.0, 2.0, 21), np.linspace(0.0, 2.0, 9))
    return FiniteElementCompliance(elastic_body(mesh, Material(200.0, 0.3), Support()), HATS)


def solve(bodies, flexible=None):
    rest = state_at_rest(bodies, np.ones(len(X)))
    return solve_nonlinear_contact(bodies, GAP, WEIGHTS, rest, 1.0, flexible=flexible).state


@pytest.mark.parametrize("start", [np.ones(len(X)), 1.0 * (np.abs(X) < 0.1), np.zeros(len(X))])
def test_contact_is_the_one_of_the_compliance_from_any_start(compliance, dense, start):
    flexible = compliance.matrix()
    pressure, approach = ElasticContact(flexible, WEIGHTS)(GAP, 1.0, start)
    expected, at = dense(flexible, GAP, WEIGHTS, 1.0)
    np.testing.assert_allclose(pressure, expected, atol=1e-10 * expected.max())
    assert approach == pytest.approx(at, rel=1e-10)
    assert 0 < np.count_nonzero(pressure) < len(X)


def test_shifted_columns_are_those_of_any_compliance_that_does_not_depend_on_the_place():
    count, far = 40, np.arange(-39.0, 40.0)
    place = np.arange(count)
    exact = (np.exp(-(far**2) / 50.0) + 0.1 * np.arctan(far))[place[:, None] - place + count - 1]
    shifted = ShiftInvariant(lambda hats: exact[:, hats], count, place[10:30])
    pressure = np.random.default_rng(1).uniform(size=count)
    np.testing.assert_allclose(shifted @ pressure, exact @ pressure, rtol=1e-12)
    block = np.ix_(place[3:9], place[20:])
    np.testing.assert_allclose(shifted[block], exact[block], rtol=1e-12)


def test_a_contact_that_does_not_settle_is_an_error(compliance, monkeypatch):
    monkeypatch.setattr(condensed, "MOST_EXCHANGES", 1)
    with pytest.raises(FemError, match="did not settle in 1 exchanges"):
        ElasticContact(compliance.matrix(), WEIGHTS)(GAP, 1.0, np.ones(len(X)))


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_a_compliance_closes_the_gap_as_the_whole_body_does(compliance, friction):
    body = LinearResponse(compliance.body), LinearContact(compliance, friction)
    roller = LinearResponse(compliance.body), LinearContact(compliance, -friction)
    whole = solve([body, roller])
    solution = solve([body], compliance.matrix(-friction))
    np.testing.assert_allclose(solution.pressure, whole.pressure, atol=1e-9 * whole.pressure.max())
    assert solution.approach == pytest.approx(whole.approach, rel=1e-9)
    assert 0 < np.count_nonzero(solution.pressure) < len(X)


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_hats_between_nodes_of_a_coarse_roller_do_no_harm(compliance, structured_block, friction):
    """Its compliance is singular, and the contact as exact as elsewhere; with its inverse the
    residual did not fall below 1e-9."""
    mesh = structured_block(np.linspace(-2.0, 2.0, 7), np.linspace(0.0, 2.0, 4))
    coarse = FiniteElementCompliance(elastic_body(mesh, Material(200.0, 0.3), Support()), HATS)
    flexible = coarse.matrix(-friction)
    assert np.linalg.matrix_rank(flexible) < len(flexible)
    body = PlasticBody(compliance.body, ElasticPlastic(Material(200.0, 0.3), Hardening(1.0)))
    bodies = [(body, LinearContact(compliance, friction))]
    rest = state_at_rest(bodies, np.ones(len(X)))
    problem = bodies, GAP, WEIGHTS, rest, 1.5
    end, history = newton_by_contacts(*problem, flexible=flexible)
    assert body.step(end.displacements[0]).yields.any()
    assert len(history) <= 6 and history[-1] <= 1e-9
    moved = compliance.weighted(end.displacements[0])
    gap = (GAP + moved + flexible @ end.pressure) / WEIGHTS - end.approach
    on = end.pressure > 0.0
    assert np.abs(gap[on]).max() < 1e-9 * end.approach and gap[~on].min() > 0.0
