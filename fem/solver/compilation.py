"""Loading dolfinx and compiling its forms, robust against interrupts.

dolfinx caches compiled forms in a folder. A process that is stopped while it compiles leaves a
source there without the mark that it is ready; later processes wait for that mark, then fail."""

import hashlib
import importlib
import os
import platform
import re
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from importlib.machinery import EXTENSION_SUFFIXES
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

import numpy as np

from fem import compat
from fem.solver.mumps import FemError

Result = TypeVar("Result")

# A form compiles in seconds: an older source without the mark is left over.
STALE_SECONDS = 60.0
# Times that a process waits for the mark (10 s each) before a source has become that old.
MOST_WAITS = 7
# Without NaN and errno for each product and logarithm; rounding stays as it is.
COMPILER = ("-O3", "-fcx-limited-range", "-fno-math-errno")


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
    """Import dolfinx and the compiled packages below it. Its wheel needs MPI in the process."""
    with uninterrupted(), compat.quick_versions():
        for name in ("mpi4py.MPI", "dolfinx.mesh", "dolfinx.fem.petsc"):
            importlib.import_module(name)


def compiled(make: Callable[[], Result]) -> Result:
    """Result of `make`, which may compile forms. TimeoutError if another does for a minute."""
    waits, clear = 0, _clear_once
    while True:
        clear(compat.form_cache())
        try:
            with uninterrupted():
                return make()
        except TimeoutError:
            waits, clear = waits + 1, remove_leftovers
            if waits > MOST_WAITS:
                raise


@cache
def c_function(source: Path, name: str) -> Callable[..., None]:
    """The function `name` of a C `source`: numbers, then contiguous arrays of long or double. Like
    forms it is compiled once, into their cache, by a name of what it depends on, but without
    dolfinx. Raises FemError where it does not compile."""
    text = source.read_text(encoding="utf-8")
    made_of = text, sys.version, platform.machine(), *COMPILER
    key = hashlib.sha256("\n".join(made_of).encode()).hexdigest()[:16]
    module = f"{source.stem}_{key}"
    forms = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", "fenics")
    ready = forms / (module + EXTENSION_SUFFIXES[0])
    with uninterrupted():
        if not ready.exists():
            from cffi import FFI, VerificationError

            ffi = FFI()
            head = re.search(rf"^void {name}\(.*?\)", text, re.DOTALL | re.MULTILINE)
            ffi.cdef(head.group() + ";")
            ffi.set_source(module, text, extra_compile_args=list(COMPILER), libraries=["m"])
            forms.mkdir(parents=True, exist_ok=True)
            with TemporaryDirectory(dir=forms) as folder:
                try:
                    os.replace(ffi.compile(tmpdir=folder), ready)  # whole, whoever else does it
                except VerificationError as error:
                    raise FemError(f"{source.name} does not compile: {error}") from error
        spec = spec_from_file_location(module, ready)
        loaded = module_from_spec(spec)
        spec.loader.exec_module(loaded)
    function, buffer = getattr(loaded.lib, name), loaded.ffi.from_buffer

    def passed(value: float | np.ndarray) -> object:
        if not isinstance(value, np.ndarray):
            return value
        kind, of = ("long[]", np.int_) if value.dtype.kind == "i" else ("double[]", float)
        return buffer(kind, np.ascontiguousarray(value, of))

    return lambda *values: function(*map(passed, values))


def remove_leftovers(folder: Path) -> None:
    """Remove the sources that stopped processes left in `folder`."""
    for source in folder.glob("libffcx_*.c"):
        with suppress(FileNotFoundError):
            age = time.time() - source.stat().st_mtime
            if age > STALE_SECONDS and not source.with_suffix(".c.cached").exists():
                source.unlink()


# At a process's first form; later leftovers cause a timeout first.
_clear_once = cache(remove_leftovers)
