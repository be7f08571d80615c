"""`crosscheck sweep`: one scene at many placements, loads, or values of any of its fields."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import (
    RESULTS,
    Scene,
    complete_models,
    job,
    json_option,
    out_option,
)
from comparisons.commands.output import progress, show, show_json
from comparisons.common.errors import ExitStatus


@job
def sweep(
    scene: Scene,
    over: Annotated[
        list[str],
        typer.Option(
            help="position=40 (placements along the trace), FIELD=A,B,C or FIELD=FROM:TO:N; "
            "several make every combination."
        ),
    ],
    models: Annotated[
        str,
        typer.Option(help="As for `run`.", autocompletion=complete_models),
    ] = "half-plane",
    workers: Annotated[
        int | None, typer.Option(help="Processes.", show_default="one a core", min=1)
    ] = None,
    out: Annotated[Path | None, out_option("sweep", "sweep-<name>")] = None,
    as_json: Annotated[bool, json_option("sweep.json")] = False,
) -> int:
    """Solve a scene at many values of its fields: one placement is not a surface."""
    from comparisons.common.quantities import models_named
    from comparisons.scenes.files import find_scene, read_toml
    from comparisons.studies.sweep.request import sweep_request
    from comparisons.studies.sweep.study import make_sweep, sweep_table

    chosen = models_named(models, "--models")
    path = find_scene(scene)
    name = path.stem.strip(". ") or "scene"
    place = {"name": name, "folder": path.parent, "source": scene}
    request = sweep_request(read_toml(path), over, chosen, **place)
    directory = out or RESULTS / f"sweep-{name}"
    with progress() as callback:
        content = make_sweep(request, directory, workers, callback)
    if as_json:
        show_json(content)
    else:
        show(sweep_table(content, directory))
    return ExitStatus.DONE
