"""Wanted element sizes on an earlier mesh of the same block, for the next one.

An error estimate of a solution says how large its elements should have been. These sizes go to the
vertices, limited in their growth, and gmsh interpolates them while it fills the block.
"""

from dataclasses import dataclass

import numpy as np

from meshes.block import BlockMesh, double_areas, unique_edges
from meshes.coating import stretched

# An element shrinks or grows at most by this factor from one mesh to the next.
MOST_CHANGE = 4.0


@dataclass(frozen=True)
class SizeField:
    """Linear on the triangles (m, 3) between sizes (n,) [m] at vertices (n, 2) [m]."""

    vertices: np.ndarray
    triangles: np.ndarray
    size: np.ndarray

    def along(self, axis: int, at: float, place: np.ndarray) -> np.ndarray:
        """Sizes (k,) [m] on the line of edges x = at (axis 0) or z = at (axis 1), at z or x [m].
        Raises ValueError if the mesh has no edge on that line."""
        on = self.vertices[:, axis] == at
        if np.count_nonzero(on) < 2:
            raise ValueError(f"the mesh has no edges along {'xz'[axis]} = {at:g} m")
        order = np.argsort(self.vertices[on, 1 - axis])
        return np.interp(place, self.vertices[on, 1 - axis][order], self.size[on][order])


def triangle_sizes(mesh: BlockMesh) -> np.ndarray:
    """Edge (m,) [m] of the equilateral triangle with the area of each element of the flat block.
    For a coating's stretched layers their length along the surface."""
    size = np.sqrt(2.0 / np.sqrt(3.0) * double_areas(mesh.points, mesh.triangles))
    length = np.ptp(mesh.points[mesh.triangles[:, :3], 0], axis=1)
    return np.where(stretched(mesh), length, size)


def size_field(mesh: BlockMesh, factor: np.ndarray, growth: float) -> SizeField:
    """Sizes for the next mesh: each element's size times its `factor` (m,), within MOST_CHANGE. A
    vertex takes the geometric mean of its elements, limited to grow by `growth` along edges."""
    wanted = triangle_sizes(mesh) * np.clip(factor, 1.0 / MOST_CHANGE, MOST_CHANGE)
    number, corner = np.unique(mesh.triangles[:, :3], return_inverse=True)
    corner = corner.reshape(-1, 3)
    count = np.bincount(corner.ravel())
    logarithm = np.bincount(corner.ravel(), np.repeat(np.log(wanted), 3)) / count
    vertices = mesh.points[number]
    return SizeField(vertices, corner, limited(vertices, corner, np.exp(logarithm), growth))


def limited(
    vertices: np.ndarray, triangles: np.ndarray, size: np.ndarray, growth: float
) -> np.ndarray:
    """Sizes (n,) [m], none larger than a neighbour's by more than growth times their distance."""
    (one, other), size = unique_edges(triangles)[0].T, size.copy()
    rise = growth * np.linalg.norm(vertices[one] - vertices[other], axis=1)
    while True:
        before = size.copy()
        np.minimum.at(size, one, before[other] + rise)
        np.minimum.at(size, other, before[one] + rise)
        if np.array_equal(size, before):
            return size
