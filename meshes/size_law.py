"""How large an element may be at a point of the block.

The size grows linearly with the distance to the ground that will be touched, is capped inside the
window of a stress field, and leaves at least a few elements across a thin block:

    s(x, z) = min(h + g d,  s_w + g d_w,  s_max)

Under vertices of one's own the size follows the local edge, min(e(x) + g z, s_max); beyond them it
grows with the distance to the last of them. A coating adds two bounds, c + g d_c and, so that no
stretched element is too long, l + g d_l.

Nomenclature (lengths in m)

    s       wanted edge of the elements
    h       edge on the refined intervals, spec.surface_size or a whole fraction of it
    e(x)    local edge between spec.vertices, linear from one to the next
    g       spec.growth [-]
    d       distance in the plane to the nearest refined interval
    s_w     size asked for in the window;  d_w distance in the plane to the window
    s_max   a quarter of the block's smaller extent, half of what lies below a coating
    c       size in the core of the coating; d_c distance in the plane to it (`meshes.coating`)
    l       longest stretched element;  d_l depth below the coating
"""

import math
from bisect import bisect_left
from collections.abc import Callable

import numpy as np

from meshes.block import BlockSpec
from meshes.coating import LONGEST, core, layer_size

ELEMENTS_ACROSS = 4
ELEMENTS_BELOW = 2  # a coating


def largest_size(spec: BlockSpec) -> float:
    """Upper bound [m] of the size anywhere: ELEMENTS_ACROSS elements through the block."""
    largest = min(spec.depth, 2.0 * spec.half_width) / ELEMENTS_ACROSS
    if spec.interface is None:
        return largest
    return min(largest, (spec.depth - spec.interface) / ELEMENTS_BELOW)


def boxes(spec: BlockSpec) -> list[tuple[float, float, float, float]]:
    """Boxes x0, x1, z1, size [m] with z <= z1 in which no element is larger than size."""
    found = [] if spec.window is None else [spec.window]
    if spec.interface is not None:
        size, everywhere = layer_size(spec), (-spec.half_width, spec.half_width)
        found.append((*core(spec), spec.interface, size))
        found.append((*everywhere, spec.interface, LONGEST * size))
    return found


def finest_size(spec: BlockSpec) -> float:
    """Largest edge [m] that a thin block, a fine window or a thin coating allows at the surface."""
    return min([largest_size(spec), *(size for *_, size in boxes(spec))])


def parts_of(edge: np.ndarray, spec: BlockSpec) -> np.ndarray:
    """Equal parts into which edges [m] of the surface are cut to respect `finest_size`."""
    return np.maximum(1, np.ceil(edge / finest_size(spec) * (1.0 - 1e-9))).astype(int)


def edges_per_size(spec: BlockSpec) -> int:
    """Equal parts into which each stretch of one surface_size is cut.

    One, unless something wants smaller elements at the surface than surface_size: then every
    multiple of surface_size stays a node.
    """
    return int(parts_of(np.array(spec.surface_size), spec))


def surface_edge(spec: BlockSpec) -> float:
    """Length h [m] of the element edges on the refined intervals."""
    return spec.surface_size / edges_per_size(spec)


def own_vertices(spec: BlockSpec) -> np.ndarray:
    """spec.vertices and the points that cut their edges where something wants smaller ones [m]."""
    given = np.asarray(spec.vertices, dtype=float)
    pieces = [
        np.linspace(start, end, parts, endpoint=False)
        for start, end, parts in zip(
            given[:-1], given[1:], parts_of(np.diff(given), spec), strict=True
        )
    ]
    return np.concatenate([*pieces, given[-1:]])


def local_edges(vertices: np.ndarray) -> np.ndarray:
    """Mean length (k,) [m] of the one or two edges at each vertex (k,) [m]."""
    edge = np.diff(vertices)
    return 0.5 * (np.append(edge[:1], edge) + np.append(edge, edge[-1:]))


def uncapped_size(spec: BlockSpec, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The law but for s_max [m] at points x, z [m] (any equal shapes)."""
    x, z = np.asarray(x, dtype=float), np.asarray(z, dtype=float)
    if spec.vertices is None:
        starts, ends = np.asarray(spec.intervals, dtype=float).reshape(-1, 2).T
        edge = surface_edge(spec)
    else:
        vertices = own_vertices(spec)
        starts, ends = vertices[:1], vertices[-1:]
        edge = np.interp(x, vertices, local_edges(vertices))
    left = np.searchsorted(starts, x, side="right") - 1
    past = np.where(left >= 0, x - ends[np.maximum(left, 0)], np.inf)
    right = np.minimum(left + 1, len(starts) - 1)
    before = np.where(left + 1 < len(starts), starts[right] - x, np.inf)
    along = np.maximum(0.0, np.minimum(past, before))
    size = edge + spec.growth * np.hypot(along, z)
    for x0, x1, z1, most in boxes(spec):
        aside = np.maximum(0.0, np.maximum(x0 - x, x - x1))
        below = np.maximum(0.0, z - z1)
        size = np.minimum(size, most + spec.growth * np.hypot(aside, below))
    return size


def wanted_size(spec: BlockSpec, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Wanted element edge s [m] at points x, z [m] (any equal shapes)."""
    return np.minimum(uncapped_size(spec, x, z), largest_size(spec))


def point_size(spec: BlockSpec) -> Callable[[float, float], float]:
    """The same law for one point at a time, without numpy.

    gmsh asks once for each vertex that it tries: at 1 us a call this costs nothing, while the
    vectorised form would take longer than the meshing.
    """
    surface = own_vertices_size(spec) if spec.vertices is not None else interval_size(spec)
    growth, largest, limits, hypot = spec.growth, largest_size(spec), boxes(spec), math.hypot

    def size(x: float, z: float) -> float:
        edge, along = surface(x)
        s = min(largest, edge + growth * hypot(along, z))
        for x0, x1, z1, most in limits:
            outside = hypot(max(0.0, x0 - x, x - x1), max(0.0, z - z1))
            s = min(s, most + growth * outside)
        return s

    return size


def interval_size(spec: BlockSpec) -> Callable[[float], tuple[float, float]]:
    """Edge and distance [m] of the nearest refined interval for a place on the surface."""
    flat_ends = [float(end) for interval in spec.intervals for end in interval]
    count, h = len(flat_ends), surface_edge(spec)

    def surface(x: float) -> tuple[float, float]:
        i = bisect_left(flat_ends, x)
        if i % 2 == 1:
            return h, 0.0
        if i == 0:
            return h, flat_ends[0] - x
        if i == count:
            return h, x - flat_ends[-1]
        return h, min(x - flat_ends[i - 1], flat_ends[i] - x)

    return surface


def own_vertices_size(spec: BlockSpec) -> Callable[[float], tuple[float, float]]:
    """Local edge and distance [m] to the stretch of spec.vertices for a place on the surface."""
    array = own_vertices(spec)
    vertices, edges = array.tolist(), local_edges(array).tolist()
    slopes = (np.diff(local_edges(array)) / np.diff(array)).tolist()
    last = len(vertices) - 1

    def surface(x: float) -> tuple[float, float]:
        i = bisect_left(vertices, x)
        if i == 0:
            return edges[0], vertices[0] - x
        if i > last:
            return edges[last], x - vertices[last]
        return edges[i - 1] + slopes[i - 1] * (x - vertices[i - 1]), 0.0

    return surface
