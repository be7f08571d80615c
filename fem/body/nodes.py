"""The displacement's nodes on a mesh of six-node triangles, in our numbering and in dolfinx's.

Degree 1: the vertices, in the order of the mesh's points. Degree 2: the mesh's points. Degree 3:
the vertices, two nodes to an edge, one to a triangle, in that order. The six points of an element
give its shape, whatever the degree."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from fem import compat
from fem.body.triangle import lattice, reference_nodes, shapes
from fem.solver.compilation import compiled
from fem.solver.mumps import FemError
from meshes.block import EDGES, BlockMesh, real_points
from meshes.quality import corner_jacobians

if TYPE_CHECKING:
    from dolfinx.fem import DirichletBC, FunctionSpace

# dolfinx lists the edge opposite to vertex 0 first, gmsh the edge between vertices 0 and 1.
GMSH_TO_DOLFINX = [0, 1, 2, 4, 5, 3]
# Edges of a cell in all releases of dolfinx, each from the lower local vertex to the other.
DOLFINX_EDGES = ((1, 2), (0, 2), (0, 1))


@dataclass(frozen=True)
class Nodes:
    """Nodes of displacements of a degree 1, 2 or 3."""

    degree: int
    elements: np.ndarray  # (m, 3, 6 or 10) of each triangle, in the order of `fem.body.triangle`
    flat: np.ndarray  # (n, 2) [m] in the flat block
    real: np.ndarray  # (n, 2) [m] in the real body


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
    """Nodes (m, 10) of cubic triangles, from their vertices and their edges' midpoints (m, 3). The
    two nodes of an edge are numbered from its vertex of lower number to the other one."""
    edges, edge = np.unique(middle, return_inverse=True)
    start = corner[:, EDGES]
    backward = start[..., 0] > start[..., 1]
    first = vertices + 2 * edge.reshape(-1, 3) + backward
    second = vertices + 2 * edge.reshape(-1, 3) + ~backward
    inside = vertices + 2 * len(edges) + np.arange(len(corner))
    along = np.stack([first, second], axis=-1).reshape(-1, 6)
    return np.column_stack([corner, along, inside])


def in_order(degree: int, order: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """Numbers (m, k) of another program's nodes of each triangle among ours.

    order      (k, 3) barycentric coordinates of its nodes times the degree, in its order
    vertices   (m, 3) number among our vertices of each of its vertices"""
    base = (degree + 1) ** np.arange(3)
    place = np.empty(base.sum() * degree + 1, dtype=np.int64)
    place[lattice(degree) @ base] = np.arange(len(lattice(degree)))
    return place[base[vertices] @ order.T]


def space_on(
    mesh: BlockMesh, numbering: Nodes, shape: tuple | None
) -> tuple["FunctionSpace", np.ndarray, np.ndarray]:
    """dolfinx space of values of a `shape` (2,), or None of scalars, on the mesh; our triangle of
    each of its cells, and our node of each of its nodes. Matched by topology, not by coordinates:
    dolfinx gives each cell's input number, and the order of its vertices among ours gives that of
    its nodes. Raises FemError if an element is inverted."""
    points = real_points(mesh)
    folded = (corner_jacobians(points, mesh.triangles) <= 0.0).any(axis=1)
    if folded.any():
        raise FemError(f"{np.count_nonzero(folded)} elements of the mesh are inverted")
    if curved := bool(np.any(mesh.shift)):
        cells, number = mesh.triangles[:, GMSH_TO_DOLFINX], np.arange(len(points))
    else:
        number, cells = np.unique(mesh.triangles[:, :3], return_inverse=True)
        cells = cells.reshape(-1, 3)
    points = points[number]
    domain = compat.triangle_mesh(cells, points, 2 if curved else 1)
    space = compiled(lambda: compat.continuous_space(domain, numbering.degree, shape))

    cell = compat.input_cells(domain)
    corner = number[compat.input_points(domain)[compat.cell_points(domain)[:, :3]]]
    vertices = np.argmax(corner[:, :, None] == mesh.triangles[cell, None, :3], axis=2)
    order = lattice(numbering.degree, DOLFINX_EDGES)
    order = in_order(numbering.degree, order, vertices)
    node = np.empty(space.dofmap.index_map.size_local, dtype=np.int64)
    node[compat.cell_nodes(space)] = np.take_along_axis(numbering.elements[cell], order, axis=1)
    return space, cell, node


def conditions_of(space: "FunctionSpace", held: np.ndarray) -> list["DirichletBC"]:
    """Zero displacement of the `held` components (nodes, 2)."""
    from dolfinx import fem

    def nodes(which: np.ndarray) -> np.ndarray:
        return np.flatnonzero(which).astype(np.int32)

    zero, whole = compat.real_number(0.0), held.all(axis=1)
    conditions = [fem.dirichletbc(np.full(2, zero), nodes(whole), compat.conditioned(space))]
    for axis in (0, 1):
        alone = 2 * nodes(held[:, axis] & ~whole) + axis
        if len(alone):  # the space of one component is slow to build
            conditions.append(fem.dirichletbc(zero, alone, compat.conditioned(space.sub(axis))))
    return conditions
