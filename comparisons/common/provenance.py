"""What a result was made with: versions, machine, hashes; and how such records are written."""

import hashlib
import json
import os
import platform
from importlib import metadata

import numpy as np

PACKAGES = (
    "crosscheck",
    "numpy",
    "scipy",
    "fenics-dolfinx",
    "petsc4py",
    "gmsh",
    "meshio",
    "pyvista",
    "pydantic",
    "pint",
    "matplotlib",
)


def versions() -> dict[str, str | None]:
    """Version of Python and of every package that shapes a figure; None where it is absent."""
    found: dict[str, str | None] = {"python": platform.python_version()}
    for name in PACKAGES:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            found[name] = None
    return found


def machine() -> dict[str, str | int | None]:
    """What the run's times depend on."""
    return {
        "system": platform.system(),
        "release": platform.release(),
        "architecture": platform.machine(),
        "processor": _processor(),
        "cores": os.cpu_count(),
        "threads": int(os.environ.get("OMP_NUM_THREADS", "0")) or None,
    }


def _processor() -> str | None:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            names = [
                line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")
            ]
    except OSError:
        return platform.processor() or None
    return names[0] if names else platform.processor() or None


def digest(*arrays: np.ndarray) -> str:
    """SHA-256 of the bytes of arrays, in order."""
    total = hashlib.sha256()
    for array in arrays:
        total.update(np.ascontiguousarray(array).tobytes())
    return total.hexdigest()


def as_json(content: dict) -> str:
    """JSON text; raises ValueError for numbers that JSON does not have."""
    return json.dumps(content, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
