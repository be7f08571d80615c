"""Levels of the bodies that a budget takes apart, each solved once, on the cores that there are."""

import math
import multiprocessing
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field, replace
from functools import cache
from threading import Lock
from typing import TYPE_CHECKING

import numpy as np

from analytic.contact.problem import ContactError
from comparisons.assessment.effects.catalogue import contained, is_taken_apart
from comparisons.assessment.effects.quantities_of_interest import QuantitiesOfInterest, answer_of
from comparisons.assessment.effects.variants import Body, problem_with
from comparisons.common.cache import Cache
from comparisons.common.errors import InputError, one_line
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
    from comparisons.models.finite_element.bodies import BodyStore

CLEAR = 2.0  # pitches that contact stays away from the end of the pressures
WORTH_A_PROCESS = 10.0  # seconds of a level's bodies; a process takes two of them to begin
LARGEST = 3.0  # memory of a body over that of the scene's own: a disc and a rough boundary
# Share of the bodies' time that lies behind as each of three levels begins and ends: for what is
# told alone.
BEHIND = (0.0, 0.15, 0.4, 1.0)


class NotComputedError(Exception):
    """A body of the budget has no answer; the message says why."""

    def __init__(self, body: Body, why: str) -> None:
        super().__init__(body, why)
        self.body = body

    def __str__(self) -> str:
        return one_line(self.args[1])


