"""Stresses in a half-plane under any line of pressure elements, at any points: direct sums.

Nodal pressures p_i stand on a uniform grid x_i; as "hat" they are joined linearly and fall to
zero one pitch beyond the ends, as "strip" each holds over its own pitch. The traction
q = friction * p in +x has the same shape.
"""

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from analytic.plane_stress import PlaneStress
from analytic.stress_elements import FrictionStress, hat_at, strip_between
from analytic.threads import for_each

Element = Literal["hat", "strip"]

_PITCH_TOLERANCE = 1e-6  # of the pitch: how far a node may stand from its place on the grid
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


def check_element(element: str) -> None:
    """ValueError unless `element` is "hat" or "strip"."""
    if element not in ("hat", "strip"):
        raise ValueError(f'element must be "hat" or "strip", not {element!r}')


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
