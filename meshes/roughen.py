"""From the flat mesh to that of the rough body: the top side moved onto the profile.

The shift of the surface is carried into the depth as the solution w of

    d2w/dx2 + STRETCH^2 d2w/dz2 = 0,   w = -height on top, w = 0 at the base, free on the sides,

by linear elements on the same triangles. A component of wavelength L dies off over the depth
STRETCH L / (2 pi), before the growing elements get too coarse for it, and squeezes the mesh by its
slope / STRETCH: a profile steeper than one can still be followed.
"""

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from meshes.block import BlockMesh
from meshes.errors import MeshError
from meshes.quality import (
    LEAST_ANGLE_ROUGH_DEGREES,
    check_quality,
    corner_jacobians,
    real_points,
    scaled_jacobians,
)
from meshes.second_order import unique_edges

STRETCH = 3.0


def roughen(mesh: BlockMesh, height: Callable[[np.ndarray], np.ndarray]) -> BlockMesh:
    """Mesh of the body bounded by z = -height(x), from the mesh of the flat block.

    height takes x (n,) [m] anywhere on the top side and gives (n,) [m], positive out of the body.
    Every node of the top side, vertex or midpoint, comes to lie on the profile: the outer edges are
    parabolas, the two others of a triangle at the top bulge a little with them, the rest stay
    straight. No point moves in x; the base and the planes of the sides stay where they are.

    Raises MeshError when height is not finite, when an element is turned inside out (naming where
    and how steep the profile is there), or when the elements are not fit to solve on.
    """
    began, seconds = time.perf_counter(), mesh.quality.get("seconds", 0.0)
    flat, triangles = mesh.points, mesh.triangles
    top = np.flatnonzero(flat[:, 1] == 0.0)
    wanted = np.asarray(height(flat[top, 0]), dtype=float)
    if wanted.shape != top.shape or not np.isfinite(wanted).all():
        raise MeshError(
            "the height must be one finite number for each x on the top side, "
            f"|x| <= {mesh.spec.half_width:g} m"
        )
    vertices = int(triangles[:, :3].max()) + 1
    shift = np.zeros(len(flat))
    shift[top] = -wanted
    shift[:vertices] = carried_down(flat[:vertices], triangles[:, :3], shift[:vertices])
    edges, _ = unique_edges(triangles[:, :3])
    straight = shift[edges].mean(axis=1)
    bulge = np.where(flat[vertices:, 1] == 0.0, shift[vertices:] - straight, 0.0)
    spread = straight + spread_bulges(bulge, triangles[:, 3:] - vertices)
    shift[vertices:] = np.where(flat[vertices:, 1] == 0.0, shift[vertices:], spread)

    rough = replace(mesh, shift=np.column_stack([np.zeros_like(shift), shift]))
    points = real_points(rough)
    refuse_inverted(points, triangles, top)
    quality = check_quality(rough, least_angle_degrees=LEAST_ANGLE_ROUGH_DEGREES)
    return replace(rough, quality=quality | {"seconds": seconds + time.perf_counter() - began})


def carried_down(points: np.ndarray, triangles: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """Shift (n,) [m] of all vertices (n, 2) from that of the vertices on the top side."""
    corner = points[triangles]
    # Opposite edges give the gradients of the linear shape functions.
    edge = np.roll(corner, -2, axis=1) - np.roll(corner, -1, axis=1)
    area = 0.5 * (edge[:, 0, 0] * edge[:, 1, 1] - edge[:, 0, 1] * edge[:, 1, 0])
    gradient = np.stack([-edge[..., 1], STRETCH * edge[..., 0]], axis=-1)
    stiffness = np.einsum("eid,ejd->eij", gradient, gradient) / (4.0 * area)[:, None, None]
    rows = np.repeat(triangles, 3, axis=1).ravel()
    columns = np.tile(triangles, 3).ravel()
    matrix = coo_matrix((stiffness.ravel(), (rows, columns)), shape=(len(points),) * 2).tocsc()

    held = (points[:, 1] == 0.0) | (points[:, 1] == points[:, 1].max())
    free = np.flatnonzero(~held)
    known = np.where(held, shift, 0.0)
    factor = splu(
        matrix[free][:, free].tocsc(),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    known[free] = factor.solve(-(matrix @ known)[free])
    return known


def spread_bulges(bulge: np.ndarray, edge_of: np.ndarray) -> np.ndarray:
    """Extra shift (e,) [m] of the inner edges' midpoints beside top edges that bulge (e,) [m].

    A bulge b of the top edge s changes the determinant at its two corners by 2 b s and not at the
    third. The fraction f of it on the other two edges makes that (1 - 2 f) and 2 f of it: equal at
    f = 1/4, which lets an edge too coarse for the profile bulge twice as far before it inverts.
    """
    extra = np.zeros(len(bulge))
    for k in range(3):
        for other in (edge_of[:, k - 1], edge_of[:, k - 2]):
            np.add.at(extra, other, 0.25 * bulge[edge_of[:, k]])
    return extra


def refuse_inverted(points: np.ndarray, triangles: np.ndarray, top: np.ndarray) -> None:
    """Raises MeshError at the worst element when any determinant is not positive."""
    inverted = corner_jacobians(points, triangles).min(axis=1) <= 0.0
    if not inverted.any():
        return
    worst = np.argmin(scaled_jacobians(points, triangles))
    x, z = points[triangles[worst, :3]].mean(axis=0)
    profile = points[top][np.argsort(points[top, 0])]
    slope = np.abs(np.diff(profile[:, 1]) / np.diff(profile[:, 0]))
    at = np.clip(np.searchsorted(profile[:, 0], x) - 1, 0, len(slope) - 1)
    raise MeshError(
        f"the rough boundary turns {np.count_nonzero(inverted)} elements inside out, the worst at "
        f"x = {x:g} m, z = {z:g} m, where the profile's slope is {slope[at]:.2g} (steepest of all "
        f"{slope.max():.2g}): refine the surface there or smooth the profile"
    )
