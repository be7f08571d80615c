"""`crosscheck rerun`: a recorded run repeated from its own record."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import job, json_option
from comparisons.commands.output import progress, show, show_json


@job
def rerun(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder that a run has left.")],
    out: Annotated[Path | None, typer.Option(help="Folder that keeps the repetition.")] = None,
    as_json: Annotated[bool, json_option("what moved, as JSON,")] = False,
) -> int:
    """Repeat a recorded run from its own record; report every figure that moved."""
    from comparisons.runs.rerun import rerun as repeat
    from comparisons.runs.rerun import rerun_summary

    with progress() as callback:
        repetition = repeat(folder, out, callback)
    if as_json:
        show_json(repetition.as_dict())
    else:
        show(rerun_summary(repetition))
    return repetition.exit_status
