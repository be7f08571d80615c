"""Fresh processes on one thread, which an interrupt ends at once: single ones and a pool.

A pool of `concurrent.futures` may wait for ever for a worker that was killed before it had read a
large task (CPython's issue 94777, in Python 3.11.2 and others); `fresh_process` does not.
"""

import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing.connection import Connection, wait
from threading import Lock, Thread
from typing import TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")
Call = Callable[..., Result]  # call(work, *given) returns work(*given), computed there

# Of processes that this one starts: one thread, and no code from the working folder.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "PYTHONSAFEPATH": "1"}
_starting = Lock()  # of processes, since each changes this one's environment for a moment


class ProcessEnded(Exception):
    """The process ended before it had answered."""


@contextmanager
def fresh_process() -> Iterator[Call]:
    """A function that calls others in one process, which starts at the first call; the end of the
    block kills it.

    Arguments and answers go through pickle. A call raises what the work raises, and ProcessEnded.
    """
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    alive, held = context.Pipe(duplex=False)
    process = context.Process(target=_serve, args=(theirs, alive))

    def call(work: Callable[..., Result], *given: object) -> Result:
        if process.pid is None:
            with _starting, environment(ONE_THREAD), _interrupts_later():
                process.start()
            theirs.close()  # so that reading ends when the process does
        try:
            ours.send((work, given))
            good, answer = ours.recv()
        except (EOFError, OSError) as error:
            raise ProcessEnded(str(error)) from error
        if good:
            return answer
        raise answer

    with ours, theirs, alive, held:
        try:
            yield call
        finally:
            if process.pid is not None:
                process.kill()  # a long factorisation handles no other signal
                process.join()


def share_out(
    items: Iterable[Item], here: Callable[[Item], None], there: Sequence[Callable[[Item], None]]
) -> None:
    """Work on every item: `here` in this thread, each of `there` in a thread of its own that waits
    for a process.

    The item of a process that ended is worked on here. The first error ends the rest, and is
    raised.
    """
    left, errors = deque(items), []

    def serve(work: Callable[[Item], None]) -> None:
        while left and not errors:
            try:
                item = left.popleft()
            except IndexError:  # another one was quicker
                return
            try:
                work(item)
            except ProcessEnded:
                left.append(item)
                return
            except Exception as error:
                errors.append(error)

    threads = [Thread(target=serve, args=(work,), daemon=True) for work in there]
    for thread in threads:
        thread.start()
    serve(here)
    for thread in threads:
        thread.join()
    serve(here)
    if errors:
        raise errors[0]


def _serve(pipe: Connection, alive: Connection) -> None:
    begin(alive)
    while True:
        work, given = pipe.recv()
        try:
            answer = True, work(*given)
        except Exception as error:
            answer = False, error
        pipe.send(answer)


@contextmanager
def _interrupts_later() -> Iterator[None]:
    """Delay Ctrl-C while a process starts: the new one must not get it before it ignores it."""
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)


@contextmanager
def processes(count: int) -> Iterator[Executor]:
    """A pool of fresh processes; what ends the block, or this process, ends them at once."""
    context = multiprocessing.get_context("spawn")
    alive, held = context.Pipe(duplex=False)
    others = multiprocessing.active_children()
    with environment(ONE_THREAD), alive, held:
        pool = ProcessPoolExecutor(count, context, initializer=begin, initargs=(alive,))
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


def begin(alive: Connection) -> None:
    """Ignore Ctrl-C, and end with the process that started this one or when it closes `alive`."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
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
