"""Stresses of a line of elements at points: element by element, or by a tree of boxes for many.

The line is cut into boxes of 8 nodes, and these are joined two by two. A point belongs to the
smallest box on whose level its depth is at most 3.5 half-widths b. That box and its three
neighbours on either side are near: on the finest level their nodes are summed, else the boxes'
outer expansions, whose radius is then at most 0.6 of the distance. All the rest stands at least 7 b
from the centre and reaches the point in one inner expansion: the parent's, moved, and the outer
ones of those halves of the parent's near boxes that are not near themselves. Only boxes over
points, and their ancestors, have one. The work grows with n + m in place of n m.

Farther from the box of all the load than twice its half-width its own outer expansion is taken. All
are right to 1e-14 of the largest pressure, at points that are known to rounding as
`analytic.stress.points` says.
"""

from dataclasses import dataclass
from functools import cache, lru_cache
from itertools import pairwise

import numpy as np

from analytic.numerics import for_each
from analytic.stress.elements import from_nearest, hat_at
from analytic.stress.potential import (
    ORDER,
    inner_to_child,
    nodes_to_outer,
    outer_to_inner,
    outer_to_parent,
    polynomial,
    stresses,
)

LEAF = 8  # nodes of the smallest box
NEIGHBOURS = 3
# Outer coefficients summed for a box so many boxes away: less than 1e-15 of its load is left out.
_OUTER_ORDERS = (ORDER, 46, 28, 22)
_BOXES = 2048  # boxes at a time
_PER_POINT = 16  # boxes of the finest level that are worth their expansions, for each point


@dataclass(frozen=True)
class BoxLevel:
    """Boxes of `half` pitches half-width: `ids` (b,) of those over points, sorted."""

    half: float
    ids: np.ndarray
    outer: np.ndarray  # (ORDER, boxes + 1) of all boxes over the load, and zero
    inner: np.ndarray  # (ORDER, b)


def box_levels(load: np.ndarray, boxes: list[np.ndarray]) -> list[BoxLevel]:
    """Expansions on each level of boxes, the finest first; `boxes` of the points on each. Those of
    all boxes, which the next points may take again, where that is not much more work."""
    line, points = np.asarray(load, dtype=float).tobytes(), sum(map(len, boxes))
    if len(load) <= LEAF * min(_PER_POINT * points, _BOXES):
        everywhere = _everywhere(line)
        if all(map(_holds, everywhere, boxes)) and len(boxes) <= len(everywhere):
            return everywhere
    return _levels(line, boxes)


def _holds(level: BoxLevel, box: np.ndarray) -> bool:
    return len(box) == 0 or bool(level.ids[0] <= box.min() and box.max() <= level.ids[-1])


@lru_cache(maxsize=32)
def _everywhere(load: bytes) -> list[BoxLevel]:
    """Levels with all boxes over a load, and their neighbours."""
    count = _outer_levels(load)[0].shape[1]
    return _levels(load, [np.arange(-NEIGHBOURS, count + NEIGHBOURS)])


