"""Support of a block."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from fem.body.surface import BoundaryPoints

Base = Literal["bonded", "frictionless"]
Sides = Literal["free", "rollers", "fixed", "tied"]


@dataclass(frozen=True)
class Support:
    """Support of the block.

    Of square blocks in place of a half-plane the one bonded and fixed all round is the best:
    Hertz's largest shear stress is 0.22 % high at a depth of 400 half-widths and 0.9 % at 100; with
    rollers 0.38 and 1.5 %, with free sides 0.41 and 1.6 %. The pressure changes by 1e-4.

    With a frictionless base and free or tied sides the bottom point nearest to the middle is held
    horizontally; a load with a horizontal resultant has no equilibrium then."""

    # "bonded": no displacement at the bottom; "frictionless": no vertical displacement
    base: Base = "bonded"
    # "free"; "rollers": no horizontal displacement; "fixed": no displacement; "tied": both the same
    sides: Sides = "free"
    # (x, z) [m]: points with |x| or z beyond are fixed, which makes a smaller body of the same mesh
    within: tuple[float, float] = (np.inf, np.inf)

    def __post_init__(self) -> None:
        if self.base not in get_args(Base):
            raise ValueError(f"base must be one of {get_args(Base)}, not {self.base!r}")
        if self.sides not in get_args(Sides):
            raise ValueError(f"sides must be one of {get_args(Sides)}, not {self.sides!r}")
        if not min(self.within) > 0.0:
            raise ValueError(f"within must be two positive lengths, not {self.within}")

    @property
    def can_slide(self) -> bool:
        """Whether nothing but one pinned point resists a horizontal force."""
        return self.base == "frictionless" and self.sides in ("free", "tied")


def held_components(flat: np.ndarray, support: Support, sides: BoundaryPoints) -> np.ndarray:
    """(n, 2) whether the support holds a component of nodes at `flat` (n, 2) in the flat block."""
    held = np.zeros(flat.shape, dtype=bool)
    flanks = np.union1d(sides.left, sides.right)
    held[sides.bottom] = support.base == "bonded", True
    held[flanks, 0] |= support.sides in ("rollers", "fixed")
    held[flanks, 1] |= support.sides == "fixed"
    held[(np.abs(flat) > support.within).any(axis=1)] = True
    if support.can_slide:
        middle = np.argmin(np.abs(flat[sides.bottom, 0]))
        held[sides.bottom[middle], 0] = True
    return held
