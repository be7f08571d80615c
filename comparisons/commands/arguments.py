"""What several commands take: a scene, a folder, what to print."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.completion import scenes

Job = Callable[[], int]
"""What a command returns: the work, which returns the exit status."""

RESULTS = Path("results")

Scene = Annotated[
    str,
    typer.Argument(help="A TOML file, or a name that `scenes` lists.", autocompletion=scenes),
]


def json_option(name: str) -> typer.models.OptionInfo:
    """The option `--json` of a command that prints `name` then, and else a table."""
    return typer.Option("--json", help=f"Print {name} instead of the table.")
