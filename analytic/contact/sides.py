"""Which nodes of a contact are held at zero pressure or at the hardness, which of them wrongly."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

PLASTIC = 10  # nodes at the hardness to each free one, from which these alone do not lead on


@dataclass(frozen=True)
class Broken:
    """Nodes whose sign condition fails: tension, pressure beyond H, overlap, a gap under p = H."""

    tensile: np.ndarray
    excessive: np.ndarray
    joining: np.ndarray
    softening: np.ndarray

    def count(self) -> int:
        return int(np.count_nonzero(self.tensile | self.excessive | self.joining | self.softening))


@dataclass(frozen=True)
class Sides:
    """Which nodes are held at p = 0 (`lower`) and at p = H (`upper`); the others are free."""

    lower: np.ndarray
    upper: np.ndarray

    @classmethod
    def of(cls, pressure: np.ndarray, hardness: float) -> "Sides":
        return cls(pressure <= 0.0, pressure >= hardness)

    @cached_property
    def free(self) -> np.ndarray:
        return ~(self.lower | self.upper)

    def edges(self) -> int:
        """Places where the free nodes begin or end."""
        return int(np.count_nonzero(self.free[1:] != self.free[:-1]))

    def mostly_upper(self) -> bool:
        """Whether PLASTIC times as many nodes are at the hardness as are free."""
        return bool(np.count_nonzero(self.upper) > PLASTIC * np.count_nonzero(self.free))

    def exchanged(self, broken: Broken) -> "Sides":
        return Sides(
            (self.lower & ~broken.joining) | broken.tensile,
            (self.upper & ~broken.softening) | broken.excessive,
        )
