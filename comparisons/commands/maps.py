"""`crosscheck map`: where the half-plane holds, over two dimensionless groups."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import (
    RESULTS,
    complete_groups,
    complete_maps,
    complete_quantities,
    complete_scenes,
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
    points: Annotated[
        str | None, typer.Option(help="Values along x and y, as NxM.", show_default="8x8")
    ] = None,
    x: Annotated[str | None, Axis] = None,
    y: Annotated[str | None, Axis] = None,
    quantity: Annotated[
        str, typer.Option(help="The quantity to show.", autocompletion=complete_quantities)
    ] = "peak_pressure",
    workers: Annotated[
        str | None,
        typer.Option(help="Processes, or a Dask scheduler's address.", show_default="one a core"),
    ] = None,
    mark: Annotated[
        str | None,
        typer.Option(help="A scene to be marked on the map.", autocompletion=complete_scenes),
    ] = None,
    again: Annotated[
        bool, typer.Option("--again", help="Solve a finished map's points anew.")
    ] = False,
    out: Annotated[Path | None, out_option("map", "<name>")] = None,
    as_json: Annotated[bool, json_option("map.json")] = False,
) -> int:
    """Map where the half-plane holds, over two dimensionless groups."""
    from comparisons.studies.maps.make import exit_status, make_map_by, show_finished
    from comparisons.studies.maps.place import finished_names, problem_named
    from comparisons.studies.maps.request import SIZE, request_of

    marked = mark and from_first(lambda: problem_named(mark))
    is_own = again or any(given is not None for given in (points, x, y, workers))
    if scene in finished_names() and not is_own:
        directory = out or RESULTS / scene
        content = from_first(lambda: show_finished(scene, quantity, marked, directory))
    else:
        request = from_first(lambda: request_of(scene, points or SIZE, x, y, quantity))
        directory = out or RESULTS / request.name
        with progress() as callback:
            content = make_map_by(workers, request, directory, callback, marked)
    if content is None:  # it worked for the first process
        return ExitStatus.DONE
    if as_json:
        show_json(content)
    else:
        from comparisons.studies.maps.content import map_table

        show(map_table(content, directory))
    return exit_status(content)
