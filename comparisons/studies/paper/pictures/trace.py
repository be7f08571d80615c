"""Both bodies under load over a whole trace, beyond the reach of the pressures too."""

import numpy as np

from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane
from comparisons.models.deformed import mean_height
from comparisons.results.outcome import Outcome


def trace_surfaces(outcome: Outcome) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x (n,) and the heights (n,) of body and roller under load [m] over the whole trace.

    From the half-plane's pressures; of a smooth body over the ground of these. The datum of the
    heights is arbitrary.
    """
    problem, level = outcome.problem, outcome.runs["half_plane"].finest
    profile, pitch, grid = problem.scene.profile, level.grid.pitch, level.grid
    if profile is not None:
        grid = HatGrid.within(float(profile.x[0]), float(profile.x[-1]), pitch)
    pressure = np.zeros(grid.count)
    first = level.grid.first - grid.first
    pressure[first : first + level.grid.count] = level.solution.pressure
    moved = HalfPlane(grid.count, pitch, problem.modulus).apply(pressure) / grid.weights
    gap = grid.hat_integrals(problem.gap, problem.knots) / grid.weights + moved
    gap -= np.median(gap[pressure > 0.0])
    given_way = problem.modulus / problem.scene.body.plane_strain_modulus * moved
    body = mean_height(problem, grid) - given_way
    return grid.x, body, body + np.maximum(gap, 0.0)
