"""Wanted element sizes on an earlier mesh of the same block, for the next one.

A solution tells how large its elements should have been. Their sizes are spread to the vertices,
never growing faster than a given slope, and gmsh interpolates them while it fills the block.
"""

from dataclasses import dataclass

import numpy as np

from meshes.block import BlockMesh
from meshes.coating import stretched
from meshes.quality import cross
from meshes.second_order import unique_edges

# From one mesh to the next an element shrinks or grows to this part or multiple of its size: an
# estimate from far off the wanted size says no more than that.
MOST_CHANGE = 4.0


@dataclass(frozen=True)
class SizeField:
    """Linear on the triangles (m, 3) between sizes (n,) [m] at vertices (n, 2) [m]."""

    vertices: np.ndarray
    triangles: np.ndarray
    size: np.ndarray

    def along(self, axis: int, at: float, place: np.ndarray) -> np.ndarray:
        """Sizes (k,) [m] on the line of edges x = at (axis 0) or z = at (axis 1), at z or x [m].

        Raises ValueError if the mesh has no edge on that line.
        """
        on = self.vertices[:, axis] == at
        if np.count_nonzero(on) < 2:
            raise ValueError(f"the mesh has no edges along {'xz'[axis]} = {at:g} m")
        order = np.argsort(self.vertices[on, 1 - axis])
        return np.interp(place, self.vertices[on, 1 - axis][order], self.size[on][order])


def triangle_sizes(mesh: BlockMesh) -> np.ndarray:
    """Edge (m,) [m] of the equilateral triangle as large as each element of the flat block.

    Of a coating's stretched layers the length along the surface.
    """
    corner = mesh.points[mesh.triangles[:, :3]]
    double_area = cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    size = np.sqrt(2.0 / np.sqrt(3.0) * double_area)
    return np.where(stretched(mesh), np.ptp(corner[..., 0], axis=1), size)


def size_field(mesh: BlockMesh, factor: np.ndarray, growth: float) -> SizeField:
    """Sizes for the next mesh: each element's own times its `factor` (m,), within MOST_CHANGE.

    A vertex takes the geometric mean of its elements, weighted alike; then no size is larger
    than that of any other vertex plus `growth` times the way there along edges.
    """
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
    """Sizes (n,) [m] cut down until none exceeds a neighbour's by more than growth times their
    distance."""
    (one, other), size = unique_edges(triangles)[0].T, size.copy()
    rise = growth * np.linalg.norm(vertices[one] - vertices[other], axis=1)
    while True:
        before = size.copy()
        np.minimum.at(size, one, before[other] + rise)
        np.minimum.at(size, other, before[one] + rise)
        if np.array_equal(size, before):
            return size
