"""Model variants solved level by level, each once, as tasks of the run."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from analytic.contact.problem import ContactError
from comparisons.common.errors import InputError
from comparisons.common.tasks import LATER, Tasks
from comparisons.judging.effects.catalogue import EFFECTS, NONLINEAR, contained, is_taken_apart
from comparisons.judging.effects.variants import ModelVariant, problem_with
from comparisons.judging.model_error.contributions import NotComputedError
from comparisons.judging.model_error.quantities_of_interest import (
    QuantitiesOfInterest,
    quantities_of,
)
from comparisons.judging.study import Solved
from comparisons.models.level import Level, ModelRun
from comparisons.models.model import Model
from comparisons.models.problem import COUPLED
from fem.solver.mumps import FemError
from meshes.block import MeshError

LEAST_LEVELS = 2  # of the effects
CLEAR = 2.0  # pitches that contact stays away from the end of the pressures
# What a task raises where a variant has no solution.
NO_SOLUTION = ContactError, MeshError, FemError, InputError, np.linalg.LinAlgError


@dataclass
class SolvedVariants:
    """Quantities of interest of model variants on the levels of a problem."""

    scene: Solved  # by the half-plane, perhaps by its own finite elements, too
    tasks: Tasks  # that solve the variants
    # by variant, number of the level from 1, and friction coefficient
    solved: dict[tuple[ModelVariant, int, float], QuantitiesOfInterest] = field(
        default_factory=dict
    )
    # why a variant has no solution, by variant and number of the level
    failed: dict[tuple[ModelVariant, int], NotComputedError] = field(default_factory=dict)
    # by variant, seconds that it took and the largest memory of its process [bytes]
    took: dict[ModelVariant, tuple[float, int]] = field(default_factory=dict)
    # the seconds by the laws of cost [s], by variant and number of the level
    expected: dict[tuple[ModelVariant, int], float] = field(default_factory=dict)
    # the variants whose finest level is kept, with its fields; by these, the level by friction
    wholes: dict[ModelVariant, dict[float, Level]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.problem = self.scene.problem
        # of the half-plane's contact, by which the costs of variants are expected
        self._patches = self.scene.runs["half_plane"].levels[0].patches
        scene = self.problem.scene
        self._own_effects = contained(scene) if is_taken_apart(scene) else None

    @property
    def of_scene(self) -> ModelRun:
        """The scene's own finite elements, of the first case."""
        return self.scene.runs["finite_element"]

    def solution(
        self, variant: ModelVariant | None, number: int, friction: float
    ) -> QuantitiesOfInterest:
        """Of a variant on a level, None for the scene's own finite elements, solved where it is
        new; raises NotComputedError."""
        if variant is None or self._is_own(variant):
            case = self.scene.case(friction)
            return quantities_of(case.runs["finite_element"].levels[number - 1], case.problem)
        self.prepare([variant], number)
        if (variant, number) in self.failed:
            raise self.failed[variant, number]
        return self.solved[variant, number, friction]

    def prepare(self, asked: Iterable[ModelVariant], number: int) -> None:
        """Solve the variants that are new on a level."""
        for variant, key in self.announce(asked, number):
            try:
                self._keep(variant, number, self.tasks.result(key))
            except NO_SOLUTION as error:
                self.failed[variant, number] = NotComputedError(variant, str(error))

    def announce(
        self, asked: Iterable[ModelVariant], number: int, urgency: int = LATER
    ) -> list[tuple[ModelVariant, str]]:
        """Make those that are new on a level known to the tasks; each with its task's key."""
        new = [variant for variant in dict.fromkeys(asked) if self.is_open(variant, number)]
        new.sort(key=lambda variant: not variant.effects & set(NONLINEAR))  # the dearest first
        keys = []
        for variant in new:
            self.expected.setdefault((variant, number), self.forecast(variant, number))
            problem, window = problem_with(self.problem, variant), self.scene.window
            how = self.tasks, problem, number, window, self._patches, urgency
            keys.append((variant, self._model(variant, number).announce(*how)))
        return keys

    def is_open(self, variant: ModelVariant, number: int) -> bool:
        """Whether a level of a variant is yet to be solved."""
        frictions = self.problem.scene.load.friction
        solved = any((variant, number, mu) in self.solved for mu in frictions)
        return not (self._is_own(variant) or solved or (variant, number) in self.failed)

    def expected_of(self, number: int, asked: Iterable[ModelVariant] | None = None) -> float:
        """Seconds that the variants of a level take by the laws of cost, or those asked for."""
        known = {
            variant: cost for (variant, level), cost in self.expected.items() if level == number
        }
        return math.fsum(known.get(variant, 0.0) for variant in (known if asked is None else asked))

    def forecast(self, variant: ModelVariant, number: int) -> float:
        """Seconds that a level of a variant takes by the laws of cost."""
        problem = problem_with(self.problem, variant)
        return self._model(variant, number).cost(problem, number, patches=self._patches).seconds

    def keep(self, wholes: Iterable[ModelVariant]) -> None:
        """Take these for `wholes`, from their first level on."""
        self.wholes = {variant: {} for variant in wholes}
        self.solved = {key: kept for key, kept in self.solved.items() if key[0] not in self.wholes}

    def finest(self, variant: ModelVariant, friction: float) -> Level:
        """The finest level of one of the `wholes`."""
        if self._is_own(variant):
            return self.scene.case(friction).runs["finite_element"].finest
        return self.wholes[variant][friction]

    def _is_own(self, variant: ModelVariant) -> bool:
        there, effects = self.problem.scene.load.friction, self._own_effects
        if effects is not None and variant.friction == 0.0:
            effects = effects - {COUPLED}
        shaped = variant.friction is None or variant.friction in there
        changed = variant.quadratic or variant.laws or variant.times > 1 or variant.half_block
        return shaped and not changed and variant.effects == effects

    def _model(self, variant: ModelVariant, number: int) -> Model:
        """What solves the problem of a variant on a level."""
        whole, name = variant in self.wholes, variant.name
        words = ", ".join(EFFECTS[one].label for one in sorted(variant.effects)) or "no effect"
        return Model(
            f"{'whole' if whole else 'part'}-{name}",
            "finite elements",
            half_block=variant.half_block,
            times=variant.times,
            fields=whole and number >= LEAST_LEVELS,  # it may be the finest
            label=f"with {words}",
        )

    def _keep(self, variant: ModelVariant, number: int, levels: Mapping[float, Level]) -> None:
        """Note the solution of a variant on a level, by friction; raises ContactError where it is
        none."""
        problem, clear = problem_with(self.problem, variant), CLEAR * self.problem.pitch_of(number)
        for level in levels.values():
            if not level.converged:
                raise ContactError(f"the contact did not converge on level {number}")
            start, stop = level.patches[0, 0], level.patches[-1, 1]
            if start < problem.extent[0] + clear or stop > problem.extent[1] - clear:
                raise ContactError("the contact reaches the end of the pressures")
        level = next(iter(levels.values()))
        seconds = sum(level.seconds.values())
        before, memory = self.took.get(variant, (0.0, 0))
        self.took[variant] = before + seconds, max(memory, level.peak_memory)
        if variant in self.wholes:
            self.wholes[variant] = dict(levels)
        self.expected[variant, number] = level.expected_seconds
        for friction, level in levels.items():
            self.solved[variant, number, friction] = quantities_of(level, problem)
