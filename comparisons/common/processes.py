"""Processes that work for this one, on one thread each, and end with it."""

import ctypes
import gc
import multiprocessing
import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext, suppress
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from threading import Lock
from types import ModuleType

from comparisons import ROOT

KILLED = "killed, as the system does where memory ends"
PR_SET_PDEATHSIG = 1  # of Linux's prctl
# Of processes that this one starts: one thread, and no code from the working folder.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "PYTHONSAFEPATH": "1"}
_starting = Lock()  # of processes, since each changes this one's environment for a moment


class ProcessWorker:
    """A process that serves a pipe until it is killed.

    serve   called there with its end of the pipe, which sends what `receive` returns
    forked  a copy of this process, with all that it has in memory; else a fresh one, which gets
            `serve` through pickle"""

    def __init__(self, serve: Callable[[Connection], None], forked: bool = False) -> None:
        context = multiprocessing.get_context("fork" if forked else "spawn")
        if not forked:  # its start would let interrupts through again
            resource_tracker.ensure_running()
        with (
            _starting,
            environment(ONE_THREAD),
            nullcontext() if forked else _without_main(),
            interrupts_later(),
            warnings.catch_warnings(),
        ):
            warnings.simplefilter("ignore", DeprecationWarning)  # of other threads: none is needed
            self._pipe, theirs = context.Pipe()
            self._process = context.Process(target=_work, args=(serve, theirs))
            self._process.start()
            theirs.close()  # so that reading ends when the process does

    def send(self, *task: object) -> None:
        """Raises ConnectionError where the process has ended."""
        self._pipe.send(task)

    def receive(self) -> tuple[str, object]:
        """Raises EOFError or ConnectionError where the process has ended."""
        return self._pipe.recv()

    def how_it_ended(self) -> str:
        """Words on how the process has ended."""
        self._process.join()
        code = self._process.exitcode
        if code == -signal.SIGKILL:
            return f"was {KILLED}"
        return f"ended by {signal.Signals(-code).name}" if code < 0 else f"ended with status {code}"

    def kill(self) -> None:
        """Kill it and what it has started; a long factorisation handles no other signal."""
        with suppress(ProcessLookupError):  # it has no group yet
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.kill()
        self._process.join()
        self._pipe.close()

    @staticmethod
    def ready(workers: Sequence["ProcessWorker"], timeout: float) -> list["ProcessWorker"]:
        """Workers that have something to say, or have ended; waits for one."""
        pipes = {worker._pipe: worker for worker in workers}
        return [pipes[pipe] for pipe in wait(list(pipes), timeout)]


def _work(serve: Callable[[Connection], None], pipe: Connection) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with suppress(OSError, AttributeError):  # the system kills it with its parent; only Linux can
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != multiprocessing.parent_process().pid:
        os._exit(1)  # it ended before that
    with suppress(OSError):
        os.setpgid(0, 0)  # what this process starts ends with it
    gc.freeze()  # a collection would look through, and copy, all that a parent has in memory
    serve(pipe)


def is_forkable() -> bool:
    """Whether copies of this process can work. Threads of OpenMP, which are in no copy though it
    waits for them, may have begun where more than one is asked for."""
    return sys.platform == "linux" and os.environ.get("OMP_NUM_THREADS") == "1"


def cores() -> int:
    return len(os.sched_getaffinity(0))


def return_freed_memory() -> None:
    """Return it to the system: the C library keeps what was freed in blocks of some megabytes, as a
    factor is, for this process alone."""
    with suppress(AttributeError):  # of Debian's C library
        ctypes.CDLL(None).malloc_trim(0)


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Delay Ctrl-C while a process starts, which must not get it before it ignores it, or a module
    is imported: a compiled one aborts the process."""
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)


@contextmanager
def uncollected() -> Iterator[None]:
    """No garbage collection inside: of imports, which leave none, it takes a sixth of the time."""
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()


@contextmanager
def _without_main() -> Iterator[None]:
    """Processes that start inside do not run the script again that this one runs, nor look for
    modules beside it first: theirs is the project's code alone, and a script needs no guard around
    its calls."""
    script, path = sys.modules["__main__"], list(sys.path)
    sys.modules["__main__"] = ModuleType("__main__")
    sys.path.insert(0, ROOT)
    try:
        yield
    finally:
        sys.modules["__main__"], sys.path[:] = script, path


@contextmanager
def environment(wanted: dict[str, str]) -> Iterator[None]:
    """Environment variables of processes that start inside: numpy reads them when imported."""
    before = {name: os.environ[name] for name in wanted if name in os.environ}
    os.environ.update(wanted)
    try:
        yield
    finally:
        for name in wanted:
            del os.environ[name]
        os.environ.update(before)
