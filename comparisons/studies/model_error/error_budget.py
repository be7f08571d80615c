"""The error budget of a finished comparison: the model error by effects, and the trace's sampling.

What cannot change a verdict is left out, unless budget.effects is "all":

1. The effects beside the scene's own finite elements, where every judged figure agrees or differs
   by the first comparison already, even if these change it by the sum of all their estimates.
2. The whole's third level, where every judged figure holds, fails, or remains inconclusive by what
   is not modelled, wherever in its uncertainty on the second level the error comes to lie.

The model error and its uncertainty are stated for every figure in any case."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from comparisons.common.numbers import with_unit
from comparisons.common.tasks import LAST, LATER, PERHAPS, Tasks
from comparisons.figures.figure import Figure, is_decided
from comparisons.figures.quantity import WHOLE
from comparisons.models.forecast import flow_seconds, time_with_flow
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import LONGER
from comparisons.models.problem import Problem
from comparisons.studies.friction.coupling import Coupling
from comparisons.studies.model_error.account import figure_of
from comparisons.studies.model_error.catalogue import UNKNOWN, ModelVariant
from comparisons.studies.model_error.contributions import (
    EffectContributions,
    NotComputedError,
    SplitVariants,
    contributions_of,
    split_variants,
)
from comparisons.studies.model_error.estimates import finite_flow
from comparisons.studies.model_error.laws import EFFECT as LAW
from comparisons.studies.model_error.laws import LawSolutions, law_variants
from comparisons.studies.model_error.model_error import ModelError, Solutions
from comparisons.studies.model_error.quantities_of_interest import (
    QuantitiesOfInterest,
)
from comparisons.studies.model_error.sampling import announce_sampling, sampling_changes
from comparisons.studies.model_error.selection import (
    FLOW,
    NONLINEAR,
    NOT_CERTAIN,
    SMALL_STRAINS,
    EffectSelection,
    select_effects,
)
from comparisons.studies.model_error.solutions import LEAST_LEVELS, SolvedVariants
from comparisons.studies.study import Solved
from comparisons.studies.subsurface.yielding import flow_assessment

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
    model_errors: tuple[ModelError, ...]  # of each quantity at each friction coefficient
    # by friction and quantity: what half the samples of the trace change
    sampling: dict[float, dict[str, float]]
    seconds: float  # that the effects took
    # by friction, the finite elements with every effect that matters, on the finest level of the
    # effects, with their fields
    wholes: dict[float, Level] = field(default_factory=dict)
    # which further level of the whole cannot change a verdict, else None
    left_out: str | None = None
    # by friction, what else is compared with the whole; empty where it has no solution, and on disk
    solutions: dict[float, Solutions] = field(default_factory=dict)
    # by effect, and of the whole beside the scene's own: seconds, and largest memory [bytes]
    took: dict[str, tuple[float, int]] = field(default_factory=dict)

    def of(self, quantity: str, friction: float) -> ModelError:
        wanted = quantity, friction
        return next(e for e in self.model_errors if (e.quantity, e.friction) == wanted)

    def figures(self, tolerance: Mapping[str, float]) -> list[Figure]:
        """Every model error, judged where it has a tolerance."""
        return [
            figure_of(error, self.selection, tolerance, self.sampling)
            for error in self.model_errors
        ]


def error_budget(
    solved: Solved, rows: tuple[Figure, ...], couplings: tuple[Coupling, ...], tasks: Tasks
) -> ErrorBudget:
    """Select the effects that may matter, solve them, and split the difference of the models. An
    effect that cannot be solved is not modelled: its estimate and the reason are kept.

    rows       the comparison of the solved models
    couplings  of the half-plane, one a friction coefficient"""
    problem, half_plane = solved.problem, solved.runs["half_plane"]
    selection = selected_effects(solved, couplings)
    is_frugal = problem.scene.budget.effects != "all"
    if (
        is_frugal
        and selection.added
        and FLOW not in selection.added
        and _is_decided(rows, selection)
    ):
        selection = selection.without(selection.added, f"cannot change a verdict ({ASKED})")
    variants = _variants(solved, tasks, solved.runs["finite_element"])
    while True:
        splits = {mu: split_variants(problem, selection, mu) for mu in problem.scene.load.friction}
        variants.keep(split.whole for split in splits.values())
        try:
            frugal = selection if is_frugal else None
            refinement = _Refinement(half_plane, rows, splits, variants, selection)
            refined = refinement.result(frugal)
            if refinement.without_laws:
                selection = selection.without(frozenset({LAW}), refinement.without_laws)
            wholes = {mu: variants.finest(split.whole).under(mu) for mu, split in splits.items()}
            selection = _with_plastic_strain(problem, selection, wholes)
            if selection.impossible.get("finite_strain") != SMALL_STRAINS:
                break
            selection = _with_finite_flow(selection, refined, splits, variants)
            if "finite_strain" not in selection.added:
                break
        except NotComputedError as error:
            dropped = _given_up(selection, splits, variants)
            if not dropped:  # what the scene itself has cannot be taken apart
                refined = _Refined(0, _unsplit(rows), str(error), None)
                finest = solved.runs["finite_element"].finest
                wholes = {mu: finest.under(mu) for mu in splits}
                break
            selection = selection.without(dropped, str(error))
    sampling = {}
    if problem.scene.profile is not None:
        sampling = sampling_changes(problem, solved.window, half_plane.levels, tasks)
    return ErrorBudget(
        selection=selection,
        levels=refined.levels,
        unsplit=refined.unsplit,
        model_errors=tuple(refined.errors),
        sampling=sampling,
        seconds=variants.seconds,
        wholes=wholes,
        left_out=refined.left_out,
        solutions=refined.solutions,
        took=_took(splits, variants),
    )


def _with_plastic_strain(
    problem: Problem, selection: EffectSelection, wholes: Mapping[float, Level]
) -> EffectSelection:
    """With the estimate of finite deformation by the pressures and plastic strains of wholes that
    flow at small ones, where their fields show these."""
    strains = [s for level in wholes.values() if (s := level.plastic_strain) is not None]
    if selection.impossible.get("finite_strain") != SMALL_STRAINS or not strains:
        return selection
    peak = max(float(level.solution.pressure.max()) for level in wholes.values())
    sizes = finite_flow(problem, peak, max(strains))
    return selection.resized("finite_strain", sizes, problem.scene.tolerances)


def _with_finite_flow(
    selection: EffectSelection,
    refined: "_Refined",
    splits: Mapping[float, SplitVariants],
    variants: SolvedVariants,
) -> EffectSelection:
    """With finite strain of a whole that flows, whose estimate matters, where that may decide a
    verdict and the time allows it by the laws of cost; else with the reason why not."""
    problem, least = variants.problem, range(1, LEAST_LEVELS + 1)
    asked, finite = problem.scene.budget.effects, selection.flowing_finitely()
    figures = (figure_of(e, selection, problem.scene.tolerances) for e in refined.errors)
    open_figures = (f for f in figures if f.bounds and f.verdict == "inconclusive")
    if not asked or (asked != "all" and all(figure.is_unresolved for figure in open_figures)):
        why = f"cannot change a verdict ({ASKED})" if asked else "not asked for (budget.effects)"
        return selection.without(frozenset({"finite_strain"}), f"{SMALL_STRAINS}: {why}")
    wholes = [split_variants(problem, finite, mu).whole for mu in problem.scene.load.friction]
    seconds = math.fsum(variants.forecast(w, n) for w in dict.fromkeys(wholes) for n in least)
    spent = _spent(variants)
    if spent + seconds <= problem.time:
        return finite
    flowing = dict.fromkeys(v for split in splits.values() for v in split.wholes)
    time = spent + seconds
    finer = GROWTH_OF_TIME * variants.expected_of(refined.levels, flowing)
    for _ in range(refined.levels, min(_most_levels(problem), len(variants.of_scene.levels))):
        if spent + finer <= time:  # the time allows this level at small strains, too
            spent, time, finer = spent + finer, time + finer, GROWTH_OF_TIME * finer
    more = with_unit(seconds, "s", 2)
    why = f"{SMALL_STRAINS}: finite ones take {more} more (budget.time)"
    return replace(selection.without(frozenset({"finite_strain"}), why), time=time)


def _took(
    splits: dict[float, SplitVariants], variants: SolvedVariants
) -> dict[str, tuple[float, int]]:
    """Of each effect by itself and of the whole, of all friction coefficients together."""
    wanted: dict[str, dict[ModelVariant, None]] = {}
    for split in splits.values():
        wanted.setdefault(WHOLE, {}).update(dict.fromkeys(split.wholes))
        for name, (with_it, _) in split.pairs.items():
            wanted.setdefault(name, {})[with_it] = None
    took = {}
    for name, solved in wanted.items():
        costs = [variants.took.get(variant, (0.0, 0)) for variant in solved]
        took[name] = math.fsum(cost[0] for cost in costs), max(cost[1] for cost in costs)
    return took


def announce_effects(
    solved: Solved, couplings: tuple[Coupling, ...], tasks: Tasks
) -> Callable[[], None]:
    """Add to the tasks what `error_budget` will ask for, as the half-plane on the levels that the
    scene asks for selects it: it may begin before the finite elements are done. Should a finer
    half-plane select other effects, these are solved then.

    Call what is returned once the scene's own finite elements leave a figure open on the least
    levels. The whole will leave it open, too: its further level need not wait, and a process stays
    with the bodies of one level."""
    problem, half_plane = solved.problem, solved.runs["half_plane"]
    selection, variants = selected_effects(solved, couplings), _variants(solved, tasks, None)
    splits = [split_variants(problem, selection, mu) for mu in problem.scene.load.friction]
    variants.keep(split.whole for split in splits)
    wholes = [variant for split in splits for variant in split.wholes]
    every = [variant for split in splits for variant in split.all]
    again = [
        variant
        for split in splits
        for variant in law_variants(split.whole, selection.laws).values()
    ]
    again += [variant for split in splits for variant in longer_increments(split.whole, selection)]
    most = min(_most_levels(problem), len(half_plane.levels))
    if FLOW in selection.added:
        most = min(most, LEAST_LEVELS)  # further ones take long, and will hardly be wanted

    def announce(splitting: int, further: int) -> None:
        variants.announce(again, 1, splitting)
        for number in range(1, most + 1):
            is_further = number > LEAST_LEVELS
            variants.announce(wholes, number, further if is_further else LATER)
            variants.announce(() if is_further else every, number, splitting)

    announce(LAST, PERHAPS)
    announce_sampling(problem, solved.window, half_plane.levels, tasks)
    return partial(announce, LATER, LATER)


def _variants(solved: Solved, tasks: Tasks, of_scene: ModelRun | None) -> SolvedVariants:
    """None of them is solved yet; `of_scene` are the scene's own finite elements."""
    patches = solved.runs["half_plane"].levels[0].patches
    return SolvedVariants(solved.problem, solved.window, of_scene, tasks, patches)


