"""The ladder as a table of the page, and as a line of the terminal."""

from collections.abc import Sequence
from math import isfinite

from comparisons.common.numbers import percent, with_unit
from comparisons.drawing.blocks import Block, Note, TextTable
from comparisons.figures.figure import Figure, Figures, deciding
from comparisons.figures.quantity import QUANTITIES, WHOLE, error_text, label
from comparisons.judging.ladder.rungs import may_suffice
from comparisons.judging.study import LADDER, Run

RUNGS = "rungs"  # series: what each rung took
# Statements: the cheapest rung that holds; why none does; the next one to try, and what it drops.
SUFFICES, NONE, ESCALATE_TO, NEXT = "suffices", "none", "escalate to", "next"
NOTE = """Every model of this run against the whole one, from the cheapest on: the error in the
figure that decides, nearest to its tolerance or farthest beyond, with its uncertainty. A model
holds where every judged figure does. The last row is what is not known of the whole model itself.
Time is that of all levels, of finite elements summed over cores; memory is the largest of the
process."""


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
