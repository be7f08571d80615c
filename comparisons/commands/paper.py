"""`crosscheck paper`: Bailey and Sayles' figures computed anew."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import RESULTS, job, json_option, out_option
from comparisons.commands.output import progress, show, show_json


@job
def paper(
    out: Annotated[Path | None, out_option("page", "paper")] = None,
    effects: Annotated[
        bool,
        typer.Option("--effects", help="compute the half-plane's model error beside each claim"),
    ] = False,
    as_json: Annotated[bool, json_option("paper.json")] = False,
) -> int:
    """Compute Bailey and Sayles' (1991) figures anew; judge each claim by its number."""
    from comparisons.studies.paper.reproduce import paper as reproduced

    with progress() as callback:
        found = reproduced(out or RESULTS / "paper", callback=callback, effects=effects)
    if as_json:
        show_json(found.as_dict())
    else:
        from comparisons.studies.paper.claim_table import paper_table

        show(paper_table(found))
    return found.exit_status
