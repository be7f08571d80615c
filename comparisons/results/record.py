"""What a run must remember to be repeated: the scene, its profile, versions, machine, hashes."""

import hashlib
import json
import os
import platform
import sys
from importlib import metadata

import numpy as np

from comparisons.models.level import ModelRun
from comparisons.scenes.scene import ProfileInfo, ResolvedScene

SCHEMA = 2  # of record.json; 1 had neither the trace as read nor the number of levels
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


def record_of(scene: ResolvedScene, runs: dict[str, ModelRun], hashes: dict[str, str]) -> dict:
    """record.json: everything that a repetition needs, the profile's samples included.

    Those of `profile` are as pressed, before any running-in; those of its `trace` as read or made.
    A repetition starts from the trace and takes off form and waves, and runs in, itself.
    """
    profile = scene.unworn
    return {
        "schema": SCHEMA,
        "name": scene.name,
        "scene": scene.tables,
        "profile": None
        if profile is None
        else {
            "x": profile.x.tolist(),
            "height": profile.height.tolist(),
            "sha256": digest(profile.x, profile.height),
            "file_sha256": scene.profile_info.sha256,
            "trace": _trace(scene.profile_info),
        },
        "models": list(runs),
        "levels": max(len(run.levels) for run in runs.values()),
        "versions": versions(),
        "machine": machine(),
        "seed": (scene.tables.get("profile") or {}).get("seed"),
        "hashes": hashes,
        "command": " ".join(sys.argv[1:]) or None,
    }


def _trace(info: ProfileInfo) -> dict:
    """The trace as read or made, and how it was read."""
    return {
        "x": info.trace.x.tolist(),
        "height": info.trace.height.tolist(),
        "sha256": digest(info.trace.x, info.trace.height),
        "format": info.format,
        "place": info.place,
        "bridged": info.bridged,
        "trimmed": info.trimmed,
    }


def as_json(content: dict) -> str:
    """JSON text; raises ValueError for numbers that JSON does not have."""
    return json.dumps(content, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
