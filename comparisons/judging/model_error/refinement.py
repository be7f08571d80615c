"""The effects of the model error level by level, until they add little to what is stated, or what a
further level could change is no verdict."""

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial

from comparisons.common.tasks import LAST, LATER
from comparisons.figures.figure import Figure, Figures
from comparisons.judging.effects.catalogue import LAW
from comparisons.judging.effects.selection import EffectSelection
from comparisons.judging.effects.variants import ModelVariant
from comparisons.judging.model_error.contributions import (
    NotComputedError,
    solutions_of,
    split_variants,
)
from comparisons.judging.model_error.model_error import Solutions, figure_of
from comparisons.judging.model_error.solutions import LEAST_LEVELS, SolvedVariants
from comparisons.models.level import Level
from comparisons.models.problem import Problem

MOST_LEVELS = 3  # of the effects
SHARE_OF_TOLERANCE = 1.0 / 3.0  # that the effects may add to the uncertainty of a figure
ASKED = 'budget.effects = "all" computes it'
GROWTH_OF_TIME = 3.2  # from one level to the next, at most


@dataclass(frozen=True)
class ErrorBudget:
    """What separates the half-plane from the whole model, and both from the surface."""

    selection: EffectSelection  # which effects were computed
    levels: int  # that the whole was taken to; 0 where it has no solution
    unsplit: str | None  # why the difference of the models could not be split, else None
    # of each quantity at each friction coefficient, without what is not modelled
    model_errors: tuple[Figure, ...]
    seconds: float = 0.0  # that the effects took
    # of each case, the finite elements with every effect that matters, on the finest level of the
    # effects, with their fields
    wholes: tuple[Level, ...] = ()
    # which further level of the whole cannot change a verdict, else None
    left_out: str | None = None
    # of each case, what else is compared with the whole; empty where it has no solution
    solutions: tuple[Solutions, ...] = ()
    # by variant: seconds, and the largest memory [bytes]
    took: dict[ModelVariant, tuple[float, int]] = field(default_factory=dict)

    def figures(self, tolerance: Mapping[str, float]) -> Figures:
        """Every model error with all that is not known of it, judged where it has a tolerance."""
        return Figures(figure_of(error, self.selection, tolerance) for error in self.model_errors)


def most_effect_levels(problem: Problem) -> int:
    most = None if problem.levels is None else problem.levels.effects
    return min(MOST_LEVELS, most or MOST_LEVELS)


