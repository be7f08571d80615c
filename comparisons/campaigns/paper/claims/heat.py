"""The numbers that judge what Seireg (1998), chapter 5, says of heat.

Its short formulas stand against exact solutions, its partition against the one that is solved
under Hertz's pressure.

Temperatures are parts of the surface's rise, times multiples of tL, in which heat passes a slab."""

import numpy as np

from analytic.heat import transient
from analytic.heat.moving_source import HeatedSurface
from analytic.heat.partition import divided
from analytic.material import ThermalMaterial

UNIT = ThermalMaterial(1.0, 1.0, 1.0)
LATE = np.linspace(1.0, 40.0, 3901) / 12.0  # from tL on, in L^2/kappa
PECLET, REACH = 21.0, 14.0  # of steel at 1 m/s under the paper's contact; in half-widths
NODES = np.linspace(-1.1, 1.1, 1101)


def parabola_error() -> float:
    """Largest error of the parabola in a half-space."""
    depth = np.linspace(0.0, 6.0, 6001)
    error = transient.parabola(depth, 1.0, 1.0) - transient.step_half_space(depth, 1.0, 1.0)
    return float(np.abs(error).max())


def bottom_error() -> float:
    """Largest error of the short formula for a slab's bottom."""
    exact = transient.step_slab(1.0, LATE, 1.0, 1.0)
    return float(np.abs(transient.bottom_rise(LATE, 1.0, 1.0) - exact).max())


def bottom_lacks(late: float) -> float:
    """What a slab's bottom lacks at `late` tL, exactly."""
    return float(1.0 - transient.step_slab(1.0, late / 12.0, 1.0, 1.0))


def mean_lacks(late: float) -> float:
    points, weights = np.polynomial.legendre.leggauss(20)
    rise = transient.step_slab(0.5 * (1.0 + points), late / 12.0, 1.0, 1.0)
    return float(1.0 - 0.5 * weights @ rise)


def formula_lacks(late: float) -> float:
    return float(1.0 - transient.bottom_rise(late / 12.0, 1.0, 1.0))


def surface_coefficient() -> float:
    """1.12 over the exact coefficient of the rise under a constant flux."""
    short = transient.surface_rise(1.0, 1.0, UNIT)
    return float(short / transient.flux_half_space(0.0, 1.0, 1.0, UNIT))


def slab_over_half_space(late: float) -> float:
    """Rise of an insulated slab's surface under a constant flux, over the half-space's."""
    slab = transient.flux_slab(0.0, late / 12.0, 1.0, 1.0, UNIT)
    return float(slab / transient.flux_half_space(0.0, late / 12.0, 1.0, UNIT))


def heat_into_body(roller: float) -> float:
    """Part of the heat that enters the body past which Hertz's contact moves, of a roller of the
    same material whose surface moves at `roller` times the body's speed."""
    given, fast = (UNIT, len(NODES), float(NODES[1] - NODES[0])), -2.0 * PECLET
    heat = np.sqrt(np.maximum(1.0 - NODES**2, 0.0))
    bodies = (HeatedSurface(*given, velocity, REACH) for velocity in (fast, fast * roller))
    return divided(*bodies, heat).fraction
