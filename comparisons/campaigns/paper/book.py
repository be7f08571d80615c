"""The numbers of Seireg's (1998) theory that judge its claims.

Its rough contact is solved to eight digits. Its short formulas of heat (chapter 5) are compared
with exact solutions, its partition with the one that is solved under Hertz's pressure. Temperatures
are relative to the surface's rise, times to tL, in which heat passes a slab."""

from functools import cache

import numpy as np

from analytic.heat import transient
from analytic.heat.moving_source import HeatedSurface
from analytic.heat.partition import divided
from analytic.material import ThermalMaterial
from analytic.statistics.nominally_flat import Summits
from analytic.statistics.penetration import BOOK_POISSON, relative_penetration
from analytic.statistics.rough_bodies import RoughContact, bearing_of, rough_contact

# Numbers and titles of the page's sections; heading and figures of the last, without pictures.
SECTIONS = {
    "seireg": "Seireg, chapter 4: rough contact",
    "seireg-heat": "Seireg, chapter 5: heat",
}
SHORT_FORMULAS = "Short formulas, and the partition", ("5.2", "5.3", "5.5", "ch. 5"), ()
SPHERE = 10e-3  # m
SETS = {
    "A": Summits(density=500e6, radius=0.2e-3, deviation=0.5e-6),
    "B": Summits(density=940e6, radius=0.2e-3, deviation=0.5e-6),
    "C": Summits(density=500e6, radius=0.2e-3, deviation=0.94e-6),
}
SMALLER = Summits(density=500e6, radius=0.1e-3, deviation=0.5e-6)
LIGHT, MIDDLE, HEAVY = 0.1, 10.0, 100.0  # T of figure 4.5, in units of set A
UNIT = ThermalMaterial(1.0, 1.0, 1.0)
LATE = np.linspace(1.0, 40.0, 3901) / 12.0  # from tL on, in L^2/kappa
PECLET, REACH = 21.0, 14.0  # of steel at 1 m/s under the paper's contact; in half-widths
NODES = np.linspace(-1.1, 1.1, 1101)


@cache
def contact(summits: Summits, load: float) -> RoughContact:
    """Of the sphere under a load T in units of set A: other sets have other units, s^(3/2)."""
    load_of_set = load * (SETS["A"].deviation / summits.deviation) ** 1.5
    return rough_contact("sphere", load_of_set, bearing_of(summits, SPHERE))


def real_pressure(summits: Summits, load: float) -> float:
    """Mean real pressure over E*."""
    ratio = summits.deviation / summits.radius
    return contact(summits, load).mean_real_pressure * float(np.sqrt(ratio))


def growth() -> float:
    return max(real_pressure(s, HEAVY) / real_pressure(s, LIGHT) for s in SETS.values())


def area_exponent() -> float:
    return 1.0 - float(np.log(growth()) / np.log(HEAVY / LIGHT))


def pressure_of_rougher() -> float:
    """Least ratio of mean real pressures: rougher, less dense, of smaller radius, over A or B."""
    a, b, c = SETS.values()
    pairs = (c, a), (a, b), (SMALLER, a)
    return min(real_pressure(one, MIDDLE) / real_pressure(other, MIDDLE) for one, other in pairs)


def area_of_rougher() -> float:
    """The largest real area, that is."""
    return 1.0 / pressure_of_rougher()


def effective_radius(load: float) -> float:
    sphere = contact(SETS["A"], load)
    return sphere.effective_width / sphere.smooth[0]


def peak_pressure(load: float) -> float:
    sphere = contact(SETS["A"], load)
    return float(sphere.pressure[0]) / sphere.smooth[1]


def penetration_coefficient(kind: str) -> float:
    """Of (q0/E)^2, E the book's."""
    return float(relative_penetration(1.0 - BOOK_POISSON**2, 1.0)[kind])


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
    surface, fast = (UNIT, len(NODES), float(NODES[1] - NODES[0])), -2.0 * PECLET
    heat = np.sqrt(np.maximum(1.0 - NODES**2, 0.0))
    bodies = (HeatedSurface(*surface, velocity, REACH) for velocity in (fast, fast * roller))
    return divided(*bodies, heat).fraction
