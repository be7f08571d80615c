"""How the half-plane solver's time and memory grow with the number of nodes, on one thread.

    python -m comparisons.benchmarks.half_plane_scaling

A self-affine line between fixed cut-offs with a tenth of it in contact, periodic, and a smooth
cylinder on an unbounded one: the same surfaces, sampled ever more finely. Times are processor
times and include the making of the operator.

A pair is the transform of one application on the finest grid, forward and back. Shorter ones, of
the preconditioner and of coarser grids, count by their length. Exit status 0 only if the demands
hold for both. Memory needs Linux with glibc.
"""

import argparse
import ctypes
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.operators.convolution import Convolution
from analytic.operators.half_plane import HalfPlane, ModelOperator
from analytic.operators.periodic import PeriodicHalfPlane
from comparisons.benchmarks import harness
from comparisons.benchmarks.half_plane_peers import cases
from comparisons.common.processes import fresh_process

SIZES = tuple(2**power for power in range(10, 21, 2))
COARSEST = 1024  # nodes, 16 to the shortest wave
SEED = 1
BUDGET = 10.0  # seconds of repeats
PAIRS = 30  # timed for the median of one
STEEPEST = 1.2  # slope of log time over log n
OVERHEAD = 2.0  # largest time over that of the transforms alone
UNEVEN = 1.3  # largest ratio of memory per node between sizes
JUDGED = 65536  # nodes; below, the interpreter's own time and memory are not negligible
COLUMNS = ("surface", "n", "time [ms]", "exchanges", "pairs", "pair [ms]", "overhead", "bytes/n")


@dataclass(frozen=True)
class ScaledProblem:
    """Operator on `count` nodes of a unit length, weighted gap (count,) [m^2], load [N/m]."""

    count: int
    operator: Callable[[], Convolution]
    weighted_gap: np.ndarray
    load: float

    def solved(self, operator: ModelOperator) -> ContactSolution:
        weights = np.full(self.count, 1.0 / self.count)
        return solve_contact(operator, self.weighted_gap, weights, Constraints(load=self.load))


@dataclass(frozen=True)
class Growth:
    """Cost of one solution.

    seconds    processor time
    exchanges  of the active set
    pairs      of transforms, in pairs of the finest grid
    pair       seconds of one such pair
    memory     peak [bytes]
    """

    count: int
    seconds: float
    exchanges: int
    pairs: float
    pair: float
    memory: int

    @property
    def overhead(self) -> float:
        """Time over that of the pairs alone."""
        return self.seconds / (self.pairs * self.pair)


def rough(count: int) -> ScaledProblem:
    """The periodic line that COARSEST nodes resolve, a tenth of it in contact."""
    waves, load = _line()
    operator = partial(PeriodicHalfPlane, count, 1.0 / count, 1.0)
    return ScaledProblem(count, operator, cases.hat_averages(waves, count) / count, load)


@cache
def _line() -> tuple[np.ndarray, float]:
    waves = cases.rough_waves(COARSEST, SEED, cases.SHORTEST / COARSEST)
    return waves, cases.load_for_share(8 * COARSEST, waves)


def cylinder(count: int) -> ScaledProblem:
    """Hertz, half of the nodes in contact, on an unbounded line."""
    case = cases.cylinder(count)
    operator = partial(HalfPlane, count, 1.0 / count, 1.0)
    return ScaledProblem(count, operator, case.hat_averages / count, case.load)


class TransformCounter:
    """An operator that notes the lengths of its transforms, and of those on coarser grids."""

    def __init__(self, operator: Convolution, lengths: list[int]) -> None:
        self._operator, self._lengths = operator, lengths

    def __getattr__(self, name: str):
        return getattr(self._operator, name)

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        self._lengths.append(_transform_length(self._operator))
        return self._operator.apply(pressure)

    def precondition(self, displacement: np.ndarray) -> np.ndarray:
        self._lengths.append(self._operator.ring)
        return self._operator.precondition(displacement)

    def cropped(self, span: int) -> "TransformCounter | None":
        return self._counted(self._operator.cropped(span))

    def coarsened(self) -> "TransformCounter | None":
        return self._counted(self._operator.coarsened())

    def _counted(self, operator: Convolution | None) -> "TransformCounter | None":
        return None if operator is None else TransformCounter(operator, self._lengths)


