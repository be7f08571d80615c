"""Files of measuring instruments (X3P, OPD, Talysurf, Mitutoyo and others), by SurfaceTopography.

That library is optional. It runs in a process of its own (`instrument_worker`): what it loads
(HDF5, MPI) must not meet dolfinx's, and a reader that crashes or hangs is a message."""

import json
import os
import shlex
import sys
import tempfile
from pathlib import Path

import numpy as np

from analytic.surface.readers.child import ReaderError, said_by
from analytic.surface.readers.source import (
    GZIP,
    MAX_BYTES,
    ProfileError,
    check_unpacked,
    contents,
    shown,
)
from analytic.surface.readers.text import ProfileTable
from analytic.surface.readers.topography import Topography

# Names the interpreter of an environment with a newer SurfaceTopography, which knows more formats
# and works with no numpy that Debian 12's dolfinx takes.
OTHER_PYTHON = "CROSSCHECK_SURFACE_PYTHON"
# By its path, and without the working folder's modules (-P).
WORKER = ("-P", str(Path(__file__).with_name("instrument_worker.py")))
ROOT = Path(__file__).resolve().parents[3]


class AbsentReaderError(ProfileError):
    """SurfaceTopography is not installed."""


def install_command() -> str:
    """The line to type that brings SurfaceTopography into this environment."""
    constraints = Path(sys.prefix) / "constraints.txt"  # keeps numpy where dolfinx needs it
    held = ["--constraint", str(constraints)] if constraints.exists() else []
    editable = (ROOT / "pyproject.toml").exists()
    what = ["--editable", f"{ROOT}[surface]"] if editable else ["crosscheck[surface]"]
    return shlex.join([sys.executable, "-m", "pip", "install", *held, *what])


def read_instrument_file(path: Path, channel: str | None = None) -> Topography | ProfileTable:
    """The default channel of a file that SurfaceTopography knows, or another; a table of xlsx.
    Raises ProfileError where the library is absent, does not know the file, or fails on it."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "heights.npz"
        source = path
        with path.open("rb") as file:
            packed = file.read(len(GZIP)) == GZIP
        if packed:
            source = Path(folder) / path.stem
            source.write_bytes(contents(path, MAX_BYTES))
        check_unpacked(source)
        answer = _ask(source, target, channel)
        if "absent" in answer:
            raise AbsentReaderError(
                path,
                "is no text, and files of instruments are read by SurfaceTopography, which is "
                f"not installed ({answer['absent']}); to install it: {install_command()}",
            )
        if "problem" in answer:
            raise ProfileError(path, answer["problem"])
        with np.load(target) as arrays:
            if "table" in arrays.files:
                return _table(path, arrays["table"], int(arrays["first"]), answer)
            heights = arrays["heights"]
            x = arrays["x"] if "x" in arrays.files else None
    if heights.size == 0:
        raise ProfileError(path, "holds no heights")
    if answer["unit"] is None and answer["unit_name"]:
        name = shown(answer["unit_name"])
        raise ProfileError(path, f"counts in {name}, which is no length; a profile has heights")
    unit = answer["unit"]
    factor = 1.0 if unit is None else unit
    pitch = answer["pitch"]
    return Topography(
        path=path,
        heights=heights * factor,
        pitch=None if pitch is None else (pitch[0] * factor, pitch[1] * factor),
        x=None if x is None else x * factor,
        unit=unit,
        format=f"{answer['format']}, by SurfaceTopography {answer['version']}",
        channels=tuple(answer.get("channels", ())),
        channel=answer.get("channel"),
    )


def _table(path: Path, numbers: np.ndarray, first: int, answer: dict) -> ProfileTable:
    """The rows of a spreadsheet, of which row `first` is the first."""
    return ProfileTable(
        path=path,
        numbers=numbers,
        text=range(len(numbers)),
        lines=np.arange(first, first + len(numbers)),
        names=tuple(answer["names"]) if all(answer["names"]) else (),
        head=tuple(answer["head"]),
        format=answer["format"],
    )


def _ask(path: Path, target: Path, channel: str | None) -> dict:
    """Reply of the worker, {"problem": one line} if it fails; arrays are in `target`."""
    paths = [str(ROOT), *filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep))]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(paths)}
    python = os.environ.get(OTHER_PYTHON) or sys.executable
    if python != sys.executable:
        del environment["PYTHONPATH"]
    arguments = [str(path.resolve()), str(target), *([] if channel is None else [channel])]
    try:
        said = said_by([python, *WORKER, *arguments], environment)
    except OSError as error:
        return {"problem": f"{OTHER_PYTHON} is {python}, which cannot be run ({error.strerror})"}
    except ReaderError as error:
        verb = "" if str(error).startswith(("crashes", "has not")) else "crashes on it: "
        return {"problem": f"SurfaceTopography {verb}{error}"}
    return json.loads(said.splitlines()[-1])
