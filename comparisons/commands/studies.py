"""Studies of a scene, each with files of its own: `crosscheck cost`, `map` and `sweep`."""

from importlib.util import find_spec
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
from comparisons.commands.output import progress, say_warnings, show_either
from comparisons.common.errors import ExitStatus, tell
from comparisons.figures.quantity import MODELS

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
    from comparisons.common.files import check_writable
    from comparisons.output.result import content_of, result_of
    from comparisons.output.terminal import cost_summary
    from comparisons.runs.run import Known, run

    asked = scene_with(scene, settings)
    directory = out or RESULTS / f"{asked.name}-cost"
    check_writable(directory)
    models = MODELS if find_spec("dolfinx") else MODELS[:1]
    with progress() as callback:
        solved = run(asked, directory, models, callback, known=Known(all_methods=True))
    show_either(as_json, content_of(result_of(solved)), lambda: cost_summary(solved))
    if not as_json:
        print(f"written: {directory / 'report.html'}, result.json and the fields beside it")
    return ExitStatus.DONE if solved.converged else ExitStatus.NOT_CONVERGED


def map_of(
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
    from comparisons.grid.map import (
        SIZE,
        finished_map,
        finished_names,
        make_map,
        map_table,
        request_of,
        show_finished,
    )
    from comparisons.grid.mark import problem_named, unlike
    from comparisons.grid.points import exit_status

    marked = None if mark is None else problem_named(mark)
    solves = again or any(option is not None for option in (points, x, y, workers, settings))
    finished = scene in finished_names()
    if quantity is None:
        quantity = finished_map(scene)["quantity"] if finished else "peak_pressure"
    if finished and not solves:
        directory = out or RESULTS / scene
        content = show_finished(scene, quantity, marked, directory)
    else:
        size = SIZE if points is None else points
        request = request_of(scene, size, x, y, quantity, settings or ())
        directory = out or RESULTS / request.scene.name
        with progress() as callback:
            content = make_map(request, directory, workers, callback, marked)
    if marked and (why := unlike(content, marked)):
        tell(f"--mark: {marked.scene.name} {why}; the map's errors are those of its own scene")
    show_either(as_json, content, lambda: map_table(content, directory))
    return exit_status(content["points"])


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
    """Solve several scenes, or one at many places, loads, traces or other values."""
    from comparisons.figures.quantity import models_named
    from comparisons.grid.points import exit_status
    from comparisons.grid.sweep import make_sweep, sweep_request
    from comparisons.grid.table import sweep_table, warnings_of

    chosen = models_named(models, "--models")
    asked = [scene_with(scene, settings) for scene in scenes]
    request = sweep_request(asked, over or (), chosen)
    directory = out or RESULTS / f"sweep-{request.name}"
    with progress() as callback:
        content = make_sweep(request, directory, workers, callback)
    say_warnings(warnings_of(content))
    show_either(as_json, content, lambda: sweep_table(content, directory))
    return exit_status(content["points"])
