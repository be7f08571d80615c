"""Several codes on one case: each as loose as the yardstick lets it be, timed in turn.

A code stops by a criterion of its own. Of its tolerances the loosest is searched with which the
yardstick is met, so that none is charged for digits that nobody asked for. Then all codes run one
after the other, again and again, so that what else the machine does meets them alike. Time is the
processor's, which other processes do not lengthen and a second thread does.
"""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

from comparisons.benchmarks.half_plane_peers.cases import Case
from comparisons.benchmarks.half_plane_peers.code import Answer, Code
from comparisons.benchmarks.half_plane_peers.yardstick import TOLERANCE, Measure, measure

SLOW = 20.0  # seconds from which one run has to do
BUDGET = 5.0  # seconds of repeats for one code on one case
BURST = (
    5e-3  # seconds: shorter calls are timed in a row, not each with the others' data in the cache
)
FEWEST = 3  # repeats of a code that is not slow


@dataclass(frozen=True)
class Entry:
    """One code on one case.

    seconds    median processor time; where `over`, the limit that it exceeded
    over       ended by the limit, short of the yardstick
    tolerance  index of the code's own tolerance
    steps      taken, where known
    """

    code: str
    seconds: float
    over: bool
    tolerance: int
    steps: int | None
    measure: Measure

    @property
    def meets(self) -> bool:
        return not self.over and self.measure.worst <= TOLERANCE


@dataclass(frozen=True)
class _Run:
    answer: Answer
    seconds: float
    measure: Measure

    @property
    def meets(self) -> bool:
        return self.measure.worst <= TOLERANCE


def race(
    case: Case, codes: list[Code], limit: float, repeats: int, first: dict[str, int]
) -> list[Entry]:
    """One entry a code, in their order.

    limit    seconds after which a code is stopped
    repeats  most timed runs
    first    by code, the index of the tolerance to try first; others start with the loosest
    """
    most = {code.name: _most_steps(code, case, limit) for code in codes}
    settled = {
        code.name: _settle(code, case, most[code.name], first.get(code.name, 0)) for code in codes
    }
    times = {
        name: [run.seconds] if run.seconds > SLOW else [] for name, (_, run) in settled.items()
    }
    for turn in range(repeats):
        for code in codes:
            index, run = settled[code.name]
            wanted = max(FEWEST, int(BUDGET / max(run.seconds, 1e-6)))
            if run.meets and run.seconds <= SLOW and turn < wanted:
                tolerance = code.tolerances[index]
                calls = 1 + int(BURST / max(run.seconds, 1e-6))
                spent = _timed(code, case, tolerance, most[code.name], calls)[1]
                times[code.name].append(spent)
    entries = []
    for code in codes:
        index, run = settled[code.name]
        over = not run.meets and run.seconds > 0.8 * limit
        seconds = limit if over else statistics.median(times[code.name] or [run.seconds])
        steps = run.answer.steps
        if steps is None and code.count is not None and run.seconds <= SLOW:
            steps = code.count(case, code.tolerances[index], most[code.name])
        entries.append(Entry(code.name, seconds, over, index, steps, run.measure))
    return entries


def _timed(
    code: Code, case: Case, tolerance: float, most: int, calls: int = 1
) -> tuple[Answer, float]:
    """The last answer of so many calls in a row, and the time of one."""
    start = time.process_time()
    for _ in range(calls):
        answer = code.solve(case, tolerance, most)
    return answer, (time.process_time() - start) / calls


def _most_steps(code: Code, case: Case, limit: float) -> int:
    """Steps that fill the limit; a code without tolerances of its own has no use for them."""
    few, more = 5, 45
    if len(code.tolerances) == 1:
        return 0
    tight = code.tolerances[-1]
    code.solve(case, tight, few)
    spent = [_timed(code, case, tight, steps)[1] for steps in (few, more)]
    each = max((spent[1] - spent[0]) / (more - few), 1e-7)
    return max(more, int(limit / each))


def _settle(code: Code, case: Case, most: int, first: int) -> tuple[int, _Run]:
    """The loosest tolerance that meets the yardstick, by its index, and the run with it.

    Where none does, the last one tried.
    """

    def run(index: int) -> _Run:
        answer, seconds = _timed(code, case, code.tolerances[index], most)
        return _Run(answer, seconds, measure(case, answer.pressure, code.element))

    return _loosest(run, first, len(code.tolerances))


def _loosest(run: Callable[[int], _Run], first: int, count: int) -> tuple[int, _Run]:
    index, found = first, run(first)
    if found.meets:
        while index > 0 and (looser := run(index - 1)).meets:
            index, found = index - 1, looser
        return index, found
    while not found.meets and index + 1 < count:
        tighter = run(index + 1)
        if not tighter.meets and tighter.seconds >= 0.999 * found.seconds > 1.0:
            return index + 1, tighter  # stopped by the limit: a tighter one will be, too
        index, found = index + 1, tighter
    return index, found
