"""The profile in a table of two columns (x and height), or of heights alone."""

import numpy as np

from analytic.numerics import check_positive
from analytic.profile import MAX_SAMPLES
from analytic.surface.readers.dropouts import MIN_SAMPLES, MeasuredProfile, known_part, without_gaps
from analytic.surface.readers.source import ProfileError, shown
from analytic.surface.readers.text import DECIMAL_COMMAS, ProfileTable

SAME_PLACE = 1e-9  # of the length: x closer than this coincide


def profile_in(
    table: ProfileTable,
    *,
    x_scale: float,
    height_scale: float,
    spacing: float | None = None,
    dropouts: str = "refuse",
) -> MeasuredProfile:
    """The profile in the rows of a file; heights are not moved, x of heights alone starts at 0.

    x_scale, height_scale  m per unit of the file
    spacing    [m] sample distance, which a file of heights alone needs and no other may have
    dropouts   "refuse": the first one is an error. "bridge": they are put on the straight line
               between their neighbours, and left out at the ends of the trace; a lost x is taken
               midway between its neighbours' if the rows are in order. A gap in x is such, too
    Rows may come in any order of x, but not twice at one x.
    Raises ProfileError (one line with the file, the line number, what is wrong, what is allowed)
    for a file that cannot be read or trusted, ValueError for arguments that make no sense."""
    pitch = {} if spacing is None else {"spacing": spacing}
    check_positive(x_scale=x_scale, height_scale=height_scale, **pitch)
    if dropouts not in ("refuse", "bridge"):
        raise ValueError(f"dropouts is {dropouts!r}; allowed: refuse, bridge")
    _check_shape(table, spacing)
    lost = np.any(np.isnan(table.numbers), axis=1)
    if dropouts == "refuse" and np.any(lost):
        raise _dropout_error(table, lost)
    height = table.numbers[:, -1] * height_scale
    x = np.arange(len(height)) * spacing if spacing else _places(table, x_scale)
    x, height, rows = known_part(table.path, x, height, lost)
    _check_places(table, x, rows)
    how = {"format": table.format, "place": None, "trimmed": len(lost) - len(rows)}
    return without_gaps(table.path, x, height, lost[rows], dropouts, **how)


def _check_shape(table: ProfileTable, spacing: float | None) -> None:
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
    if count > MAX_SAMPLES:
        raise ProfileError(table.path, f"has {count} samples; at most {MAX_SAMPLES} are allowed")


def _dropout_error(table: ProfileTable, lost: np.ndarray) -> ProfileError:
    row = int(np.argmax(lost))
    what = "height" if np.isnan(table.numbers[row, -1]) else "x"
    others = int(np.count_nonzero(lost)) - 1
    more = f", and something in {others} more line{'s' * (others > 1)}" if others else ""
    cells = table.text[row]
    shows = f" ({shown(cells)})" if isinstance(cells, str) else ""  # of arrays there is no text
    message = f"{what} is lost{shows}{more}; "
    return table.error(row, f"{message}correct it, or ask for dropouts to be bridged")


def _places(table: ProfileTable, scale: float) -> np.ndarray:
    """x [m] of every row, a lost one midway between its neighbours' if these are in order."""
    x = table.numbers[:, 0] * scale
    lost = np.isnan(x)
    if not np.any(lost) or np.all(lost):
        return x
    known = np.flatnonzero(~lost)
    steps = np.diff(x[known])
    if not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        message = "x is lost where the rows are not in order of x; remove the line"
        raise table.error(int(np.argmax(lost)), message)
    return np.interp(np.arange(len(x)), known, x[known], left=np.nan, right=np.nan)


def _check_places(table: ProfileTable, x: np.ndarray, rows: np.ndarray) -> None:
    """Refuse samples at one x: `x` ascends, `rows` are theirs in the table."""
    length = x[-1] - x[0]
    hint = f"; {DECIMAL_COMMAS}" if table.commas_may_be_decimal() else ""
    if length == 0.0:
        raise ProfileError(table.path, f"x is the same in every line; it must differ in all{hint}")
    same = np.flatnonzero(np.diff(x) <= SAME_PLACE * length)
    if len(same):
        pairs = np.sort(np.stack((rows[same], rows[same + 1])), axis=0)
        first, second = pairs[:, np.argmin(pairs[1])]
        message = f"x is the same as in line {table.lines[first]}; every sample needs its own{hint}"
        raise table.error(int(second), message)
