"""Checks of arguments, array work on threads, and functions that would cancel near zero."""

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import ArrayLike


def check_positive(**named: float) -> None:
    """Raises ValueError, by name, for the first that is not a finite number above 0."""
    for name, value in named.items():
        if not (np.isfinite(value) and value > 0.0):
            raise ValueError(f"{name} must be positive and finite, not {value:g}")


def points_below(x: ArrayLike, z: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """x, z broadcast together as floats; ValueError for a z above the surface, below 0."""
    # -0.0 + 0.0 is 0.0: angles must not count from the other side
    x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float) + 0.0)
    if np.any(z < 0.0):
        raise ValueError("z must not be negative: it points into the body")
    return x, z


def runs_of(marks: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First indices of the runs of marks (n,), and the indices that follow each run."""
    padded = np.concatenate(([False], marks, [False]))
    changes = np.flatnonzero(padded[1:] != padded[:-1])
    return changes[0::2], changes[1::2]


def for_each(work: Callable[[slice], None], pieces: Iterable[slice]) -> None:
    """Call `work` on every piece, on OMP_NUM_THREADS threads, or one a core without such a number.
    Pieces write to slices of their own: threads change no result."""
    pieces = list(pieces)
    asked = os.environ.get("OMP_NUM_THREADS", "").split(",")[0].strip()
    threads = max(1, int(asked)) if asked.isdecimal() else os.cpu_count() or 1
    workers = min(threads, len(pieces))
    if workers < 2:
        for piece in pieces:
            work(piece)
        return
    with ThreadPoolExecutor(workers) as pool:
        for _ in pool.map(work, pieces):
            pass


def angle_minus_sine(angle: ArrayLike) -> np.ndarray:
    """y - sin y for 0 <= y <= pi."""
    y = np.asarray(angle, dtype=float)
    square = np.minimum(y, 1.0) ** 2
    series = np.ones_like(square)
    for n in range(9, 0, -1):  # the next term is below 1e-19
        series = 1.0 - square / ((2.0 * n + 2.0) * (2.0 * n + 3.0)) * series
    return np.where(y < 1.0, y**3 / 6.0 * series, y - np.sin(y))


def artanh_minus_argument(argument: ArrayLike, artanh: ArrayLike) -> np.ndarray:
    """artanh y - y for 0 <= y <= 1, given y and artanh y: next to 1 only the caller knows it."""
    y = np.asarray(argument, dtype=float)
    small = np.minimum(y, 0.4)
    series, square = np.zeros_like(small), small**2
    for n in range(20, 0, -1):
        series = series * square + 1.0 / (2.0 * n + 1.0)
    return np.where(y < 0.4, series * small * square, artanh - y)
