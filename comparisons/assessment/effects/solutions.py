"""Model variants solved level by level, each once, on all cores."""

import math
import multiprocessing
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field, replace
from functools import cache, partial
from threading import Lock
from typing import TYPE_CHECKING

import numpy as np

from analytic.contact.problem import ContactError
from comparisons.assessment.effects.catalogue import EFFECTS, contained, is_taken_apart
from comparisons.assessment.effects.contributions import NotComputedError
from comparisons.assessment.effects.quantities_of_interest import (
    QuantitiesOfInterest,
    quantities_of,
)
from comparisons.assessment.effects.variants import ModelVariant, problem_with
from comparisons.common.cache import Cache
from comparisons.common.errors import InputError
from comparisons.common.mpi import is_several
from comparisons.common.processes import Call, fresh_process, share_out
from comparisons.common.progress import ProgressCallback, Stages, Step, machine_memory
from comparisons.common.quantities import MODELS
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import make_plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from fem.solver.mumps import FemError
from meshes.block import MeshError

if TYPE_CHECKING:
    from comparisons.models.finite_element.bodies import BodyCache

CLEAR = 2.0  # pitches that contact stays away from the end of the pressures
WORTH_A_PROCESS = 10.0  # seconds of a level's variants; a process takes two of them to begin
LARGEST = 3.0  # memory of a variant over that of the scene's own: a finite roller, a rough boundary
# Share of the variants' time that lies behind as each of three levels begins and ends: for the
# progress bar alone.
BEHIND = (0.0, 0.15, 0.4, 1.0)


