"""Elastic contact on a compliance, and bodies of which nothing else is left."""

import numpy as np
import pytest
from blocks import structured_block
from pressed_bodies import dense_contact

from analytic.material import Material
from analytic.material.hardening import Hardening
from fem.body.elasticity import Support, elastic_body
from fem.compliance.condensed import ShiftInvariant
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import state_at_rest
from fem.contact.terms import LinearContact, LinearResponse
from fem.nonlinear import elastic_contact
from fem.nonlinear.elastic_contact import ElasticContact
from fem.nonlinear.newton import newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody
from fem.solver.mumps import FemError

HATS = np.linspace(-1.0, 1.0, 18)
X = HATS[1:-1]
WEIGHTS = np.full(len(X), HATS[1] - HATS[0])
GAP = WEIGHTS * 0.02 * X**2


@pytest.fixture(scope="module")
def compliance():
    mesh = structured_block(np.linspace(-2.0, 2.0, 21), np.linspace(0.0, 2.0, 9))
    return FiniteElementCompliance(elastic_body(mesh, Material(200.0, 0.3), Support()), HATS)


def solve(bodies, flexible=None):
    rest = state_at_rest(bodies, np.ones(len(X)))
    return newton_by_contacts(bodies, GAP, WEIGHTS, rest, 1.0, flexible=flexible)[0]


COUNT = 120
PLACE = np.linspace(-1.0, 1.0, COUNT)
ALL = np.ix_(np.arange(COUNT), np.arange(COUNT))
ROUGH = 0.3 * np.random.default_rng(4).normal(size=COUNT) + 2.0 * PLACE**2


def half_plane_like(friction, count=COUNT):
    """A compliance like a half-plane's."""
    far = np.arange(1.0 - count, count)
    kernel = np.log(4.0 * count) - 0.5 * np.log(far**2 + 0.3) + 0.3 * friction * np.arctan(far)
    place = np.arange(count)[:, None]
    return ShiftInvariant(lambda hats: kernel[place - hats + count - 1], count, place.ravel())


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize(
    ("gap", "load", "least", "most"),
    [
        (2.0 * PLACE**2, 1e-3, 1, 2),
        (20.0 * PLACE**2, 1.0, 10, 80),
        (ROUGH, 1.0, 10, 80),
        (ROUGH, 300.0, COUNT, COUNT),
    ],
)
def test_pressures_are_those_of_dense_equations_from_any_start(friction, gap, load, least, most):
    """A smooth gap and a rough one, one hat in contact, several patches, all hats."""
    flexible, weights = half_plane_like(friction), np.full(COUNT, 0.9)
    contact = ElasticContact(flexible, weights)
    expected, at = dense_contact(flexible[ALL], gap, weights, load)
    for start in (np.ones(COUNT), 1.0 * (np.abs(PLACE) < 0.1), np.zeros(COUNT)):
        pressure, approach = contact(gap, load, start)
        np.testing.assert_allclose(pressure, expected, atol=1e-9 * expected.max())
        assert approach == pytest.approx(at, rel=1e-9)
    assert least <= np.count_nonzero(pressure) <= most


def test_many_rough_hats_settle_from_all_in_contact():
    """They start so where a coarse contact or the load before tells nothing of a smaller one."""
    count = 2000
    near = half_plane_like(0.0, count)
    walk = np.random.default_rng(1).normal(size=count).cumsum()
    gap = np.convolve(np.pad(walk, 10, mode="edge"), np.full(21, 1.0 / 21.0), "valid")
    pressure, approach = ElasticContact(near, np.ones(count))(gap, 30.0, np.ones(count))
    opening, on = gap + near @ pressure - approach, pressure > 0.0
    assert pressure.min() == 0.0 and pressure.sum() == pytest.approx(30.0, rel=1e-12)
    assert np.abs(opening[on]).max() < 1e-10 * np.ptp(opening) and opening[~on].min() > 0.0
    assert np.count_nonzero(np.diff(on)) > 20


def test_equations_that_do_not_converge_are_solved_directly(monkeypatch):
    monkeypatch.setattr(elastic_contact, "MOST_RESIDUALS", 1)
    flexible = half_plane_like(0.3)
    pressure, _ = ElasticContact(flexible, np.ones(COUNT))(ROUGH, 0.3, np.ones(COUNT))
    expected, _ = dense_contact(flexible[ALL], ROUGH, np.ones(COUNT), 0.3)
    np.testing.assert_allclose(pressure, expected, atol=1e-9 * expected.max())


def test_a_contact_that_does_not_settle_is_an_error(monkeypatch):
    monkeypatch.setattr(elastic_contact, "MOST_EXCHANGES", 1)
    with pytest.raises(FemError, match="did not settle in 1 exchanges"):
        ElasticContact(half_plane_like(0.0), np.ones(COUNT))(ROUGH, 0.3, np.ones(COUNT))


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
def test_hats_between_nodes_of_a_coarse_roller_do_no_harm(compliance, friction):
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
