"""Loading dolfinx and compiling its forms, robust against interrupts.

dolfinx caches compiled forms in a folder. A process that is stopped while it compiles leaves a
source there without the mark that it is ready; later processes wait for that mark, then fail."""

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

# A form compiles in seconds: an older source without the mark is left over.
STALE_SECONDS = 60.0
# Times that a process waits for the mark (10 s each) before a source has become that old.
MOST_WAITS = 7


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Delay Ctrl-C until the end, for this process and those that it starts. Compiled modules abort
    the process when their import is interrupted; an interrupted C compiler leaves an incomplete
    file. Other threads than the first get no interrupt: nothing to do."""
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
    with uninterrupted(), compat.quick_versions():
        for name in ("dolfinx.mesh", "dolfinx.fem.petsc"):
            importlib.import_module(name)


def compiled(make: Callable[[], Result]) -> Result:
    """What `make`, which may compile forms, returns. TimeoutError if another does for a minute."""
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


def remove_leftovers(folder: Path) -> None:
    """Remove the sources that stopped processes left in `folder`."""
    for source in folder.glob("libffcx_*.c"):
        with suppress(FileNotFoundError):
            age = time.time() - source.stat().st_mtime
            if age > STALE_SECONDS and not source.with_suffix(".c.cached").exists():
                source.unlink()


# At a process's first form; later leftovers cause a timeout first.
_clear_once = cache(remove_leftovers)
