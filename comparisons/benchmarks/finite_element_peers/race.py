"""Several finite-element codes on one case, over a ladder of meshes.

On each mesh all codes run one after the other, again and again, so that what else the machine does
meets them alike. Times are the processor's. A code that fails on a mesh, or exceeds the limit
there, is not asked for finer ones of that kind.
"""

import statistics
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from comparisons.benchmarks.finite_element_peers.cases import Case
from comparisons.benchmarks.finite_element_peers.process import Code, FailedError, Run

REPEATS = 2  # timed solutions in one process, after a first one that warms it up
SLOW = 5.0  # seconds of a solution from which one round has to do


@dataclass(frozen=True)
class Point:
    """One code on one mesh.

    edges, growth  of the mesh: element edges to a, growth of the elements with the distance
    solve          median processor time from the mesh in memory to the pressures, warm [s]
    whole          median processor time of a process that solves once [s]
    errors         as `Case.errors`
    """

    code: str
    how: str
    edges: int
    growth: float
    unknowns: int
    steps: int
    solve: float
    whole: float
    errors: dict[str, float]


def race(
    case: Case,
    codes: Sequence[Code],
    growths: Sequence[float],
    rounds: int,
    limit: float,
    tell: Callable[[str], None],
) -> list[Point]:
    """One point a code and mesh; `tell` hears of codes that give up.

    growths  of the meshes at each rung of the case's ladder
    rounds   processes of each code on each mesh
    limit    seconds for one process
    """
    found = []
    for growth in growths:
        running = list(codes)
        for edges in case.ladder:
            task = case.task(edges, growth, REPEATS)
            runs: dict[Code, list[Run]] = {code: [] for code in running}
            for turn in range(rounds):
                for code in list(running):
                    if turn > 0 and runs[code][0].whole > SLOW:
                        continue
                    try:
                        with tempfile.TemporaryDirectory() as folder:
                            runs[code].append(code.solve(task, Path(folder), limit))
                    except FailedError as failure:
                        where = f"{case.title}, {edges} edges, growth {growth:g}"
                        tell(f"{code.name}, {code.how}: given up at {where}: {failure}")
                        running.remove(code)
            found += [
                _point(case, code, edges, growth, runs[code]) for code in running if runs[code]
            ]
    return found


def _point(case: Case, code: Code, edges: int, growth: float, runs: list[Run]) -> Point:
    answer = runs[-1].answer
    # the first solution of a process counts where there is no other
    warm = [time for run in runs for time in run.answer.seconds[-REPEATS:]]
    return Point(
        code=code.name,
        how=code.how,
        edges=edges,
        growth=growth,
        unknowns=answer.unknowns,
        steps=answer.steps,
        solve=float(statistics.median(warm)),
        whole=statistics.median(run.whole for run in runs),
        errors=case.errors(answer),
    )
