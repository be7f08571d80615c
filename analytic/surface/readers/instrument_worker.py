"""Reads one file by SurfaceTopography, in a process of its own.

Arguments: the file, where to put its heights (.npz), and the channel if not the default. The last
line on standard output is JSON: what was found, or the problem in one line. A spreadsheet that the
library does not know is a table."""

import json
import re
import sys
import warnings
import zipfile
from importlib import metadata
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from SurfaceTopography import Topography

LONGEST_COMPLAINT = 200
MOST_CELLS = 2**22  # of a spreadsheet: a million rows of four; each takes 10 us
CELL = re.compile(rb"<(?:\w+:)?c[ />]")
TOO_LENIENT = ("hgt",)  # terrain: any file of twice a square number of bytes passes for it


def main(path: str, target: str, wanted: str | None = None) -> dict:
    """Reads `path`, writes `heights` and, for an uneven scan, `x` to `target`, in file units.
    Heights are (rows, columns) of a map; the result is format, version, pitch, unit [m] and its
    name, and the names of channels; or absent, or problem. Of a spreadsheet it is the head above
    the rows, whose numbers are in `target`."""
    warnings.simplefilter("ignore")
    # Without it SurfaceTopography does well; with it, this process would be one of an MPI run.
    sys.modules["mpi4py"] = None
    try:
        import SurfaceTopography
        from SurfaceTopography.Exceptions import CannotDetectFileFormat
        from SurfaceTopography.Support.UnitConversion import (
            get_unit_conversion_factor,
            is_length_unit,
        )
    except ImportError as error:
        return {"absent": _line(error)}
    version = metadata.version("SurfaceTopography")  # its own is that of any git around
    known = set(SurfaceTopography.IO.lookup_reader_by_format) - {*TOO_LENIENT}
    formats = ", ".join(sorted(known))
    unknown = {
        "problem": "is of no format that is known; allowed is text of columns, gz of any, xlsx, "
        f"npy, npz, or what SurfaceTopography {version} reads ({formats}); a newer "
        "one may know it, in an environment whose python CROSSCHECK_SURFACE_PYTHON names"
    }
    if is_spreadsheet(path):
        if _most_cells(path) > MOST_CELLS:  # before a row of them all is taken apart
            return {"problem": f"has a sheet of more than {MOST_CELLS} cells"}
        unknown = spreadsheet(path, target, wanted)
    try:
        reader = SurfaceTopography.open_topography(path)
    except CannotDetectFileFormat:
        return unknown
    except Exception as error:
        return {"problem": f"cannot be read by SurfaceTopography {version} ({_line(error)})"}
    name = reader.format()
    if name in TOO_LENIENT or not reader.channels:  # a reader of mat takes what begins like one
        return unknown
    try:
        channel, names = reader.default_channel, [str(entry.name) for entry in reader.channels]
        if wanted is not None:
            if wanted not in names:
                return {"problem": f"has no channel {wanted!r}; allowed is {', '.join(names)}"}
            channel = reader.channels[names.index(wanted)]
        sized = channel.physical_sizes is not None or not channel.is_uniform
        # The library wants some size; one that the file does not give is not passed on.
        size = {} if sized else {"physical_sizes": tuple(map(float, channel.nb_grid_pts))}
        surface = channel.topography(**size)
        heights = np.ma.filled(np.ma.asarray(surface.heights(), dtype=float), np.nan)
        places = None if surface.is_uniform else np.asarray(surface.positions(), dtype=float)
    except Exception as error:
        return {"problem": f"is a damaged file of the format {name} ({_line(error)})"}
    pitch = None
    if sized and places is None:
        steps = np.divide(surface.physical_sizes, surface.nb_grid_pts)
        if name == "mi" and given_in_metres(surface):
            steps *= get_unit_conversion_factor("m", surface.unit)
        pitch = (float(steps[0]), float(steps[-1]))
    arrays = {} if places is None else {"x": places}
    np.savez(target, heights=heights.T, **arrays)
    unit = surface.unit
    known = isinstance(unit, str) and is_length_unit(unit)
    return {
        "format": name,
        "version": version,
        "pitch": pitch,
        "unit": float(get_unit_conversion_factor(unit, "m")) if known else None,
        "unit_name": None if unit is None else str(unit),
        "channels": names,
        "channel": str(channel.name),
    }


def given_in_metres(surface: "Topography") -> bool:
    """Whether the size of a map from an MI file is in m; its unit is then of the heights alone."""
    return surface.physical_sizes[0] == float(surface.info["raw_metadata"]["xLength"])


def is_spreadsheet(path: str) -> bool:
    return zipfile.is_zipfile(path) and "xl/workbook.xml" in zipfile.ZipFile(path).namelist()


def spreadsheet(path: str, target: str, wanted: str | None) -> dict:
    """The longest run of rows of numbers on a sheet, the first or `wanted`, in its columns. A cell
    without a number is a dropout; columns without any, and the rows above, are left out."""
    try:
        from openpyxl import load_workbook
    except ImportError as error:
        return {"absent": _line(error)}
    try:
        book = load_workbook(path, read_only=True, data_only=True)
        names = book.sheetnames
        if wanted is not None and wanted not in names:
            return {"problem": f"has no channel {wanted!r}; allowed is {', '.join(names)}"}
        rows, cells = [], 0
        for row in book[wanted or names[0]].iter_rows(values_only=True):
            rows.append(row)
            cells += len(row)
            if cells > MOST_CELLS:  # of a single one far down and to the right, too
                return {"problem": f"reaches over more than {MOST_CELLS} cells"}
    except Exception as error:
        return {"problem": f"is a damaged spreadsheet ({_line(error)})"}
    width = max(map(len, rows), default=0)
    numbers = np.full((len(rows), width), np.nan)
    for number, row in enumerate(rows):
        for place, cell in enumerate(row):
            if isinstance(cell, int | float) and not isinstance(cell, bool):
                numbers[number, place] = cell
    filled = np.count_nonzero(np.isfinite(numbers), axis=1)
    usual = np.median(filled[filled > 0]) if np.any(filled) else 1
    full = np.flatnonzero(filled >= usual)
    if len(full) < 2:
        sheet = wanted or names[0]
        return {"problem": f"holds no columns of numbers on the sheet {sheet!r} of {names}"}
    first, last = full[0], full[-1] + 1
    columns = np.flatnonzero(np.isfinite(numbers[first:last]).mean(axis=0) > 0.5)
    np.savez(target, table=numbers[first:last][:, columns], first=first + 1)
    above = [["" if cell is None else str(cell) for cell in row] for row in rows[:first]]
    titles = [line for line in above if any(line)][-1:]
    return {
        "format": "xlsx",
        "head": [", ".join(filter(None, line)) for line in above],
        "names": [titles[0][column].strip() for column in columns] if titles else [],
        "channels": names,
    }


def _most_cells(path: str) -> int:
    """Number of cells of the fullest sheet."""
    most = 0
    with zipfile.ZipFile(path) as book:
        for name in book.namelist():
            if name.startswith("xl/worksheets/"):
                with book.open(name) as sheet:
                    pieces = iter(lambda: sheet.read(2**24), b"")
                    most = max(most, sum(len(CELL.findall(piece)) for piece in pieces))
    return most


def _line(error: Exception) -> str:
    """The first line that an error says, not too long."""
    text = str(error).strip() or type(error).__name__
    return text.splitlines()[0][:LONGEST_COMPLAINT]


if __name__ == "__main__":
    answer = main(*sys.argv[1:])
    print("\n" + json.dumps(answer))
