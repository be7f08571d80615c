"""The command `crosscheck`: arguments in, exit status out.

The commands stand in `comparisons.commands`. They only take their arguments apart and return the
job to do; `main` does it, so that every error and interrupt of the work ends in one place. What a
command needs beyond the standard library its job imports: `crosscheck --help` loads typer alone."""

import errno
import logging
import os
import sys
import traceback
import warnings
from collections.abc import Sequence
from contextlib import suppress
from itertools import pairwise
from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands import checks, doctor, finished, materials, run, scenes, studies
from comparisons.common.errors import ExitStatus, InputError, SolverError, address_space, drop, tell

TRACEBACK = "CROSSCHECK_TRACEBACK"  # set to anything, errors show where they come from
COMPLETION = "_CROSSCHECK_COMPLETE"  # by which a shell asks what a word may become
# Commands that work in a child process, which Ctrl-C ends, and what they leave then. A map, a
# sweep and a cost study have processes of their own, and end them.
WATCHED = {
    "run": "finished levels are kept, the same command goes on from there",
    "rerun": "nothing was changed, the same command starts again",
    **dict.fromkeys(
        ("stability", "verify"), "finished cases are kept, the same command goes on from there"
    ),
}
# Options that name a place. An empty one, as an unset variable leaves it, would mean the working
# folder and replace what stands there.
PLACES = ("--out", "--summary", "--junit")
# Of finite elements, which no wheel brings along.
FINITE_ELEMENT_LIBRARIES = ("dolfinx", "basix", "ufl", "petsc4py", "mpi4py")
NO_FINITE_ELEMENTS = (
    "finite elements take {0}, which {1} does not have; allowed is run --models half-plane, or: "
    "conda install -c conda-forge fenics-dolfinx (on Debian and Ubuntu ./crosscheck of a checkout)"
)

app = typer.Typer(
    name="crosscheck",
    help="Checks the half-plane method for rough line contact against finite elements.",
    epilog="Exit status: 0 done, and whatever was judged is within its tolerance; 1 done, and "
    "something is outside; 2 wrong input; 3 a solver did not converge; 4 done, and a verdict is "
    "inconclusive.",
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _say_version(asked: bool) -> None:
    if asked:
        from importlib.metadata import version

        print(f"crosscheck {version('crosscheck')}")
        raise typer.Exit


@app.callback()
def _whole(
    version: Annotated[
        bool, typer.Option("--version", callback=_say_version, is_eager=True, help="Show it.")
    ] = False,
) -> None:
    """Checks the half-plane method for rough line contact against finite elements."""


for name, command in {
    "run": run.run,
    "cost": studies.cost,
    "map": studies.map_of,
    "sweep": studies.sweep,
    "report": finished.report,
    "table": finished.table,
    "rerun": finished.rerun,
    "stability": checks.stability,
    "verify": checks.verify,
    "scenes": scenes.scenes,
    "materials": materials.materials,
    "deck": scenes.deck,
    "init": scenes.init,
    "doctor": doctor.doctor,
}.items():
    app.command(name)(command)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line (default: the process's own) and return the exit status."""
    if not sys.warnoptions:
        warnings.simplefilter("ignore")  # libraries' notes to programmers
        logging.getLogger("matplotlib").setLevel(logging.ERROR)  # where no home can be written
    if COMPLETION in os.environ:
        return app(prog_name="crosscheck")  # answers the shell, and exits
    is_own = arguments is None
    if is_own:
        _open_streams()
        # the cores are for processes: figures are the same on every machine, none waits for another
        os.environ.setdefault("OMP_NUM_THREADS", "1")
        # nobody's plugins look into scenes: to search for them takes longer than to read one
        os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "1")
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    if is_own and arguments[:1] and arguments[0] in WATCHED:
        from comparisons.common.interrupt import watched

        return watched(lambda: _carry_out(arguments), WATCHED[arguments[0]])
    return _carry_out(arguments)


def _open_streams() -> None:
    """Replace streams that were closed, and let the output take every character.

    Else the next file that is opened gets a closed stream's number, and what libraries print."""
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_RDWR), mode))
    sys.stdout.reconfigure(errors="backslashreplace")  # a title in Latin-1, a unit in ASCII


def _check_places(arguments: list[str]) -> None:
    for option, value in pairwise([*arguments, "-"]):
        name, assigned, place = option.partition("=")
        if name in PLACES and not (place if assigned else value).strip():
            raise InputError(f"{name}: is empty; allowed is a path")


