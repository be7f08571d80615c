"""Stresses in a layer under a line of hats, normal and tangential, on a free or a periodic line.

The field is that of a half-plane (`analytic.stress.field`) and what the base adds to it. Of a wave
the addition falls like e^-k(2t - z) (`analytic.layers.layered`): it is smooth, and so few waves
make it that they can be summed. On a periodic line, and on a rigid base by way of a long period,
they are those of an FFT; else the integral over k is taken on panels.

    h   pitch [m]      s   step of the grid [m]      t   thickness [m]      k   wavenumber [1/m]
    P   transform of the hats' pressure              w   k t
"""

from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from analytic.layers.kernel import finest_scale, wave_panels
from analytic.layers.layered import LayeredBody, added_stress
from analytic.stress.elements import uniform_pitch
from analytic.stress.field import StressField, friction_field
from analytic.stress_state import StressState

_FADED = 45.0  # w (2 - z/t) from which nothing is added: e^-45 45^2 is 6e-17
_FORGOTTEN = 55.0  # distance over t from which a rigid base leaves nothing
_LONG = 10  # times the grid that a period without images may hold
_BLOCK = 512  # waves at a time


@dataclass(frozen=True)
class LayerField:
    """Stresses [Pa] of shape (len(z), len(x)) under p alone and under q = p in +x alone."""

    x: np.ndarray
    z: np.ndarray
    normal: StressState
    traction: StressState

    def at(self, friction: float) -> StressField:
        """The field under p and q = friction * p in +x."""
        return StressField(self.x, self.z, self.normal.plus(friction, self.traction))


def layer_field(
    body: LayeredBody,
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    x_range: tuple[float, float],
    z: np.ndarray,
    subdivisions: int = 1,
    *,
    periodic: bool = False,
) -> LayerField:
    """Stresses in the layer on the levels z (k,) [m], ascending, 0 <= z <= t, within x_range.

    x_nodes (n,) [m] uniform and ascending, pressure (n,) [Pa] of hats, positive in compression.
    The grid contains the nodes' places and divides each pitch into `subdivisions`. On z = 0,
    sz = -p and txz = -q exactly. With `periodic` the nodes are one period of n pitches; the mean
    pressure acts as a very long wave does. On a frictionless base nothing holds a net traction Q
    but the layer itself: on a free line its two ends, sx = -+Q/2t far off, on a periodic one a
    force spread evenly over the layer, so that the mean of txz falls linearly to the base.

    Raises ValueError for input out of these bounds.
    """
    z = np.asarray(z, dtype=float)
    if np.any(z > body.thickness * (1.0 + 1e-12)):
        raise ValueError(f"levels must lie in the layer, down to {body.thickness:g} m")
    pressure = np.asarray(pressure, dtype=float)
    pitch = uniform_pitch(x_nodes, pressure)
    origin, ends = x_nodes[0], (min(x_range[0], x_nodes[0]), max(x_range[1], x_nodes[-1]))
    count = len(pressure)
    if not periodic and body.rigid:
        longest = (ends[1] - ends[0] + _FORGOTTEN * body.thickness) / pitch
        count = next_fast_len(int(np.ceil(longest)) + 2, real=True)
    by_period = periodic or (body.rigid and count <= _LONG * (ends[1] - ends[0]) / pitch)
    if by_period:
        pressure = np.pad(pressure, (0, count - len(pressure)))
        x_nodes = origin + pitch * np.arange(count)
    field = friction_field(x_nodes, pressure, x_range, z, subdivisions, periodic=by_period)
    normal, traction = field.stress.normal, field.stress.traction
    if by_period:
        columns = np.rint((field.x - origin) * (subdivisions / pitch)).astype(int)
        added = _by_period(body, pressure, pitch, subdivisions, columns, z)
        if body.base == "frictionless" and not periodic:  # the ends hold what the period spreads
            moment = np.sum(pressure) * field.x - x_nodes @ pressure
            added[3] -= moment / (count * body.thickness)
    else:
        added = _by_panels(body, x_nodes, pressure, pitch, field.x, z)
    return LayerField(
        field.x,
        field.z,
        normal.plus(1.0, StressState(*added[:3])),
        traction.plus(1.0, StressState(*added[3:])),
    )


