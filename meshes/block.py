"""A block to mesh, its mesh of six-node triangles with their edges, and structured meshes.

The block occupies |x| <= half_width, 0 <= z <= depth, z into the body. Its top side z = 0 is
the mean line; a rough boundary is the top side moved to z = -height(x)."""

from dataclasses import dataclass

import numpy as np

# Local ends of the three edges of a triangle, in gmsh's order of the midpoints.
EDGES = np.array([[0, 1], [1, 2], [2, 0]])


class MeshError(RuntimeError):
    """A mesh cannot be had: impossible request, failed mesher, or elements not fit to solve on."""


@dataclass(frozen=True)
class BlockSpec:
    """Block to mesh. Lengths in m."""

    half_width: float
    depth: float
    intervals: np.ndarray  # (k, 2) ranges of the surface to refine, ascending and disjoint
    # edge of the elements on them; each end and each multiple of it is a vertex
    surface_size: float
    growth: float = 0.2  # size = surface_size + growth * distance to the nearest refined range
    # (x0, x1, z1, size): no element within x0 <= x <= x1, z <= z1 is larger than size
    window: tuple[float, float, float, float] | None = None
    # depth of a line across the block that element edges follow: the lower side of a coating
    interface: float | None = None
    # (k,) ascending x of the vertices from the start of the first refined range to the end of the
    # last, in place of equal edges; sizes below follow these edges
    vertices: np.ndarray | None = None
    # x of the two vertices between which the top side may be loaded, where it is not all of it:
    # a disc's rim turns away
    loaded: tuple[float, float] | None = None


@dataclass(frozen=True)
class BlockMesh:
    """Second-order triangles of the flat block, and how far the real body is from them."""

    points: np.ndarray  # (n, 2) x and z [m] of vertices and edge midpoints of the flat block
    # (m, 6) in gmsh's order: 3 vertices, then midpoints of edges (0,1), (1,2), (2,0)
    triangles: np.ndarray
    shift: np.ndarray  # (n, 2) [m] from the flat block to the real body, rough or bent
    spec: BlockSpec


def unique_edges(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Edges (e, 2) with the lower vertex first, and for each triangle (m, 3) its three edges."""
    ends = np.sort(triangles[:, EDGES].reshape(-1, 2), axis=1).astype(np.int64)
    n = int(triangles.max()) + 1
    keys, edge_of = np.unique(ends[:, 0] * n + ends[:, 1], return_inverse=True)
    return np.column_stack([keys // n, keys % n]), edge_of.reshape(-1, 3)


def add_midpoints(vertices: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (n + e, 2), vertices first, and six-node triangles (m, 6) in gmsh's node order."""
    edges, edge_of = unique_edges(triangles)
    middle = 0.5 * (vertices[edges[:, 0]] + vertices[edges[:, 1]])
    return np.concatenate([vertices, middle]), np.hstack([triangles, len(vertices) + edge_of])


def real_points(mesh: BlockMesh) -> np.ndarray:
    """Points (n, 2) [m] of the real body, rough or bent."""
    return mesh.points + mesh.shift


def cross(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """u_x v_z - u_z v_x over the last axis."""
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


def double_areas(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Twice the signed area (m,) [m^2] of the straight triangles between the vertices."""
    corner = points[triangles[:, :3]]
    return cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])


def check_spec(spec: BlockSpec) -> None:
    """Raises MeshError, naming the field and what is allowed, if spec cannot be meshed."""

    def demand(holds: bool, what: str) -> None:
        if not holds:
            raise MeshError(f"block: {what}")

    half, depth = spec.half_width, spec.depth
    for name in ("half_width", "depth", "surface_size"):
        value = getattr(spec, name)
        demand(0.0 < value < np.inf, f"{name} is {value}: a positive length in m")
    demand(0.0 <= spec.growth <= 0.5, f"growth is {spec.growth}: allowed is 0 to 0.5")
    intervals = np.asarray(spec.intervals, dtype=float)
    demand(
        intervals.ndim == 2 and intervals.shape[1] == 2 and len(intervals) > 0,
        f"intervals have the shape {intervals.shape}: at least one row of two ends is needed",
    )
    flat, slack = intervals.ravel(), 1e-9 * spec.surface_size
    ascend = (np.diff(flat) >= -slack).all() and (np.diff(intervals, axis=1) > 0.0).all()
    wanted = "intervals must be finite, ascending and disjoint"
    demand(np.isfinite(flat).all() and ascend, wanted)
    reach = f"intervals reach from {flat[0]:g} to {flat[-1]:g} m, the block to {half:g} m"
    demand(np.abs(flat[[0, -1]]).max() <= half + slack, reach)
    if spec.window is not None:
        x0, x1, z1, size = spec.window
        holds = np.isfinite(spec.window).all() and x0 < x1 and z1 > 0.0 and size > 0.0
        demand(holds, f"window is {spec.window}: x0 < x1, z1 > 0 and size > 0 are needed")
    if spec.vertices is not None:
        vertices = np.asarray(spec.vertices, dtype=float)
        demand(
            vertices.ndim == 1
            and len(vertices) > 1
            and (np.diff(vertices) > 0.0).all()
            and np.abs(vertices[[0, -1]] - flat[[0, -1]]).max() <= slack,
            "vertices must be finite, ascending, and reach from the first interval's start to the "
            "last one's end",
        )
    if spec.interface is not None:
        allowed = f"interface is {spec.interface}: between 0 and the depth, {depth:g} m"
        demand(0.0 < spec.interface < depth, allowed)


def cells(number: np.ndarray) -> np.ndarray:
    """Two triangles (2c, 3) to each of the c cells of a grid of vertex numbers (i, j)."""
    a, b, c, d = (
        n.ravel() for n in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:])
    )
    return np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def structured(x: np.ndarray, z: np.ndarray) -> BlockMesh:
    """Two triangles to each cell of the grid x (ascending) by z (from 0 to the depth) [m]."""
    grid_x, grid_z = np.meshgrid(x, z, indexing="ij")
    vertices = np.column_stack([grid_x.ravel(), grid_z.ravel()])
    number = np.arange(len(vertices)).reshape(grid_x.shape)
    points, triangles = add_midpoints(vertices, cells(number))
    spec = BlockSpec(0.5 * (x[-1] - x[0]), z[-1], np.array([[x[0], x[-1]]]), float(x[1] - x[0]))
    return BlockMesh(points, triangles, np.zeros_like(points), spec)
