"""Arguments that several commands take, and words that the shell may complete."""

import os
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, BadParameter, Option
from typer.models import OptionInfo

from comparisons.figures.quantity import HYPHENATED

if TYPE_CHECKING:
    from comparisons.scenes.scene import Scene

RESULTS = Path("results")
LAUNCHED_AS = "CROSSCHECK_LAUNCHED_AS"  # what was typed in place of `crosscheck`, by its launcher


def json_option(name: str) -> OptionInfo:
    """The option `--json` of a command that prints `name` then, and else a table."""
    return Option("--json", help=f"Print {name} instead of the table.")


def out_option(content: str, default: str) -> OptionInfo:
    """The option `--out` of a command that writes a folder."""
    return path_option(f"Folder for the {content}.", f"results/{default}")


def path_option(meaning: str, default: str | bool = True) -> OptionInfo:
    """An option that names a file or folder to write."""
    return Option(help=meaning, show_default=default, parser=_path, metavar="PATH")


def _path(text: str) -> Path:
    """An empty text, as an unset variable leaves it, would be the working folder and replace what
    stands there."""
    if not text.strip():
        raise BadParameter("is empty; allowed is a path")
    return Path(text)


def scene_with(
    scene: str, settings: Sequence[str] | None, arguments: Sequence[str] = ()
) -> "Scene":
    """The scene of a name or path, with the values of `--set` beside what its file says, and with
    the arguments of the command that asks for it, as they were typed."""
    from comparisons.scenes.scene import Scene, with_settings

    command = [os.environ.get(LAUNCHED_AS, "crosscheck"), *arguments] if arguments else ()
    return with_settings(Scene.read(scene), settings or (), command)


def complete_scenes(incomplete: str) -> list[str]:
    """Names of scenes, TOML files and folders that begin so."""
    from comparisons.scenes.files import scene_names

    folder, slash, _ = incomplete.rpartition("/")
    paths = sorted(Path(folder + slash or ".").glob("[!.]*"))
    words = [
        f"{folder}{slash}{path.name}{'/' * path.is_dir()}"
        for path in paths
        if path.is_dir() or path.suffix == ".toml"
    ]
    return [name for name in (*scene_names(), *words) if name.startswith(incomplete)]


def completing(module: str, name: str) -> Callable[[str], list[str]]:
    """Names that begin so, of those that a module, imported then, has or returns under `name`."""

    def complete(incomplete: str) -> list[str]:
        names = getattr(import_module(module), name)
        return [n for n in (names() if callable(names) else names) if n.startswith(incomplete)]

    return complete


def complete_maps(incomplete: str) -> list[str]:
    """The names of finished maps, too."""
    finished = completing("comparisons.grid.map", "finished_names")
    return [*finished(incomplete), *complete_scenes(incomplete)]


def complete_models(incomplete: str) -> list[str]:
    """Models, and both of them."""
    return [name for name in (*HYPHENATED.values(), BOTH) if name.startswith(incomplete)]


complete_groups = completing("comparisons.grid.groups", "GROUPS")
complete_quantities = completing("comparisons.figures.quantity", "QUANTITIES")
BOTH = ",".join(HYPHENATED.values())
SCENE = "A TOML file, or a name that `scenes` lists."
SET = 'Another value of a field of the scene, such as body.yield_stress="1.2 GPa"; several times.'
MODELS = "Models to solve with, separated by commas."
SceneName = Annotated[str, Argument(help=SCENE, autocompletion=complete_scenes)]
Settings = Annotated[list[str] | None, Option("--set", metavar="FIELD=VALUE", help=SET)]
Models = Annotated[str, Option(help=MODELS, autocompletion=complete_models)]
Junit = Annotated[Path | None, path_option("File for JUnit XML: a testcase a figure.")]
