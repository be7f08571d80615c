"""Topography in a measuring instrument's file: a line scan, or a map of which one line is pressed.

Heights that were not measured are NaN. A map's first sample lies at (0, 0); columns follow each
other along its x, rows along its y, both in the order of the file and counted from 0."""

from dataclasses import dataclass
from math import hypot
from pathlib import Path

import numpy as np

from analytic.surface.readers.source import ProfileError

STENCIL = 4  # samples each way that a height between samples comes from
ROUNDING = 1e-9  # of a pitch, by which the ends of a line may pass the map's


class UnchosenLineError(ProfileError):
    """The file is a map, and no line of it was chosen."""


@dataclass(frozen=True)
class Topography:
    """Heights of one channel of a file."""

    path: Path
    # (rows, columns) of a map, (n,) of a line scan; [m], or what the file counts in where it names
    # no unit; NaN where nothing was measured
    heights: np.ndarray
    # distance between columns and between rows (of a scan: twice that of its samples), in the same
    # unit; None where the file gives none, or the scan is uneven
    pitch: tuple[float, float] | None
    x: np.ndarray | None  # (n,) positions of an uneven scan, ascending; else None
    unit: float | None  # [m] what the file counts in, None where it does not say
    format: str  # of the file, in words
    # names of the channels of which `channel` is this, () where the file has no names
    channels: tuple[str, ...] = ()
    channel: str | None = None

    @property
    def is_map(self) -> bool:
        return self.heights.ndim == 2

    def size(self) -> str:
        """Rows, columns and lengths in words."""
        rows, columns = self.heights.shape
        words = f"{rows} row{'s' * (rows != 1)} and {columns} column{'s' * (columns != 1)}"
        if self.pitch is None or self.unit is None:
            return words
        along, across = (columns - 1) * self.pitch[0], (rows - 1) * self.pitch[1]
        return f"{words}, {along:.6g} m by {across:.6g} m"


@dataclass(frozen=True)
class MapLine:
    """Line of a map: exactly one of a row, a column and a straight `line`."""

    row: int | None = None  # counted from 0
    column: int | None = None  # the same
    # its first and last point, ((x0, y0), (x1, y1)) [m]
    line: tuple[tuple[float, float], tuple[float, float]] | None = None

    def __str__(self) -> str:
        if self.row is not None:
            return f"row {self.row}"
        if self.column is not None:
            return f"column {self.column}"
        start, stop = (f"({x:g} m, {y:g} m)" for x, y in self.line)
        return f"line from {start} to {stop}"


def trace_of(topography: Topography, chosen: MapLine | None) -> tuple[np.ndarray, np.ndarray]:
    """Points x (n,), from 0 on a map, and heights (n,) of a scan, or of the chosen line of a map.

    In the unit of the topography, which must have a pitch or an x. A line that follows neither
    rows nor columns is sampled at its start, at its end and evenly between at about the smaller
    pitch, by cubic interpolation over 4 x 4 samples; where one of these was not measured, the
    height is NaN. Raises ProfileError for a scan of which a line is chosen, or outside the map."""
    if not topography.is_map:
        refuse_line(topography.path, chosen)
        if topography.x is not None:
            return topography.x, topography.heights
        return np.arange(len(topography.heights)) * topography.pitch[0], topography.heights
    rows, columns = topography.heights.shape
    along, across = topography.pitch
    for what, number, count in (("row", chosen.row, rows), ("column", chosen.column, columns)):
        if number is not None and not 0 <= number < count:
            raise ProfileError(
                topography.path,
                f"has no {what} {number} (a map of {topography.size()}); "
                f"allowed is from 0 to {count - 1}",
            )
    if chosen.row is not None:
        return np.arange(columns) * along, topography.heights[chosen.row]
    if chosen.column is not None:
        return np.arange(rows) * across, topography.heights[:, chosen.column]
    return _along(topography, np.array(chosen.line, dtype=float))


def check_chosen(topography: Topography, chosen: MapLine | None) -> None:
    """Raise UnchosenLineError for a map of which no line is chosen."""
    if topography.is_map and chosen is None:
        raise UnchosenLineError(
            topography.path,
            f"is a map of {topography.size()}, and a profile is one line of it; allowed is "
            "row, column (counted from 0) or line (from one point to another)",
        )


def refuse_line(path: Path, chosen: MapLine | None) -> None:
    """ProfileError where a line of a map was chosen from a line scan."""
    if chosen is not None:
        what = str(chosen).split()[0]
        message = f"is a line scan, which has no {what}s; allowed is to leave out {what}"
        raise ProfileError(path, message)


def _along(topography: Topography, ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Trace between two points, `ends` (2, 2) of x and y."""
    rows, columns = topography.heights.shape
    if min(rows, columns) < STENCIL:
        message = f"is a map of {topography.size()}, too few to lay a line across; allowed is row"
        raise ProfileError(topography.path, f"{message} or column")
    pitch = np.array(topography.pitch)
    most = np.array([columns - 1, rows - 1])
    places = ends / pitch
    if np.any(places < -ROUNDING) or np.any(places > most + ROUNDING):
        raise ProfileError(
            topography.path,
            f"line leaves the map ({topography.size()}); allowed are x and y inside it, from 0",
        )
    length = hypot(*(ends[1] - ends[0]))
    if length == 0.0:
        message = "line starts and ends at the same point; allowed are two different ones"
        raise ProfileError(topography.path, message)
    count = 1 + max(1, round(length / float(np.min(pitch))))
    share = np.linspace(0.0, 1.0, count)
    column, row = (np.clip(places[0] + share[:, None] * (places[1] - places[0]), 0, most)).T
    return share * length, _interpolated(topography.heights, row, column)


def _interpolated(heights: np.ndarray, row: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Heights (n,) between samples: a cubic through four samples each way."""
    first_row, row_weights = _cubic(row, heights.shape[0])
    first_column, column_weights = _cubic(column, heights.shape[1])
    height = np.zeros(len(row))
    for i in range(STENCIL):
        for j in range(STENCIL):
            weight = row_weights[i] * column_weights[j]
            term = weight * heights[first_row + i, first_column + j]
            height += np.where(weight == 0.0, 0.0, term)  # on a sample its neighbours do not count
    return height


def _cubic(place: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """First of four samples around each x (n,), and Lagrange's weights of the four (4, n)."""
    first = np.clip(np.floor(place).astype(int) - 1, 0, count - STENCIL)
    t = place - first
    weights = (
        -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0,
        t * (t - 2.0) * (t - 3.0) / 2.0,
        -t * (t - 1.0) * (t - 3.0) / 2.0,
        t * (t - 1.0) * (t - 2.0) / 6.0,
    )
    return first, np.array(weights)
