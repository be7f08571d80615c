"""Both models on ever finer levels, until every judged quantity is resolved or the budget spent."""

from collections.abc import Callable
from dataclasses import replace
from itertools import count

import numpy as np

from comparisons.common.cache import Cache
from comparisons.common.mpi import from_first
from comparisons.common.progress import Stages, no_progress
from comparisons.common.tasks import AT_ONCE, FIRST, NEEDED, Here, Tasks
from comparisons.models.forecast import expected_level
from comparisons.models.level import ExpectedCost, Level, ModelRun
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.contact import discretisations

SHARE_OF_TOLERANCE = 1.0 / 3.0  # discretisation uncertainty that ends the refinement
NO_HELP = 0.9  # of an uncertainty before the last level, if it is still larger than that
FAR_BOUNDARY_CHECK = "finite_element-far_boundary_check"
# the same with increments of plastic flow that are so many times as long
LONGER_INCREMENTS = {f"finite_element-increments_{times}": times for times in (4, 2)}


def refined(
    problem: Problem,
    plan: Plan,
    window: Window | None,
    cache: Cache,
    tasks: Tasks,
    after_half_plane: Callable[[ModelRun], Callable[[], None]] | None = None,
) -> tuple[dict[str, ModelRun], str]:
    """The runs of the plan's models, and why their refinement stopped.

    The levels that the scene asks for are known to `tasks` from the start, further ones when they
    are found necessary. Levels in the `cache` of a stopped run are not computed again; their
    expected time counts.
    after_half_plane  called with the half-plane on the levels asked for, while others are solved;
                      what it returns is called once levels leave a judged quantity unresolved"""
    levels: dict[str, list[Level]] = {name: [] for name in plan.models}
    patches, further = np.array([problem.extent]), None

    def expected(name: str, number: int) -> ExpectedCost:
        pitch = problem.pitches[0] / 2.0 ** (number - 1)
        return expected_level(name, problem, plan, pitch, patches)

    def add(name: str, number: int, key: str | None = None, times: float = 1.0) -> str:
        half_block = key == FAR_BOUNDARY_CHECK
        key = key or f"{name}-{number}"
        # the finest level that is asked for lasts longest of all
        is_first = name == "half_plane" or number == len(problem.pitches)
        cost, urgency = expected(name, number), FIRST if is_first else NEEDED
        if (name, number) == ("half_plane", 1):  # for which the others wait
            urgency = AT_ONCE
        given = cache, key, name, problem, plan, window, number, half_block, times
        size = {"seconds": cost.seconds, "memory": cost.memory}
        shares = None if name == "half_plane" else problem.pitches[0] / 2.0 ** (number - 1)
        tasks.add(key, _level, *given, **size, urgency=urgency, shares=shares)
        return key

    def checked(runs: dict[str, ModelRun]) -> dict[str, ModelRun]:
        """The runs with the far boundary at half the distance, and by longer increments."""
        again = {}
        if plan.domain_check:
            again["far_boundary_check"] = tasks.result(FAR_BOUNDARY_CHECK)
        if plan.increments_check:
            again["longer_increments"] = tuple(map(tasks.result, LONGER_INCREMENTS))
        if again:
            runs["finite_element"] = replace(runs["finite_element"], **again)
        return runs

    asked = range(1, len(problem.pitches) + 1)
    if "half_plane" in levels:  # first, while nothing else is in memory
        keys = [add("half_plane", number) for number in asked]
        levels["half_plane"].append(tasks.result(keys[0]))
        patches = levels["half_plane"][0].patches
    if "finite_element" in levels:
        time, budget, within = 0.0, problem.scene.budget, []
        for number in asked:
            cost = expected("finite_element", number)
            time += cost.seconds
            if time > budget.time or cost.memory > min(budget.memory, tasks.machine):
                break  # it may not come to that
            within.append(number)
        for number in reversed(within):  # idle processes begin with the longest
            add("finite_element", number)
        if plan.domain_check:
            add("finite_element", 1, FAR_BOUNDARY_CHECK)
        if plan.increments_check:
            for key, times in LONGER_INCREMENTS.items():
                add("finite_element", 1, key, times)
    if "half_plane" in levels:
        levels["half_plane"] += [tasks.result(key) for key in keys[1:]]
        if after_half_plane is not None:
            further = after_half_plane(ModelRun("half_plane", tuple(levels["half_plane"])))
    open_questions: dict[str, float] = {}
    for number in count(1):
        missing = [name for name, done in levels.items() if len(done) < number]
        for name, key in [(name, add(name, number)) for name in missing]:
            levels[name].append(tasks.result(key))
        runs = {name: ModelRun(name, tuple(done[:number])) for name, done in levels.items()}
        if number >= len(problem.pitches):
            before, open_questions = open_questions, unresolved(problem, runs, window)
            if not open_questions:
                return checked(runs), "every judged quantity is resolved"
        why = _spent(problem, plan, runs, tasks.machine)
        if why is None and open_questions and _stuck(before, open_questions):
            why = "refinement no longer lowers their uncertainty"
        if why is None and number == problem.scene.resolution.most:
            why = f"{number} levels are the most"
        if why is not None:
            names = ", ".join(open_questions) or "judged quantities"
            return checked(runs), f"{names} not resolved to a third of the tolerance: {why}"
        if further and number > 1 and (open_questions or unresolved(problem, runs, window)):
            further()
            further = None


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


