"""Independent pieces of array work on several threads; numpy frees the interpreter meanwhile."""

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor


def thread_count() -> int:
    """OMP_NUM_THREADS where it is a number, else the machine's cores."""
    asked = os.environ.get("OMP_NUM_THREADS", "").split(",")[0].strip()
    return max(1, int(asked)) if asked.isdigit() else os.cpu_count() or 1


def for_each(work: Callable[[slice], None], pieces: Iterable[slice]) -> None:
    """Call `work` on every piece. Pieces write to places of their own: threads change no result."""
    pieces = list(pieces)
    workers = min(thread_count(), len(pieces))
    if workers < 2:
        for piece in pieces:
            work(piece)
        return
    with ThreadPoolExecutor(workers) as pool:
        for _ in pool.map(work, pieces):
            pass
