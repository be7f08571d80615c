"""Measured profiles from any file: text, arrays, or what an instrument wrote.

Text of columns, spreadsheets and arrays are tables, of which one or two columns are a profile
(`columns`). Everything else is a topography that SurfaceTopography knows (`instruments`), and
so is text that is no profile where it knows the size, or where a line of a map is asked for. Any of
them may be packed as gz."""

from collections.abc import Sequence
from dataclasses import replace
from math import isfinite
from pathlib import Path

import numpy as np

from analytic.profile import MAX_SAMPLES
from analytic.surface.readers.arrays import is_arrays, read_arrays
from analytic.surface.readers.columns import profile_in
from analytic.surface.readers.dropouts import MeasuredProfile, known_part, without_gaps
from analytic.surface.readers.instruments import (
    AbsentReaderError,
    install_command,
    read_instrument_file,
)
from analytic.surface.readers.source import (
    MAX_BYTES,
    NOT_TEXT,
    NotRowsError,
    NotTextError,
    ProfileError,
    beginning,
    regular_file,
    wide_encoding,
)
from analytic.surface.readers.text import ColumnsError, ProfileTable, chosen_columns, read_table
from analytic.surface.readers.topography import (
    MapLine,
    Topography,
    check_chosen,
    refuse_line,
    trace_of,
)

HEAD = 4096  # bytes by which text is recognised
BYTES_PER_SAMPLE, BYTES_OF_HEADER = 100, 2**20  # of a text: no export uses more
SAME_UNIT = 1e-9  # relative


class MissingUnitError(ProfileError):
    """The file does not say what only the caller can; `field` of `profile_of` is missing."""

    def __init__(self, path: object, field: str, message: str) -> None:
        self.field = field
        super().__init__(path, message)


def open_measured(
    path: str | Path,
    *,
    columns: Sequence[str | int] | None = None,
    channel: str | None = None,
    one_column: bool = False,
    is_map: bool = False,
) -> ProfileTable | Topography:
    """Open a file: a table of one or two columns, or a topography.

    columns     as `analytic.surface.readers.text.chosen_columns` has them
    channel     of a file with several, by its name (of xlsx a sheet); None is the first, or what
                the file says
    one_column  as `read_table` has it
    is_map      whether a line of a map is asked for: numbers that SurfaceTopography takes for a map
                are then one
    Raises ColumnsError where columns are to be chosen, ProfileError for a file that nothing reads.
    """
    path = Path(path)
    regular_file(path)
    head = beginning(path, HEAD)
    is_map = is_map and columns is None
    if is_arrays(path, head):
        return read_arrays(path, columns, channel, is_map)
    is_binary = NOT_TEXT.search(head.decode("latin-1")) and not wide_encoding(head)
    if channel is not None or is_binary:
        return _by_library(path, columns, channel)
    most_bytes = BYTES_PER_SAMPLE * MAX_SAMPLES + BYTES_OF_HEADER
    opened: ProfileTable | ProfileError
    try:
        opened = read_table(path, most_bytes, one_column, columns)
    except NotTextError:
        return _by_library(path, columns, channel)
    except ProfileError as refusal:
        opened = refusal
    if is_map or (columns is None and isinstance(opened, NotRowsError)):
        opened = _map_in_text(path, is_map, opened)
    if isinstance(opened, ProfileError):
        raise opened
    return opened


def _by_library(
    path: Path, columns: Sequence[str | int] | None, channel: str | None
) -> ProfileTable | Topography:
    if (size := regular_file(path)) > MAX_BYTES:
        message = f"is too large, {size / 1e9:.3g} GB; allowed are {MAX_BYTES / 1e9:.3g} GB"
        raise ProfileError(path, message)
    measured = read_instrument_file(path, channel)
    if isinstance(measured, ProfileTable):
        return chosen_columns(measured, columns)
    if columns is not None:
        raise ProfileError(path, "is one profile or map; allowed is to leave out columns")
    return measured


def profile_of(
    opened: ProfileTable | Topography,
    *,
    x_scale: float | None = None,
    height_scale: float | None = None,
    spacing: float | None = None,
    dropouts: str = "refuse",
    chosen: MapLine | None = None,
) -> MeasuredProfile:
    """The profile in what a file holds.

    x_scale, height_scale  m per unit of the file; a table needs the second, a file that names its
               unit neither, and where they are given nevertheless they must agree with it
    spacing    [m] of samples: of a table of heights alone, and of a file without a size
    dropouts   "refuse" or "bridge", as `profile_in` has it
    chosen     the line of a map; needed for a map, wrong for anything else
    Raises MissingUnitError for what else is needed, ProfileError for a file that cannot be used."""
    if isinstance(opened, Topography):
        return _from_topography(opened, x_scale, height_scale, spacing, dropouts, chosen)
    scales = {"x_scale": x_scale or 1.0, "height_scale": height_scale or 1.0}
    read = profile_in(opened, **scales, spacing=spacing, dropouts=dropouts)
    refuse_line(opened.path, chosen)
    because = f"is {opened.format}, from whose header no unit is taken"
    _check_given(opened.path, x_scale or spacing, height_scale, because)
    return read


