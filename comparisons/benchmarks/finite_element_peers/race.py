"""Contact on finite elements beside other codes, on one thread, at equal error.

    python -m comparisons.benchmarks.finite_element_peers

A cylinder, waves and roughness on it, pressed on the same blocks with the same meshes by CalculiX
and scikit-fem, each in the way of its users, and by this project. Processor time of a solution,
from the mesh in memory to the pressures, in a process that has solved the same before (CalculiX:
without start and reading). On each mesh all codes run in turn, several times, so that disturbances
by other processes are shared. A code that fails on a mesh, or exceeds the limit there, is not run
on finer ones.

An error counts as reached from the first mesh after which no finer one exceeds it. Times between
meshes are interpolated in logarithms of both. A code's time is that of its best configuration.

Exit status 0 only if a peer is installed and this project is no later than those installed at every
error that they reach. Absent peers are named.
"""

import argparse
import math
import statistics
from collections.abc import Sequence
from typing import NamedTuple

from comparisons.benchmarks.finite_element_peers import cases
from comparisons.benchmarks.finite_element_peers.calculix import calculix
from comparisons.benchmarks.finite_element_peers.scikit_fem import scikit_fem
from comparisons.benchmarks.harness import Demand, installed, print_demands, print_table, timed

CASES = ("cylinder", "waves", "rough")
TARGETS = {"pressure": (1e-1, 3e-2, 1e-2, 3e-3), "peak": (1e-2, 3e-3, 1e-3)}
SLOW = 5.0  # seconds of a solution from which it is not repeated
COLUMNS = ("case", "code", "configuration", "edges", "unknowns", "steps", "ms", *TARGETS)


class BlockResult(NamedTuple):
    """One code on one mesh: element edges to a, median processor time [s], `BlockCase.errors`."""

    code: cases.BlockCode
    edges: int
    seconds: float
    answer: cases.BlockAnswer
    errors: dict[str, float]


class TimesAtError(NamedTuple):
    """Times [s] of this project and of one peer, infinite where the error is not reached."""

    error: str
    peer: str
    ours: float
    theirs: float

    @property
    def demand(self) -> Demand:
        """That ours reaches the error where the peer does, and no later."""
        text = f"{self.error}: ours {self.ours:.3g} s, {self.peer} {self.theirs:.3g} s"
        return Demand(self.ours <= self.theirs, text)


def main(arguments: list[str] | None = None) -> int:
    """Print every mesh and the times at equal error; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--cases", nargs="+", default=CASES, choices=CASES)
    parser.add_argument("--rounds", type=int, default=3, help="timed solutions on a mesh")
    parser.add_argument("--limit", type=float, default=60.0, help="processor seconds for one")
    options = parser.parse_args(arguments)
    ours, peers = cases.crosscheck(), installed(calculix, scikit_fem)
    found, rows = [], []
    for name in options.cases:
        case = getattr(cases, name)()
        results = race(case, ours + peers, options.rounds, options.limit)
        rows += [_cells(case.title, result) for result in results]
        found += times_at_errors(case.title, results, ours[0].name)
    print_table("Every mesh, relative errors", COLUMNS, rows)
    for peer in peers:
        both = [t for t in found if t.peer == peer.name and max(t.ours, t.theirs) < math.inf]
        if both:
            ratio = statistics.median(times.theirs / times.ours for times in both)
            print(f"{peer.name}: {ratio:.3g} times our time, in the median")
    return print_demands([times.demand for times in found], peers)


def _cells(title: str, result: BlockResult) -> list[str]:
    code, answer = result.code, result.answer
    sizes = map(str, (result.edges, answer.unknowns, answer.steps))
    errors = (f"{result.errors[name]:.1e}" for name in TARGETS)
    return [title, code.name, code.configuration, *sizes, f"{1e3 * result.seconds:.3g}", *errors]


def race(
    case: cases.BlockCase, codes: Sequence[cases.BlockCode], rounds: int, limit: float
) -> list[BlockResult]:
    """One result a code and mesh; prints which codes are not run any further.

    rounds  timed solutions of each code on each mesh, after a first one
    limit   seconds of one solution after which a code gets no finer mesh
    """
    found = []
    running = list(codes)
    for edges in case.edges:
        task = case.task(edges)
        trials: dict[cases.BlockCode, tuple[float, cases.BlockAnswer]] = {}
        for code in list(running):
            try:
                seconds, answer = trials[code] = _solved(code, task)
                stopped = f"{seconds:.0f} s" if seconds > limit else None
            except cases.FailedError as failure:
                stopped = str(failure)
            if stopped:
                running.remove(code)
                print(f"{code.name}, {code.configuration}: {case.title}, {edges} edges: {stopped}")
        times: dict[cases.BlockCode, list[float]] = {code: [] for code in trials}
        for _ in range(rounds):
            for code, (seconds, _) in trials.items():
                if seconds <= SLOW:
                    times[code].append(_solved(code, task)[0])
        for code, (seconds, answer) in trials.items():
            median = statistics.median(times[code] or [seconds])
            found.append(BlockResult(code, edges, median, answer, case.errors(answer)))
    return found


def _solved(code: cases.BlockCode, task: cases.BlockTask) -> tuple[float, cases.BlockAnswer]:
    """Processor time [s] and answer."""
    seconds, answer = timed(lambda: code.solve(task), 1)
    return seconds if answer.seconds is None else answer.seconds, answer


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


def times_at_errors(case: str, results: Sequence[BlockResult], ours: str) -> list[TimesAtError]:
    """Ours beside each peer on one case, at every error of TARGETS that one of them reaches."""
    curves: dict[str, dict[str, list[BlockResult]]] = {}
    for result in results:
        of_code = curves.setdefault(result.code.name, {})
        of_code.setdefault(result.code.configuration, []).append(result)
    found = []
    for error, targets in TARGETS.items():
        for target in targets:
            best = {
                name: min(
                    time_at([(result.errors[error], result.seconds) for result in curve], target)
                    for curve in of_code.values()
                )
                for name, of_code in curves.items()
            }
            our_time = best.pop(ours, math.inf)
            text = f"{case}, {error} to {target:g}"
            found += [TimesAtError(text, peer, our_time, time) for peer, time in best.items()]
    return [times for times in found if min(times.ours, times.theirs) < math.inf]
