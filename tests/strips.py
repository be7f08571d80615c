"""Uniform strips of pressure and traction, in place of hats: the method as published.

Webster and Sayles (1986) hold each nodal pressure p_i over its own pitch h and take the
displacement at the middle of the strip, (C p)_i = h u_z(x_i); Bailey and Sayles (1991) sum the
stresses of such strips. The points of other codes are nearest to strips, too."""

import numpy as np
from numpy.polynomial.polynomial import polyval
from numpy.typing import ArrayLike
from scipy.special import xlogy, zeta

from analytic.numerics import angle_minus_sine, points_below
from analytic.operators.convolution import Convolution
from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import TERMS, PeriodicHalfPlane
from analytic.stress.elements import FrictionStress
from analytic.stress_state import StressState


def strip_displacement(offset: ArrayLike) -> np.ndarray:
    """L_u at `offset` [pitches], any shape: a uniform pressure one pitch wide."""
    x = np.abs(np.asarray(offset, dtype=float))
    near = xlogy(x + 0.5, x + 0.5) - xlogy(x - 0.5, np.abs(x - 0.5))
    apart = np.maximum(x, 1.0)
    beyond = (apart + 0.5) * np.log1p(0.5 / apart) - (apart - 0.5) * np.log1p(-0.5 / apart)
    return np.where(x < 1.0, near, np.log(apart) + beyond) - 1.0


class StripHalfPlane(HalfPlane):
    """Pressures uniform over a pitch, displacements at its middle (Johnson 1985, eq. 2.30)."""

    def __init__(self, count, pitch, modulus, datum=None) -> None:
        super().__init__(count, pitch, modulus, datum)
        log_integral = strip_displacement(np.arange(count)) + np.log(pitch / self.datum)
        column = -2.0 * pitch**2 / (np.pi * modulus) * log_integral
        Convolution.__init__(self, column, self._symbol)

    def _symbol(self, cycles: np.ndarray) -> np.ndarray:
        """The transform of a strip is sinc."""
        c = np.where(cycles == 0.0, 0.5 * cycles[1], cycles)  # the mean: any positive value
        seen = np.sin(np.pi * c) / np.pi * (c**-2 + (1.0 - c) ** -2 - (1.0 + c) ** -2)
        return self.pitch**2 / (np.pi * self.modulus) * seen


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


def strip_stress(x: ArrayLike, z: ArrayLike, half_width: float) -> FrictionStress:
    """Stresses under unit p and q on |x| < half_width a, at x, z [m] (broadcast together), z >= 0.

    Each of them is known to rounding. On the surface the ends belong half to the strip, and sx
    under q is infinite there. Of Bailey and Sayles 1991, eq. (1) and (2), with t1, t2 =
    atan2(z, x - a), atan2(z, x + a), D = t1 - t2 and S = t1 + t2:

        sz, sx = -(1/pi) {(D - sin D) + 2 sin D (sin^2, cos^2)(S/2)}, txz = -(1/pi) sin S sin D,
    and with v = sinh ln(r2/r1) = 2 a x/(r1 r2), sx under q = -(2/pi) (asinh v - v z^2/(r1 r2)).
    """
    x, z = points_below(x, z)
    left, right = x + half_width, x - half_width
    side, x = np.where(x < 0.0, -1.0, 1.0), np.abs(x)
    left, right = np.where(side < 0.0, -right, left), np.where(side < 0.0, -left, right)
    product = np.hypot(left, z) * np.hypot(right, z)
    end = product == 0.0
    product = np.where(end, 1.0, product)
    angle = np.arctan2((left - right) * z, left * right + z**2)
    sine = (left - right) * z / product
    sine_sum = 2.0 * x * z / product
    half = 0.5 * (np.arctan2(z, left) + np.arctan2(z, right))
    upright = np.sin(half)
    # Below the strip's centre S nears pi, where its cosine would lose what sin S still holds.
    steep = half > 0.25 * np.pi
    flat = np.where(steep, 0.5 * sine_sum / np.where(steep, upright, 1.0), np.cos(half))
    rest = np.where(end, 0.5 * np.pi, angle_minus_sine(angle))
    return FrictionStress(
        normal=StressState(
            sx=-(rest + 2.0 * sine * flat**2) / np.pi,
            sz=-(rest + 2.0 * sine * upright**2) / np.pi,
            txz=-side * sine_sum * sine / np.pi,
        ),
        traction_sx=-side * np.where(end, np.inf, _strip_stretch(left, x, right, z, product)),
    )


def stress_of_strips(
    x_nodes: np.ndarray, pressure: np.ndarray, friction: float, x: ArrayLike, z: ArrayLike
) -> StressState:
    """Stresses [Pa] under strips about uniform nodes (n,) [m], q = friction p; x, z as above."""
    half_width = 0.5 * (x_nodes[1] - x_nodes[0])
    strips = (strip_stress(x - node, z, half_width).at(friction).parts for node in x_nodes)
    return StressState(*sum(p * parts for p, parts in zip(pressure, strips, strict=True)))


def _strip_stretch(
    left: np.ndarray, x: np.ndarray, right: np.ndarray, z: np.ndarray, product: np.ndarray
) -> np.ndarray:
    """(2/pi) (asinh v - v z^2/(r1 r2)), v = 2 a x/(r1 r2) >= 0, for `product` = r1 r2.
    Deep below the strip both terms tend to v: there v - asinh v is summed as a series, and
    1 - z^2/(r1 r2) formed from (r1 r2)^2 - z^4 = (x^2 - a^2)^2 + 2 z^2 (x^2 + a^2)."""
    v = (left - right) * x / product
    fraction = z**2 / product
    square = np.minimum(v, 0.1) ** 2
    series, coefficients = np.zeros_like(square), [1.0]
    for n in range(1, 9):
        coefficients.append(-coefficients[-1] * (2 * n - 1) / (2 * n))
    for n in range(8, 0, -1):
        series = square * (series + coefficients[n] / (2 * n + 1))
    fall = (left * right) ** 2 + z**2 * (left**2 + right**2)
    deep = v * (series + fall / (product * (product + z**2)))
    return 2.0 / np.pi * np.where(v < 0.1, deep, np.arcsinh(v) - v * fraction)
