"""Compliance of a half-plane under pressures that repeat along the surface.

    u_z(x) = -(2/(pi E*)) int_0^L p(s) ln|2 sin(pi (x - s)/L)| ds + Z pm

(Westergaard 1939; Johnson 1985, section 13.2). The wave e^ikx of p sinks by 2/(E* |k|), and the
elements of the grid see every wave together with its aliases k + 2 pi j/h. These infinite sums
are Hurwitz zeta functions: the symbol is right to rounding, and so are the coefficients.

    h   pitch [m]             E*  modulus [Pa]               c  cycles per pitch, k h/(2 pi)
    L   period n h [m]        pm  mean pressure [Pa]         Z  compliance of the mean [m/Pa]
"""

import numpy as np
from scipy.fft import irfft
from scipy.special import zeta

from analytic.convolution import Convolution, made_once
from analytic.operators import Element

FEWEST = 4  # elements of a coarsened period


class PeriodicHalfPlane(Convolution):
    """Compliance of a half-plane under one period of `count` elements, applied by FFT.

    The mean displacement of a periodically loaded half-plane has no value; the mean pressure is
    given the compliance of the longest wave, Z = L/(pi E*), which makes the operator positive
    definite and scale with the unit of length. An approach counts from there; the mean gap and
    all pressures do not depend on it. With E* of two bodies the displacement is the sum of both.

    count    number of elements      pitch    h [m]
    modulus  E* [Pa], or E' of one body
    element  "hat" (Galerkin) or "strip" (uniform, collocated)
    coefficients  (n,) first column of the symmetric circulant [m^2/Pa]
    """

    def __init__(self, count: int, pitch: float, modulus: float, element: Element = "hat") -> None:
        self.element = element
        self.pitch = pitch
        self.modulus = modulus
        self._mean = count * pitch**2 / (np.pi * modulus)  # h Z
        cycles = np.arange(count // 2 + 1) / count
        self.coefficients = irfft(self._symbol(cycles), count)
        super().__init__(self.coefficients, None, periodic=True)

    @made_once
    def coarsened(self) -> "PeriodicHalfPlane | None":
        """The same half-plane on elements twice as wide, centred on nodes 1, 3, 5, …

        None for an odd number of elements and once few are left.
        """
        half, odd = divmod(self.count, 2)
        if odd or half < FEWEST:
            return None
        return PeriodicHalfPlane(half, 2.0 * self.pitch, self.modulus, self.element)

    def _symbol(self, cycles: np.ndarray) -> np.ndarray:
        """Eigenvalues of the circulant [m^2/Pa]; `cycles` from 0 to 1/2, the first of them 0."""
        symbol = np.full(len(cycles), self._mean)
        aliases = hat_aliases if self.element == "hat" else strip_aliases
        symbol[1:] = self.pitch**2 / (np.pi * self.modulus) * aliases(cycles[1:])
        return symbol


def hat_aliases(cycles: np.ndarray, beyond: int = 0) -> np.ndarray:
    """sum over j of sinc^4(c + j) / |c + j|, any shape, for 0 < c <= 1/2.

    A hat's transform is sinc^2 and stands twice, in the pressure and in the average.
    With `beyond` = J > 0 only over |j| >= J.
    """
    power = (np.sin(np.pi * cycles) / np.pi) ** 4
    upward = zeta(5.0, cycles + beyond)
    return power * (upward + zeta(5.0, max(beyond, 1) - cycles))


def strip_aliases(cycles: np.ndarray) -> np.ndarray:
    """sum over j of sinc(c + j) / |c + j|, any shape, for 0 < c <= 1/2."""

    def alternating(first: np.ndarray) -> np.ndarray:
        """sum over j >= 0 of (-1)^j / (first + j)^2."""
        return 0.25 * (zeta(2.0, 0.5 * first) - zeta(2.0, 0.5 * first + 0.5))

    sine = np.sin(np.pi * cycles) / np.pi
    return sine * (alternating(cycles) + alternating(1.0 - cycles))
