"""Both models on ever finer levels, until every judged quantity is resolved or the budget spent."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial
from itertools import count

import numpy as np

from comparisons.common.mpi import from_first
from comparisons.common.progress import Stages, machine_memory, no_progress
from comparisons.common.tasks import AT_ONCE, FIRST, NEEDED, Here, Tasks
from comparisons.models.forecast import expected_level
from comparisons.models.level import ExpectedCost, Level, ModelRun
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.contact import discretisations

SHARE_OF_TOLERANCE = 1.0 / 3.0  # discretisation uncertainty that ends the refinement
NO_HELP = 0.9  # of an uncertainty before the last level, if it is still larger than that
LONGER = (4, 2)  # times as long increments of plastic flow, of its check

AfterHalfPlane = Callable[[ModelRun], Callable[[], None]]


def refined(
    problem: Problem,
    plan: Plan,
    window: Window | None,
    tasks: Tasks,
    after_half_plane: AfterHalfPlane | None = None,
) -> tuple[dict[str, ModelRun], str]:
    """The runs of the plan's models, and why their refinement stopped.

    The levels that the scene asks for are known to `tasks` from the start, further ones when they
    are found necessary.
    after_half_plane  called with the half-plane on the levels asked for, while others are solved;
                      what it returns is called once levels leave a judged quantity unresolved"""
    levels = _Levels(problem, plan, window, tasks)
    further = levels.begin(after_half_plane)
    asked, unresolved_now = len(problem.pitches), {}
    for number in count(1):
        levels.wait(number, plan.models)
        runs = levels.runs(number)
        if number >= asked:
            before, unresolved_now = unresolved_now, unresolved(problem, runs, window)
            if not unresolved_now:
                return levels.checked(runs), "every judged quantity is resolved"
        why = levels.spent(runs)
        if why is None and unresolved_now and _stuck(before, unresolved_now):
            why = "refinement no longer lowers their uncertainty"
        if why is None and number == problem.most_levels:
            why = f"{number} levels are the most"
        if why is not None:
            names = ", ".join(unresolved_now) or "judged quantities"
            return levels.checked(runs), f"{names} not resolved to a third of the tolerance: {why}"
        if further and number > 1 and (unresolved_now or unresolved(problem, runs, window)):
            further()
            further = None


@dataclass(frozen=True)
class _LevelTask:
    """One level of one model, or of finite elements a check: with the far boundary at half the
    distance, or with increments of plastic flow that are so many `times` as long."""

    problem: Problem
    plan: Plan
    window: Window | None
    name: str
    number: int  # from 1, coarse to fine
    half_block: bool = False
    times: int = 1

    @property
    def pitch(self) -> float:
        return self.problem.pitches[0] / 2.0 ** (self.number - 1)

    @property
    def key(self) -> str:
        if self.half_block:
            return f"{self.name}-far_boundary_check"
        return f"{self.name}-{self.number if self.times == 1 else f'increments_{self.times}'}"

    @property
    def urgency(self) -> int:
        if (self.name, self.number) == ("half_plane", 1):  # for which the others wait
            return AT_ONCE
        # the finest level that is asked for lasts longest of all
        first = self.name == "half_plane" or self.number == len(self.problem.pitches)
        return FIRST if first else NEEDED

    def expected(self, patches: np.ndarray) -> ExpectedCost:
        return expected_level(self.name, self.problem, self.plan, self.pitch, patches)

    def solve(self, here: Here) -> Level:
        """Imports what this model needs alone."""
        stages = Stages(lambda stage: here.callback(f"{stage}, level {self.number}"))
        if self.name == "half_plane":
            from comparisons.models.half_plane import half_plane_level

            return from_first(
                lambda: half_plane_level(self.problem, self.pitch, self.window, stages)
            )
        from comparisons.models.finite_element.bodies import BodyCache
        from comparisons.models.finite_element.level import finite_element_level
        from comparisons.models.finite_element.mesh import Refinement
        from fem.nonlinear.press_plastic import TRAVEL

        if self.half_block:
            here.callback("finite elements: far boundary at half the distance")
            stages = Stages(no_progress)
        elif self.times > 1:
            here.callback(f"finite elements: increments of flow {self.times} times as long")
            stages = Stages(no_progress)
        return finite_element_level(
            self.problem,
            self.plan,
            Refinement(self.pitch, self.half_block, self.times * TRAVEL),
            self.window,
            stages,
            check=not self.half_block and self.times == 1,
            body_cache=here.held("bodies", self.pitch, BodyCache),
            fields=not self.half_block,
        )


class _Levels:
    """The levels of a plan's models, as tasks and solved."""

    def __init__(self, problem: Problem, plan: Plan, window: Window | None, tasks: Tasks) -> None:
        self.problem, self.plan, self.tasks = problem, plan, tasks
        self.task = partial(_LevelTask, problem, plan, window)
        check = partial(self.task, "finite_element", 1)
        self.checks = [check(half_block=True)] if plan.domain_check else []
        self.checks += [check(times=times) for times in LONGER] if plan.increments_check else []
        self.solved: dict[str, list[Level]] = {name: [] for name in plan.models}
        self.patches = np.array([problem.extent])  # of contact, by which costs are expected
        # [bytes] that the machine has to give at the start
        self.machine = from_first(machine_memory)

    def begin(self, after_half_plane: AfterHalfPlane | None) -> Callable[[], None] | None:
        """Make known the levels that the scene asks for, wait for the half-plane's, and return what
        `after_half_plane` does."""
        asked = range(1, len(self.problem.pitches) + 1)
        if "half_plane" in self.solved:  # first, while nothing else is in memory
            for number in asked:
                self.add(self.task("half_plane", number))
            self.wait(1, ["half_plane"])
            self.patches = self.solved["half_plane"][0].patches
        if "finite_element" in self.solved:
            for number in reversed(self.affordable(asked)):  # idle processes begin with the longest
                self.add(self.task("finite_element", number))
            for task in self.checks:
                self.add(task)
        if "half_plane" not in self.solved:
            return None
        for number in asked:
            self.wait(number, ["half_plane"])
        run = ModelRun("half_plane", tuple(self.solved["half_plane"]))
        return after_half_plane and after_half_plane(run)

    def add(self, task: _LevelTask) -> None:
        cost = task.expected(self.patches)
        size = {"seconds": cost.seconds, "memory": cost.memory}
        shares = None if task.name == "half_plane" else task.pitch
        self.tasks.add(task.key, task.solve, **size, urgency=task.urgency, shares=shares)

    def wait(self, number: int, names: Iterable[str]) -> None:
        """Have a level of the models, and so all coarser ones."""
        missing = [self.task(n, number) for n in names if len(self.solved[n]) < number]
        for task in missing:
            self.add(task)
        for task in missing:
            self.solved[task.name].append(self.tasks.result(task.key))

    def affordable(self, asked: Iterable[int]) -> list[int]:
        """Numbers of the finite elements' levels before the one that it may not come to."""
        time, budget, within = 0.0, self.problem.scene.budget, []
        for number in asked:
            cost = self.task("finite_element", number).expected(self.patches)
            time += cost.seconds
            if time > self.problem.time or cost.memory > min(budget.memory, self.machine):
                break
            within.append(number)
        return within

    def runs(self, number: int) -> dict[str, ModelRun]:
        """The models on so many levels."""
        return {name: ModelRun(name, tuple(done[:number])) for name, done in self.solved.items()}

    def checked(self, runs: dict[str, ModelRun]) -> dict[str, ModelRun]:
        """The runs with the far boundary at half the distance, and by longer increments."""
        again = [self.tasks.result(task.key) for task in self.checks]
        if self.plan.domain_check:
            far = again.pop(0)
            runs["finite_element"] = replace(runs["finite_element"], far_boundary_check=far)
        if again:
            runs["finite_element"] = replace(runs["finite_element"], longer_increments=tuple(again))
        return runs

    def spent(self, runs: dict[str, ModelRun]) -> str | None:
        """Why one more level of every model would exceed the budget, or the machine's memory, or
        None. Time is that of the laws by which levels are planned: by a clock, a busy machine would
        stop at other figures."""
        budget = self.problem.scene.budget
        time = sum(level.expected_seconds for run in runs.values() for level in run.levels)
        memory = 0.0
        for name, run in runs.items():
            pitch, patches = 0.5 * run.finest.grid.pitch, run.finest.patches
            finer = expected_level(name, self.problem, self.plan, pitch, patches)
            time, memory = time + finer.seconds, max(memory, finer.memory)
        if time > self.problem.time:
            return f"a finer level would exceed {budget.time:g} s (budget.time)"
        if memory > budget.memory:
            return f"a finer level would exceed {budget.memory:g} bytes (budget.memory)"
        if memory > self.machine:
            return f"a finer level would take {memory:.2g} bytes, more than this machine has"
        return None


def unresolved(
    problem: Problem, runs: dict[str, ModelRun], window: Window | None
) -> dict[str, float]:
    """Judged quantities whose discretisation uncertainty is above its share of the tolerance,
    with the largest of any friction coefficient."""
    tolerance = problem.scene.tolerances
    sizes: dict[str, float] = {}
    for friction in problem.scene.load.friction:
        for name, size in discretisations(runs, problem, friction, window).items():
            if name in tolerance and size > SHARE_OF_TOLERANCE * tolerance[name]:
                sizes[name] = max(size, sizes.get(name, 0.0))
    return sizes


def _stuck(before: dict[str, float], now: dict[str, float]) -> bool:
    """Whether the last level helped none of the open quantities."""
    return all(name in before and size >= NO_HELP * before[name] for name, size in now.items())
