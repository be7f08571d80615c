"""Output of commands, and where: results to standard output, progress to standard error."""

import json
import math
import os
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic

from comparisons.common.errors import tell
from comparisons.common.numbers import is_whole
from comparisons.common.progress import Early, Lasting, ProgressCallback, Step

UNSEEN_WIDTH = 160  # columns of a table that goes to a file or a pipe
SILENCE = 60.0  # seconds between lines of progress where no terminal shows it


@contextmanager
def progress() -> Iterator[ProgressCallback]:
    """A callback that shows the stage at work and the time left, if standard error is a terminal;
    of them nothing stays there. Elsewhere a line tells a stage every SILENCE seconds."""
    if not sys.stderr.isatty():
        yield _lines()
        return
    from rich import progress as rich
    from rich.console import Console
    from rich.table import Column

    wide = Column(ratio=1, no_wrap=True, overflow="ellipsis")
    with rich.Progress(
        rich.SpinnerColumn(),
        rich.TextColumn("{task.description}", markup=False, table_column=wide),
        rich.BarColumn(20),
        rich.TimeElapsedColumn(),
        rich.TimeRemainingColumn(),
        console=Console(stderr=True),
        transient=True,
        expand=True,
        speed_estimate_period=math.inf,
    ) as shown:
        task = shown.add_task("", total=None)

        def callback(stage: str) -> None:
            if isinstance(stage, Early | Lasting):
                line = plain(stage)
                shown.console.print(line, markup=False, highlight=False, soft_wrap=True)
                return
            if isinstance(stage, Step):
                shown.update(task, total=1.0, completed=stage.done)
            shown.update(task, description=str(stage), refresh=True)

        yield callback


def plain(line: str) -> str:
    """A line in characters that any terminal shows."""
    from comparisons.output.terminal import PLAIN

    return line.translate(PLAIN)


def _lines() -> ProgressCallback:
    """A callback that tells a stage where the last line was SILENCE seconds ago, or the beginning.
    No thread tells the time: a process with threads is not copied."""
    began = last = monotonic()

    def callback(stage: str) -> None:
        nonlocal last
        if isinstance(stage, Lasting):
            tell(plain(stage))
        elif (now := monotonic()) - last >= SILENCE:
            last = now
            tell(f"after {now - began:.0f} s: {stage}")

    return callback


def show(renderable: object) -> None:
    """Print a table, as wide as the terminal, or as COLUMNS."""
    if sys.stdout.isatty():
        from rich.console import Console

        Console().print(renderable, crop=False)
        return
    from comparisons.output.terminal import in_lines

    asked = os.environ.get("COLUMNS", "")
    width = int(asked) if is_whole(asked) and int(asked) else UNSEEN_WIDTH
    print("\n".join(in_lines(renderable, width)))


def show_either(as_json: bool, content: Callable[[], object], tables: Callable[[], object]) -> None:
    """Print as JSON what `content` makes, or else what `tables` makes."""
    if as_json:
        show_json(content())
    else:
        show(tables())


def say_written(folder: Path, with_report: bool = True) -> None:
    """Print where a run's files are."""
    first = f"{folder / 'report.html'}, result.json" if with_report else folder / "result.json"
    print(f"written: {first} and the fields beside it")


def show_json(content: object) -> None:
    """Print what `--json` asks for."""
    plain = not (sys.stdout.encoding or "").lower().startswith("utf")
    text = json.dumps(content, indent=2, ensure_ascii=plain, allow_nan=False)
    # json leaves as they are some control characters that a terminal obeys
    print(re.sub("[\x7f-\x9f]", lambda character: f"\\u{ord(character[0]):04x}", text))
