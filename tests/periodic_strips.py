"""The periodic half-plane under uniform strips, to which other codes' points are nearest."""

import numpy as np
from numpy.polynomial.polynomial import polyval
from scipy.special import zeta

from analytic.operators.periodic import TERMS, PeriodicHalfPlane

# sum over j >= 2 of (-1)^j ((j+c)^-2 - (j-c)^-2), over c, in powers of c^2.
_ODD = 2.0 * np.arange(TERMS) + 3.0
_FARTHER = -2.0 * (_ODD - 1.0) * 2.0**-_ODD * (zeta(_ODD, 1.0) - zeta(_ODD, 1.5))


class PeriodicStrips(PeriodicHalfPlane):
    """Pressures uniform over a pitch, displacements at its middle."""

    def _symbol(self, cycles: np.ndarray) -> np.ndarray:
        symbol = np.full(len(cycles), self._mean)
        symbol[1:] = self.pitch**2 / (np.pi * self.modulus) * strip_aliases(cycles[1:])
        return symbol


def strip_aliases(cycles: np.ndarray) -> np.ndarray:
    """sum over j of sinc(c + j) / |c + j|, any shape, for 0 < c <= 1/2."""
    nearest = cycles**-2 + (1.0 - cycles) ** -2 - (1.0 + cycles) ** -2
    return np.sin(np.pi * cycles) / np.pi * (nearest + cycles * polyval(cycles**2, _FARTHER))
