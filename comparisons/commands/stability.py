"""`crosscheck stability`: the stiff and extreme cases."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import RESULTS, Job, json_option
from comparisons.commands.output import progress, show, show_json


def stability(
    out: Annotated[
        Path | None, typer.Option(help="Folder for the rows.", show_default="results/stability")
    ] = None,
    as_json: Annotated[bool, json_option("stability.json")] = False,
) -> Job:
    """Solve the stiff and extreme cases; end with 0 only if every one holds."""
    return partial(_stability, out, as_json)


def _stability(out: Path | None, as_json: bool) -> int:
    from comparisons.studies.robustness.run import run_stability
    from comparisons.studies.robustness.table import stability_table

    with progress() as callback:
        result = run_stability(out or RESULTS / "stability", callback)
    if as_json:
        show_json(result.as_dict())
    else:
        show(stability_table(result))
    return result.exit_status
