"""`crosscheck run`: one scene by both models, compared and judged."""

import gc
import math
import sys
from collections.abc import Sequence
from contextlib import nullcontext
from io import StringIO
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated

from typer import Context, Option

from comparisons.commands.arguments import (
    RESULTS,
    Junit,
    Models,
    SceneName,
    Settings,
    json_option,
    out_option,
    scene_with,
)
from comparisons.commands.output import progress, say_warnings, show_either
from comparisons.common.errors import ExitStatus, InputError, tell
from comparisons.figures.quantity import HYPHENATED, models_named

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from comparisons.common.tasks import Opens
    from comparisons.judging.study import Run
    from comparisons.scenes.scene import Scene
    from comparisons.scenes.surface import SceneSurface


BOTH = ",".join(HYPHENATED.values())
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
        from comparisons.common.files import (
            check_file,
            check_writable,
            holds_comparison,
            write_whole,
        )
        from comparisons.output.plausibility import warnings_about, warnings_about_result
        from comparisons.runs.run import Known, finish, solve_scene
        from comparisons.scenes.surface import surface_of

    gc.freeze()  # a collection would look through all that was imported
    began = perf_counter()
    chosen = models_named(models, "--models")
    asked = _read(scene_with(scene, settings, context.obj), answer or (), units, tolerance, law)
    surface = surface_of(asked)
    if plan and as_json:
        raise InputError("run: allowed is one of --plan, --json")
    if plan:
        return _say_plan(asked, surface, chosen)
    directory = out or RESULTS / asked.name
    check_writable(directory)
    if junit is not None:
        check_file(junit)
    if len(chosen) == 1 and holds_comparison(directory):
        tell(f"{directory}: this run of one model replaces a comparison; --out keeps both")
    say_warnings(warnings_about(asked, surface))  # before anybody waits for the solution
    with progress() as callback, _workers(workers) as opens:
        solved = solve_scene(asked, directory, chosen, callback, opens, Known(surface))
    try:
        _say_answer(solved, details, as_json)  # before the report is drawn
    except BrokenPipeError:
        sys.stdout = StringIO()  # processes that start would write out the rest of it first
        raise
    finally:  # whoever reads on: the files are for others
        say_warnings(warnings_about_result(solved))
        with progress() as callback:
            drawn = finish(solved, callback)
            if pdf and drawn:
                callback("printing the report")
                _print(directory)
        if junit is not None:
            from comparisons.output.junit import junit_xml, run_cases_of

            write_whole(junit, junit_xml(asked.name, run_cases_of(solved), perf_counter() - began))
    if not as_json:
        first = f"{directory / 'report.html'}, result.json" if drawn else directory / "result.json"
        print(f"written: {first} and the fields beside it")
    return solved.exit_status


def _say_plan(scene: "Scene", surface: "SceneSurface", models: tuple[str, ...]) -> int:
    """What a run would do, and what it would take."""
    from comparisons.output.terminal import PLAIN
    from comparisons.runs.run import planned

    for line in planned(scene, surface, models):
        print(line.translate(PLAIN))
    return ExitStatus.DONE


def _print(directory: Path) -> None:
    """Print the report; a run whose report no browser prints is as good as any other."""
    from comparisons.output.page.pdf import NoPdfError, print_report

    try:
        print_report(directory)
    except NoPdfError as error:
        tell(str(error))


def _say_answer(solved: "Run", details: bool, as_json: bool) -> None:
    from comparisons.output.result import content_of, result_of
    from comparisons.output.terminal import summary

    content = content_of(result_of(solved)) if as_json else {}
    show_either(as_json, content, lambda: summary(solved, details))
    sys.stdout.flush()


def _read(
    asked: "Scene",
    answers: Sequence[str],
    units: str | None,
    tolerance: str | None,
    law: str | None,
) -> "Scene":
    """The scene with answers from outside, NAME=FILE each, in units such as mm,MPa, and a tolerance
    and a law of elasticity in place of its own."""
    from comparisons.scenes.scene import with_law, with_tolerance
    from comparisons.scenes.studies.answers import answers_named

    if units is not None and not answers:
        raise InputError("--units: is given without --answer; allowed is beside it")
    if answers:
        named = answers_named(answers, asked.written.get("answers"), units)
        asked = asked.changed("answers", named)
    if law is not None:
        asked = with_law(asked, law)
    return asked if tolerance is None else with_tolerance(asked, _relative(tolerance))


def _relative(text: str) -> float:
    """A tolerance as it is typed, a number or a percentage."""
    from comparisons.common.units import DIMENSIONLESS, to_si

    try:
        value = to_si(text, DIMENSIONLESS) if "%" in text else float(text.encode("ascii"))
    except ValueError:
        value = math.nan
    if not 0.0 < value < 1.0:
        raise InputError(f"--tolerance: is {text}; allowed is a number above 0 and below 1, or 5%")
    return value


def _workers(scheduler: str | None) -> "AbstractContextManager[Opens | None]":
    """Those of a Dask scheduler, or none but this machine's."""
    if scheduler is None:
        return nullcontext()
    from comparisons.common.executors import cluster

    return cluster(scheduler)
