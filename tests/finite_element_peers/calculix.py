"""CalculiX under comparison: quadratic triangles (CPE6) and face-to-face penalty contact.

The way its users go: the gap is given to the block's top, which a flat element presses, with all
of its nodes prescribed; linear pressure-overclosure of K = 1000 E per half-width, SPOOLES. K a
tenth of that leaves 4e-3 of the pressure, ten times that twice as many iterations and, on fine
meshes, none that converge. Node-to-face contact is off by 2 % with these elements; mortar contact
refuses elements in a plane. The deck's modulus is 1e9, since residuals of tiny forces count as
zero.
"""

import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter

import numpy as np

from tests.finite_element_peers import task as benchmark
from tests.harness import AbsentError, timed

COMMAND = "ccx"
MOST_SECONDS = 60.0  # of one run
STIFFNESS = 1e3  # K over E [1/m], at a half-width of 1 m
MODULUS = 1e9  # in the deck [Pa]
CORNERS = ((0, 1), (1, 2), (2, 0))  # of a face S1, S2, S3
REVERSED = [0, 2, 1, 5, 4, 3]  # z down to y up turns the triangles over
STEP = """*STEP
*STATIC
1.,1.
*BOUNDARY
PUNCH_NODES,1,1
PUNCH_NODES,2,2,{lower:.14g}
*CONTACT FILE,OUTPUT=2D
CSTR
*NODE FILE,OUTPUT=2D
U
*END STEP
"""


def check_installed() -> None:
    """Raises AbsentError."""
    if shutil.which(COMMAND) is None:
        get = "apt-get install --no-install-recommends calculix-ccx"
        raise AbsentError(f"CalculiX is not installed: {get}")


def solve(task: benchmark.BlockTask) -> benchmark.BlockAnswer:
    """Raises FailedError."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "contact.inp").write_text(deck(task) + STEP.format(lower=-task.approach))
        began = perf_counter()
        seconds = seconds_of([COMMAND, "contact"], folder, MOST_SECONDS)
        whole = (perf_counter() - began, seconds)
        nodes, pressure = last_contact((folder / "contact.frd").read_text())
    count = len(task.mesh.points)  # further nodes are the punch's
    peak = pressure[nodes <= count].max() * benchmark.MATERIAL.youngs_modulus / MODULUS
    return benchmark.BlockAnswer(float(peak), 2 * count, whole)


def seconds_of(command: Sequence[str], folder: Path, limit: float) -> float:
    """Processor time [s] of a command in a folder.

    Raises FailedError, with its last words, if it fails or takes more than `limit` [s].
    """
    options = {"cwd": folder, "capture_output": True, "check": True, "timeout": limit}
    try:
        return timed(lambda: subprocess.run(command, **options))[0]
    except subprocess.TimeoutExpired as late:
        raise benchmark.FailedError(f"not done after {limit:g} s") from late
    except subprocess.CalledProcessError as failure:
        said = (failure.stdout + failure.stderr).decode(errors="replace")
        raise benchmark.FailedError(" ".join(said.split())[-200:]) from failure


def deck(task: benchmark.BlockTask) -> str:
    """The model of one task, without its step; y points out of the body."""
    x, z = task.mesh.points.T
    y = np.where(task.touchable(x, z), -z - benchmark.gap(x), -z)
    triangles = task.mesh.triangles[:, REVERSED]
    top = task.touchable(x, z)
    start, stop = task.ends
    wide, first, last = 0.5 * (stop - start), len(x) + 1, len(triangles) + 1
    lines = ["*NODE"]
    lines += [f"{i},{a:.14g},{b:.14g}" for i, (a, b) in enumerate(zip(x, y, strict=True), 1)]
    punch = ((start - wide, 0.0), (stop + wide, 0.0), (stop + wide, wide), (start - wide, wide))
    lines += [f"{first + i},{a:.14g},{b:.14g}" for i, (a, b) in enumerate(punch)]
    lines += ["*ELEMENT,TYPE=CPE6,ELSET=BLOCK"]
    lines += [",".join(map(str, (e, *row))) for e, row in enumerate(triangles + 1, 1)]
    corners = ",".join(str(first + i) for i in range(4))
    lines += ["*ELEMENT,TYPE=CPE4,ELSET=PUNCH", f"{last},{corners}"]
    lines += ["*NSET,NSET=PUNCH_NODES", corners, "*NSET,NSET=FIXED"]
    lines += [str(i + 1) for i in np.flatnonzero(task.fixed(x, z))]
    lines += ["*SURFACE,NAME=TOP"]
    for face, ends in enumerate(CORNERS, 1):
        elements = np.flatnonzero(top[triangles[:, ends]].all(axis=1))
        lines += [f"{e + 1},S{face}" for e in elements]
    lines += ["*SURFACE,NAME=FLAT", f"{last},S1", "*MATERIAL,NAME=ELASTIC", "*ELASTIC"]
    lines += [f"{MODULUS:g},{benchmark.MATERIAL.poissons_ratio:.14g}"]
    for part in ("BLOCK", "PUNCH"):
        lines += [f"*SOLID SECTION,ELSET={part},MATERIAL=ELASTIC", "1."]
    lines += ["*SURFACE INTERACTION,NAME=PENALTY"]
    lines += ["*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR", f"{STIFFNESS * MODULUS:g}"]
    lines += ["*CONTACT PAIR,INTERACTION=PENALTY,TYPE=SURFACE TO SURFACE", "TOP,FLAT"]
    lines += ["*BOUNDARY", "FIXED,1,2"]
    return "\n".join(lines) + "\n"


def last_contact(text: str) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of the nodes and contact pressures of the last increment in a result file.

    Raises FailedError if there is none.
    """
    _, head, rest = text.rpartition("\n -4  CONTACT")
    rows = [row for row in rest.partition("\n -3")[0].splitlines() if row.startswith(" -1")]
    if not (head and rows):
        raise benchmark.FailedError("ccx wrote no contact pressures")
    # fields of 12 after the node's 10: three displacements, then the pressure
    return np.array([int(row[3:13]) for row in rows]), np.array([float(row[49:61]) for row in rows])
