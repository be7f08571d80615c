"""The loaded side of a block: its nodes in order, and the nodal forces of hat pressures.

Nomenclature
    x_i                  hat nodes [m], i = 0 ... n+1, ascending; no pressure at the outer two
    phi_i(x)             hat function: 1 at x_i, 0 at its neighbours, linear between; i = 1 ... n
    t, x(t)              parameter on an edge of the surface, 0 to 1, and its x [m]: a quadratic
    N_a(t)               shape function of surface node a, of the displacement's degree
    (d_x, d_z)           direction along which a pressure acts
    B                    (2k, n) nodal force of a unit hat, B[2a + c, i] = integral N_a phi_i d_c dx
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from fem.body.nodes import Nodes
from fem.body.sums import matrix_of
from fem.body.triangle import edge_shapes
from meshes.block import BlockMesh, BlockSpec

# Points closer than this part of the block, edge or hat are the same; elements are 1e-6 or more.
SAME_POINT = 1e-9

# On edges with a central midpoint the integrand has degree 5 with cubic displacements and a linear
# direction, 3 more where the mesh is bent along x: five Gauss points integrate both exactly.
GAUSS_POINTS, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(5)

Direction = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class Surface:
    """Nodes of the top side in order: vertices at every `degree`-th index, inner nodes between."""

    x: np.ndarray  # (k,) [m] of the real body, ascending
    point: np.ndarray  # (k,) numbers among the body's nodes
    edges: np.ndarray  # (e, 3) x [m] of each edge's start, middle and end
    degree: int  # of the displacement


@dataclass(frozen=True)
class BoundaryPoints:
    """Numbers of the points on each side of the block."""

    top: np.ndarray
    bottom: np.ndarray
    left: np.ndarray
    right: np.ndarray


def boundary_points(flat: np.ndarray, spec: BlockSpec) -> BoundaryPoints:
    """Points of (n, 2) on the flat block's four sides; a corner belongs to both of its sides."""
    x, z = flat.T

    def side(distance: np.ndarray, extent: float) -> np.ndarray:
        return np.flatnonzero(np.abs(distance) <= SAME_POINT * extent)

    return BoundaryPoints(
        side(z, spec.depth),
        side(z - spec.depth, spec.depth),
        side(x + spec.half_width, spec.half_width),
        side(x - spec.half_width, spec.half_width),
    )


def surface_of(mesh: BlockMesh, nodes: Nodes) -> Surface:
    """Nodes on the top side, ordered along the flat block. Raises ValueError if the mesh's points
    there are not vertices and their midpoints in turn, or if the real surface overhangs."""
    top = _ordered(mesh.points, mesh.spec)
    flat, real = mesh.points[top, 0], (mesh.points + mesh.shift)[top, 0]
    if len(flat) < 5 or len(flat) % 2 == 0:
        raise ValueError(f"the top side has {len(flat)} points, not vertices and midpoints in turn")
    off = np.abs(flat[1::2] - 0.5 * (flat[:-1:2] + flat[2::2]))
    if np.any(off > SAME_POINT * np.diff(flat[::2])):
        raise ValueError("a midpoint of the top side is not in the middle of its edge")
    edges = np.column_stack([real[:-1:2], real[1::2], real[2::2]])
    length, bend = _length_and_bend(edges)
    if np.any(np.abs(bend) >= length):
        raise ValueError("the surface overhangs: x does not ascend along it")
    point = _ordered(nodes.flat, mesh.spec)
    return Surface(nodes.real[point, 0], point, edges, nodes.degree)


