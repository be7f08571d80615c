"""`crosscheck verify`: both models against exact solutions."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import RESULTS, Job
from comparisons.commands.output import progress, show


def verify(
    out: Annotated[
        Path | None, typer.Option(help="Folder for the figures.", show_default="results/verify")
    ] = None,
    junit: Annotated[Path | None, typer.Option(help="File for JUnit XML.")] = None,
) -> Job:
    """Hold both models to exact solutions, and stated uncertainties to true errors."""
    return partial(_verify, out, junit)


def _verify(out: Path | None, report: Path | None) -> int:
    from comparisons.verify import verify as verify_all
    from comparisons.verify_table import verify_summary

    with progress() as listener:
        found = verify_all(out or RESULTS / "verify", report, listener)
    show(verify_summary(found))
    return found.exit_status
