"""Hats of pressure on a grid: pressed on a half-plane, and wide ones as sums of narrow ones."""

import numpy as np

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane, ModelOperator


def solved(operator: ModelOperator, weighted_gap, start=None, **limits) -> ContactSolution:
    """The contact of gaps (n,) [m^2], weighted with the hats of an operator, within the limits of
    `Constraints`, which converges."""
    weights = np.full(operator.count, operator.pitch)
    solution = solve_coupled(operator, weighted_gap, weights, Constraints(**limits), start)
    assert solution.converged, solution.residuals
    return solution


def pressed(grid: HatGrid, modulus: float, gap, knots=None, **limits) -> ContactSolution:
    """A half-plane of E* [Pa] under a gap g0(x) [m]."""
    operator = HalfPlane(grid.count, grid.pitch, modulus)
    return solved(operator, grid.hat_integrals(gap, knots), **limits)


def of_narrow_hats(count: int, around: bool = False) -> np.ndarray:
    """Hats about nodes 1, 3, 5, … as 1/2, 1, 1/2 of `count` ones (count, count // 2), on a line, or
    around a circle."""
    distance = np.abs(np.arange(count)[:, None] - np.arange(1, count, 2)[: count // 2])
    if around:
        distance = np.minimum(distance, count - distance)
    return np.maximum(1.0 - 0.5 * distance, 0.0)
