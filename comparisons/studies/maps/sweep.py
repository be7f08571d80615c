"""Points of a map through an executor, each on disk as soon as it is done.

Any executor of `concurrent.futures` will do. Points are handed out a few at a time: if a process
dies and takes its pool along, the few that were out are asked again one by one, each in a pool of
its own, so that the one to blame is known, and kept as failed.
"""

from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import AbstractContextManager

from comparisons.common.cache import Cache
from comparisons.common.progress import ProgressCallback, Step, no_progress
from comparisons.studies.maps.point import failed, solve_point
from comparisons.studies.maps.request import Asked

Open = Callable[[int], AbstractContextManager[Executor]]
DIED = "the process that solved it died"


def sweep(
    points: Iterable[Asked],
    store: Cache,
    open_executor: Open,
    workers: int,
    callback: ProgressCallback = no_progress,
) -> None:
    """Have every point in the store that is not there yet.

    open_executor  opens an executor of so many workers; the next one only after the last is closed
    """
    wanted = {point.key: point for point in points}
    left = deque(point for point in wanted.values() if store.load(point.key) is None)
    done = len(wanted) - len(left)

    def keep(point: Asked, answer: dict) -> None:
        nonlocal done
        store.save(point.key, answer)
        done += 1
        callback(_step(done, len(wanted)))

    callback(_step(done, len(wanted)))
    while left:
        for suspect in _until_broken(left, keep, open_executor, workers):
            if _until_broken(deque([suspect]), keep, open_executor, 1):
                keep(suspect, {"found": failed(DIED), "seconds": None})


def _step(done: int, wanted: int) -> Step:
    return Step(f"map: {done} of {wanted} points", done / wanted)


def _until_broken(
    left: deque[Asked], keep: Callable[[Asked, dict], None], open_executor: Open, workers: int
) -> list[Asked]:
    """Solve what is left; the points that were out when a process died, none if none did."""
    out: dict[Future, Asked] = {}
    lost: list[Asked] = []

    def collect(finished: Iterable[Future]) -> None:
        for future in finished:
            point = out.pop(future)
            try:
                keep(point, future.result())
            except BrokenExecutor:
                lost.append(point)

    with open_executor(min(workers, len(left))) as executor:
        try:
            while left or out:
                try:
                    while left and len(out) < 2 * workers:  # one is at hand when one is done
                        out[executor.submit(solve_point, left[0])] = left[0]
                        left.popleft()
                except BrokenExecutor:
                    if not out:  # it was never whole
                        raise
                collect(wait(out, return_when=FIRST_COMPLETED).done)
                if lost:
                    collect(wait(out).done)
                    break
        finally:
            for future in out:
                future.cancel()
    return lost
