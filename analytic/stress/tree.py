"""Stresses of many elements at many points: a tree of boxes on the surface, n + m instead of n m.

The line is cut into boxes of 8 nodes, and these are joined two by two. A point belongs to the
smallest box on whose level its depth is at most 3.5 half-widths b. What stands in that box and in
its three neighbours on either side is near: on the finest level it is summed over the nodes, else
over the boxes' outer expansions, whose radius is then at most 0.6 of the distance. All the rest
stands at least 7 b from the centre and reaches the point, at most 3.6 b away from it, in one inner
expansion. Only boxes over points, and their ancestors, have one.

Where all of the load is farther than twice its half-width, its moments are summed as in
`stress_multipoles`, and every component keeps its own digits. Elsewhere all are right to 1e-14 of
the largest pressure, at places that are known to rounding as `stress` says.
"""

from itertools import pairwise

import numpy as np

from analytic.stress.boxes import LEAF, NEIGHBOURS, box_levels, inner_sum, outer_sum
from analytic.stress.grid import from_nearest
from analytic.stress.multipoles import FARTHER, far_moments, line_multipoles
from analytic.stress.near import Line, near_stress
from analytic.stress.potential import Element, stresses
from analytic.threads import for_each

_DEEPEST = 3.5  # half-widths of a box: points below belong to a larger one
_BLOCK, _NEAR_BLOCK = 4096, 256  # points at a time


def tree_stress(
    nodes: np.ndarray,
    load: np.ndarray,
    pitch: float,
    x: np.ndarray,
    z: np.ndarray,
    element: Element,
) -> np.ndarray:
    """sx, sz, txz under p = `load` and sx under q = `load` (4, m) [Pa], at x, z (m,) [m]."""
    parts = np.empty((4, len(x)))
    middle, half = 0.5 * (nodes[0] + nodes[-1]), 0.5 * (nodes[-1] - nodes[0]) + pitch
    far = np.hypot(x - middle, z) >= FARTHER * half
    if far.any():
        moments = far_moments(nodes - middle, load, pitch, half, element)
        parts[:, far] = line_multipoles((x[far] - middle) / half, z[far] / half, moments)
    among = np.flatnonzero(~far)
    if len(among):
        _, nearest, rest = from_nearest(nodes, pitch, x[among])
        parts[:, among] = _among(Line(load, element), nearest, rest, z[among] / pitch)
    return parts


def _among(line: Line, nearest: np.ndarray, rest: np.ndarray, down: np.ndarray) -> np.ndarray:
    """Between and next to the elements: `rest` pitches from the `nearest` node, and so far down."""
    along = nearest + (rest + 0.5)
    level = np.ceil(np.log2(np.maximum(down / (0.5 * LEAF * _DEEPEST), 1.0))).astype(int)
    box = np.floor(along / (LEAF * 2.0**level)).astype(int)
    order = np.lexsort((box, level))
    runs = list(pairwise(np.searchsorted(level[order], np.arange(level.max() + 2))))
    levels = box_levels(line.load, line.element, [box[order[a:b]] for a, b in runs])
    parts = np.empty((4, len(down)))

    def add_up(piece: slice) -> None:
        here = order[piece]
        tree = levels[level[here[0]]]
        u = np.empty(len(here), dtype=complex)
        u.real = along[here] / tree.half - (2.0 * box[here] + 1.0)
        u.imag = down[here] / tree.half
        potential, slope = inner_sum(tree, box[here], u)
        if tree is not levels[0]:
            near, near_slope = outer_sum(tree, box[here], u)
            potential += near
            slope += near_slope
        slope *= u.imag
        found = stresses(potential, slope) / (np.pi * tree.half)
        if tree is levels[0]:
            for i in range(0, len(here), _NEAR_BLOCK):
                block = slice(i, i + _NEAR_BLOCK)
                start = (box[here[block]] - NEIGHBOURS) * LEAF
                count = (2 * NEIGHBOURS + 1) * LEAF
                found[:, block] += near_stress(
                    line, nearest[here[block]], rest[here[block]], down[here[block]], start, count
                )
        parts[:, here] = found

    for_each(
        add_up,
        (
            slice(i, min(i + _BLOCK, stop))
            for start, stop in runs
            for i in range(start, stop, _BLOCK)
        ),
    )
    return parts