def selected_effects(solved: Solved, couplings: tuple[Coupling, ...]) -> EffectSelection:
    contacts = (level.solution.pressure for level in solved.runs["half_plane"].finest.by_friction)
    pressure = max(contacts, key=np.max)
    mean = float(pressure @ pressure / pressure.sum())
    flow, no_flow = flow_assessment(solved.problem, solved.runs), NOT_CERTAIN
    if flow.is_certain and solved.plan.effects:
        no_flow = _no_time_for_flow(solved)
    selection = select_effects(solved.problem, float(pressure.max()), couplings, mean, no_flow)
    asked = solved.problem.scene.budget.effects
    if not solved.plan.effects:
        computed = {LAW} if selection.laws else set()  # beside the added
        left_out = selection.added | computed | set(selection.impossible) - (set(UNKNOWN) - {LAW})
        return selection.without(left_out, "not asked for (budget.effects)")
    if asked != "all" and flow.beyond_doubt and FLOW not in selection.added:
        why = f"the body flows, an elastic one cannot hold ({ASKED})"
        return selection.without(selection.added, why)
    return selection


def _no_time_for_flow(solved: Solved) -> str | None:
    """Why flow is not computed beside the scene's own finite elements: by the laws of cost, the
    levels that it takes and theirs exceed the budget; None: they do not."""
    problem, patches = solved.problem, solved.runs["half_plane"].levels[0].patches
    if time_with_flow(problem, solved.plan, patches) <= problem.time:
        return None
    return f"it takes {with_unit(flow_seconds(problem, patches), 's', 2)} more (budget.time)"


