"""Reports of finished runs drawn again from their folders, and a page that sums them up: a row each
that leads to its report, sorted by any column."""

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from jinja2 import TemplateError

from comparisons.common.errors import InputError, one_line
from comparisons.common.files import check_writable, write_whole
from comparisons.common.numbers import percent, percent_as_written, significant, with_unit
from comparisons.common.progress import ProgressCallback
from comparisons.figures.figure import grouped
from comparisons.figures.quantity import LABELS, MODELS, QUANTITIES, error_text, label
from comparisons.output.headline import headline
from comparisons.output.page.html import inline, rendered
from comparisons.output.page.page import render
from comparisons.output.page.pdf import NoPdfError, print_report
from comparisons.output.page.saved import read_run
from comparisons.studies import contact, problem
from comparisons.studies.study import MODEL_ERROR, Run

if TYPE_CHECKING:
    from rich.console import RenderableType

# What drawing raises where a result file was edited.
DAMAGED = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, TemplateError)
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


@dataclass(frozen=True)
class Report:
    """What was drawn."""

    page: Path
    row: SummaryRow  # the run on a summary
    # where it was printed to, or why it was not; neither where that was not asked for
    pdf: Path | None = None
    no_pdf: str | None = None


def draw_again(
    folders: Sequence[Path],
    summary: Path | None,
    pdf: bool,
    callback: ProgressCallback,
    draws: bool = True,
) -> list[Report]:
    """Write report.html of each folder again, if `draws`, and the summary if a path is given.
    All folders are read before anything is written. Raises InputError for one that holds no run,
    or whose place cannot be written; and at the end, once the others are drawn and summed up, for
    those of which no report can be drawn."""
    for folder in folders:
        callback(f"{folder}: reading")
        read_run(folder, with_mesh=False)
        if draws or pdf:
            check_writable(folder, ())
    if summary is not None:
        check_writable(summary.parent, ())
        if summary.is_dir():
            raise InputError(f"--summary: {summary} is a folder; allowed is a file")
    reports, damaged = [], []
    for folder in folders:
        callback(f"{folder}: drawing the report")
        try:
            content, row = _drawn(folder, draws)  # one at a time in memory
        except InputError as error:
            damaged.append(str(error))
            continue
        report = Report(folder / "report.html", row)
        if content is not None:
            write_whole(report.page, content)
        if pdf:
            callback(f"{folder}: printing the report")
            try:
                report = replace(report, pdf=print_report(folder))
            except NoPdfError as error:
                report = replace(report, no_pdf=str(error))
        reports.append(report)
    if summary is not None and reports:
        summary.parent.mkdir(parents=True, exist_ok=True)
        write_whole(summary, summary_page([report.row for report in reports], summary.parent))
    if damaged:
        raise InputError("; ".join(damaged))
    return reports


def _drawn(folder: Path, draws: bool) -> tuple[str | None, SummaryRow]:
    """The page of a run, if it `draws`, and its row; InputError where its files make none."""
    run = read_run(folder, with_mesh=draws)
    try:
        return render(run) if draws else None, summary_row(run)
    except DAMAGED as error:
        raise InputError(
            f"{folder}: its result.json, record.json and report.npz make up no report "
            f"({error!r}); allowed is what one run wrote"
        ) from error


def reports_content(reports: Sequence[Report], summary: Path | None) -> dict:
    """What was made, for JSON."""
    return {
        "schema": 1,
        "summary": None if summary is None else str(summary),
        "runs": [
            {
                "scene": report.row.title,
                "verdict": report.row.kind,
                "sentence": report.row.sentence,
                "report": str(report.page),
                "pdf": None if report.pdf is None else str(report.pdf),
                "figures": {name: cell.value for name, cell in report.row.cells.items()},
            }
            for report in reports
        ],
    }


def reports_table(reports: Sequence[Report], summary: Path | None) -> "RenderableType":
    """What was made, for people to read."""
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    table = Table("scene", "verdict", "report", box=None, pad_edge=False)
    for report in reports:
        made = [str(path) for path in (report.page, report.pdf) if path is not None]
        table.add_row(
            Text(one_line(report.row.title)), Text(report.row.kind), Text("\n".join(made))
        )
    return table if summary is None else Group(table, "", Text(f"summary  {summary}"))


def summary_row(run: Run) -> SummaryRow:
    """The row of a finished run."""
    said = headline(run)
    cells = _groups(run) | _figures(run) | _model_errors(run) | _times(run)
    title, report = run.problem.scene.title, run.directory / "report.html"
    return SummaryRow(title, report, said.kind, said.sentence, cells)


def summary_page(rows: Sequence[SummaryRow], place: Path) -> str:
    """The page, to be written into the folder `place`, from which its links lead."""
    shown = {name for row in rows for name in row.cells}
    columns = {name: head for name, head in COLUMNS.items() if name in shown}
    kinds = [row.kind for row in rows]
    counts = {kind: kinds.count(kind) for kind in sorted(set(kinds))}
    reports = (os.path.relpath(row.report.resolve(), place.resolve()) for row in rows)
    links = [quote(os.fsencode(report)) for report in reports]
    script, policy = inline("summary.js")
    table = {"rows": rows, "columns": columns, "counts": counts, "links": links}
    return rendered("summary.html.j2", script=script, policy=policy, **table)


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
        note = f"± {percent(worst.numerical)}, tolerance {percent_as_written(worst.tolerance)}"
        text = error_text(worst.value, worst.numerical)
        cells[f"model_error_{worst.quantity}"] = Cell(text, abs(worst.value), note)
    return cells


def _times(run: Run) -> dict[str, Cell]:
    seconds = {name: sum(model.seconds.values()) for name, model in run.runs.items()}
    budget = run.data(MODEL_ERROR)
    if budget is not None and budget.seconds:
        seconds["error_budget"] = budget.seconds
    return {f"seconds_{n}": Cell(with_unit(time, "s", 3), time) for n, time in seconds.items()}
