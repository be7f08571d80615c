"""Stresses in a half-plane under any line of pressure elements, at any points.

Nodal pressures p_i stand on a uniform grid x_i; as "hat" they are joined linearly and fall to
zero one pitch beyond the ends, as "strip" each holds over its own pitch. Tractions have the same
shape. A field on a grid of columns and levels is quicker by `stress_field`.

A few pairs of point and element are summed one by one, which keeps the relative accuracy of every
component; more by a tree (`analytic.stress.tree`), in a time proportional to their numbers' sum.
The two agree to 1e-13 of the largest load, wherever the nodes stand.

Nodes count as whole pitches apart, and a place by its distance from the nearest one: at a node,
given as in `x_nodes`, no rounding of the coordinates enters. Between nodes that of x and x_i moves
the place by up to eps |x| (eps 1.1e-16), which changes a stress by about eps |x|/h times the
difference between neighbouring pressures, h the pitch: 5e-12 of it at h = 1 um, 5 cm from the
origin.

Stresses along straight lines: down from a point of the surface, or between any two points.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analytic.stress.elements import FrictionStress, check_element, uniform_pitch
from analytic.stress.periodic import periodic_stress
from analytic.stress.potential import Element
from analytic.stress.tree import line_stress
from analytic.stress_state import StressState


def stress_at(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    friction: float,
    x: ArrayLike,
    z: ArrayLike,
    element: Element = "hat",
    *,
    traction: np.ndarray | None = None,
    periodic: bool = False,
) -> StressState:
    """Stresses [Pa] at x, z [m] (broadcast together), z >= 0, tension positive.

    x_nodes (n,) [m] uniform and ascending, pressure (n,) [Pa] positive in compression. The
    traction in +x is friction * pressure + traction, with `traction` (n,) [Pa] nodal values of
    any sign. With `periodic` the nodes are one period of n pitches, repeated without end; what
    the mean pressure then does to sx is told in `analytic.stress.periodic`.

    Raises ValueError for a grid that is not uniform, for z < 0 and for an unknown element.
    """
    besides = (
        []
        if traction is None
        else [friction_stress_at(x_nodes, traction, x, z, element, periodic=periodic)]
    )
    stress = friction_stress_at(x_nodes, pressure, x, z, element, periodic=periodic)
    return stress.at(friction, *besides)


def friction_stress_at(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    x: ArrayLike,
    z: ArrayLike,
    element: Element = "hat",
    *,
    periodic: bool = False,
) -> FrictionStress:
    """`stress_at` under q = friction * p, for every friction at once."""
    pitch = uniform_pitch(x_nodes, pressure)
    check_element(element)
    x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
    if np.any(z < 0.0):
        raise ValueError("z must not be negative: it points into the body")
    sum_up = periodic_stress if periodic else line_stress
    parts = sum_up(x_nodes, pressure, pitch, x.ravel(), z.ravel(), element)
    parts = parts.reshape(4, *x.shape)
    return FrictionStress(StressState(*parts[:3]), parts[3])


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
