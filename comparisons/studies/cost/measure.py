"""Time and memory of one setting of one method, in a process of its own that has one thread.

Seconds are the processor's, gmsh's process included: on an idle machine they are those of the
clock, on a busy one they are what the clock would show if it were idle.
"""

import resource
import statistics
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from comparisons.common.errors import InputError
from comparisons.common.progress import Stages, peak_memory
from comparisons.models.problem import Problem, problem_of
from comparisons.models.window import Window, window_of
from comparisons.scenes.scene import ResolvedScene
from comparisons.studies.cost.methods import METHODS, Method
from comparisons.studies.cost.solve import Answer, solved

WARM = 1.0  # seconds: a first go that is shorter is repeated before any is counted

_begun: list[str] = []  # methods that this process has met: the first go loads what it takes


@dataclass(frozen=True)
class Task:
    """What to measure: as many `repeats` as `limit` seconds of the processor allow, at least one.

    load    [N/m] that a prescribed approach takes, else None
    half_block  whether an unbounded body is held at half the distance
    """

    scene: ResolvedScene
    load: float | None
    method: str
    setting: float
    repeats: int = 1
    limit: float = 0.0
    half_block: bool = False


@dataclass(frozen=True)
class Measured:
    """What a setting gave and took: medians over the `repeats` that were counted.

    seconds   of the processor by stage       total   of all stages
    wall      on the clock                    spread  smallest and largest total
    memory    largest of the process so far [bytes]; settings come from coarse to fine
    spent     seconds of the processor that measuring took, all goes together
    """

    answer: Answer
    seconds: dict[str, float]
    total: float
    wall: float
    spread: tuple[float, float]
    repeats: int
    memory: int
    spent: float


@dataclass(frozen=True)
class Refused:
    """Why a setting gave nothing: `skipped` as too large, or failed."""

    because: str
    skipped: bool


@dataclass
class ProcessorStages(Stages):
    """Seconds of the processor by stage, those of ended child processes included."""

    begun: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str, announce: str | None = None) -> Iterator[None]:
        begin = processor_seconds()
        try:
            yield
        finally:
            self.seconds[name] = self.seconds.get(name, 0.0) + processor_seconds() - begin


def processor_seconds() -> float:
    """Of this process and of its children that have ended."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def measure(task: Task) -> Measured | Refused:
    """Carry out a task in this process."""
    method = next(m for m in METHODS if m.name == task.method)
    first = processor_seconds()
    try:
        problem = problem_of(task.scene, task.load)
        window = window_of(problem) if task.scene.stress is not None else None
        answer, seconds, wall = _go(method, problem, task, window)
        runs = [(seconds, wall)]
        if task.method not in _begun or sum(seconds.values()) < WARM:
            runs = []
        _begun.append(task.method)
        while not runs or (len(runs) < task.repeats and processor_seconds() - first < task.limit):
            answer, seconds, wall = _go(method, problem, task, window)
            runs.append((seconds, wall))
    except InputError as error:  # of the budget, before anything was meshed
        return Refused(str(error), skipped=True)
    except Exception as error:
        return Refused(f"{type(error).__name__}: {error}", skipped=False)
    totals = [sum(seconds.values()) for seconds, _ in runs]
    names = list(runs[0][0])
    return Measured(
        answer=answer,
        seconds={name: statistics.median(s[name] for s, _ in runs) for name in names},
        total=statistics.median(totals),
        wall=statistics.median(wall for _, wall in runs),
        spread=(min(totals), max(totals)),
        repeats=len(runs),
        memory=peak_memory(),
        spent=processor_seconds() - first,
    )


def _go(
    method: Method, problem: Problem, task: Task, window: Window | None
) -> tuple[Answer, dict[str, float], float]:
    """One solution: its answer, seconds of the processor by stage, and seconds on the clock."""
    stages, begin = ProcessorStages(), time.perf_counter()
    answer = solved(method, problem, task.setting, window, stages, task.half_block)
    return answer, stages.seconds, time.perf_counter() - begin
