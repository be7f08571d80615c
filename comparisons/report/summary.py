"""Many runs on one page: a row each that leads to its report, sorted by any column."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from comparisons.common.numbers import given_percent, percent, significant, with_unit
from comparisons.figures.quantity import LABELS, MODELS, QUANTITIES, label
from comparisons.report.headline import headline
from comparisons.report.html import inline, rendered
from comparisons.report.tables.problem import GROUPS
from comparisons.report.tables.text import error_text
from comparisons.results.outcome import Outcome

FIGURES = ("peak_pressure", "contact_length", "tau1_max")
# What a row may show, in the order of columns: name, head.
COLUMNS = {
    **{name: words.rpartition(", ")[2] for name, words in GROUPS.items()},
    **{name: label(name) for name in FIGURES},
    **{f"model_error_{name}": f"model error: {label(name)}" for name in QUANTITIES},
    **{f"seconds_{name}": f"time, {LABELS[name]}" for name in MODELS},
    "seconds_error_budget": "time summed over cores, error budget",
}


@dataclass(frozen=True)
class Cell:
    """Text, the number [SI] that it is sorted by, and what else there is to say."""

    text: str
    value: float
    note: str = ""


@dataclass(frozen=True)
class SummaryRow:
    """A run."""

    title: str
    report: Path  # its page
    kind: str  # the verdict in a word or two, with its sentence
    sentence: str
    cells: dict[str, Cell]  # of those of COLUMNS that the run has


def summary_row(outcome: Outcome) -> SummaryRow:
    """The row of a finished run."""
    said = headline(outcome)
    return SummaryRow(
        title=outcome.problem.scene.title,
        report=outcome.directory / "report.html",
        kind=said.kind,
        sentence=said.sentence,
        cells=_groups(outcome) | _figures(outcome) | _model_errors(outcome) | _times(outcome),
    )


def summary_page(rows: Sequence[SummaryRow], place: Path) -> str:
    """The page, to be written into the folder `place`, from which its links lead."""
    shown = {name for row in rows for name in row.cells}
    kinds = [row.kind for row in rows]
    counts = {kind: kinds.count(kind) for kind in sorted(set(kinds))}
    script, policy = inline("summary.js")
    return rendered(
        "summary.html.j2",
        rows=rows,
        columns={name: head for name, head in COLUMNS.items() if name in shown},
        counts=counts,
        links=[
            quote(os.fsencode(os.path.relpath(row.report.resolve(), place.resolve())))
            for row in rows
        ],
        script=script,
        policy=policy,
    )


def _groups(outcome: Outcome) -> dict[str, Cell]:
    groups = outcome.result["groups"]
    return {
        name: Cell(significant(groups[name], 3), groups[name])
        for name in GROUPS
        if groups[name] is not None
    }


def _figures(outcome: Outcome) -> dict[str, Cell]:
    """The finite elements', or the only model's, each the largest of any friction."""
    _, entries = list(outcome.result["models"].items())[-1]
    found = {}
    for name in FIGURES:
        part = "stress" if QUANTITIES[name].needs_stress else "contact"
        values = [entry[part][name] for entry in entries if entry[part] is not None]
        if values:
            found[name] = Cell(with_unit(max(values), QUANTITIES[name].unit), max(values))
    return found


def _model_errors(outcome: Outcome) -> dict[str, Cell]:
    """Of what is judged, at the friction coefficient where it is largest."""
    if outcome.budget is None:
        return {}
    found: dict[str, Cell] = {}
    for name, tolerance in outcome.problem.scene.tolerances.items():
        errors = [error for error in outcome.budget.model_errors if error.quantity == name]
        if not errors:
            continue
        worst = max(errors, key=lambda error: abs(error.value) + error.uncertainty)
        note = f"± {percent(worst.uncertainty)}, tolerance {given_percent(tolerance)}"
        text = error_text(name, worst.value, worst.uncertainty)
        found[f"model_error_{name}"] = Cell(text, abs(worst.value), note)
    return found


def _times(outcome: Outcome) -> dict[str, Cell]:
    seconds = {name: sum(run.seconds.values()) for name, run in outcome.runs.items()}
    if outcome.budget is not None and outcome.budget.seconds:
        seconds["error_budget"] = outcome.budget.seconds
    return {f"seconds_{n}": Cell(with_unit(time, "s", 3), time) for n, time in seconds.items()}
