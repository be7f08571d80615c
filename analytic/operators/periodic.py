"""Compliance of a half-plane under pressures that repeat along the surface.

    u_z(x) = -(2/(pi E*)) int_0^L p(s) ln|2 sin(pi (x - s)/L)| ds + Z pm

(Westergaard 1939; Johnson 1985, section 13.2). The wave e^ikx of p sinks by 2/(E* |k|), and the
hats see it together with its aliases k + 2 pi j/h. These sums are Hurwitz zeta functions, here
the nearest terms and a power series of the others: right to rounding, as are the coefficients.

    h   pitch [m]             E*  modulus [Pa]               c  cycles per pitch, k h/(2 pi)
    L   period n h [m]        pm  mean pressure [Pa]         Z  compliance of the mean [m/Pa]"""

from functools import cached_property

import numpy as np
from numpy.polynomial.polynomial import polyval
from scipy.fft import irfft
from scipy.special import binom, zeta

from analytic.operators.convolution import Convolution

FEWEST = 4  # elements of a coarsened period
TERMS = 14  # of series in (c/2)^2 <= 1/16: the rest is below 1e-16


class PeriodicHalfPlane(Convolution):
    """Compliance of a half-plane under one period of `count` elements, applied by FFT.

    The mean displacement has no value; the mean pressure gets the compliance of the longest wave,
    Z = L/(pi E*), which makes the operator positive definite and scale with the unit of length. An
    approach counts from there; mean gap and pressures do not depend on it. With E* of two bodies
    the displacement is the sum of both.

    count    number of elements      pitch    h [m]
    modulus  E* [Pa], or E' of one body"""

    def __init__(self, count: int, pitch: float, modulus: float) -> None:
        self.pitch, self.modulus, self.arguments = pitch, modulus, (modulus,)
        self._mean = count * pitch**2 / (np.pi * modulus)  # h Z
        cycles = np.arange(count // 2 + 1) / count
        column = irfft(self._symbol(cycles), count)
        super().__init__(column, None, periodic=True)

    @cached_property
    def coarser(self) -> "PeriodicHalfPlane | None":
        """See `Convolution`; None for an odd number of elements and once few are left."""
        return None if self.count % 2 or self.count < 2 * FEWEST else super().coarser

    def _symbol(self, cycles: np.ndarray) -> np.ndarray:
        """Eigenvalues of the circulant [m^2/Pa]; `cycles` from 0 to 1/2, the first of them 0."""
        symbol = np.full(len(cycles), self._mean)
        symbol[1:] = self.pitch**2 / (np.pi * self.modulus) * hat_aliases(cycles[1:])
        return symbol


# sum over |j| >= 2 of |c + j|^-5 in powers of c^2: 2 (4+2k over 4) zeta(5+2k, 2).
_EVEN = 2.0 * np.arange(TERMS) + 4.0
_FARTHER = 2.0 * binom(_EVEN, 4.0) * zeta(_EVEN + 1.0, 2)


def hat_aliases(cycles: np.ndarray) -> np.ndarray:
    """sum over j of sinc^4(c + j) / |c + j|, any shape, for 0 < c <= 1/2. A hat's transform is
    sinc^2 and stands twice, in the pressure and in the average."""
    total = polyval(cycles**2, _FARTHER) + _fifth(cycles)
    total = total + _fifth(1.0 + cycles)
    total = total + _fifth(1.0 - cycles)
    return (np.sin(np.pi * cycles) / np.pi) ** 4 * total


def _fifth(value: np.ndarray) -> np.ndarray:
    """value^-5, by products."""
    inverse = 1.0 / value
    return (inverse * inverse) ** 2 * inverse
