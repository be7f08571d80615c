"""The numbers of Seireg's (1998) theory of rough contact, solved to eight digits, that judge its
claims; those on heat are judged by `comparisons.campaigns.paper.claims.heat`."""

from functools import cache

import numpy as np

from analytic.statistics.nominally_flat import Summits
from analytic.statistics.penetration import BOOK_POISSON, relative_penetration
from analytic.statistics.rough_bodies import RoughContact, bearing_of, rough_contact

SPHERE = 10e-3  # m
SETS = {
    "A": Summits(density=500e6, radius=0.2e-3, deviation=0.5e-6),
    "B": Summits(density=940e6, radius=0.2e-3, deviation=0.5e-6),
    "C": Summits(density=500e6, radius=0.2e-3, deviation=0.94e-6),
}
SMALLER = Summits(density=500e6, radius=0.1e-3, deviation=0.5e-6)
LIGHT, MIDDLE, HEAVY = 0.1, 10.0, 100.0  # T of figure 4.5, in units of set A


@cache
def contact(summits: Summits, load: float) -> RoughContact:
    """Of the sphere under a load T in units of set A: other sets have other units, s^(3/2)."""
    own = load * (SETS["A"].deviation / summits.deviation) ** 1.5
    return rough_contact("sphere", own, bearing_of(summits, SPHERE))


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
    found = contact(SETS["A"], load)
    return found.effective_width / found.smooth[0]


def peak_pressure(load: float) -> float:
    found = contact(SETS["A"], load)
    return float(found.pressure[0]) / found.smooth[1]


def penetration_coefficient(kind: str) -> float:
    """Of (q0/E)^2, E the book's."""
    return float(relative_penetration(1.0 - BOOK_POISSON**2, 1.0)[kind])
