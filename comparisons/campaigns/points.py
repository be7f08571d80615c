"""Points of a map or a sweep as tasks, each on disk as soon as it is done, and who solves them.

One point is the work of one process, on one thread."""

import math
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Protocol

from comparisons.common.cache import Cache
from comparisons.common.errors import InputError, one_line
from comparisons.common.executors import cluster, ranks
from comparisons.common.mpi import is_several
from comparisons.common.processes import ProcessWorker, cores
from comparisons.common.progress import ProgressCallback, Step
from comparisons.common.tasks import Here, ProcessEnded, Tasks
from fem.solver.communicator import each_alone


class Point(Protocol):
    """What is solved by itself, and the `key` of everything that shapes its answer."""

    key: str


Solve = Callable[[Point], dict]  # what was `found` at a point, and the `seconds` that it took
SOLVED, FAILED = "solved", "failed"
DIED = "the process that solved it died"


def failed(why: str) -> dict:
    """What is found at a point without an answer."""
    return {"status": FAILED, "why": one_line(why)}


@contextmanager
def tasks_by(workers: int | str | None, kept: Cache) -> Iterator[Tasks | None]:
    """Tasks on so many processes, one a core (None), or on a Dask cluster, by its address. Under
    mpirun on its ranks: each of these calls this; all but the first work, and get None.
    Raises InputError for other workers."""
    if is_several():
        with ranks() as opens, Tasks(opens, math.inf, kept) as tasks:
            yield opens and tasks
        return
    text = str(cores() if workers is None else workers)
    if text.isdigit():
        if int(text) < 1:
            raise InputError(f"--workers: is {text}; allowed is from 1 on")
        with Tasks(ProcessWorker, int(text), kept) as tasks:
            yield tasks
        return
    if "://" not in text:
        raise InputError(
            f"--workers: is {text!r}; allowed is a number, or a Dask scheduler's address "
            "such as tcp://host:8786"
        )
    with cluster(text) as opens, Tasks(opens, math.inf, kept) as tasks:
        yield tasks


def finish(
    points: Iterable[Point], solve: Solve, tasks: Tasks, callback: ProgressCallback, what: str
) -> None:
    """Solve every point that the tasks do not keep, for them to keep. One that kills its process
    has failed.

    what  the points are of, for the progress"""
    keys = dict.fromkeys(point.key for point in points)
    callback(Step(f"{what}: 0 of {len(keys)} points", 0.0))
    for point in points:
        tasks.add(point.key, _solved, solve, point, seconds=1.0)
    for number, key in enumerate(tasks.as_done(keys), start=1):
        try:
            tasks.result(key)
        except ProcessEnded:
            tasks.kept.save(key, {"found": failed(DIED), "seconds": None})
        callback(Step(f"{what}: {number} of {len(keys)} points", number / len(keys)))


def _solved(here: Here, solve: Solve, point: Point) -> dict:
    """By this process alone, though it may be one of several."""
    with each_alone():
        return solve(point)
