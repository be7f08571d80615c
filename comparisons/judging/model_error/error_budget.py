"""The error budget of a finished comparison: the model error by effects, and the trace's sampling.

What cannot change a verdict is left out, unless budget.effects is "all":

1. The effects beside the scene's own finite elements, where every judged figure agrees or differs
   by the first comparison already, even if these change it by the sum of all their estimates.
2. The whole's third level, where every judged figure holds, fails, or remains inconclusive by what
   is not modelled, wherever in its uncertainty on the second level the error comes to lie.

The model error and its uncertainty are stated for every figure in any case."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from comparisons.common.numbers import with_unit
from comparisons.common.tasks import LAST, LATER, PERHAPS, Tasks
from comparisons.figures.figure import Figure, is_decided
from comparisons.figures.quantity import QUANTITIES, WHOLE
from comparisons.judging.coupling import Coupling
from comparisons.judging.effects.catalogue import UNKNOWN, ModelVariant
from comparisons.judging.effects.estimates import Sizes, finite_flow, law_of_elasticity
from comparisons.judging.effects.laws import EFFECT as LAW
from comparisons.judging.effects.laws import law_variants
from comparisons.judging.effects.sampling import EFFECT as SAMPLING
from comparisons.judging.effects.sampling import announce_sampling, sampling_estimate
from comparisons.judging.effects.selection import (
    FLOW,
    ITS_OWN_LAW,
    SMALL_STRAINS,
    EffectSelection,
    is_negligible,
    select_effects,
    why_not,
)
from comparisons.judging.model_error.account import ErrorBudget, figure_of
from comparisons.judging.model_error.contributions import (
    NotComputedError,
    SplitVariants,
    split_variants,
)
from comparisons.judging.model_error.model_error import ModelError
from comparisons.judging.model_error.refinement import (
    ASKED,
    GROWTH_OF_TIME,
    EffectRefinement,
    RefinedEffects,
    longer_increments,
    most_effect_levels,
    spent_seconds,
)
from comparisons.judging.model_error.solutions import LEAST_LEVELS, SolvedVariants
from comparisons.judging.study import Solved
from comparisons.judging.yielding import flow_assessment
from comparisons.models.forecast import flow_seconds, time_with_flow
from comparisons.models.level import Level
from comparisons.models.problem import Problem


def error_budget(
    solved: Solved, rows: tuple[Figure, ...], couplings: tuple[Coupling, ...], tasks: Tasks
) -> ErrorBudget:
    """Select the effects that may matter, solve them, and split the difference of the models. An
    effect that cannot be solved is not modelled: its estimate and the reason are kept.

    rows       the comparison of the solved models; its norms are figures of none
    couplings  of the half-plane, one a friction coefficient"""
    rows = tuple(row for row in rows if row.quantity in QUANTITIES)
    problem, frictions = solved.problem, solved.problem.scene.load.friction
    selection = selected_effects(solved, couplings)
    is_frugal = problem.scene.budget.effects != "all"
    if (
        is_frugal
        and selection.added
        and FLOW not in selection.added
        and _is_decided(rows, selection)
    ):
        selection = selection.without(selection.added, f"cannot change a verdict ({ASKED})")
    variants = SolvedVariants(solved, tasks)
    while True:
        splits = tuple(split_variants(problem, selection, mu) for mu in frictions)
        variants.keep(split.whole for split in splits)
        solvers = rows, splits, variants, selection
        try:
            if FLOW in selection.added:
                first = EffectRefinement(*solvers, LEAST_LEVELS).result(None)
                wholes = _wholes(variants, splits)
                if (flow := _idle_flow(problem, first, wholes)) is not None:
                    selection = selected_effects(solved, couplings, {FLOW: flow})
                    continue
            refinement = EffectRefinement(*solvers)
            refined = refinement.result(selection if is_frugal else None)
            if refinement.without_laws:
                selection = selection.without(frozenset({LAW}), refinement.without_laws)
            wholes = _wholes(variants, splits)
            selection = _with_plastic_strain(problem, selection, wholes)
            if selection.impossible.get("finite_strain") != SMALL_STRAINS:
                break
            selection = _with_finite_flow(selection, refined, splits, variants)
            if "finite_strain" not in selection.added:
                break
        except NotComputedError as error:
            dropped = _given_up(selection, splits, variants)
            if not dropped:  # what the scene itself has cannot be taken apart
                refined = RefinedEffects(0, _unsplit(rows), str(error), None)
                wholes = tuple(case.runs["finite_element"].finest for case in solved.cases)
                break
            selection = selection.without(dropped, str(error))
    if problem.scene.profile is not None:
        known = sampling_estimate(solved, tasks)
        selection = selection.estimated(SAMPLING, *known, problem.scene.tolerances)
    return ErrorBudget(
        selection=selection,
        levels=refined.levels,
        unsplit=refined.unsplit,
        model_errors=tuple(refined.errors),
        seconds=math.fsum(seconds for seconds, _ in variants.took.values()),
        wholes=wholes,
        left_out=refined.left_out,
        solutions=refined.solutions,
        took=_took(splits, variants),
    )


def _wholes(variants: SolvedVariants, splits: Iterable[SplitVariants]) -> tuple[Level, ...]:
    """The finest level of the whole of each case."""
    pairs = zip(variants.scene.cases, splits, strict=True)
    return tuple(variants.finest(split.whole, case.friction) for case, split in pairs)


def _unsplit(rows: tuple[Figure, ...]) -> list[ModelError]:
    """The models' differences as they are."""
    return [
        ModelError(r.quantity, r.friction, {}, 0.0, r.value, r.numerical, r.scale) for r in rows
    ]


