"""The elements of a coating: small ones under the contact, stretched layers beside it.

The core of the coating, the range of x under the refined ranges, is filled like the rest of the
block, with elements no larger than t / LAYERS, where t = spec.interface is the thickness [m].
Beside it, where the size law asks for larger ones, LAYERS layers of stretched elements go on to the
sides of the block. They cost next to nothing, and the size law resolves the displacements there."""

import numpy as np

from meshes.block import BlockMesh, BlockSpec, MeshError, cells

# Quadratic elements across the coating under the contact. Displacements differ from those with six
# by at most 5e-5 of their range, for moduli 0.1 to 100 times the body's; with two by 2e-4.
LAYERS = 3
# Longest stretched element over its thickness. With 400 the whole surface moves by up to 4e-4 of
# that range, and patches are too flat to recover stresses from.
LONGEST = 50.0


def layer_size(spec: BlockSpec) -> float:
    """Largest element edge t / LAYERS [m] in the core of the coating."""
    return spec.interface / LAYERS


def core(spec: BlockSpec) -> tuple[float, float]:
    """Ends [m] of the core, beyond which the size law alone asks for t / LAYERS or more. An end is
    the block's side where the law does not grow or less than an edge would be left."""
    half, size = spec.half_width, layer_size(spec)
    if spec.growth * 2.0 * half <= size:
        return -half, half
    low, high = float(spec.intervals[0][0]), float(spec.intervals[-1][1])
    if spec.window is not None and spec.window[3] < size:
        low, high = min(low, spec.window[0]), max(high, spec.window[1])
    low, high = low - size / spec.growth, high + size / spec.growth
    return (low if low > -half + size else -half), (high if high < half - size else half)


def stretched(mesh: BlockMesh) -> np.ndarray:
    """(m,) whether a triangle belongs to the stretched layers, which are flat on purpose."""
    spec = mesh.spec
    if spec.interface is None:
        return np.zeros(len(mesh.triangles), dtype=bool)
    x, z = mesh.points[mesh.triangles[:, :3]].mean(axis=1).T
    low, high = core(spec)
    return (z < spec.interface) & ((x < low) | (x > high))


def with_layers(
    vertices: np.ndarray, triangles: np.ndarray, interface: float | None, beside: tuple
) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (n, 2) [m] and triangles (m, 3) with the stretched layers added. `beside` are the x
    [m] of the layers' columns, from the core outwards; their nodes on the `interface` [m] and at
    the end of the core must be among the vertices, else MeshError is raised."""
    for x in beside:
        columns, depths = np.meshgrid(x, np.linspace(0.0, interface, LAYERS + 1), indexing="ij")
        number = np.full(columns.shape, -1, dtype=np.int64)
        number[0] = known(vertices, columns[0], depths[0])
        number[1:, -1] = known(vertices, columns[1:, -1], depths[1:, -1])
        new = number < 0
        number[new] = len(vertices) + np.arange(np.count_nonzero(new))
        vertices = np.concatenate([vertices, np.column_stack([columns[new], depths[new]])])
        added = cells(number)
        # On the left the columns run towards -x, which turns the sense of rotation.
        triangles = np.concatenate([triangles, added if x[-1] > x[0] else added[:, ::-1]])
    return vertices, triangles


def known(vertices: np.ndarray, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Numbers of the vertices that lie exactly at x, z (k,) [m]."""
    on = np.flatnonzero(np.isin(vertices[:, 0], x) & np.isin(vertices[:, 1], z))
    number = {tuple(vertices[k]): k for k in on}
    try:
        return np.array([number[point] for point in zip(x, z, strict=True)], dtype=np.int64)
    except KeyError as error:
        raise MeshError("the layers beside a coating's core do not fit what lies below") from error
