"""All methods at all their settings, each measured in a process of its own with one thread.

In: a problem, and a cache of what was measured before. Out: a row for every setting, its solution
and what it cost; what fails is a row as well. Seconds are processor time, gmsh's process included,
which is about the wall time of an idle machine. A setting that was measured is not measured again
unless scene, program, versions, machine or the number of repeats differ; the time it took counts as
before."""

import re
import statistics
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from comparisons.campaigns.cost.methods import (
    METHODS,
    SolutionMethod,
    Values,
    is_half_plane_problem,
    solved,
    why_not,
)
from comparisons.common.cache import Cache, kinds_of
from comparisons.common.errors import InputError
from comparisons.common.numbers import with_unit
from comparisons.common.processes import ProcessWorker
from comparisons.common.progress import (
    ProgressCallback,
    Stages,
    Step,
    peak_memory,
    processor_seconds,
    within,
)
from comparisons.common.provenance import LEVEL_CODE, key_of, machine, program_code, versions
from comparisons.common.tasks import ProcessEnded, Tasks, called
from comparisons.figures.figure import Figure
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.window import window_of
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import scene_key, surface_of

FOLDER = "cost_points"
# What shapes what is measured, beside versions of libraries and the machine.
CODE = (*LEVEL_CODE, *(f"comparisons/campaigns/cost/{n}.py" for n in ("measure", "methods")))
THREADS = 1  # of a measuring process
# Time of a setting over that of the one before.
GROWTH = {"half_plane": 2.5, "finite_element": 3.5}
# Shares of budget.time, in processor seconds, by which methods are done; later ones get the rest.
SHARES = (0.04, 0.06, 0.08, 0.2, 0.4, 0.55, 0.75, 0.9)
MOST_OF_REST = 0.25  # share of what is left of it beyond which a setting is not repeated
OK, FAILED, SKIPPED = "ok", "failed", "skipped"
NOT_CONVERGED = "did not converge"

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
    """A setting has no solution: its status, skipped as too large or failed, and why."""


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
        raise RefusedError(SKIPPED, str(error)) from error
    except Exception as error:
        raise RefusedError(FAILED, f"{type(error).__name__}: {error}") from error
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


@dataclass(frozen=True)
class CostRow:
    """A method at a setting."""

    method: SolutionMethod
    setting: float | None  # pitch [m] or tolerance; None: the method does not apply
    status: str  # ok | failed | skipped
    because: str | None = None  # why it is not ok
    measured: MeasuredRun | None = None
    # of a method's coarsest setting: with the far boundary at half its distance, where that counts
    far_boundary_check: MeasuredRun | None = None
    # relative, by quantity; once they are known, and without those that the row has none of
    errors: Mapping[str, Figure] = field(default_factory=dict)

    def seconds(self, stresses: bool) -> float:
        """Processor time of the contact alone, or with the stresses."""
        by_stage = self.measured.seconds.items()
        return sum(s for name, s in by_stage if stresses or name != "stresses")

    @property
    def label(self) -> str:
        return "–" if self.setting is None else with_unit(self.setting, "m", 3)

    def meets(self, quantities: Iterable[str]) -> bool | None:
        """Whether every error agrees with none within its tolerance; None where one is unknown."""
        errors = [self.errors.get(name) for name in quantities]
        return None if None in errors else all(error.verdict == "agree" for error in errors)


def measuring_machine() -> dict:
    return machine() | {"threads": THREADS}


def cost_cache(out: Path, scene: Scene, repeats: int, whole: bool = False) -> Cache:
    """What was measured of `scene`, by task's name; and the load [N/m] of a prescribed approach."""
    program = versions(), program_code(*CODE)
    key = key_of(scene_key(scene, surface_of(scene)), measuring_machine(), repeats, whole, *program)
    return Cache(out / FOLDER, key, kinds_of(MeasuredRun))


def measured_study(
    problem: Problem,
    repeats: int,
    cache: Cache,
    callback: ProgressCallback,
    methods: tuple[SolutionMethod, ...] = METHODS,
) -> list[CostRow]:
    """By method, from coarse to fine. What the cache does not have is measured, and saved there.
    Each method has a process of its own, so that memory is its own, on one thread."""
    spent, rows = 0.0, []
    shares = SHARES[-len(methods) :]
    for number, (share, method) in enumerate(zip(shares, methods, strict=True)):
        because = why_not(method, problem)
        if because is not None:
            rows.append(CostRow(method, None, SKIPPED, because))
            continue
        left = share * problem.scene.budget.time - spent
        with Tasks(ProcessWorker, 1, cache) as tasks:
            run = partial(_measured, tasks)
            part = within(callback, number / len(methods), (number + 1) / len(methods))
            series = _series(method, problem, repeats, left, run, part)
            if _wants_far_boundary_check(method, problem) and series[0].status == OK:
                task = CostTask(problem, method, series[0].setting, half_block=True)
                with suppress(RefusedError, ProcessEnded):
                    series[0] = replace(series[0], far_boundary_check=run(task))
        rows += series
        spent += sum(row.measured.spent for row in series if row.measured is not None)
    return rows


def _series(
    method: SolutionMethod,
    problem: Problem,
    repeats: int,
    left: float,
    run: Callable[[CostTask], MeasuredRun],
    callback: ProgressCallback,
) -> list[CostRow]:
    """The rows of a method, in the processor seconds that are `left` for it; `run` measures, or
    raises RefusedError or ProcessEnded."""
    rows, settings, ended, expected = [], method.settings(problem), None, 0.0
    for number, setting in enumerate(settings, start=1):
        name = f"{method.name}: {with_unit(setting, 'm', 3)} ({number} of {len(settings)})"
        callback(Step(name, (number - 1) / len(settings)))
        if ended or expected > left:
            because = ended or (
                f"{expected:.2g} s are more than is left of this method's part of "
                f"{problem.scene.budget.time:g} s (budget.time)"
            )
            rows.append(CostRow(method, setting, SKIPPED, because))
            continue
        limit = MOST_OF_REST * max(left, 0.0)
        try:
            measured = run(CostTask(problem, method, setting, repeats, limit))
        except RefusedError as refused:
            rows.append(CostRow(method, setting, *refused.args))
        except ProcessEnded:
            ended = "the process that measured had ended"
            rows.append(CostRow(method, setting, FAILED, "the process that measured it ended"))
        else:
            outcome = (OK, None) if measured.level.converged else (FAILED, NOT_CONVERGED)
            rows.append(CostRow(method, setting, *outcome, measured))
            left -= measured.spent
            expected = GROWTH[method.model] * measured.total
    return rows


def _measured(tasks: Tasks, task: CostTask) -> MeasuredRun:
    tasks.add(task.name, called, measure, task)
    return tasks.result(task.name)


def _wants_far_boundary_check(method: SolutionMethod, problem: Problem) -> bool:
    """Whether the finite elements are a reference, whose far boundary counts."""
    scene = problem.scene
    unbounded = scene.body.thickness is None or scene.body.width is None
    return method.model == "finite_element" and unbounded and not is_half_plane_problem(problem)
