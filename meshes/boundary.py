"""Vertices on the sides of the block and on a coating's interface, graded off refined ranges."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from meshes.block import BlockSpec, MeshError
from meshes.coating import LAYERS, core
from meshes.size_law import edges_per_size, own_vertices, wanted_size

# A refined range may miss a whole number of edges by this part of an edge (rounding of its ends).
WHOLE_EDGES_TOLERANCE = 1e-6
# A shorter rest beside a refined range would force elements much finer than asked for.
LEAST_LEFTOVER = 0.45


def graded_line(start: float, end: float, size: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Points (n + 1,) from start to end [m], start < end, spaced by size(t) [m]. Of 1/size, summed
    over cells short enough for a law of slope one at most, each edge holds the same part."""
    cells = np.array([start, end])
    while True:
        middle = 0.5 * (cells[:-1] + cells[1:])
        # The slack keeps ties the same in other units of length.
        long = np.diff(cells) > (0.25 + 1e-9) * size(middle)
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
    """Edges of surface_size on the refined range [start, end] [m]; MeshError if not whole."""
    lengths = (end - start) / spec.surface_size
    whole = max(1, round(lengths))
    if abs(lengths - whole) > WHOLE_EDGES_TOLERANCE + 1e-9 * whole:
        raise MeshError(
            f"interval {start:g} .. {end:g} m is {lengths:.6g} surface sizes of "
            f"{spec.surface_size:g} m long: it must be a whole number of them"
        )
    return whole * edges_per_size(spec)


def sizes_on(spec: BlockSpec, axis: int, at: float) -> Callable[[np.ndarray], np.ndarray]:
    """Wanted sizes [m] on the line x = at (axis 0) or z = at (axis 1), at z or x [m]."""

    def wanted(place: np.ndarray) -> np.ndarray:
        return wanted_size(spec, *((at, place) if axis == 0 else (place, at)))

    return wanted


def top_nodes(spec: BlockSpec) -> np.ndarray:
    """Ascending x [m] of the vertices on z = 0, with both corners and the ends of a coating's core.
    Raises MeshError if a refined range is no whole number of edges or leaves too short a rest."""
    size = sizes_on(spec, 1, 0.0)
    half, pieces = spec.half_width, []
    reached = -half

    def fill(to: float) -> None:
        rest, h = to - reached, size(np.array([reached, to])).min()
        if rest <= WHOLE_EDGES_TOLERANCE * h:
            return
        if rest < LEAST_LEFTOVER * h:
            raise MeshError(
                f"only {rest:g} m are left at x = {to:g} m between refined ranges or to the "
                f"side of the block: leave none, or at least {LEAST_LEFTOVER} of an edge ({h:g} m)"
            )
        pieces.append(graded_line(reached, to, size)[:-1])

    low, high = (-half, half) if spec.interface is None else core(spec)
    fill(low)
    reached = low
    if spec.vertices is None:
        ranges = np.asarray(spec.intervals, dtype=float)
        inner = [np.linspace(*interval, interval_edges(spec, *interval) + 1) for interval in ranges]
    else:
        inner = [own_vertices(spec)]
    for inside in inner:
        fill(inside[0])
        pieces.append(inside[:-1])
        reached = inside[-1]
    fill(high)
    reached = high
    fill(half)
    x = np.concatenate([*pieces, [half]])
    x[0] = -half
    return x


@dataclass(frozen=True)
class Outline:
    """Straight lines of vertices, and the regions between them that gmsh fills. A region is given
    by the lines around it, in positive sense in (x, z): k + 1 for line k, -(k + 1) against it."""

    points: np.ndarray  # (n, 2) [m]
    lines: tuple[np.ndarray, ...]  # numbers of the points on each line, both ends included
    regions: tuple[tuple[int, ...], ...]
    beside: tuple[np.ndarray, ...] = ()  # x [m] of the columns of a coating's stretched layers


def outline(spec: BlockSpec) -> Outline:
    """The four sides of the block; with a coating its core and the rest of the block below it."""

    def line(x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        return np.column_stack(np.broadcast_arrays(x, z))

    def down(x: float, start: float, stop: float) -> np.ndarray:
        return line(x, graded_line(start, stop, sizes_on(spec, 0, x)))

    def across(start: float, stop: float, z: float) -> np.ndarray:
        return line(graded_line(start, stop, sizes_on(spec, 1, z)), z)

    half, depth, top = spec.half_width, spec.depth, top_nodes(spec)
    bottom = across(-half, half, depth)[::-1]
    if spec.interface is None:
        sides = [line(top, 0.0), down(half, 0.0, depth), bottom, down(-half, 0.0, depth)[::-1]]
        return joined(sides, ((1, 2, 3, 4),))

    at, (low, high) = spec.interface, core(spec)
    layers = np.linspace(0.0, at, LAYERS + 1)
    lines = [
        line(top[(low <= top) & (top <= high)], 0.0),
        line(high, layers) if high < half else down(half, 0.0, at),
        across(low, high, at)[::-1],
        (line(low, layers) if low > -half else down(-half, 0.0, at))[::-1],
        down(half, at, depth),
        bottom,
        down(-half, at, depth)[::-1],
    ]
    # The rest of the interface, from left to right, belongs to what lies below alone.
    before, after = top[top <= low], top[top >= high]
    below = [5, 6, 7]
    if low > -half:
        lines.append(line(before, at))
        below.append(len(lines))
    below.append(-3)
    if high < half:
        lines.append(line(after, at))
        below.append(len(lines))
    beside = tuple(x for x in (before[::-1], after) if len(x) > 1)
    return replace(joined(lines, ((1, 2, 3, 4), tuple(below))), beside=beside)


def joined(lines: list[np.ndarray], regions: tuple[tuple[int, ...], ...]) -> Outline:
    """Outline of lines (k, 2) [m] that meet at their ends."""
    points, ends, numbers, count = [], {}, [], 0
    for line in lines:
        start, stop = (tuple(line[k].tolist()) for k in (0, -1))
        new = np.ones(len(line), dtype=bool)
        new[0], new[-1] = start not in ends, stop not in ends
        number = count + np.cumsum(new) - 1
        number[0], number[-1] = ends.setdefault(start, number[0]), ends.setdefault(stop, number[-1])
        points.append(line[new])
        numbers.append(number)
        count += len(points[-1])
    return Outline(np.concatenate(points), tuple(numbers), regions)
