"""Loading dolfinx and compiling its forms such that a stop in between does no lasting harm.

dolfinx keeps what it has compiled in a folder, for later processes. One that is stopped while it
compiles leaves a source there without the mark that it is ready, and every later one would wait
for that mark in vain, then fail.
"""

import importlib
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import TypeVar

from fem import compat

Result = TypeVar("Result")

# A form compiles in seconds: a source that old, and still not marked, is nobody's work in progress.
STALE_SECONDS = 60.0
# Times that a process waits for the mark (10 s each) before a source has become that old.
MOST_WAITS = 7


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Hold Ctrl-C back until the end, from this process and from those that it starts.

    Compiled modules that are interrupted while they are imported abort the process, or report
    something else than an interrupt; an interrupted C compiler leaves its work half done.
    In any thread but the first, where no interrupt arrives, nothing happens.
    """
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or before is None:
        yield
        return
    held = []
    signal.signal(signal.SIGINT, lambda number, frame: held.append(number))
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        signal.signal(signal.SIGINT, before)
        if held:
            signal.raise_signal(signal.SIGINT)


@cache
def load_dolfinx() -> None:
    """Import dolfinx and the compiled packages below it."""
    with uninterrupted():
        for name in ("dolfinx.mesh", "dolfinx.fem.petsc"):
            importlib.import_module(name)


def compiled(make: Callable[[], Result]) -> Result:
    """What `make` returns, which may have forms compiled.

    Raises TimeoutError when another process has been compiling the same for a minute.
    """
    from mpi4py import MPI

    waits, clear = 0, _clear_once
    while True:
        if MPI.COMM_WORLD.rank == 0:  # it compiles for all
            clear(compat.form_cache())
        try:
            with uninterrupted():
                return make()
        except TimeoutError:
            waits, clear = waits + 1, remove_leftovers
            if waits > MOST_WAITS:
                raise


@cache
def _clear_once(folder: Path) -> None:
    """`remove_leftovers` at a process' first form: what is left later is met by a timeout first."""
    remove_leftovers(folder)


def remove_leftovers(folder: Path) -> None:
    """Remove sources that a process left in `folder` when it was stopped."""
    for source in folder.glob("libffcx_*.c"):
        with suppress(FileNotFoundError):
            age = time.time() - source.stat().st_mtime
            if age > STALE_SECONDS and not source.with_suffix(".c.cached").exists():
                source.unlink()
