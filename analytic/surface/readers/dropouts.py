"""Lost samples of a trace: put on the straight line between their neighbours, or refused."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analytic.profile import MAX_SAMPLES, Profile
from analytic.surface.readers.source import ProfileError

MIN_SAMPLES = 4
GAP, UNEVEN_GAP = 2.5, 5.0  # of the usual step: so long a one has lost samples in it
EVEN = (0.5, 1.5)  # of the median step: most steps of an even trace, its x rounded or not


@dataclass(frozen=True)
class MeasuredProfile:
    """A profile as its file gives it, in m, x ascending, and how it was read."""

    profile: Profile
    format: str  # text | npy | x3p, by SurfaceTopography …
    place: str | None  # which line of which map, None for a line scan
    bridged: int  # dropouts put on the straight line between their neighbours
    trimmed: int  # dropouts left out at the ends of the trace
    # [m] from where to where the longest bridge goes, None without any
    stretch: tuple[float, float] | None = None


def known_part(
    path: Path, x: np.ndarray, height: np.ndarray, lost: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x and height (m,) [m] without dropouts, by ascending x, and the samples that they come from.

    x      (n,) [m] in any order; NaN only at ends that are left out
    lost   (n,) which heights are; those beyond the outermost known ones are left out"""
    if np.all(lost):
        raise ProfileError(path, "holds nothing but dropouts")
    inside = np.argsort(x, kind="stable")
    if np.any(lost):
        good = inside[~lost[inside]]
        inside = inside[(x[inside] >= x[good[0]]) & (x[inside] <= x[good[-1]])]
        height = np.where(lost, np.interp(x, x[good], height[good]), height)
    if (count := len(inside)) < MIN_SAMPLES:
        message = f"has {count} sample{'s' * (count > 1)} but for dropouts at its ends"
        raise ProfileError(path, f"{message}; a profile needs at least {MIN_SAMPLES}")
    return x[inside], height[inside], inside


def without_gaps(
    path: Path,
    x: np.ndarray,
    height: np.ndarray,
    bridged: np.ndarray,
    dropouts: str,
    **how: object,
) -> MeasuredProfile:
    """The profile of x and height (n,) [m], `bridged` (n,) of them, with its gaps bridged as well.

    how   the fields of MeasuredProfile that are not found here
    Raises ProfileError for what is no profile, and at the first gap unless dropouts are bridged."""
    try:
        known = Profile(x, height)
    except ValueError as error:
        raise ProfileError(path, f"holds no profile: {error}") from error
    x, height, filled = fill_gaps(path, known.x, known.height, dropouts)
    every = filled.copy()
    every[~filled] = bridged
    stretch = longest_bridge(x, every)
    return MeasuredProfile(Profile(x, height), bridged=int(every.sum()), stretch=stretch, **how)


@dataclass(frozen=True)
class Gap:
    """A stretch of a trace, from `start` to `stop` [m], that lacks `lost` samples."""

    start: float
    stop: float
    lost: int


def gaps(x: np.ndarray) -> list[Gap]:
    """Gaps of missing samples in x (n,) [m], strictly ascending. A step is a gap above GAP
    medians of an even trace (nine steps in ten are near the median), above UNEVEN_GAP times what
    nine steps in ten do not exceed of any other."""
    steps = np.diff(x)
    usual = float(np.median(steps))
    even = np.mean((steps >= EVEN[0] * usual) & (steps <= EVEN[1] * usual)) >= 0.9
    most = GAP * usual if even else UNEVEN_GAP * float(np.quantile(steps, 0.9))
    return [
        Gap(float(x[i]), float(x[i + 1]), max(round(float(min(steps[i] / usual, 1e9))) - 1, 1))
        for i in np.flatnonzero(steps > most)
    ]


def fill_gaps(
    path: Path, x: np.ndarray, height: np.ndarray, dropouts: str
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x and height (m,) with samples on the straight line across every gap, and which those are."""
    missing = gaps(x)
    if not missing:
        return x, height, np.zeros(len(x), dtype=bool)
    lost = sum(gap.lost for gap in missing)
    if dropouts == "refuse":
        more = f", and at {len(missing) - 1} more places" if len(missing) > 1 else ""
        raise ProfileError(
            path,
            f"x has a gap from {missing[0].start:.6g} m to {missing[0].stop:.6g} m{more} ({lost} "
            f"sample{'s' * (lost > 1)} lost); correct it, or ask for dropouts to be bridged",
        )
    if len(x) + lost > MAX_SAMPLES:
        message = f"x has a gap of {max(gap.lost for gap in missing)} samples"
        raise ProfileError(path, f"{message}; at most {MAX_SAMPLES} samples are allowed in all")
    across = (np.linspace(gap.start, gap.stop, gap.lost + 2)[1:-1] for gap in missing)
    every = np.sort(np.concatenate([x, *across]))
    return every, np.interp(every, x, height), ~np.isin(every, x)


def longest_bridge(x: np.ndarray, bridged: np.ndarray) -> tuple[float, float] | None:
    """Ends [m] of the longest stretch of x (n,) whose samples are all `bridged`, or None."""
    known = x[~bridged]
    inside = np.searchsorted(known, x[bridged], side="right")
    inside = inside[(inside > 0) & (inside < len(known))]
    if not len(inside):
        return None
    widest = inside[np.argmax(known[inside] - known[inside - 1])]
    return float(known[widest - 1]), float(known[widest])
