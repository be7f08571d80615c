"""Stresses of a line of elements at points: element by element, or by a tree where that is less."""

import numpy as np

from analytic.stress.elements import hat_at, strip_between
from analytic.stress.grid import from_nearest
from analytic.stress.potential import Element
from analytic.stress.tree import tree_stress
from analytic.threads import for_each

_BLOCK = 2**14  # pairs of point and element at a time, which stay in the cache
# From so many elements, and pairs of point and element, on a tree is quicker.
_TREE_ELEMENTS, _TREE_PAIRS = 64, 20_000


def line_stress(
    nodes: np.ndarray,
    load: np.ndarray,
    pitch: float,
    x: np.ndarray,
    z: np.ndarray,
    element: Element,
) -> np.ndarray:
    """sx, sz, txz under p = `load` and sx under q = `load` (4, m) [Pa], at x, z (m,) [m].

    Idle nodes at the ends cost nothing.
    """
    loaded = np.flatnonzero(load)
    if len(loaded) == 0:
        return np.zeros((4, len(x)))
    if len(loaded) < _TREE_ELEMENTS or len(loaded) * len(x) < _TREE_PAIRS:
        return direct_stress(nodes[loaded], load[loaded], pitch, x, z, element)
    run = slice(loaded[0], loaded[-1] + 1)
    return tree_stress(nodes[run], load[run], pitch, x, z, element)


def direct_stress(
    nodes: np.ndarray,
    load: np.ndarray,
    pitch: float,
    x: np.ndarray,
    z: np.ndarray,
    element: Element,
) -> np.ndarray:
    """`line_stress` as the sum over all elements, each component with its own digits."""
    parts = np.empty((4, len(x)))
    step = max(1, _BLOCK // len(nodes))
    whole, nearest, rest = from_nearest(nodes, pitch, x)
    down = z / pitch

    def add_up(here: slice) -> None:
        offset = rest[here, None] + (nearest[here, None] - whole)
        depth = np.broadcast_to(down[here, None], offset.shape)
        if element == "hat":
            unit = hat_at(offset, depth)
        else:
            unit = strip_between(offset + 0.5, offset, offset - 0.5, depth)
        normal = unit.normal
        for row, values in enumerate((normal.sx, normal.sz, normal.txz, unit.traction_sx)):
            parts[row, here] = values @ load

    for_each(add_up, (slice(i, i + step) for i in range(0, len(x), step)))
    return parts
