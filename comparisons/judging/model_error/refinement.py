"""The effects of the model error level by level: model variants, each solved once on a level as a
task of the run, until they add little to what is stated, or what a further level could change is no
verdict."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from analytic.contact.problem import ContactError
from comparisons.common.errors import InputError
from comparisons.common.tasks import LAST, LATER, Tasks
from comparisons.figures.figure import Figure, Figures
from comparisons.judging.effects.catalogue import (
    LAW,
    NONLINEAR,
    contained,
    is_taken_apart,
    model_with,
)
from comparisons.judging.effects.selection import ASKED, EffectSelection
from comparisons.judging.model_error.model_error import Solutions, figure_of, split_variants
from comparisons.judging.rule import QuantitiesOfInterest, quantities_of
from comparisons.judging.study import Case, Solved
from comparisons.models.level import Level
from comparisons.models.model import Model
from comparisons.models.problem import COUPLED, Problem
from fem.solver.mumps import FemError
from meshes.block import MeshError

LEAST_LEVELS, MOST_LEVELS = 2, 3  # of the effects
SHARE_OF_TOLERANCE = 1.0 / 3.0  # that the effects may add to the uncertainty of a figure
GROWTH_OF_TIME = 3.2  # from one level to the next, at most
CLEAR = 2.0  # pitches that contact stays away from the end of the pressures
# What a task raises where a variant has no solution.
NO_SOLUTION = ContactError, MeshError, FemError, InputError, np.linalg.LinAlgError


class NotComputedError(Exception):
    """A model variant has no solution; the message says why."""


@dataclass(frozen=True)
class ErrorBudget:
    """Differences between the half-plane, the whole model and the surface."""

    selection: EffectSelection  # which effects were computed
    levels: int  # that the whole model was taken to; 0 where it has no solution
    unsplit: str | None  # why the difference of the models could not be split, else None
    # of each quantity at each friction coefficient, without what is not modelled
    model_errors: tuple[Figure, ...]
    # of each case, the finite elements with every effect that matters, on the finest level of the
    # effects, with their fields
    wholes: tuple[Level, ...] = ()
    # which further level of the whole model cannot change a verdict, else None
    left_out: str | None = None
    # of each case, what else is compared with the whole model; empty where it has no solution
    solutions: tuple[Solutions, ...] = ()
    # by variant: seconds, and the largest memory [bytes]
    took: dict[Model, tuple[float, int]] = field(default_factory=dict)

    @property
    def seconds(self) -> float:
        """Seconds that the effects took."""
        return math.fsum(seconds for seconds, _ in self.took.values())

    def figures(self, tolerance: Mapping[str, float]) -> Figures:
        """Every model error with all that is not known of it, judged where it has a tolerance."""
        return Figures(figure_of(error, self.selection, tolerance) for error in self.model_errors)


class EffectRefinement:
    """Quantities of interest of the model variants that a selection of effects takes, level by
    level. The split stays on the least levels, unless the whole model and the scene's own finite
    elements are all that it takes."""

    def __init__(
        self, scene: Solved, tasks: Tasks, selection: EffectSelection, rows: Iterable[Figure] = ()
    ) -> None:
        """Begin with a scene that the half-plane solves, perhaps its own finite elements, too;
        `rows` are the judged comparison of both."""
        self.scene, self.problem, self.tasks, self.rows = scene, scene.problem, tasks, tuple(rows)
        # by variant and number of the level from 1: by friction; why there is no solution
        self.solved: dict[tuple[Model, int], dict[float, QuantitiesOfInterest]] = {}
        self.failed: dict[tuple[Model, int], str] = {}
        # by variant, seconds that it took and the largest memory of its process [bytes]
        self.took: dict[Model, tuple[float, int]] = {}
        # seconds by the laws of cost, by variant and number of the level
        self.expected: dict[tuple[Model, int], float] = {}
        # of the half-plane's contact, by which costs are expected
        self._patches = scene.runs["half_plane"].levels[0].patches
        self.own = own_variants(self.problem)
        self.select(selection)

    def select(self, selection: EffectSelection) -> None:
        """Go on with another selection. What is solved stays, but for levels of its wholes, whose
        fields are wanted."""
        self.selection, cases = selection, self.scene.cases
        self.splits = [split_variants(self.problem, selection, case.friction) for case in cases]
        self.every = dict.fromkeys(variant for split in self.splits for variant in split.all)
        self.wholes = dict.fromkeys(variant for split in self.splits for variant in split.wholes)
        # by friction, the finest level of those with every effect
        self.finest: dict[Model, dict[float, Level]] = {s.whole: {} for s in self.splits}
        for key in [key for key in self.solved if key[0] in self.finest]:
            del self.solved[key]

    @property
    def most_levels(self) -> int:
        """Levels for the effects at most: no more than those of the scene's own models."""
        most = None if self.problem.levels is None else self.problem.levels.effects
        own = len(self.scene.runs["half_plane"].levels)
        return min(MOST_LEVELS, most or MOST_LEVELS, own)

    def announce_all(
        self, splitting: int, levels: int = LEAST_LEVELS, further: int = LATER
    ) -> None:
        """Make the variants known to the tasks: on so many levels whole models, which others need,
        on the least ones and as urgent as `splitting` what splits them, too."""
        for split in self.splits:
            self.announce(split.checks, 1, splitting)
        for number in range(1, levels + 1):
            is_further = number > LEAST_LEVELS
            self.announce(self.wholes, number, further if is_further else LATER)
            self.announce(() if is_further else self.every, number, splitting)

    def announce(
        self, asked: Iterable[Model], number: int, urgency: int = LATER
    ) -> dict[Model, str]:
        """Make those that are new on a level known to the tasks; the keys of these."""
        new = [variant for variant in dict.fromkeys(asked) if self.is_open(variant, number)]
        new.sort(key=lambda variant: not variant.effects & NONLINEAR)  # the dearest first
        keys, how = {}, (number, self._patches)
        for variant in new:
            self.expected.setdefault((variant, number), self.forecast(variant, number))
            model = self._model(variant, number)
            keys[variant] = model.announce(self.tasks, self.problem, *how, urgency)
        return keys

    def prepare(self, asked: Iterable[Model], number: int) -> None:
        """Solve the variants that are new on a level."""
        for variant, key in self.announce(asked, number).items():
            try:
                levels = self.tasks.result(key)
                self.solved[variant, number] = self._noted(variant, number, levels)
            except NO_SOLUTION as error:
                self.failed[variant, number] = " ".join(str(error).split())

    def is_open(self, variant: Model, number: int) -> bool:
        """True if a level of a variant is yet to be solved."""
        key = variant, number
        return variant not in self.own and key not in self.solved and key not in self.failed

    def solution(self, variant: Model | None, number: int, case: Case) -> QuantitiesOfInterest:
        """Figures of a solved variant on a level, None for the scene's own finite elements."""
        if variant is None or variant in self.own:
            return quantities_of(case.runs["finite_element"].levels[number - 1], case.problem)
        return self.solved[variant, number][case.friction]

    def forecast(self, variant: Model, number: int) -> float:
        """Seconds that a level of a variant takes by the laws of cost."""
        return variant.cost(self.problem, number, self._patches).seconds

    def spent(self, below: float = math.inf) -> float:
        """Seconds, by the laws of cost, of the levels of the scene's finite elements and of all
        variants, of these `below` a number."""
        spent = [cost for (_, number), cost in self.expected.items() if number < below]
        own = (level.expected_seconds for level in self.scene.runs["finite_element"].levels)
        return math.fsum([*spent, *own])

    def finer(self, number: int) -> float:
        """Seconds that the level of the whole models after this one takes at most."""
        known = (self.expected.get((variant, number), 0.0) for variant in self.wholes)
        return GROWTH_OF_TIME * math.fsum(known)

    def budget(self, most: int = MOST_LEVELS) -> ErrorBudget:
        """The model errors by so many levels at most; wholes are solved before what splits them.
        Raises NotComputedError where a whole has no solution on the least levels."""
        self.announce_all(LAST)
        levels, left_out = self._solve_wholes(min(most, self.most_levels))
        for number in range(1, min(levels, LEAST_LEVELS) + 1):
            self.prepare(self.every, number)
        solutions = self._solutions(levels)
        return ErrorBudget(
            selection=self.selection,
            levels=levels,
            unsplit=next((one.unsplit for one in solutions if one.unsplit), None),
            model_errors=tuple(self._errors(solutions)),
            wholes=tuple(self._finest(one) for one in solutions),
            left_out=left_out,
            solutions=tuple(solutions),
        )

    def _solve_wholes(self, most: int) -> tuple[int, str | None]:
        """Solve as many levels of the whole models as it takes: how many, and which further one is
        left out, as it cannot change a verdict."""
        for number in range(1, min(most, LEAST_LEVELS) + 1):
            self._solve_whole(number)
        if most >= LEAST_LEVELS:
            self._solve_checks()
        for number in range(LEAST_LEVELS + 1, most + 1):
            errors = self._errors(self._solutions(number - 1))
            if _settled(self.rows, errors):
                return number - 1, None
            if self.problem.scene.budget.effects != "all" and self._are_fixed(errors):
                further = f"level {number} of the whole model"
                return number - 1, f"{further}: cannot change a verdict ({ASKED})"
            # by the laws of cost: clocks would give another machine other figures
            if self.spent(number) + self.finer(number - 1) > self.problem.time:
                return number - 1, None
            try:
                self._solve_whole(number)
            except NotComputedError:
                return number - 1, None
        return most, None

    def _solve_whole(self, number: int) -> None:
        self.prepare(self.wholes, number)
        for variant in self.wholes:
            if (why := self.failed.get((variant, number))) is not None:
                raise NotComputedError(why)

    def _solve_checks(self) -> None:
        """Solve the coarsest level; where one of the laws has no solution, none is taken."""
        for split in self.splits:
            self.prepare(split.checks, 1)
        laws = [law for split in self.splits for law in split.laws.items()]
        whys = [f"as {probe}: {why}" for (_, probe), v in laws if (why := self.failed.get((v, 1)))]
        if whys and self.selection.laws:
            self.selection = self.selection.without(frozenset({LAW}), whys[0])

    def _solutions(self, levels: int) -> list[Solutions]:
        """Solutions of each case so far, on so many levels. The split is on those on which no
        variant is open."""
        taken = []
        for case, split in zip(self.scene.cases, self.splits, strict=True):
            history, unsplit, levels_split = [], None, 0
            for number in range(1, levels + 1):
                tried = [v for v in (*split.all, *split.checks) if not self.is_open(v, number)]
                found = [v for v in tried if (v, number) not in self.failed]
                history.append(
                    {v: self.solution(v, number, case) for v in (split.of_scene, *found)}
                )
                if levels_split == number - 1 and set(split.all) <= set(tried):
                    levels_split = number
                    if split.nothing not in found:
                        unsplit = unsplit or self.failed[split.nothing, number]
            how = {"levels_split": 0 if unsplit else levels_split, "unsplit": unsplit}
            taken.append(Solutions(case, split, self.selection.laws, tuple(history), **how))
        return taken

    def _finest(self, one: Solutions) -> Level:
        """Finest level of a case's whole model."""
        if one.split.whole in self.own:
            return one.case.runs["finite_element"].finest
        return self.finest[one.split.whole][one.case.friction]

    def _errors(self, solutions: list[Solutions]) -> list[Figure]:
        known = [(one, row) for one in solutions for row in self.rows]
        return [one.error(row) for one, row in known if row.friction == one.case.friction]

    def _are_fixed(self, errors: list[Figure]) -> bool:
        """True if a finer solution leaves every verdict as it is."""
        known = self.selection, self.problem.scene.tolerances
        figures = (figure_of(error, *known) for error in errors)
        return all(figure.is_fixed for figure in figures if figure.bounds)

    def _model(self, variant: Model, number: int) -> Model:
        """Model for a level of a variant; a whole has its fields: the level may be the finest."""
        if variant not in self.finest:
            return replace(variant, name=f"part-{variant.name}")
        return replace(variant, name=f"whole-{variant.name}", fields=number >= LEAST_LEVELS)

    def _noted(
        self, variant: Model, number: int, levels: Mapping[float, Level]
    ) -> dict[float, QuantitiesOfInterest]:
        """The solution of a variant on a level, by friction, once what it took is noted; raises
        ContactError where it is none."""
        problem, clear = variant.posed(self.problem), CLEAR * self.problem.pitch_of(number)
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
        if variant in self.finest:
            self.finest[variant] = dict(levels)
        self.expected[variant, number] = level.expected_seconds
        return {friction: quantities_of(level, problem) for friction, level in levels.items()}


def own_variants(problem: Problem) -> set[Model]:
    """Models that the scene's own finite elements are; none where these are more than effects."""
    scene = problem.scene
    if not is_taken_apart(scene):
        return set()
    own, frictions = contained(scene), (None, *scene.load.friction)
    return {model_with(problem, own - ({COUPLED} if mu == 0.0 else set()), mu) for mu in frictions}


def _settled(rows: tuple[Figure, ...], errors: list[Figure]) -> bool:
    """Whether the effects add little to the uncertainty of every judged figure."""
    stated = {(e.quantity, e.friction): e.uncertainty.parts["numerical"] for e in errors}
    return all(
        stated[row.quantity, row.friction]
        <= (row.numerical if math.isfinite(row.numerical) else 0.0)
        + SHARE_OF_TOLERANCE * row.tolerance
        for row in rows
        if row.tolerance is not None
    )
