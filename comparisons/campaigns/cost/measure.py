"""Time and memory of one setting of one method, in a process of its own with one thread.

Seconds are processor time, gmsh's process included: on an idle machine the wall time, on a busy one
what the wall time would be if the machine were idle."""

import re
import statistics
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from comparisons.campaigns.cost.methods import METHODS, SolutionMethod
from comparisons.campaigns.cost.solve import SolvedContact, solved
from comparisons.common.errors import InputError
from comparisons.common.progress import Stages, peak_memory, processor_seconds
from comparisons.models.problem import Problem, problem_of
from comparisons.models.window import Window, window_of
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface

# Methods that this process has run. The first solution loads libraries, and does not count.
_begun: set[str] = set()


@dataclass(frozen=True)
class CostTask:
    """What to measure: as many `repeats` as `limit` seconds allow, at least one."""

    scene: Scene
    surface: SceneSurface
    load: float | None  # [N/m] of a prescribed approach, else None
    method: str
    setting: float
    repeats: int = 1
    limit: float = 0.0
    half_block: bool = False  # whether an unbounded body is held at half the distance

    @property
    def name(self) -> str:
        method = re.sub(r"\W+", "-", self.method)
        return f"{method}_{self.setting!r}{'_half_block' if self.half_block else ''}"


@dataclass(frozen=True)
class MeasuredRun:
    """Solution and cost of a setting: medians over the `repeats` that were counted."""

    solved: SolvedContact
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
    method = next(m for m in METHODS if m.name == task.method)
    first = processor_seconds()
    try:
        problem = problem_of(task.scene, task.surface, task.load)
        window = window_of(problem) if task.scene.stress is not None else None
        contact, seconds, wall = _timed(method, problem, task, window)
        runs = [(seconds, wall)] if task.method in _begun else []
        _begun.add(task.method)
        while not runs or (len(runs) < task.repeats and processor_seconds() - first < task.limit):
            contact, seconds, wall = _timed(method, problem, task, window)
            runs.append((seconds, wall))
    except InputError as error:  # of the budget, before anything was meshed
        raise RefusedError(str(error), skipped=True) from error
    except Exception as error:
        raise RefusedError(f"{type(error).__name__}: {error}", skipped=False) from error
    totals = [sum(seconds.values()) for seconds, _ in runs]
    return MeasuredRun(
        solved=contact,
        seconds={name: statistics.median(s[name] for s, _ in runs) for name in runs[0][0]},
        total=statistics.median(totals),
        wall=statistics.median(wall for _, wall in runs),
        spread=(min(totals), max(totals)),
        repeats=len(runs),
        memory=peak_memory(),
        spent=processor_seconds() - first,
    )


def _timed(
    method: SolutionMethod, problem: Problem, task: CostTask, window: Window | None
) -> tuple[SolvedContact, dict[str, float], float]:
    stages, begin = ProcessorStages(), time.perf_counter()
    contact = solved(method, problem, task.setting, window, stages, task.half_block)
    return contact, stages.seconds, time.perf_counter() - begin
