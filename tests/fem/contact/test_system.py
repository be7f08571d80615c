"""Systems of Newton steps by the factor of a former one: as by their own."""

import numpy as np
import pytest
from blocks import structured_block

from analytic.material import Material
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.contact import system as module
from fem.contact.system import ContactSystem, ReusedFactor
from fem.contact.terms import LinearContact
from fem.solver.mumps import FemError, solve_once

HATS = np.linspace(-1.0, 1.0, 18)
WEIGHTS = np.full(16, HATS[1] - HATS[0])


@pytest.fixture(scope="module")
def compliance():
    mesh = structured_block(np.linspace(-2.0, 2.0, 21), np.linspace(0.0, 2.0, 9))
    return FiniteElementCompliance(elastic_body(mesh, Material(1.0, 0.3), Support()), HATS)


def system(compliance, hats, soft=0.0, friction=0.0, loaded=True):
    """In which the stiffness of some nodes is less by a part."""
    body, count = compliance.body, compliance.body.unknowns
    part = np.where(np.arange(count) % 7 == 0, 1.0 - soft, 1.0)
    tangent = body.stiffness().multiply(part).multiply(part[:, None]).tocsr()
    terms = LinearContact(compliance, friction).at(np.zeros(body.held.shape), np.zeros(16))
    free = np.flatnonzero(~body.held.ravel())
    flexible = compliance.matrix(-friction)
    kind = 1.0, loaded, not friction
    return ContactSystem([(tangent, terms, free)], flexible, WEIGHTS, np.array(hats), *kind)


def counted(monkeypatch, worth, accuracy):
    """A reused factor of a worth in its solutions, and the systems that it has factorised."""
    monkeypatch.setattr(module, "FACTOR_WORTH", worth)
    reused, made = ReusedFactor(accuracy), []
    renew = reused._renew
    reused._renew = lambda system: (made.append(system), renew(system))
    return reused, made


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("loaded", [True, False])
def test_a_solution_is_that_of_the_systems_own_factor(compliance, monkeypatch, friction, loaded):
    """Hats join and leave, at ends and within, and the tangent changes."""
    reused, made = counted(monkeypatch, 1000, 1e-11)
    for soft, hats in [(0.0, [5, 6, 7, 9]), (0.0, [4, 6, 7, 8, 10]), (0.1, [6]), (0.1, [5, 6, 7])]:
        now = system(compliance, hats, soft, friction, loaded)
        right = np.random.default_rng(len(hats)).normal(size=now.size)
        x = solve_once(now.matrix(), right, symmetric=False)
        np.testing.assert_allclose(reused.solve(now, right), x, atol=1e-8 * np.abs(x).max())
    assert len(made) == 1


def test_a_factor_is_made_again_where_others_cost_more(compliance, monkeypatch):
    """Its solutions take ever more steps as the tangent softens; with one step each there is one
    factorisation for all."""
    reused, made = counted(monkeypatch, 2, 1e-3)
    for soft in (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6):
        reused.solve(now := system(compliance, [7, 8], soft), np.ones(now.size))
    assert 1 < len(made) < 7
    several = len(made)
    for _ in range(10):
        reused.solve(now, np.ones(now.size))
    assert len(made) <= several + 1


def test_a_singular_system_is_an_error(compliance):
    now = system(compliance, [7, 8], soft=1.0)
    with pytest.raises(FemError, match="singular"):
        ReusedFactor(1e-10).solve(now, np.ones(now.size))