@dataclass
class SolvedVariants:
    """Quantities of interest of model variants on the levels of a problem.

    own       the scene's own finite elements, already solved
    cache     of levels
    beside    calls of other processes, which may solve some
    solved    by variant, number of the level from 1, and friction coefficient
    failed    why a variant has no solution, by variant and number of the level
    seconds   that the variants took, of all processes together
    expected  the same by the laws of cost [s], by variant and number of the level
    wholes    the variants whose finest level is kept, with its fields; by these, the level
    """

    problem: Problem
    window: Window | None
    own: ModelRun
    cache: Cache
    callback: ProgressCallback
    beside: Sequence[Call] = ()
    solved: dict[tuple[ModelVariant, int, float], QuantitiesOfInterest] = field(
        default_factory=dict
    )
    failed: dict[tuple[ModelVariant, int], NotComputedError] = field(default_factory=dict)
    seconds: float = 0.0
    expected: dict[tuple[ModelVariant, int], float] = field(default_factory=dict)
    wholes: dict[ModelVariant, Level | None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._body_cache: BodyCache | None = None
        self._lock = Lock()
        scene = self.problem.scene
        self._own_effects = contained(scene) if is_taken_apart(scene) else None

    def scene_solution(self, number: int, friction: float) -> QuantitiesOfInterest:
        """Of the scene's own finite elements."""
        return quantities_of(self.own.levels[number - 1], self.problem, friction)

    def solution(self, variant: ModelVariant, number: int, friction: float) -> QuantitiesOfInterest:
        """Of a variant on a level, solved where it is new; raises NotComputedError."""
        if self._is_own(variant):
            return self.scene_solution(number, friction)
        if self._is_new(variant, number):
            self._solve_here(variant, number, BEHIND[number - 1])
        if (variant, number) in self.failed:
            raise self.failed[variant, number]
        return self.solved[variant, number, friction]

    def prepare(self, asked: Iterable[ModelVariant], number: int) -> None:
        """Solve the variants that are new on a level, side by side where that pays."""
        new = [each for each in asked if self.is_open(each, number)]
        new.sort(key=lambda variant: "finite_strain" not in variant.effects)  # the dearest first

        def here(variant: ModelVariant) -> None:
            start, stop = BEHIND[number - 1 : number + 1]
            left = sum(self._is_new(each, number) for each in new)
            self._solve_here(variant, number, stop - (stop - start) * left / len(new))

        def there(call: Call, variant: ModelVariant) -> None:
            given = self.problem, self.window, variant, number, variant in self.wholes
            self._keep(variant, number, lambda: call(_solved_there, *given))

        share_out(new, here, [partial(there, call) for call in self._helpers(number, len(new))])

    def is_open(self, variant: ModelVariant, number: int) -> bool:
        """Whether a level of a variant is yet to be solved."""
        return not self._is_own(variant) and self._is_new(variant, number)

    def expected_of(self, number: int, asked: Iterable[ModelVariant] | None = None) -> float:
        """Seconds that the variants of a level take by the laws of cost, or those asked for."""
        known = {each: cost for (each, level), cost in self.expected.items() if level == number}
        return math.fsum(known.get(each, 0.0) for each in (known if asked is None else asked))

    def _helpers(self, number: int, count: int) -> Sequence[Call]:
        """The processes that `count` variants on a level are worth, and memory allows."""
        level = self.own.levels[number - 1]
        if count * level.expected_seconds < WORTH_A_PROCESS:
            return ()
        memory = min(self.problem.scene.budget.memory, machine_memory())
        processes = min(count, memory // (LARGEST * level.expected_memory))
        return self.beside[: max(0, int(processes) - 1)]

    def _is_new(self, variant: ModelVariant, number: int) -> bool:
        solved = any((variant, number, mu) in self.solved for mu in self.problem.scene.friction)
        return not solved and (variant, number) not in self.failed

    def _is_own(self, variant: ModelVariant) -> bool:
        frictions = self.problem.scene.friction
        shaped = variant.friction is None or frictions == (variant.friction,)
        return shaped and not variant.quadratic and variant.effects == self._own_effects

    def keep(self, wholes: Iterable[ModelVariant]) -> None:
        """Take these for `wholes`, from their first level on."""
        self.wholes = dict.fromkeys(wholes)
        self.solved = {key: each for key, each in self.solved.items() if key[0] not in self.wholes}

    def finest(self, variant: ModelVariant) -> Level:
        """The finest level of one of the `wholes`."""
        return self.own.finest if self._is_own(variant) else self.wholes[variant]

    def _solve_here(self, variant: ModelVariant, number: int, behind: float) -> None:
        from comparisons.models.finite_element.bodies import BodyCache

        words = ", ".join(EFFECTS[name].label for name in sorted(variant.effects)) or "no effect"
        self.callback(Step(f"error budget: finite elements with {words}, level {number}", behind))
        body_cache = self._body_cache = self._body_cache or BodyCache()
        given = self.problem, self.window, variant, number, variant in self.wholes
        self._keep(variant, number, lambda: _solved(*given, body_cache))

    def _keep(self, variant: ModelVariant, number: int, solve: Callable[[], Level]) -> None:
        """Note the solution of a variant on a level, or why it has none."""
        part = "whole" if variant in self.wholes else "part"
        kept, problem = f"{part}-{variant.name}-{number}", problem_with(self.problem, variant)
        level = self.cache.load(kept)
        if level is None:
            try:
                level = solve()
            except NotComputedError as error:
                self.failed[variant, number] = error
                return
            self.cache.save(kept, level)
        with self._lock:
            self.seconds += sum(level.seconds.values())
            if variant in self.wholes:
                self.wholes[variant] = level
        self.expected[variant, number] = level.expected_seconds
        for each in problem.scene.friction:
            self.solved[variant, number, each] = quantities_of(level, problem, each)


@contextmanager
def processes_beside() -> Iterator[Sequence[Call]]:
    """Calls of a process for each further core, each begun when it is first called; none in a
    process that is itself one of several."""
    alone = not is_several() and multiprocessing.parent_process() is None
    with ExitStack() as stack:
        cores = len(os.sched_getaffinity(0)) if alone else 1
        yield [stack.enter_context(fresh_process()) for _ in range(cores - 1)]


def _solved(
    problem: Problem,
    window: Window | None,
    variant: ModelVariant,
    number: int,
    fields: bool,
    body_cache: "BodyCache",
) -> Level:
    """A variant on a level, with its mesh's `fields` where asked; raises NotComputedError."""
    from comparisons.models.finite_element.level import finite_element_level
    from comparisons.models.finite_element.mesh import Refinement

    problem = problem_with(problem, variant)
    plan, pitch = make_plan(problem, MODELS), problem.pitches[0] / 2.0 ** (number - 1)
    wanted = problem, plan, Refinement(pitch), window, Stages()
    try:
        level = finite_element_level(*wanted, body_cache=body_cache)
    except (ContactError, MeshError, FemError, InputError, np.linalg.LinAlgError) as error:
        raise NotComputedError(variant, str(error)) from error
    if not level.solution.converged:
        raise NotComputedError(variant, f"the contact did not converge on level {number}")
    low, high = problem.extent
    if level.patches[0, 0] < low + CLEAR * pitch or level.patches[-1, 1] > high - CLEAR * pitch:
        raise NotComputedError(variant, "the contact reaches the end of the pressures")
    return level if fields else replace(level, mesh_field=None)


def _solved_there(
    problem: Problem, window: Window | None, variant: ModelVariant, number: int, fields: bool
) -> Level:
    """The same in another process, whose variants share meshes and factors."""
    return _solved(problem, window, variant, number, fields, _body_cache_of_process())


@cache
def _body_cache_of_process() -> "BodyCache":
    from comparisons.models.finite_element.bodies import BodyCache

    return BodyCache()