def _carry_out(arguments: list[str]) -> int:
    try:
        _check_places(arguments)
        job = app(arguments or ["--help"], prog_name="crosscheck", standalone_mode=False)
        status = job() if callable(job) else job or ExitStatus.DONE
        sys.stdout.flush()
        return int(status)
    except KeyboardInterrupt as stop:
        return _end(ExitStatus.INTERRUPTED, _interrupted(arguments, *map(str, stop.args)))
    except (BrokenPipeError, SystemExit) as end:
        if isinstance(end, SystemExit) and not end.code:  # the shell's completion is installed
            sys.stdout.flush()
            return int(ExitStatus.DONE)
        # nobody reads on: typer and rich would exit with 1, which has another meaning here
        drop(sys.stdout)
        return int(ExitStatus.BROKEN_PIPE)
    except InputError as error:
        return _end(ExitStatus.BAD_INPUT, str(error))
    except SolverError as error:
        return _end(ExitStatus.NOT_CONVERGED, str(error))
    except Exception as error:
        if _is_interrupt(error):
            return _end(ExitStatus.INTERRUPTED, _interrupted(arguments))
        if hasattr(error, "format_message"):  # typer's and click's own; their base has moved
            said = error.format_message().replace("Value error, ", "")
            return _end(ExitStatus.BAD_INPUT, f"{said} (see crosscheck --help)")
        if (missing := getattr(error, "name", None)) in FINITE_ELEMENT_LIBRARIES:
            return _end(ExitStatus.BAD_INPUT, NO_FINITE_ELEMENTS.format(missing, sys.executable))
        status = _defect(error)
        if os.environ.get(TRACEBACK):
            with suppress(OSError):
                traceback.print_exc()
            return int(status)
        return _end(status, f"{_account(error, status)} (set {TRACEBACK}=1 for the traceback)")


def _interrupted(arguments: list[str], *left: str) -> str:
    """What an interrupt leaves: as the work says, or else as its command always does; `run` says it
    as soon as a level is finished."""
    usual = [WATCHED[name] for name in arguments[:1] if name in WATCHED and name != "run"]
    return "; ".join(["interrupted", *(left or usual)])


def _end(status: ExitStatus, message: str) -> int:
    """Print the line that goes with a status."""
    tell(message)
    return int(status)


def _is_interrupt(error: BaseException) -> bool:
    """Whether Ctrl-C is behind it: a compiled module that is being imported says ImportError."""
    while error and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _defect(error: Exception) -> ExitStatus:
    try:
        sys.stdout.flush()
    except OSError:
        drop(sys.stdout)
    if _limit(error):
        return ExitStatus.OUT_OF_MEMORY
    out_of_memory = (
        isinstance(error, MemoryError),
        getattr(error, "errno", None) == errno.ENOMEM,
        "INFOG(1)=-13" in str(error),  # MUMPS, while it solves
        # where the system maps no more memory, libraries say that a part of them is not there
        isinstance(error, ImportError) and (address_space() or "failed to map" in str(error)),
        address_space() and "can't start new thread" in str(error),
    )
    if any(out_of_memory):
        return ExitStatus.OUT_OF_MEMORY
    return ExitStatus.CANNOT_WRITE if isinstance(error, OSError) else ExitStatus.DEFECT


def _limit(error: Exception) -> str:
    """What the system lets the user have too few of, or nothing."""
    number = getattr(error, "errno", None)
    if number in (errno.EMFILE, errno.ENFILE) or "Too many open files" in str(error):
        return "open files (ulimit -n)"
    threads = "can't start new thread" in str(error) and not address_space()
    return "processes (ulimit -u)" if number == errno.EAGAIN or threads else ""


def _account(error: Exception, status: ExitStatus) -> str:
    """An error that is not the user's, and where in the program it was raised."""
    if limit := _limit(error):
        return f"the system allows this user no more {limit}; allowed is a higher limit"
    if status == ExitStatus.OUT_OF_MEMORY:
        limit = address_space()
        remedy = "allowed is a smaller scene (budget.memory, resolution, stress.points)"
        if limit:
            remedy = f"the process may have {limit / 1e9:.3g} GB of address space (ulimit -v)"
        return f"out of memory: {str(error) or type(error).__name__}; {remedy}"
    if isinstance(error, OSError):
        return f"{error.filename or 'standard output'}: {error.strerror or error}"
    place = traceback.extract_tb(error.__traceback__)[-1]
    return (
        f"internal error: {type(error).__name__}: {error} "
        f"in {Path(place.filename).name}, line {place.lineno}"
    )


if __name__ == "__main__":
    sys.exit(main())
