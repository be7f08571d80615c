"""`crosscheck map`: where the half-plane holds, over two dimensionless groups."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import (
    RESULTS,
    complete_groups,
    complete_maps,
    complete_quantities,
    job,
    json_option,
    out_option,
)
from comparisons.commands.output import progress, show, show_json
from comparisons.common.errors import ExitStatus
from comparisons.common.mpi import from_first

Axis = typer.Option(
    help="GROUP or GROUP=FROM:TO.", show_default="by the scene", autocompletion=complete_groups
)


@job
def map_of(
    scene: Annotated[
        str,
        typer.Argument(
            help="As for `run`, or the name of a finished map.", autocompletion=complete_maps
        ),
    ],
    points: Annotated[str, typer.Option(help="Values along x and y, as NxM.")] = "8x8",
    x: Annotated[str | None, Axis] = None,
    y: Annotated[str | None, Axis] = None,
    quantity: Annotated[
        str, typer.Option(help="The quantity to show.", autocompletion=complete_quantities)
    ] = "peak_pressure",
    workers: Annotated[
        str | None,
        typer.Option(help="Processes, or a Dask scheduler's address.", show_default="one a core"),
    ] = None,
    out: Annotated[Path | None, out_option("map", "<name>")] = None,
    as_json: Annotated[bool, json_option("map.json")] = False,
) -> int:
    """Map where the half-plane holds, over two dimensionless groups."""
    from comparisons.studies.maps.request import request_of

    request = from_first(lambda: request_of(scene, points, x, y, quantity))
    directory = out or RESULTS / request.name
    from comparisons.studies.maps.make import exit_status, make_map_by

    with progress() as callback:
        content = make_map_by(workers, request, directory, callback)
    if content is None:  # it worked for the first process
        return ExitStatus.DONE
    if as_json:
        show_json(content)
    else:
        from comparisons.studies.maps.content import map_table

        show(map_table(content, directory))
    return exit_status(content)
