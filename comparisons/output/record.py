"""What a run must remember to be repeated: the scene, its profile, versions, machine, hashes."""

import sys

from analytic.profile import Profile
from comparisons.common.errors import one_line
from comparisons.common.provenance import digest, machine, made, versions
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.scenes.surface import ProfileInfo

SCHEMA = 2  # of record.json; 1 had neither the trace as read nor the number of levels


def record_of(problem: Problem, runs: dict[str, ModelRun], hashes: dict[str, str]) -> dict:
    """record.json: everything that a repetition needs, the profile's samples included.
    Those of `profile` are as pressed, before any running-in; those of its `trace` as read or made.
    A repetition starts from the trace and takes off form and waves, and runs in, itself."""
    scene, surface, tables = problem.scene, problem.surface, problem.tables
    profile = surface.as_measured
    return {
        "schema": SCHEMA,
        "name": scene.name,
        "scene": tables,
        "profile": None if profile is None else _profile(profile, surface.info),
        "models": list(runs),
        "levels": max(len(run.levels) for run in runs.values()),
        "made": made(),
        "versions": versions(),
        "machine": machine(),
        "seed": (tables.get("profile") or {}).get("seed"),
        "hashes": hashes,
        "command": one_line(" ".join(sys.argv[1:])) or None,
    }


def _profile(pressed: Profile, info: ProfileInfo) -> dict:
    names = ("format", "place", "bridged", "trimmed", "stretch")
    how = {name: getattr(info, name) for name in names}
    trace = _samples(info.trace) | how
    return _samples(pressed) | {"file_sha256": info.sha256, "trace": trace}


def _samples(profile: Profile) -> dict:
    x, height = profile.x, profile.height
    return {"x": x.tolist(), "height": height.tolist(), "sha256": digest(x, height)}
