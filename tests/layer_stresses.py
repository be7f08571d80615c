"""Stresses in a layer under a line of hats, normal and tangential.

The field is that of a half-plane (`analytic.stress.field`) and what the base adds to it. Of a wave
the addition falls like e^-k(2t - z) (`analytic.layers.layered`): it is smooth, and the integral
over k is taken on panels.

    h   pitch [m]      s   step of the grid [m]      t   thickness [m]      k   wavenumber [1/m]
    P   transform of the hats' pressure              w   k t
"""

from dataclasses import dataclass

import numpy as np

from analytic.layers.kernel import finest_scale, wave_panels
from analytic.layers.layered import LayeredBody, added_stress, coupling
from analytic.stress.elements import uniform_pitch
from analytic.stress.field import StressField, friction_field
from analytic.stress_state import StressState

_FADED = 45.0  # w (2 - z/t) from which nothing is added: e^-45 45^2 is 6e-17
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
) -> LayerField:
    """Stresses in the layer on the levels z (k,) [m], ascending, 0 <= z <= t, within x_range.

    x_nodes (n,) [m] uniform and ascending, pressure (n,) [Pa] of hats, positive in compression.
    The grid contains the nodes' places and divides each pitch into `subdivisions`. On z = 0,
    sz = -p and txz = -q exactly. On a frictionless base nothing holds a net traction Q but the
    layer itself: its two ends, sx = -+Q/2t far off.
    """
    pitch = uniform_pitch(x_nodes, pressure)
    field = friction_field(x_nodes, pressure, x_range, z, subdivisions)
    normal, traction = field.stress.normal, field.stress.traction
    added = _by_panels(body, x_nodes, pressure, pitch, field.x, z)
    return LayerField(
        field.x,
        field.z,
        normal.plus(1.0, StressState(*added[:3])),
        traction.plus(1.0, StressState(*added[3:])),
    )


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


def coupling_compliance(body: LayeredBody, wavenumber: np.ndarray) -> np.ndarray:
    """uz of the surface under waves of traction [m/Pa]: uz cos kx under sin kx, k [1/m] > 0."""
    scale = body.thickness / (2.0 * body.material.shear_modulus)
    w = np.asarray(wavenumber * body.thickness, dtype=float)
    return scale * coupling(body.contrast, w) / w
