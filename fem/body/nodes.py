"""The displacement's nodes on a mesh of six-node triangles: numbered by topology, then placed.

Degree 1: the vertices, in the order of their numbers among the mesh's points. Degree 2: the mesh's
points. Degree 3: the vertices, two nodes to an edge, one to a triangle, in that order. Whatever
the degree, an element has the shape that its six points give it.
"""

from dataclasses import dataclass

import numpy as np

from fem.body.triangle import lattice, reference_nodes, shapes
from meshes.block import BlockMesh
from meshes.quality import real_points
from meshes.second_order import EDGES


@dataclass(frozen=True)
class Nodes:
    """Where displacements are known.

    degree     1, 2 or 3
    elements   (m, 3, 6 or 10) numbers of each triangle's nodes, in the order of `fem.body.triangle`
    flat       (n, 2) [m] places in the flat block
    real       (n, 2) [m] places in the real body
    """

    degree: int
    elements: np.ndarray
    flat: np.ndarray
    real: np.ndarray


def nodes_of(mesh: BlockMesh, degree: int) -> Nodes:
    """Nodes of displacements of that degree. Raises ValueError for another degree than 1, 2, 3."""
    if degree not in (1, 2, 3):
        raise ValueError(f"the degree of the displacement must be 1, 2 or 3, not {degree}")
    if degree == 2:
        return Nodes(2, mesh.triangles, mesh.points, real_points(mesh))
    vertices, corner = np.unique(mesh.triangles[:, :3], return_inverse=True)
    elements = corner.reshape(-1, 3)
    if degree == 3:
        elements = _cubic(elements, len(vertices), mesh.triangles[:, 3:])
    share = shapes(reference_nodes(degree))

    def placed(points: np.ndarray) -> np.ndarray:
        place = np.empty((elements.max() + 1, 2))
        place[elements] = np.einsum("mac,qa->mqc", points[mesh.triangles], share, optimize=True)
        return place

    return Nodes(degree, elements, placed(mesh.points), placed(real_points(mesh)))


def _cubic(corner: np.ndarray, vertices: int, middle: np.ndarray) -> np.ndarray:
    """Nodes (m, 10) of cubic triangles, from their vertices and their edges' midpoints (m, 3).

    The two nodes of an edge are numbered from its vertex of the lower number to the other one.
    """
    edges, edge = np.unique(middle, return_inverse=True)
    start = corner[:, EDGES]
    backward = start[..., 0] > start[..., 1]
    first = vertices + 2 * edge.reshape(-1, 3) + backward
    second = vertices + 2 * edge.reshape(-1, 3) + ~backward
    inside = vertices + 2 * len(edges) + np.arange(len(corner))
    along = np.stack([first, second], axis=-1).reshape(-1, 6)
    return np.column_stack([corner, along, inside])


def at_points(nodes: Nodes, mesh: BlockMesh, value: np.ndarray) -> np.ndarray:
    """Values (..., points, 2) at the mesh's points from those at the nodes (..., n, 2)."""
    if nodes.degree == 2:
        return value
    result = np.empty((*value.shape[:-2], *mesh.points.shape))
    share = shapes(reference_nodes(2), nodes.degree)
    result[..., mesh.triangles, :] = np.einsum(
        "...mac,qa->...mqc", value[..., nodes.elements, :], share
    )
    return result


def in_order(degree: int, order: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """Where another program's nodes of each triangle are among ours.

    order      (k, 3) barycentric coordinates of its nodes times the degree, in its order
    vertices   (m, 3) the place among our vertices of each of its vertices
    Returns (m, k) places among our nodes of the triangle.
    """
    base = (degree + 1) ** np.arange(3)
    place = np.empty(base.sum() * degree + 1, dtype=np.int64)
    place[lattice(degree) @ base] = np.arange(len(lattice(degree)))
    return place[base[vertices] @ order.T]
