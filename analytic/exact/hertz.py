"""Line contact of a smooth cylinder on a half-plane: pressure and stresses, sliding or not.

Nomenclature: a half-width [m], p0 peak pressure [Pa], P load per length [N/m], R radius of
relative curvature [m], E* combined modulus [Pa], mu friction coefficient. In units of a and p0:
w = x + i z, s = sqrt(w-1) sqrt(w+1) = n + i m, and the potential of the pressure

    I(w) = (1/pi) int p(t)/(w - t) dt = w - s = 1/(w + s) = B - i A.

The stresses are sx = Im I + z Re I', sz = Im I - z Re I', txz = -z Im I' under the pressure and
-2 Re I + z Im I', -z Im I', Im I + z Re I' under a traction of the same shape that acts in +x.
With I' = -I/s and the identities z = m - A, A n = B z they turn into

    sx = -A (2n^2 + A m)/|s|^2     sz = -A m (m + z)/|s|^2     txz = -A n (m + z)/|s|^2
    sx = -B (2n^2 + A (2m + z))/|s|^2,  sz = txz above,  txz = sx above,

where A, m >= 0 and n, B have the sign of x: no two terms of a sum differ in sign, so each
component is right to rounding on the surface, at the edges and at any distance.
m and n are those of McEwen (Johnson 1985, eq. 4.49-4.50); pressure and load eq. 4.43-4.45."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import root

from analytic.numerics import check_positive, points_below
from analytic.stress_state import Extremum, StressState

_OfShear = Callable[[np.ndarray], np.ndarray]
_OfSlope = Callable[[complex, np.ndarray], np.ndarray]

_GOLDEN = (1.0 + np.sqrt(5.0)) / 2.0
# By extreme: value of the shear `_shear`, slope of the value, and sign that the value has there.
_EXTREMES = {
    "tau1": (np.abs, lambda shear, slope: (np.conj(shear) * slope).real, 1.0),
    "txz_max": (np.imag, lambda shear, slope: slope.imag, 1.0),
    "txz_min": (lambda shear: -shear.imag, lambda shear, slope: -slope.imag, -1.0),
}


@dataclass(frozen=True)
class HertzContact:
    """A smooth line contact: half_width a [m], peak_pressure p0 [Pa], load_per_length P [N/m],
    radius R [m] of relative curvature, combined_modulus E* [Pa]."""

    half_width: float
    peak_pressure: float
    load_per_length: float
    radius: float
    combined_modulus: float

    def pressure(self, x: ArrayLike) -> np.ndarray:
        """p0 sqrt(1 - x^2/a^2) [Pa] at x [m] from the centre, zero outside the contact."""
        ratio = np.abs(np.asarray(x, dtype=float)) / self.half_width
        return self.peak_pressure * np.sqrt(np.maximum((1.0 - ratio) * (1.0 + ratio), 0.0))

    @property
    def tau1_max(self) -> float:
        """Largest principal shear without friction [Pa]: p0 / g^(5/2), g the golden ratio."""
        return self.peak_pressure * _GOLDEN**-2.5

    @property
    def tau1_max_depth(self) -> float:
        """Depth [m], a / sqrt(g), of the largest (p0/a) (z - z^2/sqrt(a^2 + z^2)) on the axis."""
        return self.half_width / np.sqrt(_GOLDEN)


@dataclass(frozen=True)
class HertzExtremes:
    """Largest tau1 >= 0, largest and smallest txz of the whole field under one friction."""

    tau1: Extremum
    txz_max: Extremum
    txz_min: Extremum


def hertz_from_load(load_per_length: float, radius: float, combined_modulus: float) -> HertzContact:
    """Contact under P [N/m] with R [m] and E* [Pa]: a^2 = 4 P R/(pi E*), p0 = 2 P/(pi a). Raises
    ValueError unless all three are positive."""
    check_positive(
        load_per_length=load_per_length, radius=radius, combined_modulus=combined_modulus
    )
    half_width = np.sqrt(4.0 * load_per_length * radius / (np.pi * combined_modulus))
    peak = 2.0 * load_per_length / (np.pi * half_width)
    return HertzContact(float(half_width), float(peak), load_per_length, radius, combined_modulus)


def hertz_from_peak_pressure(
    peak_pressure: float, radius: float, combined_modulus: float
) -> HertzContact:
    """Contact with p0 [Pa], R [m], E* [Pa] > 0 (else ValueError): a = 2 R p0/E*, P = pi a p0/2."""
    check_positive(peak_pressure=peak_pressure, radius=radius, combined_modulus=combined_modulus)
    half_width = 2.0 * radius * peak_pressure / combined_modulus
    load = 0.5 * np.pi * half_width * peak_pressure
    return HertzContact(half_width, peak_pressure, float(load), radius, combined_modulus)


def hertz_stress(
    hertz: HertzContact, x: ArrayLike, z: ArrayLike, friction: float = 0.0
) -> StressState:
    """Stresses [Pa] at x, z [m] (broadcast together), z >= 0, under p and q = friction p in +x.
    On the surface sz = -p and txz = -friction p; at the very edge x = -a, a the limit from the
    surface is taken, where all but the sx of the traction vanish. Raises ValueError for z < 0."""
    x, z = points_below(x, z)
    a, side = hertz.half_width, np.copysign(1.0, x)
    x, depth = np.abs(x), z / a
    # x - a before the division: next to the edge only the difference of the given numbers is exact.
    left, right, x = (x + a) / a, (x - a) / a, x / a
    s = np.sqrt(_complex(right, depth)) * np.sqrt(_complex(left, depth))
    m = s.imag
    n = np.where(m > 0.0, x * depth / np.where(m > 0.0, m, 1.0), s.real)
    square = (x + n) ** 2 + (depth + m) ** 2
    big_a, big_b = (depth + m) / square, (x + n) / square
    modulus = np.hypot(right, depth) * np.hypot(left, depth)
    edge = modulus == 0.0
    over = big_a / np.where(edge, 1.0, modulus)
    sx = -over * (2.0 * n**2 + big_a * m)
    sz = -over * m * (m + depth)
    txz = -over * n * (m + depth) * side
    stretch = (2.0 * n**2 + big_a * (2.0 * m + depth)) / np.where(edge, 1.0, modulus)
    sx_traction = -big_b * np.where(edge, 2.0, stretch) * side
    p0 = hertz.peak_pressure
    return StressState(
        sx=p0 * (sx + friction * sx_traction),
        sz=p0 * (sz + friction * txz),
        txz=p0 * (txz + friction * sx),
    )


def hertz_extremes(hertz: HertzContact, friction: float = 0.0) -> HertzExtremes:
    """Largest tau1 and the extremes of txz over the half-plane, positions to 1e-10 a.
    On the surface tau1 = |mu| p0 all over the contact and txz is -mu p0 at its centre; where
    that exceeds every value below, the centre is returned. Raises RuntimeError if the search
    for the point of zero gradient fails."""
    p0, a = hertz.peak_pressure, hertz.half_width

    def extremum(value: _OfShear, slope: _OfSlope, sign: float) -> Extremum:
        peak, x, z = _highest(friction, value, slope)
        return Extremum(float(sign * p0 * peak), float(a * x), float(a * z))

    return HertzExtremes(**{name: extremum(*how) for name, how in _EXTREMES.items()})


@cache
def _highest(friction: float, value: _OfShear, slope: _OfSlope) -> tuple[float, float, float]:
    """Largest `value` of the shear, and x, z [a] of it: best of a grid, then zero gradient. With
    much friction the positive peak of txz moves down like mu, and the grid with it."""
    depth = np.geomspace(1e-3, 10.0 * (1.0 + abs(friction)), 300)[:, None]
    x = np.linspace(-3.0, 3.0, 241)[None, :]
    heights = value(_shear(x, depth, friction)[0])
    row, column = np.unravel_index(np.argmax(heights), heights.shape)
    centre = float(value(_shear(0.0, 0.0, friction)[0]))
    if heights[row, column] <= centre:
        return centre, 0.0, 0.0

    def gradient(point: np.ndarray) -> np.ndarray:
        shear, along, down = _shear(point[0], abs(point[1]), friction)
        return np.array([slope(shear, along), slope(shear, down)])

    stationary = root(gradient, [x[0, column], depth[row, 0]], tol=1e-14)
    peak = float(value(_shear(stationary.x[0], abs(stationary.x[1]), friction)[0]))
    if np.max(np.abs(gradient(stationary.x))) > 1e-12 or peak < heights[row, column]:
        raise RuntimeError(f"no stationary shear found for friction {friction:g}")
    return peak, stationary.x[0], abs(stationary.x[1])


def _shear(
    x: ArrayLike, z: ArrayLike, friction: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(sz - sx)/2 + i txz and its derivatives in x and z; lengths in a, stresses in p0.
    = mu I + (i mu - 1) z I', with I' = -I/s and I'' = 1/s^3."""
    s = np.sqrt(_complex(np.subtract(x, 1.0), z)) * np.sqrt(_complex(np.add(x, 1.0), z))
    potential = 1.0 / (_complex(x, z) + s)
    first, second, factor = -potential / s, s**-3.0, 1j * friction - 1.0
    along = friction * first + factor * z * second
    down = 1j * friction * first + factor * (first + 1j * z * second)
    return friction * potential + factor * z * first, along, down


def _complex(real: ArrayLike, imaginary: ArrayLike) -> np.ndarray:
    """real + i imaginary with an imaginary zero of positive sign: the body's side of the cut."""
    real, imaginary = np.broadcast_arrays(real, imaginary)
    number = np.empty(real.shape, dtype=complex)
    number.real, number.imag = real, np.abs(imaginary)
    return number
