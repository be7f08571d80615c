"""The command `crosscheck`: arguments in, exit status out.

Commands only take their arguments apart and return the job to do; `main` does it, so that every
error and interrupt of the work ends in one place. What a command needs beyond the standard
library is imported by its job: `crosscheck --help` loads typer and nothing else.
"""

import difflib
import json
import os
import sys
import traceback
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from comparisons.errors import InputError, SolverError, one_line
from comparisons.exit_status import ExitStatus
from comparisons.rank import as_one, from_first, is_several
from comparisons.stages import Listener, silent

Job = Callable[[], int]

MODELS = {"half-plane": "half_plane", "finite-element": "finite_element"}
RESULTS = Path("results")
TRACEBACK = "CROSSCHECK_TRACEBACK"  # set to anything, errors show where they come from
FINISHED = (ExitStatus.DONE, ExitStatus.OUTSIDE_TOLERANCE, ExitStatus.NOT_CONVERGED)
UNSEEN_WIDTH = 160  # columns of a table that goes to a file or a pipe

app = typer.Typer(
    name="crosscheck",
    help="Checks the half-plane method for rough line contact against finite elements.",
    epilog="Exit status: 0 done; 1 done, and a quantity is outside its tolerance; "
    "2 wrong input; 3 a solver did not converge.",
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


@app.command()
def run(
    scene: Annotated[str, typer.Argument(help="A TOML file, or a name that `scenes` lists.")],
    out: Annotated[
        Path | None, typer.Option(help="Folder for the results.", show_default="results/<name>")
    ] = None,
    models: Annotated[
        str, typer.Option(help="Models to solve with, separated by commas.")
    ] = ",".join(MODELS),
    tolerance: Annotated[
        float | None,
        typer.Option(help="Relative, of all that is judged; refinement ends where it is met."),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print result.json instead of the table.")
    ] = False,
) -> Job:
    """Solve a scene with both models, compare them and judge."""
    return partial(_run, scene, out, models, tolerance, as_json)


@app.command()
def cost(
    scene: Annotated[str, typer.Argument(help="A TOML file, or a name that `scenes` lists.")],
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for the results.", show_default="results/<name>-cost"),
    ] = None,
    repeats: Annotated[int, typer.Option(help="Times that each setting is measured.")] = 3,
) -> Job:
    """Measure error against time of every method; name the cheapest for each tolerance."""
    return partial(_cost, scene, out, repeats)


@app.command()
def rerun(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder that a run has left.")],
    out: Annotated[Path | None, typer.Option(help="Folder that keeps the repetition.")] = None,
) -> Job:
    """Repeat a recorded run from its own record; report every figure that moved."""
    return partial(_rerun, folder, out)


@app.command()
def stability(
    out: Annotated[
        Path | None, typer.Option(help="Folder for the rows.", show_default="results/stability")
    ] = None,
) -> Job:
    """Solve the stiff and extreme cases; end with 0 only if every one holds."""
    return partial(_stability, out)


@app.command()
def verify(
    out: Annotated[
        Path | None, typer.Option(help="Folder for the figures.", show_default="results/verify")
    ] = None,
    junit: Annotated[Path | None, typer.Option(help="File for JUnit XML.")] = None,
) -> Job:
    """Hold both models to exact solutions, and stated uncertainties to true errors."""
    return partial(_verify, out, junit)


@app.command("map")
def map_of(
    scene: Annotated[str, typer.Argument(help="As for `run`, or the name of a finished map.")],
    points: Annotated[str, typer.Option(help="Values along x and y, as NxM.")] = "8x8",
    x: Annotated[
        str | None, typer.Option(help="GROUP or GROUP=FROM:TO.", show_default="by the scene")
    ] = None,
    y: Annotated[
        str | None, typer.Option(help="GROUP or GROUP=FROM:TO.", show_default="by the scene")
    ] = None,
    quantity: Annotated[str, typer.Option(help="The quantity to show.")] = "peak_pressure",
    workers: Annotated[
        str | None,
        typer.Option(help="Processes, or a Dask scheduler's address.", show_default="one a core"),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="Folder for the map.", show_default="results/<name>")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print map.json instead of the table.")
    ] = False,
) -> Job:
    """Map where the half-plane holds, over two dimensionless groups."""
    return partial(_map, (scene, points, x, y, quantity), workers, out, as_json)


