"""A page that sums up finished runs: a row each that leads to its report, sorted by any column.

In: the folders of runs. Out: the page; what was made, for the terminal."""

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from comparisons.common.errors import InputError, one_line
from comparisons.common.files import check_writable, write_whole
from comparisons.common.numbers import percent, percent_as_written, significant, with_unit
from comparisons.common.progress import ProgressCallback
from comparisons.figures.figure import Findings, grouped
from comparisons.figures.quantity import LABELS, MODELS, QUANTITIES, error_text, label
from comparisons.output.page.html import inline, rendered
from comparisons.output.page.pdf import NoPdfError, print_report
from comparisons.output.record import BUILT_OTHERWISE, read_result
from comparisons.output.result_json import Result
from comparisons.output.within import rounded_up
from comparisons.studies import contact, problem
from comparisons.studies.study import MODEL_ERROR

if TYPE_CHECKING:
    from rich.console import RenderableType

FIGURES = ("peak_pressure", "contact_length", "tau1_max")
# What a row may show, in the order of columns: name, head.
COLUMNS = {
    "within": "right within",
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
class Report:
    """A finished run, as a row shows it."""

    result: Result
    page: Path
    cells: dict[str, Cell]  # of those of COLUMNS that the run has
    # where the page was printed to, or why it was not; neither where that was not asked for
    pdf: Path | None = None
    no_pdf: str | None = None

    @property
    def title(self) -> str:
        return self.result.scene["title"]


def read_report(folder: Path, pdf: bool = False) -> Report:
    """The run in a folder. Raises InputError where there is none; for `pdf`, where its page is
    missing or cannot be printed there."""
    result, page = read_result(folder / "result.json"), folder / "report.html"
    if pdf:
        check_writable(folder, ())
        if not page.is_file():
            raise InputError(f"{folder}: holds no report.html; allowed is what a run wrote")
    try:
        return Report(result, page, cells_of(result))
    except BUILT_OTHERWISE as error:
        said = f"{folder / 'result.json'}: sums up to nothing ({error!r})"
        raise InputError(f"{said}; allowed is what a run wrote") from error


def printed(report: Report, callback: ProgressCallback) -> Report:
    """With its page printed, or why it is not."""
    folder = report.page.parent
    callback(f"{folder}: printing the report")
    try:
        return replace(report, pdf=print_report(folder))
    except NoPdfError as error:
        return replace(report, no_pdf=str(error))


def write_summary(reports: Sequence[Report], path: Path) -> None:
    """Write the page. Raises InputError where that cannot be."""
    check_writable(path.parent, ())
    if path.is_dir():
        raise InputError(f"--summary: {path} is a folder; allowed is a file")
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, summary_page(reports, path.parent))


def summary_content(reports: Sequence[Report], summary: Path | None) -> dict:
    """What was made, for JSON."""
    return {
        "schema": 1,
        "summary": None if summary is None else str(summary),
        "runs": [
            {
                "scene": report.title,
                "verdict": report.result.verdict,
                "sentence": f"{report.result.within_words} {report.result.why}",
                "report": str(report.page),
                "pdf": None if report.pdf is None else str(report.pdf),
                "figures": {name: cell.value for name, cell in report.cells.items()},
            }
            for report in reports
        ],
    }


def summary_table(reports: Sequence[Report], summary: Path) -> "RenderableType":
    """What was made, for people to read."""
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    table = Table("scene", "verdict", "report", box=None, pad_edge=False)
    for report in reports:
        pages = "\n".join(str(path) for path in (report.page, report.pdf) if path is not None)
        table.add_row(*map(Text, (one_line(report.title), report.result.verdict, pages)))
    return Group(table, "", Text(f"summary  {summary}"))


def summary_page(reports: Sequence[Report], place: Path) -> str:
    """The page, to be written into the folder `place`, from which its links lead."""
    shown = {name for report in reports for name in report.cells}
    columns = {name: head for name, head in COLUMNS.items() if name in shown}
    kinds = [report.result.verdict for report in reports]
    counts = {kind: kinds.count(kind) for kind in sorted(set(kinds))}
    paths = (os.path.relpath(report.page.resolve(), place.resolve()) for report in reports)
    links = [quote(os.fsencode(path)) for path in paths]
    script, policy = inline("summary.js")
    table = {"reports": reports, "columns": columns, "counts": counts, "links": links}
    return rendered("summary.html.j2", script=script, policy=policy, **table)


def cells_of(result: Result) -> dict[str, Cell]:
    """What a row shows of a run."""
    figures = _groups(result) | _figures(result) | _model_errors(result)
    return _within(result) | figures | _times(result)


def _within(result: Result) -> dict[str, Cell]:
    if result.within is None:
        return {}
    return {"within": Cell(percent_as_written(rounded_up(result.within)), result.within)}


def _groups(result: Result) -> dict[str, Cell]:
    groups = result.figures.of(study=problem.NAME, source=problem.SCENE)
    return {figure.quantity: Cell(significant(figure.value, 3), figure.value) for figure in groups}


def _figures(result: Result) -> dict[str, Cell]:
    """The finite elements', or the only model's, each the largest of any friction."""
    *_, known = (result.figures.of(study=contact.NAME, source=name) for name in result.models)
    cells = {}
    for name in FIGURES:
        values = [figure.value for figure in known.of(quantity=name)]
        if values:
            cells[name] = Cell(with_unit(max(values), QUANTITIES[name].unit), max(values))
    return cells


def _model_errors(result: Result) -> dict[str, Cell]:
    """Of what is judged, at the friction coefficient where it is largest."""
    cells: dict[str, Cell] = {}
    for errors in grouped(result.model_errors, lambda error: error.quantity):
        worst = max(errors, key=lambda error: abs(error.value) + error.numerical)
        note = f"± {percent(worst.numerical)}, tolerance {percent_as_written(worst.tolerance)}"
        text = error_text(worst.value, worst.numerical)
        cells[f"model_error_{worst.quantity}"] = Cell(text, abs(worst.value), note)
    return cells


def _times(result: Result) -> dict[str, Cell]:
    stages = {name: result.findings[contact.NAME].table("seconds", name) for name in result.models}
    seconds = {name: sum(table.columns["seconds"].values) for name, table in stages.items()}
    budget = result.findings.get(MODEL_ERROR, Findings()).table("cost")
    if budget is not None and budget.columns["seconds"].values[0]:
        seconds["error_budget"] = budget.columns["seconds"].values[0]
    return {f"seconds_{n}": Cell(with_unit(time, "s", 3), time) for n, time in seconds.items()}
