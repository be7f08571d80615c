"""A roughness profile as data, and as the C2 curve that both models press on."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

MAX_SAMPLES = 2_000_000  # the spline of so many samples takes 0.25 GB while it is built
MIN_SAMPLES = 8  # of a made profile
ROUNDING = 1e-6  # of the sample spacing: so far beyond its end a profile is still evaluated
# Sizes [m] between which slopes, curvatures and their powers still fit a double.
CLOSEST, FARTHEST = 1e-33, 1e33

Surface = Callable[..., np.ndarray]
"""`surface(x, derivative=0)`: height [m], slope [-] or curvature [1/m] at x [m], shape of x."""


@dataclass(frozen=True)
class Profile:
    """Heights along a line, unknown outside its samples; or periodic, the last sample the first."""

    x: np.ndarray  # (n,) [m] strictly ascending, n >= 4; the samples need not be evenly spaced
    height: np.ndarray  # (n,) [m] positive out of the body
    periodic: bool = False  # the surface repeats after its `length`

    def __post_init__(self) -> None:
        if self.x.ndim != 1 or self.x.shape != self.height.shape:
            raise ValueError("x and height must be one-dimensional and of equal length")
        if len(self.x) < 4:
            raise ValueError(f"a profile needs at least 4 samples, not {len(self.x)}")
        if not (np.all(np.isfinite(self.x)) and np.all(np.isfinite(self.height))):
            raise ValueError("a profile's samples must be finite")
        step = np.diff(self.x)
        if not np.all(step > 0.0):
            raise ValueError("a profile's x must ascend strictly")
        if (least := float(step.min())) < CLOSEST:
            raise ValueError(f"samples are {least:.3g} m apart; allowed is {CLOSEST:g} m or more")
        for name, values in (("position", self.x), ("height", self.height)):
            if (most := float(np.abs(values).max())) > FARTHEST:
                raise ValueError(f"a {name} is {most:.3g} m; allowed is up to {FARTHEST:g} m")
        if self.periodic and self.height[0] != self.height[-1]:
            raise ValueError("the last sample of a periodic profile must repeat the first")

    @property
    def length(self) -> float:
        """Distance from the first to the last sample [m]."""
        return float(self.x[-1] - self.x[0])

    @property
    def spacing(self) -> float:
        """Median distance between neighbouring samples [m]."""
        return float(np.median(np.diff(self.x)))

    def spline(self) -> "CubicSpline":
        """C2 cubic spline through the samples: height(x) [m]. Unlike `surface` it extrapolates; of
        a periodic profile it is known everywhere."""
        from scipy.interpolate import CubicSpline  # slow to load, and not needed to hold samples

        ends = "periodic" if self.periodic else "not-a-knot"
        return CubicSpline(self.x, self.height, bc_type=ends)

    def shifted(self, position: float) -> "Profile":
        """Profile whose x = `position` [m] is moved to the origin."""
        return replace(self, x=self.x - position)


def surface(profile: Profile) -> Surface:
    """The profile's spline as a callable that refuses to leave the samples. The result takes x [m]
    of any shape and `derivative` (0 height, 1 slope, 2 curvature), and raises ValueError where x
    lies outside the profile by more than rounding. It can be pickled."""
    if profile.periodic:
        return profile.spline()
    return partial(_within, profile.spline(), ROUNDING * profile.spacing)


def _within(spline: "CubicSpline", slack: float, x: np.ndarray, derivative: int = 0) -> np.ndarray:
    first, last = float(spline.x[0]), float(spline.x[-1])
    x = np.asarray(x, dtype=float)
    outside = ~((x >= first - slack) & (x <= last + slack))
    if np.any(outside):
        raise ValueError(
            f"the profile is known from x = {first:g} m to {last:g} m, "
            f"not at {float(x[outside].flat[0]):g} m"
        )
    return spline(np.clip(x, first, last), derivative)