@app.command()
def paper(
    out: Annotated[
        Path | None, typer.Option(help="Folder for the page.", show_default="results/paper")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print paper.json instead of the table.")
    ] = False,
) -> Job:
    """Compute Bailey and Sayles' (1991) figures anew; judge each claim by its number."""
    return partial(_paper, out, as_json)


@app.command()
def scenes() -> Job:
    """List the scenes that come with crosscheck."""
    return _scenes


@app.command()
def doctor() -> Job:
    """Show what is installed, what is missing, and how to get it."""
    return _doctor


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line (default: the process's own) and return the exit status.

    Several processes under mpirun are heard, and end, as one.
    """
    if not sys.warnoptions:
        warnings.simplefilter("ignore")  # libraries' notes to programmers, not to this reader
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    return as_one(lambda: _carry_out(arguments), FINISHED)


def _carry_out(arguments: list[str]) -> int:
    try:
        job = app(arguments or ["--help"], prog_name="crosscheck", standalone_mode=False)
        status = job() if callable(job) else job or ExitStatus.DONE
        sys.stdout.flush()
        return int(status)
    except KeyboardInterrupt as stop:
        return _end(ExitStatus.INTERRUPTED, "; ".join(["interrupted", *map(str, stop.args)]))
    except (BrokenPipeError, SystemExit):
        # nobody reads on: typer and rich make of it an exit with 1, which has another meaning here
        _drop_output()
        return int(ExitStatus.BROKEN_PIPE)
    except InputError as error:
        return _end(ExitStatus.BAD_INPUT, str(error))
    except SolverError as error:
        return _end(ExitStatus.NOT_CONVERGED, str(error))
    except Exception as error:
        if _is_interrupt(error):
            return _end(ExitStatus.INTERRUPTED, "interrupted")
        if hasattr(error, "format_message"):  # typer's and click's own; their base has moved
            return _end(ExitStatus.BAD_INPUT, f"{error.format_message()} (see crosscheck --help)")
        if os.environ.get(TRACEBACK):
            traceback.print_exc()
            return int(_defect(error))
        return _end(_defect(error), f"{_account(error)} (set {TRACEBACK}=1 for the traceback)")


def _run(scene: str, out: Path | None, models: str, tolerance: float | None, as_json: bool) -> int:
    chosen = _models(models)
    from comparisons.files import check_writable
    from comparisons.resolve import load_scene

    resolved = from_first(lambda: load_scene(scene))
    if tolerance is not None:
        from comparisons.tolerance import with_tolerance

        resolved = with_tolerance(resolved, tolerance)
    directory = out or RESULTS / resolved.name
    from_first(lambda: check_writable(directory))
    from comparisons.run import run as run_scene

    with _progress() as progress:
        outcome = run_scene(resolved, directory, chosen, progress)
    if as_json:
        print(json.dumps(outcome.result, indent=2, ensure_ascii=False, allow_nan=False))
    else:
        from comparisons.table import summary

        _show(summary(outcome))
    return outcome.exit_status


def _cost(scene: str, out: Path | None, repeats: int) -> int:
    from comparisons.cost import cost as measured_cost
    from comparisons.cost_table import cost_summary
    from comparisons.resolve import load_scene

    resolved = load_scene(scene)
    directory = out or RESULTS / f"{resolved.name}-cost"
    with _progress() as progress:
        found = measured_cost(resolved, directory, repeats, progress)
    _show(cost_summary(found))
    print(f"diagrams {directory / 'cost.html'}, figures {directory / 'cost.json'}")
    return ExitStatus.DONE


def _rerun(folder: Path, out: Path | None) -> int:
    from comparisons.rerun import rerun as repeat
    from comparisons.rerun_table import rerun_summary

    with _progress() as progress:
        repetition = repeat(folder, out, progress)
    _show(rerun_summary(repetition))
    return repetition.exit_status


def _stability(out: Path | None) -> int:
    from comparisons.stability.run import run_stability
    from comparisons.stability.table import stability_table

    with _progress() as progress:
        result = run_stability(out or RESULTS / "stability", progress)
    _show(stability_table(result))
    return result.exit_status


def _verify(out: Path | None, report: Path | None) -> int:
    from comparisons.verify import verify as verify_all
    from comparisons.verify_table import verify_summary

    with _progress() as progress:
        found = verify_all(out or RESULTS / "verify", report, progress)
    _show(verify_summary(found))
    return found.exit_status


def _map(
    asked: tuple[str | None, ...], workers: str | None, out: Path | None, as_json: bool
) -> int:
    from comparisons.maps.request import request_of

    request = from_first(lambda: request_of(*asked))
    directory = out or RESULTS / request.name
    from comparisons.maps.command import exit_status, mapped

    with _progress() as progress:
        content = mapped(request, directory, workers, progress)
    if content is None:  # it worked for the first process
        return ExitStatus.DONE
    if as_json:
        print(json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False))
    else:
        from comparisons.maps.table import map_table

        _show(map_table(content, directory))
    return exit_status(content)


def _paper(out: Path | None, as_json: bool) -> int:
    from comparisons.paper.reproduce import paper as reproduced

    with _progress() as progress:
        found = reproduced(out or RESULTS / "paper", listener=progress)
    if as_json:
        print(json.dumps(found.as_dict(), indent=2, ensure_ascii=False, allow_nan=False))
    else:
        from comparisons.paper.table import paper_table

        _show(paper_table(found))
    return found.exit_status


def _scenes() -> int:
    from comparisons.scene_file import scene_titles

    titles = scene_titles()
    width = max(map(len, titles))
    for name, title in titles.items():
        print(f"{name:{width}}  {title}")
    return ExitStatus.DONE


def _doctor() -> int:
    from comparisons.doctor import doctor, doctor_table

    checks = doctor()
    _show(doctor_table(checks))
    return ExitStatus.DONE if all(c.ok for c in checks) else ExitStatus.SOMETHING_MISSING


def _models(given: str) -> tuple[str, ...]:
    """The models' names in results, in the order of `MODELS`."""
    named = [name.strip() for name in given.split(",") if name.strip()]
    for name in named:
        if name not in MODELS:
            near = difflib.get_close_matches(name, MODELS, n=1, cutoff=0.0)[0]
            raise InputError(
                f"--models: there is no model {name}; the nearest is {near}; "
                f"allowed are {', '.join(MODELS)}"
            )
    if not named:
        raise InputError(f"--models: is empty; allowed are {', '.join(MODELS)}")
    return tuple(MODELS[name] for name in MODELS if name in named)


@contextmanager
def _progress() -> Iterator[Listener]:
    """A listener that shows the stage at work, if anybody watches standard error."""
    if not sys.stderr.isatty():
        yield silent
        return
    from rich.console import Console
    from rich.text import Text

    with Console(stderr=True).status("") as status:
        yield lambda stage: status.update(Text(stage))


def _show(renderable: object) -> None:
    from rich.console import Console

    # Open MPI hands its processes a terminal, whatever its own output goes to
    if sys.stdout.isatty() and not is_several():
        Console().print(renderable)
    else:
        Console(width=UNSEEN_WIDTH, force_terminal=False).print(renderable)


def _end(status: ExitStatus, message: str) -> int:
    """Say the one line that goes with a status."""
    print(f"crosscheck: {one_line(message)}", file=sys.stderr)
    return int(status)


def _is_interrupt(error: BaseException) -> bool:
    """Whether Ctrl-C is behind it: a compiled module that is being imported says ImportError."""
    while error and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _defect(error: Exception) -> ExitStatus:
    if not isinstance(error, OSError):
        return ExitStatus.DEFECT
    try:
        sys.stdout.flush()
    except OSError:
        _drop_output()
    return ExitStatus.CANNOT_WRITE


def _drop_output() -> None:
    """Have what is left of standard output go nowhere: the last flush must not fail again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _account(error: Exception) -> str:
    """An error that is not the user's, and where in the program it came up."""
    if isinstance(error, OSError):
        return f"{error.filename or 'output'}: {error.strerror or error}"
    place = traceback.extract_tb(error.__traceback__)[-1]
    return (
        f"internal error: {type(error).__name__}: {error} "
        f"in {Path(place.filename).name}, line {place.lineno}"
    )


if __name__ == "__main__":
    sys.exit(main())
