"""Rough planes of Gaussian heights: Greenwood and Williamson (1966), and Persson (2001).

Summits are spheres of one radius whose heights are Gaussian; each bears as if alone (Hertz).

    E* combined modulus [Pa]     eta density of summits [1/m^2]    beta their radius [m]
    s  deviation of heights [m]  h   separation of the mean plane of the summits over s
    p  mean pressure [Pa]        f   real over nominal area

    p = (4/3) eta E* sqrt(beta) s^(3/2) F_3/2(h),   f = pi eta beta s F_1(h),
    F_n(h) = integral from h of (t - h)^n phi(t) dt,  phi the unit normal density"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import erf

from analytic.numerics import check_positive

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(100)
TAIL = 9.5  # standard deviations beyond which phi is less than rounding


@dataclass(frozen=True)
class Summits:
    """Summits of a surface, or peaks of a profile: density [1/m^2] or [1/m], radius, standard
    deviation of the height and mean height above the mean plane or line [m]."""

    density: float
    radius: float
    deviation: float
    mean: float = 0.0

    def __post_init__(self) -> None:
        check_positive(density=self.density, radius=self.radius, deviation=self.deviation)


def tail_integral(n: float, h: ArrayLike) -> np.ndarray:
    """F_n(h) for n > -1, of any shape of h, to 1e-14 relative wherever phi(h) is a double.
    With t - h = v^2 the integrand is smooth for half and whole n. Nothing cancels."""
    h = np.asarray(h, dtype=float)[..., None]
    start = np.sqrt(np.maximum(0.0, -h - TAIL))
    half = 0.5 * (np.sqrt(np.sqrt(TAIL**2 + np.maximum(h, 0.0) ** 2) - h) - start)
    v = start + half * (1.0 + POINTS)
    density = np.exp(-0.5 * (v**2 + h) ** 2) / np.sqrt(2.0 * np.pi)
    return np.sum(2.0 * half * WEIGHTS * v ** (2.0 * n + 1.0) * density, axis=-1)


def persson_fraction(pressure: ArrayLike, modulus: float, rms_slope: float) -> np.ndarray:
    """f of a plane-strain surface at mean pressures [Pa], by Persson's theory.
    erf(p / sqrt(2 V)), V = (E* s')^2 / 4 the variance of the pressure that closes all gaps, s' the
    slope of ridges across the plane. An isotropic surface with profiles of slope s' has 2 V."""
    return erf(np.sqrt(2.0) * np.asarray(pressure) / (modulus * rms_slope))
