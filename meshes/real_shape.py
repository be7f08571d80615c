"""The real body's mesh from the flat block's: a rough top side, or the sector of a disc.

Rough body: the shift of the top side continues into the depth as the solution w of

    d2w/dx2 + STRETCH^2 d2w/dz2 = 0,   w = -height on top, w = 0 at the base, free on the sides,

by linear elements on the same triangles. A component of wavelength L decays over the depth
STRETCH L / (2 pi) and compresses elements by its slope / STRETCH: slopes above one are possible.

Disc of radius R [m], z into the roller as for every body, with the sagitta s(x) [m]:

    (x, z)  ->  (x (1 - z/R), s(x) + (R - s(x)) z/R),     s(x) = R - sqrt(R^2 - x^2).

The surface goes to the roller's circle without moving along x, lines of equal depth to circles
about the centre (0, R), upright lines to rays.

What lies near the contact in a disc (`rounded`): squares about the origin go to arcs about it, rays
to curves that divide the disc's angle there, pi - 2 asin(r / 2R), as they divide pi. Base and sides
become the arc that ends on the rim over the block's ends."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from meshes.block import BlockMesh, MeshError, real_points, unique_edges
from meshes.quality import (
    LEAST_ANGLE_ROUGH_DEGREES,
    check_quality,
    corner_jacobians,
    scaled_jacobians,
)

STRETCH = 3.0


def roughen(mesh: BlockMesh, height: Callable[[np.ndarray], np.ndarray]) -> BlockMesh:
    """Mesh of the body bounded by z = -height(x), from the mesh of the flat block.

    height takes x (n,) [m] on the top side and gives (n,) [m], positive out of the body. The edges
    of the top side are parabolas through the profile, the two other edges of their triangles curve
    a little with them, the rest stay straight. No point moves along x; base and sides stay.

    Raises MeshError if height is not finite, if an element is inverted (with x and z and the
    slope there), or if the elements are not fit to solve on."""
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
    on_top = flat[vertices:, 1] == 0.0
    bulge = np.where(on_top, shift[vertices:] - straight, 0.0)
    spread = straight + spread_bulges(bulge, triangles[:, 3:] - vertices)
    shift[vertices:] = np.where(on_top, shift[vertices:], spread)

    rough = replace(mesh, shift=np.column_stack([np.zeros_like(shift), shift]))
    points = real_points(rough)
    refuse_inverted(points, triangles, top)
    check_quality(rough, least_angle_degrees=LEAST_ANGLE_ROUGH_DEGREES)
    return rough


def carried_down(points: np.ndarray, triangles: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """Shift w (n,) [m] of all vertices (n, 2) from that of the vertices on the top side."""
    corner = points[triangles]
    # The edge opposite to a vertex gives the gradient of its linear shape function.
    edge = np.roll(corner, -2, axis=1) - np.roll(corner, -1, axis=1)
    area = 0.5 * (edge[:, 0, 0] * edge[:, 1, 1] - edge[:, 0, 1] * edge[:, 1, 0])
    gradient = np.stack([-edge[..., 1], STRETCH * edge[..., 0]], axis=-1)
    stiffness = np.einsum("eid,ejd->eij", gradient, gradient) / (4.0 * area)[:, None, None]
    place = (np.repeat(triangles, 3, axis=1).ravel(), np.tile(triangles, 3).ravel())
    matrix = coo_matrix((stiffness.ravel(), place), shape=(len(points),) * 2).tocsc()

    held = (points[:, 1] == 0.0) | (points[:, 1] == points[:, 1].max())
    free = np.flatnonzero(~held)
    known = np.where(held, shift, 0.0)
    inner, options = matrix[free][:, free].tocsc(), {"SymmetricMode": True}
    factor = splu(inner, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    known[free] = factor.solve(-(matrix @ known)[free])
    return known


def spread_bulges(bulge: np.ndarray, edge_of: np.ndarray) -> np.ndarray:
    """Extra shift (e,) [m] of the midpoints of inner edges beside top edges that bulge (e,) [m].
    A bulge b of a top edge of length s changes the determinant at its ends by 2 b s, not at the
    third corner; with the fraction f of b on the other two edges by (1 - 2 f) and 2 f of that.
    These are equal at f = 1/4, which allows twice the bulge before inversion."""
    own = 0.25 * bulge[edge_of]
    others = own.sum(axis=1, keepdims=True) - own
    return np.bincount(edge_of.ravel(), others.ravel(), len(bulge))


def refuse_inverted(points: np.ndarray, triangles: np.ndarray, top: np.ndarray) -> None:
    """Raises MeshError, with the worst element, if any determinant is not positive."""
    inverted = corner_jacobians(points, triangles).min(axis=1) <= 0.0
    if not inverted.any():
        return
    worst = np.argmin(scaled_jacobians(points, triangles))
    x, z = points[triangles[worst, :3]].mean(axis=0)
    profile = points[top][np.argsort(points[top, 0])]
    slope = np.abs(np.diff(profile[:, 1]) / np.diff(profile[:, 0]))
    at = np.clip(np.searchsorted(profile[:, 0], x) - 1, 0, len(slope) - 1)
    raise MeshError(
        f"the rough boundary inverts {np.count_nonzero(inverted)} elements, the worst at "
        f"x = {x:g} m, z = {z:g} m, where the profile's slope is {slope[at]:.2g} (steepest of all "
        f"{slope.max():.2g}): refine the surface there or smooth the profile"
    )


# At 0.8 R the surface's elements are 5/3 as long as along x, at 0.7 R of depth 0.3 as long.
WIDEST, DEEPEST = 0.8, 0.7


def sagitta(x: np.ndarray, radius: float) -> np.ndarray:
    """s(x) [m] of a circle of `radius` [m], without cancellation."""
    return x**2 / (radius + np.sqrt(radius**2 - x**2))


def rounded(mesh: BlockMesh, radius: float) -> BlockMesh:
    """Mesh of a disc of `radius` [m] up to an arc about the contact, from that of a flat block as
    deep as its half-width; x of the surface stays. Raises MeshError if it is of another form, or
    wider than the disc, or if the elements are not fit to solve on."""
    half = mesh.spec.half_width
    if mesh.shift.any() or mesh.spec.depth != half or not half < radius:
        raise MeshError(
            f"only a flat block as deep as its half-width, {half:g} m, and that below the radius, "
            f"{radius:g} m, can be rounded"
        )
    x, z = mesh.points.T
    r, square = np.hypot(x, z), np.maximum(np.abs(x), z)
    chord = np.sqrt(2.0 * radius * sagitta(r - square / half * (r - square), radius))
    share = 1.0 - np.arcsin(0.5 * chord / radius) / (0.5 * np.pi)
    angle = 0.5 * np.pi - share * np.arctan2(x, z)
    real = chord[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    disc = replace(mesh, shift=real - mesh.points)
    check_quality(disc, least_angle_degrees=LEAST_ANGLE_ROUGH_DEGREES)
    return disc


def bent(mesh: BlockMesh, radius: float) -> BlockMesh:
    """Mesh of the sector of a disc of `radius` [m], from the mesh of a flat block.
    Its base is the inner arc and its sides are rays; a support holds them like the block's. All
    nodes are mapped exactly. Raises MeshError if the block is not flat, has a half-width above
    WIDEST or a depth above DEEPEST of the radius, or if the elements are not fit to solve on."""
    half, depth = mesh.spec.half_width, mesh.spec.depth
    if mesh.shift.any():
        raise MeshError("only a flat block can be bent to a disc")
    for name, length, share in (("half-width", half, WIDEST), ("depth", depth, DEEPEST)):
        if not length <= share * radius:
            raise MeshError(
                f"a block of {name} {length:g} m cannot be bent to a disc of radius {radius:g} m: "
                f"at most {share:g} of the radius is allowed, {share * radius:g} m"
            )
    x, z = mesh.points.T
    toward = z / radius
    shift = np.column_stack([-x * toward, sagitta(x, radius) * (1.0 - toward)])
    disc = replace(mesh, shift=shift)
    check_quality(disc, least_angle_degrees=LEAST_ANGLE_ROUGH_DEGREES)
    return disc
