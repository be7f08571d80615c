"""Parts of programs that measure the project: a process on one thread, tables and demands."""

import os
import resource
import sys
from collections.abc import Callable, Iterable, Sequence
from time import process_time
from typing import NamedTuple, TypeVar

from meshes import build

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
Result = TypeVar("Result")


class Demand(NamedTuple):
    """Demand of a benchmark, in words, and whether it holds."""

    holds: bool
    text: str


class AbsentError(Exception):
    """A peer is not installed; the message says how to get it."""


def installed(*peers: Callable[[], list[Result]]) -> list[Result]:
    """The codes of all peers that are installed; the others are named on the screen."""
    codes: list[Result] = []
    for peer in peers:
        try:
            codes += peer()
        except AbsentError as absent:
            print(f"skipped: {absent}")
    return codes


def run_on_one_thread(main: Callable[[], int]) -> None:
    """Exit with the status of `main`, called where numerical libraries use one thread.

    They read their number of threads when they are loaded: the process starts again if needed.
    """
    if not ONE_THREAD.items() <= os.environ.items():
        os.execve(sys.executable, [sys.executable, *sys.orig_argv[1:]], os.environ | ONE_THREAD)
    sys.exit(main())


def mesh_seconds() -> float:
    """Processor seconds of the meshes so far by processes which wait for a task: the system counts
    those of a process among its parent's children when it has ended."""
    return sum(worker.seconds for worker in build.idle)


def processor_seconds() -> float:
    """Seconds of this process, of those that it has started and that have ended, and of gmsh."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return process_time() + children.ru_utime + children.ru_stime + mesh_seconds()


def timed(work: Callable[[], Result]) -> tuple[float, Result]:
    """Processor time [s] of a call, its child processes included, and what it returned."""
    start = processor_seconds()
    result = work()
    return processor_seconds() - start, result


def print_table(title: str, columns: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """The first column is a name, the others are numbers."""
    from rich.console import Console
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for number, name in enumerate(columns):
        table.add_column(name, justify="right" if number else "left")
    for row in rows:
        table.add_row(*row)
    Console(width=140).print(table)


def print_demands(demands: Sequence[Demand], peers: Sequence | None = None) -> int:
    """The exit status: 0 only if all hold and, where peers are required, one is installed."""
    for demand in demands:
        print("holds " if demand.holds else "FAILS ", demand.text)
    failed = sum(not demand.holds for demand in demands)
    print(f"{failed} demands fail" if failed else "all demands hold")
    absent = peers is not None and not peers
    if absent:
        print("no peer is installed: nothing is shown")
    return int(absent or failed > 0)
