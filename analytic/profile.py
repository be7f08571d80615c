"""A roughness profile as data, and as the C2 curve that both models press on."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline


@dataclass(frozen=True)
class Profile:
    """Heights along a line: `x` (n,) [m] strictly ascending, `height` (n,) [m] positive out of the body."""

    x: np.ndarray
    height: np.ndarray

    def __post_init__(self) -> None:
        if self.x.ndim != 1 or self.x.shape != self.height.shape:
            raise ValueError("x and height must be one-dimensional and of equal length")
        if len(self.x) < 4:
            raise ValueError(f"a profile needs at least 4 samples, not {len(self.x)}")
        if not (np.all(np.isfinite(self.x)) and np.all(np.isfinite(self.height))):
            raise ValueError("a profile's samples must be finite")
        if not np.all(np.diff(self.x) > 0.0):
            raise ValueError("a profile's x must ascend strictly")

    def spline(self) -> CubicSpline:
        """C2 cubic spline through the samples (not-a-knot ends): height(x) [m]."""
        return CubicSpline(self.x, self.height)
