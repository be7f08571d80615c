"""Flat punch with rounded corners on a half-plane, without friction.

    ________________          g0(x) = 0                   for |x| <= b,
    \\              /                  (|x| - b)^2/(2 R)   beyond: flat on 2b, corners of radius R,
     \\____________/                                       parabolic as in Hertz's theory
    ----------------------    contact on |x| < a, a > b
         2b, 2a

Nomenclature: b half of the flat [m], R corner radius [m], E* combined modulus [Pa], P load per
length [N/m], a half-width [m], e = sqrt(a^2 - b^2) [m], chi = arccos(b/a).

    P = (E*/2R) (a^2 chi - e b)                                (Ciavarella, Hills, Monno 1998)
    dP/da = (E*/R) a chi

The pressure is the sum of flat punches of growing width c, each with the load dP(c) and the
pressure dP/(pi sqrt(c^2 - x^2)); with s = sqrt(a^2 - x^2) it integrates to

    pi R p/E* = chi s - x artanh(s e/(a^2 + b x)) + (x - b) artanh(min(s, e)/max(s, e)),  x >= 0,
    with artanh of either equal to arsinh(s e/(a (x + b))), arsinh(min(s, e)/sqrt|x^2 - b^2|),

which is the source's logarithm with its two halves merged: for x >= b no terms cancel. On the
flat the tangents at e = 0 do, and what is left of them is taken together (lengths in a):

    e^3 (1 + b x - x^2 + x^3)/((1 + b) s (1 + b x)),  besides y - sin y and artanh y - y.

s comes from e and x - b, so that even a corner contact of 1e-8 b keeps its digits. b = 0 is
Hertz's contact; for e much smaller than b the pressure tends to P/(pi s) of the flat punch.
The peak stands where t artanh t = chi b/e with t = b s/(x e)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from analytic.numerics import angle_minus_sine, artanh_minus_argument, check_positive


@dataclass(frozen=True)
class RoundedPunch:
    """A punch in contact: `half_flat` b [m], `corner_radius` R [m], `combined_modulus` E* [Pa],
    `load_per_length` P [N/m], `half_width` a [m], `corner_chord` e = sqrt(a^2 - b^2) [m]."""

    half_flat: float
    corner_radius: float
    combined_modulus: float
    load_per_length: float
    half_width: float
    corner_chord: float

    def gap(self, x: ArrayLike) -> np.ndarray:
        """Initial gap g0 [m] at x [m] from the middle."""
        beyond = np.maximum(np.abs(np.asarray(x, dtype=float)) - self.half_flat, 0.0)
        return beyond**2 / (2.0 * self.corner_radius)

    def pressure(self, x: ArrayLike) -> np.ndarray:
        """Pressure [Pa] at x [m] from the middle, zero outside the contact."""
        return self._pressure(np.abs(np.asarray(x, dtype=float)) - self.half_flat)

    @property
    def peak_pressure(self) -> float:
        """Largest pressure [Pa]."""
        return float(self._pressure(np.array(self._peak_beyond_flat)))

    @property
    def _peak_beyond_flat(self) -> float:
        b, e, a = self.half_flat, self.corner_chord, self.half_width
        if b == 0.0:
            return 0.0
        level = np.arctan2(e, b) * b / e
        ratio = brentq(lambda t: t * np.arctanh(t) - level, 0.0, 0.9, xtol=1e-300, rtol=1e-15)
        root = np.hypot(b, e * ratio)
        return float(b * e**2 * (1.0 - ratio) * (1.0 + ratio) / (root * (a + root)))

    def _pressure(self, beyond: np.ndarray) -> np.ndarray:
        """Pressure [Pa] by x - b [m], x >= 0."""
        a = self.half_width
        b, e, beyond = self.half_flat / a, self.corner_chord / a, beyond / a
        x = b + beyond
        opening = beyond * (x + b)  # x^2 - b^2 = e^2 - s^2
        s = np.sqrt(np.maximum(e**2 - opening, 0.0))
        chi = np.arctan2(e, b)
        # Both are infinite where their divisor vanishes, and are multiplied with it there.
        nothing, root = np.zeros_like(s), np.sqrt(np.abs(opening))
        across = np.arcsinh(np.divide(s * e, x + b, out=nothing.copy(), where=x + b > 0.0))
        corner = np.arcsinh(np.divide(np.minimum(s, e), root, out=nothing, where=root > 0.0))
        beyond_flat = chi * s - x * across + beyond * corner
        middle, product = np.maximum(s, e), s * e / (1.0 + b * x)
        on_flat = (
            e**3 * (1.0 + b * x - x**2 + x**3) / ((1.0 + b) * middle * (1.0 + b * x))
            + middle * angle_minus_sine(chi)
            - x * artanh_minus_argument(product, across)
            + beyond * artanh_minus_argument(e / middle, corner)
        )
        shape = np.where(s > 0.0, np.where(beyond < 0.0, on_flat, beyond_flat), 0.0)
        return self.combined_modulus * a / (np.pi * self.corner_radius) * shape


def rounded_punch_from_half_width(
    half_width: float, half_flat: float, corner_radius: float, combined_modulus: float
) -> RoundedPunch:
    """Contact of half-width a [m] > b >= 0 [m], with R [m] and E* [Pa].
    Raises ValueError unless a, R and E* are positive and 0 <= b < a."""
    check_positive(
        half_width=half_width, corner_radius=corner_radius, combined_modulus=combined_modulus
    )
    if not 0.0 <= half_flat < half_width:
        raise ValueError(
            f"half_flat must be at least 0 and below {half_width:g}, the half-width, "
            f"not {half_flat:g}"
        )
    e = float(np.sqrt((half_width - half_flat) * (half_width + half_flat)))
    # a^2 chi - e b as a^2 (chi - sin chi) + e (a - b), both positive
    a = np.hypot(e, half_flat)
    shape = a**2 * angle_minus_sine(np.arctan2(e, half_flat)) + e**3 / (a + half_flat)
    load = 0.5 * combined_modulus / corner_radius * float(shape)
    return RoundedPunch(half_flat, corner_radius, combined_modulus, load, half_width, e)
