"""Errors of one line, and the exit statuses that the command line ends with."""

import difflib
import re
import sys
import traceback
from collections.abc import Iterable
from contextlib import suppress
from enum import IntEnum
from importlib.util import find_spec
from pathlib import Path

TRACEBACK = "CROSSCHECK_TRACEBACK"  # set to anything, errors show where they come from


class ExitStatus(IntEnum):
    """0 to 4 are for scripts to branch on; the others follow sysexits.h and the shells."""

    DONE = 0
    OUTSIDE_TOLERANCE = 1
    SOMETHING_MISSING = 1  # of `doctor`
    BAD_INPUT = 2
    NOT_CONVERGED = 3
    INCONCLUSIVE = 4
    DEFECT = 70  # EX_SOFTWARE: an error of the program, never of the input
    OUT_OF_MEMORY = 71  # EX_OSERR
    CANNOT_WRITE = 74  # EX_IOERR
    INTERRUPTED = 130  # 128 + SIGINT
    BROKEN_PIPE = 141  # 128 + SIGPIPE


class OneLineError(Exception):
    """`str` is one line for the user."""

    def __init__(self, message: str) -> None:
        super().__init__(one_line(message))


class InputError(OneLineError, ValueError):
    """Wrong input, with what is allowed instead; the command line ends with status 2."""


class SceneError(InputError):
    """A scene, or a file it names, is wrong: "file: section.field: problem; allowed is …"."""


class SolverError(OneLineError, RuntimeError):
    """A solver did not converge; the command line ends with status 3."""


class MissingLibrary(OneLineError, ModuleNotFoundError):
    """Error where a library is needed and not installed; the command line ends with 2."""


def check_finite_elements() -> None:
    """Raise MissingLibrary where there is no dolfinx, which no wheel brings along."""
    if find_spec("dolfinx") is None:
        raise MissingLibrary(
            f"finite elements need dolfinx, which {sys.executable} does not have; allowed is run "
            "--models half-plane, or: conda install -c conda-forge fenics-dolfinx (on Debian and "
            "Ubuntu ./crosscheck of a checkout)"
        )


def nearest(name: str, names: Iterable[str], alike: float = 0.0) -> str | None:
    """The one of `names` that is most like `name`; None where difflib's ratio is below `alike`."""
    return next(iter(difflib.get_close_matches(name, list(names), n=1, cutoff=alike)), None)


def one_line(text: str) -> str:
    """The text without line breaks, `printable`."""
    return printable(re.sub(r"[ \t\r\n]+", " ", text).strip())


def printable(line: str) -> str:
    """The line with what a terminal would obey written as escapes."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in line)


def defect(error: BaseException) -> str:
    """An error of the program in one phrase: Python's message, and where it was raised."""
    if not hasattr(error, "__notes__"):
        note_place(error)
    return f"{type(error).__name__}: {error} in {error.__notes__[0]}"


def note_place(error: BaseException) -> None:
    """Note where an error was raised: its traceback does not leave the process."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    error.add_note(f"{Path(place.filename).name}, line {place.lineno}")


def tell(message: str) -> None:
    """Print one line to standard error, nothing where that cannot be written."""
    with suppress(OSError):
        print(f"crosscheck: {one_line(message)}", file=sys.stderr, flush=True)
