"""The half-plane's model error: what separates it from finite elements with every effect.

In: the comparison of both models, the couplings. Out: a judged figure a quantity, its effects, and
the whole model's levels. The effects begin as soon as the half-plane is solved, whose result is
said then, beside estimates of what it leaves out.

What cannot change a verdict is left out, unless budget.effects is "all":

1. The effects beside the scene's own finite elements, where every judged figure agrees or differs
   by the first comparison already, even if these change it by the sum of all their estimates.
2. The whole model's third level, where every judged figure holds, fails, or remains inconclusive by
   what is not modelled, wherever in its uncertainty on the second level the error comes to lie.

The model error and its uncertainty are stated for every figure in any case."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

from comparisons.common.numbers import with_unit
from comparisons.common.progress import Early
from comparisons.common.tasks import LAST, LATER, PERHAPS, Tasks
from comparisons.figures.figure import Column, Figure, Findings, Part, Series, Statement, is_decided
from comparisons.figures.quantity import MAIN, QUANTITIES, WHOLE
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
    estimates,
)
from comparisons.judging.effects.estimates import Shown, Sizes, finite_flow, law_of_elasticity
from comparisons.judging.effects.laws import trust
from comparisons.judging.effects.sampling import announce_sampling, sampling_estimate
from comparisons.judging.effects.selection import (
    ASKED,
    EffectSelection,
    effects_of_run,
    is_negligible,
    selected_effects,
)
from comparisons.judging.model_error import show
from comparisons.judging.model_error.model_error import INTERACTION, JUMP, split_variants
from comparisons.judging.model_error.refinement import (
    GROWTH_OF_TIME,
    LEAST_LEVELS,
    EffectRefinement,
    ErrorBudget,
    NotComputedError,
)
from comparisons.judging.model_error.show import TRUST
from comparisons.judging.rule import values_of
from comparisons.judging.study import COMPARISON, Solved, Study
from comparisons.judging.study import MODEL_ERROR as NAME
from comparisons.judging.yielding import flow_assessment
from comparisons.models.level import Level
from comparisons.models.problem import Problem


def begin(solved: Solved, tasks: Tasks) -> None:
    """Announce the effects once the half-plane is solved, and say what it finds; with the finite
    elements beside it, which then leave a figure open, the whole model's further levels, too."""
    if "half_plane" in solved.runs:
        more = tasks.held(NAME, NAME, lambda: _announced(solved, tasks))
        if "finite_element" in solved.runs:
            more()


def selection_lines(solved: Solved, tasks: Tasks) -> list[str]:
    """Effects that a run of both models will compute, and which matter and cannot be, as the
    half-plane selects them."""
    if not solved.plan.compares:
        return []
    selection = effects_of_run(solved, tasks)
    account = {name: selection.account(name) for name in EFFECTS}
    flows = flow_assessment(solved).at_such_stresses
    lines = [f"flow: {flows}"] if flows else []
    for status in ("computed", "not computed"):
        names = [name for name, (what, _) in account.items() if what == status]
        why = {name: f" ({account[name][1]})" if status != "computed" else "" for name in names}
        named = ", ".join(f"{EFFECTS[name].label}{why[name]}" for name in names)
        lines += [f"effects {status}: {named}"] if named else []
    return lines


def _announced(solved: Solved, tasks: Tasks) -> Callable[[], None]:
    """Add to the tasks what `error_budget` will ask for, as the half-plane on the levels that the
    scene asks for selects it: it may begin before the finite elements are done. Should a finer
    half-plane select other effects, these are solved then.

    Call what is returned once the scene's own finite elements leave a figure open on the least
    levels. The whole model will leave it open, too: its further level need not wait, and a process
    stays with the bodies of one level."""
    selection = effects_of_run(solved, tasks)
    effects = EffectRefinement(solved, tasks, selection)
    most = effects.most_levels
    if FLOW in selection.added:
        most = min(most, LEAST_LEVELS)  # further ones take long, and will hardly be wanted
    effects.announce_all(LAST, most, PERHAPS)
    announce_sampling(solved, tasks)
    case, moved = max(solved.cases, key=lambda case: case.friction), coupled(solved, tasks)
    for line in early_lines(case.problem, case.runs["half_plane"].finest, moved):
        tasks.callback(Early(line))
    return partial(effects.announce_all, LATER, most)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    return findings_of(error_budget(solved, before[COMPARISON].figures, tasks), solved.problem)


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
                least = effects.budget(LEAST_LEVELS)
                if (flow := _idle_flow(least, scene.tolerances)) is not None:
                    selection = selected_effects(solved, coupled(solved, tasks), {FLOW: flow})
                    continue
            found = effects.budget()
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
    how = {"study": NAME, "against": WHOLE, "bounds": None, "levels": ()}
    return replace(row, uncertainty=sure, parts=(Part(INTERACTION, 0.0), Part(JUMP, 0.0)), **how)


