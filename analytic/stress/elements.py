"""Stresses in a half-plane under one hat of pressure and of traction.

Nomenclature: p pressure (positive in compression) and q traction (in +x) at the hat's peak, both 1
here; r, t distance and angle from a node of the hat, t = atan2(z, x - node).

sz under q is txz under p, and txz under q is sx under p: four arrays hold what any friction needs.

Written as in the sources, the formulas are sums of angles and logarithms that cancel: sz falls
like z^3/x^4 while its terms do not fall at all. Close to the hat they are recast here so that every
component keeps its digits; away from it moments of its potential are right to rounding of the
largest of the four.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import xlogy

from analytic.stress.potential import NEAREST_FAR, hat_series, stresses
from analytic.stress_state import StressState


@dataclass(frozen=True)
class FrictionStress:
    """Stresses [Pa] under a pressure p and, by superposition, a traction q = friction * p."""

    normal: StressState  # under p alone
    traction_sx: np.ndarray  # sx under q = p in +x, which is sx a unit of friction
    along: float = 0.0  # sx everywhere beside these, which no traction on the surface makes

    @classmethod
    def of(cls, parts: np.ndarray, along: float = 0.0) -> "FrictionStress":
        """Stresses from sx, sz, txz under p and sx under q (4, …) [Pa]."""
        return cls(StressState(*parts[:3]), parts[3], along)

    @property
    def parts(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """sx, sz, txz under p and sx under q [Pa]."""
        return self.normal.sx, self.normal.sz, self.normal.txz, self.traction_sx

    def plus(self, parts: np.ndarray, along: float = 0.0) -> "FrictionStress":
        """Add the stresses of another load, given as to `of`."""
        return FrictionStress.of(np.array(self.parts) + parts, self.along + along)

    @property
    def traction(self) -> StressState:
        """Stresses under q = p in +x alone."""
        return StressState(sx=self.traction_sx, sz=self.normal.txz, txz=self.normal.sx)

    def at(self, friction: ArrayLike) -> StressState:
        """Stresses under p and q = friction * p, by one friction or by that of each point."""
        state = self.normal.plus(friction, self.traction) if np.any(friction) else self.normal
        return replace(state, sx=state.sx + self.along) if self.along else state


def hat_at(x: np.ndarray, z: np.ndarray) -> FrictionStress:
    """Stresses under unit p and q at 0 that fall linearly to zero at -1 and 1; x, z in pitches."""
    parts = np.empty((4, *x.shape))
    near = np.hypot(x, z) < NEAREST_FAR
    parts[:, near] = _hat_closed(x[near], z[near])
    potential, slope = hat_series(x[~near] + 1j * z[~near])
    parts[:, ~near] = stresses(potential, z[~near] * slope)
    return FrictionStress.of(parts)


def _hat_closed(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """sx, sz, txz under p and sx under q (4, n) close to the hat, lengths in pitches.

    With y = x + 1, x, x - 1, weights c = 1, -2, 1 and t = atan2(z, y), from the potential
    (1/pi) sum c w ln w, w = y + i z:
        pi sz = sum c y t, pi sx = pi sz + 2 z sum c ln r, pi txz = -z sum c t,
        pi sx under q = 3 z sum c t - 2 sum c y ln r.
    """
    side, x = np.where(x < 0.0, -1.0, 1.0), np.abs(x)
    y = np.stack([x + 1.0, x, x - 1.0])
    radius, angle = np.hypot(y, z), np.arctan2(z, y)
    logs = _second_difference(np.log(np.where(radius > 0.0, radius, 1.0)))
    stretch = _second_difference(xlogy(y, radius))
    shallow = z < x
    # Around the axis angles from the vertical leave exactly nothing of what is odd in x.
    upright = np.arctan2(1.0 - x, z) - np.arctan2(1.0 + x, z) + 2.0 * np.arctan2(x, z)
    turn = np.where(shallow, _second_difference(angle), upright)
    # y t = |y| atan(z/|y|) + pi min(y, 0), and the difference of the latter is -pi times the hat;
    # taking z off the former leaves what is of third order in z away from the nodes.
    steady = _second_difference(_shortfall(np.abs(y), z)) - np.pi * np.maximum(1.0 - x, 0.0)
    sz = np.where(shallow, steady, _second_difference(y * angle)) / np.pi
    sx, txz = sz + 2.0 * z * logs / np.pi, -side * z * turn / np.pi
    return np.stack([sx, sz, txz, side * (3.0 * z * turn - 2.0 * stretch) / np.pi])


def _second_difference(at: np.ndarray) -> np.ndarray:
    """Second difference of three rows; the outer first, so that opposite ones cancel exactly."""
    return at[0] + at[2] - 2.0 * at[1]


def _shortfall(y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """y atan(z/y) - z for y, z >= 0, which is -z^3/(3 y^2) + … for small z/y."""
    small = z < 0.25 * y
    square = np.where(small, z / np.where(small, y, 1.0), 0.0) ** 2
    series = np.zeros_like(square)
    for n in range(14, 0, -1):
        series = -square * (series + 1.0 / (2.0 * n + 1.0))
    return np.where(small, z * series, y * np.arctan2(z, y) - z)


_PITCH_TOLERANCE = 1e-6  # of the pitch: how far a node may stand from its point of the grid


def uniform_pitch(x_nodes: np.ndarray, pressure: np.ndarray) -> float:
    """Pitch [m] of the grid that carries `pressure`; ValueError where it is not uniform."""
    if np.ndim(x_nodes) != 1 or np.shape(x_nodes) != np.shape(pressure):
        raise ValueError("x_nodes and pressure must be one-dimensional and of equal length")
    if len(x_nodes) < 2:
        raise ValueError(f"a grid of pressures needs at least 2 nodes, not {len(x_nodes)}")
    if not (np.all(np.isfinite(x_nodes)) and np.all(np.isfinite(pressure))):
        raise ValueError("x_nodes and pressure must be finite")
    pitch = (x_nodes[-1] - x_nodes[0]) / (len(x_nodes) - 1)
    grid = x_nodes[0] + pitch * np.arange(len(x_nodes))
    if not (pitch > 0.0 and np.max(np.abs(x_nodes - grid)) <= _PITCH_TOLERANCE * pitch):
        raise ValueError("x_nodes must be uniform and ascending")
    return float(pitch)


def from_nearest(
    nodes: np.ndarray, pitch: float, x: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points x (m,) [m] and nodes (n,) [m], ascending, by whole pitches, which rounding spares.
    Whole pitches (n,) from the first node to each; those to the node nearest to each point (m,),
    and the pitches from there to the point (m,), 0 at a node as it was given."""
    whole = np.rint((nodes - nodes[0]) / pitch).astype(int)
    nearest = np.searchsorted(0.5 * (nodes[1:] + nodes[:-1]), x)
    return whole, whole[nearest], (x - nodes[nearest]) / pitch
