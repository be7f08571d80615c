"""Versions, machine and hashes that a result was made with, and how such records are written."""

import hashlib
import json
import os
import platform
import subprocess
from contextlib import suppress
from datetime import UTC, datetime
from functools import cache
from importlib import metadata
from pathlib import Path

import numpy as np

from comparisons.common.numbers import is_whole

PROJECT = Path(__file__).resolve().parents[2]
# Folders and files whose code shapes a level of a scene.
LEVEL_CODE = ("analytic", "meshes", "fem", "comparisons/scenes", "comparisons/models")
# What shapes figures, beside it.
JUDGING_CODE = ("comparisons/figures", "comparisons/judging", "comparisons/studies")
PACKAGES = ("crosscheck", "numpy", "scipy", "fenics-dolfinx", "petsc4py", "gmsh", "meshio")
PACKAGES += ("pyvista", "pydantic", "pint", "matplotlib")
OTHER_NAMES = {"fenics-dolfinx": "dolfinx-solver-real"}  # of a wheel
_version = cache(metadata.version)


def versions() -> dict[str, str | None]:
    """Version of Python and of every package that shapes a figure; None where it is absent."""
    numbers: dict[str, str | None] = {"python": platform.python_version()}
    for name in PACKAGES:
        numbers[name] = None
        for distribution in (OTHER_NAMES.get(name, name), name):
            with suppress(metadata.PackageNotFoundError):
                numbers[name] = _version(distribution)
    return numbers


def made() -> dict[str, str | None]:
    """When, where and by which revision of this checkout; None for what is not known."""
    now = datetime.now(UTC).isoformat(sep=" ", timespec="seconds")
    return {"date": now, "host": platform.node() or None, "revision": revision()}


@cache
def revision() -> str | None:
    """Commit of this code's checkout, `+changes` where files differ; None without one, or git."""
    if not (PROJECT / ".git").exists():
        return None
    git = ("git", "-C", str(PROJECT), "describe", "--always", "--exclude=*", "--dirty=+changes")
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    how = {"env": environment | {"GIT_OPTIONAL_LOCKS": "0"}, "text": True, "timeout": 20.0}
    with suppress(OSError, subprocess.SubprocessError):
        return subprocess.run(git, capture_output=True, check=True, **how).stdout.strip() or None
    return None


def machine() -> dict[str, str | int | None]:
    """Properties of the machine that a run's times depend on; threads are OpenMP's of the outermost
    level, None where OMP_NUM_THREADS says nothing legal."""
    threads = os.environ.get("OMP_NUM_THREADS", "").split(",")[0].strip()
    return {
        "system": platform.system(),
        "release": platform.release(),
        "architecture": platform.machine(),
        "processor": _processor(),
        "cores": os.cpu_count(),
        "threads": int(threads) or None if is_whole(threads) else None,
    }


def _processor() -> str | None:
    with suppress(OSError), open("/proc/cpuinfo", encoding="utf-8") as lines:
        for line in lines:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or None


@cache
def program_code(*places: str) -> str:
    """Hash of the code in folders and files of the project, its C and tables in TOML among it."""
    total = hashlib.sha256()
    for place in places:
        path = PROJECT / place
        kinds = ("*.py", "*.toml", "*.c") if path.is_dir() else ()
        sources = [source for kind in kinds for source in path.rglob(kind)] or [path]
        for source in sorted(sources):
            with open(source, "rb", buffering=0) as file:
                total.update(file.read())
    return total.hexdigest()


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
