"""`crosscheck scenes`: what comes along; `crosscheck deck`: a scene for another code."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from comparisons.commands.arguments import RESULTS, Scene, job, json_option, out_option
from comparisons.commands.output import show_json
from comparisons.common.errors import ExitStatus

Code = Literal["calculix", "abaqus", "fenicsx"]


@job
def scenes(as_json: Annotated[bool, json_option("names and titles as JSON")] = False) -> int:
    """List the scenes that come with crosscheck."""
    from comparisons.scenes.files import scene_titles

    titles = scene_titles()
    if as_json:
        show_json(titles)
        return ExitStatus.DONE
    width = max(map(len, titles))
    for name, title in titles.items():
        print(f"{name:{width}}  {title}")
    return ExitStatus.DONE


@job
def deck(
    scene: Scene,
    code: Annotated[Code, typer.Option("--for", help="Code that is to solve it.")],
    out: Annotated[Path | None, out_option("deck", "<name>-<code>")] = None,
    level: Annotated[
        int,
        typer.Option(help="Of the scene's refinement, 1 the coarsest: elements on the contact."),
    ] = 1,
    as_json: Annotated[bool, json_option("folder, files and sizes as JSON")] = False,
) -> int:
    """Write a scene as a complete input of another code, and how to bring its answer back."""
    from comparisons.scenes.resolve import load_scene
    from comparisons.studies.decks.write import write_deck

    resolved = load_scene(scene)
    written = write_deck(resolved, code, out or RESULTS / f"{resolved.name}-{code}", level)
    if as_json:
        show_json(written.as_dict())
        return ExitStatus.DONE
    print(f"{written.nodes} nodes; {written.folder / 'README.md'} says how to solve it")
    return ExitStatus.DONE
