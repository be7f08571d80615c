"""Temperature of Jaeger's moving band in closed form, in units of its half-width l.

A band of uniform flux q on |x| < l, of Peclet number Pe = V l / (2 kappa), heats the surface to

    T = 2 kappa q / (pi k V) [I(X + Pe) - I(X - Pe)],   I(u) = int_0^u e^{-s} K0(|s|) ds
      = 1 + u e^{-u} (K0(u) - K1(u)) for u > 0,   1 - |u| e^{|u|} (K0 + K1)(|u|) for u < 0

(Jaeger 1942; Carslaw and Jaeger 1959, section 10.7), X = V x / (2 kappa).
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq
from scipy.special import k0e, k1e


def band_surface(x: ArrayLike, peclet: float) -> np.ndarray:
    """k T / (q l) at x [l]; peclet = V l / (2 kappa) > 0."""
    place = np.asarray(x, dtype=float)
    front, rear = peclet * (place + 1.0), peclet * (place - 1.0)
    ahead = rear > 0.0  # both terms near 1 there: the difference of what they lack
    total = _integral(front, ahead) - _integral(rear, ahead)
    return total / (np.pi * peclet)


def _integral(u: np.ndarray, ahead: np.ndarray) -> np.ndarray:
    """I(u) as above, less 1 where `ahead`."""
    size = np.abs(u).clip(1e-300)
    front = size * np.exp(-2.0 * size) * (k0e(size) - k1e(size)) + np.where(ahead, 0.0, 1.0)
    behind = 1.0 - size * (k0e(size) + k1e(size))
    return np.where(u == 0.0, 0.0, np.where(u > 0.0, front, behind))


def band_maximum(peclet: float) -> tuple[float, float]:
    """Largest k T / (q l) and its x [l]: where e^{-u} K0(|u|) is the same at both ends."""

    def slope(distance: float) -> float:  # from the trailing edge, in l
        front, rear = peclet * distance, peclet * (2.0 - distance)
        return float(np.exp(-2.0 * front) * k0e(front) - k0e(rear))

    distance = brentq(slope, 1e-12 / (1.0 + peclet), 1.0, xtol=1e-16, rtol=1e-14)
    place = distance - 1.0
    return float(band_surface(place, peclet)), float(place)


def band_mean(peclet: float) -> float:
    """Mean k T / (q l) over the band."""
    u = 2.0 * peclet
    # second integrals of e^{-+s} K0(s): u I(u) - int s e^{-+s} K0(s) ds
    decay = np.exp(-2.0 * u)
    behind = u * (u * (k0e(u) + k1e(u)) - 1.0) - (u**2 * (k0e(u) + k1e(u)) - u * k1e(u) + 1.0) / 3.0
    moment = (decay * (u**2 * (k0e(u) - k1e(u)) - u * k1e(u)) + 1.0) / 3.0
    front = u * (1.0 + u * decay * (k0e(u) - k1e(u))) - moment
    return float((front + behind) / (2.0 * peclet) / (np.pi * peclet))
