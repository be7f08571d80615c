"""How far an edge moves once the nodes that break their sign conditions change sides.

An edge of a contact that stands s too far out shows tension over s/2 only, and one that stands s
too far in overlaps over 3 s/2: beside an edge in the wrong place pressures and gaps go as

    p ~ (x - s/2) / sqrt(x),    g ~ -sqrt(x) (x - 3 s/2),

x counted from it (the singularity of a fixed edge and the next term). Exchanging just the nodes
that are seen to be wrong creeps to the edge by halves from the one side and steps over it from the
other.
"""

import numpy as np

from analytic.contact.sides import Broken, Sides


def foreseen(broken: Broken, sides: Sides) -> Broken:
    """The nodes that will be wrong, from those that are: at edges, runs of two or more."""
    tensile = _retreat(broken.tensile, sides.free)
    joining = _advance(broken.joining, sides.free)
    return Broken(tensile, broken.excessive, joining, broken.softening)


def _retreat(tensile: np.ndarray, free: np.ndarray) -> np.ndarray:
    """Runs of tension that begin at an edge of their patch, nearly twice as long."""
    starts, stops = _runs(tensile)
    more = stops - starts - 1
    if not more.any():
        return tensile
    before, after = _free_beside(free, starts, stops)
    starts = np.maximum(starts - np.where(before & ~after, more, 0), 0)
    stops = np.minimum(stops + np.where(after & ~before, more, 0), len(tensile))
    return _marked(starts, stops, len(tensile)) & free


def _advance(joining: np.ndarray, free: np.ndarray) -> np.ndarray:
    """Runs of overlap beside a patch, two thirds as long."""
    starts, stops = _runs(joining)
    fewer = (stops - starts) // 3
    if not fewer.any():
        return joining
    before, after = _free_beside(free, starts, stops)
    starts = starts + np.where(after & ~before, fewer, 0)
    stops = stops - np.where(before & ~after, fewer, 0)
    return _marked(starts, stops, len(joining))


def _runs(marks: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First nodes of the runs of marks, and the nodes that follow each."""
    padded = np.concatenate(([False], marks, [False]))
    changes = np.flatnonzero(padded[1:] != padded[:-1])
    return changes[0::2], changes[1::2]


def _marked(starts: np.ndarray, stops: np.ndarray, count: int) -> np.ndarray:
    """Marks (count,) on runs, which may overlap."""
    steps = np.bincount(starts, minlength=count + 1) - np.bincount(stops, minlength=count + 1)
    return np.cumsum(steps[:-1]) > 0


def _free_beside(
    free: np.ndarray, starts: np.ndarray, stops: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Whether the nodes before and after each run are free; beyond the ends of the grid none is."""
    padded = np.concatenate(([False], free, [False]))
    return padded[starts], padded[stops + 1]
