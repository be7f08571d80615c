"""Nodes on the four sides of the block: equal edges on the refined intervals, graded elsewhere."""

from collections.abc import Callable

import numpy as np

from meshes.block import BlockSpec
from meshes.errors import MeshError
from meshes.size_law import edges_per_size, surface_edge, wanted_size

# An interval may miss a whole number of edges by this part of an edge (rounding of its ends).
WHOLE_EDGES_TOLERANCE = 1e-6
# Shorter leftovers beside an interval would force elements much finer than asked for.
LEAST_LEFTOVER = 0.45


def graded_line(start: float, end: float, size: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Points (n + 1,) from start to end [m], start < end, spaced by size(t) [m].

    The density 1/size is integrated over cells short enough for a law whose slope is at most one;
    each edge then holds the same share of the integral, so that neighbours fit together.
    """
    cells = np.array([start, end])
    while True:
        middle = 0.5 * (cells[:-1] + cells[1:])
        long = np.diff(cells) > 0.25 * size(middle)
        if not long.any():
            break
        cells = np.sort(np.concatenate([cells, middle[long]]))
    width = np.diff(cells)
    density = (1.0 / size(cells[:-1]) + 4.0 / size(middle) + 1.0 / size(cells[1:])) / 6.0
    edges = np.concatenate([[0.0], np.cumsum(width * density)])
    n = max(1, round(edges[-1]))
    points = np.interp(np.linspace(0.0, edges[-1], n + 1), edges, cells)
    points[[0, -1]] = start, end
    return points


def interval_edges(spec: BlockSpec, start: float, end: float) -> int:
    """Number of equal edges on the refined interval [start, end] [m].

    Raises MeshError when it is not a whole number of surface_size.
    """
    lengths = (end - start) / spec.surface_size
    whole = max(1, round(lengths))
    if abs(lengths - whole) > WHOLE_EDGES_TOLERANCE + 1e-9 * whole:
        raise MeshError(
            f"interval {start:g} .. {end:g} m is {lengths:.6g} surface sizes of "
            f"{spec.surface_size:g} m long: it must be a whole number of them"
        )
    return whole * edges_per_size(spec)


def top_nodes(spec: BlockSpec) -> np.ndarray:
    """Ascending x [m] of the vertices on z = 0, both corners included.

    Raises MeshError when an interval is not a whole number of edges or leaves too short a rest.
    """

    def size(x: np.ndarray) -> np.ndarray:
        return wanted_size(spec, x, np.zeros_like(x))

    h = surface_edge(spec)
    pieces = []
    reached = -spec.half_width

    def fill(to: float) -> None:
        rest = to - reached
        if rest <= WHOLE_EDGES_TOLERANCE * h:
            return
        if rest < LEAST_LEFTOVER * h:
            raise MeshError(
                f"only {rest:g} m are left at x = {to:g} m between refined intervals or to the "
                f"side of the block: leave none, or at least {LEAST_LEFTOVER} of an edge ({h:g} m)"
            )
        pieces.append(graded_line(reached, to, size)[:-1])

    for start, end in np.asarray(spec.intervals, dtype=float):
        fill(start)
        pieces.append(np.linspace(start, end, interval_edges(spec, start, end) + 1)[:-1])
        reached = end
    fill(spec.half_width)
    x = np.concatenate([*pieces, [spec.half_width]])
    x[0] = -spec.half_width
    return x


def boundary_loop(spec: BlockSpec) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (n, 2) [m] once around the block and the (4,) indices of its corners.

    Starts at (-half_width, 0) along the top to (half_width, 0), then down the right side, back
    along the bottom and up the left side: positive sense of rotation in (x, z).
    """
    half, depth = spec.half_width, spec.depth

    def across(z: float) -> Callable[[np.ndarray], np.ndarray]:
        return lambda x: wanted_size(spec, x, np.full_like(x, z))

    def down(x: float) -> Callable[[np.ndarray], np.ndarray]:
        return lambda z: wanted_size(spec, np.full_like(z, x), z)

    top = top_nodes(spec)
    right = graded_line(0.0, depth, down(half))
    bottom = graded_line(-half, half, across(depth))[::-1]
    left = graded_line(0.0, depth, down(-half))[::-1]
    sides = [
        np.column_stack([top, np.zeros_like(top)])[:-1],
        np.column_stack([np.full_like(right, half), right])[:-1],
        np.column_stack([bottom, np.full_like(bottom, depth)])[:-1],
        np.column_stack([np.full_like(left, -half), left])[:-1],
    ]
    corners = np.cumsum([0, *(len(side) for side in sides[:-1])])
    return np.concatenate(sides), corners
