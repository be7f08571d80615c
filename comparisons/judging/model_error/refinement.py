"""The effects of the model error level by level, until they add little to what is stated, or what a
further level could change is no verdict."""

import math
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial

from comparisons.common.tasks import LAST
from comparisons.figures.figure import Figure
from comparisons.judging.effects.catalogue import ModelVariant
from comparisons.judging.effects.laws import LawSolutions, law_variants
from comparisons.judging.effects.selection import FLOW, NONLINEAR, EffectSelection
from comparisons.judging.model_error.account import figure_of
from comparisons.judging.model_error.contributions import (
    NotComputedError,
    SplitVariants,
    contributions_of,
)
from comparisons.judging.model_error.model_error import ModelError, Solutions
from comparisons.judging.model_error.solutions import LEAST_LEVELS, SolvedVariants
from comparisons.models.plan import LONGER
from comparisons.models.problem import Problem

MOST_LEVELS = 3  # of the effects
SHARE_OF_TOLERANCE = 1.0 / 3.0  # that the effects may add to the uncertainty of a figure
ASKED = 'budget.effects = "all" computes it'
GROWTH_OF_TIME = 3.2  # from one level to the next, at most


def longer_increments(whole: ModelVariant, selection: EffectSelection) -> tuple[ModelVariant, ...]:
    """The whole by longer increments of flow, the longest first, where the scene's own finite
    elements do not flow: their check; else none."""
    return tuple(replace(whole, times=t) for t in LONGER) if FLOW in selection.added else ()


def most_effect_levels(problem: Problem) -> int:
    most = None if problem.levels is None else problem.levels.effects
    return min(MOST_LEVELS, most or MOST_LEVELS)


@dataclass(frozen=True)
class RefinedEffects:
    """The model errors, as far as the levels of the effects were taken."""

    levels: int  # that the whole was taken to
    errors: list[ModelError]
    unsplit: str | None  # why these are not split
    left_out: str | None  # which level cannot change a verdict
    solutions: tuple[Solutions, ...] = ()  # of each case


@dataclass
class _CaseEffects:
    """The variants of one case, and what is solved of them."""

    split: SplitVariants
    laws: dict[tuple[int, str], ModelVariant]  # the whole with other laws of elasticity
    increments: tuple[ModelVariant, ...]  # by longer increments of flow, the longest first
    solutions: Solutions

    def now(self, **found: object) -> None:
        self.solutions = replace(self.solutions, **found)


