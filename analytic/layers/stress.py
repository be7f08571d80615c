"""Stresses below a layered surface under a line of hats, of pressure and of sliding traction.

The field is that of a half-plane (`analytic.stress`) and what the base adds to it. Of a wave the
addition falls like e^-k(2t - z) in the layer (`analytic.layers.layered`). Below it, in a half-plane
that the layer is bonded to, the stresses are those that the tractions P, Q of the interface make,
with Z = k (z - t),

    sz = (Q Z - P (1 + Z)) e^-Z      sx = (Q (2 - Z) - P (1 - Z)) e^-Z
    txz = (Q (Z - 1) - P Z) e^-Z

under P cos kx and Q sin kx (Johnson 1985, section 13.2), and fall like e^-kz. The integral over k
is taken on panels.

    h   pitch [m]      t   thickness [m]      k   wavenumber [1/m]      w   k t
    p   pressure [Pa], positive in compression     q   traction in +x [Pa]"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analytic.layers.kernel import finest_scale, wave_panels
from analytic.layers.layered import LayeredBody, added_stress
from analytic.stress.elements import uniform_pitch
from analytic.stress_state import StressState

_FADED = 45.0  # of k times the distance in which a wave falls: e^-45 45^2 is 6e-17
_BLOCK = 256  # nodes whose phases are one block's times one point's


@dataclass(frozen=True)
class AddedStress:
    """Stresses that the base adds to a half-plane's, by waves."""

    body: LayeredBody
    middle: float  # x [m] that phases count from
    wavenumber: np.ndarray  # k (n,) [1/m], ascending
    load: np.ndarray  # (n,) [Pa] the hats' share of each wave, with the weight of the integral

    @classmethod
    def of(
        cls,
        body: LayeredBody,
        x_nodes: np.ndarray,
        pressure: np.ndarray,
        x_range: tuple[float, float],
    ) -> "AddedStress":
        """Waves of hats of pressure (n,) [Pa] on uniform x_nodes (n,) [m], for x in x_range [m].
        Raises ValueError for nodes that are not uniform."""
        pitch = uniform_pitch(x_nodes, pressure)
        loaded = np.flatnonzero(pressure)
        if len(loaded) == 0:
            return cls(body, 0.0, np.empty(0), np.empty(0))
        nodes, pressure = x_nodes[loaded[0] : loaded[-1] + 1], pressure[loaded[0] : loaded[-1] + 1]
        middle = float(0.5 * (nodes[0] + nodes[-1]))
        far = max(abs(x_range[0] - middle), abs(x_range[1] - middle)) + nodes[-1] - middle
        reach = 2.0 * (far + 2.0 * pitch) / body.thickness
        w, weights = wave_panels(_FADED, reach, finest_scale(body.contrast))
        k = w / body.thickness
        share = weights * pitch / (np.pi * body.thickness) * np.sinc(0.5 * k * pitch / np.pi) ** 2
        return cls(body, middle, k, share * _transform(k, nodes[0] - middle, pitch, pressure))

    def field(self, x: np.ndarray, z: np.ndarray, below: bool = False) -> np.ndarray:
        """sx, sz, txz under p and under q = p in +x (6, len(z), len(x)) [Pa], at the points x (m,)
        and depths z (k,) [m]; `below` the layer, where z >= t. ValueError for other depths."""
        phase = np.exp(1j * np.outer(self.wavenumber, x - self.middle))
        added = np.empty((6, len(z), len(x)))
        for row, depth in enumerate(z):
            faded = _FADED / (depth if below else 2.0 * self.body.thickness - depth)
            count = np.searchsorted(self.wavenumber, faded)
            k = self.wavenumber[:count]
            waves = _rows(self.body, k, np.full(count, depth), below) * self.load[:count]
            added[:, row] = (waves @ phase[:count]).real
        return added

    def at(
        self, friction: ArrayLike, x: np.ndarray, z: np.ndarray, below: bool = False
    ) -> StressState:
        """Stresses under q = friction * p, at x, z [m] of any one shape."""
        flat = x.ravel() - self.middle, z.ravel()
        k = np.broadcast_to(self.wavenumber, (len(flat[0]), len(self.wavenumber)))
        depth = np.broadcast_to(flat[1][:, None], k.shape)
        waves = _rows(self.body, k, depth, below) * (self.load * np.exp(1j * k * flat[0][:, None]))
        parts = waves.real.sum(axis=-1).reshape(6, *x.shape)
        return StressState(*(parts[:3] + friction * parts[3:]))


def _transform(k: np.ndarray, first: float, pitch: float, values: np.ndarray) -> np.ndarray:
    """sum of values_j e^-ik(first + j pitch), (n,) for k (n,), block by block."""
    blocks = -(-len(values) // _BLOCK)
    padded = np.zeros(blocks * _BLOCK)
    padded[: len(values)] = values
    within = np.exp(-1j * pitch * np.outer(np.arange(_BLOCK), k))
    before = np.exp(-1j * np.outer(first + pitch * _BLOCK * np.arange(blocks), k))
    return np.einsum("bk,bk->k", padded.reshape(blocks, _BLOCK) @ within, before)


def _rows(body: LayeredBody, k: np.ndarray, z: np.ndarray, below: bool) -> np.ndarray:
    """Stresses sx, sz, txz that the base adds under p e^ikx and under q e^ikx, (6, …), k > 0."""
    p, q = _below(body, k, z) if below else added_stress(body, k, z)
    return np.array([p.sx + 0j, p.sz + 0j, -1j * p.txz, 1j * q.sx, 1j * q.sz, q.txz + 0j])


def _below(body: LayeredBody, k: np.ndarray, z: np.ndarray) -> tuple[StressState, StressState]:
    """Stresses under the layer: what the interface makes there, less the half-plane's."""
    if body.rigid or np.any(z < body.thickness * (1.0 - 1e-12)):
        raise ValueError(f"depths must lie in the base, from {body.thickness:g} m on")
    interface = np.full(np.shape(k), body.thickness)
    made = []
    for load, added in enumerate(added_stress(body, k, interface)):
        pressed, sheared = float(load == 0), float(load == 1)
        alone = _half_plane(k, interface, pressed, sheared)
        there = alone.plus(1.0, added)
        under = _half_plane(k, z - body.thickness, -there.sz, -there.txz)
        made.append(under.plus(-1.0, _half_plane(k, z, pressed, sheared)))
    return made[0], made[1]


def _half_plane(
    k: np.ndarray, z: np.ndarray, p: np.ndarray | float, q: np.ndarray | float
) -> StressState:
    """Stresses of a half-plane under p cos kx and q sin kx."""
    depth = k * z
    fall = np.exp(-depth)
    return StressState(
        sx=(q * (2.0 - depth) - p * (1.0 - depth)) * fall,
        sz=(q * depth - p * (1.0 + depth)) * fall,
        txz=(q * (depth - 1.0) - p * depth) * fall,
    )
