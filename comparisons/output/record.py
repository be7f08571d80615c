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
from comparisons.models.level import ModelRun
from comparisons.models.problem import MOST_LEVELS, Levels, Problem
from comparisons.output import result_json
from comparisons.output.result_json import Result
from comparisons.scenes.scene import Origin, Scene
from comparisons.scenes.surface import KnownTrace, ProfileInfo, SceneSurface, surface_of
from comparisons.studies.study import MODEL_ERROR

SCHEMA = 2  # of record.json; 1 had neither the trace as read nor the number of levels
_IN_WORDS = {dict: "a table", list: "a list", str: "text", int: "a whole number"}


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
    models = _part(path, content, "models", list)
    if not models or any(name not in MODELS for name in models):
        raise InputError(f"{path}: models: is {models!r}; allowed are {', '.join(MODELS)}")
    scene, surface = _scene(path, content)
    return Record(
        scene=scene,
        surface=surface,
        models=tuple(name for name in MODELS if name in models),
        levels=_levels(path, content, result),
        result=result,
        **{name: _part(path, content, name, dict) for name in ("versions", "machine", "hashes")},
    )


def read_result(path: Path) -> Result:
    """What a run's result.json says. Raises InputError, one line, where it is none."""
    content = read_table(path)
    try:
        check_schema(path, content, result_json.SCHEMA)
        return result_json.read_content(content)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise InputError(f"{path}: is no result of a run ({error!r}); allowed is one") from error


def _scene(path: Path, content: dict) -> tuple[Scene, SceneSurface]:
    tables, name = _part(path, content, "scene", dict), _part(path, content, "name", str)
    name = one_line(name)
    trace = None
    if tables.get("profile") is not None:
        trace = _trace(path, _part(path, content, "profile", dict))
    scene = Scene.of(tables, Origin(name, path.parent, str(path)))
    return scene, surface_of(scene, trace)


def _levels(path: Path, content: dict, result: Result) -> Levels:
    """As many as the run and its error budget had."""
    levels = _part(path, content, "levels", int)
    if not 1 <= levels <= MOST_LEVELS:
        raise InputError(f"{path}: levels: is {levels}; allowed is from 1 to {MOST_LEVELS}")
    cost = result.findings[MODEL_ERROR].table("cost") if MODEL_ERROR in result.findings else None
    effects = None if cost is None else cost.columns["levels"].values[0]
    if effects is not None and not (type(effects) is int and 0 <= effects <= MOST_LEVELS):
        where = f"{path.parent / 'result.json'}: levels of the whole model"
        raise InputError(f"{where}: is {effects!r}; allowed is from 0 to {MOST_LEVELS}")
    return Levels(levels, effects)


def _trace(path: Path, profile: dict) -> KnownTrace:
    """The recorded trace, if it is still what was recorded."""
    trace = _part(path, profile, "trace", dict, "profile.")
    where = f"{path}: profile.trace"
    try:
        x, height = (np.array(trace[name], dtype=float) for name in ("x", "height"))
        samples = Profile(x, height)
        stretch = trace.get("stretch")
        read = MeasuredProfile(
            profile=samples,
            format=trace["format"],
            place=trace["place"],
            bridged=int(trace["bridged"]),
            trimmed=int(trace["trimmed"]),
            stretch=None if stretch is None else (float(stretch[0]), float(stretch[1])),
        )
        same = digest(x, height) == trace["sha256"]
        wrong = "" if same else ": has another SHA-256 than recorded"
    except KeyError as error:
        wrong = f".{error.args[0]}: is missing"
    except (TypeError, ValueError, IndexError, OverflowError) as error:
        wrong = f": {error}"
    if wrong:
        raise InputError(f"{where}{wrong}; allowed is what was recorded")
    return KnownTrace(read, profile.get("file_sha256"))


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
    schema = _part(path, content, "schema", int)
    if schema != known:
        age, remedy = ("a later", "") if schema > known else ("an earlier", ": run the scene again")
        said = f"is {schema}, of {age} crosscheck"
        raise InputError(f"{path}: schema: {said}; allowed is {known}{remedy}")


def _part(path: Path, content: Mapping, name: str, kind: type, within: str = "") -> object:
    """A named part of a table, of the kind that a run writes."""
    value = content.get(name)
    if isinstance(value, kind) and not isinstance(value, bool):
        return value
    state = "is missing" if value is None else f"is {type(value).__name__}"
    raise InputError(f"{path}: {within}{name}: {state}; allowed is {_IN_WORDS[kind]}")
