"""Half-plane under a line load, a uniform strip and a triangle, normal and tangential.

    P, Q at x = 0             line load [N/m]
    p, q on |x| < a           uniform strip [Pa]
    p, q at x = 0, linear to zero at -a and a    triangle [Pa]

P and p press into the body, Q and q act on it in +x; r, t distance and angle from x, r1, t1 from
x - a and r2, t2 from x + a, t = atan2(z, x). Stresses, tension positive (Johnson 1985, sections
2.2 to 2.5; the strip's also Bailey and Sayles 1991, eq. 1 and 2):

    line      sx, txz, sz = -(2/pi) (x^2 z, x z^2, z^3) P/r^4
              sx, txz, sz = -(2/pi) (x^3, x^2 z, x z^2) Q/r^4
    strip     sx, sz = -(p/2pi) (2 (t1-t2) +- (sin 2t1 - sin 2t2))
              txz = (p/2pi) (cos 2t1 - cos 2t2)
              sx = (q/2pi) (4 ln(r1/r2) - (cos 2t1 - cos 2t2))
    triangle  sz = (p/pi a) ((x-a) t1 + (x+a) t2 - 2 x t),  sx = sz + (2 p z/pi a) ln(r1 r2/r^2)
              txz = -(p z/pi a) (t1 + t2 - 2 t)
              sx = (q/pi a) (3 z (t1+t2-2t) - 2 ((x-a) ln r1 + (x+a) ln r2 - 2 x ln r))

and sz, txz under q are txz, sx under p. Those of strip and triangle are sums of terms that cancel:
as printed they are right to rounding of p and q. From 3 a on, stresses and displacements are those
of the loads at Gauss's points instead, which keeps the digits of each at any distance.

Surface displacements in plane strain, G shear modulus, nu Poisson's ratio, with
L = int p ln|x - s| ds and J = int p sgn(x - s) ds of the load (Johnson's sections again):

    into the body  -((1-nu)/(pi G)) L(p) + ((1-2nu)/(4G)) J(q)
    along x        -((1-nu)/(pi G)) L(q) - ((1-2nu)/(4G)) J(p)

The logarithm's zero is at the datum, a distance from x = 0 on either side; the load's own size
sets how deep the half-plane moves otherwise, so only differences mean anything.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import xlogy

from analytic.material import Material
from analytic.stress_state import StressState

_FAR = 3.0  # distance from the middle in a, from which Gauss's points stand for the load
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)  # (3 + sqrt 8)^-48 is left out there

_Curve = Callable[[np.ndarray], np.ndarray]
_Parts = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class SurfaceDisplacement:
    """Of the surface [m]: `along` in +x, `into` the body."""

    along: np.ndarray
    into: np.ndarray


def line_load_stress(normal: float, tangential: float, x: ArrayLike, z: ArrayLike) -> StressState:
    """Stresses [Pa] at x, z [m], z >= 0, under P and Q [N/m] at x = 0, where all are infinite.

    Raises ValueError for z < 0 and at the load itself.
    """
    x, z = _points(x, z)
    if np.any((x == 0.0) & (z == 0.0)):
        raise ValueError("the stresses are infinite under the line load itself")
    return _combined(_line(x, z), normal, tangential)


def strip_load_stress(
    half_width: float, normal: float, tangential: float, x: ArrayLike, z: ArrayLike
) -> StressState:
    """Stresses [Pa] at x, z [m], z >= 0, under p and q [Pa] on |x| < half_width a [m].

    On the surface the ends belong half to the strip, and sx under q is infinite there.
    Raises ValueError for z < 0.
    """
    x, z = _points(x, z)
    parts = _near_and_far(_strip, np.ones_like, x / half_width, z / half_width)
    return _combined(parts, normal, tangential)


def triangle_load_stress(
    half_width: float, normal: float, tangential: float, x: ArrayLike, z: ArrayLike
) -> StressState:
    """Stresses [Pa] at x, z [m], z >= 0, under p and q [Pa] at x = 0, zero from half_width a on.

    Finite everywhere. Raises ValueError for z < 0.
    """
    x, z = _points(x, z)
    parts = _near_and_far(_triangle, _tent, x / half_width, z / half_width)
    return _combined(parts, normal, tangential)


def line_load_displacement(
    normal: float, tangential: float, x: ArrayLike, body: Material, datum: float
) -> SurfaceDisplacement:
    """Surface displacements at x [m] under P and Q [N/m] at x = 0; the logarithm's zero at `datum`.

    Infinite at the load.
    """
    x = np.asarray(x, dtype=float)
    with np.errstate(divide="ignore"):
        return _displacement(np.log(np.abs(x) / datum), np.sign(x), normal, tangential, body)


def strip_load_displacement(
    half_width: float, normal: float, tangential: float, x: ArrayLike, body: Material, datum: float
) -> SurfaceDisplacement:
    """Surface displacements at x [m] under p and q [Pa] on |x| < half_width.

    The logarithm's zero is at `datum`; all lengths in m.
    """

    def closed(y: np.ndarray) -> np.ndarray:
        return xlogy(y + 1.0, abs(y + 1.0)) - xlogy(y - 1.0, abs(y - 1.0)) - 2.0

    y = np.asarray(x, dtype=float) / half_width
    return _displacement(
        half_width * _log_above_datum(closed, np.ones_like, y, datum / half_width),
        2.0 * half_width * np.clip(y, -1.0, 1.0),
        normal,
        tangential,
        body,
    )


def triangle_load_displacement(
    half_width: float, normal: float, tangential: float, x: ArrayLike, body: Material, datum: float
) -> SurfaceDisplacement:
    """Surface displacements at x [m] under p and q [Pa] at x = 0 that vanish from half_width on.

    The logarithm's zero is at `datum`; all lengths in m.
    """

    def closed(y: np.ndarray) -> np.ndarray:
        ends = xlogy((y + 1.0) ** 2, abs(y + 1.0)) + xlogy((y - 1.0) ** 2, abs(y - 1.0))
        return 0.5 * ends - xlogy(y**2, abs(y)) - 1.5

    y = np.asarray(x, dtype=float) / half_width
    inside = np.clip(y, -1.0, 1.0)
    return _displacement(
        half_width * _log_above_datum(closed, _tent, y, datum / half_width),
        half_width * inside * (2.0 - np.abs(inside)),
        normal,
        tangential,
        body,
    )


def _log_above_datum(closed: _Curve, load: _Curve, y: np.ndarray, datum: float) -> np.ndarray:
    """int load(s) ln|y - s| ds less its value at the datum; lengths in a."""
    places = np.append(y, datum)
    value = np.empty_like(places)
    far = np.abs(places) > _FAR
    value[~far] = closed(places[~far])
    value[far] = sum(
        weight * load(node) * np.log(np.abs(places[far] - node)) for node, weight in _gauss()
    )
    return (value[:-1] - value[-1]).reshape(y.shape)


def _displacement(
    logarithm: np.ndarray, sign: np.ndarray, normal: float, tangential: float, body: Material
) -> SurfaceDisplacement:
    """From L and J [m] of unit loads."""
    shear, nu = body.shear_modulus, body.poissons_ratio
    log_part = -(1.0 - nu) / (np.pi * shear) * logarithm
    sign_part = (1.0 - 2.0 * nu) / (4.0 * shear) * sign
    return SurfaceDisplacement(
        along=tangential * log_part - normal * sign_part,
        into=normal * log_part + tangential * sign_part,
    )


def _combined(parts: np.ndarray, normal: float, tangential: float) -> StressState:
    """From sx, sz, txz under a unit pressure and sx under a unit traction."""
    sx, sz, txz, sx_traction = parts
    if tangential == 0.0:  # the traction's sx may be infinite
        return StressState(normal * sx, normal * sz, normal * txz)
    return StressState(
        sx=normal * sx + tangential * sx_traction,
        sz=normal * sz + tangential * txz,
        txz=normal * txz + tangential * sx,
    )


def _near_and_far(closed: _Parts, load: _Curve, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The four parts (4, …), lengths in a: `closed` near the load, its Gauss points beyond."""
    parts = np.empty((4, *x.shape))
    far = np.hypot(x, z) > _FAR
    parts[:, ~far] = closed(x[~far], z[~far])
    parts[:, far] = 0.0
    for node, weight in _gauss():
        parts[:, far] += weight * load(node) * _line(x[far] - node, z[far])
    return parts


