"""Points of a map or a sweep through executors, each on disk as soon as it is done.

Points are solved by processes here (`comparisons.common.processes`), by the ranks under mpirun, or
by a Dask cluster: by any executor of `concurrent.futures`. One point is the work of one process, on
one thread. A few points are submitted at a time. If a process dies and takes its pool along, the
points that were submitted are tried again one by one, each in a pool of its own: the one that
kills its process again is saved as failed."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from typing import Protocol

from comparisons.common.cache import Cache
from comparisons.common.errors import InputError, one_line
from comparisons.common.progress import ProgressCallback, Step, no_progress
from fem.solver.compilation import load_dolfinx


class Point(Protocol):
    """What is solved by itself, and the `key` of everything that shapes its answer."""

    key: str


Solve = Callable[[Point], dict]  # what was `found` at a point, and the `seconds` that it took
OpenExecutor = Callable[[int], AbstractContextManager[Executor]]
SOLVED, FAILED = "solved", "failed"
DIED = "the process that solved it died"


def failed(why: str) -> dict:
    """What is found at a point without an answer."""
    return {"status": FAILED, "why": one_line(why)}


def solve_points(
    points: Iterable[Point],
    solve: Solve,
    cache: Cache,
    open_executor: OpenExecutor,
    workers: int,
    callback: ProgressCallback = no_progress,
    what: str = "map",
) -> None:
    """Solve every point that the cache does not have, and save it there.

    open_executor  opens an executor of so many workers; each is closed before the next one
    what           the points are of, for the progress"""
    wanted = {point.key: point for point in points}
    left = deque(point for point in wanted.values() if cache.load(point.key) is None)

    def announce() -> None:
        callback(Step(f"{what}: {done} of {len(wanted)} points", done / len(wanted)))

    def save(point: Point, answer: dict) -> None:
        nonlocal done
        cache.save(point.key, answer)
        done += 1
        announce()

    done = len(wanted) - len(left)
    announce()
    while left:
        for suspect in _until_broken(left, solve, save, open_executor, workers):
            if _until_broken(deque([suspect]), solve, save, open_executor, 1):
                save(suspect, {"found": failed(DIED), "seconds": None})


def _until_broken(
    left: deque[Point],
    solve: Solve,
    save: Callable[[Point, dict], None],
    open_executor: OpenExecutor,
    workers: int,
) -> list[Point]:
    """Solve points until none are left, or a process dies: the points submitted then, else none."""
    submitted: dict[Future, Point] = {}
    lost: list[Point] = []

    def collect(finished: Iterable[Future]) -> None:
        for future in finished:
            point = submitted.pop(future)
            try:
                save(point, future.result())
            except BrokenExecutor:
                lost.append(point)

    with open_executor(min(workers, len(left))) as executor:
        try:
            while left or submitted:
                try:
                    while left and len(submitted) < 2 * workers:  # one is at hand when one is done
                        submitted[executor.submit(solve, left[0])] = left[0]
                        left.popleft()
                except BrokenExecutor:
                    if not submitted:  # the pool was never whole
                        raise
                collect(wait(submitted, return_when=FIRST_COMPLETED).done)
                if lost:
                    collect(wait(submitted).done)
                    break
        finally:
            for future in submitted:
                future.cancel()
    return lost


@dataclass(frozen=True)
class Workers:
    """An open executor, and on how many points at once it works."""

    executor: Executor
    count: int


@contextmanager
def ranks() -> Iterator[Workers | None]:
    """The processes that mpirun started; each of them calls this. The first one gets the others as
    workers. The others work until it is done, and get None."""
    load_dolfinx()  # before the pool is made: within a job it would wait for the others for ever
    from mpi4py import MPI
    from mpi4py.futures import MPICommExecutor

    with MPICommExecutor(MPI.COMM_WORLD, root=0) as executor:
        yield executor and Workers(executor, max(1, MPI.COMM_WORLD.size - 1))


@contextmanager
def cluster(scheduler: str) -> Iterator[Workers]:
    """The workers of a Dask scheduler at an address such as tcp://host:8786. How many points each
    works on at once, and OMP_NUM_THREADS, are set there: 1 is best for both. Raises InputError
    where there is no scheduler, or Dask is not installed."""
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
