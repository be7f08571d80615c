"""Reports of finished runs drawn again from their folders, and a page that sums them up."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from jinja2 import TemplateError

from comparisons.common.errors import InputError, one_line
from comparisons.common.files import check_writable, write_whole
from comparisons.common.progress import ProgressCallback
from comparisons.output.page.page import render
from comparisons.output.page.pdf import NoPdfError, print_report
from comparisons.output.page.saved import read_run
from comparisons.output.page.summary import SummaryRow, summary_page, summary_row

if TYPE_CHECKING:
    from rich.console import RenderableType

# What drawing raises where a result file was edited.
DAMAGED = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, TemplateError)


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
    or whose place cannot be written; and at the end, where the others are drawn and summed up, for
    those that make up no report."""
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
    outcome = read_run(folder, with_mesh=draws)
    try:
        return render(outcome) if draws else None, summary_row(outcome)
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
