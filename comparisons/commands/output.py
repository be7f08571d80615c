"""What commands print, and where: results to standard output, progress to a terminal alone."""

import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from comparisons.common.errors import one_line
from comparisons.common.mpi import is_several
from comparisons.common.progress import ProgressCallback, no_progress

UNSEEN_WIDTH = 160  # columns of a table that goes to a file or a pipe


@contextmanager
def progress() -> Iterator[ProgressCallback]:
    """A callback that shows the stage at work and the time left, if anybody watches."""
    if not sys.stderr.isatty():
        yield no_progress
        return
    from comparisons.common.progress_bar import progress_bar

    with progress_bar() as callback:
        yield callback


def is_watched() -> bool:
    """Whether results go to a terminal that somebody reads."""
    # Open MPI hands its processes a terminal, whatever its own output goes to
    return sys.stdout.isatty() and not is_several()


def show(renderable: object) -> None:
    """Print a table, as wide as the terminal if there is one."""
    from rich.console import Console

    if is_watched():
        Console().print(renderable)
    else:
        Console(width=UNSEEN_WIDTH, force_terminal=False).print(renderable)


def say(sentence: str) -> None:
    """Tell on standard error what concerns the user but is no failure of the command."""
    print(f"crosscheck: {one_line(sentence)}", file=sys.stderr)


def show_file(path: Path) -> None:
    """Print a file of the results: what `--json` asks for where it has just been written."""
    print(path.read_text(encoding="utf-8"), end="")


def show_json(content: object) -> None:
    """Print what `--json` asks for."""
    plain = not (sys.stdout.encoding or "").lower().startswith("utf")
    print(json.dumps(content, indent=2, ensure_ascii=plain, allow_nan=False))
