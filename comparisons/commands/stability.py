"""`crosscheck stability`: the stiff and extreme cases."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import RESULTS, Job
from comparisons.commands.output import progress, show


def stability(
    out: Annotated[
        Path | None, typer.Option(help="Folder for the rows.", show_default="results/stability")
    ] = None,
) -> Job:
    """Solve the stiff and extreme cases; end with 0 only if every one holds."""
    return partial(_stability, out)


def _stability(out: Path | None) -> int:
    from comparisons.stability.run import run_stability
    from comparisons.stability.table import stability_table

    with progress() as listener:
        result = run_stability(out or RESULTS / "stability", listener)
    show(stability_table(result))
    return result.exit_status