def _map_in_text(
    path: Path, is_map: bool, opened: ProfileTable | ProfileError
) -> ProfileTable | Topography | ProfileError:
    """Topography that SurfaceTopography reads of text that is no profile, or that `is_map`; else
    `opened`, which says how to get SurfaceTopography where that may help."""
    try:
        topography = _by_library(path, None, None)
    except AbsentReaderError:
        if isinstance(opened, ColumnsError) or (is_map and isinstance(opened, ProfileError)):
            hint = "a map in text is read by SurfaceTopography, to install it"
            opened.args = (f"{opened}; {hint}: {install_command()}",)
        return opened
    except ProfileError:
        return opened
    has_size = topography.pitch is not None or topography.x is not None
    is_known = has_size and topography.unit is not None
    return topography if is_known or (topography.is_map and (is_map or has_size)) else opened


def _check_given(path: Path, x: float | None, height: float | None, because: str) -> None:
    for field, value in (("x_unit", x), ("z_unit", height)):
        if value is None:
            raise MissingUnitError(path, field, because)


def _from_topography(
    field: Topography,
    x_scale: float | None,
    height_scale: float | None,
    spacing: float | None,
    dropouts: str,
    chosen: MapLine | None,
) -> MeasuredProfile:
    path = field.path
    _check_size(field)
    try:
        field = _in_metres(field, x_scale, height_scale, spacing)
    finally:
        check_chosen(field, chosen)  # before its units: that it is a map explains the rest
    x, height = trace_of(field, chosen)
    lost = np.isnan(height)
    if dropouts == "refuse" and np.any(lost):
        first, count = int(np.argmax(lost)), int(np.count_nonzero(lost))
        where = f"sample {first} of {chosen}" if chosen else f"sample {first}"
        more = f", nor {'were' if count > 2 else 'was'} {count - 1} more" if count > 1 else ""
        message = f"{where}, at x = {x[first]:g} m, was not measured{more}"
        remedy = "choose another line, or ask for dropouts to be bridged"
        raise ProfileError(path, f"{message}; {remedy}")
    x, height, samples = known_part(path, x, height, lost)
    place = f"{chosen} of {field.size()}" if chosen else None
    how = {"format": field.format, "place": place, "trimmed": len(lost) - len(samples)}
    return without_gaps(path, x, height, lost[samples], dropouts, **how)


def _check_size(field: Topography) -> None:
    """Refuse a map without samples, or whose samples are no distance apart."""
    if field.heights.size == 0:
        shape = " by ".join(map(str, field.heights.shape))
        raise ProfileError(field.path, f"is a damaged file: it holds {shape} heights")
    if field.pitch is not None and not all(isfinite(step) and step > 0.0 for step in field.pitch):
        steps = " and ".join(f"{step:g}" for step in field.pitch)
        raise ProfileError(field.path, f"is a damaged file: its samples are {steps} apart")


def _in_metres(
    field: Topography, x_scale: float | None, height_scale: float | None, spacing: float | None
) -> Topography:
    """The topography in m, with what its file does not say, and without contradiction to it."""
    path, pitch, heights, x = field.path, field.pitch, field.heights, field.x
    sized = pitch is not None or x is not None
    if spacing is not None and sized:
        raise ProfileError(path, "gives its own size; the sample spacing is for files without one")
    if not sized and spacing is None:
        raise MissingUnitError(path, "spacing", "does not give its size")
    if field.unit is not None:
        for name, scale in (("x_unit", x_scale), ("z_unit", height_scale)):
            if scale is not None and abs(scale / field.unit - 1.0) > SAME_UNIT:
                message = f"counts in units of {field.unit:g} m and not of {scale:g} m, as {name}"
                raise ProfileError(path, f"{message} has it; allowed is to leave out {name}")
    else:
        _check_given(path, x_scale if sized else spacing, height_scale, "names no unit")
        heights = heights * height_scale
        if sized:
            pitch = None if pitch is None else (pitch[0] * x_scale, pitch[1] * x_scale)
            x = None if x is None else x * x_scale
    if not sized:
        pitch = (spacing, spacing)
    return replace(field, heights=heights, pitch=pitch, x=x, unit=1.0)
