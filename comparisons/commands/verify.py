"""`crosscheck verify`: both models against exact solutions."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import RESULTS, job, json_option, out_option
from comparisons.commands.output import progress, show, show_file


@job
def verify(
    out: Annotated[Path | None, out_option("figures", "verify")] = None,
    junit: Annotated[Path | None, typer.Option(help="File for JUnit XML.")] = None,
    as_json: Annotated[bool, json_option("verify.json")] = False,
) -> int:
    """Hold both models to exact solutions, and stated uncertainties to true errors."""
    from comparisons.studies.verify.pages import verify_summary
    from comparisons.studies.verify.run import verify as verify_all

    directory = out or RESULTS / "verify"
    with progress() as callback:
        found = verify_all(directory, junit, callback)
    if as_json:
        show_file(directory / "verify.json")
    else:
        show(verify_summary(found))
    return found.exit_status
