"""What a run must remember to be repeated: the scene, its profile, versions, machine, hashes."""

import hashlib
import json
import os
import platform
import sys
from importlib import metadata

import numpy as np

from comparisons.scene import ResolvedScene

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


def record_of(scene: ResolvedScene, models: tuple[str, ...], hashes: dict[str, str]) -> dict:
    """record.json: everything that a repetition needs, the profile's samples included.

    They are those before any running-in, which a repetition repeats.
    """
    profile = scene.unworn
    return {
        "schema": 1,
        "name": scene.name,
        "scene": scene.tables,
        "profile": None
        if profile is None
        else {
            "x": profile.x.tolist(),
            "height": profile.height.tolist(),
            "sha256": digest(profile.x, profile.height),
            "file_sha256": scene.profile_info.sha256,
        },
        "models": list(models),
        "versions": versions(),
        "machine": machine(),
        "seed": (scene.tables.get("profile") or {}).get("seed"),
        "hashes": hashes,
        "command": " ".join(sys.argv[1:]) or None,
    }


def as_json(content: dict) -> str:
    """JSON text; raises ValueError for numbers that JSON does not have."""
    return json.dumps(content, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
