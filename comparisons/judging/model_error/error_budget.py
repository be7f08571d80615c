"""The error budget of a finished comparison: the model error by effects, and the trace's sampling.

What cannot change a verdict is left out, unless budget.effects is "all":

1. The effects beside the scene's own finite elements, where every judged figure agrees or differs
   by the first comparison already, even if these change it by the sum of all their estimates.
2. The whole's third level, where every judged figure holds, fails, or remains inconclusive by what
   is not modelled, wherever in its uncertainty on the second level the error comes to lie.

The model error and its uncertainty are stated for every figure in any case."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from comparisons.common.numbers import with_unit
from comparisons.common.tasks import LAST, LATER, PERHAPS, Tasks
from comparisons.figures.figure import Figure, Part, is_decided
from comparisons.figures.quantity import QUANTITIES, WHOLE
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.coupling import Coupling, coupled
from comparisons.judging.effects.catalogue import (
    EFFECTS,
    FINITE,
    FLOW,
    ITS_OWN_LAW,
    LAW,
    SAMPLING,
    SMALL_STRAINS,
    UNKNOWN,
    why_not,
)
from comparisons.judging.effects.estimates import (
    Shown,
    Sizes,
    finite_flow,
    law_of_elasticity,
    mean_pressure,
)
from comparisons.judging.effects.sampling import announce_sampling, sampling_estimate
from comparisons.judging.effects.selection import EffectSelection, is_negligible, select_effects
from comparisons.judging.model_error.contributions import NotComputedError, split_variants
from comparisons.judging.model_error.model_error import INTERACTION, JUMP
from comparisons.judging.model_error.refinement import (
    ASKED,
    GROWTH_OF_TIME,
    LEAST_LEVELS,
    MOST_LEVELS,
    EffectRefinement,
    ErrorBudget,
)
from comparisons.judging.study import MODEL_ERROR, Solved
from comparisons.judging.yielding import flow_assessment
from comparisons.models.plan import flow_seconds, time_with_flow


def error_budget(solved: Solved, rows: tuple[Figure, ...], tasks: Tasks) -> ErrorBudget:
    """Select the effects that may matter, solve them, and split the difference of the models. An
    effect that cannot be solved is not modelled: its estimate and the reason are kept.

    rows  the comparison of the solved models; its norms are figures of none"""
    rows = tuple(row for row in rows if row.quantity in QUANTITIES)
    scene, selection = solved.problem.scene, effects_of_run(solved, tasks)
    is_frugal = scene.budget.effects != "all"
    is_open = FLOW in selection.added or not _is_decided(rows, selection)
    if is_frugal and selection.added and not is_open:
        selection = selection.without(selection.added, f"cannot change a verdict ({ASKED})")
    effects, budget = EffectRefinement(solved, tasks, selection, rows), None
    while budget is None:
        effects.select(selection)
        try:
            if FLOW in selection.added:
                least = effects.budget(LEAST_LEVELS, is_frugal=False)
                if (flow := _idle_flow(least, scene.tolerances)) is not None:
                    selection = selected_effects(solved, coupled(solved, tasks), {FLOW: flow})
                    continue
            found = effects.budget(MOST_LEVELS, is_frugal)
        except NotComputedError as error:
            if dropped := _given_up(effects):
                selection = selection.without(dropped, str(error))
                continue
            # what the scene itself has cannot be taken apart
            wholes = tuple(case.runs["finite_element"].finest for case in solved.cases)
            budget = ErrorBudget(selection, 0, str(error), tuple(map(_unsplit, rows)), wholes)
        else:
            selection = _of_what_flows(found, effects)
            budget = None if selection.added - found.selection.added else found
    if scene.profile is not None:
        known = sampling_estimate(solved, tasks)
        selection = selection.estimated(SAMPLING, *known, scene.tolerances)
    return replace(budget, selection=selection, took=effects.took)


def _unsplit(row: Figure) -> Figure:
    """A difference of the models as it is."""
    sure = Uncertainty({"numerical": row.numerical})
    how = {"study": MODEL_ERROR, "against": WHOLE, "bounds": None, "levels": ()}
    return replace(row, uncertainty=sure, parts=(Part(INTERACTION, 0.0), Part(JUMP, 0.0)), **how)


def _idle_flow(budget: ErrorBudget, tolerances: Mapping[str, float]) -> Sizes | None:
    """What flow changes, by itself and with the other effects, where that moves no judged figure by
    a share of its tolerance that matters: the whole is then one that does not flow. Nothing where
    the wholes have no plastic strain; else None."""
    if all(level.plastic_strain == 0.0 for level in budget.wholes):
        return {}
    sizes: dict[str, float] = {}
    for error in budget.model_errors:
        flow = error.part(FLOW)
        if flow is None:
            return None
        effects = [part for part in error.parts if part.name in EFFECTS]
        joint = abs(error.part(INTERACTION).value) if len(effects) > 1 else 0.0
        size = abs(flow.value) + flow.uncertainty + joint
        sizes[error.quantity] = max(size, sizes.get(error.quantity, 0.0))
    return sizes if is_negligible(sizes, tolerances) else None


def _of_what_flows(budget: ErrorBudget, effects: EffectRefinement) -> EffectSelection:
    """The selection with the estimates of finite deformation and of the law of elasticity by the
    pressures of wholes that flow, and by their plastic strains where their fields show these; with
    finite deformation where that matters, may decide a verdict, and the time allows it by the laws
    of cost; else with the reason why not."""
    problem, selection = effects.problem, budget.selection
    strains = [s for level in budget.wholes if (s := level.plastic_strain) is not None]
    pressures = [level.solution.pressure for level in budget.wholes]
    shown = Shown(max(map(np.max, pressures)), max(map(mean_pressure, pressures)))
    tolerances = problem.scene.tolerances
    if selection.impossible.get(LAW) == ITS_OWN_LAW:
        sizes = law_of_elasticity(problem, shown)
        selection = selection.estimated(LAW, sizes, ITS_OWN_LAW, tolerances)
    if selection.impossible.get(FINITE) == SMALL_STRAINS and strains:
        sizes = finite_flow(problem, shown, max(strains))
        selection = selection.estimated(FINITE, sizes, SMALL_STRAINS, tolerances)
    if selection.impossible.get(FINITE) != SMALL_STRAINS:
        return selection
    asked, finite = problem.scene.budget.effects, selection.flowing_finitely()
    # what its law of elasticity may change stays, and decides nothing of this
    others = {name: sizes for name, sizes in selection.estimates.items() if name != LAW}
    known = replace(budget, selection=replace(selection, estimates=others)).figures(tolerances)
    # at the least tolerance at which a run holds it is as open as here
    open_figures = (f for f in known if f.bounds and f.verdict == "inconclusive")
    if not asked or (asked != "all" and all(figure.is_unresolved for figure in open_figures)):
        why = f"cannot change a verdict ({ASKED})" if asked else "not asked for (budget.effects)"
        return selection.without(frozenset({FINITE}), f"{SMALL_STRAINS}: {why}")
    wholes = [split_variants(problem, finite, mu).whole for mu in problem.scene.load.friction]
    least = range(1, LEAST_LEVELS + 1)
    seconds = math.fsum(effects.forecast(w, n) for w in dict.fromkeys(wholes) for n in least)
    spent = effects.spent()
    if spent + seconds <= problem.time:
        return finite
    time, most = spent + seconds, min(effects.most_levels, len(effects.own_levels))
    finer = effects.finer(budget.levels)
    for _ in range(budget.levels, most):
        if spent + finer <= time:  # the time allows this level at small strains, too
            spent, time, finer = spent + finer, time + finer, GROWTH_OF_TIME * finer
    more = with_unit(seconds, "s", 2)
    why = f"{SMALL_STRAINS}: finite ones take {more} more (budget.time)"
    return replace(selection.without(frozenset({FINITE}), why), time=time)


def announce_effects(solved: Solved, tasks: Tasks) -> Callable[[], None]:
    """Add to the tasks what `error_budget` will ask for, as the half-plane on the levels that the
    scene asks for selects it: it may begin before the finite elements are done. Should a finer
    half-plane select other effects, these are solved then.

    Call what is returned once the scene's own finite elements leave a figure open on the least
    levels. The whole will leave it open, too: its further level need not wait, and a process stays
    with the bodies of one level."""
    selection = effects_of_run(solved, tasks)
    effects = EffectRefinement(solved, tasks, selection)
    most = min(effects.most_levels, len(solved.runs["half_plane"].levels))
    if FLOW in selection.added:
        most = min(most, LEAST_LEVELS)  # further ones take long, and will hardly be wanted
    effects.announce_all(LAST, most, PERHAPS)
    announce_sampling(solved, tasks)
    return partial(effects.announce_all, LATER, most)


def effects_of_run(solved: Solved, tasks: Tasks) -> EffectSelection:
    """As the half-plane selects them as far as it is refined, decided once."""
    levels = len(solved.runs["half_plane"].levels)
    return tasks.held("effects", levels, lambda: selected_effects(solved, coupled(solved, tasks)))


def selected_effects(
    solved: Solved, couplings: tuple[Coupling, ...], known: Mapping[str, Sizes] = {}
) -> EffectSelection:
    """As the half-plane selects them, and what is `known` of effects that were computed."""
    finest = (case.runs["half_plane"].finest for case in solved.cases)
    pressure = max((level.solution.pressure for level in finest), key=np.max)
    problem, patches, no_time = solved.problem, solved.runs["half_plane"].levels[0].patches, None
    flow = flow_assessment(solved)
    # by the laws of cost, of the levels that flow takes and of the scene's own finite elements
    if not why_not(FLOW, problem) and time_with_flow(problem, patches) > problem.time:
        more = with_unit(flow_seconds(problem, patches), "s", 2)
        no_time = f"it takes {more} more (budget.time)"
    mean = mean_pressure(pressure)
    shown = Shown(float(pressure.max()), mean, couplings, flow.least_shear)
    selection = select_effects(problem, shown, known, no_time)
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


def _is_decided(rows: tuple[Figure, ...], selection: EffectSelection) -> bool:
    """Whether every judged row agrees or differs whatever the effects do that its finite elements
    do not have."""
    missing = [sizes for n, sizes in selection.estimates.items() if n not in selection.contained]

    def decided(row: Figure) -> bool:
        size = sum(sizes.get(row.quantity, 0.0) for sizes in missing)
        return is_decided(row.value, row.numerical, size, row.tolerance)

    return all(decided(row) for row in rows if row.tolerance is not None)


def _given_up(effects: EffectRefinement) -> frozenset[str]:
    """The added effects to leave out where the whole has no solution: those that have none by
    themselves, else finite deformation, else all."""
    failed, added = {variant for variant, _ in effects.failed}, effects.selection.added
    pairs = [pair for split in effects.splits for pair in split.pairs.items()]
    alone = {name for name, (with_it, _) in pairs if with_it in failed}
    return next(filter(None, (added & alone, added & {FINITE})), added)
