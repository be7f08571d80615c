"""The boxes of a tree on the surface: expansions of a load in each, passed up and down the levels.

What stands in a box and in its three neighbours on either side is near; all the rest is in the
box's inner expansion. Its coefficients are the parent's, moved, and the outer ones of those halves
of the parent's near boxes that are not near themselves.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from analytic.stress.potential import Element
from analytic.stress.translations import (
    ORDER,
    inner_to_child,
    nodes_to_outer,
    outer_to_inner,
    outer_to_parent,
)

LEAF = 8  # nodes of the smallest box
NEIGHBOURS = 3
# Outer coefficients summed for a box so many boxes away: less than 1e-15 of its load is left out.
_OUTER_ORDERS = (ORDER, 46, 28, 22)
_BLOCK = 2048  # boxes at a time


@dataclass(frozen=True)
class Level:
    """Boxes of `half` pitches half-width: `ids` (b,) of those over points, sorted.

    outer  (ORDER, boxes + 1) of all boxes over the load, and zero
    inner  (ORDER, b)
    """

    half: float
    ids: np.ndarray
    outer: np.ndarray
    inner: np.ndarray


def box_levels(load: np.ndarray, element: Element, boxes: list[np.ndarray]) -> list[Level]:
    """Expansions on each level of boxes, the finest first; `boxes` of the points on each."""
    count = -(-len(load) // LEAF)
    padded = np.zeros(count * LEAF)
    padded[: len(load)] = load
    outer = [nodes_to_outer(LEAF, element) @ padded.reshape(count, LEAF).T]
    while outer[-1].shape[1] > 1 or len(outer) < len(boxes):
        finer = outer[-1]
        if finer.shape[1] % 2:
            finer = np.column_stack([finer, np.zeros(ORDER)])
        outer.append(outer_to_parent(-1) @ finer[:, ::2] + outer_to_parent(1) @ finer[:, 1::2])
    ids = []
    for index in range(len(outer)):
        own = np.unique(boxes[index]) if index < len(boxes) else np.empty(0, dtype=int)
        ids.append(np.union1d(own, ids[-1] // 2) if ids else own)
    levels = []
    for index in reversed(range(len(outer))):
        sources = np.column_stack([outer[index], np.zeros(ORDER)])
        inner = np.zeros((ORDER, len(ids[index])))
        # From the third level on, counted from the box that holds the whole load, boxes are far.
        for right in (0, 1) if len(levels) > 1 else ():
            here = np.flatnonzero(ids[index] % 2 == right)
            parent = np.searchsorted(levels[-1].ids, ids[index][here] // 2)
            inner[:, here] = inner_to_child(2 * right - 1) @ levels[-1].inner[:, parent]
            for i in range(0, len(here), _BLOCK):
                inner[:, here[i : i + _BLOCK]] += _from_far(
                    sources, ids[index][here[i : i + _BLOCK]], right
                )
        levels.append(Level(0.5 * LEAF * 2.0**index, ids[index], sources, inner))
    return levels[::-1]


def _from_far(sources: np.ndarray, box: np.ndarray, right: int) -> np.ndarray:
    """Inner coefficients of boxes, all `right` or left halves, from what only their parents had."""
    away, matrix = _far_boxes(right)
    found = inside(box + away[:, None], sources.shape[1] - 1)
    if np.all(found == sources.shape[1] - 1):
        return np.zeros((ORDER, len(box)))
    return matrix @ sources.T[found].transpose(0, 2, 1).reshape(-1, len(box))


@cache
def _far_boxes(right: int) -> tuple[np.ndarray, np.ndarray]:
    """Distances [boxes] to the halves of the parent's near boxes that are not near themselves.

    And the matrix (ORDER, distances * ORDER) that takes their outer coefficients to inner ones.
    """
    away = np.arange(-2 * NEIGHBOURS - right, 2 * NEIGHBOURS + 2 - right)
    away = away[np.abs(away) > NEIGHBOURS]
    return away, np.hstack([outer_to_inner(int(boxes)) for boxes in away])


def inside(box: np.ndarray, count: int) -> np.ndarray:
    """Boxes of the load by number, and `count` for those beyond it."""
    return np.where((box >= 0) & (box < count), box, count)


def inner_sum(tree: Level, box: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """sum L_l u^l of each point's box (points,), and its derivative in u."""
    column = np.searchsorted(tree.ids, box)
    value, slope = np.zeros_like(u), np.zeros_like(u)
    for row in tree.inner[::-1]:
        slope *= u
        slope += value
        value *= u
        value += row[column]
    return value, slope


def outer_sum(tree: Level, box: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """sum M_k / u^(k+1) over the near boxes, and its derivative in u."""
    total, change = np.zeros_like(u), np.zeros_like(u)
    for away in range(-NEIGHBOURS, NEIGHBOURS + 1):
        column = inside(box + away, tree.outer.shape[1] - 1)
        v = 1.0 / (u - 2.0 * away)
        value, slope = np.zeros_like(u), np.zeros_like(u)
        for row in tree.outer[_OUTER_ORDERS[abs(away)] - 1 :: -1]:
            slope *= v
            slope += value
            value *= v
            value += row[column]
        total += v * value
        change -= v * v * (value + v * slope)
    return total, change
