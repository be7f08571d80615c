"""Measured profiles from text files: two columns (x and height), or heights alone."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analytic.numerics import check_positive
from analytic.profile import MAX_SAMPLES, Profile
from analytic.surface.readers.text import (
    DECIMAL_COMMAS,
    ProfileError,
    ProfileTable,
    read_table,
    shown,
)


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
    """

    profile: Profile
    bridged: int
    trimmed: int


def read_profile(
    path: str | Path,
    *,
    x_scale: float,
    height_scale: float,
    spacing: float | None = None,
    dropouts: str = "refuse",
    max_samples: int = MAX_SAMPLES,
) -> ReadProfile:
    """The profile in a text file; `analytic.surface.readers.text` says how the file is understood.

    x_scale, height_scale  m per unit of the file
    spacing    [m] sample distance, which a file of heights alone needs and no other may have
    dropouts   "refuse": the first one is an error. "bridge": they are put on the straight line
               between their neighbours, and left out at the ends of the trace; a lost x is taken
               midway between its neighbours' if the rows are in order
    Rows may come in any order of x, but not twice at one x.
    Raises ProfileError (one line with the file, the line number, what is wrong, what is allowed)
    for a file that cannot be read or trusted, ValueError for arguments that make no sense.
    """
    given = {} if spacing is None else {"spacing": spacing}
    check_positive(x_scale=x_scale, height_scale=height_scale, **given)
    if dropouts not in ("refuse", "bridge"):
        raise ValueError(f"dropouts is {dropouts!r}; allowed: refuse, bridge")
    max_bytes = BYTES_PER_SAMPLE * max_samples + BYTES_OF_HEADER
    table = read_table(Path(path), max_bytes, one_column=spacing is not None)
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
    bridged = int(np.count_nonzero(lost[inside]))
    return ReadProfile(Profile(x[order], height[order]), bridged, len(lost) - len(inside))


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
