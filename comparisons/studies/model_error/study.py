"""The half-plane's model error: what separates it from finite elements with every effect.

In: the comparison of both models, the couplings. Out: a judged figure a quantity, its effects, and
the whole model's levels. The effects begin as soon as the half-plane is solved."""

from collections.abc import Callable, Mapping

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Findings
from comparisons.figures.quantity import QUANTITIES
from comparisons.studies import comparison
from comparisons.studies.friction import coupling
from comparisons.studies.model_error import show
from comparisons.studies.model_error.account import NAME, findings_of
from comparisons.studies.model_error.error_budget import (
    ErrorBudget,
    announce_effects,
    error_budget,
)
from comparisons.studies.study import Solved, Study


def begin(solved: Solved, tasks: Tasks) -> None:
    """Announce the effects once the half-plane is solved; with the finite elements beside it, which
    then leave a figure open, the whole model's further levels, too."""
    if "half_plane" in solved.runs:
        more = tasks.held(NAME, NAME, lambda: _announced(solved, tasks))
        if "finite_element" in solved.runs:
            more()


def _announced(solved: Solved, tasks: Tasks) -> Callable[[], None]:
    moved = coupling.coupled(solved, tasks).changes if solved.plan.coupling else ()
    return announce_effects(solved, moved, tasks)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    moved = before[coupling.NAME].data.changes if coupling.NAME in before else ()
    budget = error_budget(solved, before[comparison.NAME].figures, moved, tasks)
    return findings_of(budget, solved.problem)


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: solved.plan.compares,
    begin=begin,
    data=ErrorBudget,
    blocks=show.blocks,
    pictures={"model_error": show.model_error_picture},
    lines=show.lines,
)
