"""Nodal forces of exact stress fields, for the method of manufactured solutions.

By a quadrature of its own on the boundary: independent of the surface loads that it tests."""

from collections.abc import Callable

import numpy as np

from fem.body.nodes import nodes_of
from fem.body.sums import nodal_sums
from fem.body.triangle import collapsed_gauss, edge_shapes, edge_slopes, jacobians, shapes
from meshes.block import BlockMesh, double_areas, real_points

# Degree 8: far more than what is tested.
LINE, LINE_WEIGHT = np.polynomial.legendre.leggauss(5)
LINE, LINE_WEIGHT = 0.5 * (1.0 + LINE), 0.5 * LINE_WEIGHT
AREA, AREA_WEIGHT = collapsed_gauss(5)


def forces_of(
    mesh: BlockMesh, stress: Callable, body_force: Callable | None = None, degree: int = 2
) -> np.ndarray:
    """Nodal forces (n, 2) [N/m] of the boundary tractions of a stress field and of a body force.
    `stress`(x, z) gives sx, sz, txz [Pa]; `body_force`(x, z) [N/m^3]; degree: displacement's."""
    elements = nodes_of(mesh, degree).elements
    points = real_points(mesh)
    turn = np.sign(double_areas(points, mesh.triangles))
    count = elements.max() + 1
    inner = [range(3 + k * (degree - 1), 3 + (k + 1) * (degree - 1)) for k in range(3)]
    border = elements[:, [[k, *inner[k], (k + 1) % 3] for k in range(3)]].reshape(-1, degree + 1)
    edges = mesh.triangles[:, [[0, 3, 1], [1, 4, 2], [2, 5, 0]]].reshape(-1, 3)
    turn = np.repeat(turn, 3)
    outer = np.bincount(edges[:, 1], minlength=len(points))[edges[:, 1]] == 1
    edges, border, turn = edges[outer], border[outer], turn[outer]
    place = edge_shapes(LINE) @ points[edges]
    tangent = edge_slopes(LINE) @ points[edges] * turn[:, None, None]
    sx, sz, txz = np.broadcast_arrays(*stress(place[..., 0], place[..., 1]))
    along, down = tangent[..., 1], -tangent[..., 0]
    traction = np.stack([sx * along + txz * down, txz * along + sz * down], axis=-1)
    shape = LINE_WEIGHT[:, None] * edge_shapes(LINE, degree)
    load = nodal_sums(border, shape.T @ traction, count)
    if body_force is not None:
        nodes = points[mesh.triangles]
        place = np.einsum("mac,qa->mqc", nodes, shapes(AREA))
        volume = np.abs(np.linalg.det(jacobians(nodes, AREA))) * AREA_WEIGHT
        force = np.stack(body_force(place[..., 0], place[..., 1]), axis=-1) * volume[..., None]
        load += nodal_sums(elements, shapes(AREA, degree).T @ force, count)
    return load
