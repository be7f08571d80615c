"""The half-plane's model error: what separates it from finite elements with every effect.

In: the comparison of both models, the couplings. Out: a judged figure a quantity, its effects, and
the whole model's levels. The effects begin as soon as the half-plane is solved, whose result is
said then, beside estimates of what it leaves out."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

from comparisons.common.numbers import with_unit
from comparisons.common.progress import Early
from comparisons.common.tasks import LAST, LATER, PERHAPS, Tasks
from comparisons.figures.figure import Column, Findings, Series, Statement
from comparisons.figures.quantity import MAIN, QUANTITIES, WHOLE
from comparisons.judging.coupling import Coupling, coupled
from comparisons.judging.effects.catalogue import EFFECTS, FLOW, estimates
from comparisons.judging.effects.estimates import Shown
from comparisons.judging.effects.laws import trust
from comparisons.judging.effects.sampling import announce_sampling
from comparisons.judging.effects.selection import effects_of_run
from comparisons.judging.model_error import show
from comparisons.judging.model_error.error_budget import error_budget
from comparisons.judging.model_error.refinement import LEAST_LEVELS, EffectRefinement, ErrorBudget
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
    budget = error_budget(solved, before[COMPARISON].figures, tasks)
    return findings_of(budget, solved.problem)


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
