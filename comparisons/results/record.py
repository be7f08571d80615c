"""What a run must remember to be repeated: the scene, its profile, versions, machine, hashes."""

import sys

from comparisons.common.provenance import digest, machine, versions
from comparisons.models.level import ModelRun
from comparisons.scenes.scene import ProfileInfo, ResolvedScene

SCHEMA = 2  # of record.json; 1 had neither the trace as read nor the number of levels


def record_of(scene: ResolvedScene, runs: dict[str, ModelRun], hashes: dict[str, str]) -> dict:
    """record.json: everything that a repetition needs, the profile's samples included.

    Those of `profile` are as pressed, before any running-in; those of its `trace` as read or made.
    A repetition starts from the trace and takes off form and waves, and runs in, itself.
    """
    profile = scene.as_measured
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
