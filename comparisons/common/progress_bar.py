"""The line that a watcher sees: stage, bar, time so far, time left."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import monotonic
from typing import TYPE_CHECKING

from comparisons.common.progress import ProgressCallback, Step

if TYPE_CHECKING:
    from rich.progress import ProgressColumn, Task
    from rich.text import Text

BAR = 20  # columns
MOST = 0.99  # of the bar, while the work is not done


@dataclass
class Outlook:
    """How far a task has come, from what it tells at its steps.

    clock  seconds that only grow
    """

    clock: Callable[[], float] = monotonic
    start: float = field(init=False)
    behind: float = 0.0  # share that was told last
    whole: float | None = None  # s that the task takes in all, None while nothing tells

    def __post_init__(self) -> None:
        self.start = self.clock()

    @property
    def elapsed(self) -> float:
        """[s]"""
        return self.clock() - self.start

    def told(self, stage: str) -> None:
        """Take note of a stage that begins."""
        if isinstance(stage, Step) and stage.behind not in (0.0, self.behind):
            self.behind = stage.behind
            self.whole = self.elapsed / stage.behind

    @property
    def share(self) -> float | None:
        """Of the task that lies behind, 0 to MOST; None while unknown."""
        return None if self.whole is None else min(self.elapsed / max(self.whole, 1e-9), MOST)

    @property
    def left(self) -> float | None:
        """[s], None while unknown or overdue."""
        if self.whole is None or self.elapsed >= self.whole:
            return None
        return self.whole - self.elapsed


@contextmanager
def progress_bar() -> Iterator[ProgressCallback]:
    """A callback that shows on standard error what it is told; nothing stays there."""
    from rich.console import Console
    from rich.progress import Progress

    outlook = Outlook()
    console = Console(stderr=True)
    with Progress(*_columns(outlook), console=console, transient=True, expand=True) as shown:
        task = shown.add_task("", total=None)

        def told(stage: str) -> None:
            outlook.told(stage)
            shown.update(task, description=str(stage), refresh=True)

        yield told


def _columns(outlook: Outlook) -> "list[ProgressColumn]":
    from rich.progress import ProgressColumn, SpinnerColumn
    from rich.progress_bar import ProgressBar
    from rich.table import Column
    from rich.text import Text

    class Stage(ProgressColumn):
        """As it is told: brackets are no markup."""

        def render(self, task: "Task") -> "Text":
            return Text(task.description)

    class Bar(ProgressColumn):
        def render(self, task: "Task") -> ProgressBar:
            share = outlook.share
            return ProgressBar(
                total=None if share is None else 1.0,
                completed=share or 0.0,
                width=BAR,
                animation_time=task.get_time(),
            )

    class Times(ProgressColumn):
        max_refresh = 0.5

        def render(self, task: "Task") -> "Text":
            return Text(times(outlook.elapsed, outlook.left))

    wide = Column(ratio=1, no_wrap=True, overflow="ellipsis")
    return [SpinnerColumn(), Stage(table_column=wide), Bar(), Times()]


def times(elapsed: float, left: float | None) -> str:
    """Time so far and time left, as minutes and seconds."""
    so_far = _minutes(elapsed)
    return so_far if left is None else f"{so_far}, {_minutes(left)} left"


def _minutes(seconds: float) -> str:
    whole = round(seconds)
    hours, rest = divmod(whole, 3600)
    minutes = f"{rest // 60}:{rest % 60:02d}"
    return f"{hours}:{rest // 60:02d}:{rest % 60:02d}" if hours else minutes
