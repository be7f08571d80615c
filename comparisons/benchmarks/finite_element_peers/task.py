"""A contact problem of the benchmark on one mesh, and the answer of a code: what a peer imports."""

from collections.abc import Callable
from dataclasses import dataclass

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


@dataclass(frozen=True)
class BlockTask:
    """One problem on one mesh.

    waves     (k, 3) rows of A_k [m], lambda_k [m], phi_k [rad]
    approach  d [m]
    """

    mesh: BlockMesh
    waves: np.ndarray
    approach: float

    @property
    def ends(self) -> tuple[float, float]:
        """x [m] between which contact is possible; the mesh has equal edges there."""
        start, stop = self.mesh.spec.intervals[0]
        return float(start), float(stop)

    def gap(self, x: np.ndarray) -> np.ndarray:
        """g0 [m] at x [m], of any shape."""
        return gap(x, self.waves)

    def fixed(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Whether points are on the bottom or on one of the sides."""
        side = BLOCK * (1.0 - SLACK)
        return (np.abs(x) >= side) | (z >= side)

    def touchable(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Whether points are on the top where contact is possible."""
        slack = SLACK * BLOCK
        start, stop = self.ends
        return (z <= slack) & (x >= start - slack) & (x <= stop + slack)


@dataclass(frozen=True)
class BlockAnswer:
    """Contact pressures of one solution.

    x, pressure  (k,) ascending [m], and [Pa] there, linear between; zero elsewhere
    unknowns     displacement components
    steps        of the contact iteration
    seconds      processor time, where the caller cannot measure it
    whole        wall and processor time of the whole process, where the code is one
    """

    x: np.ndarray
    pressure: np.ndarray
    unknowns: int
    steps: int
    seconds: float | None = None
    whole: tuple[float, float] | None = None

    def at(self, x: np.ndarray) -> np.ndarray:
        """Pressure [Pa] at x [m]."""
        return np.interp(x, self.x, self.pressure, left=0.0, right=0.0)


@dataclass(frozen=True)
class BlockCode:
    """One configuration of one code; `solve` raises FailedError."""

    name: str
    configuration: str
    solve: Callable[[BlockTask], BlockAnswer]


def gap(x: np.ndarray, waves: np.ndarray) -> np.ndarray:
    """g0 [m] at x [m], of any shape, with (k, 3) rows A_k [m], lambda_k [m], phi_k of waves."""
    x = np.asarray(x, dtype=float)
    angle = 2.0 * np.pi * x[..., None] / waves[:, 1] + waves[:, 2]
    return x**2 / (2.0 * RADIUS) + (1.0 - np.cos(angle)) @ waves[:, 0]
