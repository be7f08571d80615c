"""Size of an element at a point of the block, and the number of unknowns that follows from it.

The size grows linearly with the distance to the refined ranges, is capped inside the window of a
stress field, and leaves a few elements across a thin block:

    s(x, z) = min(h + g d,  s_w + g d_w,  s_max)

Under given vertices the size follows the local edge, min(e(x) + g z, s_max). A coating adds the
bounds c + g d_c in its core and l + g d_l, which limits the length of its stretched elements.

Nomenclature (lengths in m)
    s       wanted edge of the elements
    h       edge on the refined ranges, spec.surface_size or a whole fraction of it
    e(x)    local edge between spec.vertices, linear from one to the next
    g       spec.growth [-]
    d       distance in the plane to the nearest refined range
    s_w     size asked for in the window;  d_w distance in the plane to the window
    s_max   a quarter of the block's smaller extent, half of what lies below a coating
    c       size in the core of the coating;  d_c distance in the plane to it (`meshes.coating`)
    l       longest stretched element;  d_l depth below the coating"""

import math
import pickle
from bisect import bisect_left
from collections.abc import Callable
from functools import lru_cache

import numpy as np

from meshes.block import BlockSpec, MeshError, check_spec
from meshes.coating import LAYERS, LONGEST, core, layer_size

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
    limits = [] if spec.window is None else [spec.window]
    if spec.interface is not None:
        size, half = layer_size(spec), spec.half_width
        limits.append((*core(spec), spec.interface, size))
        limits.append((-half, half, spec.interface, LONGEST * size))
    return limits


def finest_size(spec: BlockSpec) -> float:
    """Largest edge [m] that a thin block, a fine window or a thin coating allows at the surface."""
    return min([largest_size(spec), *(size for *_, size in boxes(spec))])


def parts_of(edge: np.ndarray, spec: BlockSpec) -> np.ndarray:
    """Equal parts into which edges [m] of the surface are cut to respect `finest_size`."""
    return np.maximum(1, np.ceil(edge / finest_size(spec) * (1.0 - 1e-9))).astype(int)


def edges_per_size(spec: BlockSpec) -> int:
    """Equal parts into which each edge of surface_size is cut to respect `finest_size`."""
    return int(parts_of(np.array(spec.surface_size), spec))


def surface_edge(spec: BlockSpec) -> float:
    """Length h [m] of the element edges on the refined ranges."""
    return spec.surface_size / edges_per_size(spec)


def own_vertices(spec: BlockSpec) -> np.ndarray:
    """spec.vertices [m], their edges cut where `finest_size` is smaller."""
    vertices = np.asarray(spec.vertices, dtype=float)
    parts = parts_of(np.diff(vertices), spec)
    edge = np.repeat(np.arange(len(parts)), parts)
    number = np.arange(len(edge)) - np.repeat(np.cumsum(parts) - parts, parts)
    cut = number * (np.diff(vertices) / parts)[edge] + vertices[edge]
    return np.append(cut, vertices[-1])


def local_edges(vertices: np.ndarray) -> np.ndarray:
    """Mean length (k,) [m] of the one or two edges at each vertex (k,) [m]."""
    edge = np.diff(vertices)
    return 0.5 * (np.append(edge[:1], edge) + np.append(edge, edge[-1:]))


