"""Quality of a mesh, which shows whether it is fit to solve on.

least_angle_degrees   smallest angle between straight edges of any triangle; 60 is best
least_jacobian        smallest scaled Jacobian at any corner,
                      2/sqrt(3) * det(t1, t2) / (|t1| |t2|) with t1, t2 the tangents of the
                      (curved) edges there; 1 for an equilateral triangle, <= 0 when inverted
size_jump             largest ratio of the sizes (square root of area) of two neighbours"""

import numpy as np

from meshes.block import EDGES, BlockMesh, MeshError, cross, real_points
from meshes.coating import stretched

LEAST_ANGLE_DEGREES = 15.0
# The slope of a profile shears the elements at the surface, whatever the mesher does.
LEAST_ANGLE_ROUGH_DEGREES = 5.0
LEAST_JACOBIAN = 0.05
LARGEST_SIZE_JUMP = 4.0


def corner_tangents(points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tangents (m, 3, 2) [m] of both edges at each corner; for straight edges the edges."""
    corner = points[triangles[:, :3]]
    middle = points[triangles[:, 3:]]
    ahead, behind = np.roll(corner, -1, axis=1), np.roll(corner, 1, axis=1)
    onward = 4.0 * middle - 3.0 * corner - ahead
    back = 4.0 * np.roll(middle, 1, axis=1) - 3.0 * corner - behind
    return onward, back


def corner_jacobians(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Determinant (m, 3) [m^2] of each element's map at its corners. Where only heights move and x
    stays affine in the element, the determinant is linear in the reference coordinates: if positive
    at the corners, it is positive everywhere."""
    return cross(*corner_tangents(points, triangles))


def scaled_jacobians(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Smallest scaled Jacobian (m,) [-] of each element over its corners."""
    onward, back = corner_tangents(points, triangles)
    scale = np.linalg.norm(onward, axis=2) * np.linalg.norm(back, axis=2)
    return (2.0 / np.sqrt(3.0)) * (cross(onward, back) / scale).min(axis=1)


def measure(points: np.ndarray, triangles: np.ndarray) -> dict:
    """Quality figures of six-node triangles (m, 6) on points (n, 2) [m]; names as above."""
    corner = points[triangles[:, :3]]
    side = corner[:, EDGES[:, 1]] - corner[:, EDGES[:, 0]]
    before = -np.roll(side, 1, axis=1)
    double_area = cross(side[:, 0], -side[:, 2])
    angle = np.degrees(np.arctan2(np.abs(cross(side, before)), (side * before).sum(axis=2)))

    middle = triangles[:, 3:].ravel()  # one to an edge
    order = np.argsort(middle, kind="stable")
    edge, element = middle[order], order // 3
    shared = np.flatnonzero(edge[1:] == edge[:-1])
    size = np.sqrt(np.abs(double_area))
    pair = np.sort(np.column_stack([size[element[shared]], size[element[shared + 1]]]), axis=1)
    jump = (pair[:, 1] / pair[:, 0]).max() if len(pair) and pair.min() > 0.0 else 1.0
    return {
        "least_angle_degrees": float(angle.min()),
        "least_jacobian": float(scaled_jacobians(points, triangles).min()),
        "size_jump": float(jump),
    }


def quality_of(mesh: BlockMesh) -> dict:
    """Quality figures of the real body's mesh, without the shapes of stretched elements."""
    return measure(real_points(mesh), mesh.triangles[~stretched(mesh)])


def check_quality(mesh: BlockMesh, *, least_angle_degrees: float = LEAST_ANGLE_DEGREES) -> None:
    """Raise MeshError, with x and z, if the mesh is not fit to solve on."""
    figures = quality_of(mesh)
    bounds = [
        ("least_jacobian", LEAST_JACOBIAN, 1.0),
        ("least_angle_degrees", least_angle_degrees, 1.0),
        ("size_jump", LARGEST_SIZE_JUMP, -1.0),
    ]
    for name, bound, sense in bounds:
        if sense * (figures[name] - bound) < 0.0:
            points, judged = real_points(mesh), mesh.triangles[~stretched(mesh)]
            worst = np.argmin(scaled_jacobians(points, judged))
            x, z = points[judged[worst, :3]].mean(axis=0)
            raise MeshError(
                f"mesh not fit to solve on: {name} is {figures[name]:.3g}, the bound is {bound:g} "
                f"(worst element at x = {x:g} m, z = {z:g} m)"
            )
