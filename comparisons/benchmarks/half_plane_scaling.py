"""How the half-plane solver's time grows with the number of nodes, on one thread.

    python -m comparisons.benchmarks.half_plane_scaling

A self-affine line between fixed cut-offs with a tenth of it in contact, periodic, and a smooth
cylinder on an unbounded one: the same surfaces, sampled ever more finely. Times are processor
times and include the making of the operator. Exit status 0 only if the demand holds for both.
"""

import argparse
from collections.abc import Callable
from functools import cache, partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import PeriodicHalfPlane
from comparisons.benchmarks import harness
from comparisons.benchmarks.half_plane_peers import cases

SIZES = tuple(2**power for power in range(10, 21, 2))
COARSEST = 1024  # nodes, 16 to the shortest wave
SEED = 1
BUDGET = 10.0  # seconds of repeats
STEEPEST = 1.2  # slope of log time over log n
COLUMNS = ("surface", "n", "time [ms]", "exchanges", "applications")


def rough(count: int) -> Callable[[], ContactSolution]:
    """The periodic line that COARSEST nodes resolve, a tenth of it in contact."""
    waves, load = _line()
    return partial(_solved, PeriodicHalfPlane, cases.hat_averages(waves, count), load)


@cache
def _line() -> tuple[np.ndarray, float]:
    waves = cases.rough_waves(COARSEST, SEED, cases.SHORTEST / COARSEST)
    return waves, cases.load_for_share(8 * COARSEST, waves)


def cylinder(count: int) -> Callable[[], ContactSolution]:
    """Hertz, half of the nodes in contact, on an unbounded line."""
    case = cases.cylinder(count)
    return partial(_solved, HalfPlane, case.hat_averages, case.load)


def _solved(
    kind: type[HalfPlane] | type[PeriodicHalfPlane], averages: np.ndarray, load: float
) -> ContactSolution:
    """Hats over a unit length; their averages of the gap (n,) [m], load [N/m]."""
    count = len(averages)
    weights = np.full(count, 1.0 / count)
    operator = kind(count, 1.0 / count, 1.0)
    solution = solve_contact(operator, averages / count, weights, Constraints(load=load))
    if not solution.converged:
        raise ArithmeticError(f"{count} nodes: {solution.residuals}")
    return solution


def demand(title: str, times: dict[int, float]) -> harness.Demand:
    """On the times [s] of one surface by its numbers of nodes, two or more."""
    slope = np.polyfit(*np.log(list(times.items())).T, 1)[0]
    text = f"{title}: time as n^{slope:.3f}, at most {STEEPEST:g}"
    return harness.Demand(bool(slope <= STEEPEST), text)


def main(arguments: list[str] | None = None) -> int:
    """Print all sizes of both surfaces, and the demands; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, help="numbers of nodes")
    parser.add_argument("--repeats", type=int, default=9, help="most timed runs of one size")
    options = parser.parse_args(arguments)
    demands, rows = [], []
    for title, make in (("self-affine, periodic", rough), ("cylinder, unbounded", cylinder)):
        times = {}
        for count in sorted(options.sizes):
            times[count], found = harness.timed(make(count), options.repeats, BUDGET)
            steps = (str(found.iterations[name]) for name in COLUMNS[3:])
            rows.append((title, str(count), f"{1e3 * times[count]:.4g}", *steps))
        demands.append(demand(title, times))
    harness.print_table("One solution", COLUMNS, rows)
    return harness.print_demands(demands)


if __name__ == "__main__":
    harness.run_on_one_thread(main)
