"""The command `crosscheck`: arguments in, exit status out.

The commands stand in `comparisons.commands`. What one needs beyond the standard library it imports
itself: `crosscheck --help` loads typer alone. Every error and interrupt of a command ends in
`main`."""

import atexit
import gc
import os
import signal
import sys
import traceback
import warnings
from collections.abc import Sequence
from contextlib import suppress
from types import FrameType
from typing import Annotated, NoReturn

import typer
from typer.main import get_command

from comparisons.commands import checks, doctor, finished, materials, run, scenes, studies
from comparisons.common.errors import (
    TRACEBACK,
    ExitStatus,
    InputError,
    MissingLibrary,
    SolverError,
    defect,
    tell,
)

COMPLETION = "_CROSSCHECK_COMPLETE"  # by which a shell asks what a word may become
# What a command keeps of its work as it goes on.
KEPT = {"run": "levels", "cost": "levels", "map": "points", "sweep": "points"}
KEPT |= {"stability": "cases", "verify": "cases"}

app = typer.Typer(
    name="crosscheck",
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


for command in (
    *(run.run, studies.cost, studies.map, studies.sweep),
    *(finished.report, finished.table, finished.rerun, checks.stability, checks.verify),
    *(scenes.scenes, materials.materials, scenes.deck, scenes.init, doctor.doctor),
):
    app.command()(command)


def entry() -> NoReturn:
    """Run the process's own command line, and end as Python does, but for taking apart all that was
    imported: a tenth of a second."""
    if not sys.warnoptions:
        warnings.simplefilter("ignore")  # libraries' notes to programmers
    # the cores are for processes: figures are the same on every machine, none waits for another
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    gc.set_threshold(50_000)  # of garbage there is little: to look for it at Python's 700 costs 4 %
    # nobody's plugins look into scenes: to search for them takes longer than to read one
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "1")
    if signal.getsignal(signal.SIGINT) == signal.default_int_handler:
        signal.signal(signal.SIGINT, _interrupt_once)
    if COMPLETION in os.environ:
        app(prog_name="crosscheck")  # answers the shell, and exits
    if sys.stdout is not None:  # a closed one
        sys.stdout.reconfigure(errors="backslashreplace")  # a title in Latin-1, a unit in ASCII
    status = main(sys.argv[1:])
    atexit._run_exitfuncs()
    with suppress(OSError, AttributeError):
        sys.stdout.flush()
        sys.stderr.flush()
    os._exit(status)


def _interrupt_once(number: int, frame: FrameType | None) -> None:
    """A second Ctrl-C does not cut off what the first one leaves, and its line."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    raise KeyboardInterrupt


def main(arguments: Sequence[str]) -> int:
    """Run a command line and return its exit status; an error is one line on standard error."""
    try:
        return _carried_out(arguments)
    except (BrokenPipeError, SystemExit) as end:  # rich exits where nobody reads on
        return int(ExitStatus.BROKEN_PIPE if getattr(end, "code", True) else ExitStatus.DONE)
    except (Exception, KeyboardInterrupt) as error:
        if os.environ.get(TRACEBACK):
            traceback.print_exc()
        status, said = _account(error, KEPT.get(next(iter(arguments), "")))
        tell(said)
        return int(status)


def _carried_out(arguments: Sequence[str]) -> int:
    """Status that the command returns; its own handling of errors would be typer's."""
    group, words = get_command(app), list(arguments) or ["--help"]
    try:
        with group.make_context("crosscheck", words, obj=list(arguments)) as context:
            status = group.invoke(context)
    except typer.Exit as end:
        status = end.exit_code
    print(end="", flush=True)  # what cannot be written is an error now
    return int(status)


def _account(error: BaseException, kept: str | None) -> tuple[ExitStatus, str]:
    """The status of an error, and its line: what is not the user's has Python's own words."""
    if _is_interrupt(error):
        left = f"; finished {kept} are kept, the same command goes on from there" if kept else ""
        return ExitStatus.INTERRUPTED, f"interrupted{left}"
    if isinstance(error, InputError | MissingLibrary):
        return ExitStatus.BAD_INPUT, str(error)
    if isinstance(error, SolverError):
        return ExitStatus.NOT_CONVERGED, str(error)
    if hasattr(error, "format_message"):  # typer's own, whose base has moved between releases
        said = error.format_message().replace("Value error, ", "")
        return ExitStatus.BAD_INPUT, f"{said} (see crosscheck --help)"
    said, hint = f"{type(error).__name__}: {error}", f"(set {TRACEBACK}=1 for the traceback)"
    if isinstance(error, MemoryError):
        return ExitStatus.OUT_OF_MEMORY, f"{said} {hint}"
    if isinstance(error, OSError):
        return ExitStatus.CANNOT_WRITE, f"{said} {hint}"
    return ExitStatus.DEFECT, f"internal error: {defect(error)} {hint}"


def _is_interrupt(error: BaseException) -> bool:
    """Whether Ctrl-C is behind it: a compiled module that is being imported says ImportError."""
    while error and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


if __name__ == "__main__":
    entry()
