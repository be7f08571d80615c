"""A page that sums up finished runs: a row each that leads to its report, sorted by any column.

In: the folders of runs. Out: the page; what was made, for the terminal."""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from comparisons.common.errors import InputError, one_line
from comparisons.common.files import PDF, REPORT, check_file, write_whole
from comparisons.common.numbers import (
    percent,
    percent_as_written,
    rounded_up,
    significant,
    with_unit,
)
from comparisons.common.progress import ProgressCallback
from comparisons.figures.figure import Findings, grouped
from comparisons.figures.quantity import LABELS, MAIN, MODELS, QUANTITIES, error_text, label
from comparisons.judging import contact
from comparisons.judging.study import MODEL_ERROR
from comparisons.output.page.html import inline, rendered
from comparisons.output.page.pdf import print_report
from comparisons.output.result import Result, read_result
from comparisons.studies import problem

if TYPE_CHECKING:
    from rich.console import RenderableType

# What a row may show, in the order of columns: name, head.
COLUMNS = {
    "within": "right within",
    **{name: problem.QUANTITIES[name].label.rpartition(", ")[2] for name in problem.GROUPS},
    **{name: label(name) for name in MAIN},
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
    # why the page was not printed; "": it was; None: that was not asked for
    no_pdf: str | None = None

    @property
    def title(self) -> str:
        return self.result.scene["title"]

    @property
    def pdf(self) -> Path | None:
        """Where the page was printed to."""
        return self.page.with_name(PDF) if self.no_pdf == "" else None

    @cached_property
    def cells(self) -> dict[str, Cell]:
        """Cells of those of COLUMNS that the run has."""
        return {name: Cell(*said) for name, *said in _cells(self.result)}


@dataclass(frozen=True)
class Reports:
    """Finished runs, shown again."""

    reports: tuple[Report, ...]
    summary: Path | None  # the page over all

    def as_dict(self) -> dict:
        """Pages that were made, for JSON."""
        runs = [
            {
                "scene": report.title,
                "verdict": report.result.verdict,
                "sentence": f"{report.result.within_words} {report.result.why}",
                "report": str(report.page),
                "pdf": report.pdf and str(report.pdf),
                "figures": {name: cell.value for name, cell in report.cells.items()},
            }
            for report in self.reports
        ]
        return {"schema": 1, "summary": self.summary and str(self.summary), "runs": runs}

    def tables(self) -> "RenderableType":
        """The run as it was printed; of several a line each."""
        from rich.console import Group
        from rich.table import Table
        from rich.text import Text

        if self.summary is None:
            return Group(*(report.result.tables() for report in self.reports))
        table = Table("scene", "verdict", "report", box=None, pad_edge=False)
        for report in self.reports:
            pages = "\n".join(str(path) for path in (report.page, report.pdf) if path is not None)
            table.add_row(*map(Text, (one_line(report.title), report.result.verdict, pages)))
        return Group(table, "", Text(f"summary  {self.summary}"))


def show_again(
    folders: Sequence[Path], summary: Path | None, pdf: bool, callback: ProgressCallback
) -> Reports:
    """Finished runs from their folders, a page over all of them, and each one's page printed.
    Raises InputError, before anything is written, where one cannot be read or written."""
    reports = [Report(read_result(folder), folder / REPORT) for folder in folders]
    for report in reports if pdf else ():
        if not report.page.is_file():
            where = report.page.parent
            raise InputError(f"{where}: holds no {REPORT}; allowed is what a run wrote")
    if summary is not None:
        check_file(summary)
        write_whole(summary, summary_page(reports, summary.parent))
    for number, report in enumerate(reports) if pdf else ():
        callback(f"{report.page}: printing")
        reports[number] = replace(report, no_pdf=print_report(report.page.parent))
    return Reports(tuple(reports), summary)


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


def _cells(result: Result) -> Iterator[tuple[str, str, float] | tuple[str, str, float, str]]:
    """Name of a column, and the fields of its cell."""
    if result.within is not None:
        yield "within", percent_as_written(rounded_up(result.within)), result.within
    for group in result.figures.of(study=problem.NAME, source=problem.SCENE):
        yield group.quantity, significant(group.value, 3), group.value
    # the finite elements', or the only model's, each the largest of any friction
    known = result.figures.of(study=contact.NAME, source=result.models[-1])
    for name in MAIN:
        if values := [figure.value for figure in known.of(quantity=name)]:
            yield name, with_unit(max(values), QUANTITIES[name].unit), max(values)
    for errors in grouped(result.model_errors, attrgetter("quantity")):
        worst = max(errors, key=lambda error: abs(error.value) + error.numerical)
        note = f"± {percent(worst.numerical)}, tolerance {percent_as_written(worst.tolerance)}"
        text = error_text(worst.value, worst.numerical)
        yield f"model_error_{worst.quantity}", text, abs(worst.value), note
    stages = {name: result.findings[contact.NAME].table("seconds", name) for name in result.models}
    seconds = {name: sum(of.columns["seconds"].values) for name, of in stages.items() if of}
    if budget := result.findings.get(MODEL_ERROR, Findings()).table("cost"):
        [seconds["error_budget"]] = budget.columns["seconds"].values
    for name, time in seconds.items():
        if time:
            yield f"seconds_{name}", with_unit(time, "s", 3), time
