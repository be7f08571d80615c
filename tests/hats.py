"""Hats of pressure on a grid: pressed on a half-plane, and wide ones as sums of narrow ones."""

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane


def pressed(grid: HatGrid, modulus: float, gap, knots=None, **limits) -> ContactSolution:
    """A half-plane of E* [Pa] under a gap g0(x) [m], within the limits of `Constraints`."""
    operator, weighted_gap = (
        HalfPlane(grid.count, grid.pitch, modulus),
        grid.hat_integrals(gap, knots),
    )
    solution = solve_contact(operator, weighted_gap, grid.weights, Constraints(**limits))
    assert solution.converged
    return solution


def of_narrow_hats(count: int, around: bool = False) -> np.ndarray:
    """Hats about nodes 1, 3, 5, … as 1/2, 1, 1/2 of `count` ones (count, count // 2), on a line, or
    around a circle."""
    distance = np.abs(np.arange(count)[:, None] - np.arange(1, count, 2)[: count // 2])
    if around:
        distance = np.minimum(distance, count - distance)
    return np.maximum(1.0 - 0.5 * distance, 0.0)
