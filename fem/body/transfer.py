"""A block's mesh handed to dolfinx, and what its numbers mean in ours."""

from typing import TYPE_CHECKING

import numpy as np

from fem import compat
from fem.body.nodes import Nodes, in_order
from meshes.block import BlockMesh
from meshes.quality import real_points

if TYPE_CHECKING:
    from dolfinx.fem import DirichletBC, FunctionSpace
    from dolfinx.mesh import Mesh
    from mpi4py.MPI import Comm

# dolfinx lists the edge opposite to vertex 0 first, gmsh the edge between vertices 0 and 1.
GMSH_TO_DOLFINX = [0, 1, 2, 4, 5, 3]


def domain_of(comm: "Comm", mesh: BlockMesh, degree: int) -> tuple["Mesh", np.ndarray]:
    """dolfinx mesh, and the mesh point (k,) behind each of its input points.

    `degree` is that of the elements' edges: 1, from the vertices alone, or 2. The first process
    hands the whole mesh in; dolfinx spreads it.
    """
    if degree == 2:
        cells, number = mesh.triangles[:, GMSH_TO_DOLFINX], np.arange(len(mesh.points))
    else:
        number, cells = np.unique(mesh.triangles[:, :3], return_inverse=True)
        cells = cells.reshape(-1, 3)
    points = real_points(mesh)[number]
    if comm.rank > 0:
        cells, points = cells[:0], points[:0]
    return compat.triangle_mesh(comm, cells, points, degree), number


def own_numbers(
    mesh: BlockMesh, domain: "Mesh", number: np.ndarray, space: "FunctionSpace", numbering: Nodes
) -> tuple[np.ndarray, np.ndarray]:
    """Our triangle of each of dolfinx's cells, our node of each of its nodes (owned, then ghosts).

    By topology, never by coordinates: a cell is known from the input, and its nodes from where
    each of its vertices stands among those of our triangle.
    """
    cell = compat.input_cells(domain)
    corner = number[compat.input_points(domain)[compat.cell_points(domain)[:, :3]]]
    vertices = np.argmax(corner[:, :, None] == mesh.triangles[cell, None, :3], axis=2)
    order = in_order(numbering.degree, compat.node_order(numbering.degree), vertices)
    index_map = space.dofmap.index_map
    node = np.full(index_map.size_local + index_map.num_ghosts, -1, dtype=np.int64)
    node[compat.cell_nodes(space)] = np.take_along_axis(numbering.elements[cell], order, axis=1)
    return cell, node


def conditions_of(space: "FunctionSpace", held: np.ndarray) -> list["DirichletBC"]:
    """Zero displacement of the held components (nodes, 2) of the space."""
    from dolfinx import fem

    def nodes(which: np.ndarray) -> np.ndarray:
        return np.flatnonzero(which).astype(np.int32)

    zero, whole = compat.real_number(0.0), held.all(axis=1)
    both = fem.dirichletbc(np.full(2, zero), nodes(whole), compat.conditioned(space))
    conditions = [both]
    for axis in (0, 1):
        alone = 2 * nodes(held[:, axis] & ~whole) + axis
        if len(alone):  # a space of one component takes as long as its condition
            part = compat.conditioned(space.sub(axis))
            conditions.append(fem.dirichletbc(zero, alone, part))
    return conditions
