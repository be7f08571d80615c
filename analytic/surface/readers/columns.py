"""Measured profiles from text files: two columns (x and height), or heights alone."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analytic.numerics import check_positive
from analytic.profile import MAX_SAMPLES, Profile
from analytic.surface.readers.source import ProfileError, shown
from analytic.surface.readers.text import DECIMAL_COMMAS, ProfileTable, read_table


def bridge(
    x: np.ndarray, height: np.ndarray, lost: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x and height (m,) [m] without gaps, and the m samples that they come from.

    x      (n,) [m] in any order; NaN only at ends that are left out
    lost   (n,) which heights are; at least one is not
    Lost samples beyond the outermost ones that are known are left out.
    """
    good = np.flatnonzero(~lost)
    good = good[np.argsort(x[good], kind="stable")]
    inside = np.flatnonzero((x >= x[good[0]]) & (x <= x[good[-1]]))
    height = np.where(lost, np.interp(x, x[good], height[good]), height)
    return x[inside], height[inside], inside


GAP, UNEVEN_GAP = 2.5, 5.0  # of the usual step: so long a one has lost samples in it
EVEN = (0.5, 1.5)  # of the median step: most steps of an even trace, its x rounded or not


@dataclass(frozen=True)
class Gap:
    """A stretch of a trace, from `start` to `stop` [m], that lacks `lost` samples."""

    start: float
    stop: float
    lost: int


def gaps(x: np.ndarray) -> list[Gap]:
    """Where samples are missing in x (n,) [m], strictly ascending.

    A step is a gap above GAP medians of an even trace (nine steps in ten are near the median),
    above UNEVEN_GAP times what nine steps in ten do not exceed of any other.
    """
    steps = np.diff(x)
    usual = float(np.median(steps))
    even = np.mean((steps >= EVEN[0] * usual) & (steps <= EVEN[1] * usual)) >= 0.9
    most = GAP * usual if even else UNEVEN_GAP * float(np.quantile(steps, 0.9))
    return [
        Gap(float(x[i]), float(x[i + 1]), max(round(float(min(steps[i] / usual, 1e9))) - 1, 1))
        for i in np.flatnonzero(steps > most)
    ]


