"""The effects of the model error level by level, until they add little to what is stated, or what a
further level could change is no verdict."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial

from comparisons.common.tasks import LAST, LATER
from comparisons.figures.figure import Figure, Figures
from comparisons.judging.effects.catalogue import LAW
from comparisons.judging.effects.selection import EffectSelection
from comparisons.judging.effects.variants import ModelVariant
from comparisons.judging.model_error.contributions import (
    NotComputedError,
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
        self.problem, self.cases = variants.problem, variants.scene.cases
        self.splits = [split_variants(self.problem, selection, c.friction) for c in self.cases]
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
        levels, left_out = self._solve_wholes(most, is_frugal)
        for number in range(1, min(levels, LEAST_LEVELS) + 1):
            self.variants.prepare(self.every, number)
        solutions, finest = self._solutions(levels), self.variants.finest
        return ErrorBudget(
            selection=self.selection,
            levels=levels,
            unsplit=next((one.unsplit for one in solutions if one.unsplit), None),
            model_errors=tuple(self._errors(solutions)),
            wholes=tuple(finest(one.split.whole, one.case.friction) for one in solutions),
            left_out=left_out,
            solutions=tuple(solutions),
        )

    def _solve_wholes(self, most: int, is_frugal: bool) -> tuple[int, str | None]:
        """As many levels of the wholes as it takes; which further one cannot change a verdict."""
        for number in range(1, min(most, LEAST_LEVELS) + 1):
            self._solve_whole(number)
        if most >= LEAST_LEVELS:
            self._solve_checks()
        for number in range(LEAST_LEVELS + 1, most + 1):
            errors = self._errors(self._solutions(number - 1))
            if _settled(self.rows, errors):
                return number - 1, None
            if is_frugal and self._are_fixed(errors):
                further = f"level {number} of the whole model"
                return number - 1, f"{further}: cannot change a verdict ({ASKED})"
            # by the laws of cost: clocks would give another machine other figures
            finer = GROWTH_OF_TIME * self.variants.expected_of(number - 1, self.wholes)
            if spent_seconds(self.variants, number) + finer > self.problem.time:
                return number - 1, None
            try:
                self._solve_whole(number)
            except NotComputedError:
                return number - 1, None
        return most, None

    def _solve_whole(self, number: int) -> None:
        self.variants.prepare(self.wholes, number)
        for error in (self.variants.failed.get((variant, number)) for variant in self.wholes):
            if error is not None:
                raise error

    def _solve_checks(self) -> None:
        """On the coarsest level; where one of the laws has no solution, none is taken."""
        for split in self.splits:
            self.variants.prepare(split.checks, 1)
        laws = (variant for split in self.splits for variant in split.laws.values())
        failed = [error for law in laws if (error := self.variants.failed.get((law, 1)))]
        if failed and self.selection.laws:
            why = f"with the law of {failed[0].variant.laws_name}: {failed[0]}"
            self.selection = self.selection.without(frozenset({LAW}), why)

    def _solutions(self, levels: int) -> list[Solutions]:
        """Of each case, what is solved so far on so many levels. The split is on those on which no
        variant is open."""
        known, taken = self.variants, []
        for case, split in zip(self.cases, self.splits, strict=True):
            history, unsplit, levels_split = [], None, 0
            for number in range(1, levels + 1):
                solved = partial(known.solution, number=number, friction=case.friction)
                tried = [v for v in (*split.all, *split.checks) if not known.is_open(v, number)]
                found = {v: solved(v) for v in tried if (v, number) not in known.failed}
                history.append({split.of_scene: solved(split.of_scene)} | found)
                if levels_split == number - 1 and set(split.all) <= set(tried):
                    levels_split = number
                    if split.nothing not in found:
                        unsplit = unsplit or str(known.failed[split.nothing, number])
            how = {"levels_split": 0 if unsplit else levels_split, "unsplit": unsplit}
            taken.append(Solutions(case, split, self.selection.laws, tuple(history), **how))
        return taken

    def _errors(self, solutions: list[Solutions]) -> list[Figure]:
        known = [(one, row) for one in solutions for row in self.rows]
        return [one.error(row) for one, row in known if row.friction == one.case.friction]

    def _are_fixed(self, errors: list[Figure]) -> bool:
        """Whether a finer solution leaves every verdict as it is."""
        known = self.selection, self.problem.scene.tolerances
        figures = (figure_of(error, *known) for error in errors)
        return all(figure.is_fixed for figure in figures if figure.bounds)


def spent_seconds(variants: SolvedVariants, below: float = math.inf) -> float:
    """Seconds of the levels of the scene's finite elements and of all variants, of these `below` a
    number, by the laws of cost."""
    spent = [cost for (_, number), cost in variants.expected.items() if number < below]
    return math.fsum([*spent, *(level.expected_seconds for level in variants.of_scene.levels)])


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
