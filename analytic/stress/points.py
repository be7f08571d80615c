"""Stresses in a half-plane under any line of pressure elements, at any points.

Nodal pressures p_i stand on a uniform grid x_i; they are joined linearly and fall to zero one pitch
beyond the ends. Tractions have the same shape. Few pairs of point and hat are summed one by one,
more by a tree (`analytic.stress.tree`). Both agree to 1e-13 of the largest load.

Nodes count as whole pitches h apart, and a point by its distance from the nearest one: at a node no
rounding of the coordinates enters. Between nodes it moves the point by up to eps |x|, which changes
a stress by about eps |x|/h times the difference between neighbouring pressures: 5e-12 of it at
h = 1 um, 5 cm from the origin.
"""

import numpy as np
from numpy.typing import ArrayLike

from analytic.numerics import points_below
from analytic.stress.elements import FrictionStress, uniform_pitch
from analytic.stress.tree import LoadedLine, line_stress
from analytic.stress_state import StressState


def stress_at(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    friction: float,
    x: ArrayLike,
    z: ArrayLike,
) -> StressState:
    """Stresses [Pa] at x, z [m] (broadcast together), z >= 0, tension positive.
    x_nodes (n,) [m] uniform and ascending, pressure (n,) [Pa] positive in compression. The
    traction in +x is friction * pressure.
    Raises ValueError for a grid that is not uniform, and for z < 0."""
    return friction_stress_at(x_nodes, pressure, x, z).at(friction)


def friction_stress_at(
    x_nodes: np.ndarray, pressure: np.ndarray, x: ArrayLike, z: ArrayLike
) -> FrictionStress:
    """`stress_at` under q = friction * p, for every friction at once."""
    pitch = uniform_pitch(x_nodes, pressure)
    x, z = points_below(x, z)
    line = LoadedLine(x_nodes, pressure, pitch)
    parts = line_stress(line, x.ravel(), z.ravel())
    return FrictionStress.of(parts.reshape(4, *x.shape))
