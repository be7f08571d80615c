"""Stresses along straight lines: down from a point of the surface, or between any two points."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analytic.stress.points import stress_at
from analytic.stress.potential import Element
from analytic.stress_state import StressState


@dataclass(frozen=True)
class StressSection:
    """Stresses [Pa] (m,) at places x, z (m,) [m] that stand `along` (m,) [m] from the first.

    `direction` is the section's own, a unit vector in x and z.
    """

    x: np.ndarray
    z: np.ndarray
    along: np.ndarray
    direction: tuple[float, float]
    stress: StressState

    def turned(self) -> StressState:
        """The stresses [Pa] in axes along the section and across it, the latter a quarter turn on.

        sx is then the stress along the section, sz that across it, and txz the shear on it, in
        axes turned from x towards z by the section's own angle.
        """
        c, s = self.direction
        given = self.stress
        mixed = 2.0 * c * s * given.txz
        return StressState(
            sx=c * c * given.sx + s * s * given.sz + mixed,
            sz=s * s * given.sx + c * c * given.sz - mixed,
            txz=c * s * (given.sz - given.sx) + (c * c - s * s) * given.txz,
        )


def depth_profile(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    friction: float,
    x: float,
    depths: ArrayLike,
    element: Element = "hat",
    *,
    traction: np.ndarray | None = None,
    periodic: bool = False,
) -> StressSection:
    """Stresses at `depths` (m,) [m], from 0 on, below the place x [m].

    The load is given as to `stress_at`. Raises ValueError for what that refuses.
    """
    z = np.asarray(depths, dtype=float)
    if z.ndim != 1 or len(z) == 0:
        raise ValueError("depths must be one-dimensional and not empty")
    stress = stress_at(
        x_nodes, pressure, friction, x, z, element, traction=traction, periodic=periodic
    )
    return StressSection(np.full(len(z), float(x)), z, z - z[0], (0.0, 1.0), stress)


def section(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    friction: float,
    start: tuple[float, float],
    stop: tuple[float, float],
    count: int = 201,
    element: Element = "hat",
    *,
    traction: np.ndarray | None = None,
    periodic: bool = False,
) -> StressSection:
    """Stresses at `count` places, evenly from `start` to `stop`, each (x, z) [m] with z >= 0.

    The load is given as to `stress_at`. Raises ValueError for what that refuses, for fewer than
    2 places and for two ends in one place.
    """
    if count < 2 or tuple(start) == tuple(stop):
        raise ValueError("a section needs two different ends and at least 2 places")
    share = np.linspace(0.0, 1.0, count)
    x, z = ((1.0 - share) * a + share * b for a, b in zip(start, stop, strict=True))
    run, fall = stop[0] - start[0], stop[1] - start[1]
    length = float(np.hypot(run, fall))
    stress = stress_at(
        x_nodes, pressure, friction, x, z, element, traction=traction, periodic=periodic
    )
    return StressSection(x, z, share * length, (run / length, fall / length), stress)
