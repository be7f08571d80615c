"""The loaded side of a block: its nodes in order, and the nodal forces of hat pressures.

Nomenclature
    x_i = x0 + i pitch   hat nodes [m], i = 0 ... n-1; the outer two hats stick out by one pitch
    phi_i(x)             hat function: 1 at x_i, 0 at its neighbours, linear between
    N_a(x)               quadratic shape function of surface node a
    (d_x, d_z)           direction along which a pressure acts
    B                    (2k, n) nodal force of a unit hat, B[2a + c, i] = integral N_a phi_i d_c dx
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from meshes.block import BlockMesh

# Closer than this part of the block, or of the edge or hat in question, is in the same place. The
# smallest elements of a block are 1e-6 of it.
SAME_POINT = 1e-9

# A direction that varies along the surface is integrated with it: with a linear direction the
# integrand has degree 4, which three Gauss points integrate exactly.
GAUSS_POINTS = 3

Direction = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class Surface:
    """Nodes of the top side, ascending: vertices at even places, midpoints at odd ones.

    x       (k,) [m]
    point   (k,) numbers in the mesh's points
    """

    x: np.ndarray
    point: np.ndarray


@dataclass(frozen=True)
class BoundaryPoints:
    """Numbers of the mesh points (vertices and midpoints) on each side of the block."""

    top: np.ndarray
    bottom: np.ndarray
    left: np.ndarray
    right: np.ndarray


def boundary_points(mesh: BlockMesh) -> BoundaryPoints:
    """Mesh points on the flat block's four sides; a corner belongs to both of its sides."""
    x, z = mesh.points.T
    half, depth = mesh.spec.half_width, mesh.spec.depth

    def side(distance: np.ndarray, extent: float) -> np.ndarray:
        return np.flatnonzero(np.abs(distance) <= SAME_POINT * extent)

    return BoundaryPoints(
        top=side(z, depth),
        bottom=side(z - depth, depth),
        left=side(x + half, half),
        right=side(x - half, half),
    )


def surface_of(mesh: BlockMesh) -> Surface:
    """Top side of the flat block, sorted by x.

    Raises ValueError if the points there are not vertices and their midpoints in turn.
    """
    top = boundary_points(mesh).top
    top = top[np.argsort(mesh.points[top, 0])]
    x = mesh.points[top, 0]
    if len(x) < 5 or len(x) % 2 == 0:
        raise ValueError(f"the top side has {len(x)} points, not vertices and midpoints in turn")
    edge = np.diff(x[::2])
    if np.any(np.abs(x[1::2] - 0.5 * (x[:-1:2] + x[2::2])) > SAME_POINT * edge):
        raise ValueError("a midpoint of the top side is not in the middle of its edge")
    return Surface(x, top)


def hat_nodes(x0: float, pitch: float, count: int) -> np.ndarray:
    """x (count,) [m] of the hat pressures' nodes."""
    return x0 + pitch * np.arange(count)


def straight_down(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(d_x, d_z) = (0, 1): the normal of a flat surface, into the body."""
    return np.zeros_like(x), np.ones_like(x)


def tangent_of(direction: Direction) -> Direction:
    """Direction of the sliding traction: `direction` turned by a right angle, towards +x."""

    def tangent(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        along, down = direction(x)
        return down, -along

    return tangent


def hat_forces(
    surface: Surface, x0: float, pitch: float, count: int, direction: Direction = straight_down
) -> csr_matrix:
    """Nodal forces B (2k, count) [m] of unit hat pressures, exact.

    A pressure is a force per length of x, not of arc. Rows 2a and 2a+1 are the x and z force at
    surface node a. The integrals run over the pieces between element vertices and hat nodes, on
    which the integrand is a polynomial. With a `direction` that varies they are exact up to
    its linear part on each piece.

    Raises ValueError if a hat sticks out of the surface.
    """
    node = x0 + pitch * np.arange(-1, count + 1)
    vertex = surface.x[::2]
    slack = SAME_POINT * pitch
    if node[0] < vertex[0] - slack or node[-1] > vertex[-1] + slack:
        raise ValueError(
            f"the pressures reach from {node[0]:g} m to {node[-1]:g} m, "
            f"but the surface only from {vertex[0]:g} m to {vertex[-1]:g} m"
        )
    within = vertex[(vertex > node[0]) & (vertex < node[-1])]
    cut = np.union1d(node, within)
    left, length = cut[:-1], np.diff(cut)
    place, weight = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    x = left[:, None] + 0.5 * length[:, None] * (1.0 + place)
    weight = 0.5 * length[:, None] * weight

    middle = left + 0.5 * length
    element = np.clip(np.searchsorted(vertex, middle) - 1, 0, len(vertex) - 2)
    interval = np.clip(np.searchsorted(node, middle) - 1, 0, count)
    t = (x - vertex[element, None]) / (vertex[element + 1] - vertex[element])[:, None]
    shape = np.stack([(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)])
    rising = (x - node[interval, None]) / pitch
    hat = np.stack([1.0 - rising, rising])
    along = np.stack(np.broadcast_arrays(*direction(x)))

    # value[a, c, h, piece]: shape function, component, hat, piece
    value = np.einsum("aeg,ceg,heg,eg->ache", shape, along, hat, weight, optimize=True)
    row = 2 * (2 * element + np.arange(3)[:, None])[:, None, None, :]
    row = row + np.arange(2)[None, :, None, None]
    column = (interval + np.arange(-1, 1)[:, None])[None, None, :, :]
    row, column = np.broadcast_arrays(row, column)
    inside = (column >= 0) & (column < count) & (value != 0.0)
    return csr_matrix(
        (value[inside], (row[inside], column[inside])), shape=(2 * len(surface.x), count)
    )
