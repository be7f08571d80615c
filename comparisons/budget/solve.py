"""Levels of the bodies that a budget takes apart, each solved once."""

from dataclasses import dataclass, field, replace

import numpy as np

from analytic.contact import ContactError
from comparisons.budget.answers import Answer, answer_of
from comparisons.budget.bodies import Body, problem_with
from comparisons.budget.effects import contained, is_taken_apart
from comparisons.checkpoint import Checkpoint
from comparisons.errors import InputError, one_line
from comparisons.level import Level, ModelRun, Window
from comparisons.plan import MODELS, make_plan
from comparisons.problem import Problem
from comparisons.stages import Listener, Stages, Step
from fem.mumps import FemError
from meshes.errors import MeshError

CLEAR = 2.0  # pitches that contact stays away from the end of the pressures


class NotComputedError(Exception):
    """A body of the budget has no answer; the message says why."""

    def __init__(self, body: Body, why: str) -> None:
        super().__init__(one_line(why))
        self.body = body


@dataclass
class Bodies:
    """Answers of bodies on the levels of a problem; meshes and fields are not kept.

    own      the scene's own finite elements, already solved
    answers  by body, number of the level from 1, and friction coefficient
    seconds  that the bodies took
    expected by the laws of cost [s], by number of the level
    """

    problem: Problem
    window: Window | None
    own: ModelRun
    checkpoint: Checkpoint
    listener: Listener
    answers: dict[tuple[Body, int, float], Answer] = field(default_factory=dict)
    seconds: float = 0.0
    expected: dict[int, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._store = None  # of meshes and factors that bodies of one level have in common
        scene = self.problem.scene
        self._own_effects = contained(scene) if is_taken_apart(scene) else None

    def own_answer(self, number: int, friction: float) -> Answer:
        """Of the scene's own finite elements."""
        return answer_of(self.own.levels[number - 1], self.problem, friction)

    def answer(self, body: Body, number: int, friction: float) -> Answer:
        """Of a body on a level, solved where it is new; raises NotComputedError."""
        if self._is_own(body):
            return self.own_answer(number, friction)
        if (body, number, friction) not in self.answers:
            problem = problem_with(self.problem, body)
            level = self._level(body, problem, number)
            for each in problem.scene.friction:
                self.answers[body, number, each] = answer_of(level, problem, each)
        return self.answers[body, number, friction]

    def _level(self, body: Body, problem: Problem, number: int) -> Level:
        kept = f"{body.name}-{number}"
        level = self.checkpoint.load(kept)
        if level is None:
            level = replace(self._solved(body, problem, number), mesh_field=None)
            self.checkpoint.save(kept, level)
        self.seconds += sum(level.seconds.values())
        self.expected[number] = self.expected.get(number, 0.0) + level.expected_seconds
        return level

    def _is_own(self, body: Body) -> bool:
        plain = not (body.stand_in or body.held)
        frictions = self.problem.scene.friction
        shaped = body.friction is None or frictions == (body.friction,)
        return plain and shaped and body.effects == self._own_effects

    def _solved(self, body: Body, problem: Problem, number: int) -> Level:
        from comparisons.finite_element import finite_element_level
        from comparisons.finite_element_bodies import BodyStore
        from comparisons.finite_element_mesh import Refinement

        self._store = self._store or BodyStore()
        plan, pitch = make_plan(problem, MODELS), self.problem.pitches[0] / 2.0 ** (number - 1)
        words = ", ".join(sorted(body.effects)) or "no effect"
        said = f"error budget: finite elements with {words}, level {number}"
        self.listener(Step(said, 0.25 * (number - 1)))  # about: there are two to four levels
        try:
            level = finite_element_level(
                problem, plan, Refinement(pitch), self.window, Stages(), store=self._store
            )
        except (ContactError, MeshError, FemError, InputError, np.linalg.LinAlgError) as error:
            raise NotComputedError(body, str(error)) from error
        if not level.solution.converged:
            raise NotComputedError(body, f"the contact did not converge on level {number}")
        low, high = problem.extent
        if level.patches[0, 0] < low + CLEAR * pitch or level.patches[-1, 1] > high - CLEAR * pitch:
            raise NotComputedError(body, "the contact reaches the end of the pressures")
        return level
