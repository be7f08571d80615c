"""The half-plane solver beside other codes, on one thread.

    python -m tests.half_plane_peers

A smooth cylinder, a sinusoid and self-affine lines, at several sizes, each solved to the same
contact conditions by one measure (`tests.half_plane_peers.yardstick`).

A code stops by a criterion of its own: the loosest of its tolerances that meets the yardstick is
searched, so that none pays for digits that are not required. Then all codes run in turn, several
times, so that disturbances by other processes are shared. Times are processor times.

Exit status 0 only if a peer is installed and this project is, beside those installed, nowhere
slower, as many times faster as WANTED says, and its error no larger. Absent peers are named.
"""

import argparse
import statistics
import time
from dataclasses import dataclass, replace
from functools import partial

from tests.half_plane_peers.cases import LineCase, cylinder, rough, sinusoid
from tests.half_plane_peers.codes import LineAnswer, LineCode, contact_mechanics, crosscheck, tamaas
from tests.half_plane_peers.yardstick import TOLERANCE, ContactResiduals, measure
from tests.harness import Demand, installed, print_demands, print_table

SIZES = (256, 1024, 4096, 16384, 65536)
SEEDS = (1, 2, 3)
WANTED = {4096: 3.0, 65536: 20.0}  # times faster than the fastest peer; elsewhere never slower
SAME = 1e-3  # relative difference up to which two errors count as equal
SLOW = 20.0  # seconds of one run from which it is not repeated
BUDGET = 5.0  # seconds of repeats for one code on one case
BURST = 5e-3  # seconds: shorter calls are timed several in a row, with a warm cache
FEWEST = 3  # repeats of a code that is not slow
COLUMNS = ("case", "n", "code", "time [ms]", "ratio", "conditions", "error", "steps")


@dataclass(frozen=True)
class LineResult:
    """One code on one case.

    seconds    median processor time; where `over`, the limit that it exceeded
    over       stopped by the limit before it met the yardstick
    tolerance  the code's own
    steps      taken, where the code reports them
    """

    code: str
    seconds: float
    over: bool
    tolerance: float
    steps: int | None
    residuals: ContactResiduals

    @property
    def meets(self) -> bool:
        return not self.over and self.residuals.worst <= TOLERANCE


def main(arguments: list[str] | None = None) -> int:
    """Print every code on every case, and the demands; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, help="numbers of nodes")
    parser.add_argument("--seeds", type=int, nargs="*", default=SEEDS, help="of the rough lines")
    parser.add_argument("--repeats", type=int, default=21, help="most timed runs of one code")
    parser.add_argument("--limit", type=float, default=120.0, help="seconds for one run")
    options = parser.parse_args(arguments)
    ours, peers = crosscheck(), installed(tamaas, contact_mechanics)
    cases = {"cylinder": cylinder, "sinusoid": sinusoid}
    cases |= {f"self-affine, seed {seed}": partial(rough, seed=seed) for seed in options.seeds}
    wanted, rows = [], []
    for title, case_of in cases.items():
        for count in options.sizes:
            results = race(case_of(count), ours + peers, options.limit, options.repeats)
            rows += [(title, str(count), *_cells(result, results[0])) for result in results]
            wanted += demands(f"{title}, n = {count}", count, results[0], results[len(ours) :])
    print_table("Processor time; ratio: time over that of the first row", COLUMNS, rows)
    return print_demands(wanted, peers)


def _cells(result: LineResult, ours: LineResult) -> list[str]:
    return [
        result.code,
        f"over {result.seconds:.0f} s" if result.over else f"{1e3 * result.seconds:.3g}",
        f"{'> ' if result.over else ''}{result.seconds / ours.seconds:.3g}",
        f"{result.residuals.worst:.1e}" + ("" if result.meets else " missed"),
        f"{result.residuals.error:.3e}",
        "-" if result.steps is None else str(result.steps),
    ]


def race(case: LineCase, codes: list[LineCode], limit: float, repeats: int) -> list[LineResult]:
    """One result a code, in their order.

    limit    seconds after which a code is stopped
    repeats  most timed runs
    """
    most = {code.name: _most_steps(code, case, limit) for code in codes}
    trials = [_loosest(code, case, most[code.name], limit) for code in codes]
    times: list[list[float]] = [[] for _ in codes]
    for turn in range(repeats):
        for code, trial, spent in zip(codes, trials, times, strict=True):
            wanted = max(FEWEST, int(BUDGET / max(trial.seconds, 1e-6)))
            if trial.meets and trial.seconds <= SLOW and turn < wanted:
                calls = 1 + int(BURST / max(trial.seconds, 1e-6))
                spent.append(_timed(code, case, trial.tolerance, most[code.name], calls)[1])
    return [
        replace(trial, seconds=limit if trial.over else statistics.median(spent or [trial.seconds]))
        for trial, spent in zip(trials, times, strict=True)
    ]


def _timed(
    code: LineCode, case: LineCase, tolerance: float, most: int, calls: int = 1
) -> tuple[LineAnswer, float]:
    """The last answer of `calls` calls in a row, and the mean time [s] of one."""
    start = time.process_time()
    for _ in range(calls):
        answer = code.solve(case, tolerance, most)
    return answer, (time.process_time() - start) / calls


def _most_steps(code: LineCode, case: LineCase, limit: float) -> int:
    """Steps that take about `limit` seconds."""
    few, more = 5, 45
    tight = code.tolerances[-1]
    code.solve(case, tight, few)
    spent = [_timed(code, case, tight, steps)[1] for steps in (few, more)]
    per_step = max((spent[1] - spent[0]) / (more - few), 1e-7)
    return max(more, int(limit / per_step))


def _loosest(code: LineCode, case: LineCase, most: int, limit: float) -> LineResult:
    """Result at the loosest tolerance that meets the yardstick, or the last one where none does."""
    before = 0.0
    for tolerance in code.tolerances:
        answer, seconds = _timed(code, case, tolerance, most)
        residuals = measure(case, answer.pressure, code.element)
        over = residuals.worst > TOLERANCE and seconds > 0.8 * limit
        result = LineResult(code.name, seconds, over, tolerance, answer.steps, residuals)
        if result.meets or seconds >= 0.999 * before > 1.0:
            break  # or stopped by the limit, as with all tighter ones
        before = seconds
    return result


def demands(title: str, count: int, ours: LineResult, peers: list[LineResult]) -> list[Demand]:
    """Demands on `ours` beside the `peers` on one case of `count` nodes."""
    wishes = [Demand(ours.meets, f"{title}: ours meets the yardstick")]
    rivals = [peer for peer in peers if peer.meets or peer.over]
    misses = [peer.code for peer in peers if peer not in rivals]
    wishes += [Demand(True, f"{title}: {code} never meets the yardstick") for code in misses]
    if rivals:
        wanted = WANTED.get(count, 1.0)
        ratio = min(peer.seconds for peer in rivals) / ours.seconds
        text = f"{title}: {ratio:.3g} times faster, wanted {wanted:g}"
        wishes.append(Demand(ratio >= wanted, text))
    errors = [peer.residuals.error for peer in rivals if peer.meets]
    if errors:
        error, least = ours.residuals.error, min(errors)
        text = f"{title}: error {error:.3g}, of the best peer {least:.3g}"
        wishes.append(Demand(error <= (1.0 + SAME) * least, text))
    return wishes
