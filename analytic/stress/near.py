"""Stresses of the elements next to a point, a run of them at a time."""

from dataclasses import dataclass

import numpy as np

from analytic.stress.elements import FrictionStress
from analytic.stress.kernels import unit_stress
from analytic.stress.potential import Element


@dataclass(frozen=True)
class Line:
    """The load (n,) [Pa], one pitch from node to node."""

    load: np.ndarray
    element: Element


def near_stress(
    line: Line,
    nearest: np.ndarray,
    rest: np.ndarray,
    z: np.ndarray,
    start: np.ndarray,
    count: int,
) -> np.ndarray:
    """The four stresses (4, points) of `count` elements from number `start` (points,) on.

    At places (points,) `rest` from the node of number `nearest`, and z below, in pitches. Elements
    beyond the line's ends carry nothing.
    """
    unique, which = np.unique(start, return_inverse=True)
    index = unique[:, None] + np.arange(-1, count + 1)
    loaded = (index >= 0) & (index < len(line.load))
    load = np.where(loaded, line.load[np.where(loaded, index, 0)], 0.0)
    load[:, [0, -1]] = 0.0
    offset = rest[:, None] + (nearest[:, None] - index[which])
    z = z[:, None]
    if line.element == "strip":
        unit = unit_stress(offset, np.broadcast_to(z, offset.shape), "strip")
        return _weighted(unit, load[which])
    bend = np.zeros_like(load)
    bend[:, 1:-1] = load[:, 2:] - 2.0 * load[:, 1:-1] + load[:, :-2]
    bend[:, [0, -1]] = load[:, [1, -2]]
    return _bends(offset, z, load[which], bend[which])


def _weighted(unit: FrictionStress, load: np.ndarray) -> np.ndarray:
    normal = unit.normal
    rows = (normal.sx, normal.sz, normal.txz, unit.traction_sx)
    return np.array([np.einsum("ij,ij->i", row, load) for row in rows])


def _bends(x: np.ndarray, z: np.ndarray, load: np.ndarray, bend: np.ndarray) -> np.ndarray:
    """The stresses (4, points) of a load that is linear between nodes, lengths in pitches.

    x (points, nodes), z (points, 1), `load` and its change of slope c at each node (points, nodes).
    With y = x + i z, I = (1/pi) sum c y ln y and I' = (1/pi) sum c ln y. As sum c = 0, angles count
    from the vertical and lengths from half the span of the nodes; sum c |x| = 2 p(x) is taken from
    the load itself, which leaves terms of the order of the depth in sz.
    """
    distance = np.abs(x)
    rise = np.arctan2(z, distance)
    square = x * x
    square += z * z
    square *= 4.0 / x.shape[1] ** 2
    log = np.log(np.where(square > 0.0, square, 1.0))
    lean = np.copysign(0.5 * np.pi - rise, x)
    angle, log_sum = np.einsum("ij,ij->i", bend, lean), np.einsum("ij,ij->i", bend, log)
    rise_moment = np.einsum("ij,ij->i", bend, distance * rise)
    log_moment = np.einsum("ij,ij->i", bend, x * log)
    own = np.einsum("ij,ij->i", load, np.maximum(1.0 - distance, 0.0))
    z = z[:, 0]
    sz = rise_moment / np.pi - own
    return np.array(
        [
            sz + z * log_sum / np.pi,
            sz,
            z * angle / np.pi,
            -(3.0 * z * angle + log_moment) / np.pi,
        ]
    )
