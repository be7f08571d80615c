"""Which model suffices: the cheapest whose every judged error holds against the whole.

In: the error budget of a finished comparison. Out: a judged figure a rung, quantity and friction
coefficient; what each rung took; which one suffices, and the assumption worth dropping next."""

from collections.abc import Mapping, Sequence

from comparisons.figures.figure import Column, Figure, Findings, Series, Statement
from comparisons.figures.quantity import WHOLE
from comparisons.studies import comparison
from comparisons.studies.ladder import show
from comparisons.studies.ladder.rungs import HALF_PLANE, Rung, of_budget
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.study import LADDER, MODEL_ERROR, WHY_NOT, Solved, Study
from comparisons.studies.subsurface import yielding


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    budget = before[MODEL_ERROR].data
    if not budget.solutions:
        why = budget.unsplit or "the whole model has no solution"
        return Findings(statements=(Statement(WHY_NOT, why),))
    rungs = of_budget(solved, budget, before[comparison.NAME].figures)
    flows = before[yielding.NAME].said(yielding.BEYOND_DOUBT)
    figures = tuple(figure for rung in rungs for figure in rung.figures)
    columns = {
        "rung": Column(tuple(rung.name for rung in rungs)),
        "model": Column(tuple(rung.words for rung in rungs)),
        "seconds": Column(tuple(rung.seconds for rung in rungs), "s"),
        "peak_memory": Column(tuple(rung.memory for rung in rungs), "byte"),
    }
    series = (Series(show.RUNGS, columns, is_account=True),)
    return Findings(figures, series, tuple(_statements(rungs, before[MODEL_ERROR], flows)))


def _statements(rungs: Sequence[Rung], errors: Findings, flows: str | None) -> list[Statement]:
    holding = [] if flows else [rung for rung in rungs if rung.verdict == "holds"]
    half_plane = next(rung for rung in rungs if rung.name == HALF_PLANE)
    said = []
    if flows:
        said.append(Statement(show.NONE, "flow"))
    elif holding:
        said.append(Statement(show.SUFFICES, holding[0].name))
    elif rungs[-1].verdict == "inconclusive":
        said.append(Statement(show.NONE, "the whole model is not known to the tolerance"))
    dearer = rungs[rungs.index(half_plane) + 1 :]
    possible = [rung.name for rung in (*holding, *dearer) if rung.verdict != "fails"]
    if half_plane.verdict != "holds" and not flows and possible:
        said.append(Statement(show.ESCALATE_TO, possible[0]))
        if (assumption := _worth_dropping(errors)) is not None:
            said.append(Statement(show.NEXT, assumption))
    return said


def _worth_dropping(errors: Findings) -> str | None:
    """The effect that the half-plane's worst judged error is mostly made of."""
    judged = [f for f in errors.figures if f.against == WHOLE and f.bounds is not None]
    worst = max(judged, key=_reach)
    sizes = {part.name: abs(part.value) for part in worst.parts if part.name in EFFECTS}
    sizes |= {name: size for name, size in worst.unknown.items() if name in EFFECTS}
    return max(sizes, key=sizes.get, default=None)


def _reach(figure: Figure) -> float:
    """How far an error may lie, over its tolerance."""
    return (abs(figure.value) + figure.total) / figure.tolerance


STUDY = Study(
    name=LADDER,
    quantities=comparison.QUANTITIES,
    solve=solve,
    applies=lambda solved: solved.plan.compares and bool(solved.problem.scene.tolerances),
    blocks=show.blocks,
    lines=show.lines,
)