@dataclass
class Bodies:
    """Answers of bodies on the levels of a problem; meshes and fields are not kept.

    own       the scene's own finite elements, already solved
    beside    calls of other processes, which may solve some
    answers   by body, number of the level from 1, and friction coefficient
    failed    why a body has none, by body and number of the level
    seconds   that the bodies took, of all processes together
    expected  the same by the laws of cost [s], by body and number of the level
    """

    problem: Problem
    window: Window | None
    own: ModelRun
    checkpoint: Cache
    callback: ProgressCallback
    beside: Sequence[Call] = ()
    answers: dict[tuple[Body, int, float], QuantitiesOfInterest] = field(default_factory=dict)
    failed: dict[tuple[Body, int], NotComputedError] = field(default_factory=dict)
    seconds: float = 0.0
    expected: dict[tuple[Body, int], float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._store: BodyStore | None = None
        self._lock = Lock()
        scene = self.problem.scene
        self._own_effects = contained(scene) if is_taken_apart(scene) else None

    def own_answer(self, number: int, friction: float) -> QuantitiesOfInterest:
        """Of the scene's own finite elements."""
        return answer_of(self.own.levels[number - 1], self.problem, friction)

    def answer(self, body: Body, number: int, friction: float) -> QuantitiesOfInterest:
        """Of a body on a level, solved where it is new; raises NotComputedError."""
        if self._is_own(body):
            return self.own_answer(number, friction)
        if self._is_new(body, number):
            self._solve_here(body, number, BEHIND[number - 1])
        if (body, number) in self.failed:
            raise self.failed[body, number]
        return self.answers[body, number, friction]

    def prepare(self, asked: Iterable[Body], number: int) -> None:
        """Have what bodies answer on a level at hand, solved side by side where that pays."""
        new = [body for body in asked if not self._is_own(body) and self._is_new(body, number)]
        new.sort(key=lambda body: "finite_strain" not in body.effects)  # the dearest first

        def here(body: Body) -> None:
            start, stop = BEHIND[number - 1 : number + 1]
            left = sum(self._is_new(each, number) for each in new)
            self._solve_here(body, number, stop - (stop - start) * left / len(new))

        def there(call: Call) -> Callable[[Body], None]:
            def work(body: Body) -> None:
                given = self.problem, self.window, body, number
                self._keep(body, number, lambda: call(_solved_there, *given))

            return work

        share_out(new, here, [there(call) for call in self._helpers(number, len(new))])

    def expected_of(self, number: int) -> float:
        """Seconds that the bodies of a level take by the laws of cost."""
        return math.fsum(cost for (_, level), cost in self.expected.items() if level == number)

    def _helpers(self, number: int, count: int) -> Sequence[Call]:
        """The processes that `count` bodies on a level are worth, and memory allows."""
        level = self.own.levels[number - 1]
        if count * level.expected_seconds < WORTH_A_PROCESS:
            return ()
        memory = min(self.problem.scene.budget.memory, machine_memory())
        processes = min(count, memory // (LARGEST * level.expected_memory))
        return self.beside[: max(0, int(processes) - 1)]

    def _is_new(self, body: Body, number: int) -> bool:
        solved = any((body, number, mu) in self.answers for mu in self.problem.scene.friction)
        return not solved and (body, number) not in self.failed

    def _is_own(self, body: Body) -> bool:
        plain = not (body.stand_in or body.held)
        frictions = self.problem.scene.friction
        shaped = body.friction is None or frictions == (body.friction,)
        return plain and shaped and body.effects == self._own_effects

    def _solve_here(self, body: Body, number: int, behind: float) -> None:
        from comparisons.models.finite_element.bodies import BodyStore

        words = ", ".join(sorted(body.effects)) or "no effect"
        self.callback(Step(f"error budget: finite elements with {words}, level {number}", behind))
        store = self._store = self._store or BodyStore()
        self._keep(body, number, lambda: _solved(self.problem, self.window, body, number, store))

    def _keep(self, body: Body, number: int, solve: Callable[[], Level]) -> None:
        """Note a body's answers on a level, or why it has none."""
        kept, problem = f"{body.name}-{number}", problem_with(self.problem, body)
        level = self.checkpoint.load(kept)
        if level is None:
            try:
                level = solve()
            except NotComputedError as error:
                self.failed[body, number] = error
                return
            self.checkpoint.save(kept, level)
        with self._lock:
            self.seconds += sum(level.seconds.values())
        self.expected[body, number] = level.expected_seconds
        for each in problem.scene.friction:
            self.answers[body, number, each] = answer_of(level, problem, each)


@contextmanager
def processes_beside() -> Iterator[Sequence[Call]]:
    """Calls of a process for each further core, each begun when it is first called; none in a
    process that is itself one of several."""
    alone = not is_several() and multiprocessing.parent_process() is None
    with ExitStack() as stack:
        cores = len(os.sched_getaffinity(0)) if alone else 1
        yield [stack.enter_context(fresh_process()) for _ in range(cores - 1)]


def _solved(
    problem: Problem, window: Window | None, body: Body, number: int, store: "BodyStore"
) -> Level:
    """A body on a level, without its mesh's field; raises NotComputedError."""
    from comparisons.models.finite_element.level import finite_element_level
    from comparisons.models.finite_element.mesh import Refinement

    problem = problem_with(problem, body)
    plan, pitch = make_plan(problem, MODELS), problem.pitches[0] / 2.0 ** (number - 1)
    try:
        level = finite_element_level(
            problem, plan, Refinement(pitch), window, Stages(), store=store
        )
    except (ContactError, MeshError, FemError, InputError, np.linalg.LinAlgError) as error:
        raise NotComputedError(body, str(error)) from error
    if not level.solution.converged:
        raise NotComputedError(body, f"the contact did not converge on level {number}")
    low, high = problem.extent
    if level.patches[0, 0] < low + CLEAR * pitch or level.patches[-1, 1] > high - CLEAR * pitch:
        raise NotComputedError(body, "the contact reaches the end of the pressures")
    return replace(level, mesh_field=None)


def _solved_there(problem: Problem, window: Window | None, body: Body, number: int) -> Level:
    """The same in a process of its own, which keeps what its bodies have in common."""
    return _solved(problem, window, body, number, _kept_store())


@cache
def _kept_store() -> "BodyStore":
    from comparisons.models.finite_element.bodies import BodyStore

    return BodyStore()
