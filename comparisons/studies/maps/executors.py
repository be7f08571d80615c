"""Who solves a map's points: processes here, ranks under mpirun, or a Dask cluster.

All are executors of `concurrent.futures`. One point is one process' work, on one thread.
"""

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait

from comparisons.common.errors import InputError
from fem.solver.compilation import load_dolfinx

ONE_THREAD = {"OMP_NUM_THREADS": "1"}


@dataclass(frozen=True)
class Workers:
    """An open executor, and on how many points at once it works."""

    executor: Executor
    count: int


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
                    process.kill()  # within a long factorisation it hears of nothing else
            raise
        finally:
            pool.shutdown(cancel_futures=True)


def begin(alive: Connection) -> None:
    """Leave Ctrl-C to the process that started this one, and end with it or when it says so."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def watch() -> None:
        wait([alive, parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


@contextmanager
def ranks() -> Iterator[Workers | None]:
    """The processes that mpirun started, to be called by all: the first one gets the others to
    work for it, the others work until it is done and get None."""
    load_dolfinx()  # before the pool is made: inside a job it would wait for the others for ever
    from mpi4py import MPI
    from mpi4py.futures import MPICommExecutor

    with MPICommExecutor(MPI.COMM_WORLD, root=0) as executor:
        yield executor and Workers(executor, max(1, MPI.COMM_WORLD.size - 1))


@contextmanager
def cluster(scheduler: str) -> Iterator[Workers]:
    """The workers of a Dask scheduler at an address such as tcp://host:8786.

    Theirs is how many points each works on at once, and OMP_NUM_THREADS: one of either is best.
    Raises InputError where there is none, or Dask is not installed.
    """
    try:
        from distributed import Client
    except ImportError as error:
        raise InputError(
            f"--workers: {scheduler} needs Dask; allowed is a number, or: pip install distributed"
        ) from error
    try:
        client = Client(scheduler)
    except (OSError, ValueError) as error:
        raise InputError(f"--workers: {scheduler} does not answer as a Dask scheduler") from error
    with client:
        count = sum(client.nthreads().values())
        yield Workers(client.get_executor(pure=False), max(1, count))


@contextmanager
def environment(wanted: dict[str, str]) -> Iterator[None]:
    """Variables for processes that are started inside: numpy reads them as it is imported."""
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
