"""What a run must remember to be repeated: scene, profile, versions, machine, hashes; and back.

Everything is read from the run's folder itself, checked: a profile's file may have changed or
gone."""

import json
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analytic.profile import Profile
from analytic.surface.readers.files import MeasuredProfile
from comparisons.common.errors import InputError, one_line
from comparisons.common.provenance import digest, machine, made, versions
from comparisons.figures.quantity import MODELS
from comparisons.judging.study import MODEL_ERROR
from comparisons.models.level import Solution
from comparisons.models.problem import MOST_LEVELS, Levels, Problem
from comparisons.output import result_json
from comparisons.output.result_json import Result
from comparisons.scenes.scene import Origin, Scene
from comparisons.scenes.surface import KnownTrace, ProfileInfo, SceneSurface, surface_of

SCHEMA = 2  # of record.json; 1 had neither the trace as read nor the number of levels
HOW_READ = ("format", "place", "bridged", "trimmed", "stretch")  # a trace
# What is raised where a file is built otherwise than a run writes it.
BUILT_OTHERWISE = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)


def record_of(problem: Problem, runs: dict[str, Solution], hashes: dict[str, str]) -> dict:
    """record.json: everything that a repetition needs, the profile's samples included.
    Those of `profile` are as pressed, before any running-in; those of its `trace` as read or made.
    A repetition starts from the trace and takes off form and waves, and runs in, itself."""
    scene, surface = problem.scene, problem.surface
    tables, run_in = surface.completed(scene.tables), surface.run_in
    profile = surface.profile if run_in is None else run_in.before
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
    trace = _samples(info.trace) | {name: getattr(info, name) for name in HOW_READ}
    return _samples(pressed) | {"file_sha256": info.sha256, "trace": trace}


def _samples(profile: Profile) -> dict:
    x, height = profile.x, profile.height
    return {"x": x.tolist(), "height": height.tolist(), "sha256": digest(x, height)}


@dataclass(frozen=True)
class Record:
    """A recorded run."""

    scene: Scene
    surface: SceneSurface  # as measured
    models: tuple[str, ...]  # of half_plane, finite_element
    levels: Levels
    result: Result
    versions: dict
    machine: dict
    hashes: dict


def read_record(folder: Path) -> Record:
    """The run recorded in a folder. Raises InputError, one line, where it cannot be repeated."""
    if not folder.is_dir():
        raise InputError(f"{folder}: is no folder; allowed is the folder of a finished run")
    path = folder / "record.json"
    content = read_table(path)
    check_schema(path, content, SCHEMA)
    result = read_result(folder / "result.json")
    try:
        if not content["models"]:
            raise ValueError("without a model")
        tables, origin = content["scene"], Origin(one_line(content["name"]), folder, str(path))
        has_trace = tables.get("profile") is not None
        trace = _trace(path, content["profile"]) if has_trace else None
        scene = Scene.of(tables, origin)
        return Record(
            scene=scene,
            surface=surface_of(scene, trace),
            models=tuple(sorted(content["models"], key=MODELS.index)),
            levels=_levels(path, content["levels"], result),
            result=result,
            **{name: dict(content[name]) for name in ("versions", "machine", "hashes")},
        )
    except InputError:
        raise
    except BUILT_OTHERWISE as error:
        raise InputError(f"{path}: is no record of a run ({error!r}); allowed is one") from error


def read_result(path: Path) -> Result:
    """What a run's result.json says. Raises InputError, one line, where it is none."""
    content = read_table(path)
    check_schema(path, content, result_json.SCHEMA)
    try:
        return result_json.read_content(content)
    except BUILT_OTHERWISE as error:
        raise InputError(f"{path}: is no result of a run ({error!r}); allowed is one") from error


def _levels(path: Path, levels: int, result: Result) -> Levels:
    """As many as the run and its error budget had."""
    cost = result.findings[MODEL_ERROR].table("cost") if MODEL_ERROR in result.findings else None
    effects = None if cost is None else cost.columns["levels"].values[0]
    result_path = path.with_name("result.json")
    for file, known, least in ((path, levels, 1), (result_path, effects or 0, 0)):
        if not (type(known) is int and least <= known <= MOST_LEVELS):
            allowed = f"allowed is from {least} to {MOST_LEVELS}"
            raise InputError(f"{file}: levels: is {known!r}; {allowed}")
    return Levels(levels, effects)


def _trace(path: Path, profile: dict) -> KnownTrace:
    """The recorded trace, if it is still what was recorded."""
    trace = profile["trace"]
    x, height = (np.array(trace[name], dtype=float) for name in ("x", "height"))
    if digest(x, height) != trace["sha256"]:
        what = "has another SHA-256 than recorded; allowed is what was recorded"
        raise InputError(f"{path}: profile.trace: {what}")
    how = {name: trace[name] for name in HOW_READ}
    how["stretch"] = how["stretch"] and tuple(how["stretch"])
    return KnownTrace(MeasuredProfile(profile=Profile(x, height), **how), profile["file_sha256"])


def read_table(path: Path) -> dict:
    """The table in a file of a run's folder. Raises InputError where there is none."""
    try:
        content = json.loads(path.read_bytes().decode("utf-8"), parse_constant=_no_number)
    except FileNotFoundError:
        raise InputError(
            f"{path.parent}: holds no {path.name}; allowed is the folder of a finished run"
        ) from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}; allowed is a file") from None
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: is not JSON: {error}; allowed is what a run wrote") from None
    if not isinstance(content, dict):
        raise InputError(f"{path}: is no table; allowed is what a run wrote")
    return content


def _no_number(name: str) -> None:
    """Refuse NaN and the infinities, which Python reads, and no run writes."""
    raise ValueError(f"{name} is no number")


def check_schema(path: Path, content: Mapping, known: int) -> None:
    """Raise InputError unless the content of a file is of the schema that is known here."""
    schema = content.get("schema")
    if schema != known:
        is_later = isinstance(schema, int) and schema > known
        age, remedy = ("a later", "") if is_later else ("an earlier", ": run the scene again")
        said = f"is {schema}, of {age} crosscheck"
        raise InputError(f"{path}: schema: {said}; allowed is {known}{remedy}")
