"""`crosscheck report`: finished runs' pages drawn again, and one page over all of them."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import RESULTS, job, json_option
from comparisons.commands.output import progress, say, show, show_json
from comparisons.common.errors import ExitStatus
from comparisons.common.mpi import from_first


@job
def report(
    folders: Annotated[
        list[Path], typer.Argument(metavar="DIR...", help="Folders that runs have left.")
    ],
    summary: Annotated[
        Path | None,
        typer.Option(
            help="Page over all runs; given by name, no report is drawn again.",
            show_default="results/summary.html, of several DIR",
        ),
    ] = None,
    pdf: Annotated[bool, typer.Option("--pdf", help="Print each report to PDF, too.")] = False,
    as_json: Annotated[bool, json_option("what was made, as JSON,")] = False,
) -> int:
    """Draw reports again from result files, without solving; sum many runs up on one page."""
    from comparisons.report.redraw import draw_again, reports_content, reports_table

    draws = summary is None
    if draws and len(folders) > 1:
        summary = RESULTS / "summary.html"
    with progress() as callback:
        reports = from_first(lambda: draw_again(folders, summary, pdf, callback, draws))
    if as_json:
        show_json(reports_content(reports, summary))
    else:
        show(reports_table(reports, summary))
    for why in dict.fromkeys(report.no_pdf for report in reports if report.no_pdf):
        say(why)
    return ExitStatus.DONE
