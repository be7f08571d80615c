"""The half-plane against the finite elements on the same pressure elements.

In: solved levels of both models. Out: a judged figure a quantity and friction coefficient,
(half-plane - finite elements) / finite elements, and plain ones, the relative L2 norms of the
pressures' difference and of that of tau1 on the common window."""

from collections.abc import Iterator, Mapping

from comparisons.figures.figure import Figure, Findings
from comparisons.figures.quantity import COMPARED
from comparisons.judging.rule import COMPARISON as NAME
from comparisons.judging.rule import judged, norms_of
from comparisons.judging.study import Case, Solved, Study
from comparisons.models.level import Solution

SHOWN = 2.0 / 3.0  # of the uncertainty that a figure which is shown may have: a difference's own


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """Every quantity and norm, in the order of friction."""
    cases = solved.cases
    return Findings(
        tuple(f for case in cases for f in differences(case, case.runs["half_plane"], solved))
    )


def differences(case: Case, model: Solution, solved: Solved) -> Iterator[Figure]:
    """Those of an analytic model from the finite elements of a case, and their norms."""
    elements = case.runs["finite_element"]
    yield from judged(model, case.problem, elements).values()
    yield from norms_of(model, case.problem, elements)


def discretisations(case: Case) -> dict[str, float]:
    """The discretisation uncertainty that refinement is to lower: the difference's, which is
    judged, or SHOWN times a model's own, whose figures are shown, where that is larger; of one
    model alone its own. Not the sum: what the pressure elements leave out cancels."""
    models = list(case.runs.values())
    alone = [_left(judged(model, case.problem)) for model in models]
    if len(models) == 1:
        return alone[0]
    apart = _left(judged(models[0], case.problem, models[1]))
    return {n: max(size, *(SHOWN * of[n] for of in alone)) for n, size in apart.items()}


def _left(figures: Mapping[str, Figure]) -> dict[str, float]:
    return {name: figure.uncertainty.parts["discretisation"] for name, figure in figures.items()}


STUDY = Study(NAME, COMPARED, solve, applies=lambda solved: solved.plan.compares)
