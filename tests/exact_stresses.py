"""Closed forms beside those of `analytic.exact`, for comparison: stresses, gaps and overlaps.

The stresses follow from the potential I(w) = (1/pi) int p(t)/(w - t) dt of the pressure as in
`analytic.exact.hertz`; symbols as in the modules of the contacts.

sliding   I = (E*/2R) (w - (w - c)^f (w + b)^r)
wavy      I = (1/lambda) int p(t) cot(pi (w - t)/lambda) dt = 2 p* cos theta (sin theta - s),
          dI/dtheta = -2 p* (sin theta - s) (1 - sin theta (sin theta - s))/s,
          s = sqrt(sin^2 theta - S^2), theta = pi (x + i z)/lambda;
          with W = sin theta/S and W - s/S = B - i A' both parts of Im I have one sign
"""

from math import factorial

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipe, ellipk, roots_jacobi, xlogy

from analytic.exact.flattened_cylinder import FlattenedCylinder
from analytic.exact.sliding import SlidingContact
from analytic.exact.westergaard import WestergaardContact
from analytic.layers.layered import LayeredBody, added_stress
from analytic.numerics import points_below
from analytic.stress.elements import FrictionStress, hat_at, strip_between
from analytic.stress_state import StressState

# Distance from the centre, in h, from which the loads of Gauss-Jacobi's points are summed: with 32
# points the remainder is below (2 - sqrt 3)^64.
_FAR, _POINTS = 2.0, 32
# Depth pi z/lambda from which nothing of the wave is left and its hyperbolic functions overflow.
_DEEP = 300.0


def sliding_stress(contact: SlidingContact, x: ArrayLike, z: ArrayLike) -> StressState:
    """Stresses [Pa] in the half-plane at x, z [m] (broadcast together), z >= 0.

    Right to rounding of the pressure's potential near the contact, of each component far away.
    At the very edges all but the sx of the traction vanish. Raises ValueError for z < 0.
    """
    x, z = points_below(x, z)
    h, (left, right) = contact.half_width, contact.edges
    parts = np.empty((4, *x.shape))
    far = np.hypot(x - 0.5 * (left + right), z) > _FAR * h
    parts[:, far] = _summed(contact, x[far], z[far])
    near = ~far
    parts[:, near] = _closed(contact, (x[near] - left) / h, (x[near] - right) / h, z[near] / h)
    sx, sz, txz, sx_traction = parts
    mu = contact.friction
    return StressState(sx=sx + mu * sx_traction, sz=sz + mu * txz, txz=txz + mu * sx)


def _closed(
    contact: SlidingContact, rear: np.ndarray, front: np.ndarray, z: np.ndarray
) -> np.ndarray:
    """sx, sz, txz under p and sx under q = p (4, n) [Pa]; x + b, x - c and z in h."""
    n = contact.exponent_shift
    product = _power(front, z, 0.5 + n) * _power(rear, z, 0.5 - n)
    # The pressure's own scale brings its cosine, which the potential has not.
    scale = contact.combined_modulus * contact.half_width / (2.0 * contact.radius)
    apex = 0.5 * (rear + front) - 2.0 * n
    potential = apex + 1j * z - product
    square = (rear + 1j * z) * (front + 1j * z)
    edge = square == 0.0
    slope = 1.0 - product * (apex + 4.0 * n + 1j * z) / np.where(edge, 1.0, square)
    stretch = np.where(edge, 0.0, z * slope)
    return scale * np.stack(
        [
            potential.imag + stretch.real,
            potential.imag - stretch.real,
            -stretch.imag,
            stretch.imag - 2.0 * potential.real,
        ]
    )


