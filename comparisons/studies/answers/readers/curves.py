"""Pressures along a surface: from a table, and what they must be, wherever they are from."""

from pathlib import Path

import numpy as np

from analytic.surface.readers.source import MAX_BYTES
from analytic.surface.readers.text import read_table
from comparisons.scenes.studies.answers import AnswerSection

FEWEST = 5  # points that show a pressure


def read_curve(path: Path, source: AnswerSection) -> tuple[np.ndarray, np.ndarray]:
    """x (n,) [m], ascending, and pressure (n,) [Pa] in a table."""
    table = read_table(path, MAX_BYTES, one_column=False, columns=source.columns)
    lost = np.flatnonzero(np.isnan(table.numbers).any(axis=1))
    if len(lost):
        raise table.error(int(lost[0]), "holds no number; allowed are x and pressure")
    x, pressure = table.numbers.T
    if not _one_way(x) and _one_way(pressure):
        one, other = source.columns
        raise ValueError(
            "its first column goes to and fro and its second one way: are they swapped? allowed "
            f"is x before pressure, columns = {[other, one]}"
        )
    return checked(x * source.length - source.x_origin, pressure * source.stress)


def _one_way(values: np.ndarray) -> bool:
    steps = np.diff(values)
    return bool(np.all(steps > 0.0) or np.all(steps < 0.0))


def checked(x: np.ndarray, pressure: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Both in ascending order. Raises ValueError for what is no pressure along a surface."""
    order = np.argsort(x, kind="stable")
    x, pressure = x[order], pressure[order]
    if len(x) < FEWEST:
        raise ValueError(f"has {len(x)} points; allowed are {FEWEST} or more along the contact")
    if not np.all(np.diff(x) > 0.0):
        twice = x[:-1][np.diff(x) <= 0.0][0]
        raise ValueError(f"has x = {twice:g} m twice; allowed is one pressure at each place")
    if not np.any(pressure):
        raise ValueError("has no pressure but 0; allowed is that of a contact")
    return x, pressure
