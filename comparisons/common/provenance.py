"""What a result was made with: versions, machine, hashes; and how such records are written."""

import hashlib
import json
import marshal
import os
import platform
import subprocess
import sys
import time
from contextlib import suppress
from datetime import UTC, datetime
from functools import cache
from importlib import metadata
from importlib.util import cache_from_source
from pathlib import Path
from types import CodeType

import numpy as np

from comparisons.common.files import write_whole

PROJECT = Path(__file__).resolve().parents[2]
# Folders and files whose code shapes a level of a scene.
LEVEL_CODE = ("analytic", "meshes", "fem", "comparisons/scenes", "comparisons/models")
PACKAGES = ("crosscheck", "numpy", "scipy", "fenics-dolfinx", "petsc4py", "gmsh", "meshio")
PACKAGES += ("pyvista", "pydantic", "pint", "matplotlib")
# Hashes of code stand beside Python's own of this module, and are good for the same sources: those
# of equal time and size. What has just changed may change again at the same time [ns]: not kept.
KNOWN_CODE = Path(cache_from_source(__file__)).with_suffix(".json")
RACY = 2_000_000_000


def versions() -> dict[str, str | None]:
    """Version of Python and of every package that shapes a figure; None where it is absent."""
    found: dict[str, str | None] = {"python": platform.python_version()}
    for name in PACKAGES:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            found[name] = None
    return found


def made() -> dict[str, str | None]:
    """When, where and by which revision of this checkout; None for what is not known."""
    now = datetime.now(UTC).isoformat(sep=" ", timespec="seconds")
    return {"date": now, "host": platform.node() or None, "revision": revision()}


@cache
def revision() -> str | None:
    """Commit of the checkout that this code stands in, with `+changes` where files differ from it;
    None outside of one, or without git."""
    if not (PROJECT / ".git").exists():
        return None
    git = ("git", "-C", str(PROJECT), "describe", "--always", "--exclude=*", "--dirty=+changes")
    own = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    given = {"env": own | {"GIT_OPTIONAL_LOCKS": "0"}, "text": True, "timeout": 20.0}
    with suppress(OSError, subprocess.SubprocessError):
        return subprocess.run(git, capture_output=True, check=True, **given).stdout.strip() or None
    return None


def machine() -> dict[str, str | int | None]:
    """What the run's times depend on."""
    return {
        "system": platform.system(),
        "release": platform.release(),
        "architecture": platform.machine(),
        "processor": _processor(),
        "cores": os.cpu_count(),
        "threads": _threads(),
    }


def _threads() -> int | None:
    """Of the outermost level, as OMP_NUM_THREADS asks for; None where it says nothing legal."""
    first = os.environ.get("OMP_NUM_THREADS", "").split(",")[0].strip()
    return int(first) or None if first.isdecimal() and first.isascii() else None


def _processor() -> str | None:
    with suppress(OSError), open("/proc/cpuinfo", encoding="utf-8") as lines:
        for line in lines:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or None


@cache
def program_code(*places: str) -> str:
    """Hash of the code in folders and files of the project: without comments, docstrings and places
    of lines, which shape no figure."""
    known, found, settled = _known_code(), {}, time.time_ns() - RACY
    for place in places:
        path = PROJECT / place
        for source in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            state = source.stat()
            stamp = [state.st_mtime_ns, state.st_size]
            *before, code = known.get(str(source), [None])
            found[str(source)] = [*stamp, code if before == stamp else _code_of(source)]
    kept = known | {name: each for name, each in found.items() if each[0] < settled}
    if kept != known and not sys.dont_write_bytecode:
        with suppress(OSError):
            write_whole(KNOWN_CODE, json.dumps(kept))
    codes = [code for *_, code in found.values()]
    return hashlib.sha256("".join(codes).encode()).hexdigest()


def _known_code() -> dict[str, list]:
    """By path: time of change [ns], size and hash of the code of sources as they were compiled."""
    with suppress(OSError, ValueError):
        return json.loads(KNOWN_CODE.read_text(encoding="utf-8"))
    return {}


def _code_of(source: Path) -> str:
    code = compile(source.read_bytes(), source.name, "exec", dont_inherit=True, optimize=2)
    # version 2 writes no references, so equal code gives equal bytes
    return hashlib.sha256(marshal.dumps(_without_places(code), 2)).hexdigest()


def _without_places(code: CodeType) -> CodeType:
    """A module's or function's code without the lines that it stands on."""
    constants = tuple(map(_constant, code.co_consts))
    return code.replace(co_consts=constants, co_firstlineno=0, co_linetable=b"")


def _constant(value: object) -> object:
    """As marshal's version 2 takes it: Python 3.14 has slices among the constants."""
    if isinstance(value, CodeType):
        return _without_places(value)
    if isinstance(value, tuple):
        return tuple(map(_constant, value))
    return ("slice", value.start, value.stop, value.step) if isinstance(value, slice) else value


def key_of(*parts: object) -> str:
    """Hash of what cached results depend on, in JSON."""
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def digest(*arrays: np.ndarray) -> str:
    """SHA-256 of the bytes of arrays, in order."""
    total = hashlib.sha256()
    for array in arrays:
        total.update(np.ascontiguousarray(array).tobytes())
    return total.hexdigest()


def as_json(content: dict) -> str:
    """JSON text; raises ValueError for numbers that JSON does not have."""
    return json.dumps(content, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
