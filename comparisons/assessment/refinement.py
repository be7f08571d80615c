"""Both models on ever finer levels, until every judged quantity is resolved or the budget spent."""

import math
from collections.abc import Callable
from functools import lru_cache
from itertools import count
from time import perf_counter
from typing import TYPE_CHECKING

from comparisons.assessment.comparison import discretisations
from comparisons.common.cache import Cache
from comparisons.common.mpi import from_first
from comparisons.common.progress import ProgressCallback, Stages, Step, machine_memory, no_progress
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window

if TYPE_CHECKING:
    from comparisons.models.finite_element.bodies import BodyCache
    from comparisons.models.level import ExpectedCost

SHARE_OF_TOLERANCE = 1.0 / 3.0  # discretisation uncertainty that ends the refinement
USUAL_GROWTH = 2.2  # of a level's time over the one before: for the progress bar alone
NO_HELP = 0.9  # of an uncertainty before the last level, if it is still larger than that
FAR_BOUNDARY_CHECK = "finite_element-far_boundary_check"


def refined(
    problem: Problem, plan: Plan, window: Window | None, cache: Cache, callback: ProgressCallback
) -> tuple[dict[str, ModelRun], str]:
    """The runs of the plan's models, and why their refinement stopped.

    Levels in the `cache` of a stopped run are not computed again; their expected time counts.
    """
    levels: dict[str, list[Level]] = {name: [] for name in plan.models}
    check: Level | None = None

    @lru_cache(maxsize=1)  # the latest pitch's alone, for the far-boundary check on it
    def bodies(pitch: float) -> "BodyCache":
        from comparisons.models.finite_element.bodies import BodyCache

        return BodyCache()

    def solved(
        name: str, name_in_cache: str, pitch: float, progress: ProgressCallback, **how: bool
    ) -> Level:
        level = cache.load(name_in_cache)
        if level is None:
            level = _solve(name, problem, plan, pitch, window, progress, bodies, **how)
            cache.save(name_in_cache, level)
        return level

    begin = perf_counter()

    def progress(number: int) -> ProgressCallback:
        spent = perf_counter() - begin
        behind = spent / (spent + _expected(levels, len(problem.pitches)))
        return _numbered(callback, number, behind)

    open_questions: dict[str, float] = {}
    if "half_plane" in levels:  # first, while nothing else is in memory
        for number, pitch in enumerate(problem.pitches, start=1):
            levels["half_plane"].append(
                solved("half_plane", f"half_plane-{number}", pitch, progress(number))
            )
    for number in count(1):
        pitch = problem.pitches[0] / 2.0 ** (number - 1)
        for name, done in levels.items():
            if len(done) < number:
                done.append(solved(name, f"{name}-{number}", pitch, progress(number)))
        if number == 1 and plan.domain_check:
            callback("finite elements: far boundary at half the distance")
            check = solved(
                "finite_element", FAR_BOUNDARY_CHECK, pitch, no_progress, half_block=True
            )
        runs = {
            name: ModelRun(name, tuple(done[:number]), check if name == "finite_element" else None)
            for name, done in levels.items()
        }
        if number >= len(problem.pitches):
            before, open_questions = open_questions, unresolved(problem, runs, window)
            if not open_questions:
                return runs, "every judged quantity is resolved"
        why = _spent(problem, plan, runs)
        if why is None and open_questions and _stuck(before, open_questions):
            why = "refinement no longer lowers their uncertainty"
        if why is None and number == problem.scene.resolution.most:
            why = f"{number} levels are the most"
        if why is not None:
            names = ", ".join(open_questions) or "judged quantities"
            return runs, f"{names} not resolved to a third of the tolerance: {why}"


def _expected(levels: dict[str, list[Level]], planned: int) -> float:
    """Seconds that the levels which are still to come may take; infinite before the first."""
    done = list(levels.values())[-1]  # the finite elements', which take the longest
    if not done:
        return math.inf
    last = sum(done[-1].seconds.values())
    return sum(last * USUAL_GROWTH**k for k in range(1, max(planned - len(done), 1) + 1))


def _numbered(callback: ProgressCallback, number: int, behind: float) -> ProgressCallback:
    """Adds to stages the number of their level, and to the first how much lies behind."""
    names = count()

    def numbered(stage: str) -> None:
        words = f"{stage}, level {number}"
        callback(words if next(names) else Step(words, behind))

    return numbered


def unresolved(
    problem: Problem, runs: dict[str, ModelRun], window: Window | None
) -> dict[str, float]:
    """Judged quantities whose discretisation uncertainty is above its share of the tolerance,
    with the largest of any friction coefficient."""
    tolerance = problem.scene.tolerance
    found: dict[str, float] = {}
    for friction in problem.scene.friction:
        for name, size in discretisations(runs, problem, friction, window).items():
            if name in tolerance and size > SHARE_OF_TOLERANCE * tolerance[name]:
                found[name] = max(size, found.get(name, 0.0))
    return found


def _stuck(before: dict[str, float], now: dict[str, float]) -> bool:
    """Whether the last level helped none of the open quantities."""
    return all(name in before and size >= NO_HELP * before[name] for name, size in now.items())


def _spent(problem: Problem, plan: Plan, runs: dict[str, ModelRun]) -> str | None:
    """Why one more level of every model would exceed the budget, or None.

    Time is that of the laws by which levels are planned: by a clock, a busy machine would stop at
    other figures.
    """
    budget = problem.scene.budget
    time = sum(level.expected_seconds for run in runs.values() for level in run.levels)
    memory = 0.0
    for name, run in runs.items():
        finer = _expected_of(name, problem, plan, run.finest)
        time, memory = time + finer.seconds, max(memory, finer.memory)
    if time > budget.time:
        return f"a finer level would exceed {budget.time:g} s (budget.time)"
    if memory > budget.memory:
        return f"a finer level would exceed {budget.memory:g} bytes (budget.memory)"
    if memory > from_first(machine_memory):
        return f"a finer level would take {memory:.2g} bytes, more than this machine has"
    return None


def _expected_of(name: str, problem: Problem, plan: Plan, finest: Level) -> "ExpectedCost":
    """What the level after the finest one of a model will take."""
    if name == "half_plane":
        from comparisons.models.half_plane import expected_of

        return expected_of(2 * finest.grid.count)
    from comparisons.models.finite_element.cost import expected
    from comparisons.models.finite_element.mesh import Refinement

    return expected(problem, plan, Refinement(0.5 * finest.grid.pitch), finest.patches)


def _solve(
    name: str,
    problem: Problem,
    plan: Plan,
    pitch: float,
    window: Window | None,
    callback: ProgressCallback,
    bodies: Callable[[float], "BodyCache"],
    half_block: bool = False,
) -> Level:
    """One level of one model; what the other model alone needs is not imported."""
    if name == "half_plane":
        from comparisons.models.half_plane import half_plane_level

        stages = Stages(callback)
        return from_first(lambda: half_plane_level(problem, pitch, window, stages))
    from comparisons.models.finite_element.level import finite_element_level
    from comparisons.models.finite_element.mesh import Refinement

    refinement, stages, body_cache = Refinement(pitch, half_block), Stages(callback), bodies(pitch)
    return finite_element_level(
        problem, plan, refinement, window, stages, body_cache=body_cache, check=not half_block
    )