def longer_increments(whole: ModelVariant, selection: EffectSelection) -> tuple[ModelVariant, ...]:
    """The whole by longer increments of flow, the longest first, where the scene's own finite
    elements do not flow: their check; else none."""
    return tuple(replace(whole, times=t) for t in LONGER) if FLOW in selection.added else ()


def _at_small_strains(split: SplitVariants, selection: EffectSelection) -> ModelVariant:
    """The whole, as its increments are checked: these are the same at finite strain."""
    flows = selection.whole.issuperset(NONLINEAR)
    return split.pairs["finite_strain"][1] if flows else split.whole


def _most_levels(problem: Problem) -> int:
    most = None if problem.levels is None else problem.levels.effects
    return min(MOST_LEVELS, most or MOST_LEVELS)


@dataclass(frozen=True)
class _Refined:
    """The model errors, as far as the levels of the effects were taken."""

    levels: int  # that the whole was taken to
    errors: list[ModelError]
    unsplit: str | None  # why these are not split
    left_out: str | None  # which level cannot change a verdict
    solutions: dict[float, Solutions] = field(default_factory=dict)  # by friction


class _Refinement:
    """The effects level by level. The split stays on the least levels, unless the whole and the
    scene's own finite elements are all that it takes."""

    def __init__(
        self,
        half_plane: ModelRun,
        rows: tuple[Figure, ...],
        splits: dict[float, SplitVariants],
        solved: SolvedVariants,
        selection: EffectSelection,
    ) -> None:
        laws = selection.laws
        self.laws = {mu: law_variants(split.whole, laws) for mu, split in splits.items()}
        self.open_laws, self.without_laws = laws, ""  # why they have no solution
        self.with_laws: dict[float, LawSolutions] = {}
        small = {mu: _at_small_strains(split, selection) for mu, split in splits.items()}
        longer = {mu: longer_increments(whole, selection) for mu, whole in small.items()}
        self.increments = {mu: (*some, small[mu]) if some else () for mu, some in longer.items()}
        self.longer: dict[float, list[QuantitiesOfInterest]] = {}
        self.rows, self.splits, self.solved, self.problem = rows, splits, solved, solved.problem
        self.runs = {"half_plane": half_plane, "finite_element": solved.of_scene}
        self.most = min(_most_levels(solved.problem), len(solved.of_scene.levels))
        self.every = dict.fromkeys(variant for split in splits.values() for variant in split.all)
        self.wholes = dict.fromkeys(
            variant for split in splits.values() for variant in split.wholes
        )
        frictions = solved.problem.scene.load.friction
        self.history: dict[float, list[EffectContributions]] = {mu: [] for mu in frictions}

    def result(self, frugal: EffectSelection | None) -> _Refined:
        """The wholes, which others need, are solved before what splits them.

        frugal  what was selected, where a level that cannot change a verdict is left out; else None
        Raises NotComputedError where a whole has no solution on the least levels."""
        for number in range(1, LEAST_LEVELS + 1):
            self.solved.announce(self.every, number, LAST)
        for mu, variants in self.laws.items():
            self.solved.announce((*variants.values(), *self.increments[mu]), 1, LAST)
        left_out = self._take_wholes(frugal)
        levels = len(next(iter(self.history.values())))
        for number in range(1, levels + 1):
            if number <= LEAST_LEVELS or not self._is_open(number):
                self._take(number, alone=False)
        parts = (level for of_friction in self.history.values() for level in of_friction)
        why = next((level.unsplit for level in parts if level.unsplit), None)
        return _Refined(levels, self._errors(), why, left_out, self._solutions())

    def _take_wholes(self, frugal: EffectSelection | None) -> str | None:
        """As many levels of the wholes as it takes; which one cannot change a verdict."""
        for number in range(1, self.most + 1):
            if number > LEAST_LEVELS and _is_beyond(self.solved, number, self.wholes):
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
        for mu, variants in self.laws.items():
            self.solved.prepare(variants.values(), 1)
            try:
                moved = {key: self.solved.solution(v, 1, mu) for key, v in variants.items()}
            except NotComputedError as error:
                self.without_laws = f"with the law of {error.variant.laws_name}: {error}"
                self.with_laws = {}
                return
            if variants:
                whole, window = self.history[mu][0].whole, self.solved.window
                self.with_laws[mu] = LawSolutions(
                    self.problem, window, self.open_laws, whole, moved
                )

    def _take_increments(self) -> None:
        """The wholes that flow on the coarsest level by longer increments; none where one of them
        has no solution."""
        for mu, variants in self.increments.items():
            self.solved.prepare(variants, 1)
            try:
                self.longer[mu] = [self.solved.solution(v, 1, mu) for v in variants]
            except NotComputedError:
                self.longer[mu] = []

    def _take(self, number: int, alone: bool) -> None:
        """A level into the history: of the wholes alone, or of every variant."""
        self.solved.prepare(self.wholes if alone else self.every, number)
        new = {
            mu: contributions_of(self.solved, self.splits[mu], mu, number, alone)
            for mu in self.history
        }
        for mu, parts in new.items():
            self.history[mu][number - 1 : number] = [parts]

    def _is_open(self, number: int) -> bool:
        return any(self.solved.is_open(variant, number) for variant in self.every)

    def _errors(self) -> list[ModelError]:
        return [
            solutions.error(row)
            for mu, solutions in self._solutions().items()
            for row in self.rows
            if row.friction == mu
        ]

    def _solutions(self) -> dict[float, Solutions]:
        problem, window, made = self.problem, self.solved.window, {}
        for mu, parts in self.history.items():
            runs = {name: run.under(mu) for name, run in self.runs.items()}
            made[mu] = Solutions(
                *(problem, window, runs, parts, mu),
                laws=self.with_laws.get(mu),
                longer=self.longer.get(mu, []) if self.increments[mu] else None,
            )
        return made

    def _is_fixed(self, errors: list[ModelError], selection: EffectSelection) -> bool:
        """Whether a finer solution leaves every verdict as it is."""
        tolerance = self.problem.scene.tolerances
        figures = (figure_of(error, selection, tolerance) for error in errors)
        return all(figure.is_fixed for figure in figures if figure.bounds)