def _idle_flow(problem: Problem, refined: RefinedEffects, wholes: Iterable[Level]) -> Sizes | None:
    """What flow changes, by itself and with the other effects, where that moves no judged figure by
    a share of its tolerance that matters: the whole is then one that does not flow. Nothing where
    the `wholes` have no plastic strain; else None."""
    if all(level.plastic_strain == 0.0 for level in wholes):
        return {}
    sizes: dict[str, float] = {}
    for error in refined.errors:
        flow = error.effects.get(FLOW)
        if flow is None:
            return None
        joint = abs(error.interaction) if len(error.effects) > 1 else 0.0
        size = abs(flow.value) + flow.uncertainty + joint
        sizes[error.quantity] = max(size, sizes.get(error.quantity, 0.0))
    return sizes if is_negligible(sizes, problem.scene.tolerances) else None


def _with_plastic_strain(
    problem: Problem, selection: EffectSelection, wholes: Sequence[Level]
) -> EffectSelection:
    """With the estimates of finite deformation and of the law of elasticity by the pressures of
    wholes that flow, and by their plastic strains where their fields show these."""
    strains = [s for level in wholes if (s := level.plastic_strain) is not None]
    pressures = [level.solution.pressure for level in wholes]
    peak, mean = max(map(np.max, pressures)), max(map(mean_pressure, pressures))
    tolerances = problem.scene.tolerances
    if selection.impossible.get(LAW) == ITS_OWN_LAW:
        selection = selection.resized(LAW, law_of_elasticity(problem, peak, mean), tolerances)
    if selection.impossible.get("finite_strain") != SMALL_STRAINS or not strains:
        return selection
    return selection.resized("finite_strain", finite_flow(problem, peak, max(strains)), tolerances)


def _with_finite_flow(
    selection: EffectSelection,
    refined: RefinedEffects,
    splits: Iterable[SplitVariants],
    variants: SolvedVariants,
) -> EffectSelection:
    """With finite strain of a whole that flows, whose estimate matters, where that may decide a
    verdict and the time allows it by the laws of cost; else with the reason why not."""
    problem, least = variants.problem, range(1, LEAST_LEVELS + 1)
    asked, finite = problem.scene.budget.effects, selection.flowing_finitely()
    # what its law of elasticity may change stays, and decides nothing of this
    others = {name: why for name, why in selection.impossible.items() if name != LAW}
    known = replace(selection, impossible=others), problem.scene.tolerances
    # at the least tolerance at which a run holds it is as open as here
    figures = (figure_of(error, *known) for error in refined.errors)
    open_figures = (f for f in figures if f.bounds and f.verdict == "inconclusive")
    if not asked or (asked != "all" and all(figure.is_unresolved for figure in open_figures)):
        why = f"cannot change a verdict ({ASKED})" if asked else "not asked for (budget.effects)"
        return selection.without(frozenset({"finite_strain"}), f"{SMALL_STRAINS}: {why}")
    wholes = [split_variants(problem, finite, mu).whole for mu in problem.scene.load.friction]
    seconds = math.fsum(variants.forecast(w, n) for w in dict.fromkeys(wholes) for n in least)
    spent = spent_seconds(variants)
    if spent + seconds <= problem.time:
        return finite
    flowing = dict.fromkeys(variant for split in splits for variant in split.wholes)
    time = spent + seconds
    finer = GROWTH_OF_TIME * variants.expected_of(refined.levels, flowing)
    for _ in range(refined.levels, min(most_effect_levels(problem), len(variants.of_scene.levels))):
        if spent + finer <= time:  # the time allows this level at small strains, too
            spent, time, finer = spent + finer, time + finer, GROWTH_OF_TIME * finer
    more = with_unit(seconds, "s", 2)
    why = f"{SMALL_STRAINS}: finite ones take {more} more (budget.time)"
    return replace(selection.without(frozenset({"finite_strain"}), why), time=time)