def _transform_length(operator: Convolution) -> int:
    return operator.count if operator.periodic else next_fast_len(2 * operator.count, real=True)


def growth(make: Callable[[int], ScaledProblem], count: int, repeats: int) -> Growth:
    """Time the problem `repeats` times or while BUDGET lasts; count and measure memory once."""
    problem = make(count)
    lengths: list[int] = []
    operator = problem.operator()
    longest = _transform_length(operator)
    solution = problem.solved(TransformCounter(operator, lengths))
    if not solution.converged:
        raise ArithmeticError(f"{problem.count} nodes: {solution.residuals}")
    wave = np.random.default_rng(SEED).random(longest)
    irfft(rfft(wave), longest)  # makes its plan
    with fresh_process() as call:
        memory = call(_peak_memory, make, count)
    return Growth(
        count=problem.count,
        seconds=harness.timed(lambda: problem.solved(problem.operator()), repeats, BUDGET)[0],
        exchanges=solution.iterations["exchanges"],
        pairs=sum(lengths) / longest,
        pair=harness.timed(lambda: irfft(rfft(wave), longest), PAIRS)[0],
        memory=memory,
    )


def _peak_memory(make: Callable[[int], ScaledProblem], count: int) -> int:
    """Bytes that one solution adds to what this process holds; memory that is requested but never
    touched, which a tracer of allocations would count, is not included."""

    def highest() -> int:
        # getrusage would count what the parent held before this program was loaded
        status = Path("/proc/self/status").read_text()
        return 1024 * int(status.split("VmHWM:")[1].split()[0])

    problem = make(count)
    ctypes.CDLL(None).malloc_trim(0)  # hands back what was freed before
    Path("/proc/self/clear_refs").write_text("5")  # resets the peak
    before = highest()
    problem.solved(problem.operator())
    return highest() - before


def demands(title: str, rows: list[Growth]) -> list[harness.Demand]:
    """Demands on the rows of one surface, in ascending order of size."""
    found = []
    if len(rows) > 1:
        slope = np.polyfit(*np.log([(row.count, row.seconds) for row in rows]).T, 1)[0]
        text = f"{title}: time as n^{slope:.3f}, at most {STEEPEST:g}"
        found.append(harness.Demand(bool(slope <= STEEPEST), text))
    large = [row for row in rows if row.count >= JUDGED]
    if large:
        worst = max(row.overhead for row in large)
        text = f"{title}: {worst:.2f} times the transforms' own time, at most {OVERHEAD:g}"
        found.append(harness.Demand(worst <= OVERHEAD, text))
    if len(large) > 1:
        each = [row.memory / row.count for row in large]
        spread = max(each) / min(each)
        text = f"{title}: memory per node differs by {spread:.2f}, at most {UNEVEN:g}"
        found.append(harness.Demand(spread <= UNEVEN, text))
    return found


def main(arguments: list[str] | None = None) -> int:
    """Print all sizes of both surfaces, and the demands; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, help="numbers of nodes")
    parser.add_argument("--repeats", type=int, default=9, help="most timed runs of one size")
    options = parser.parse_args(arguments)
    found, rows = [], []
    for title, make in (("self-affine, periodic", rough), ("cylinder, unbounded", cylinder)):
        costs = [growth(make, count, options.repeats) for count in sorted(options.sizes)]
        found += demands(title, costs)
        rows += [
            (
                title,
                f"{cost.count}",
                f"{1e3 * cost.seconds:.4g}",
                f"{cost.exchanges}",
                f"{cost.pairs:.1f}",
                f"{1e3 * cost.pair:.4g}",
                f"{cost.overhead:.2f}",
                f"{cost.memory / cost.count:.0f}",
            )
            for cost in costs
        ]
    harness.print_table("One solution", COLUMNS, rows)
    return harness.print_demands(found)


if __name__ == "__main__":
    harness.run_on_one_thread(main)
