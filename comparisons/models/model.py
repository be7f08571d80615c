"""A model: assumptions, and a way to solve a problem under them on one level, with its cost.

Analytic models are the half-plane and the effects that they have beside its assumptions; finite
elements have the effects that the scene gives them, or that the model sets in it. A level is solved
here alone, or as a task of a run, which keeps it by its key."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from comparisons.common.progress import Stages
from comparisons.common.tasks import NEEDED, Here, Tasks
from comparisons.models.analytic import analytic_level, expected_with
from comparisons.models.level import ExpectedCost, Level
from comparisons.models.problem import COUPLED, Problem

if TYPE_CHECKING:
    from comparisons.models.finite_element.mesh import Refinement


@dataclass(frozen=True)
class Model:
    """Model whose levels have numbers from 1, coarse to fine, and pitches by `Problem.pitch_of`."""

    name: str  # of its levels among the tasks of a run; of the scene's own, the source of figures
    solver: Literal["analytic", "finite elements"]
    # beside the half-plane's assumptions; of the scene's own finite elements they are the scene's
    effects: frozenset[str] = frozenset()
    half_block: bool = False  # the far boundary of an unbounded body is at half the distance
    times: int = 1  # as long increments of plastic flow
    # give all stresses on the mesh and on every so many-th x of the window; 0: the largest alone
    fields: int = 0
    label: str = ""  # of its stages
    # fields of the scene that it sets, and the least size [m] of an unbounded body; its name tells
    # such models apart
    sets: Mapping[str, object] = field(default_factory=dict, compare=False)
    least_block: float = field(default=0.0, compare=False)

    def posed(self, problem: Problem) -> Problem:
        """The problem that it solves, on the same pressure elements."""
        if not self.sets:
            return problem
        scene = problem.scene.unchecked(self.sets)
        return replace(problem, scene=scene, least_block=self.least_block)

    def cost(
        self, problem: Problem, number: int, patches: np.ndarray | None = None
    ) -> ExpectedCost:
        """Cost of a level by the laws of cost, before anything is meshed or solved: of finite
        elements in contact on `patches` (k, 2) [m], by default all over the stretch of
        pressures, which it never exceeds."""
        problem, pitch = self.posed(problem), problem.pitch_of(number)
        if self.solver == "analytic":
            cost = expected_with(problem, pitch)
        else:
            from comparisons.models.finite_element.mesh import expected

            there = np.array([problem.extent]) if patches is None else patches
            cost = expected(problem, self._refinement(pitch), there)
        contacts = len(problem.scene.load.friction) if self._is_moved(problem) else 1
        return replace(cost, seconds=contacts * cost.seconds)

    def solve(self, here: Here, problem: Problem, number: int) -> dict[float, Level]:
        """A level by friction coefficient, with the stresses that the scene asks for. Imports what
        it needs alone; raises ContactError, MeshError, FemError and SceneError."""
        words = ", ".join(filter(None, (self.label, *self._checks.values(), f"level {number}")))
        stages = Stages(lambda stage: here.callback(f"{stage}, {words}"))
        problem = self.posed(problem)
        contacts, levels, seconds = [problem], {}, 0.0
        if self._is_moved(problem):
            contacts = map(problem.under, problem.scene.load.friction)
        for contact in contacts:
            solved = self._solved(here, contact, problem.pitch_of(number), stages)
            seconds += next(iter(solved.values())).expected_seconds
            levels |= solved
        return {mu: replace(level, expected_seconds=seconds) for mu, level in levels.items()}

    def _is_moved(self, problem: Problem) -> bool:
        """Whether each friction coefficient has a contact of its own."""
        coupled = problem.scene.finite_element.coupled
        return COUPLED in self.effects if self.solver == "analytic" else coupled

    def _solved(
        self, here: Here, problem: Problem, pitch: float, stages: Stages
    ) -> dict[float, Level]:
        """Levels of the friction coefficients that share a contact."""
        if self.solver == "analytic":
            grid = problem.grid(pitch)
            return analytic_level(problem, self.effects, grid, stages, self.fields)
        from comparisons.models.finite_element.bodies import BodyCache
        from comparisons.models.finite_element.level import finite_element_level

        # bodies of one pitch are held: those of other levels are dropped
        how = self._refinement(pitch), stages, here.held("bodies", pitch, BodyCache)
        return finite_element_level(problem, *how, fields=self.fields)

    def announce(
        self,
        tasks: Tasks,
        problem: Problem,
        number: int,
        patches: np.ndarray | None = None,
        urgency: int = NEEDED,
        short: float = 0.0,
    ) -> str:
        """Make a level known to the tasks, which give it by the key that is returned. One that is
        expected to take less than `short` [s] is solved at once, in this process."""
        thinned = (f"every_{self.fields}",) if self.fields > 1 else ()
        key = "-".join((self.name, *self._checks, *thinned, str(number)))
        cost = self.cost(problem, number, patches)
        tasks.add(
            key,
            self.solve,
            *(problem, number),
            seconds=cost.seconds,
            memory=cost.memory,
            urgency=urgency,
            shares=None if self.solver == "analytic" else problem.pitch_of(number),
            by_itself=cost.seconds < short,
        )
        return key

    @property
    def _checks(self) -> dict[str, str]:
        """Checks on its levels, in words by parts of their keys."""
        checks = {}
        if self.half_block:
            checks["far_boundary_check"] = "far boundary at half the distance"
        if self.times > 1:
            checks[f"increments_{self.times}"] = f"increments of flow {self.times} times as long"
        return checks

    def _refinement(self, pitch: float) -> "Refinement":
        from comparisons.models.finite_element.mesh import Refinement
        from fem.nonlinear.press_plastic import TRAVEL

        return Refinement(pitch, self.half_block, self.times * TRAVEL)


def scene_model(name: str, problem: Problem, fields: int = 0) -> Model:
    """One of the scene's own MODELS."""
    if name == "half_plane":
        return Model(name, "analytic", problem.half_plane_effects, fields=fields)
    return Model(name, "finite elements", fields=fields)
