"""A matrix that is not symmetric stands for the body that it was taken from."""

import numpy as np
import pytest

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.grid import HatGrid, roller_gap
from analytic.operators.tangential import CoupledHalfPlane, DenseCoupledCompliance

RADIUS, MODULUS, LOAD = 7.5706e-3, 115.385e9, 1.0e6
GRID = HatGrid.within(-0.5e-3, 0.5e-3, 2e-6)


def body(friction_dundurs: float = 0.4, grid: HatGrid = GRID) -> CoupledHalfPlane:
    return CoupledHalfPlane(grid.count, grid.pitch, MODULUS, friction_dundurs)


def whole(operator: CoupledHalfPlane) -> DenseCoupledCompliance:
    return DenseCoupledCompliance(operator.block(np.arange(operator.count)))


def wavy_gap(grid: HatGrid = GRID) -> np.ndarray:
    wave = 2.0 * np.pi / 60e-6
    return grid.hat_integrals(lambda x: roller_gap(RADIUS)(x) - 0.3e-6 * np.cos(wave * x + 0.4))


@pytest.mark.parametrize(
    "constraints",
    [Constraints(load=LOAD), Constraints(load=LOAD, hardness=5e9), Constraints(approach=2e-6)],
)
@pytest.mark.parametrize("friction_dundurs", [-0.1, 0.4])
def test_contact_is_that_of_the_same_body(friction_dundurs, constraints):
    right = solve_coupled(body(friction_dundurs), wavy_gap(), GRID.weights, constraints)
    found = solve_coupled(whole(body(friction_dundurs)), wavy_gap(), GRID.weights, constraints)
    assert found.converged
    assert found.pressure == pytest.approx(right.pressure, abs=1e-8 * right.pressure.max())
    assert found.iterations["exchanges"] <= 12


def test_coarser_hats_are_sums_of_finer_ones():
    """As those of the half-plane with hats twice as wide; of an even count the last is short."""
    for count in (41, 40):
        fine = CoupledHalfPlane(count, 1e-6, MODULUS, 0.4, 1e-3)
        coarse = whole(fine).coarsened()
        exact = fine.coarsened().block(np.arange(count // 2))
        inner = slice(None) if count % 2 else slice(None, -1)
        found = coarse.matrix[inner, inner]
        assert found == pytest.approx(exact[inner, inner], rel=1e-11)
        assert coarse.count == count // 2 and coarse.skew


def test_symmetric_matrix_has_no_skew_part():
    assert not whole(body(0.0)).skew
    assert whole(body(1e-6)).skew


def test_hats_that_the_body_cannot_resolve_away_from_the_contact_do_no_harm():
    """As over a mesh that is coarse there: displacements of every third hat, and between them."""
    far = np.abs(GRID.x) > 0.42e-3
    places = np.flatnonzero(~far | (np.arange(GRID.count) % 3 == 0))
    spread = np.array([np.interp(GRID.x, GRID.x[places], row) for row in np.eye(len(places))]).T
    few = DenseCoupledCompliance(spread @ body().block(places) @ spread.T)
    assert few.solve(np.arange(40), np.ones((40, 1))) is None
    constraints = Constraints(load=LOAD)
    found = solve_coupled(few, wavy_gap(), GRID.weights, constraints)
    right = solve_coupled(body(), wavy_gap(), GRID.weights, constraints)
    assert found.converged
    assert found.pressure == pytest.approx(right.pressure, abs=1e-6 * right.pressure.max())
