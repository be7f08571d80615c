"""Which model suffices: the cheapest whose every judged error holds against the whole.

In: the error budget of a finished comparison. Out: a judged figure a rung, quantity and friction
coefficient; what each rung took; which one suffices, and the assumption worth dropping next."""

from collections.abc import Mapping, Sequence

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Column, Findings, Series, Statement, nearest_to_tolerance
from comparisons.figures.quantity import QUANTITIES, WHOLE
from comparisons.judging import yielding
from comparisons.judging.effects.catalogue import EFFECTS
from comparisons.judging.ladder import candidates, show
from comparisons.judging.ladder.rungs import (
    HALF_PLANE,
    Rung,
    announce_operators,
    may_suffice,
    rungs,
)
from comparisons.judging.model_error.error_budget import effects_of_run
from comparisons.judging.study import LADDER, MODEL_ERROR, WHY_NOT, Solved, Study


def begin(solved: Solved, tasks: Tasks) -> None:
    """Announce the candidates that no finite elements refute, once the half-plane is solved, where
    the effects that this selects ask for them: they then wait for no finite elements."""
    if list(solved.runs) != [HALF_PLANE]:
        return
    whole = effects_of_run(solved, tasks).whole
    for candidate in candidates.CANDIDATES:
        held = candidate.carries(solved.problem, whole, 0.0)
        if held and not candidate.has_elements:
            announce_operators(solved, held, len(solved.problem.pitches), tasks)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    flow, budget = before[yielding.NAME].data, before[MODEL_ERROR].data
    if not budget.solutions:
        why = budget.unsplit or "the whole model has no solution"
        return Findings(statements=(Statement(WHY_NOT, why),))
    made = rungs(solved, budget, flow, tasks)
    figures = tuple(figure for rung in made for figure in rung.figures)
    columns = {
        "rung": Column(tuple(rung.name for rung in made)),
        "model": Column(tuple(rung.words for rung in made)),
        "seconds": Column(tuple(rung.seconds for rung in made), "s"),
        "peak_memory": Column(tuple(rung.memory for rung in made), "byte"),
    }
    series = (Series(show.RUNGS, columns, is_account=True),)
    said = _statements(made, before[MODEL_ERROR], flow.beyond_doubt)
    return Findings(figures, series, tuple(said))


def _statements(rungs: Sequence[Rung], errors: Findings, flows: str) -> list[Statement]:
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
    possible = [rung.name for rung in (*holding, *dearer) if may_suffice(rung.figures)]
    possible += [rungs[-1].name] * (rungs[-1].verdict != "fails")  # if none is known to that
    if half_plane.verdict != "holds" and not flows and possible:
        said.append(Statement(show.ESCALATE_TO, possible[0]))
        if (assumption := _worth_dropping(errors)) is not None:
            said.append(Statement(show.NEXT, assumption))
    return said


def _worth_dropping(errors: Findings) -> str | None:
    """The effect that the half-plane's worst judged error is mostly made of."""
    judged = [f for f in errors.figures if f.against == WHOLE and f.bounds is not None]
    worst = nearest_to_tolerance(judged)
    sizes = {part.name: abs(part.value) for part in worst.parts if part.name in EFFECTS}
    sizes |= {name: size for name, size in worst.unknown.items() if name in EFFECTS}
    return max(sizes, key=sizes.get, default=None)


STUDY = Study(
    name=LADDER,
    quantities=QUANTITIES,
    solve=solve,
    begin=begin,
    applies=lambda solved: solved.plan.compares and bool(solved.problem.scene.tolerances),
    blocks=show.blocks,
    lines=show.lines,
)
