"""Commands on finished runs: `crosscheck report` shows them again, `rerun` repeats one from its own
record, `table` puts many into one table."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from comparisons.commands.arguments import RESULTS, json_option, path_option
from comparisons.commands.output import progress, show_either
from comparisons.common.errors import ExitStatus, InputError, tell


def report(
    folders: Annotated[list[Path], Argument(metavar="DIR...", help="Folders that runs have left.")],
    summary: Annotated[
        Path | None,
        path_option("Page over all runs.", "results/summary.html, of several DIR"),
    ] = None,
    pdf: Annotated[bool, Option("--pdf", help="Print each report to PDF, too.")] = False,
    as_json: Annotated[bool, json_option("what was made, as JSON,")] = False,
) -> int:
    """Show a finished run again without solving. Of many runs a page sums them up, too."""
    from comparisons.output.page.summary import show_again

    if summary is None and len(folders) > 1:
        summary = RESULTS / "summary.html"
    with progress() as callback:
        shown = show_again(folders, summary, pdf, callback)
    show_either(as_json, shown.as_dict, shown.tables)
    for why in dict.fromkeys(report.no_pdf for report in shown.reports if report.no_pdf):
        tell(why)
    return ExitStatus.DONE


def rerun(
    folder: Annotated[Path, Argument(metavar="DIR", help="Folder that a run has left.")],
    out: Annotated[Path | None, path_option("Folder that keeps the repetition.")] = None,
    as_json: Annotated[bool, json_option("what moved, as JSON,")] = False,
) -> int:
    """Repeat a recorded run, from its own record. Shows every figure that moved."""
    from comparisons import api

    with progress() as callback:
        repetition = api.rerun(folder, out=out, progress=callback)
    show_either(as_json, repetition.as_dict, repetition.tables)
    return repetition.exit_status


def table(
    folders: Annotated[
        list[Path], Argument(metavar="DIR...", help="Folders with runs in or below them.")
    ],
    out: Annotated[Path | None, path_option("FILE.csv, with every figure.")] = None,
    raw: Annotated[bool, Option("--csv", help="Print every figure as CSV.")] = False,
    as_json: Annotated[bool, Option("--json", help="Print every figure as JSON.")] = False,
) -> int:
    """Put the figures of many runs into one table. Shows what is judged."""
    from comparisons import api

    if raw and as_json:
        raise InputError("table: allowed is one of --csv, --json")
    found = api.table(*folders)
    if out is not None:
        found.write(out)
    if raw:
        print(found.csv, end="")
    elif as_json or out is None:
        show_either(as_json, lambda: found.rows, found.tables)
    else:
        runs = len({row["run"] for row in found.rows})
        print(f"{len(found.rows)} rows of {runs} run{'s' * (runs != 1)} in {out}")
    return found.exit_status
