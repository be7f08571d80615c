"""Whole processes to 1e-4 of Hertz' peak pressure: this project beside CalculiX and scikit-fem.

    python -m tests.finite_element_peers.whole_process

The cylinder of `cases`, on one thread: processor time of a process from its start to its end,
imports included.
CalculiX and scikit-fem read their mesh; this project makes its own in the same process. So there
are two comparisons: as it stands, and with the time that gmsh takes for the mesh, in a process of
its own, added to the peers' times. Growth of the elements is a choice, too: quadratic elements that
grow by 0.4 never reach 1e-4. Of every code the least time counts, of meshes from which on no finer
one of the same growth is worse than 1e-4.

Exit status 0 only if a peer is installed and this project takes no longer than those installed,
the time of the mesh counted for all.
"""

import json
import math
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np

from meshes.block import BlockMesh, BlockSpec
from tests.finite_element_peers import task as benchmark
from tests.harness import AbsentError, Demand, print_demands, print_table, run_on_one_thread, timed

GROWTHS, EDGES = (0.4, 0.2, 0.1), (10, 20, 40, 80)
ERROR, ROUNDS = 1e-4, 3
OURS, MESH, PEER = "crosscheck", "mesh", "scikit-fem"
# Degree of this project's elements and hats to an edge.
CONFIGURATIONS = {"P2": (2, 1), "P3": (3, 2)}
COLUMNS = ("code", "growth", "edges", "unknowns", "peak", "s", "with mesh", "wall s")

MODULE = "tests.finite_element_peers.whole_process"

Times = tuple[float, float]  # wall, processor [s]


def solve(code: str, file: str | Path) -> None:
    """Print unknowns and peak pressure, but of MESH: a process is timed at this."""
    block = dict(np.load(file))
    start, stop, size, growth = block["spec"]
    spec = BlockSpec(benchmark.BLOCK, benchmark.BLOCK, np.array([[start, stop]]), size, growth)
    if code == PEER:
        from tests.finite_element_peers.scikit_fem import solve as solved

        points = block["points"]
        mesh = BlockMesh(points, block["triangles"], np.zeros_like(points), spec)
    else:
        from meshes.build import build_block

        mesh = build_block(spec)
        if code == MESH:
            return
        from tests.finite_element_peers.cases import solved as solved_by_us

        solved = partial(solved_by_us, *CONFIGURATIONS[code])
    answer = solved(benchmark.BlockTask(mesh, float(block["approach"])))
    print(json.dumps([int(answer.unknowns), answer.peak]))


def stored(task: benchmark.BlockTask, file: Path) -> Path:
    """The task as a process reads it."""
    spec, mesh = task.mesh.spec, task.mesh
    known = {"spec": [*task.ends, spec.surface_size, spec.growth], "approach": task.approach}
    mesh = {"points": mesh.points, "triangles": mesh.triangles}
    np.savez(file, **known, **mesh)
    return file


def process(code: str, file: Path) -> tuple[Times, list]:
    """Medians of the times of a process, and what it printed."""
    command, walls, seconds = [sys.executable, "-m", MODULE, code, str(file)], [], []
    options = {"check": True, "capture_output": True, "text": True}
    for _ in range(ROUNDS):
        began = perf_counter()
        spent, done = timed(lambda: subprocess.run(command, **options))
        walls.append(perf_counter() - began)
        seconds.append(spent)
    return (median(walls), median(seconds)), json.loads(done.stdout or "[]")


def main() -> int:
    """Print every process and the least times; the exit status."""
    from tests.finite_element_peers import calculix, cases, scikit_fem

    peers = []
    for name, peer in (("CalculiX", calculix), (PEER, scikit_fem)):
        try:
            peer.check_installed()
            peers.append(name)
        except AbsentError as absent:
            print(f"skipped: {absent}")
    case, rows, curves = cases.cylinder(), [], {}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "task.npz"
        for growth in GROWTHS:
            for edges in EDGES:
                task = case.task(edges, growth)
                stored(task, file)
                (_, meshing), _ = process(MESH, file)
                runs = {name: process(name, file) for name in CONFIGURATIONS}
                if PEER in peers:
                    runs[PEER] = process(PEER, file)
                if "CalculiX" in peers:  # a process of its own; once, it takes seconds
                    try:
                        peak, unknowns, whole = calculix.solve(task)
                        runs["CalculiX"] = whole, [unknowns, peak]
                    except benchmark.FailedError as failure:
                        print(f"CalculiX, growth {growth:g}, {edges} edges: {failure}")
                for name, ((wall, seconds), (unknowns, peak)) in runs.items():
                    error = abs(peak / case.peak - 1.0)
                    whole = seconds + (meshing if name in peers else 0.0)
                    code = name if name in peers else f"{OURS}, {name}"
                    curves.setdefault((code, growth), []).append((error, seconds, whole))
                    numbers = f"{growth:g}", str(edges), str(unknowns), f"{error:.1e}"
                    rows.append((code, *numbers, *(f"{t:.2f}" for t in (seconds, whole, wall))))
    print_table("Whole processes", COLUMNS, rows)
    return print_demands(verdicts(curves, peers), peers)


Curves = dict[tuple[str, float], list[tuple[float, float, float]]]


def verdicts(curves: Curves, peers: list[str]) -> list[Demand]:
    """Demands on curves by code with its configuration, and growth: error, seconds, seconds with
    the mesh, coarse to fine."""
    least: dict[str, list[float]] = {}
    for (code, _), curve in curves.items():
        owner = code.partition(",")[0]
        times = [time_at([(error, both[k]) for error, *both in curve], ERROR) for k in (0, 1)]
        least[owner] = list(map(min, least.get(owner, times), times))
    wanted, ours = [], least[OURS][0]
    for name in peers:
        reading, meshed = (theirs / ours for theirs in least[name])
        text = f"peak to {ERROR:g}: ours {ours:.2f} s, {name} {least[name][1]:.2f} s, "
        text += f"{meshed:.2g} times; {reading:.2g} times where it reads its mesh"
        wanted.append(Demand(meshed >= 1.0, text))
    return wanted


def time_at(curve: Sequence[tuple[float, float]], target: float) -> float:
    """Time at an error from (error, time) of each mesh, coarse to fine; inf if not reached."""
    before = None
    for mesh, (_, time) in enumerate(curve):
        error = max(error for error, _ in curve[mesh:])
        if error <= target:
            if before is None or before[0] <= error:
                return time
            share = math.log(before[0] / target) / math.log(before[0] / error)
            return before[1] * (time / before[1]) ** share
        before = error, time
    return math.inf


if __name__ == "__main__":
    if len(sys.argv) > 1:
        solve(*sys.argv[1:])
    else:
        run_on_one_thread(main)
