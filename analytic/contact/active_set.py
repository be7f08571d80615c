"""The active set: which nodes are held at zero pressure or at the hardness, and which violate it.

Edge extrapolation. At x from an edge that stands s too far out,

    p ~ (x - s/2) / sqrt(x),    g ~ -sqrt(x) (x - 3 s/2)

(the singularity of a fixed edge and the next term): tension shows over s/2 only, overlap beside an
edge s too far in over 3 s/2. Runs of violating nodes at an edge are therefore lengthened or
shortened, instead of approaching it by halves from one side and stepping over it from the other."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from analytic.numerics import runs_of


@dataclass(frozen=True)
class Violations:
    """Nodes that violate: in tension, above H, overlapping at p = 0, open at p = H."""

    tensile: np.ndarray
    excessive: np.ndarray
    joining: np.ndarray
    softening: np.ndarray

    def count(self) -> int:
        return int(np.count_nonzero(self.tensile | self.excessive | self.joining | self.softening))


@dataclass(frozen=True)
class ActiveSet:
    """Nodes that are held at p = 0 (`lower`) and at p = H (`upper`); the others are free."""

    lower: np.ndarray
    upper: np.ndarray

    @classmethod
    def of(cls, pressure: np.ndarray, hardness: float | np.ndarray) -> "ActiveSet":
        return cls(pressure <= 0.0, pressure >= hardness)

    @cached_property
    def free(self) -> np.ndarray:
        return ~(self.lower | self.upper)

    def edges(self) -> int:
        """Count of boundaries between free nodes and others."""
        return int(np.count_nonzero(self.free[1:] != self.free[:-1]))

    def exchanged(self, violated: Violations) -> "ActiveSet":
        return ActiveSet(
            (self.lower & ~violated.joining) | violated.tensile,
            (self.upper & ~violated.softening) | violated.excessive,
        )


def extrapolated(violated: Violations, active: ActiveSet) -> Violations:
    """Violations with the runs of two nodes or more at edges extrapolated."""
    tensile = _retreat(violated.tensile, active.free)
    joining = _advance(violated.joining, active.free)
    return Violations(tensile, violated.excessive, joining, violated.softening)


def _retreat(tensile: np.ndarray, free: np.ndarray) -> np.ndarray:
    """Runs of tension that begin at an edge of their patch, nearly twice as long."""
    starts, stops = runs_of(tensile)
    more = stops - starts - 1
    if not more.any():
        return tensile
    before, after = _free_beside(free, starts, stops)
    starts = np.maximum(starts - np.where(before & ~after, more, 0), 0)
    stops = np.minimum(stops + np.where(after & ~before, more, 0), len(tensile))
    return _marked(starts, stops, len(tensile)) & free


def _advance(joining: np.ndarray, free: np.ndarray) -> np.ndarray:
    """Runs of overlap beside a patch, two thirds as long."""
    starts, stops = runs_of(joining)
    fewer = (stops - starts) // 3
    if not fewer.any():
        return joining
    before, after = _free_beside(free, starts, stops)
    starts = starts + np.where(after & ~before, fewer, 0)
    stops = stops - np.where(before & ~after, fewer, 0)
    return _marked(starts, stops, len(joining))


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
