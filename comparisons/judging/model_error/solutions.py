"""Model variants solved level by level, each once, as tasks of the run."""

import math
from collections.abc import Iterable, Mapping

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
from comparisons.models.level import Level, Solution
from comparisons.models.model import Model
from comparisons.models.problem import COUPLED
from fem.solver.mumps import FemError
from meshes.block import MeshError

LEAST_LEVELS = 2  # of the effects
CLEAR = 2.0  # pitches that contact stays away from the end of the pressures
# What a task raises where a variant has no solution.
NO_SOLUTION = ContactError, MeshError, FemError, InputError, np.linalg.LinAlgError


class SolvedVariants:
    """Quantities of interest of model variants on the levels of a problem."""

    def __init__(self, scene: Solved, tasks: Tasks) -> None:
        """Those of a scene that is solved by the half-plane, perhaps by its own finite elements,
        too."""
        self.scene, self.problem, self.tasks = scene, scene.problem, tasks
        # by variant and number of the level from 1: by friction, or why there is no solution
        self.solved: dict[
            tuple[ModelVariant, int], dict[float, QuantitiesOfInterest] | NotComputedError
        ] = {}
        # by variant, seconds that it took and the largest memory of its process [bytes]
        self.took: dict[ModelVariant, tuple[float, int]] = {}
        # the seconds by the laws of cost [s], by variant and number of the level
        self.expected: dict[tuple[ModelVariant, int], float] = {}
        # the variants whose finest level is kept, with its fields; by these, the level by friction
        self.wholes: dict[ModelVariant, dict[float, Level]] = {}
        # of the half-plane's contact, by which the costs of variants are expected
        self._patches = scene.runs["half_plane"].levels[0].patches
        own = self.problem.scene
        self._own_effects = contained(own) if is_taken_apart(own) else None

    @property
    def of_scene(self) -> Solution:
        """The scene's own finite elements, of the first case."""
        return self.scene.runs["finite_element"]

    @property
    def failed(self) -> dict[tuple[ModelVariant, int], NotComputedError]:
        """Those that have no solution."""
        return {k: found for k, found in self.solved.items() if isinstance(found, NotComputedError)}

    def solution(
        self, variant: ModelVariant | None, number: int, friction: float
    ) -> QuantitiesOfInterest:
        """Of a variant on a level, None for the scene's own finite elements, solved where it is
        new; raises NotComputedError."""
        if variant is None or self._is_own(variant):
            case = self.scene.case(friction)
            return quantities_of(case.runs["finite_element"].levels[number - 1], case.problem)
        self.prepare([variant], number)
        found = self.solved[variant, number]
        if isinstance(found, NotComputedError):
            raise found
        return found[friction]

    def prepare(self, asked: Iterable[ModelVariant], number: int) -> None:
        """Solve the variants that are new on a level."""
        for variant, key in self.announce(asked, number).items():
            try:
                found = self._noted(variant, number, self.tasks.result(key))
            except NO_SOLUTION as error:
                found = NotComputedError(variant, str(error))
            self.solved[variant, number] = found

    def announce(
        self, asked: Iterable[ModelVariant], number: int, urgency: int = LATER
    ) -> dict[ModelVariant, str]:
        """Make those that are new on a level known to the tasks; the keys of these."""
        new = [variant for variant in dict.fromkeys(asked) if self.is_open(variant, number)]
        new.sort(key=lambda variant: not variant.effects & set(NONLINEAR))  # the dearest first
        keys, how = {}, (number, self._patches)
        for variant in new:
            self.expected.setdefault((variant, number), self.forecast(variant, number))
            model, problem = self._model(variant, number), problem_with(self.problem, variant)
            keys[variant] = model.announce(self.tasks, problem, *how, urgency)
        return keys

    def is_open(self, variant: ModelVariant, number: int) -> bool:
        """Whether a level of a variant is yet to be solved."""
        return not self._is_own(variant) and (variant, number) not in self.solved

    def expected_of(self, number: int, asked: Iterable[ModelVariant] | None = None) -> float:
        """Seconds that the variants of a level take by the laws of cost, or those asked for."""
        known = {variant: cost for (variant, n), cost in self.expected.items() if n == number}
        return math.fsum(known.get(variant, 0.0) for variant in (known if asked is None else asked))

    def forecast(self, variant: ModelVariant, number: int) -> float:
        """Seconds that a level of a variant takes by the laws of cost."""
        problem = problem_with(self.problem, variant)
        return self._model(variant, number).cost(problem, number, self._patches).seconds

    def keep(self, wholes: Iterable[ModelVariant]) -> None:
        """Take these for `wholes`, from their first level on."""
        self.wholes, failed = {variant: {} for variant in wholes}, self.failed
        again = [key for key in self.solved if key[0] in self.wholes and key not in failed]
        for key in again:
            del self.solved[key]

    def finest(self, variant: ModelVariant, friction: float) -> Level:
        """The finest level of one of the `wholes`."""
        if self._is_own(variant):
            return self.scene.case(friction).runs["finite_element"].finest
        return self.wholes[variant][friction]

    def _is_own(self, variant: ModelVariant) -> bool:
        effects, friction = self._own_effects, variant.friction
        if effects is not None and friction == 0.0:
            effects = effects - {COUPLED}
        is_there = friction in (None, *self.problem.scene.load.friction)
        return is_there and effects is not None and variant == ModelVariant(effects, friction)

    def _model(self, variant: ModelVariant, number: int) -> Model:
        """What solves the problem of a variant on a level."""
        whole = variant in self.wholes
        words = ", ".join(EFFECTS[name].label for name in sorted(variant.effects)) or "no effect"
        return Model(
            f"{'whole' if whole else 'part'}-{variant.name}",
            "finite elements",
            half_block=variant.half_block,
            times=variant.times,
            fields=whole and number >= LEAST_LEVELS,  # it may be the finest
            label=f"with {words}",
        )

    def _noted(
        self, variant: ModelVariant, number: int, levels: Mapping[float, Level]
    ) -> dict[float, QuantitiesOfInterest]:
        """The solution of a variant on a level, by friction, once what it took is noted; raises
        ContactError where it is none."""
        problem, clear = problem_with(self.problem, variant), CLEAR * self.problem.pitch_of(number)
        for level in levels.values():
            if not level.converged:
                raise ContactError(f"the contact did not converge on level {number}")
            start, stop = level.patches[0, 0], level.patches[-1, 1]
            if start < problem.extent[0] + clear or stop > problem.extent[1] - clear:
                raise ContactError("the contact reaches the end of the pressures")
        level = next(iter(levels.values()))
        before, memory = self.took.get(variant, (0.0, 0))
        spent = before + sum(level.seconds.values())
        self.took[variant] = spent, max(memory, level.peak_memory)
        if variant in self.wholes:
            self.wholes[variant] = dict(levels)
        self.expected[variant, number] = level.expected_seconds
        return {friction: quantities_of(level, problem) for friction, level in levels.items()}