def _gauss() -> Iterator[tuple[float, float]]:
    """Points and weights over |s| < 1 by halves, so that a kink in the middle does no harm."""
    for middle in (-0.5, 0.5):
        yield from zip(middle + 0.5 * _NODES, 0.5 * _WEIGHTS, strict=True)


def _tent(point: np.ndarray) -> np.ndarray:
    return 1.0 - np.abs(point)


def _line(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The four parts (4, …) of a unit line load."""
    cosine, sine = x / np.hypot(x, z), z / np.hypot(x, z)
    parts = np.stack([cosine**2 * sine, sine**3, cosine * sine**2, cosine**3])
    return -2.0 / np.pi * parts / np.hypot(x, z)


def _strip(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The four parts (4, …) of a uniform strip."""
    t1, t2 = np.arctan2(z, x - 1.0), np.arctan2(z, x + 1.0)
    # an end of the strip on the surface is halfway between its inside and its outside
    t1 = np.where((z == 0.0) & (x == 1.0), 0.5 * np.pi, t1)
    t2 = np.where((z == 0.0) & (x == -1.0), 0.5 * np.pi, t2)
    sines, cosines = np.sin(2.0 * t1) - np.sin(2.0 * t2), np.cos(2.0 * t1) - np.cos(2.0 * t2)
    with np.errstate(divide="ignore"):
        stretch = 4.0 * (np.log(np.hypot(x - 1.0, z)) - np.log(np.hypot(x + 1.0, z)))
    return np.stack(
        [-2.0 * (t1 - t2) - sines, -2.0 * (t1 - t2) + sines, cosines, stretch - cosines]
    ) / (2.0 * np.pi)


def _triangle(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The four parts (4, …) of a triangle."""
    places = (x - 1.0, x + 1.0, x)
    t1, t2, t = (np.arctan2(z, y) for y in places)
    r1, r2, r = (np.hypot(y, z) for y in places)
    level = (x - 1.0) * t1 + (x + 1.0) * t2 - 2.0 * x * t
    turn = z * (t1 + t2 - 2.0 * t)
    logs = xlogy(z, r1) + xlogy(z, r2) - 2.0 * xlogy(z, r)
    stretch = xlogy(x - 1.0, r1) + xlogy(x + 1.0, r2) - 2.0 * xlogy(x, r)
    return np.stack([level + 2.0 * logs, level, -turn, 3.0 * turn - 2.0 * stretch]) / np.pi


def _points(x: ArrayLike, z: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
    if np.any(z < 0.0):
        raise ValueError("z must not be negative: it points into the body")
    return x, z
