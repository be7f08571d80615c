"""`crosscheck rerun`: a recorded run repeated from its own record."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import Job
from comparisons.commands.output import progress, show


def rerun(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder that a run has left.")],
    out: Annotated[Path | None, typer.Option(help="Folder that keeps the repetition.")] = None,
) -> Job:
    """Repeat a recorded run from its own record; report every figure that moved."""
    return partial(_rerun, folder, out)


def _rerun(folder: Path, out: Path | None) -> int:
    from comparisons.rerun import rerun as repeat
    from comparisons.rerun_table import rerun_summary

    with progress() as listener:
        repetition = repeat(folder, out, listener)
    show(rerun_summary(repetition))
    return repetition.exit_status
