"""`crosscheck cost`: error against time of every method that applies to a scene."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import RESULTS, Scene, job, json_option, out_option
from comparisons.commands.output import progress, show, show_file
from comparisons.common.errors import ExitStatus


@job
def cost(
    scene: Scene,
    out: Annotated[Path | None, out_option("results", "<name>-cost")] = None,
    repeats: Annotated[int, typer.Option(help="Times that each setting is measured.")] = 3,
    as_json: Annotated[bool, json_option("cost.json")] = False,
) -> int:
    """Measure error against time of every method; name the cheapest for each tolerance."""
    from comparisons.scenes.resolve import load_scene
    from comparisons.studies.cost.cost import cost as measured_cost
    from comparisons.studies.cost.page import cost_table

    resolved = load_scene(scene)
    directory = out or RESULTS / f"{resolved.name}-cost"
    with progress() as callback:
        found = measured_cost(resolved, directory, repeats, callback)
    if as_json:
        show_file(directory / "cost.json")
        return ExitStatus.DONE
    show(cost_table(found))
    print(f"diagrams {directory / 'cost.html'}, figures {directory / 'cost.json'}")
    return ExitStatus.DONE
