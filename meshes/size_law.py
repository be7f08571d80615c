"""How large an element may be at a point of the block.

The size grows linearly with the distance to the ground that will be touched, is capped inside the
window of a stress field, and leaves at least a few elements across a thin block:

    s(x, z) = min(h + g d,  s_w + g d_w,  s_max)

A coating adds two bounds, c + g d_c and, so that no stretched element is too long, l + g d_l.

Nomenclature (lengths in m)

    s       wanted edge of the elements
    h       edge on the refined intervals, spec.surface_size or a whole fraction of it
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


def edges_per_size(spec: BlockSpec) -> int:
    """Equal parts into which each stretch of one surface_size is cut.

    One, unless a thin block, a fine window or a thin coating wants smaller elements at the surface
    than surface_size: then every multiple of surface_size stays a node.
    """
    finest = min([largest_size(spec), *(size for *_, size in boxes(spec))])
    return max(1, math.ceil(spec.surface_size / finest * (1.0 - 1e-9)))


def surface_edge(spec: BlockSpec) -> float:
    """Length h [m] of the element edges on the refined intervals."""
    return spec.surface_size / edges_per_size(spec)


def uncapped_size(spec: BlockSpec, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The law but for s_max [m] at points x, z [m] (any equal shapes): grows at most by g."""
    x, z = np.asarray(x, dtype=float), np.asarray(z, dtype=float)
    starts, ends = np.asarray(spec.intervals, dtype=float).reshape(-1, 2).T
    left = np.searchsorted(starts, x, side="right") - 1
    past = np.where(left >= 0, x - ends[np.maximum(left, 0)], np.inf)
    right = np.minimum(left + 1, len(starts) - 1)
    before = np.where(left + 1 < len(starts), starts[right] - x, np.inf)
    along = np.maximum(0.0, np.minimum(past, before))
    size = surface_edge(spec) + spec.growth * np.hypot(along, z)
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
    flat_ends = [float(end) for interval in spec.intervals for end in interval]
    count = len(flat_ends)
    h, growth, largest = surface_edge(spec), spec.growth, largest_size(spec)
    limits = boxes(spec)
    hypot = math.hypot

    def size(x: float, z: float) -> float:
        i = bisect_left(flat_ends, x)
        if i % 2 == 1:
            along = 0.0
        elif i == 0:
            along = flat_ends[0] - x
        elif i == count:
            along = x - flat_ends[-1]
        else:
            along = min(x - flat_ends[i - 1], flat_ends[i] - x)
        s = min(largest, h + growth * hypot(along, z))
        for x0, x1, z1, most in limits:
            outside = hypot(max(0.0, x0 - x, x - x1), max(0.0, z - z1))
            s = min(s, most + growth * outside)
        return s

    return size
