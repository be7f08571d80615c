"""A layer or a coating by two independent models: the analytic operator and finite elements.

In: finite elements of a layered scene, which keep all else that the half-plane assumes. Out: the
operator's figures, and a judged difference a quantity, (operator - finite elements) / finite
elements, of one problem. It stands in the place of the half-plane's comparison, whose difference is
what the layer does."""

from collections.abc import Mapping
from dataclasses import replace

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Figure, Findings
from comparisons.figures.quantity import COMPARED, QUANTITIES
from comparisons.judging.comparison import differences_of, norms_of
from comparisons.judging.contact import uncertainties, values_of
from comparisons.judging.effects.catalogue import contained
from comparisons.judging.ladder.rungs import OPERATORS, OTHER, operator_runs
from comparisons.judging.study import LAYERED, Solved, Study
from comparisons.models.analytic import why_no_stresses
from comparisons.models.operators import LAYERS, is_layered


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    runs, figures = operator_runs(solved, contained(solved.problem.scene), tasks), []
    for case in solved.cases if runs else ():
        run, problem, finite_elements = runs[case.friction], case.problem, case.runs[OTHER]
        stated = uncertainties(run, problem)
        for name, value in values_of(run.finest, problem).items():
            at, size = case.at, abs(value) or QUANTITIES[name].scale(problem.hertz)
            figures.append(
                Figure(LAYERED, name, OPERATORS, value, at, scale=size, uncertainty=stated[name])
            )
        rows = [*differences_of(run, finite_elements, case).values()]
        rows += norms_of(run, finite_elements, case, solved.window)
        figures += [replace(row, study=LAYERED, source=OPERATORS) for row in rows]
    return Findings(tuple(figures))


def applies(solved: Solved) -> bool:
    """Whether the scene's finite elements have layers and nothing else that no half-plane has."""
    scene = solved.problem.scene
    alike = contained(scene) <= LAYERS and scene.body.width is None and not scene.periodic
    possible = why_no_stresses(solved.problem, solved.window) is None
    return bool(solved.plan.compares and is_layered(scene) and alike and possible)


STUDY = Study(LAYERED, COMPARED, solve, applies=applies)
