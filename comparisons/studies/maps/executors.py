"""Who solves a map's points: processes here (`comparisons.common.processes`), ranks under mpirun,
or a Dask cluster.

All are executors of `concurrent.futures`. One point is one process' work, on one thread.
"""

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass

from comparisons.common.errors import InputError
from fem.solver.compilation import load_dolfinx


@dataclass(frozen=True)
class Workers:
    """An open executor, and on how many points at once it works."""

    executor: Executor
    count: int


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
