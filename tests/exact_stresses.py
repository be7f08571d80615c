"""Closed forms beside those of `analytic`, for comparison: stresses, displacements, overlaps."""

from math import factorial

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipe, ellipk, roots_jacobi, xlogy

from analytic.exact.flattened_cylinder import FlattenedCylinder
from analytic.exact.sliding import SlidingContact
from analytic.exact.westergaard import WestergaardContact
from analytic.layers.layered import LayeredBody, added_stress
from analytic.numerics import points_below
from analytic.stress.elements import FrictionStress, hat_at
from analytic.stress_state import StressState


def sliding_stress(contact: SlidingContact, x: ArrayLike, z: ArrayLike) -> StressState:
    """Stresses [Pa] at x, z [m] (broadcast together), z >= h/10: line loads at 400 points of Gauss
    and Jacobi, whose weight is the pressure itself."""
    x, z = points_below(x, z)
    n, h = contact.exponent_shift, contact.half_width
    point, weight = roots_jacobi(400, 0.5 + n, 0.5 - n)
    load = -2.0 / np.pi * contact.load_per_length * weight / weight.sum()
    along, depth = x[..., None] - 0.5 * sum(contact.edges) - h * point, z[..., None]
    kernel = load / (along**2 + depth**2) ** 2
    sz, txz, sx, drag = (np.sum(kernel * along**k, axis=-1) * z ** (3 - k) for k in range(4))
    mu = contact.friction
    return StressState(sx=sx + mu * drag, sz=sz + mu * txz, txz=txz + mu * sx)


def westergaard_gap(contact: WestergaardContact, x: ArrayLike) -> np.ndarray:
    """Separation of the deformed surfaces [m] at x [m] from a crest.

    g = 2 A S^2 (sinh tau cosh tau - tau) where sin psi = S cosh tau outside the contact.
    """
    x = contact._folded(x)
    if contact.full:
        return np.zeros_like(x)
    depth = np.sqrt(np.maximum(contact._beyond(x), 0.0))
    sine = np.sin(np.pi * contact.half_width / contact.wavelength)
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


def hat_stress(x: ArrayLike, z: ArrayLike, pitch: float) -> FrictionStress:
    """Stress under unit p and q at x = 0, linear to zero at -pitch, pitch; x, z >= 0 [m]."""
    x, z = points_below(x, z)
    return hat_at(x / pitch, z / pitch)


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

    int_{-1}^{1} (1-|s|) ln|x-s| ds, the displacement under a hat at one x.
    """
    x, order = np.abs(np.asarray(offset, dtype=float))[..., None], 2.0 * np.arange(1, 49)
    apart, unit = np.maximum(x, 1.5), x + 1.0
    moments = 2.0 / (order * (order + 1.0) * (order + 2.0))
    far = np.log(apart[..., 0]) - np.sum((moments * apart**-order)[..., ::-1], axis=-1)
    y = x + np.array([1.0, 0.0, -1.0])
    closed = 0.5 * xlogy(y**2, np.abs(y) / unit) @ np.array([1.0, -2.0, 1.0])
    return np.where(x[..., 0] < 1.5, closed + np.log(unit[..., 0]) - 1.5, far)
