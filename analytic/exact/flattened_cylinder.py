"""A smooth cylinder on a half-plane whose pressure ends at a hardness: the crown that flow removes.

    P   load per length [N/m]     R   radius [m]      b   contact on |x| < b [m]
    H   hardness [Pa]             E*  modulus [Pa]    c   flowed stretch on |x| < c [m]
    p   pressure [Pa]             d   overlap [m]     k   c / b

With F(z) = int p(s)/(z - s) ds the slopes are F'+ + F'- = pi E*/R on c < |x| < b, where the gap is
closed, and p' = 0 on |x| < c. Bounded pressures that carry P leave one function,

    F' = pi E*/(2R) {1 - (z^2 - L)/sqrt((z^2 - c^2)(z^2 - b^2))},   L = b^2 (1 - E(k)/K(k)),

whose jump is p' and whose mean is the overlap's curvature, R d'' = (x^2 - L)/sqrt((c^2 - x^2)
(b^2 - x^2)) on |x| < c with d = d' = 0 at c. K and E are the complete elliptic integrals of the
modulus k. The integrals of p' and d'' give H K = pi E* b/(4R), P = H b {2E - (1 - k^2) K} and
what follows; at c = 0 it is Hertz' contact, at c = b a block of P = 2bH."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq
from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc

from analytic.exact.hertz import hertz_from_load


@dataclass(frozen=True)
class FlattenedCylinder:
    """Half-widths `contact` b, `flowed` c, `radius` R [m]; `combined_modulus`, `hardness` [Pa]."""

    contact: float
    flowed: float
    radius: float
    combined_modulus: float
    hardness: float

    def pressure(self, x: ArrayLike) -> np.ndarray:
        """H on the flowed stretch, from there E*/(2R) {b E(t|m) - L/b F(t|m)}, zero from b on [Pa].
        m = 1 - k^2 and sin^2 t = (b^2 - x^2)/(b^2 - c^2)."""
        b, c = self.contact, self.flowed
        x = np.abs(np.asarray(x, dtype=float))
        m, share = 1.0 - (c / b) ** 2, (c / b) ** 2
        level = b**2 * (1.0 - ellipe(share) / ellipk(share))  # L
        angle = np.arcsin(np.sqrt(np.clip((b**2 - x**2) / (b**2 - c**2), 0.0, 1.0)))
        outer = b * ellipeinc(angle, m) - level / b * ellipkinc(angle, m)
        outer *= self.combined_modulus / (2.0 * self.radius)
        return np.where(x < c, self.hardness, np.where(x < b, outer, 0.0))


def flattened_cylinder(
    load_per_length: float, radius: float, combined_modulus: float, hardness: float
) -> FlattenedCylinder:
    """The contact under P [N/m] with R [m], E* [Pa] and H [Pa].
    Raises ValueError unless H lies below Hertz' peak pressure p0, so that some material flows; then
    (p0/H)^2 = (4/pi^2) K {2E - (1 - k^2) K} has one root k."""
    peak = hertz_from_load(load_per_length, radius, combined_modulus).peak_pressure
    if not 0.0 < hardness < peak:
        raise ValueError(
            f"nothing flows at a hardness of {hardness:g} Pa: the peak pressure is {peak:g} Pa"
        )

    def excess(m: float) -> float:
        first, second = ellipk(m), ellipe(m)
        carried = (2.0 / np.pi) ** 2 * first * (2.0 * second - (1.0 - m) * first)
        return carried - (peak / hardness) ** 2

    m = brentq(excess, 0.0, 1.0 - np.finfo(float).eps, xtol=1e-300, rtol=1e-15)
    contact = 4.0 * radius * hardness * ellipk(m) / (np.pi * combined_modulus)
    return FlattenedCylinder(
        float(contact), float(contact * np.sqrt(m)), radius, combined_modulus, hardness
    )