def _summed(contact: SlidingContact, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The same (4, n) [Pa] by x and z [m]: line loads at the points of Gauss and Jacobi."""
    n, h = contact.exponent_shift, contact.half_width
    point, weight = roots_jacobi(_POINTS, 0.5 + n, 0.5 - n)
    along = x[:, None] - 0.5 * sum(contact.edges) - h * point
    depth = z[:, None]
    square = along**2 + depth**2
    kernel = -2.0 / np.pi * contact._scale * h * weight / square**2
    return np.stack(
        [np.sum(kernel * along**power * depth ** (3 - power), axis=1) for power in (2, 0, 1, 3)]
    )


def _power(real: np.ndarray, imaginary: np.ndarray, exponent: float) -> np.ndarray:
    """(real + i imaginary)^exponent in the upper half-plane, its edge included."""
    angle = exponent * np.arctan2(imaginary, real)
    return np.hypot(real, imaginary) ** exponent * (np.cos(angle) + 1j * np.sin(angle))


def westergaard_stress(
    contact: WestergaardContact,
    x: ArrayLike,
    z: ArrayLike,
    friction: float = 0.0,
    mean_sx: float | None = None,
) -> StressState:
    """Stresses [Pa] at x, z [m] (broadcast together), z >= 0, under p and q = friction p in +x.

    mean_sx  average of sx over a wavelength [Pa], the same at every depth, which the loads leave
             open; default -pm, the sum of the line loads' own fields. A body that cannot
             stretch sideways has -pm nu/(1 - nu).

    Errors are of the order of rounding times the largest of the pressure's potential and its
    gradient times z at the point. At the very edge, as in `hertz_stress`, the limit from the
    surface is taken. Raises ValueError for z < 0.
    """
    x, z = points_below(x, z)
    wave = np.fmod(np.abs(x), contact.wavelength)
    side = np.copysign(1.0, x) * np.where(wave > 0.5 * contact.wavelength, -1.0, 1.0)
    place = np.minimum(wave, contact.wavelength - wave)
    eta = np.pi * z / contact.wavelength
    potential, stretch = (_full if contact.full else _partial)(contact, place, eta)
    along, across = stretch.real, stretch.imag * side
    sx, sz, txz = potential.imag + along, potential.imag - along, -across
    sx_traction = side * (stretch.imag - 2.0 * potential.real)
    offset = 0.0 if mean_sx is None else mean_sx + contact.mean_pressure
    return StressState(
        sx=sx + friction * sx_traction + offset,
        sz=sz + friction * txz,
        txz=txz + friction * sx,
    )


def _full(
    contact: WestergaardContact, x: np.ndarray, eta: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """I = -i (pm + p* exp 2 i theta) and z I' [Pa]."""
    wave = contact.closing_pressure * np.exp(2.0 * (1j * np.pi * x / contact.wavelength - eta))
    return -1j * (contact.mean_pressure + wave), 2.0 * eta * wave


def _partial(
    contact: WestergaardContact, x: np.ndarray, eta: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """I and z I' [Pa] at 0 <= x <= lambda/2."""
    unit, a, sine = np.pi / contact.wavelength, contact.half_width, _sine(contact)
    depth, half = np.minimum(eta, _DEEP), 0.5 * contact.wavelength
    # The cosine as a sine of the distance to the valley: next to it only that is exact.
    sin_psi, cos_psi = np.sin(unit * x), np.sin(unit * (half - x))
    middle, beyond = 0.5 * unit * (x + a), 0.5 * unit * (x - a)
    rise = 2.0 * sin_psi * np.sinh(0.5 * depth) ** 2  # sin psi (cosh eta - 1)
    right = (2.0 * np.sin(beyond) * np.cos(middle) + rise) / sine
    left = (2.0 * np.sin(middle) * np.cos(beyond) + rise) / sine
    real, imaginary = sin_psi * np.cosh(depth) / sine, cos_psi * np.sinh(depth) / sine
    root = np.sqrt(right + 1j * imaginary) * np.sqrt(left + 1j * imaginary)
    m = root.imag
    n = np.where(m > 0.0, real * imaginary / np.where(m > 0.0, m, 1.0), root.real)
    edge = (m == 0.0) & (n == 0.0)
    square = (real + n) ** 2 + (imaginary + m) ** 2
    shape = (real + n - 1j * (imaginary + m)) / square
    cosine = cos_psi * np.cosh(depth) - 1j * sin_psi * np.sinh(depth)
    scale = 2.0 * contact.closing_pressure
    root, place = n + 1j * m, real + 1j * imaginary
    # 1 - sin theta (sin theta - s), near the surface as sin theta s + cos^2 theta: there it may be
    # small, while deep below those two are large.
    shallow = depth < 1.0
    factor = np.where(
        shallow,
        sine**2 * place * root + np.where(shallow, cosine, 0.0) ** 2,
        1.0 - sine**2 * place * shape,
    )
    slope = shape / np.where(edge, 1.0, root) * factor
    return scale * sine * cosine * shape, -scale * eta * slope


def westergaard_gap(contact: WestergaardContact, x: ArrayLike) -> np.ndarray:
    """Separation of the deformed surfaces [m] at x [m] from a crest.

    g = 2 A S^2 (sinh tau cosh tau - tau) where sin psi = S cosh tau outside the contact.
    """
    x = contact._folded(x)
    if contact.full:
        return np.zeros_like(x)
    depth = np.sqrt(np.maximum(contact._beyond(x), 0.0))
    sine = _sine(contact)
    tau = np.arcsinh(depth / sine)
    near = 0.5 * sine**2 * _sinh_minus_argument(2.0 * np.minimum(tau, 1.0))
    far = depth * np.hypot(depth, sine) - sine**2 * tau
    return 2.0 * contact.amplitude * np.where(tau < 1.0, near, far)


def _sinh_minus_argument(y: np.ndarray) -> np.ndarray:
    """sinh y - y for y >= 0."""
    series = sum(y ** (2 * n + 1) / factorial(2 * n + 1) for n in range(1, 12))
    return np.where(y < 1.0, series, np.sinh(y) - y)


def largest_overlap(flat: FlattenedCylinder) -> float:
    """d in the middle of a flattened cylinder [m]."""
    b, c, arc = flat.contact, flat.flowed, np.arctanh(flat.flowed / flat.contact)
    return float((0.5 * ((b**2 + c**2) * arc - b * c) - _level(flat) * arc) / flat.radius)


def flowed_volume(flat: FlattenedCylinder) -> float:
    """int d dx over the flowed stretch of a flattened cylinder [m^2]."""
    b, m = flat.contact, (flat.flowed / flat.contact) ** 2
    first, second = ellipk(m), ellipe(m)
    fourth_moment = b**3 * ((2.0 + m) * first - 2.0 * (1.0 + m) * second) / 3.0
    return float((fourth_moment - _level(flat) * b * (first - second)) / flat.radius)


def _level(flat: FlattenedCylinder) -> float:
    """L [m^2]."""
    m = (flat.flowed / flat.contact) ** 2
    return flat.contact**2 * (1.0 - ellipe(m) / ellipk(m))


def _sine(contact: WestergaardContact) -> float:
    """S = sin(pi a/lambda)."""
    return np.sin(np.pi * contact.half_width / contact.wavelength)


def hat_stress(x: ArrayLike, z: ArrayLike, pitch: float) -> FrictionStress:
    """Under unit p and q at x = 0 that fall linearly to zero at -pitch, pitch; x, z >= 0 [m]."""
    x, z = points_below(x, z)
    return hat_at(x / pitch, z / pitch)


def strip_stress(x: ArrayLike, z: ArrayLike, half_width: float) -> FrictionStress:
    """Under unit p and unit q on |x| < half_width, at x, z [m] (broadcast together), z >= 0."""
    x, z = points_below(x, z)
    return strip_between(x + half_width, x, x - half_width, z)


def wave_stress(
    body: LayeredBody, wavenumber: ArrayLike, z: ArrayLike
) -> tuple[StressState, StressState]:
    """Stresses under p cos kx alone and under q sin kx alone, at depths 0 <= z <= t [m].

    k [1/m], k > 0, and z are broadcast together. Raises ValueError for a depth outside the layer.
    """
    k, z = np.broadcast_arrays(np.asarray(wavenumber, dtype=float), np.asarray(z, dtype=float))
    normal, traction = added_stress(body, k, z)
    depth, decay = k * z, np.exp(-k * z)
    return (
        StressState(
            normal.sx - (1.0 - depth) * decay,
            normal.sz - (1.0 + depth) * decay,
            normal.txz - depth * decay,
        ),
        StressState(
            traction.sx + (2.0 - depth) * decay,
            traction.sz + depth * decay,
            traction.txz - (1.0 - depth) * decay,
        ),
    )


def hat_displacement(offset: ArrayLike) -> np.ndarray:
    """L_h of `analytic.operators.elements` at `offset` [pitches], any shape.

    int_{-1}^{1} (1-|s|) ln|x-s| ds, the displacement under a hat at one place.
    """
    x, order = np.abs(np.asarray(offset, dtype=float))[..., None], 2.0 * np.arange(1, 49)
    apart, unit = np.maximum(x, 1.5), x + 1.0
    moments = 2.0 / (order * (order + 1.0) * (order + 2.0))
    far = np.log(apart[..., 0]) - np.sum((moments * apart**-order)[..., ::-1], axis=-1)
    y = x + np.array([1.0, 0.0, -1.0])
    closed = 0.5 * xlogy(y**2, np.abs(y) / unit) @ np.array([1.0, -2.0, 1.0])
    return np.where(x[..., 0] < 1.5, closed + np.log(unit[..., 0]) - 1.5, far)
