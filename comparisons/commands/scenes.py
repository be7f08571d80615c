"""Scene files: `crosscheck scenes` lists the shipped ones, `init` writes one for a measured
profile, `deck` hands one to another code."""

import sys
from pathlib import Path
from typing import Annotated, Literal

from typer import Argument, Option

from comparisons.commands.arguments import (
    RESULTS,
    SceneName,
    Settings,
    json_option,
    out_option,
    path_option,
    scene_with,
)
from comparisons.commands.output import show_either, show_json
from comparisons.common.errors import ExitStatus

Code = Literal["calculix", "fenicsx"]


def scenes(
    benchmarks: Annotated[
        bool, Option("--benchmarks", help="Those of which figures are published.")
    ] = False,
    schema: Annotated[
        bool, Option("--schema", help="JSON Schema of a scene, for completion in editors.")
    ] = False,
    as_json: Annotated[bool, json_option("names and titles as JSON")] = False,
) -> int:
    """List the scenes that come with crosscheck."""
    from comparisons.scenes.files import scene_titles

    if schema:
        from comparisons.scenes.scene import Scene
        from comparisons.scenes.schema.json_schema import schema_for_editors

        show_json(schema_for_editors(Scene))
        return ExitStatus.DONE
    titles = scene_titles(benchmarks)
    width = max(map(len, titles))
    if as_json:
        show_json(titles)
    else:
        print(*(f"{name:{width}}  {title}" for name, title in titles.items()), sep="\n")
    return ExitStatus.DONE


def init(
    profile: Annotated[Path, Argument(help="A file with a measured profile.")],
    out: Annotated[Path | None, path_option("The scene's file.", "PROFILE.toml")] = None,
    x_unit: Annotated[str | None, Option(help="Unit of positions, such as um.")] = None,
    z_unit: Annotated[str | None, Option(help="Unit of heights, such as um.")] = None,
    spacing: Annotated[
        str | None, Option(help='Of samples of heights alone, such as "0.5 um".')
    ] = None,
    columns: Annotated[
        str | None, Option(help="Of x and height in a table: names or numbers, as 0,2.")
    ] = None,
    channel: Annotated[
        str | None, Option(help="Of a file with several; a sheet of an xlsx.")
    ] = None,
    row: Annotated[int | None, Option(help="Of an areal map, counted from 0.")] = None,
    column: Annotated[int | None, Option(help="Of an areal map instead.")] = None,
    radius: Annotated[str | None, Option(help='Of the roller, such as "8.2 mm".')] = None,
    load: Annotated[
        str | None, Option(help='Per length, such as "3.85 N/um".', show_default="an example")
    ] = None,
    peak_pressure: Annotated[
        str | None, Option(help="By Hertz, instead of the load, such as 1GPa.")
    ] = None,
    friction: Annotated[str | None, Option(help="Coefficient.")] = None,
    material: Annotated[
        str | None, Option(help="Of both bodies: a solid of crosscheck materials.")
    ] = None,
    youngs_modulus: Annotated[str | None, Option(help='Of both bodies, such as "207 GPa".')] = None,
    poissons_ratio: Annotated[str | None, Option(help="Of both bodies.")] = None,
    hardness: Annotated[str | None, Option(help="Of the rough body, as a pressure.")] = None,
    picture: Annotated[
        bool, Option(help="Draw trace, power spectrum and bearing curve beside the scene.")
    ] = True,
    force: Annotated[bool, Option("--force", help="Replace the scene's file.")] = False,
    yes: Annotated[bool, Option("--yes", help="Ask nothing: take examples.")] = False,
    as_json: Annotated[bool, json_option("what was found as JSON")] = False,
) -> int:
    """Look at a measured profile and write a short scene for it. A terminal asks for the rest."""
    from comparisons.campaigns.init.first_scene import write_first_scene

    options = {"x_unit": x_unit, "z_unit": z_unit, "spacing": spacing, "row": row, "column": column}
    options |= {"channel": channel, "columns": columns, "radius": radius, "friction": friction}
    options |= {"load": load, "peak_pressure": peak_pressure, "hardness": hardness}
    options |= {"youngs_modulus": youngs_modulus, "poissons_ratio": poissons_ratio}
    options |= {"material": material}
    asks = sys.stdin.isatty() and sys.stdout.isatty() and not (yes or as_json)
    made = write_first_scene(profile, out, options, force, picture, _ask if asks else None)
    show_either(as_json, made.as_dict, made.tables)
    return made.exit_status


def _ask(question: str) -> str:
    try:
        return input(question)
    except EOFError:
        raise KeyboardInterrupt from None


def deck(
    scene: SceneName,
    code: Annotated[Code, Option("--for", help="Code that is to solve it.")],
    settings: Settings = None,
    out: Annotated[Path | None, out_option("deck", "<name>-<code>")] = None,
    level: Annotated[
        int, Option(help="Of the scene's refinement, 1 the coarsest: elements on the contact.")
    ] = 1,
    as_json: Annotated[bool, json_option("folder, files and sizes as JSON")] = False,
) -> int:
    """Write a scene as input of another code. A page says how to bring its answer back."""
    from comparisons import api

    asked = scene_with(scene, settings)
    folder = out or RESULTS / f"{asked.name}-{code}"
    made = api.deck(asked, code, level=level, out=folder)
    show_either(as_json, lambda: {"folder": str(folder), **made.as_dict()}, made.tables)
    if not as_json:
        print(f"written: {folder / 'README.md'} and what it names")
    return made.exit_status
