"""`crosscheck table`: many runs as one tidy table."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import job
from comparisons.commands.output import show_json
from comparisons.common.errors import ExitStatus


@job
def table(
    folders: Annotated[
        list[Path], typer.Argument(metavar="DIR...", help="Folders with runs in or below them.")
    ],
    out: Annotated[
        Path | None, typer.Option(help="FILE.csv or FILE.parquet; without it CSV is printed.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the rows as JSON.")] = False,
) -> int:
    """Put the figures of many runs into one table: a row a run, friction and quantity."""
    from comparisons.results.flat_table import as_csv, check_ending, tidy_rows, write_table

    if out is not None:
        check_ending(out)
    rows = tidy_rows(folders)
    if out is not None:
        write_table(out, rows)
    if as_json:
        show_json(rows)
    elif out is None:
        print(as_csv(rows), end="")
    else:
        runs = len({row["run"] for row in rows})
        print(f"{len(rows)} rows of {runs} run{'s' * (runs != 1)} in {out}")
    return ExitStatus.DONE