class EffectRefinement:
    """The effects level by level. The split stays on the least levels, unless the whole and the
    scene's own finite elements are all that it takes."""

    def __init__(
        self,
        rows: tuple[Figure, ...],
        splits: tuple[SplitVariants, ...],
        solved: SolvedVariants,
        selection: EffectSelection,
        most: int = MOST_LEVELS,
    ) -> None:
        """`splits` of each case; `most` levels at most."""
        self.open_laws, self.without_laws = selection.laws, ""  # why they have no solution
        self.rows, self.solved, self.problem = rows, solved, solved.problem
        self.cases = []
        for case, split in zip(solved.scene.cases, splits, strict=True):
            # increments are checked at small strains: they are the same at finite ones
            small = split.whole
            if selection.whole.issuperset(NONLINEAR):
                small = split.pairs["finite_strain"][1]
            longer = longer_increments(small, selection)
            increments = (*longer, small) if longer else ()
            known = Solutions(case, longer=[] if increments else None)
            laws = law_variants(split.whole, selection.laws)
            self.cases.append(_CaseEffects(split, laws, increments, known))
        self.most = min(most, most_effect_levels(solved.problem), len(solved.of_scene.levels))
        self.every = dict.fromkeys(variant for split in splits for variant in split.all)
        self.wholes = dict.fromkeys(variant for split in splits for variant in split.wholes)

    @property
    def solutions(self) -> tuple[Solutions, ...]:
        return tuple(one.solutions for one in self.cases)

    def result(self, frugal: EffectSelection | None) -> RefinedEffects:
        """The wholes, which others need, are solved before what splits them.

        frugal  what was selected, where a level that cannot change a verdict is left out; else None
        Raises NotComputedError where a whole has no solution on the least levels."""
        for number in range(1, LEAST_LEVELS + 1):
            self.solved.announce(self.every, number, LAST)
        for one in self.cases:
            nearer = one.split.held_nearer.values()
            self.solved.announce((*one.laws.values(), *one.increments, *nearer), 1, LAST)
        left_out = self._take_wholes(frugal)
        levels = len(self.solutions[0].history)
        for number in range(1, levels + 1):
            is_open = any(self.solved.is_open(variant, number) for variant in self.every)
            if number <= LEAST_LEVELS or not is_open:
                self._take(number, alone=False)
        # on the coarsest level, what lacks an effect of size with its far boundary nearer
        for one in self.cases:
            nearer, friction = {}, one.solutions.case.friction
            for name, variant in one.split.held_nearer.items():
                with suppress(NotComputedError):
                    nearer[name] = self.solved.solution(variant, 1, friction)
            one.now(nearer=nearer)
        parts = (level for solutions in self.solutions for level in solutions.history)
        why = next((level.unsplit for level in parts if level.unsplit), None)
        return RefinedEffects(levels, self._errors(), why, left_out, self.solutions)

    def _take_wholes(self, frugal: EffectSelection | None) -> str | None:
        """As many levels of the wholes as it takes; which one cannot change a verdict."""
        for number in range(1, self.most + 1):
            if number > LEAST_LEVELS:
                # by the laws of cost: clocks would give another machine other figures
                finer = GROWTH_OF_TIME * self.solved.expected_of(number - 1, self.wholes)
                if spent_seconds(self.solved, number) + finer > self.problem.time:
                    return None
            try:
                self._take(number, alone=True)
            except NotComputedError:
                if number <= LEAST_LEVELS:
                    raise
                return None
            if number == LEAST_LEVELS:
                self._take_laws()
                self._take_increments()
            errors = self._errors()
            if number >= LEAST_LEVELS and _settled(self.rows, errors):
                return None
            if LEAST_LEVELS <= number < self.most and frugal and self._is_fixed(errors, frugal):
                further = f"level {number + 1} of the whole model"
                return f"{further}: cannot change a verdict ({ASKED})"
        return None

    def _take_laws(self) -> None:
        """The wholes on the coarsest level with other laws; `without_laws` where one has none."""
        for one in self.cases:
            self.solved.prepare(one.laws.values(), 1)
            solved = partial(self.solved.solution, number=1, friction=one.solutions.case.friction)
            try:
                moved = {key: solved(variant) for key, variant in one.laws.items()}
            except NotComputedError as error:
                self.without_laws = f"with the law of {error.variant.laws_name}: {error}"
                for known in self.cases:
                    known.now(laws=None)
                return
            if moved:
                whole = one.solutions.history[0].whole
                laws = LawSolutions(one.solutions.problem, self.open_laws, whole, moved)
                one.now(laws=laws)

    def _take_increments(self) -> None:
        """The wholes that flow on the coarsest level by longer increments; none where one of them
        has no solution."""
        for one in self.cases:
            self.solved.prepare(one.increments, 1)
            solved = partial(self.solved.solution, number=1, friction=one.solutions.case.friction)
            with suppress(NotComputedError):
                if one.increments:
                    one.now(longer=list(map(solved, one.increments)))

    def _take(self, number: int, alone: bool) -> None:
        """A level into the history: of the wholes alone, or of every variant."""
        self.solved.prepare(self.wholes if alone else self.every, number)
        new = []
        for one in self.cases:
            known = {"number": number, "friction": one.solutions.case.friction}
            new.append(contributions_of(partial(self.solved.solution, **known), one.split, alone))
        for one, parts in zip(self.cases, new, strict=True):  # all of them, or none
            before, after = one.solutions.history[: number - 1], one.solutions.history[number:]
            one.now(history=(*before, parts, *after))

    def _errors(self) -> list[ModelError]:
        return [
            solutions.error(row)
            for solutions in self.solutions
            for row in self.rows
            if row.friction == solutions.case.friction
        ]

    def _is_fixed(self, errors: list[ModelError], selection: EffectSelection) -> bool:
        """Whether a finer solution leaves every verdict as it is."""
        tolerance = self.problem.scene.tolerances
        figures = (figure_of(error, selection, tolerance) for error in errors)
        return all(figure.is_fixed for figure in figures if figure.bounds)


def spent_seconds(solved: SolvedVariants, below: int | None = None) -> float:
    """Seconds of the levels of the scene's finite elements and of all variants, of these `below` a
    number, by the laws of cost."""
    numbers = {number for _, number in solved.expected if below is None or number < below}
    spent = sum(level.expected_seconds for level in solved.of_scene.levels)
    return spent + sum(solved.expected_of(number) for number in sorted(numbers))


def _settled(rows: tuple[Figure, ...], errors: list[ModelError]) -> bool:
    """Whether the effects add little to the uncertainty of every judged figure."""
    stated = {(e.quantity, e.friction): e.uncertainty for e in errors}
    return all(
        stated[row.quantity, row.friction]
        <= (row.numerical if math.isfinite(row.numerical) else 0.0)
        + SHARE_OF_TOLERANCE * row.tolerance
        for row in rows
        if row.tolerance is not None
    )
