"""Of finished runs: `crosscheck report` shows them again, `rerun` repeats one from its own record,
`table` puts many into one table."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from comparisons.commands.arguments import RESULTS, json_option, path_option
from comparisons.commands.output import progress, show, show_either, show_json
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
    show_either(as_json, shown.as_dict(), shown.tables)
    for why in dict.fromkeys(report.no_pdf for report in shown.reports if report.no_pdf):
        tell(why)
    return ExitStatus.DONE


def rerun(
    folder: Annotated[Path, Argument(metavar="DIR", help="Folder that a run has left.")],
    out: Annotated[Path | None, path_option("Folder that keeps the repetition.")] = None,
    as_json: Annotated[bool, json_option("what moved, as JSON,")] = False,
) -> int:
    """Repeat a recorded run, from its own record. Shows every figure that moved."""
    from comparisons.runs.rerun import rerun as repeat
    from comparisons.runs.rerun import rerun_summary

    with progress() as callback:
        repetition = repeat(folder, out, callback)
    show_either(as_json, repetition.as_dict(), lambda: rerun_summary(repetition))
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
    from comparisons.common.files import write_whole
    from comparisons.output import flat_csv as flat

    if raw and as_json:
        raise InputError("table: allowed is one of --csv, --json")
    if out is not None:
        flat.check_place(out)
    rows = flat.tidy_rows(folders)
    if out is not None:
        write_whole(out, flat.as_csv(rows))
    if as_json:
        show_json(rows)
    elif raw:
        print(flat.as_csv(rows), end="")
    elif out is None:
        show(flat.rows_tables(flat.judged_rows(rows), flat.right_within))
    else:
        runs = len({row["run"] for row in rows})
        print(f"{len(rows)} rows of {runs} run{'s' * (runs != 1)} in {out}")
    return ExitStatus.DONE