def _by_period(
    body: LayeredBody,
    pressure: np.ndarray,
    pitch: float,
    subdivisions: int,
    columns: np.ndarray,
    z: np.ndarray,
) -> np.ndarray:
    """What the base adds (6, levels, columns) [Pa] under one period of pressures (n,), by FFT."""
    length = len(pressure) * subdivisions
    source = np.zeros(length)
    source[::subdivisions] = pressure
    spectrum = rfft(source)
    period = length * pitch / subdivisions
    highest = int(_FADED * period / (2.0 * np.pi * body.thickness)) + 1
    added = np.zeros((6, len(z), len(columns)))
    waves = np.arange(1, highest + 1)
    k = 2.0 * np.pi * waves / period
    share = subdivisions * np.sinc(waves * subdivisions / length) ** 2
    # wave f stands at f modulo the length, and above half of it as the conjugate of its mirror
    place = waves % length
    mirrored = place > length // 2
    place = np.where(mirrored, length - place, place)
    # of the two halves of a wave at half the length both fall on one place
    both = (place == 0) | (2 * place == length)
    for level, depth in enumerate(z):
        for row, values in enumerate(_rows(body, k, depth) * share):
            values = np.where(mirrored, values.conj(), values)
            values = np.where(both, 2.0 * values.real, values)
            kernel = np.bincount(place, values.real, len(spectrum)) + 1j * np.bincount(
                place, values.imag, len(spectrum)
            )
            kernel[0] += subdivisions * _mean(body, depth)[row]
            added[row, level] = irfft(kernel * spectrum, length)[columns % length]
    return added


def _by_panels(
    body: LayeredBody,
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    pitch: float,
    x: np.ndarray,
    z: np.ndarray,
) -> np.ndarray:
    """What the base adds (6, levels, columns) [Pa], (1/pi) Re int rows P e^ikx dk."""
    loaded = np.flatnonzero(pressure)
    added = np.zeros((6, len(z), len(x)))
    if len(loaded) == 0:
        return added
    nodes, pressure = x_nodes[loaded], pressure[loaded]
    middle = 0.5 * (nodes[0] + nodes[-1])
    far = max(abs(x[0] - middle), abs(x[-1] - middle)) + nodes[-1] - middle + 2.0 * pitch
    w, weights = wave_panels(_FADED, 2.0 * far / body.thickness, finest_scale(body.contrast))
    for first in range(0, len(w), _BLOCK):
        k = w[first : first + _BLOCK] / body.thickness
        share = weights[first : first + _BLOCK] * pitch / (np.pi * body.thickness)
        share = share * np.sinc(0.5 * k * pitch / np.pi) ** 2
        load = share * (np.exp(-1j * np.outer(k, nodes - middle)) @ pressure)
        rows = np.array([_rows(body, k, depth) for depth in z])  # (levels, 6, waves)
        field = (rows * load) @ np.exp(1j * np.outer(k, x - middle))
        added += field.real.transpose(1, 0, 2)
    return added


def _rows(body: LayeredBody, k: np.ndarray, depth: float) -> np.ndarray:
    """What the base adds to sx, sz, txz under p e^ikx and under q e^ikx, k > 0 (6, len(k))."""
    p, q = added_stress(body, k, np.full(len(k), depth))
    return np.array([p.sx + 0j, p.sz + 0j, -1j * p.txz, 1j * q.sx, 1j * q.sz, q.txz + 0j])


def _mean(body: LayeredBody, depth: float) -> np.ndarray:
    """The same for the mean, (6,): the limit of long waves, whose odd parts have none."""
    long, _ = added_stress(body, np.zeros(1), np.full(1, depth))
    carried = depth / body.thickness if body.base == "frictionless" else 0.0
    return np.array([long.sx[0], long.sz[0], 0.0, 0.0, 0.0, carried])