def _idle_flow(budget: ErrorBudget, tolerances: Mapping[str, float]) -> Sizes | None:
    """Change by flow, alone and with the other effects, where it moves no judged figure by a share
    of its tolerance that matters: the whole model then does not flow. Nothing where the
    wholes have no plastic strain; else None."""
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
    shown = Shown.by(*(level.solution.pressure for level in budget.wholes))
    tolerances = problem.scene.tolerances
    if selection.impossible.get(LAW) == ITS_OWN_LAW:
        sizes = law_of_elasticity(problem, shown)
        selection = selection.estimated(LAW, sizes, ITS_OWN_LAW, tolerances)
    if selection.impossible.get(FINITE) == SMALL_STRAINS and strains:
        sizes = finite_flow(problem, shown, max(strains))
        selection = selection.estimated(FINITE, sizes, SMALL_STRAINS, tolerances)
    if selection.impossible.get(FINITE) != SMALL_STRAINS:
        return selection
    impossible = {name: why for name, why in selection.impossible.items() if name != FINITE}
    finite = replace(selection, added=selection.added | {FINITE}, impossible=impossible)
    asked = problem.scene.budget.effects
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
    time, finer = spent + seconds, effects.finer(budget.levels)
    for _ in range(budget.levels, effects.most_levels):
        if spent + finer <= time:  # the time allows this level at small strains, too
            spent, time, finer = spent + finer, time + finer, GROWTH_OF_TIME * finer
    more = with_unit(seconds, "s", 2)
    why = f"{SMALL_STRAINS}: finite ones take {more} more (budget.time)"
    return replace(selection.without(frozenset({FINITE}), why), time=time)


def _is_decided(rows: tuple[Figure, ...], selection: EffectSelection) -> bool:
    """Whether every judged row agrees or differs whatever the effects do that its finite elements
    do not have."""
    missing = [sizes for n, sizes in selection.estimates.items() if n not in selection.contained]

    def decided(row: Figure) -> bool:
        size = sum(sizes.get(row.quantity, 0.0) for sizes in missing)
        return is_decided(row.value, row.numerical, size, row.tolerance)

    return all(decided(row) for row in rows if row.tolerance is not None)


def _given_up(effects: EffectRefinement) -> frozenset[str]:
    """The added effects to leave out where the whole model has no solution: those that have none by
    themselves, else finite deformation, else all."""
    failed, added = {variant for variant, _ in effects.failed}, effects.selection.added
    pairs = [pair for split in effects.splits for pair in split.pairs.items()]
    alone = {name for name, (with_it, _) in pairs if with_it in failed}
    return next(filter(None, (added & alone, added & {FINITE})), added)


def findings_of(budget: ErrorBudget, problem: Problem) -> Findings:
    """The model errors of a finished comparison, and what became of every effect."""
    account = {name: budget.selection.account(name) for name in EFFECTS}
    columns = {
        "effect": Column(tuple(account)),
        "status": Column(tuple(status for status, _ in account.values())),
        "because": Column(tuple(why for _, why in account.values())),
    }
    for quantity in QUANTITIES:
        sizes = [budget.selection.estimates.get(name, {}).get(quantity) for name in EFFECTS]
        columns[quantity] = Column(tuple(None if size == math.inf else size for size in sizes))
    cost = {"levels": Column((budget.levels,)), "seconds": Column((budget.seconds,), "s")}
    series = (
        Series("effects", columns, is_account=True),
        Series("cost", cost, WHOLE, is_account=True),
    )
    said = {"not split": budget.unsplit, "left out": budget.left_out}
    if "finite_strain" in budget.selection.whole and budget.wholes:
        frictions = problem.scene.load.friction
        said[TRUST] = trust(problem, budget.wholes[frictions.index(max(frictions))])
    statements = tuple(Statement(name, text) for name, text in said.items() if text is not None)
    return Findings(budget.figures(problem.scene.tolerances), series, statements, budget)


def early_lines(
    problem: Problem, level: Level, couplings: tuple[Coupling, ...] = ()
) -> tuple[str, str]:
    """The half-plane's figures on a level, and what it may leave out, by estimates: these are
    larger than what they stand for, and no verdict.

    couplings  of the half-plane, where they are known"""
    scene, known = problem.scene, values_of(level, problem)
    figures = {name: known[name] for name in MAIN if name in known}
    said = [
        f"{QUANTITIES[name].short} {with_unit(value, QUANTITIES[name].unit)}"
        for name, value in figures.items()
    ]
    # half-planes do not flow, though the scene's finite elements may
    flow = False if scene.finite_element.plastic is False else None
    elastic = replace(problem, scene=scene.unchecked({"finite_element.plastic": flow}))
    sizes = estimates(elastic, Shown.by(level.solution.pressure, couplings=couplings))
    left = []
    for name in figures:
        total = sum(of.get(name, 0.0) for of in sizes.values())
        size = f"{100.0 * total:.2g} %" if total < 1.0 else "100 % or more"
        left.append(f"{QUANTITIES[name].short} {size}")
    most = max(sizes, key=lambda effect: max(sizes[effect].get(name, 0.0) for name in figures))
    return (
        f"half-plane: {', '.join(said)}",
        f"left out, by estimates at most: {', '.join(left)}, mostly {EFFECTS[most].label}",
    )


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: solved.plan.compares,
    begin=begin,
    blocks=show.blocks,
    pictures={"model_error": show.model_error_picture},
    lines=show.lines,
)
