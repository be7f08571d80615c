"""Processes on one thread, which an interrupt ends at once: single ones, a pool, and copies of this
one for works that need all that it has in memory.

A pool of `concurrent.futures` may wait for ever for a worker that was killed before it had read a
large task (CPython's issue 94777, in Python 3.11.2 and others); `fresh_process` does not."""

import ctypes
import gc
import multiprocessing
import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from threading import Lock
from types import ModuleType
from typing import TypeVar

from comparisons.common.interrupt import end_with_parent
from comparisons.common.mpi import is_several

Result = TypeVar("Result")
Works = Sequence[Callable[[], object]]
Call = Callable[..., Result]  # call(work, *given) returns work(*given), computed there

# Of processes that this one starts: one thread, and no code from the working folder.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "PYTHONSAFEPATH": "1"}
_starting = Lock()  # of processes, since each changes this one's environment for a moment


class ProcessEnded(Exception):
    """The process ended before it had answered."""


class Worker:
    """A process that serves a pipe, once it is started, and until it is killed.

    serve   called there with the pipe's other end
    forked  from this process, with all that it has loaded; else a fresh one"""

    def __init__(self, serve: Callable[[Connection], None], forked: bool = False) -> None:
        self._forked, self._serve = forked, serve
        self._context = multiprocessing.get_context("fork" if forked else "spawn")
        self.pipe, self._theirs = self._context.Pipe()
        self._alive, self._held = self._context.Pipe(duplex=False)
        self._process: BaseProcess | None = None

    def start(self, others: Sequence["Worker"] = ()) -> None:
        """`others` are forked ones beside it, whose ends it must not keep."""
        ours = [end for each in (self, *others) for end in (each.pipe, each._held)]
        given = self._serve, self._theirs, self._alive, ours if self._forked else []
        self._process = self._context.Process(target=_work, args=given)
        with _starting, environment(ONE_THREAD), interrupts_later():
            self._process.start()
        self._theirs.close()  # so that reading ends when the process does

    def kill(self) -> None:
        """With what it has started; a long factorisation handles no other signal."""
        if self._process is not None and self._process.pid is not None:
            with suppress(ProcessLookupError):  # it has no group yet
                os.killpg(self._process.pid, signal.SIGKILL)
            self._process.kill()
            self._process.join()
        for end in (self.pipe, self._theirs, self._alive, self._held):
            end.close()


@contextmanager
def fresh_process() -> Iterator[Call]:
    """A function that calls others in one process, from the first call to the end of the block.
    Arguments and answers go through pickle. A call raises what its work does, and ProcessEnded."""
    worker, started = Worker(_answer), []

    def call(work: Callable[..., Result], *given: object) -> Result:
        if not started:
            started.append(True)
            worker.start()
        try:
            worker.pipe.send((work, given))
            good, answer = worker.pipe.recv()
        except (EOFError, OSError) as error:
            raise ProcessEnded(str(error)) from error
        if good:
            return answer
        raise answer

    try:
        yield call
    finally:
        worker.kill()


def return_freed_memory() -> None:
    """To the system: the C library keeps what was freed in blocks of some megabytes, as a factor
    is, for this process alone."""
    with suppress(AttributeError):  # of Debian's C library
        ctypes.CDLL(None).malloc_trim(0)


def answered(work: Callable[..., Result], *given: object) -> tuple[bool, Result | Exception]:
    """Whether the work raised nothing, and what it returned or raised."""
    try:
        return True, work(*given)
    except Exception as error:
        return False, error


def _answer(pipe: Connection) -> None:
    while True:
        work, given = pipe.recv()
        pipe.send(answered(work, *given))


def _work(
    serve: Callable[[Connection], None],
    pipe: Connection,
    alive: Connection,
    inherited: Sequence[Connection],
) -> None:
    with suppress(OSError):
        os.setpgid(0, 0)  # what it starts ends with it
    for end in inherited:
        end.close()
    if inherited:  # forked by a thread that lasts as long as it does
        end_with_parent()
    begin(alive)
    serve(pipe)


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
def processes(count: int, copied: Works | None = None) -> Iterator[Executor]:
    """A pool of fresh processes; what ends the block, or this process, ends them at once.

    copied   work that `_copied` finds in the processes, which are copies of this one then"""
    context = multiprocessing.get_context("spawn" if copied is None else "fork")
    alive, held = context.Pipe(duplex=False)
    others = multiprocessing.active_children()
    with environment(ONE_THREAD), _without_main(), alive, held:
        given = alive, copied  # a copy gets them without pickle
        pool = ProcessPoolExecutor(count, context, initializer=begin, initargs=given)
        try:
            yield pool
        except BaseException:
            held.close()
            for process in multiprocessing.active_children():
                if process not in others:
                    process.kill()  # a long factorisation handles no other signal
            raise
        finally:
            pool.shutdown(cancel_futures=True)


@contextmanager
def _without_main() -> Iterator[None]:
    """Processes that start inside do not run the script again that this one runs: theirs is the
    project's code alone, and a script needs no guard around its calls."""
    script = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = script


@contextmanager
def beside_next(works: Works) -> Iterator[None]:
    """The first `side_by_side` inside begins with these works, too; else the block ends with them.
    They return nothing."""
    _before.extend(works)
    try:
        yield
        side_by_side([])
    finally:
        _before.clear()


def side_by_side(works: Sequence[Callable[[], Result]]) -> list[Result]:
    """What each work returns, in their order; copies of this process carry them out, one a core.

    Works share what this process has in memory, and their answers go through pickle. They use no
    MPI, which survives no fork. They are carried out here on one core, where this is one of several
    processes or has several threads, and where copies cannot be made or do not answer."""
    before = len(_before)
    works = [*_before, *works]
    _before.clear()
    count = min(copies(), len(works))
    if count > 1:
        with suppress(BrokenProcessPool, OSError), processes(count, works) as pool:
            with interrupts_later(), warnings.catch_warnings():
                warnings.simplefilter("ignore", DeprecationWarning)  # of other threads: they wait
                answers = pool.map(_copied, range(len(works)))
            return list(answers)[before:]  # an error of the work itself comes again below
    return [work() for work in works][before:]


def copies() -> int:
    """How many copies of this process may work at once; 1: none beside it. Threads of OpenMP, which
    are in no copy though it waits for them, may have begun where more than one is asked for."""
    alone = not is_several() and multiprocessing.parent_process() is None
    alone = alone and os.environ.get("OMP_NUM_THREADS") == ONE_THREAD["OMP_NUM_THREADS"]
    return len(os.sched_getaffinity(0)) if alone else 1


_works: Works = ()  # of a copy
_before: list[Callable[[], object]] = []  # that `side_by_side` begins with


def _copied(number: int) -> object:
    return _works[number]()


def begin(alive: Connection, copied: Works | None = None) -> None:
    """Ignore Ctrl-C, and end with the process that started this one or when it closes `alive`.

    copied   what a copy of a process carries out"""
    global _works
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if copied is not None:
        _works = copied
        gc.disable()  # a collection would look through, and copy, all that the parent has
    parent = multiprocessing.parent_process()

    def watch() -> None:
        wait([alive, parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


@contextmanager
def environment(wanted: dict[str, str]) -> Iterator[None]:
    """Environment variables of processes that start inside: numpy reads them when imported."""
    before = {name: os.environ.get(name) for name in wanted}
    os.environ.update(wanted)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
