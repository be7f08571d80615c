"""Stresses under a pressure that repeats along the surface: what the periods beside it add.

The potential of one period and all its images is

    I(w) = (1/L) int_0^L p(s) cot(pi (w - s)/L) ds,        w = x + i z

(the stresses that follow from it are in `analytic.stress.potential`). The period and its two
neighbours are summed as on a free line, so that nodes, edges and the surface keep their exact
forms; what is left of the kernel, in u = (w - s)/L,

    K(u) = cot(pi u) - (1/pi) (1/(u - 1) + 1/u + 1/(u + 1)) = -(2/pi) sum_k (zeta(2k) - 1) u^(2k-1)

has no pole nearer than |u| = 2, so that for it a period of pressures is the same as twenty forces
at Chebyshev points: their polynomials up to degree 19 have the moments of the pressure.

At depth the waves e^iqx of the pressure die off like e^-qz; its mean pm stays: K tends to -i/pi and
sx = sz = -pm, which is what a wide strip makes under its middle. A surface that repeats does not
stretch: the strain along x is zero on average. Its stress is sx = -nu/(1 - nu) pm far below, and
the difference is the same everywhere (`held_along`).

    L   period [m]        p, pm   pressure and its mean [Pa]        nu   Poisson's ratio"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike
from scipy.special import zeta

from analytic.grid import HatGrid
from analytic.stress.potential import stresses

FORCES = 20  # at poles twice as far as the ends of the period: 5.8^-20 is below 1e-15
TERMS = 30  # of the series, up to |u| = SERIES: (1.3/2)^60 is below 1e-11, of a part of 1e-5
SERIES = 1.3
# A hat's moments up to the third are those of two forces at this part of its pitch from its node.
BESIDE = 1.0 / np.sqrt(6.0)


def held_along(mean: float, poissons_ratio: float) -> float:
    """Stress [Pa] along x beside that of the tractions where the mean strain along x is zero."""
    return (1.0 - 2.0 * poissons_ratio) / (1.0 - poissons_ratio) * mean


@dataclass(frozen=True)
class ImageStress:
    """Stresses of all periods but the middle three of `grid`, under its pressure (n,) [Pa]."""

    grid: HatGrid
    pressure: np.ndarray

    @cached_property
    def _points(self) -> np.ndarray:
        return chebyshev.chebpts1(FORCES)

    @property
    def _half(self) -> float:
        """[m] of the stretch that the Chebyshev points stand on, the feet of all hats inside."""
        return 0.5 * self.grid.period + self.grid.pitch

    @cached_property
    def _forces(self) -> np.ndarray:
        """(FORCES,) [N/m] at the Chebyshev points."""
        middle, share = self.grid.x, BESIDE * self.grid.pitch
        angle = np.arccos(np.array([middle - share, middle + share]) / self._half)
        moments = [np.sum(self.pressure * np.cos(k * angle)) for k in range(FORCES)]
        moments = 0.5 * self.grid.pitch * np.array(moments)
        moments[0] *= 0.5
        return 2.0 / FORCES * chebyshev.chebval(self._points, moments)

    def parts(self, x: ArrayLike, z: ArrayLike) -> np.ndarray:
        """sx, sz, txz under p and sx under q = p in +x (4, …) [Pa] at x, z [m], |x| <= L/2."""
        x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
        place, period = x + 1j * z, self.grid.period
        value, slope = np.zeros_like(place), np.zeros_like(place)
        for point, force in zip(self._half * self._points, self._forces, strict=True):
            kernel, derivative = far_kernel((place - point) / period)
            value += force / period * kernel
            slope += force / period**2 * derivative
        return stresses(value, z * slope)


def far_kernel(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """K and dK/du at u (…) with |Re u| below SERIES and Im u >= 0."""
    value, slope = np.empty_like(u), np.empty_like(u)
    near = np.abs(u) < SERIES
    order = np.arange(1, TERMS + 1)
    coefficients = -2.0 / np.pi * zeta(2.0 * order, 2.0)
    square, odd, even = u[near] ** 2, 0.0, 0.0
    for k, coefficient in zip(order[::-1], coefficients[::-1], strict=True):
        odd = odd * square + coefficient
        even = even * square + (2.0 * k - 1.0) * coefficient
    value[near], slope[near] = odd * u[near], even
    far = u[~near]
    # cot(pi u) by the wave that falls with depth
    wave = np.exp(2j * np.pi * far)
    cotangent = -1j * (1.0 + wave) / (1.0 - wave)
    value[~near], slope[~near] = cotangent, -np.pi * (1.0 + cotangent**2)
    for image in (-1.0, 0.0, 1.0):
        value[~near] -= 1.0 / (np.pi * (far - image))
        slope[~near] += 1.0 / (np.pi * (far - image) ** 2)
    return value, slope
