"""Stresses in a half-plane under any line of pressure elements, at any points: direct sums.

Nodal pressures p_i stand on a uniform grid x_i; as "hat" they are joined linearly and fall to
zero one pitch beyond the ends, as "strip" each holds over its own pitch. The traction
q = friction * p in +x has the same shape.
"""

import numpy as np
from numpy.typing import ArrayLike

from analytic.plane_stress import PlaneStress
from analytic.stress_elements import FrictionStress, hat_at, strip_between
from analytic.stress_grid import check_element, uniform_pitch
from analytic.stress_potential import Element
from analytic.threads import for_each

_BLOCK = 2**16  # pairs of point and element at a time, a few tens of megabytes


def stress_at(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    friction: float,
    x: ArrayLike,
    z: ArrayLike,
    element: Element = "hat",
) -> PlaneStress:
    """Stresses [Pa] at x, z [m] (broadcast together), z >= 0, tension positive.

    x_nodes (n,) [m] uniform and ascending, pressure (n,) [Pa] positive in compression.
    Raises ValueError for a grid that is not uniform, for z < 0 and for an unknown element.
    """
    return friction_stress_at(x_nodes, pressure, x, z, element).at(friction)


def friction_stress_at(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    x: ArrayLike,
    z: ArrayLike,
    element: Element = "hat",
) -> FrictionStress:
    """`stress_at` for every friction at once."""
    pitch = uniform_pitch(x_nodes, pressure)
    check_element(element)
    x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
    if np.any(z < 0.0):
        raise ValueError("z must not be negative: it points into the body")
    loaded = np.flatnonzero(pressure)
    nodes, load = x_nodes[loaded], pressure[loaded]
    parts = np.zeros((4, x.size))
    step = max(1, _BLOCK // max(1, len(loaded)))

    def add_up(here: slice) -> None:
        part = _unit(x.ravel()[here, None], z.ravel()[here, None], nodes, pitch, element)
        normal = part.normal
        for row, values in enumerate((normal.sx, normal.sz, normal.txz, part.traction_sx)):
            parts[row, here] = values @ load

    for_each(add_up, (slice(i, i + step) for i in range(0, x.size, step)))
    parts = parts.reshape(4, *x.shape)
    return FrictionStress(PlaneStress(*parts[:3]), parts[3])


def _unit(
    x: np.ndarray, z: np.ndarray, nodes: np.ndarray, pitch: float, element: Element
) -> FrictionStress:
    """Of each node's element at unit pressure, (points, nodes) from x and z (points, 1)."""
    offset = x - nodes
    depth = np.broadcast_to(z, offset.shape)
    if element == "hat":
        return hat_at(offset / pitch, depth / pitch)
    half = 0.5 * pitch
    return strip_between(x - (nodes - half), offset, x - (nodes + half), depth)