def _spent(problem: Problem, plan: Plan, runs: dict[str, ModelRun], machine: float) -> str | None:
    """Why one more level of every model would exceed the budget, or the memory of the `machine`
    [bytes], or None. Time is that of the laws by which levels are planned: by a clock, a busy
    machine would stop at other figures."""
    budget = problem.scene.budget
    time = sum(level.expected_seconds for run in runs.values() for level in run.levels)
    memory = 0.0
    for name, run in runs.items():
        finest = run.finest
        finer = expected_level(name, problem, plan, 0.5 * finest.grid.pitch, finest.patches)
        time, memory = time + finer.seconds, max(memory, finer.memory)
    if time > budget.time:
        return f"a finer level would exceed {budget.time:g} s (budget.time)"
    if memory > budget.memory:
        return f"a finer level would exceed {budget.memory:g} bytes (budget.memory)"
    if memory > machine:
        return f"a finer level would take {memory:.2g} bytes, more than this machine has"
    return None


def _level(
    here: Here,
    cache: Cache,
    key: str,
    name: str,
    problem: Problem,
    plan: Plan,
    window: Window | None,
    number: int,
    half_block: bool,
    times: float,
) -> Level:
    """One level of one model, from the cache or into it; imports what this model needs alone."""
    found, pitch = cache.load(key), problem.pitches[0] / 2.0 ** (number - 1)
    if found is not None:
        return found
    if half_block:
        here.callback("finite elements: far boundary at half the distance")
        stages = Stages(no_progress)
    elif times != 1.0:
        here.callback(f"finite elements: increments of flow {times:g} times as long")
        stages = Stages(no_progress)
    else:
        stages = Stages(lambda stage: here.callback(f"{stage}, level {number}"))
    if name == "half_plane":
        from comparisons.models.half_plane import half_plane_level

        found = from_first(lambda: half_plane_level(problem, pitch, window, stages))
    else:
        from comparisons.models.finite_element.bodies import BodyCache
        from comparisons.models.finite_element.level import finite_element_level
        from comparisons.models.finite_element.mesh import Refinement
        from fem.nonlinear.press_plastic import TRAVEL

        refinement = Refinement(pitch, half_block, times * TRAVEL)
        bodies = here.held("bodies", pitch, BodyCache)
        given = problem, plan, refinement, window, stages
        alone = not half_block and times == 1.0
        how = {"check": alone, "fields": not half_block}
        found = finite_element_level(*given, body_cache=bodies, **how)
    cache.save(key, found)
    return found
