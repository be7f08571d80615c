"""`crosscheck run`: one scene by both models, compared and judged."""

import difflib
import sys
from functools import partial
from pathlib import Path
from typing import Annotated, Literal

import typer

from comparisons.commands import completion
from comparisons.commands.arguments import RESULTS, Job, Scene, json_option
from comparisons.commands.output import progress, say, show, show_json
from comparisons.common.errors import InputError, SceneError
from comparisons.common.model_names import HYPHENATED
from comparisons.common.mpi import from_first, is_first

Fields = Literal["auto", "vtu", "vtkhdf", "msh"]

NAMES = {words: model for model, words in HYPHENATED.items()}  # of models, as options have them


def run(
    scene: Scene,
    out: Annotated[
        Path | None, typer.Option(help="Folder for the results.", show_default="results/<name>")
    ] = None,
    models: Annotated[
        str,
        typer.Option(
            help="Models to solve with, separated by commas.", autocompletion=completion.models
        ),
    ] = ",".join(NAMES),
    tolerance: Annotated[
        float | None,
        typer.Option(help="Relative, of all that is judged; refinement ends where it is met."),
    ] = None,
    fields: Annotated[
        Fields, typer.Option(help="File format of the stress fields; auto is by their size.")
    ] = "auto",
    pdf: Annotated[bool, typer.Option("--pdf", help="Print the report to PDF, too.")] = False,
    as_json: Annotated[bool, json_option("result.json")] = False,
) -> Job:
    """Solve a scene with both models, compare them and judge."""
    return partial(_run, scene, out, models, tolerance, fields, pdf, as_json)


def _run(
    scene: str,
    out: Path | None,
    models: str,
    tolerance: float | None,
    fields: str,
    pdf: bool,
    as_json: bool,
) -> int:
    chosen = _models(models)
    from comparisons.common.files import check_writable
    from comparisons.results.plausibility import doubts_about, doubts_about_result
    from comparisons.scenes.resolve import load_scene

    resolved = from_first(lambda: load_scene(scene))
    if tolerance is not None:
        from comparisons.scenes.resolve import with_tolerance

        resolved = with_tolerance(resolved, tolerance)
    directory = out or RESULTS / resolved.name
    from_first(lambda: check_writable(directory))
    from comparisons.runs.run import run as run_scene

    doubts = doubts_about(resolved)
    if sys.stderr.isatty():  # whoever waits need not wait for that
        _say_doubts(doubts)
    with progress() as callback:
        try:
            outcome = run_scene(resolved, directory, chosen, callback, fields)
        except SceneError as error:
            raise SceneError("; ".join([str(error), *doubts])) from error
        if pdf and is_first():
            callback("printing the report")
            _print(directory)
    if as_json:
        show_json(outcome.result)
    else:
        from comparisons.report.terminal import summary

        show(summary(outcome))
    _say_doubts([*doubts, *doubts_about_result(outcome)])
    return outcome.exit_status


def _say_doubts(doubts: list[str]) -> None:
    if not (doubts and is_first()):
        return
    from comparisons.report.terminal import PLAIN

    for doubt in doubts:
        say(f"doubtful: {doubt.translate(PLAIN)}")


def _print(directory: Path) -> None:
    """Print the report; without a browser say so, the run is none the worse for it."""
    from comparisons.report.pdf import NoPdfError, print_report

    try:
        print_report(directory)
    except NoPdfError as error:
        say(str(error))


def _models(given: str) -> tuple[str, ...]:
    """The models' names in results, in the order of `NAMES`."""
    named = [name.strip() for name in given.split(",") if name.strip()]
    for name in named:
        if name not in NAMES:
            near = difflib.get_close_matches(name, NAMES, n=1, cutoff=0.0)[0]
            raise InputError(
                f"--models: there is no model {name}; the nearest is {near}; "
                f"allowed are {', '.join(NAMES)}"
            )
    if not named:
        raise InputError(f"--models: is empty; allowed are {', '.join(NAMES)}")
    return tuple(NAMES[name] for name in NAMES if name in named)