def fill_gaps(
    path: Path, x: np.ndarray, height: np.ndarray, dropouts: str, max_samples: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x and height (m,) with samples on the straight line across every gap, and which those are.

    Raises ProfileError, which names the first gap, where dropouts are not to be bridged.
    """
    found = gaps(x)
    if not found:
        return x, height, np.zeros(len(x), dtype=bool)
    if dropouts == "refuse":
        first, lost = found[0], sum(gap.lost for gap in found)
        more = f", and at {len(found) - 1} more places" if len(found) > 1 else ""
        raise ProfileError(
            path,
            f"x has a gap from {first.start:.6g} m to {first.stop:.6g} m{more} ({lost} "
            f"sample{'s' * (lost > 1)} lost); correct it, or ask for dropouts to be bridged",
        )
    if len(x) + sum(gap.lost for gap in found) > max_samples:
        message = f"x has a gap of {max(found, key=lambda gap: gap.lost).lost} samples"
        raise ProfileError(path, f"{message}; at most {max_samples} samples are allowed in all")
    every = np.sort(
        np.concatenate(
            [x, *(np.linspace(gap.start, gap.stop, gap.lost + 2)[1:-1] for gap in found)]
        )
    )
    return every, np.interp(every, x, height), ~np.isin(every, x)


def longest_bridge(x: np.ndarray, bridged: np.ndarray) -> tuple[float, float] | None:
    """Ends [m] of the longest stretch of x (n,) whose samples are all `bridged`, or None."""
    known = x[~bridged]
    if len(known) == len(x):
        return None
    inside = np.searchsorted(known, x[bridged], side="right")
    inside = inside[(inside > 0) & (inside < len(known))]
    if not len(inside):
        return None
    widest = inside[np.argmax(known[inside] - known[inside - 1])]
    return float(known[widest - 1]), float(known[widest])


MIN_SAMPLES = 4
BYTES_PER_SAMPLE = 100  # no export uses more
BYTES_OF_HEADER = 2**20
SAME_PLACE = 1e-9  # of the length: x closer than this coincide


@dataclass(frozen=True)
class ReadProfile:
    """A profile as its file gives it, and how it was read.

    profile   x and height in m, x ascending; heights not moved; x of heights alone starts at 0
    bridged   dropouts put on the straight line between their neighbours
    trimmed   dropouts left out at the ends of the trace
    stretch   [m] from where to where the longest of those lines goes, None without any
    """

    profile: Profile
    bridged: int
    trimmed: int
    stretch: tuple[float, float] | None


def profile_in(
    table: ProfileTable,
    *,
    x_scale: float,
    height_scale: float,
    spacing: float | None = None,
    dropouts: str = "refuse",
    max_samples: int = MAX_SAMPLES,
) -> ReadProfile:
    """The profile in the rows of a file, of its one or two columns.

    x_scale, height_scale  m per unit of the file
    spacing    [m] sample distance, which a file of heights alone needs and no other may have
    dropouts   "refuse": the first one is an error. "bridge": they are put on the straight line
               between their neighbours, and left out at the ends of the trace; a lost x is taken
               midway between its neighbours' if the rows are in order. A gap in x is such, too
    Rows may come in any order of x, but not twice at one x.
    Raises ProfileError (one line with the file, the line number, what is wrong, what is allowed)
    for a file that cannot be read or trusted, ValueError for arguments that make no sense.
    """
    given = {} if spacing is None else {"spacing": spacing}
    check_positive(x_scale=x_scale, height_scale=height_scale, **given)
    if dropouts not in ("refuse", "bridge"):
        raise ValueError(f"dropouts is {dropouts!r}; allowed: refuse, bridge")
    path = table.path
    _check_shape(table, spacing, max_samples)
    lost = np.any(np.isnan(table.numbers), axis=1)
    if dropouts == "refuse" and np.any(lost):
        raise _dropout_error(table, lost)
    height = table.numbers[:, -1] * height_scale
    x = np.arange(len(height)) * spacing if spacing else table.numbers[:, 0] * x_scale
    if np.any(lost):
        x, height, inside = _bridge(table, x, height, lost)
    else:
        inside = np.arange(len(x))
    if len(inside) < MIN_SAMPLES:
        message = f"{len(inside)} samples are left without the dropouts at its ends"
        raise ProfileError(path, f"{message}; a profile needs at least {MIN_SAMPLES}")
    order = np.argsort(x, kind="stable")
    _check_places(table, x[order], inside[order])
    made = lost[inside][order]
    try:
        known = Profile(x[order], height[order])
    except ValueError as error:
        raise ProfileError(path, f"holds no profile: {error}") from error
    x, height, filled = fill_gaps(path, known.x, known.height, dropouts, max_samples)
    bridged = filled.copy()
    bridged[~filled] = made
    return ReadProfile(
        profile=Profile(x, height),
        bridged=int(np.count_nonzero(bridged)),
        trimmed=len(lost) - len(inside),
        stretch=longest_bridge(x, bridged),
    )


def read_profile(path: str | Path, *, max_samples: int = MAX_SAMPLES, **how: object) -> ReadProfile:
    """The profile in a text file of one or two columns; `how` as `profile_in` has it."""
    one_column = how.get("spacing") is not None
    table = read_table(Path(path), most_bytes(max_samples), one_column)
    return profile_in(table, max_samples=max_samples, **how)


def most_bytes(max_samples: int) -> int:
    """Size that a text of so many samples does not exceed."""
    return BYTES_PER_SAMPLE * max_samples + BYTES_OF_HEADER


def _check_shape(table: ProfileTable, spacing: float | None, max_samples: int) -> None:
    count = len(table.lines)
    if table.numbers.shape[1] == 2 and spacing is not None:
        message = "two columns bring their own x; the sample spacing is for heights alone"
        raise table.error(0, message)
    if table.numbers.shape[1] == 1 and spacing is None:
        message = "one column holds heights alone, and these need the sample spacing"
        raise table.error(0, message)
    if count < MIN_SAMPLES:
        plural = "s" * (count > 1)
        message = f"has {count} sample{plural}; a profile needs at least {MIN_SAMPLES}"
        raise ProfileError(table.path, message)
    if count > max_samples:
        raise ProfileError(table.path, f"has {count} samples; at most {max_samples} are allowed")


def _dropout_error(table: ProfileTable, lost: np.ndarray) -> ProfileError:
    row = int(np.argmax(lost))
    what = "height" if np.isnan(table.numbers[row, -1]) else "x"
    others = int(np.count_nonzero(lost)) - 1
    more = f", and something in {others} more line{'s' * (others > 1)}" if others else ""
    return table.error(
        row,
        f"{what} is lost ({shown(table.text[row])}){more}; "
        "correct it, or ask for dropouts to be bridged",
    )


def _bridge(
    table: ProfileTable, x: np.ndarray, height: np.ndarray, lost: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x and height without gaps, and the rows that they come from (the ends may go)."""
    if np.all(lost):
        raise ProfileError(table.path, "holds nothing but dropouts")
    lost_x = np.isnan(x)
    if np.any(lost_x):
        known = np.flatnonzero(~lost_x)
        steps = np.diff(x[known])
        if not (np.all(steps > 0.0) or np.all(steps < 0.0)):
            message = "x is lost where the rows are not in order of x; remove the line"
            raise table.error(int(np.argmax(lost_x)), message)
        x = np.interp(np.arange(len(x)), known, x[known], left=np.nan, right=np.nan)
    return bridge(x, height, lost)


def _check_places(table: ProfileTable, x: np.ndarray, rows: np.ndarray) -> None:
    """Refuse samples at one place: `x` ascends, `rows` are theirs in the table."""
    length = x[-1] - x[0]
    hint = f"; {DECIMAL_COMMAS}" if table.commas_may_be_decimal() else ""
    if length == 0.0:
        raise ProfileError(table.path, f"x is the same in every line; it must differ in all{hint}")
    same = np.flatnonzero(np.diff(x) <= SAME_PLACE * length)
    if not len(same):
        return
    pairs = np.sort(np.stack((rows[same], rows[same + 1])), axis=0)
    first, second = pairs[:, np.argmin(pairs[1])]
    message = f"x is the same as in line {table.lines[first]}; every sample needs its own{hint}"
    raise table.error(int(second), message)
