"""Which model suffices: the cheapest whose every judged error holds against the whole.

In: the error budget of a finished comparison. Out: a judged figure a rung, quantity and friction
coefficient; what each rung took; which one suffices, and which is worth trying next."""

from collections.abc import Iterable, Mapping, Sequence
from math import isfinite

from comparisons.common.numbers import percent, with_unit
from comparisons.common.tasks import Tasks
from comparisons.drawing.blocks import Block, Note, TextTable
from comparisons.figures.figure import (
    Column,
    Figure,
    Figures,
    Findings,
    Series,
    Statement,
    deciding,
)
from comparisons.figures.quantity import QUANTITIES, WHOLE, error_text, label
from comparisons.judging import yielding
from comparisons.judging.effects.selection import effects_of_run
from comparisons.judging.ladder import candidates
from comparisons.judging.ladder.rungs import HALF_PLANE, Rung, rungs
from comparisons.judging.study import LADDER, MODEL_ERROR, WHY_NOT, Run, Solved, Study

RUNGS = "rungs"  # series: what each rung took
# Statements: the cheapest rung that holds; why none does; the next one to try.
SUFFICES, NONE, ESCALATE_TO = "suffices", "none", "escalate to"
NOTE = """Every model of this run against the whole one, from the cheapest on: the error in the
figure that decides, nearest to its tolerance or farthest beyond, with its uncertainty. A model
holds where every judged figure does. The last row is what is not known of the whole model itself.
Time is that of all levels, of finite elements summed over cores; memory is the largest of the
process."""


def begin(solved: Solved, tasks: Tasks) -> None:
    """Announce the candidates that no finite elements refute, once the half-plane is solved, where
    the effects that this selects ask for them: they then wait for no finite elements."""
    if list(solved.runs) != [HALF_PLANE]:
        return
    whole = effects_of_run(solved, tasks).whole
    for candidate in candidates.CANDIDATES:
        held = candidate.carries(solved.problem, whole, 0.0)
        if held and not candidate.has_elements:
            candidates.announce(solved, held, len(solved.problem.pitches), tasks)


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
    series = (Series(RUNGS, columns, is_account=True),)
    said = _statements(made, flow.beyond_doubt)
    return Findings(figures, series, tuple(said))


def _statements(rungs: Sequence[Rung], flows: str) -> list[Statement]:
    holding = [] if flows else [rung for rung in rungs if rung.verdict == "holds"]
    half_plane = next(rung for rung in rungs if rung.name == HALF_PLANE)
    said = []
    if flows:
        said.append(Statement(NONE, "flow"))
    elif holding:
        said.append(Statement(SUFFICES, holding[0].name))
    elif rungs[-1].verdict == "inconclusive":
        said.append(Statement(NONE, "the whole model is not known to the tolerance"))
    dearer = rungs[rungs.index(half_plane) + 1 :]
    possible = [rung.name for rung in (*holding, *dearer) if may_suffice(rung.figures)]
    possible += [rungs[-1].name] * (rungs[-1].verdict != "fails")  # if none is known to that
    if half_plane.verdict != "holds" and not flows and possible:
        said.append(Statement(ESCALATE_TO, possible[0]))
    return said


def may_suffice(errors: Iterable[Figure]) -> bool:
    """Whether no error of a rung fails, or is less certain than its tolerance."""
    return all(e.verdict != "fails" and e.total <= e.tolerance for e in errors)


def blocks(run: Run) -> list[Block]:
    rows = []
    for row, words, errors in _rungs(run):
        worst = deciding(errors)
        size, unsure = error_text(worst.value, worst.total), percent(worst.total)
        memory = with_unit(row["peak_memory"], "byte", 2) if row["peak_memory"] else ""
        judged = label(worst.quantity), size, unsure, worst.verdict
        rows.append((words, *judged, _time(row), memory))
    if not rows:
        return []
    head = ("model", "quantity", "error", "uncertainty", "verdict", "time", "memory")
    line = "; ".join(f"{name}: {text}" for name, text in lines(run))
    table = TextTable(line.replace("tau1", "τ₁"), head, tuple(rows), "comparison", words=False)
    return [Block("model-error", (table, Note(NOTE)))]


def lines(run: Run) -> list[tuple[str, str]]:
    """The cheapest model that holds, or that may by an error known to its tolerance."""
    rungs, findings = _rungs(run), run.findings[LADDER]
    if not rungs:
        return []
    by_name = {row["rung"]: _text(row, words, errors) for row, words, errors in rungs}
    if (name := findings.said(SUFFICES)) is not None:
        return [("cheapest that holds", by_name[name])]
    left = [row["rung"] for row, _, errors in rungs if may_suffice(errors)]
    why = f", {said}" if (said := findings.said(NONE)) else ""
    beside = f"cheapest that may: {by_name[left[0]]}" if left else "none is known to suffice"
    return [("cheapest that holds", f"none{why}; {beside}")]


def _rungs(run: Run) -> list[tuple[dict, str, Figures]]:
    """Each rung's row of the series, its name in words, and its errors."""
    table, known = run.findings[LADDER].table(RUNGS), run.figures.of(study=LADDER)
    rows = [] if table is None else table.rows()
    return [(row, row["model"], known.of(source=row["rung"], against=WHOLE)) for row in rows]


def _text(row: dict, words: str, errors: Sequence[Figure]) -> str:
    worst = deciding(errors)
    error = f", {QUANTITIES[worst.quantity].short} {worst.sized(worst.total)}"
    return f"{words} ({_time(row)}{error if isfinite(worst.total) else ''})"


def _time(row: dict) -> str:
    return with_unit(row["seconds"], "s", 2)


STUDY = Study(
    name=LADDER,
    quantities=QUANTITIES,
    solve=solve,
    begin=begin,
    applies=lambda solved: solved.plan.compares and bool(solved.problem.scene.tolerances),
    blocks=blocks,
    lines=lines,
)
