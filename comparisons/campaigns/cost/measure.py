"""Time and memory of one setting of one method, in a process of its own with one thread.

In: a problem, a method, a setting. Out: the solution and what it cost. Seconds are processor time,
gmsh's process included: on an idle machine the wall time, on a busy one what the wall time would be
if the machine were idle."""

import re
import statistics
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial

from comparisons.campaigns.cost.methods import SolutionMethod, Values, solved
from comparisons.common.errors import InputError
from comparisons.common.progress import Stages, peak_memory, processor_seconds
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.window import window_of

# Methods that this process has run. The first solution loads libraries, and does not count.
_begun: set[str] = set()


@dataclass(frozen=True)
class CostTask:
    """What to measure: as many `repeats` as `limit` seconds allow, at least one."""

    problem: Problem
    method: SolutionMethod
    setting: float
    repeats: int = 1
    limit: float = 0.0
    half_block: bool = False  # whether an unbounded body is held at half the distance

    @property
    def name(self) -> str:
        method = re.sub(r"\W+", "-", self.method.name)
        return f"{method}_{self.setting!r}{'_half_block' if self.half_block else ''}"


@dataclass(frozen=True)
class MeasuredRun:
    """Solution and cost of a setting: medians over the `repeats` that were counted."""

    level: Level  # without its mesh
    values: Values
    seconds: dict[str, float]  # processor time by stage
    total: float  # of all stages
    wall: float  # wall time
    spread: tuple[float, float]  # smallest and largest total
    repeats: int
    memory: int  # largest of the process so far [bytes]; settings come from coarse to fine
    spent: float  # seconds that measuring took in all


class RefusedError(Exception):
    """Why a setting has no solution: `skipped` as too large, or failed."""

    def __init__(self, because: str, skipped: bool) -> None:
        super().__init__(because, skipped)
        self.because, self.skipped = because, skipped


class ProcessorStages(Stages):
    """Processor seconds by stage, those of ended child processes included."""

    @contextmanager
    def stage(self, name: str, announce: str | None = None) -> Iterator[None]:
        begin = processor_seconds()
        try:
            yield
        finally:
            self.seconds[name] = self.seconds.get(name, 0.0) + processor_seconds() - begin


def measure(task: CostTask) -> MeasuredRun:
    """Raises RefusedError."""
    first, times = processor_seconds(), []
    try:
        window = window_of(task.problem) if task.problem.scene.stress is not None else None
        inputs = task.method, task.problem, task.setting, window
        solve = partial(solved, *inputs, half_block=task.half_block)
        if task.method.name not in _begun:
            solve(stages=ProcessorStages())
            _begun.add(task.method.name)
        while not times or (len(times) < task.repeats and processor_seconds() - first < task.limit):
            stages, begin = ProcessorStages(), time.perf_counter()
            level, values = solve(stages=stages)
            times.append((stages.seconds, time.perf_counter() - begin))
    except InputError as error:  # of the budget, before anything was meshed
        raise RefusedError(str(error), skipped=True) from error
    except Exception as error:
        raise RefusedError(f"{type(error).__name__}: {error}", skipped=False) from error
    totals = [sum(seconds.values()) for seconds, _ in times]
    return MeasuredRun(
        level=level,
        values=values,
        seconds={name: statistics.median(s[name] for s, _ in times) for name in times[0][0]},
        total=statistics.median(totals),
        wall=statistics.median(wall for _, wall in times),
        spread=(min(totals), max(totals)),
        repeats=len(times),
        memory=peak_memory(),
        spent=processor_seconds() - first,
    )
