"""A layer or a coating by two independent models: the analytic operator and finite elements.

In: finite elements of a layered scene, which keep all else that the half-plane assumes. Out: the
operator's figures, and a judged difference a quantity, (operator - finite elements) / finite
elements, of one problem. It stands in the place of the half-plane's comparison, whose difference is
what the layer does."""

from collections.abc import Mapping
from dataclasses import replace

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Findings
from comparisons.figures.quantity import COMPARED
from comparisons.judging.comparison import differences
from comparisons.judging.effects.catalogue import contained
from comparisons.judging.ladder.candidates import why_no_stresses
from comparisons.judging.ladder.rungs import operator_runs
from comparisons.judging.rule import judged
from comparisons.judging.study import LAYERED, Solved, Study
from comparisons.models.operators import LAYERS, is_layered


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    runs, figures = operator_runs(solved, contained(solved.problem.scene), tasks), []
    for case in solved.cases if runs else ():
        run = runs[case.friction]
        own = (replace(figure, levels=()) for figure in judged(run, case.problem).values())
        figures += (replace(f, study=LAYERED) for f in (*own, *differences(case, run, solved)))
    return Findings(tuple(figures))


def applies(solved: Solved) -> bool:
    """Whether the scene's finite elements have layers and nothing else that no half-plane has."""
    scene = solved.problem.scene
    alike = contained(scene) <= LAYERS and scene.body.width is None and not scene.periodic
    possible = why_no_stresses(solved.problem) is None
    return bool(solved.plan.compares and is_layered(scene) and alike and possible)


STUDY = Study(LAYERED, COMPARED, solve, applies=applies)
