"""`crosscheck run`: one scene by both models, compared and judged."""

import gc
import sys
from collections.abc import Sequence
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Context, Option

from comparisons.commands.arguments import (
    BOTH,
    RESULTS,
    Junit,
    Models,
    SceneName,
    Settings,
    json_option,
    out_option,
    scene_with,
)
from comparisons.commands.output import plain, progress, say_written, show_either
from comparisons.common.errors import ExitStatus, InputError

if TYPE_CHECKING:
    from comparisons.scenes.scene import Scene

Tolerance = Annotated[
    str | None,
    Option(help="Relative, such as 5%, of all that is judged; refinement ends where met."),
]
Law = Annotated[
    str | None,
    Option(help="Of elasticity, of every elastic body; linear: nothing deforms finitely."),
]
Workers = Annotated[
    str | None, Option(help="A Dask scheduler's address: it solves the samples of [scatter].")
]
Answers = Annotated[
    list[str] | None,
    Option(metavar="NAME=FILE", help="An answer from outside: pressures or a result."),
]
Units = Annotated[
    str | None,
    Option(metavar="LENGTH,STRESS", help="Of the files of --answer, such as mm,MPa; else SI."),
]
Details = Annotated[
    bool, Option("--details", help="Every compared quantity, where the models agree, too.")
]


def run(
    context: Context,
    scene: SceneName,
    settings: Settings = None,
    out: Annotated[Path | None, out_option("results", "<name>")] = None,
    models: Models = BOTH,
    tolerance: Tolerance = None,
    law: Law = None,
    junit: Junit = None,
    workers: Workers = None,
    answer: Answers = None,
    units: Units = None,
    plan: Annotated[
        bool, Option("--plan", help="Only say what would be solved, and how long it takes.")
    ] = False,
    details: Details = False,
    pdf: Annotated[bool, Option("--pdf", help="Print the report to PDF, too.")] = False,
    as_json: Annotated[bool, json_option("result.json")] = False,
) -> int:
    """Solve a scene with both models, compare them and judge."""
    from comparisons.common.processes import uncollected

    with uncollected():
        from comparisons import api
        from comparisons.common.files import check_file
        from comparisons.scenes.files import value_of
    gc.freeze()  # a collection would look through all that was imported
    asked = _with_answers(scene_with(scene, settings, context.obj), answer or (), units)
    how = {"law": law, "tolerance": None if tolerance is None else value_of(tolerance)}
    if plan and as_json:
        raise InputError("run: allowed is one of --plan, --json")
    if plan:
        print(*map(plain, api.plan(asked, models, **how)), sep="\n")
        return ExitStatus.DONE
    folder = out or RESULTS / asked.name
    if junit is not None:
        check_file(junit)
    with progress() as callback:
        solved = api.run(
            asked, models, out=folder, files=False, workers=workers, progress=callback, **how
        )
    try:  # before the report is drawn
        show_either(as_json, lambda: solved.result, lambda: solved.tables(details))
        sys.stdout.flush()
    except BrokenPipeError:
        sys.stdout = StringIO()  # processes that start would write out the rest of it first
        raise
    finally:  # whoever reads on: the files are for others
        with progress() as callback:
            drawn = solved.write(junit=junit, pdf=pdf, progress=callback)
    if not as_json:
        say_written(folder, drawn)
    return solved.exit_status


def _with_answers(asked: "Scene", answers: Sequence[str], units: str | None) -> "Scene":
    """The scene with answers from outside, NAME=FILE each, in units such as mm,MPa."""
    from comparisons.scenes.studies.answers import answers_named

    if units is not None and not answers:
        raise InputError("--units: is given without --answer; allowed is beside it")
    if not answers:
        return asked
    return asked.changed("answers", answers_named(answers, asked.written.get("answers"), units))
