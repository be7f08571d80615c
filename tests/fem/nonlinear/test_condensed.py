"""Elastic contact on a dense compliance, and a roller that has become one."""

import numpy as np
import pytest

from analytic.material import Material
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.nonlinear import condensed
from fem.nonlinear.condensed import CondensedRoller, ElasticContact
from fem.solver.mumps import FemError

HATS = np.linspace(-1.0, 1.0, 18)
X = HATS[1:-1]
WEIGHTS = np.full(len(X), HATS[1] - HATS[0])
GAP = WEIGHTS * 0.02 * X**2


@pytest.fixture(scope="module")
def compliance(structured_block):
    mesh = structured_block(np.linspace(-2.0, 2.0, 21), np.linspace(0.0, 2.0, 9))
    return FiniteElementCompliance(elastic_body(mesh, Material(200.0, 0.3), Support()), HATS)


@pytest.mark.parametrize("start", [np.ones(len(X)), 1.0 * (np.abs(X) < 0.1), np.zeros(len(X))])
def test_contact_is_the_one_of_the_compliance_from_any_start(compliance, dense, start):
    flexible = compliance.matrix()
    pressure, approach = ElasticContact(flexible, WEIGHTS)(GAP, 1.0, start)
    expected, at = dense(flexible, GAP, WEIGHTS, 1.0)
    np.testing.assert_allclose(pressure, expected, atol=1e-10 * expected.max())
    assert approach == pytest.approx(at, rel=1e-10)
    assert 0 < np.count_nonzero(pressure) < len(X)


def test_a_contact_that_does_not_settle_is_an_error(compliance, monkeypatch):
    monkeypatch.setattr(condensed, "MOST_EXCHANGES", 1)
    with pytest.raises(FemError, match="did not settle in 1 exchanges"):
        ElasticContact(compliance.matrix(), WEIGHTS)(GAP, 1.0, np.ones(len(X)))


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_a_roller_on_the_hats_moves_as_the_whole_one(compliance, friction):
    roller = CondensedRoller(compliance.matrix(friction), WEIGHTS, not friction)
    pressure = 1.0 + X
    moved = roller.moved(pressure)
    terms = roller.at(moved, pressure)
    np.testing.assert_allclose(terms.gap, compliance.apply(pressure, friction), rtol=1e-10)
    force, _ = roller.linearised(moved)
    np.testing.assert_allclose(force.ravel(), terms.force @ pressure, atol=1e-9)
    assert roller.symmetric is not bool(friction)


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_hats_between_the_nodes_of_a_coarse_mesh_do_no_harm(compliance, friction):
    """Their compliance is singular: what it moves comes back, whatever else pressures hold."""
    hats = np.linspace(-1.0, 1.0, 68)
    flexible = FiniteElementCompliance(compliance.body, hats).matrix(friction)
    assert np.linalg.matrix_rank(flexible) < len(flexible)
    weights = np.full(len(flexible), hats[1] - hats[0])
    roller, pressure = CondensedRoller(flexible, weights, not friction), 1.0 + hats[1:-1]
    moved = roller.moved(pressure)
    again = roller.moved(roller.force(moved)[:, 0] / weights)
    np.testing.assert_allclose(again, moved, rtol=1e-6, atol=0.0)