def straight_down(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(d_x, d_z) = (0, 1): the normal of a flat surface, into the body."""
    return np.zeros_like(x), np.ones_like(x)


def tangent_of(direction: Direction) -> Direction:
    """Direction of the sliding traction: `direction` rotated by a right angle, towards +x."""

    def tangent(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        along, down = direction(x)
        return down, -along

    return tangent


@dataclass(frozen=True)
class HatPoints:
    """Gauss points under hats, five on each piece between element vertices and hat nodes."""

    x: np.ndarray  # (e, g) [m]
    weight: np.ndarray  # (e, g) [m]
    shape: np.ndarray  # (a, e, g) shape functions of the piece's edge
    node: np.ndarray  # (a, e) their surface nodes
    hat: np.ndarray  # (2, e, g) the two hats over the piece
    column: np.ndarray  # (2, e) their numbers; -1 and count are the outer feet, without pressure


def hat_points(surface: Surface, hats: np.ndarray, cuts: Sequence[float] = ()) -> HatPoints:
    """Gauss points under `hats` (count + 2,) [m], with their outer feet. `cuts` [m] end further
    pieces. Raises ValueError if the hats' nodes do not ascend or a hat sticks out of the surface.
    """
    hats = np.asarray(hats, dtype=float)
    if hats.ndim != 1 or len(hats) < 3 or not np.all(np.diff(hats) > 0.0):
        raise ValueError("the hats' nodes must be three or more numbers that ascend")
    vertex = np.append(surface.edges[:, 0], surface.edges[-1, 2])
    pitch = np.diff(hats)
    low, high = SAME_POINT * pitch[[0, -1]]
    if hats[0] < vertex[0] - low or hats[-1] > vertex[-1] + high:
        raise ValueError(
            f"the pressures reach from {hats[0]:g} m to {hats[-1]:g} m, "
            f"but the surface only from {vertex[0]:g} m to {vertex[-1]:g} m"
        )
    inner = np.union1d(vertex, cuts)
    cut = np.union1d(hats, inner[(inner > hats[0]) & (inner < hats[-1])])
    middle = 0.5 * (cut[:-1] + cut[1:])
    element, interval = (np.searchsorted(ends[1:-1], middle) for ends in (vertex, hats))

    edge = surface.edges[element]
    begin, end = place_on(edge, cut[:-1]), place_on(edge, cut[1:])
    t = begin[:, None] + 0.5 * (end - begin)[:, None] * (1.0 + GAUSS_POINTS)
    length, bend = (value[:, None] for value in _length_and_bend(edge))
    x = edge[:, :1] + t * (length + bend * (1.0 - t))
    rising = (x - hats[interval, None]) / pitch[interval, None]
    return HatPoints(
        x=x,
        weight=0.5 * (end - begin)[:, None] * GAUSS_WEIGHTS * (length + bend * (1.0 - 2.0 * t)),
        shape=np.moveaxis(edge_shapes(t, surface.degree), -1, 0),
        node=surface.degree * element + np.arange(surface.degree + 1)[:, None],
        hat=np.stack([1.0 - rising, rising]),
        column=interval + np.arange(-1, 1)[:, None],
    )


def hat_forces(
    surface: Surface, hats: np.ndarray, direction: Direction = straight_down, periodic: bool = False
) -> csr_matrix:
    """Nodal forces B (2k, count) [m] of unit hat pressures. `hats` (count + 2,) [m] are the hats'
    nodes, ascending, with the outer feet; or (count + 1,) of a `periodic` surface from one side to
    the other, where the halves of the first hat are. A pressure is a force per length of x, not of
    arc. Rows 2a and 2a+1 are the x and z force at surface node a. Exact for a `direction` linear on
    each piece between vertices and hat nodes. Errors as of `hat_points`."""
    points, count = hat_points(surface, hats), len(hats) - 2
    along = np.stack(np.broadcast_arrays(*direction(points.x)))
    # value[a, c, h, piece]: shape function, component, hat, piece
    value = np.einsum("aeg,cheg->ache", points.shape * points.weight, along[:, None] * points.hat)
    row = 2 * points.node[:, None, None, :] + np.arange(2)[:, None, None]
    column = points.column + 1
    if periodic:
        column[column == count + 1] = 0
    forces = matrix_of(value, row, column, (2 * len(surface.x), count + 2))
    forces = forces[:, :-1] if periodic else forces[:, 1:-1]
    forces.eliminate_zeros()
    return forces


def nodal_on(hats: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values at all nodes of hats (count + 2,) from those (count,) of the hats: zero at their outer
    feet; on hats (count + 1,) of a periodic surface the first again."""
    periodic = len(hats) == len(values) + 1
    return np.append(values, values[0]) if periodic else np.pad(values, 1)


def _ordered(flat: np.ndarray, spec: BlockSpec) -> np.ndarray:
    """Numbers of the points (n, 2) on the flat block's top side, where it may be loaded, by x."""
    top = boundary_points(flat, spec).top
    if spec.loaded is not None:
        first, last = spec.loaded
        top = top[(flat[top, 0] >= first) & (flat[top, 0] <= last)]
    return top[np.argsort(flat[top, 0])]


def _length_and_bend(edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """L and c (e,) [m] of x(t) = x(0) + L t + c t (1 - t) on edges (e, 3)."""
    start, middle, end = edges.T
    return end - start, 4.0 * middle - 2.0 * (start + end)


def along_edges(edges: np.ndarray, edge: np.ndarray, t: np.ndarray) -> np.ndarray:
    """x (k,) [m] at t (k,), 0 to 1, of the edges numbered `edge` (k,) among (e, 3)."""
    length, bend = _length_and_bend(edges[edge])
    return edges[edge, 0] + t * (length + bend * (1.0 - t))


def place_on(edges: np.ndarray, x: np.ndarray) -> np.ndarray:
    """t (e,) at which edges (e, 3) have x (e,)."""
    length, bend = _length_and_bend(edges)
    slope, gone = length + bend, x - edges[:, 0]
    return 2.0 * gone / (slope + np.sqrt(np.maximum(slope**2 - 4.0 * bend * gone, 0.0)))


def values_at(surface: Surface, x: np.ndarray) -> csr_matrix:
    """Matrix (m, k) that gives values at x (m,) [m] from those at the surface's nodes (k,)."""
    edge = np.searchsorted(surface.edges[1:, 0], x)
    shape = edge_shapes(place_on(surface.edges[edge], x), surface.degree)
    column = surface.degree * edge[:, None] + np.arange(surface.degree + 1)
    return matrix_of(shape, np.arange(len(x))[:, None], column, (len(x), len(surface.x)))
