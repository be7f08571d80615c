"""Reads one file by SurfaceTopography, in a process of its own.

Arguments: the file, and where to put its heights (.npz). The last line on standard output is
JSON: what was found, or the problem in one line.
"""

import json
import sys
import warnings

import numpy as np

LONGEST_COMPLAINT = 200
TOO_LENIENT = ("hgt",)  # terrain: any file of twice a square number of bytes passes for it


def main(path: str, target: str) -> dict:
    """Reads `path`, writes `heights` and, for an uneven scan, `x` to `target`, in file units.

    Heights are (rows, columns) of a map; the result is format, version, pitch, unit [m] and its
    name, or absent, or problem.
    """
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
    version = SurfaceTopography.__version__
    unknown = {
        "problem": f"is neither text nor of a format that SurfaceTopography {version} knows; "
        "allowed is text of one or two columns, SDF or one of these"
    }
    try:
        reader = SurfaceTopography.open_topography(path)
    except CannotDetectFileFormat:
        return unknown
    except Exception as error:
        return {"problem": f"cannot be read by SurfaceTopography {version} ({_line(error)})"}
    name = reader.format()
    if name in TOO_LENIENT:
        return unknown
    try:
        channel = reader.default_channel
        sized = channel.physical_sizes is not None or not channel.is_uniform
        # The library wants some size; one that the file does not give is not passed on.
        given = {} if sized else {"physical_sizes": tuple(map(float, channel.nb_grid_pts))}
        surface = channel.topography(**given)
        heights = np.ma.filled(np.ma.asarray(surface.heights(), dtype=float), np.nan)
        places = None if surface.is_uniform else np.asarray(surface.positions(), dtype=float)
    except Exception as error:
        return {"problem": f"is a damaged file of the format {name} ({_line(error)})"}
    pitch = None
    if sized and places is None:
        steps = np.divide(surface.physical_sizes, surface.nb_grid_pts).tolist()
        pitch = (steps[0], steps[-1])
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
    }


def _line(error: Exception) -> str:
    """The first line that an error says, not too long."""
    text = str(error).strip() or type(error).__name__
    return text.splitlines()[0][:LONGEST_COMPLAINT]


if __name__ == "__main__":
    found = main(*sys.argv[1:])
    print("\n" + json.dumps(found))
