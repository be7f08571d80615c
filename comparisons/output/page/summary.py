"""Many runs on one page: a row each that leads to its report, sorted by any column."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from comparisons.common.numbers import given_percent, percent, significant, with_unit
from comparisons.figures.figure import grouped
from comparisons.figures.quantity import LABELS, MODELS, QUANTITIES, error_text, label
from comparisons.output.headline import headline
from comparisons.output.page.html import inline, rendered
from comparisons.studies import contact, problem
from comparisons.studies.study import MODEL_ERROR, Run

FIGURES = ("peak_pressure", "contact_length", "tau1_max")
# What a row may show, in the order of columns: name, head.
COLUMNS = {
    **{name: problem.QUANTITIES[name].label.rpartition(", ")[2] for name in problem.GROUPS},
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


def summary_row(outcome: Run) -> SummaryRow:
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


def _groups(run: Run) -> dict[str, Cell]:
    groups = run.figures.of(study=problem.NAME, source=problem.SCENE)
    return {figure.quantity: Cell(significant(figure.value, 3), figure.value) for figure in groups}


def _figures(run: Run) -> dict[str, Cell]:
    """The finite elements', or the only model's, each the largest of any friction."""
    known, cells = run.figures.of(study=contact.NAME, source=list(run.runs)[-1]), {}
    for name in FIGURES:
        values = [figure.value for figure in known.of(quantity=name)]
        if values:
            cells[name] = Cell(with_unit(max(values), QUANTITIES[name].unit), max(values))
    return cells


def _model_errors(run: Run) -> dict[str, Cell]:
    """Of what is judged, at the friction coefficient where it is largest."""
    cells: dict[str, Cell] = {}
    for errors in grouped(run.model_errors, lambda error: error.quantity):
        worst = max(errors, key=lambda error: abs(error.value) + error.numerical)
        note = f"± {percent(worst.numerical)}, tolerance {given_percent(worst.tolerance)}"
        text = error_text(worst.quantity, worst.value, worst.numerical)
        cells[f"model_error_{worst.quantity}"] = Cell(text, abs(worst.value), note)
    return cells


def _times(outcome: Run) -> dict[str, Cell]:
    seconds = {name: sum(run.seconds.values()) for name, run in outcome.runs.items()}
    budget = outcome.data(MODEL_ERROR)
    if budget is not None and budget.seconds:
        seconds["error_budget"] = budget.seconds
    return {f"seconds_{n}": Cell(with_unit(time, "s", 3), time) for n, time in seconds.items()}
