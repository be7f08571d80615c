"""`crosscheck stability`: the stiff and extreme cases."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import RESULTS, job, json_option, out_option
from comparisons.commands.output import progress, show, show_file


@job
def stability(
    out: Annotated[Path | None, out_option("rows", "stability")] = None,
    junit: Annotated[Path | None, typer.Option(help="File for JUnit XML.")] = None,
    as_json: Annotated[bool, json_option("stability.json")] = False,
) -> int:
    """Solve the stiff and extreme cases; end with 0 only if every one holds."""
    from comparisons.studies.checks import rows_table, verdict_lines
    from comparisons.studies.robustness.run import run_robustness

    directory = out or RESULTS / "stability"
    with progress() as callback:
        study = run_robustness(directory, junit, callback)
    if as_json:
        show_file(directory / "stability.json")
    else:
        show(rows_table(study.rows))
        show(verdict_lines(study))
    return study.exit_status
