"""The command `crosscheck`: arguments in, exit status out.

The commands stand in `comparisons.commands`. They only take their arguments apart and return the
job to do; `main` does it, so that every error and interrupt of the work ends in one place. What a
command needs beyond the standard library its job imports: `crosscheck --help` loads typer alone."""

import atexit
import errno
import os
import signal
import sys
import traceback
import warnings
from collections.abc import Sequence
from contextlib import suppress
from itertools import pairwise
from types import FrameType
from typing import Annotated, NoReturn

import typer

from comparisons.commands import checks, doctor, finished, materials, run, scenes, studies
from comparisons.common.errors import (
    TRACEBACK,
    ExitStatus,
    InputError,
    SolverError,
    defect,
    drop,
    tell,
)

LIMITS = (errno.ENOMEM, errno.EAGAIN, errno.EMFILE, errno.ENFILE)  # of the system, that are reached
COMPLETION = "_CROSSCHECK_COMPLETE"  # by which a shell asks what a word may become
# Commands that Ctrl-C ends in their midst, and what they leave then.
LEFT = {
    **dict.fromkeys(("cost", "run"), "finished levels are kept"),
    **dict.fromkeys(("map", "sweep"), "finished points are kept"),
    **dict.fromkeys(("stability", "verify"), "finished cases are kept"),
}
LEFT = {name: f"{left}, the same command goes on from there" for name, left in LEFT.items()}
LEFT["rerun"] = "nothing recorded was changed, the same command does it again"
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
    if COMPLETION in os.environ:
        return app(prog_name="crosscheck")  # answers the shell, and exits
    is_own = arguments is None
    if is_own:
        for name in ("stdout", "stderr"):
            if getattr(sys, name) is None:  # closed: the next file would get its number
                setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_WRONLY), "w"))
        sys.stdout.reconfigure(errors="backslashreplace")  # a title in Latin-1, a unit in ASCII
        # the cores are for processes: figures are the same on every machine, none waits for another
        os.environ.setdefault("OMP_NUM_THREADS", "1")
        # nobody's plugins look into scenes: to search for them takes longer than to read one
        os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "1")
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    if is_own and signal.getsignal(signal.SIGINT) == signal.default_int_handler:
        signal.signal(signal.SIGINT, _interrupt_once)
    return _carry_out(arguments)


def entry() -> NoReturn:
    """Run the process's own command line, and end as Python does, but for taking apart all that was
    imported: a tenth of a second."""
    status = main()
    atexit._run_exitfuncs()
    with suppress(OSError):
        sys.stdout.flush()
        sys.stderr.flush()
    os._exit(status)


def _interrupt_once(number: int, frame: FrameType | None) -> None:
    """A second Ctrl-C does not cut off what the first one leaves, and its line."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    raise KeyboardInterrupt


def _check_places(arguments: list[str]) -> None:
    for option, value in pairwise([*arguments, "-"]):
        name, assigned, place = option.partition("=")
        if name in PLACES and not (place if assigned else value).strip():
            raise InputError(f"{name}: is empty; allowed is a path")


def _carry_out(arguments: list[str]) -> int:
    try:
        _check_places(arguments)
        how = {"prog_name": "crosscheck", "standalone_mode": False, "obj": arguments}
        job = app(arguments or ["--help"], **how)
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
        if isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG:
            name = os.fsdecode(error.filename or "")
            said = f"{name[:40]}…: is a name of {len(name)} characters, too long for a file"
            return _end(ExitStatus.BAD_INPUT, f"{said}; allowed is a shorter one")
        if hasattr(error, "format_message"):  # typer's and click's own; their base has moved
            said = error.format_message().replace("Value error, ", "")
            return _end(ExitStatus.BAD_INPUT, f"{said} (see crosscheck --help)")
        if (missing := getattr(error, "name", None)) in FINITE_ELEMENT_LIBRARIES:
            return _end(ExitStatus.BAD_INPUT, NO_FINITE_ELEMENTS.format(missing, sys.executable))
        try:
            sys.stdout.flush()
        except OSError:
            drop(sys.stdout)
        status = _status_of(error)
        if os.environ.get(TRACEBACK):
            traceback.print_exc()
            return int(status)
        return _end(status, f"{_account(error, status)} (set {TRACEBACK}=1 for the traceback)")


def _interrupted(arguments: list[str], *left: str) -> str:
    """What an interrupt leaves: as the work says, or else as its command always does."""
    usual = [LEFT[name] for name in arguments[:1] if name in LEFT]
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


def _status_of(error: Exception) -> ExitStatus:
    """The status of an error that is not the user's."""
    limit = isinstance(error, OSError) and error.errno in LIMITS
    # MUMPS says so while it solves
    if limit or isinstance(error, MemoryError) or "INFOG(1)=-13" in str(error):
        return ExitStatus.OUT_OF_MEMORY
    return ExitStatus.CANNOT_WRITE if isinstance(error, OSError) else ExitStatus.DEFECT


def _account(error: Exception, status: ExitStatus) -> str:
    """An error that is not the user's: Python's message, and of a defect where it was raised."""
    if status == ExitStatus.DEFECT:
        return f"internal error: {defect(error)}"
    return f"{type(error).__name__}: {error}"


if __name__ == "__main__":
    entry()
