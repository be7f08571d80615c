"""Builds the flat, graded, second-order mesh of a BlockSpec with gmsh in a separate process."""

import os
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import fields, replace
from pathlib import Path

import numpy as np

from meshes.block import BlockMesh, BlockSpec, MeshError, add_midpoints, check_spec, double_areas
from meshes.boundary import outline
from meshes.coating import with_layers
from meshes.quality import check_quality
from meshes.size_field import SizeField

# By its path, and without the working folder's modules (-P).
WORKER = (sys.executable, "-P", str(Path(__file__).with_name("gmsh_worker.py")))
# Without these variables of mpirun, gmsh does not start MPI as one more rank.
LAUNCHER_VARIABLES = ("OMPI_", "PMIX_", "PMI_", "PRTE_", "MPI_LOCAL", "HYDI_")
# Decimals of lengths in units of surface_size: the same block in other units gives the same mesh.
UNIT_DECIMALS = 9


def in_units(spec: BlockSpec, unit: float) -> BlockSpec:
    """spec with all lengths divided by unit [m] and rounded to UNIT_DECIMALS."""

    def scaled(value: float | Sequence | None) -> float | list | None:
        if value is None:
            return None
        return np.round(np.asarray(value, dtype=float) / unit, UNIT_DECIMALS).tolist()

    lengths = (each.name for each in fields(spec) if each.name != "growth")
    return replace(spec, **{name: scaled(getattr(spec, name)) for name in lengths})


def field_in_units(sizes: SizeField, unit: float) -> SizeField:
    """sizes with all lengths divided by unit [m] and rounded to UNIT_DECIMALS."""
    vertices, size = (np.round(each / unit, UNIT_DECIMALS) for each in (sizes.vertices, sizes.size))
    return replace(sizes, vertices=vertices, size=size)


def run_worker(task: tuple, timeout: float) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (n, 2) and triangles (m, 3) by `meshes.gmsh_worker.fill` with the arguments `task`.

    Raises MeshError if the process fails, crashes, or takes longer than timeout [s]. The process
    ends with this call, whatever happens.
    """
    environment = {k: v for k, v in os.environ.items() if not k.startswith(LAUNCHER_VARIABLES)}
    root = str(Path(__file__).resolve().parents[1])
    paths = [root, *filter(None, environment.get("PYTHONPATH", "").split(os.pathsep))]
    environment["PYTHONPATH"] = os.pathsep.join(paths)
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    with subprocess.Popen(WORKER, env=environment, **pipes) as process:
        try:
            output, complaint = process.communicate(pickle.dumps(task), timeout=timeout)
        except subprocess.TimeoutExpired as error:
            raise MeshError(f"gmsh was stopped: not done after {timeout:g} s") from error
        finally:
            process.kill()
    if process.returncode != 0:
        raise MeshError(explain_failure(process.returncode, complaint.decode(errors="replace")))
    try:
        return pickle.loads(output)
    except Exception as error:  # incomplete output raises errors of many kinds
        raise MeshError("gmsh ended without a mesh") from error


def explain_failure(status: int, complaint: str) -> str:
    """One sentence for a gmsh process that ended with status and wrote complaint."""
    lines = [line.strip() for line in complaint.splitlines() if line.strip()]
    last = lines[-1] if lines else "it said nothing"
    if "cannot open shared object file" in last:
        return (
            f"gmsh cannot be loaded, a system library is missing ({last}): "
            "apt install libglu1-mesa libgl1 libxrender1 libxcursor1 libxfixes3 libxft2 "
            "libfontconfig1 libxinerama1"
        )
    if "No module named 'gmsh'" in last:
        return "gmsh is not installed: pip install gmsh"
    if status < 0:
        return f"gmsh crashed ({signal.Signals(-status).name}): {last}"
    return f"gmsh failed: {last}"


def refuse_unfilled(vertices: np.ndarray, triangles: np.ndarray, area: float) -> None:
    """Raises MeshError unless the triangles (m, 3) use all vertices and fill the area [m^2]."""
    used = np.zeros(len(vertices), dtype=bool)
    used[triangles] = True
    filled = 0.5 * np.abs(double_areas(vertices, triangles)).sum()
    if not (used.all() and abs(filled - area) <= 1e-9 * area):
        raise MeshError(
            f"gmsh failed: its {len(triangles)} triangles cover {filled / area:.6g} of the block "
            f"and leave {np.count_nonzero(~used)} vertices unused"
        )


def build_block(
    spec: BlockSpec, *, sizes: SizeField | None = None, timeout: float = 600.0
) -> BlockMesh:
    """Flat second-order mesh of the block, with element sizes by `meshes.size_law`.

    Each refined range has vertices at both ends and equal edges of surface_size, or of a whole
    fraction of it where a thin block, a fine window or a thin coating needs less. Points on the
    sides and on the interface are exact. The same spec gives the same mesh to the last bit, and a
    spec in other units of length the same triangles.

    sizes     from an earlier mesh of the same block: outside the refined ranges elements follow
              them where they are smaller than the size law's
    timeout   of gmsh [s]

    Raises MeshError if spec cannot be meshed, if gmsh fails or runs out of time, or if the elements
    are not fit to solve on.
    """
    began = time.perf_counter()
    check_spec(spec)
    unit = spec.surface_size
    given, small = outline(spec, sizes), in_units(spec, unit)
    field = None if sizes is None else field_in_units(sizes, unit)
    # Rounding can give the scaled block another number of points.
    scaled = outline(small, field).points
    if scaled.shape != given.points.shape:
        scaled = given.points / unit
    points = np.round(scaled, UNIT_DECIMALS)
    vertices, triangles = run_worker((points, given.lines, given.regions, small, field), timeout)
    vertices = vertices * unit
    vertices[: len(given.points)] = given.points
    vertices, triangles = with_layers(vertices, triangles, spec.interface, given.beside)
    refuse_unfilled(vertices, triangles, 2.0 * spec.half_width * spec.depth)
    points, triangles = add_midpoints(vertices, triangles)
    mesh = BlockMesh(points, triangles, np.zeros_like(points), spec)
    quality = check_quality(mesh)
    return replace(mesh, quality=quality | {"seconds": time.perf_counter() - began})