def _is_decided(rows: tuple[Figure, ...], selection: EffectSelection) -> bool:
    """Whether every judged row agrees or differs whatever the effects do that its finite elements
    do not have."""
    missing = [sizes for n, sizes in selection.estimates.items() if n not in selection.contained]
    return all(
        is_decided(
            row.value,
            row.numerical,
            sum(sizes.get(row.quantity, 0.0) for sizes in missing),
            row.tolerance,
        )
        for row in rows
        if row.tolerance is not None
    )


def _is_beyond(solved: SolvedVariants, number: int, asked: Iterable[ModelVariant]) -> bool:
    """Whether a level of these variants would exceed the time, by the laws of cost: clocks would
    give another machine other figures."""
    finer = GROWTH_OF_TIME * solved.expected_of(number - 1, asked)
    return _spent(solved, number) + finer > solved.problem.time


def _spent(solved: SolvedVariants, below: int | None = None) -> float:
    """Seconds of the levels of the scene's finite elements and of all variants, of these `below` a
    number, by the laws of cost."""
    numbers = {number for _, number in solved.expected if below is None or number < below}
    spent = sum(level.expected_seconds for level in solved.of_scene.levels)
    return spent + sum(solved.expected_of(number) for number in sorted(numbers))


def _unsplit(rows: tuple[Figure, ...]) -> list[ModelError]:
    """The models' differences as they are."""
    return [
        ModelError(row.quantity, row.friction, {}, 0.0, row.value, row.numerical, row.scale)
        for row in rows
    ]


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


def _given_up(
    selection: EffectSelection, splits: dict[float, SplitVariants], solved: SolvedVariants
) -> frozenset[str]:
    """The added effects to leave out where the whole has no solution: those that have none by
    themselves, else finite deformation, else all."""
    failed = {variant for variant, _ in solved.failed}
    alone = {
        name
        for split in splits.values()
        for name, (with_it, _) in split.pairs.items()
        if with_it in failed
    }
    for fewer in (alone, {"finite_strain"}):
        if selection.added & fewer:
            return selection.added & fewer
    return selection.added
