"""A contact problem of the benchmark on one mesh, and the answer of a code: what a peer imports."""

from typing import NamedTuple

import numpy as np

from analytic.material import Material
from meshes.block import BlockMesh

MATERIAL = Material(1.0, 0.3)
SLOPE = 1e-5  # a / R
RADIUS = 1.0 / SLOPE
BLOCK = 40.0  # half-width and depth, in a
SLACK = 1e-9  # of the block: points closer to a side than this are on it


class FailedError(Exception):
    """A code found no pressures; the message is its own."""


class BlockTask(NamedTuple):
    """The problem on one mesh, pressed by the approach d [m]."""

    mesh: BlockMesh
    approach: float

    @property
    def ends(self) -> tuple[float, float]:
        """x [m] between which contact is possible; the mesh has equal edges there."""
        start, stop = self.mesh.spec.intervals[0]
        return float(start), float(stop)

    def fixed(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Whether points are on the bottom or on one of the sides."""
        side = BLOCK * (1.0 - SLACK)
        return (np.abs(x) >= side) | (z >= side)

    def touchable(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Whether points are on the top where contact is possible."""
        slack = SLACK * BLOCK
        start, stop = self.ends
        return (z <= slack) & (x >= start - slack) & (x <= stop + slack)


class BlockAnswer(NamedTuple):
    """The largest pressure [Pa] of a solution, and its displacement components.

    whole  wall and processor time [s] of the whole process, where the code is one
    """

    peak: float
    unknowns: int
    whole: tuple[float, float] | None = None


def gap(x: np.ndarray) -> np.ndarray:
    """g0 [m] at x [m]."""
    return x**2 / (2.0 * RADIUS)
