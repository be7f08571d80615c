"""Runs gmsh, which can crash its process, in a separate one, which `meshes.build` starts.

Reads the arguments of `fill` from standard input, pickled, one after the other. What it returns or
raises, in words, and its processor seconds go to standard output, pickled."""

import ctypes
import os
import pickle
import signal
import sys
import time
from contextlib import suppress
from importlib import import_module

import numpy as np

from meshes.block import BlockSpec
from meshes.size_law import point_size

OPTIONS = {
    "General.Terminal": 0,
    "General.NumThreads": 1,
    "Mesh.MaxNumThreads1D": 1,
    "Mesh.MaxNumThreads2D": 1,
    "Mesh.RandomSeed": 1,
    # The default random shift is relative to the whole block: with depth/h beyond 5e4 it can leave
    # triangles without area on straight sides.
    "Mesh.RandomFactor": 1e-12,
    # Delaunay: half the time of the frontal variant, the same least angle.
    "Mesh.Algorithm": 5,
    # gmsh fills the inside only; nodes on the sides are given and keep their tags.
    "Mesh.MeshOnlyEmpty": 1,
    "Mesh.Renumber": 0,
    "Mesh.MeshSizeExtendFromBoundary": 0,
    "Mesh.MeshSizeFromPoints": 0,
    "Mesh.MeshSizeFromCurvature": 0,
    "Mesh.MeshSizeMin": 0.0,
    "Mesh.MeshSizeMax": 1e22,
}


def die_with_parent() -> None:
    """Have the kernel stop this process when its parent ends (Linux)."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def fill(
    points: np.ndarray,
    lines: tuple[np.ndarray, ...],
    regions: tuple[tuple[int, ...], ...],
    spec: BlockSpec,
) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (n, 2), the given points first, and triangles (m, 3) that fill all regions. points
    (k, 2), lines and regions as in `meshes.boundary.Outline`."""
    import gmsh

    if gmsh.isInitialized():  # by the task before, of which nothing stays
        gmsh.finalize()
    # The mesh must not depend on a user's configuration files of gmsh.
    gmsh.initialize(argv=[], readConfigFiles=False, interruptible=False)
    for name, value in OPTIONS.items():
        gmsh.option.setNumber(name, value)
    model = gmsh.model
    place = np.column_stack([points, np.zeros(len(points))])
    tags = np.arange(1, len(points) + 1)

    ends = dict.fromkeys(int(end) for line in lines for end in line[[0, -1]])
    ends = {end: model.geo.addPoint(*place[end]) for end in ends}
    curves = [model.geo.addLine(ends[line[0]], ends[line[-1]]) for line in lines]
    for region in regions:
        loop = [int(np.sign(k)) * curves[abs(k) - 1] for k in region]
        model.geo.addPlaneSurface([model.geo.addCurveLoop(loop)])
    model.geo.synchronize()
    for end, point in ends.items():
        model.mesh.addNodes(0, point, [tags[end]], place[end])
        model.mesh.addElementsByType(point, 15, [], [tags[end]])
    for curve, line in zip(curves, lines, strict=True):
        along = np.linalg.norm(place[line] - place[line[0]], axis=1)
        inner = line[1:-1]
        model.mesh.addNodes(1, curve, tags[inner], place[inner].ravel(), (along / along[-1])[1:-1])
        edges = np.column_stack([tags[line[:-1]], tags[line[1:]]])
        model.mesh.addElementsByType(curve, 1, [], edges.ravel())

    size = point_size(spec)
    model.mesh.setSizeCallback(lambda dim, tag, x, y, z, lc: size(x, y))
    model.mesh.generate(2)

    node_tags, coordinates, _ = model.mesh.getNodes()
    order = np.argsort(node_tags)
    node_tags = node_tags[order]
    vertices = coordinates.reshape(-1, 3)[order, :2]
    if not np.array_equal(vertices[: len(points)], points):
        raise RuntimeError("gmsh moved or renumbered the nodes on the sides of the block")
    _, corner_tags = model.mesh.getElementsByType(2)
    triangles = np.searchsorted(node_tags, corner_tags).reshape(-1, 3)
    return vertices, triangles


def main() -> None:
    """Answer one task after the other."""
    die_with_parent()
    with suppress(Exception):  # the first task says why it is not there
        import_module("gmsh")
    with os.fdopen(os.dup(1), "wb") as answers:
        # what gmsh prints must not get into the results, nor fill a pipe that is read at the end
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        while True:
            try:
                task = pickle.load(sys.stdin.buffer)
            except EOFError:
                return
            began, filled, complaint = time.process_time(), None, None
            try:
                filled = fill(*task)
            except Exception as error:
                complaint = f"{type(error).__name__}: {error}"
            pickle.dump((filled, complaint, time.process_time() - began), answers)
            answers.flush()


if __name__ == "__main__":
    main()