def _took(
    splits: Iterable[SplitVariants], variants: SolvedVariants
) -> dict[str, tuple[float, int]]:
    """Of each effect by itself and of the whole, of all friction coefficients together."""
    wanted: dict[str, dict[ModelVariant, None]] = {}
    for split in splits:
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
    selection, variants = selected_effects(solved, couplings), SolvedVariants(solved, tasks)
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
    again += [variant for split in splits for variant in split.held_nearer.values()]
    most = min(most_effect_levels(problem), len(half_plane.levels))
    if FLOW in selection.added:
        most = min(most, LEAST_LEVELS)  # further ones take long, and will hardly be wanted

    def announce(splitting: int, further: int) -> None:
        variants.announce(again, 1, splitting)
        for number in range(1, most + 1):
            is_further = number > LEAST_LEVELS
            variants.announce(wholes, number, further if is_further else LATER)
            variants.announce(() if is_further else every, number, splitting)

    announce(LAST, PERHAPS)
    announce_sampling(solved, tasks)
    return partial(announce, LATER, LATER)


def selected_effects(
    solved: Solved, couplings: tuple[Coupling, ...], known: Mapping[str, Sizes] = {}
) -> EffectSelection:
    """As the half-plane selects them, and what is `known` of effects that were computed."""
    finest = (case.runs["half_plane"].finest for case in solved.cases)
    pressure = max((level.solution.pressure for level in finest), key=np.max)
    problem, patches, no_time = solved.problem, solved.runs["half_plane"].levels[0].patches, None
    flow, peak = flow_assessment(solved), float(pressure.max())
    # by the laws of cost, of the levels that flow takes and of the scene's own finite elements
    if not why_not(FLOW, problem) and time_with_flow(problem, solved.plan, patches) > problem.time:
        more = with_unit(flow_seconds(problem, patches), "s", 2)
        no_time = f"it takes {more} more (budget.time)"
    selection = select_effects(
        *(problem, peak, couplings, mean_pressure(pressure)),
        shear=flow.least_shear,
        known=known,
        no_time=no_time,
    )
    asked = problem.scene.budget.effects
    if not solved.plan.effects:
        computed = {LAW} if selection.laws else set()  # beside the added
        left_out = selection.added | computed | set(selection.impossible) - (set(UNKNOWN) - {LAW})
        return selection.without(left_out, "not asked for (budget.effects)")
    flows = flow.beyond_doubt and FLOW not in selection.added | selection.found
    # it flows, too, where nothing says how far
    flows = flows or any(map(math.isinf, selection.estimates.get(FLOW, {}).values()))
    if asked != "all" and flows:
        why = f"the body flows, an elastic one cannot hold ({ASKED})"
        return selection.without(selection.added, why)
    return selection


def mean_pressure(pressure: np.ndarray) -> float:
    """[Pa] that the load stands under on average, by equal elements."""
    return float(pressure @ pressure / pressure.sum())


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


def _given_up(
    selection: EffectSelection, splits: Iterable[SplitVariants], solved: SolvedVariants
) -> frozenset[str]:
    """The added effects to leave out where the whole has no solution: those that have none by
    themselves, else finite deformation, else all."""
    failed = {variant for variant, _ in solved.failed}
    alone = {
        name for split in splits for name, (with_it, _) in split.pairs.items() if with_it in failed
    }
    for fewer in (alone, {"finite_strain"}):
        if selection.added & fewer:
            return selection.added & fewer
    return selection.added
