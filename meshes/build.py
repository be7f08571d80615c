"""Builds the flat, graded, second-order mesh of a BlockSpec with gmsh in a separate process."""

import atexit
import os
import pickle
import signal
import subprocess
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import fields, replace
from pathlib import Path

import numpy as np

from meshes.block import BlockMesh, BlockSpec, MeshError, add_midpoints, check_spec, double_areas
from meshes.boundary import outline
from meshes.coating import with_layers
from meshes.quality import check_quality

# By its path, and without the working folder's modules (-P).
WORKER = (sys.executable, "-P", str(Path(__file__).with_name("gmsh_worker.py")))
# Without these variables of mpirun, gmsh does not start MPI as one more rank.
LAUNCHER_VARIABLES = ("OMPI_", "PMIX_", "PMI_", "PRTE_", "MPI_LOCAL", "HYDI_")
TIMEOUT = 600.0  # of a mesh [s]
GRACE = 1.0  # seconds that a worker with its pipes closed may take to end
# Decimals of lengths in units of surface_size: the same block in other units gives the same mesh.
UNIT_DECIMALS = 9


def in_units(spec: BlockSpec, unit: float) -> BlockSpec:
    """spec with all lengths divided by unit [m] and rounded to UNIT_DECIMALS."""

    def scaled(value: float | Sequence | None) -> float | list | None:
        if value is None:
            return None
        return np.round(np.asarray(value, dtype=float) / unit, UNIT_DECIMALS).tolist()

    lengths = (field.name for field in fields(spec) if field.name != "growth")
    return replace(spec, **{name: scaled(getattr(spec, name)) for name in lengths})


class GmshWorker:
    """A process of `meshes.gmsh_worker`, which makes one mesh after the other with gmsh."""

    def __init__(self) -> None:
        self.made_for, self.seconds = (os.getpid(), WORKER), 0.0
        pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
        self.process = subprocess.Popen(WORKER, env=_environment(), **pipes)

    def serves(self) -> bool:
        """Whether it is alive, of this process, and would be started so again."""
        return self.made_for == (os.getpid(), WORKER) and self.process.poll() is None

    def filled(self, task: tuple) -> tuple[np.ndarray, np.ndarray]:
        """See `run_worker`."""
        late = threading.Event()

        def stop() -> None:
            late.set()
            self.process.kill()

        timer = threading.Timer(TIMEOUT, stop)
        try:
            timer.start()
            pickle.dump(task, self.process.stdin)
            self.process.stdin.flush()
            filled, complaint, seconds = pickle.load(self.process.stdout)
        except Exception:  # it ended, or what it wrote raises errors of many kinds
            status, said = self.last_words()
            if late.is_set():
                raise MeshError(f"gmsh was stopped: not done after {TIMEOUT:g} s") from None
            if status == -signal.SIGKILL:
                raise MemoryError("gmsh was killed, as the system does where memory ends") from None
            how = "failed" if status >= 0 else f"crashed ({signal.Signals(-status).name})"
            raise MeshError(f"gmsh {how}: {said}") from None
        finally:
            timer.cancel()
        self.seconds += seconds
        if complaint:
            raise MeshError(f"gmsh failed: {complaint}")
        return filled

    def last_words(self) -> tuple[int, str]:
        """Exit status of the process, which is ended, and the last line that it wrote."""
        with suppress(subprocess.TimeoutExpired, OSError):
            self.process.stdin.close()
            self.process.wait(timeout=GRACE)
        self.process.kill()
        lines = self.process.stderr.read().decode(errors="replace").strip().splitlines()
        return self.process.wait(), lines[-1] if lines else "it said nothing"

    def close(self) -> None:
        """End the process, where it is this one's."""
        if self.made_for[0] == os.getpid():
            self.process.kill()
            self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout, self.process.stderr):
            with suppress(OSError):
                pipe.close()


# Workers without a task. One that runs is in no list: whoever takes it, has it alone.
idle: list[GmshWorker] = []


@atexit.register
def close_workers() -> None:
    """End the workers that wait for a task."""
    while idle:
        idle.pop().close()


def _environment() -> dict[str, str]:
    """Environment of a worker: without a launcher's variables, and with the project to import."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith(LAUNCHER_VARIABLES)}
    root = str(Path(__file__).resolve().parents[1])
    paths = [root, *filter(None, environment.get("PYTHONPATH", "").split(os.pathsep))]
    environment["PYTHONPATH"] = os.pathsep.join(paths)
    return environment


def start_worker() -> None:
    """Have one worker wait, which loads gmsh while this process does something else."""
    while idle and not idle[-1].serves():
        idle.pop().close()
    if not idle:
        idle.append(GmshWorker())


def run_worker(task: tuple) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (n, 2) and triangles (m, 3) by `meshes.gmsh_worker.fill` with the arguments `task`.
    Raises MeshError if the process fails, crashes, or takes longer than TIMEOUT, MemoryError if
    it is killed, and so is the next. The process waits for further tasks, but ends where this
    one fails or is interrupted."""
    try:
        return _filled(task)
    except MemoryError:
        return _filled(task)


def _filled(task: tuple) -> tuple[np.ndarray, np.ndarray]:
    worker = idle.pop() if idle else GmshWorker()
    try:
        if not worker.serves():
            worker.close()
            worker = GmshWorker()
        filled = worker.filled(task)
    except BaseException:
        worker.close()
        raise
    idle.append(worker)
    return filled


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


def build_block(spec: BlockSpec) -> BlockMesh:
    """Flat second-order mesh of the block, with element sizes by `meshes.size_law`.

    Each refined range has vertices at both ends and equal edges of surface_size, or of a whole
    fraction of it where a thin block, a fine window or a thin coating needs less. Points on the
    sides and on the interface are exact. The same spec gives the same mesh to the last bit, and a
    spec in other units of length the same triangles.

    Raises MeshError if spec cannot be meshed, if gmsh fails or runs out of time, or if the elements
    are not fit to solve on, MemoryError if gmsh is killed."""
    check_spec(spec)
    unit = spec.surface_size
    outer, small = outline(spec), in_units(spec, unit)
    # Rounding can give the scaled block another number of points.
    scaled = outline(small).points
    if scaled.shape != outer.points.shape:
        scaled = outer.points / unit
    points = np.round(scaled, UNIT_DECIMALS)
    vertices, triangles = run_worker((points, outer.lines, outer.regions, small))
    vertices = vertices * unit
    vertices[: len(outer.points)] = outer.points
    vertices, triangles = with_layers(vertices, triangles, spec.interface, outer.beside)
    refuse_unfilled(vertices, triangles, 2.0 * spec.half_width * spec.depth)
    points, triangles = add_midpoints(vertices, triangles)
    mesh = BlockMesh(points, triangles, np.zeros_like(points), spec)
    check_quality(mesh)
    return mesh
