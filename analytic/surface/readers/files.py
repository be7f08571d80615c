"""Measured profiles from any file: text, SDF, or what an instrument wrote.

Text of one or two columns is a profile (`columns`). Everything else is a topography: surface data
files (`topography`), and what SurfaceTopography knows (`instruments`), among it text with more than
two columns whose header gives the map's size and unit.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analytic.profile import MAX_SAMPLES, Profile
from analytic.surface.readers.columns import MIN_SAMPLES, bridge, read_profile
from analytic.surface.readers.instruments import (
    AbsentReaderError,
    install_command,
    read_instrument_file,
)
from analytic.surface.readers.text import (
    NOT_TEXT,
    ColumnsError,
    NotTextError,
    ProfileError,
    regular_file,
    unreadable,
)
from analytic.surface.readers.topography import (
    MapLine,
    Topography,
    is_sdf,
    read_sdf,
    refuse_line,
    trace_of,
)

HEAD = 4096  # bytes by which text is recognised
MAX_BYTES = 2**31  # of a topography
SAME_UNIT = 1e-9  # relative


@dataclass(frozen=True)
class MeasuredProfile:
    """A profile as its file gives it, in m, and how it was read.

    format     text | SDF … | x3p, by SurfaceTopography …
    place      which line of which map, None for a line scan
    bridged    dropouts put on the straight line between their neighbours
    trimmed    dropouts left out at the ends of the trace
    """

    profile: Profile
    format: str
    place: str | None
    bridged: int
    trimmed: int


class MissingUnitError(ProfileError):
    """The file does not say what only the caller can; `field` of `read_measured` is missing."""

    def __init__(self, path: object, field: str, message: str) -> None:
        self.field = field
        super().__init__(path, message)


def read_measured(
    path: str | Path,
    *,
    x_scale: float | None = None,
    height_scale: float | None = None,
    spacing: float | None = None,
    dropouts: str = "refuse",
    chosen: MapLine | None = None,
    max_samples: int = MAX_SAMPLES,
) -> MeasuredProfile:
    """The profile in a file.

    x_scale, height_scale  m per unit of the file; text needs the second, a file that names its
               unit neither, and where they are given nevertheless they must agree with it
    spacing    [m] of samples: of text with heights alone, and of a file without a size
    dropouts   "refuse" or "bridge", as `read_profile` has it
    chosen     the line of a map; needed for a map, wrong for anything else
    Raises MissingUnitError for what else is needed, ProfileError for a file that cannot be used.
    """
    path = Path(path)
    head = _head(path)
    rest = (path, x_scale, height_scale, spacing, dropouts, chosen)
    if is_sdf(head):
        return _from_topography(read_sdf, *rest)
    if NOT_TEXT.search(head.decode("latin-1")) and head[:2] not in (b"\xff\xfe", b"\xfe\xff"):
        return _from_topography(read_instrument_file, *rest)
    try:
        read = read_profile(
            path,
            x_scale=x_scale or 1.0,
            height_scale=height_scale or 1.0,
            spacing=spacing,
            dropouts=dropouts,
            max_samples=max_samples,
        )
    except NotTextError:
        return _from_topography(read_instrument_file, *rest)
    except ColumnsError as error:
        return _from_topography(_map_in_text(error), *rest)
    refuse_line(path, chosen)
    _check_given(path, x_scale or spacing, height_scale, "is text, which names no unit")
    return MeasuredProfile(read.profile, "text", None, read.bridged, read.trimmed)


def _head(path: Path) -> bytes:
    regular_file(path)
    try:
        with path.open("rb") as file:
            return file.read(HEAD)
    except OSError as error:
        raise unreadable(path, error) from error


def _map_in_text(columns: ColumnsError) -> Callable[[Path], Topography]:
    """Reader of a matrix of heights; what the other readers do not know stays a wrong profile."""

    def read(path: Path) -> Topography:
        try:
            topography = read_instrument_file(path)
        except AbsentReaderError:
            hint = "a map with its size and unit in its header is read by SurfaceTopography"
            raise ProfileError(
                path, f"{columns.message}; {hint}, to install it: {install_command()}", columns.line
            ) from None
        except ProfileError:
            raise columns from None
        if topography.unit is None or topography.pitch is None:
            raise columns
        return topography

    return read


def _check_given(path: Path, x: float | None, height: float | None, because: str) -> None:
    for field, value in (("x_unit", x), ("z_unit", height)):
        if value is None:
            raise MissingUnitError(path, field, because)


def _from_topography(
    reader: Callable[[Path], Topography],
    path: Path,
    x_scale: float | None,
    height_scale: float | None,
    spacing: float | None,
    dropouts: str,
    chosen: MapLine | None,
) -> MeasuredProfile:
    if (size := regular_file(path)) > MAX_BYTES:
        message = f"is too large, {size / 1e9:.3g} GB; allowed are {MAX_BYTES / 1e9:.3g} GB"
        raise ProfileError(path, message)
    found = _in_metres(reader(path), x_scale, height_scale, spacing)
    x, height = trace_of(found, chosen)
    lost = np.isnan(height)
    if dropouts == "refuse" and np.any(lost):
        first, count = int(np.argmax(lost)), int(np.count_nonzero(lost))
        where = f"sample {first} of {chosen}" if chosen else f"sample {first}"
        raise ProfileError(
            path,
            f"{where}, at x = {x[first]:g} m, was not measured"
            + (f", nor {'were' if count > 2 else 'was'} {count - 1} more" if count > 1 else "")
            + "; choose another line, or ask for dropouts to be bridged",
        )
    if np.all(lost):
        raise ProfileError(path, "holds nothing but dropouts there")
    x, height, inside = bridge(x, height, lost)
    if len(inside) < MIN_SAMPLES:
        raise ProfileError(
            path,
            f"has {len(inside)} sample{'s' * (len(inside) != 1)} there; "
            f"a profile needs at least {MIN_SAMPLES}",
        )
    try:
        profile = Profile(x, height)
    except ValueError as error:
        raise ProfileError(path, f"holds no profile: {error}") from error
    return MeasuredProfile(
        profile=profile,
        format=found.format,
        place=f"{chosen} of {found.size()}" if chosen else None,
        bridged=int(np.count_nonzero(lost[inside])),
        trimmed=len(lost) - len(inside),
    )


def _in_metres(
    found: Topography, x_scale: float | None, height_scale: float | None, spacing: float | None
) -> Topography:
    """The topography in m, with what its file does not say, and without contradiction to it."""
    path, pitch, heights, x = found.path, found.pitch, found.heights, found.x
    sized = pitch is not None or x is not None
    if spacing is not None and sized:
        raise ProfileError(path, "gives its own size; the sample spacing is for files without one")
    if not sized and spacing is None:
        raise MissingUnitError(path, "spacing", "does not give its size")
    if found.unit is not None:
        for name, scale in (("x_unit", x_scale), ("z_unit", height_scale)):
            if scale is not None and abs(scale / found.unit - 1.0) > SAME_UNIT:
                raise ProfileError(
                    path,
                    f"counts in units of {found.unit:g} m and not of {scale:g} m, as {name} has "
                    f"it; allowed is to leave out {name}",
                )
    else:
        _check_given(path, x_scale if sized else spacing, height_scale, "names no unit")
        heights = heights * height_scale
        if sized:
            pitch = None if pitch is None else (pitch[0] * x_scale, pitch[1] * x_scale)
            x = None if x is None else x * x_scale
    if not sized:
        pitch = (spacing, spacing)
    return Topography(path, heights, pitch, x, 1.0, found.format)