def uncapped_size(spec: BlockSpec, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The law without s_max [m] at points x, z [m] (shapes that broadcast)."""
    x, z = np.asarray(x, dtype=float), np.asarray(z, dtype=float)
    if spec.vertices is None:
        starts, ends = np.asarray(spec.intervals, dtype=float).reshape(-1, 2).T
        edge = surface_edge(spec)
    else:
        vertices = own_vertices(spec)
        starts, ends = vertices[:1], vertices[-1:]
        edge = np.interp(x, vertices, local_edges(vertices))
    # the nearest of several intervals, told by the middles between them
    left = 0 if len(starts) == 1 else np.searchsorted(0.5 * (ends[:-1] + starts[1:]), x)
    along = np.maximum(0.0, np.maximum(starts[left] - x, x - ends[left]))
    size = edge + spec.growth * np.hypot(along, z)
    for x0, x1, z1, most in boxes(spec):
        aside, below = np.maximum(0.0, np.maximum(x0 - x, x - x1)), np.maximum(0.0, z - z1)
        size = np.minimum(size, most + spec.growth * np.hypot(aside, below))
    return size


def wanted_size(spec: BlockSpec, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Wanted element edge s [m] at points x, z [m] (shapes that broadcast)."""
    return np.minimum(uncapped_size(spec, x, z), largest_size(spec))


def point_size(spec: BlockSpec) -> Callable[[float, float], float]:
    """`wanted_size` for one point at a time, without numpy: 1 us a call. gmsh calls it for each
    vertex that it tries; `wanted_size` would take longer than the meshing."""
    surface = own_vertices_size(spec) if spec.vertices is not None else interval_size(spec)
    growth, largest, limits, hypot = spec.growth, largest_size(spec), boxes(spec), math.hypot

    def size(x: float, z: float) -> float:
        edge, along = surface(x)
        s = min(largest, edge + growth * hypot(along, z))
        for x0, x1, z1, most in limits:
            s = min(s, most + growth * hypot(max(0.0, x0 - x, x - x1), max(0.0, z - z1)))
        return s

    return size


def interval_size(spec: BlockSpec) -> Callable[[float], tuple[float, float]]:
    """Function of x [m]: the edge of the nearest refined range and the distance to it [m]."""
    ends = [-math.inf, *(float(end) for interval in spec.intervals for end in interval), math.inf]
    h = surface_edge(spec)

    def surface(x: float) -> tuple[float, float]:
        i = bisect_left(ends, x)
        return h, 0.0 if i % 2 == 0 else min(x - ends[i - 1], ends[i] - x)

    return surface


def own_vertices_size(spec: BlockSpec) -> Callable[[float], tuple[float, float]]:
    """Function of x [m]: the local edge and the distance to the range of spec.vertices [m]."""
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


# gmsh's Delaunay triangles have 1.17 times the number that equilateral ones of the wanted edge
# would have: measured 1.15 to 1.19 over half-planes, windows and sets of asperities.
TRIANGLES_PER_EQUILATERAL = 1.17
# A box is small enough when the size varies by less than this part of its mean within it.
VARIATION = 0.5
MOST_BOXES = 2_000_000  # at once; each holds several elements
GAUSS, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(3)


def estimate_unknowns(spec: BlockSpec) -> int:
    """Number of displacements, before any is fixed, of the second-order mesh of spec. From the
    integral of the size law, within 25 % of `meshes.build.build_block`. Raises MeshError if spec
    cannot be meshed. Known ones are looked up: forecasts, tasks and levels ask again."""
    check_spec(spec)
    return _estimated(pickle.dumps(spec))


@lru_cache(256)
def _estimated(pickled: bytes) -> int:
    spec = pickle.loads(pickled)
    half, depth = spec.half_width, spec.depth
    low, high = (-half, half) if spec.interface is None else core(spec)
    filled, layered = [[low, high, 0.0, spec.interface or depth]], []
    if spec.interface is not None:
        filled.append([-half, half, spec.interface, depth])
        beside = (-half, low), (high, half)  # none where the core reaches to the sides
        layered = [[start, stop, 0.0, 0.0] for start, stop in beside if stop > start]
    outer = [[-half, half, z, z] for z in (0.0, depth)]
    outer += [[x, x, 0.0, depth] for x in (-half, half)]
    # Euler: v - e + m = 1 and 2 e = 3 m + b give v + e = 1 + 2 m + b.
    triangles = [TRIANGLES_PER_EQUILATERAL * 4.0 / np.sqrt(3.0)] * len(filled)
    factors = [2.0 * count for count in triangles + [2.0 * LAYERS] * len(layered)] + [1.0] * 4
    return round(2.0 * (1.0 + sum_of_integrals(spec, filled + layered + outer, factors)))


def sum_of_integrals(spec: BlockSpec, boxes: list[list[float]], factors: list[float]) -> float:
    """Integrals of wanted_size ** -2 over boxes x0, x1, z0, z1 [m] and of wanted_size ** -1 along
    those of no width or no height, each times its factor. Boxes are bisected across their longer
    extent until the law, whose slope is at most the growth, is nearly constant in each or capped
    throughout; then three Gauss points each way."""
    boxes, cap, even = np.column_stack([boxes, factors]), largest_size(spec), []
    while len(boxes):
        if len(boxes) > MOST_BOXES:
            raise MeshError(
                f"elements of {spec.surface_size:.3g} m in a body of {spec.depth:.3g} m are too "
                "many to count"
            )
        x, half_x, z, half_z = centres(boxes)
        change, size = spec.growth * np.hypot(half_x, half_z), uncapped_size(spec, x, z)
        done = (change <= VARIATION * np.minimum(size, cap)) | (size - change >= cap)
        even.append(boxes[done])
        left, right, wide = boxes[~done], boxes[~done], (half_x >= half_z)[~done]
        left[wide, 1] = right[wide, 0] = x[~done][wide]
        left[~wide, 3] = right[~wide, 2] = z[~done][~wide]
        boxes = np.concatenate([left, right])
    even = np.concatenate(even)
    x, half_x, z, half_z = centres(even)
    at = (x[:, None] + half_x[:, None] * GAUSS)[..., None], (z[:, None] + half_z[:, None] * GAUSS)
    density = 1.0 / wanted_size(spec, at[0], at[1][:, None])
    density[(half_x > 0.0) & (half_z > 0.0)] **= 2
    mean = (density @ GAUSS_WEIGHTS) @ GAUSS_WEIGHTS / 4.0
    width, height = (np.where(half > 0.0, 2.0 * half, 1.0) for half in (half_x, half_z))
    return float((even[:, 4] * mean * width * height).sum())


def centres(boxes: np.ndarray) -> tuple[np.ndarray, ...]:
    """x and half the width, z and half the height (n,) [m] of boxes x0, x1, z0, z1."""
    x0, x1, z0, z1 = boxes.T[:4]
    return 0.5 * (x0 + x1), 0.5 * (x1 - x0), 0.5 * (z0 + z1), 0.5 * (z1 - z0)
