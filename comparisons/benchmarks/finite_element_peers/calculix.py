"""CalculiX under comparison: quadratic triangles (CPE6) and face-to-face penalty contact.

The way its users go: the gap is given to the block's top, which a flat element presses, with all
of its nodes prescribed; linear pressure-overclosure of K = 1000 E per half-width, SPOOLES. K a
tenth of that leaves 4e-3 of the pressure, ten times that twice as many iterations and, on fine
meshes, none that converge. Node-to-face contact is off by 2 % with these elements; mortar contact
refuses elements in a plane. The deck's modulus is 1e9, since residuals of tiny forces count as
zero.

ccx tells no times of its own: the solution's is that of the whole run less that of the same deck
with *NO ANALYSIS, which reads and checks it.
"""

from pathlib import Path

import numpy as np

from comparisons.benchmarks.finite_element_peers.process import FailedError, Run, spent
from comparisons.benchmarks.finite_element_peers.task import Answer, Task

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
NO_STEP = "*STEP\n*NO ANALYSIS\n*STATIC\n*END STEP\n"


def solve(command: str, task: Task, folder: Path, limit: float) -> Run:
    """The task by ccx, started as `command`; raises FailedError."""
    model = deck(task)
    (folder / "contact.inp").write_text(model + STEP.format(lower=-task.approach))
    (folder / "read.inp").write_text(model + NO_STEP)
    reading = spent([command, "read"], folder, limit)
    total = spent([command, "contact"], folder, limit)
    nodes, pressure = last_contact((folder / "contact.frd").read_text())
    x, z = task.points.T
    value = np.zeros(len(x))
    known = nodes <= len(x)  # the others are the punch's
    value[nodes[known] - 1] = pressure[known] * task.youngs_modulus / MODULUS
    ground = np.flatnonzero(task.touchable(x, z))
    ground = ground[np.argsort(x[ground])]
    steps = iterations((folder / "contact.cvg").read_text())
    seconds = np.array([total - reading])
    return Run(Answer(x[ground], value[ground], seconds, 2 * len(x), steps), total)


def deck(task: Task) -> str:
    """The model of one task, without its step; y points out of the body."""
    x, z = task.points.T
    y = np.where(task.touchable(x, z), -z - task.gap(x), -z)
    triangles = task.triangles[:, REVERSED]
    ground = task.touchable(x, z)
    start, stop = task.ground
    wide, first, last = 0.5 * (stop - start), len(x) + 1, len(triangles) + 1
    lines = ["*NODE"]
    lines += [f"{i},{a:.14g},{b:.14g}" for i, (a, b) in enumerate(zip(x, y, strict=True), 1)]
    punch = ((start - wide, 0.0), (stop + wide, 0.0), (stop + wide, wide), (start - wide, wide))
    lines += [f"{first + i},{a:.14g},{b:.14g}" for i, (a, b) in enumerate(punch)]
    lines += ["*ELEMENT,TYPE=CPE6,ELSET=BLOCK"]
    lines += [",".join(map(str, (e, *row))) for e, row in enumerate(triangles + 1, 1)]
    corners = ",".join(str(first + i) for i in range(4))
    lines += ["*ELEMENT,TYPE=CPE4,ELSET=PUNCH", f"{last},{corners}"]
    lines += ["*NSET,NSET=PUNCH_NODES", corners, "*NSET,NSET=HELD"]
    lines += [str(i + 1) for i in np.flatnonzero(task.held(x, z))]
    lines += ["*SURFACE,NAME=GROUND"]
    for face, ends in enumerate(CORNERS, 1):
        elements = np.flatnonzero(ground[triangles[:, ends]].all(axis=1))
        lines += [f"{e + 1},S{face}" for e in elements]
    lines += ["*SURFACE,NAME=FLAT", f"{last},S1", "*MATERIAL,NAME=ELASTIC", "*ELASTIC"]
    lines += [f"{MODULUS:g},{task.poissons_ratio:.14g}"]
    for part in ("BLOCK", "PUNCH"):
        lines += [f"*SOLID SECTION,ELSET={part},MATERIAL=ELASTIC", "1."]
    lines += ["*SURFACE INTERACTION,NAME=PENALTY"]
    lines += ["*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR", f"{STIFFNESS * MODULUS:g}"]
    lines += ["*CONTACT PAIR,INTERACTION=PENALTY,TYPE=SURFACE TO SURFACE", "GROUND,FLAT"]
    lines += ["*BOUNDARY", "HELD,1,2"]
    return "\n".join(lines) + "\n"


def last_contact(text: str) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of the nodes and contact pressures of the last increment in a result file.

    Raises FailedError if there is none.
    """
    found: dict[int, float] | None = None
    inside = False
    for line in text.splitlines():
        if line.startswith(" -4"):
            inside = line.split()[1] == "CONTACT"
            if inside:
                found = {}
        elif inside and line.startswith(" -1"):
            # fields of 12 after the node's 10: three displacements, then the pressure
            found[int(line[3:13])] = float(line[49:61])
        elif line.startswith(" -3"):
            inside = False
    if not found:
        raise FailedError("ccx wrote no contact pressures")
    return np.array(list(found)), np.array(list(found.values()))


def iterations(text: str) -> int:
    """Equilibrium iterations of all increments, from ccx's summary of its convergence."""
    return sum(line.split()[0].isdigit() for line in text.splitlines() if line.strip())
