"""Both models on ever finer levels, until every judged quantity is resolved or the budget spent.

In: a scene and its plan. Out: the levels of every model, and why there are no more."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from itertools import chain, count

import numpy as np

from comparisons.common.progress import machine_memory
from comparisons.common.tasks import AT_ONCE, FIRST, NEEDED, Tasks
from comparisons.figures.quantity import label
from comparisons.judging.comparison import discretisations
from comparisons.judging.model_error.refinement import LEAST_LEVELS
from comparisons.judging.study import Solved
from comparisons.models.level import (
    ExpectedCost,
    Level,
    Solution,
    flowing_contact,
    refuse_too_large,
)
from comparisons.models.model import Model, scene_model
from comparisons.models.plan import LONGER, with_one_more
from fem.solver.mumps import FemError

Levels = dict[float, Level]  # one model's on one pitch, by friction coefficient
SHARE_OF_TOLERANCE = 1.0 / 3.0  # discretisation uncertainty that ends the refinement
SHORT = 0.5  # seconds of a level that this process solves itself while others have begun
NO_HELP = 0.9  # of an uncertainty before the last level, if it is still larger than that


def announce(scene: Solved, tasks: Tasks, begin: Callable[[Solved], None]) -> None:
    """Make known to the tasks what a run begins with, as `refined` does; only the half-plane is
    solved, on the levels asked for."""
    _Levels(scene, tasks).begin(begin)


def refined(
    scene: Solved,
    tasks: Tasks,
    begin: Callable[[Solved], None] = lambda solved: None,
    is_known: Callable[[], None] = lambda: None,
) -> Solved:
    """The runs of the plan's models, and why their refinement stopped. Raises FemError where one of
    the least levels has no solution; a finer one that has none ends the refinement.

    The levels that the scene asks for are known to `tasks` from the start, further ones when they
    are found necessary.
    scene  nothing of it is solved yet
    begin  called with the half-plane on the levels asked for, while others are solved, and again
           once levels of both models leave a judged quantity unresolved
    is_known  called when all that is asked for is known to the tasks"""
    levels = _Levels(scene, tasks)
    levels.begin(begin)
    is_known()
    asked, unresolved_now, begun = len(scene.problem.pitches), {}, False
    for number in count(1):
        try:
            now = levels.solved(number, scene.plan.models)
        except FemError as error:
            if number <= LEAST_LEVELS:
                raise
            return levels.checked(now, _not_resolved(unresolved(now), f"level {number}: {error}"))
        if number >= asked:
            before, unresolved_now = unresolved_now, unresolved(now)
            if not unresolved_now:
                return levels.checked(now, "every judged quantity is resolved")
        why = levels.spent(now.runs)
        if why is None and unresolved_now and _stuck(before, unresolved_now):
            why = "refinement no longer lowers their uncertainty"
        if why is None and number == scene.problem.most_levels:
            why = f"{number} levels are the most"
        if why is not None:
            return levels.checked(now, _not_resolved(unresolved_now, why))
        if not begun and number > 1 and (unresolved_now or unresolved(now)):
            begun = True
            begin(now)


def _not_resolved(names: Iterable[str], why: str) -> str:
    open_now = ", ".join(map(label, names)) or "judged quantities"
    return f"{open_now} not resolved to a third of the tolerance: {why}"


class _Levels:
    """The levels of a plan's models, as tasks and solved."""

    def __init__(self, scene: Solved, tasks: Tasks) -> None:
        self.scene, self.problem, self.plan, self.tasks = scene, scene.problem, scene.plan, tasks
        names = scene.plan.models
        self.models = {name: scene_model(name, scene.problem) for name in names}
        elements = self.models.get("finite_element")
        self.checks: dict[str, list[Model]] = {}  # by the part of an uncertainty that they show
        if self.plan.domain_check:
            self.checks["domain"] = [replace(elements, half_block=True)]
        if self.plan.increments_check:
            self.checks["increments"] = [replace(elements, times=times) for times in LONGER]
        self.levels: dict[str, list[Levels]] = {name: [] for name in names}
        # the first finite elements with all of their fields: they may be the finest; of a rough
        # surface every level's are read
        self.shown = 1 if scene.problem.scene.profile else len(scene.problem.pitches)
        self.patches: np.ndarray | None = None  # of contact, by which costs are expected
        # [bytes] that the machine has to give at the start
        self.machine = machine_memory()
        # [s] of a half-plane's level that this process solves itself while others are at work
        self.short = SHORT if self.plan.compares else 0.0

    def begin(self, begin: Callable[[Solved], None]) -> None:
        """Make known the levels that the scene asks for; the half-plane's first tells what the
        others will take. With the half-plane on all of them call `begin`."""
        asked = range(1, len(self.problem.pitches) + 1)
        if "half_plane" in self.models:  # first, while nothing else is in memory
            for number in asked:
                cost, pitch = self.cost("half_plane", number), self.problem.pitch_of(number)
                refuse_too_large(self.problem, cost, "half-plane pressures", pitch)
                if number == 1 or cost.seconds >= self.short:  # others: beside finite elements
                    self.add(self.models["half_plane"], number)
            self.wait(1, ["half_plane"])
            first, *_ = self.levels["half_plane"][0].values()
            self.patches = first.patches
            if self.problem.scene.finite_element.plastic:
                self.patches = flowing_contact(self.problem)
        if "finite_element" in self.models:
            affordable = self.affordable(asked)
            self.shown = min(self.shown, max(affordable, default=1))
            for number in reversed(affordable):  # idle processes begin with the longest
                self.add(self.models["finite_element"], number)
            for model in chain.from_iterable(self.checks.values()):
                self.add(model)
        if "half_plane" in self.models:
            begin(self.solved(len(self.problem.pitches), ["half_plane"]))

    def cost(self, name: str, number: int) -> ExpectedCost:
        return self.models[name].cost(self.problem, number, self.patches)

    def add(self, model: Model, number: int = 1) -> str:
        """The key of a level's task."""
        is_half_plane, window = model.name == "half_plane", self.problem.window
        is_thinned = window is not None and not is_half_plane and number < self.shown
        model = replace(model, fields=window.norm_step if is_thinned else 1)
        # the finest level that is asked for lasts longest of all
        first = is_half_plane or number == len(self.problem.pitches)
        urgency = FIRST if first else NEEDED
        if is_half_plane and number == 1:  # for which the others wait
            urgency = AT_ONCE
        how = self.problem, number, self.patches, urgency
        return model.announce(self.tasks, *how, self.short if is_half_plane else 0.0)

    def wait(self, number: int, models: Iterable[str]) -> None:
        """Have the levels of the models up to a number."""
        missing = {
            (name, level): self.add(self.models[name], level)
            for name in models
            for level in range(len(self.levels[name]) + 1, number + 1)
        }
        for (name, _), key in missing.items():
            self.levels[name].append(self.tasks.result(key))

    def affordable(self, asked: Iterable[int]) -> list[int]:
        """Numbers of the finite elements' levels before the one that it may not come to."""
        time, budget, within = 0.0, self.problem.scene.budget, []
        for number in asked:
            cost = self.cost("finite_element", number)
            time += cost.seconds
            if time > self.problem.time or cost.memory > min(budget.memory, self.machine):
                break
            within.append(number)
        return within

    def solved(self, number: int, models: Iterable[str]) -> Solved:
        """The scene with so many levels of the models."""
        self.wait(number, models)
        cases = []
        for case in self.scene.cases:
            levels = {n: [of[case.friction] for of in self.levels[n][:number]] for n in models}
            runs = {name: Solution(name, tuple(of_model)) for name, of_model in levels.items()}
            cases.append(replace(case, runs=runs))
        return replace(self.scene, cases=tuple(cases))

    def checked(self, solved: Solved, why: str) -> Solved:
        """Add the far boundary at half the distance, longer increments, and why that is all."""
        elements = solved.runs.get("finite_element")
        if elements and len(elements.levels) < self.shown:  # than was to be expected
            self.shown = finest = len(elements.levels)
            in_full = self.tasks.result(self.add(self.models[elements.name], finest))
            self.levels[elements.name][finest - 1] = in_full
            solved = self.solved(finest, solved.runs)
        again: dict[str, list[Levels]] = {part: [] for part in self.checks}
        for part, model in ((part, model) for part, of in self.checks.items() for model in of):
            try:
                again[part].append(self.tasks.result(self.add(model)))
            except FemError:  # the longest increments Newton's method may not bear
                if model.times < max(LONGER):
                    raise
        cases = []
        for case in solved.cases:
            repeated = {p: tuple(of[case.friction] for of in every) for p, every in again.items()}
            if repeated:
                run = replace(case.runs["finite_element"], repeated=repeated)
                case = replace(case, runs={**case.runs, run.name: run})
            cases.append(case)
        return replace(solved, cases=tuple(cases), refinement=why)

    def spent(self, runs: Mapping[str, Solution]) -> str | None:
        """Why one more level of every model would exceed the budget, or the machine's memory, or
        None. Time is that of the laws by which levels are planned: by a clock, a busy machine would
        stop at other figures."""
        budget = self.problem.scene.budget
        time, memory = with_one_more(self.problem, runs)
        if time > self.problem.time:
            return f"a finer level would exceed {budget.time:g} s (budget.time)"
        if memory > budget.memory:
            return f"a finer level would exceed {budget.memory:g} bytes (budget.memory)"
        if memory > self.machine:
            return f"a finer level would take {memory:.2g} bytes, more than this machine has"
        return None


def unresolved(solved: Solved) -> dict[str, float]:
    """Judged quantities whose discretisation uncertainty is above its share of the tolerance, with
    the largest of any friction coefficient."""
    tolerance, largest = solved.problem.scene.tolerances, {}
    for case in solved.cases:
        for name, size in discretisations(case).items():
            if name in tolerance and size > SHARE_OF_TOLERANCE * tolerance[name]:
                largest[name] = max(size, largest.get(name, 0.0))
    return largest


def _stuck(before: dict[str, float], now: dict[str, float]) -> bool:
    """Whether the last level helped none of the open quantities."""
    return all(name in before and size >= NO_HELP * before[name] for name, size in now.items())
