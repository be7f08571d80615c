"""Largest and mean temperature of Jaeger's band in closed form, in units of its half-width l."""

import numpy as np
from scipy.optimize import brentq
from scipy.special import k0e, k1e

from analytic.heat.moving_source import band_surface


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
