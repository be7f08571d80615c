"""Studies of a scene, each with files of its own: `crosscheck cost`, `map` and `sweep`."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from comparisons.commands.arguments import (
    RESULTS,
    Models,
    SceneName,
    Settings,
    complete_groups,
    complete_maps,
    complete_quantities,
    complete_scenes,
    json_option,
    out_option,
    scene_with,
)
from comparisons.commands.output import progress, say_written, show_either

Axis = Annotated[
    str | None,
    Option(
        help="GROUP or GROUP=FROM:TO.", show_default="by the scene", autocompletion=complete_groups
    ),
]
Workers = Annotated[
    str | None, Option(help="Processes, or a Dask scheduler's address.", show_default="one a core")
]
MAPPED = "As for `run`, or the name of a finished map."


def cost(
    scene: SceneName,
    settings: Settings = None,
    out: Annotated[Path | None, out_option("results", "<name>-cost")] = None,
    as_json: Annotated[bool, json_option("result.json")] = False,
) -> int:
    """Show error against time of every method: a run that solves the scene by all of them. Names
    the cheapest for each tolerance."""
    from comparisons import api

    asked = scene_with(scene, settings)
    folder = out or RESULTS / f"{asked.name}-cost"
    with progress() as callback:
        solved = api.cost(asked, out=folder, progress=callback)
    show_either(as_json, lambda: solved.result, solved.tables)
    if not as_json:
        say_written(folder)
    return solved.exit_status


def map(
    scene: Annotated[str, Argument(help=MAPPED, autocompletion=complete_maps)],
    settings: Settings = None,
    points: Annotated[
        str | None, Option(help="Values along x and y, as NxM.", show_default="8x8")
    ] = None,
    x: Axis = None,
    y: Axis = None,
    quantity: Annotated[
        str | None,
        Option(
            help="The quantity to show.",
            autocompletion=complete_quantities,
            show_default="peak_pressure, or the finished map's",
        ),
    ] = None,
    workers: Workers = None,
    mark: Annotated[
        str | None, Option(help="A scene to be marked on the map.", autocompletion=complete_scenes)
    ] = None,
    again: Annotated[bool, Option("--again", help="Solve a finished map's points anew.")] = False,
    out: Annotated[Path | None, out_option("map", "<name>")] = None,
    as_json: Annotated[bool, json_option("map.json")] = False,
) -> int:
    """Map where the half-plane holds, over two dimensionless groups."""
    from comparisons import api
    from comparisons.scenes.files import name_of

    folder = out or RESULTS / name_of(Path(scene))
    asked = {"x": x, "y": y, "quantity": quantity, "settings": settings or (), "mark": mark}
    how = {"again": again, "workers": workers, "out": folder}
    with progress() as callback:
        made = api.map(scene, points, **asked, **how, progress=callback)
    show_either(as_json, lambda: made.content, made.tables)
    return made.exit_status


def sweep(
    scenes: Annotated[
        list[str],
        Argument(help="Scenes' files or names.", autocompletion=complete_scenes),
    ],
    over: Annotated[
        list[str] | None,
        Option(
            help="position=40 (placements along the trace), FIELD=A,B,C, FIELD=FROM:TO:N or "
            "profile.file=FOLDER; several make every combination."
        ),
    ] = None,
    settings: Settings = None,
    models: Models = "half-plane",
    workers: Workers = None,
    out: Annotated[Path | None, out_option("sweep", "sweep-<name>")] = None,
    as_json: Annotated[bool, json_option("sweep.json")] = False,
) -> int:
    """Solve several scenes, or one at many positions, loads, traces or other values."""
    from comparisons import api
    from comparisons.grid.sweep import joined_name

    asked = [scene_with(scene, settings) for scene in scenes]
    folder = out or RESULTS / f"sweep-{joined_name(asked)}"
    with progress() as callback:
        made = api.sweep(asked, over or (), models, workers=workers, out=folder, progress=callback)
    show_either(as_json, lambda: made.content, made.tables)
    return made.exit_status