class EffectRefinement:
    """The effects of a selection level by level. The split stays on the least levels, unless the
    whole and the scene's own finite elements are all that it takes."""

    def __init__(
        self, rows: tuple[Figure, ...], variants: SolvedVariants, selection: EffectSelection
    ) -> None:
        self.rows, self.variants, self.selection = rows, variants, selection
        self.problem, self.solutions = variants.problem, []
        for case in variants.scene.cases:
            split = split_variants(self.problem, selection, case.friction)
            self.solutions.append(Solutions(case, split, selection.laws))
        self.splits = [one.split for one in self.solutions]
        variants.keep(split.whole for split in self.splits)
        self.every = dict.fromkeys(variant for split in self.splits for variant in split.all)
        self.wholes = dict.fromkeys(variant for split in self.splits for variant in split.wholes)

    def announce(self, splitting: int, levels: int = LEAST_LEVELS, further: int = LATER) -> None:
        """Make the variants known to the tasks: on so many levels the wholes, which others need, on
        the least ones and as urgent as `splitting` what splits them, too."""
        for split in self.splits:
            self.variants.announce(split.checks, 1, splitting)
        for number in range(1, levels + 1):
            is_further = number > LEAST_LEVELS
            self.variants.announce(self.wholes, number, further if is_further else LATER)
            self.variants.announce(() if is_further else self.every, number, splitting)

    def budget(self, most: int, is_frugal: bool) -> ErrorBudget:
        """The model errors by so many levels at most; wholes are solved before what splits them.

        is_frugal  whether a level that cannot change a verdict is left out
        Raises NotComputedError where a whole has no solution on the least levels."""
        most = min(most, most_effect_levels(self.problem), len(self.variants.of_scene.levels))
        self.announce(LAST)
        left_out = self._take_wholes(most, is_frugal)
        levels = len(self.solutions[0].history)
        for number in range(1, levels + 1):
            is_open = any(self.variants.is_open(variant, number) for variant in self.every)
            if number <= LEAST_LEVELS or not is_open:
                self._take(number, alone=False)
        finest = self.variants.finest
        return ErrorBudget(
            selection=self.selection,
            levels=levels,
            unsplit=next((one.unsplit for one in self.solutions if one.unsplit), None),
            model_errors=tuple(self._errors()),
            wholes=tuple(finest(one.split.whole, one.case.friction) for one in self.solutions),
            left_out=left_out,
            solutions=tuple(self.solutions),
        )

    def _take_wholes(self, most: int, is_frugal: bool) -> str | None:
        """As many levels of the wholes as it takes; which one cannot change a verdict."""
        for number in range(1, min(most, LEAST_LEVELS) + 1):
            self._take(number, alone=True)
        if most >= LEAST_LEVELS:
            self._take_checks()
        for number in range(LEAST_LEVELS + 1, most + 1):
            errors = self._errors()
            if _settled(self.rows, errors):
                break
            if is_frugal and self._are_fixed(errors):
                return f"level {number} of the whole model: cannot change a verdict ({ASKED})"
            # by the laws of cost: clocks would give another machine other figures
            finer = GROWTH_OF_TIME * self.variants.expected_of(number - 1, self.wholes)
            if spent_seconds(self.variants, number) + finer > self.problem.time:
                break
            try:
                self._take(number, alone=True)
            except NotComputedError:
                break
        return None

    def _take(self, number: int, alone: bool) -> None:
        """A level into the history: of the wholes alone, or of every variant."""
        self.variants.prepare(self.wholes if alone else self.every, number)
        taken = []
        for one in self.solutions:
            solved = partial(self.variants.solution, number=number, friction=one.case.friction)
            found, nothing = solutions_of(solved, one.split, alone), one.split.nothing
            before = one.history[number - 1] if number <= len(one.history) else {}
            history = (*one.history[: number - 1], before | found, *one.history[number:])
            one = replace(one, history=history)
            if not alone:
                why = None if nothing in found else str(self.variants.failed[nothing, number])
                why = one.unsplit or why
                one = replace(one, unsplit=why, levels_split=0 if why else number)
            taken.append(one)
        self.solutions = taken  # all of them, or none

    def _take_checks(self) -> None:
        """On the coarsest level, those checks that have a solution; where one of the laws has none,
        no law is taken."""
        for number, one in enumerate(self.solutions):
            first = dict(one.history[0])
            for variant in one.split.checks:
                with suppress(NotComputedError):
                    first[variant] = self.variants.solution(variant, 1, one.case.friction)
            self.solutions[number] = replace(one, history=(first, *one.history[1:]))
        laws = (variant for split in self.splits for variant in split.laws.values())
        failed = [error for law in laws if (error := self.variants.failed.get((law, 1)))]
        if failed and self.selection.laws:
            why = f"with the law of {failed[0].variant.laws_name}: {failed[0]}"
            self.selection = self.selection.without(frozenset({LAW}), why)
            self.solutions = [replace(one, laws=()) for one in self.solutions]

    def _errors(self) -> list[Figure]:
        known = [(one, row) for one in self.solutions for row in self.rows]
        return [one.error(row) for one, row in known if row.friction == one.case.friction]

    def _are_fixed(self, errors: list[Figure]) -> bool:
        """Whether a finer solution leaves every verdict as it is."""
        known = self.selection, self.problem.scene.tolerances
        figures = (figure_of(error, *known) for error in errors)
        return all(figure.is_fixed for figure in figures if figure.bounds)


def spent_seconds(variants: SolvedVariants, below: int | None = None) -> float:
    """Seconds of the levels of the scene's finite elements and of all variants, of these `below` a
    number, by the laws of cost."""
    numbers = {number for _, number in variants.expected if below is None or number < below}
    spent = sum(level.expected_seconds for level in variants.of_scene.levels)
    return spent + sum(variants.expected_of(number) for number in sorted(numbers))


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
