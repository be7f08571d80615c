"""An analytic model against the finite elements on the same pressure elements.

In: solved levels of both models. Out: a judged figure a quantity and friction coefficient,
(model - finite elements) / finite elements, and plain ones, the relative L2 norms of the pressures'
difference and of that of tau1 on the common window.

The model is the half-plane. Of a layer or a coating it is also the analytic operator, beside finite
elements that keep all else that the half-plane assumes: two independent models of one problem,
which stand in for the half-plane's comparison, whose difference is what the layer does."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Figure, Findings
from comparisons.figures.quantity import COMPARED
from comparisons.judging.effects.catalogue import contained
from comparisons.judging.ladder.candidates import solutions, why_no_stresses
from comparisons.judging.rule import judged, norms_of
from comparisons.judging.study import COMPARISON, LAYERED, Case, Solved, Study
from comparisons.models.level import Solution
from comparisons.models.operators import LAYERS, is_layered

SHOWN = 2.0 / 3.0  # of the uncertainty that a figure which is shown may have: a difference's own


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """Every quantity and norm, in the order of friction."""
    cases = solved.cases
    return Findings(tuple(f for case in cases for f in _differences(case, case.runs["half_plane"])))


def solve_layered(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    """The operator's own figures, and the same of it; nothing where it has no solution."""
    runs, figures = solutions(solved, contained(solved.problem.scene), tasks), []
    for case in solved.cases if runs else ():
        run = runs[case.friction]
        own = (replace(figure, levels=()) for figure in judged(run, case.problem).values())
        figures += (replace(f, study=LAYERED) for f in (*own, *_differences(case, run)))
    return Findings(tuple(figures))


def _differences(case: Case, model: Solution) -> Iterator[Figure]:
    """Differences of an analytic model from the finite elements of a case, and their norms."""
    elements = case.runs["finite_element"]
    yield from judged(model, case.problem, elements).values()
    yield from norms_of(model, case.problem, elements)


def is_of_layers(solved: Solved) -> bool:
    """Whether the scene's finite elements have layers and nothing else that no half-plane has."""
    scene = solved.problem.scene
    alike = contained(scene) <= LAYERS and scene.body.width is None and not scene.periodic
    possible = why_no_stresses(solved.problem) is None
    return bool(solved.plan.compares and is_layered(scene) and alike and possible)


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


STUDY = Study(COMPARISON, COMPARED, solve, applies=lambda solved: solved.plan.compares)
LAYERED_STUDY = Study(LAYERED, COMPARED, solve_layered, applies=is_of_layers)
