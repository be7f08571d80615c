"""`crosscheck init`: a look at a measured profile, and a scene to start from."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import job, json_option
from comparisons.commands.output import is_watched, show, show_json
from comparisons.common.errors import ExitStatus


@job
def init(
    profile: Annotated[Path, typer.Argument(help="A file with a measured profile.")],
    out: Annotated[
        Path | None, typer.Option(help="The scene's file.", show_default="PROFILE.toml")
    ] = None,
    x_unit: Annotated[str | None, typer.Option(help="Unit of positions, such as um.")] = None,
    z_unit: Annotated[str | None, typer.Option(help="Unit of heights, such as um.")] = None,
    spacing: Annotated[
        str | None, typer.Option(help='Of samples of heights alone, such as "0.5 um".')
    ] = None,
    row: Annotated[int | None, typer.Option(help="Of an areal map, counted from 0.")] = None,
    column: Annotated[int | None, typer.Option(help="Of an areal map instead.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the scene's file.")] = False,
    as_json: Annotated[bool, json_option("what was found as JSON")] = False,
) -> int:
    """Look at a measured profile and write a commented scene for it."""
    from comparisons.studies.init.first_scene import given_fields, write_first_scene

    options = {"x_unit": x_unit, "z_unit": z_unit, "spacing": spacing, "row": row, "column": column}
    made = write_first_scene(profile, out, given_fields(options), force)
    if as_json:
        show_json(made.as_dict())
        return ExitStatus.DONE
    from rich.console import Console

    from comparisons.studies.init.profile_view import init_table

    unicode = (sys.stdout.encoding or "ascii").lower().startswith("utf")
    show(init_table(made, Console().width - 1 if is_watched() else None, unicode))
    return ExitStatus.DONE
