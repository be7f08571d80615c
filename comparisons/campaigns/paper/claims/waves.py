"""Which waves bridge the quiescent zone below a roller, on the half-plane."""

import numpy as np

from analytic.operators.tangential import CoupledHalfPlane
from analytic.stress.field import friction_field
from comparisons.campaigns.paper.claims.readings import LevelView
from comparisons.models.nearest_operator import solve_on
from comparisons.studies.comparison import DEEP
from comparisons.studies.quiescent_zone import QUIET, mean_shear, shear_dip

WAVES = np.geomspace(0.2, 0.8, 9)  # a
SEVERITY = 2.0  # p0: the mean pressure that would close the waves, pi E* height / wavelength


def bridging_wavelength(view: LevelView, friction: float) -> float:
    """Shortest wave [a], a crest under the roller's middle, over whose zone the mean shear falls
    nowhere below QUIET of both maxima; infinite where there is none up to 0.8 a."""
    ratios = np.array([_ratio(view, wave, friction) for wave in WAVES])
    bridging = np.flatnonzero(ratios >= QUIET)
    if len(bridging) == 0:
        return np.inf
    pair = slice(max(bridging[0] - 1, 0), bridging[0] + 1)
    return float(np.exp(np.interp(QUIET, ratios[pair], np.log(WAVES[pair]))))


def _ratio(view: LevelView, wave: float, friction: float) -> float:
    """Least mean shear over the smaller maximum, under waves [a] on the view's smooth body."""
    problem, grid, window = view.problem, view.level.grid, view.window
    hertz, length = problem.hertz, wave * problem.hertz.half_width
    height = SEVERITY * hertz.peak_pressure * length / (np.pi * problem.modulus)
    weighted_gap = grid.hat_integrals(
        lambda x: problem.gap(x) - height * np.cos(2.0 * np.pi * x / length), problem.knots
    )
    operator = CoupledHalfPlane(grid.count, grid.pitch, problem.modulus, 0.0)
    pressure = solve_on(operator, weighted_gap, grid.weights, problem.constraints()).pressure
    spacing = window.subdivisions(grid.pitch), "hat", window.stride(grid.pitch)
    points = (window.x[0], window.x[-1]), window.z[view.rows]
    field = friction_field(grid.x, pressure, *points, *spacing).at(friction)
    shear = mean_shear(problem, window, field.stress.tau1, view.every)
    return shear_dip(field.z, shear, DEEP * hertz.half_width).ratio
