"""Runs gmsh in a process of its own: `python -m meshes.gmsh_worker`.

Reads one npz archive on standard input, writes one on standard output, complains on standard
error. gmsh can crash or abort the process that it lives in; here it takes nothing with it.
"""

import ctypes
import io
import os
import signal
import sys

import numpy as np

from meshes.block import BlockSpec
from meshes.size_law import point_size

OPTIONS = {
    "General.Terminal": 0,
    "General.NumThreads": 1,
    "Mesh.MaxNumThreads1D": 1,
    "Mesh.MaxNumThreads2D": 1,
    "Mesh.RandomSeed": 1,
    # The default random shift is relative to the whole block: with depth/h beyond 5e4 it can move
    # points by as much as the shortest edges and leave triangles without area on straight sides.
    "Mesh.RandomFactor": 1e-12,
    # Delaunay: half the time of the frontal variant, the same least angle.
    "Mesh.Algorithm": 5,
    # The sides are ours; only the inside is to be filled, and our node tags are to stay.
    "Mesh.MeshOnlyEmpty": 1,
    "Mesh.Renumber": 0,
    "Mesh.MeshSizeExtendFromBoundary": 0,
    "Mesh.MeshSizeFromPoints": 0,
    "Mesh.MeshSizeFromCurvature": 0,
    "Mesh.MeshSizeMin": 0.0,
    "Mesh.MeshSizeMax": 1e22,
}


def die_with_parent() -> None:
    """Have the kernel stop this process when its parent goes, however that ends (Linux)."""
    if sys.platform == "linux":
        pr_set_pdeathsig = 1
        ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGKILL)


def fill(loop: np.ndarray, corners: np.ndarray, spec: BlockSpec) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (n, 2), those of the loop first, and triangles (m, 3) inside the loop (k, 2)."""
    import gmsh

    # No configuration files: the mesh must not depend on what a user set for the gmsh program.
    gmsh.initialize(argv=[], readConfigFiles=False, interruptible=False)
    for name, value in OPTIONS.items():
        gmsh.option.setNumber(name, value)
    model = gmsh.model
    flat = np.column_stack([loop, np.zeros(len(loop))])
    tags = np.arange(1, len(loop) + 1)

    points = [model.geo.addPoint(*flat[c]) for c in corners]
    lines = [model.geo.addLine(points[i], points[(i + 1) % 4]) for i in range(4)]
    surface = model.geo.addPlaneSurface([model.geo.addCurveLoop(lines)])
    model.geo.synchronize()
    for point, c in zip(points, corners, strict=True):
        model.mesh.addNodes(0, point, [tags[c]], flat[c])
        model.mesh.addElementsByType(point, 15, [], [tags[c]])
    ends = [*corners[1:], len(loop)]
    for line, first, last in zip(lines, corners, ends, strict=True):
        chain = np.arange(first, last + 1) % len(loop)
        along = np.linalg.norm(flat[chain] - flat[first], axis=1)
        inner = chain[1:-1]
        model.mesh.addNodes(1, line, tags[inner], flat[inner].ravel(), (along / along[-1])[1:-1])
        edges = np.column_stack([tags[chain[:-1]], tags[chain[1:]]])
        model.mesh.addElementsByType(line, 1, [], edges.ravel())

    size = point_size(spec)
    model.mesh.setSizeCallback(lambda dim, tag, x, y, z, lc: size(x, y))
    model.mesh.generate(2)

    node_tags, coordinates, _ = model.mesh.getNodes()
    order = np.argsort(node_tags)
    node_tags = node_tags[order]
    vertices = coordinates.reshape(-1, 3)[order, :2]
    if not np.array_equal(vertices[: len(loop)], loop):
        raise RuntimeError("gmsh moved or renumbered the nodes on the sides of the block")
    _, corner_tags = model.mesh.getElementsByType(2, surface)
    triangles = np.searchsorted(node_tags, corner_tags).reshape(-1, 3)
    return vertices, triangles


def main() -> int:
    die_with_parent()
    result = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever gmsh prints must not end in the archive
    try:
        with np.load(io.BytesIO(sys.stdin.buffer.read())) as task:
            window = tuple(task["window"].tolist()) or None
            half_width, depth, surface_size, growth = task["numbers"].tolist()
            spec = BlockSpec(
                half_width, depth, task["intervals"], surface_size, growth, window=window
            )
            vertices, triangles = fill(task["loop"], task["corners"], spec)
    except Exception as error:
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
        return 1
    with result:
        archive = io.BytesIO()
        np.savez(archive, vertices=vertices, triangles=triangles)
        result.write(archive.getvalue())
    return 0


if __name__ == "__main__":
    sys.exit(main())