def _levels(load: bytes, boxes: list[np.ndarray]) -> list[BoxLevel]:
    """Levels with the boxes that are asked for, and their ancestors."""
    outer = list(_outer_levels(load))
    while len(outer) < len(boxes):
        outer.append(_parents(outer[-1]))
    ids = []
    for index in range(len(outer)):
        used = np.unique(boxes[index]) if index < len(boxes) else np.empty(0, dtype=int)
        ids.append(np.union1d(used, ids[-1] // 2) if ids else used)
    levels = []
    for index in reversed(range(len(outer))):
        sources = np.column_stack([outer[index], np.zeros(ORDER)])
        inner = np.zeros((ORDER, len(ids[index])))
        # From the third level on, counted from the box that holds the whole load, boxes are far.
        for right in (0, 1) if len(levels) > 1 else ():
            here = np.flatnonzero(ids[index] % 2 == right)
            parent = np.searchsorted(levels[-1].ids, ids[index][here] // 2)
            inner[:, here] = inner_to_child(2 * right - 1) @ levels[-1].inner[:, parent]
            for i in range(0, len(here), _BOXES):
                inner[:, here[i : i + _BOXES]] += _from_far(
                    sources, ids[index][here[i : i + _BOXES]], right
                )
        levels.append(BoxLevel(0.5 * LEAF * 2.0**index, ids[index], sources, inner))
    return levels[::-1]


@lru_cache(maxsize=4)
def _outer_levels(load: bytes) -> tuple[np.ndarray, ...]:
    """Outer coefficients (ORDER, boxes) of a load's boxes on each level up to the one that holds
    all of it; searches ask for the same load again and again."""
    nodal = np.frombuffer(load)
    padded = np.pad(nodal, (0, -len(nodal) % LEAF)).reshape(-1, LEAF)
    levels = [nodes_to_outer(LEAF) @ padded.T]
    while levels[-1].shape[1] > 1:
        levels.append(_parents(levels[-1]))
    return tuple(levels)


def _parents(outer: np.ndarray) -> np.ndarray:
    """Outer coefficients of the boxes that are made of two each."""
    if outer.shape[1] % 2:
        outer = np.column_stack([outer, np.zeros(ORDER)])
    return outer_to_parent(-1) @ outer[:, ::2] + outer_to_parent(1) @ outer[:, 1::2]


def _from_far(sources: np.ndarray, box: np.ndarray, right: int) -> np.ndarray:
    """Inner coefficients of boxes, all `right` or left halves, from what only their parents had."""
    away, matrix = _far_boxes(right)
    column = inside(box + away[:, None], sources.shape[1] - 1)
    if np.all(column == sources.shape[1] - 1):
        return np.zeros((ORDER, len(box)))
    seen = sources[: _OUTER_ORDERS[-1]].T[column]
    return matrix @ seen.transpose(0, 2, 1).reshape(-1, len(box))


@cache
def _far_boxes(right: int) -> tuple[np.ndarray, np.ndarray]:
    """Distances [boxes] to the halves of the parent's near boxes that are not near themselves. And
    the matrix (ORDER, distances * orders) that takes their outer coefficients to inner ones."""
    away = np.arange(-2 * NEIGHBOURS - right, 2 * NEIGHBOURS + 2 - right)
    away = away[np.abs(away) > NEIGHBOURS]
    return away, np.hstack([outer_to_inner(int(boxes))[:, : _OUTER_ORDERS[-1]] for boxes in away])


def inside(box: np.ndarray, count: int) -> np.ndarray:
    """Boxes of the load by number, and `count` for those beyond it."""
    return np.where((box >= 0) & (box < count), box, count)


def outer_sum(tree: BoxLevel, box: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """sum M_k / u^(k+1) over the near boxes, and its derivative in u."""
    total, change = np.zeros_like(u), np.zeros_like(u)
    for away, orders in enumerate(_OUTER_ORDERS):
        sides = np.unique([-away, away])[:, None]
        column = inside(box + sides, tree.outer.shape[1] - 1)
        v = 1.0 / (u - 2.0 * sides)
        value, slope = polynomial((row[column] for row in tree.outer[orders - 1 :: -1]), v)
        total += np.sum(v * value, axis=0)
        change -= np.sum(v * v * (value + v * slope), axis=0)
    return total, change


@dataclass(frozen=True)
class LoadedLine:
    """Hats with nodes (n,) [m], a uniform `pitch` [m] apart, under `load` (n,) [Pa]."""

    nodes: np.ndarray
    load: np.ndarray
    pitch: float

    def part(self, some: slice | np.ndarray) -> "LoadedLine":
        """Some of the elements."""
        return LoadedLine(self.nodes[some], self.load[some], self.pitch)


def near_stress(
    line: LoadedLine, nearest: np.ndarray, rest: np.ndarray, z: np.ndarray, box: np.ndarray
) -> np.ndarray:
    """The four stresses (4, points) of the elements in each point's near boxes on the finest level.
    At points (points,) `rest` from the node of number `nearest`, and z below, in pitches."""
    unique, which = np.unique((box - NEIGHBOURS) * LEAF, return_inverse=True)
    index = unique[:, None] + np.arange(-1, (2 * NEIGHBOURS + 1) * LEAF + 1)
    loaded = (index >= 0) & (index < len(line.load))
    load = np.where(loaded, line.load[np.where(loaded, index, 0)], 0.0)
    load[:, [0, -1]] = 0.0
    offset = rest[:, None] + (nearest[:, None] - index[which])
    bend = np.zeros_like(load)
    bend[:, 1:-1] = load[:, 2:] - 2.0 * load[:, 1:-1] + load[:, :-2]
    bend[:, [0, -1]] = load[:, [1, -2]]
    return _bends(offset, z[:, None], load[which], bend[which])


def _bends(x: np.ndarray, z: np.ndarray, load: np.ndarray, bend: np.ndarray) -> np.ndarray:
    """The stresses (4, points) of a load that is linear between nodes, lengths in pitches.
    x (points, nodes), z (points, 1), `load` and its change of slope c at each node (points, nodes).
    With y = x + i z, I = (1/pi) sum c y ln y and I' = (1/pi) sum c ln y. As sum c = 0, angles count
    from the vertical and lengths from half the span of the nodes; sum c |x| = 2 p(x) is taken from
    the load itself, which leaves terms of the order of the depth in sz."""
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
    surface_pressure = np.einsum("ij,ij->i", load, np.maximum(1.0 - distance, 0.0))
    z = z[:, 0]
    sz = rise_moment / np.pi - surface_pressure
    sx, txz = sz + z * log_sum / np.pi, z * angle / np.pi
    return np.array([sx, sz, txz, -(3.0 * z * angle + log_moment) / np.pi])


_DEEPEST = 3.5  # half-widths of a box: points below belong to a larger one
_FAR = 2.0  # half-widths of the largest box, from whose middle on it is all that is seen
_BLOCK, _NEAR_BLOCK = 4096, 256  # points at a time


def tree_stress(line: LoadedLine, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """sx, sz, txz under p and sx under q, each the line's load (4, m) [Pa], at x, z (m,) [m]."""
    _, nearest, rest = from_nearest(line.nodes, line.pitch, x)
    along, down = nearest + (rest + 0.5), z / line.pitch
    half = 0.5 * LEAF * 2.0 ** np.ceil(np.log2(max(len(line.load) / LEAF, 1.0)))
    parts, far = np.empty((4, len(x))), np.hypot(along - half, down) >= _FAR * half
    if far.any():
        u = (along[far] - half + 1j * down[far]) / half
        (*_, root), v = box_levels(line.load, []), 1.0 / u
        value, slope = polynomial(root.outer[::-1, 0], v)
        potential, slope = v * value, -v * v * (value + v * slope)
        parts[:, far] = stresses(potential, u.imag * slope) / (np.pi * half)
    if not far.all():
        parts[:, ~far] = _among(line, nearest[~far], rest[~far], down[~far])
    return parts


def _among(line: LoadedLine, nearest: np.ndarray, rest: np.ndarray, down: np.ndarray) -> np.ndarray:
    """Between and next to the elements: `rest` pitches from the `nearest` node, and so far down."""
    along = nearest + (rest + 0.5)
    level = np.ceil(np.log2(np.maximum(down / (0.5 * LEAF * _DEEPEST), 1.0))).astype(int)
    box = np.floor(along / (LEAF * 2.0**level)).astype(int)
    order = np.lexsort((box, level))
    runs = list(pairwise(np.searchsorted(level[order], np.arange(level.max() + 2))))
    levels = box_levels(line.load, [box[order[a:b]] for a, b in runs])
    parts = np.empty((4, len(down)))

    def add_up(piece: slice) -> None:
        here = order[piece]
        tree = levels[level[here[0]]]
        u = np.empty(len(here), dtype=complex)
        u.real = along[here] / tree.half - (2.0 * box[here] + 1.0)
        u.imag = down[here] / tree.half
        column = np.searchsorted(tree.ids, box[here])
        potential, slope = polynomial((row[column] for row in tree.inner[::-1]), u)
        if tree is not levels[0]:
            near, near_slope = outer_sum(tree, box[here], u)
            potential += near
            slope += near_slope
        slope *= u.imag
        sums = stresses(potential, slope) / (np.pi * tree.half)
        if tree is levels[0]:
            for i in range(0, len(here), _NEAR_BLOCK):
                block = slice(i, i + _NEAR_BLOCK)
                at = here[block]
                sums[:, block] += near_stress(line, nearest[at], rest[at], down[at], box[at])
        parts[:, here] = sums

    blocks = [slice(i, min(i + _BLOCK, stop)) for a, stop in runs for i in range(a, stop, _BLOCK)]
    for_each(add_up, blocks)
    return parts


_PAIRS = 2**14  # pairs of point and element at a time, which stay in the cache
# From so many elements, and pairs of point and element, on a tree is quicker.
_TREE_ELEMENTS, _TREE_PAIRS = 64, 20_000


def line_stress(line: LoadedLine, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """sx, sz, txz under p and sx under q, each the line's load (4, m) [Pa], at x, z (m,) [m]."""
    loaded = np.flatnonzero(line.load)
    if len(loaded) == 0:
        return np.zeros((4, len(x)))
    if len(loaded) < _TREE_ELEMENTS or len(loaded) * len(x) < _TREE_PAIRS:
        return direct_stress(line.part(loaded), x, z)
    return tree_stress(line.part(slice(loaded[0], loaded[-1] + 1)), x, z)


def direct_stress(line: LoadedLine, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """`line_stress` as the sum over all elements."""
    parts = np.empty((4, len(x)))
    step = max(1, _PAIRS // len(line.nodes))
    whole, nearest, rest = from_nearest(line.nodes, line.pitch, x)
    down = z / line.pitch

    def add_up(here: slice) -> None:
        offset = rest[here, None] + (nearest[here, None] - whole)
        depth = np.broadcast_to(down[here, None], offset.shape)
        unit = hat_at(offset, depth)
        for row, values in enumerate(unit.parts):
            parts[row, here] = values @ line.load

    for_each(add_up, (slice(i, i + step) for i in range(0, len(x), step)))
    return parts
