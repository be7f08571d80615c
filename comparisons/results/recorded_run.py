"""The record and the figures in a run's folder, checked.

Everything comes from the folder itself. A profile's file may have changed or gone.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path

import numpy as np

from analytic.profile import Profile
from analytic.surface.readers.files import MeasuredProfile
from comparisons.common.errors import InputError
from comparisons.common.provenance import digest
from comparisons.common.quantities import MODELS
from comparisons.results.changes import check_figures
from comparisons.results.record import SCHEMA
from comparisons.results.result_json import SCHEMA as RESULT_SCHEMA
from comparisons.scenes.profile import KnownTrace
from comparisons.scenes.resolve import resolve_tables
from comparisons.scenes.scene import Resolution, ResolvedScene

_IN_WORDS = {dict: "a table", list: "a list", str: "text", int: "a whole number"}


@dataclass(frozen=True)
class Record:
    """A recorded run.

    scene    as resolved, with as many levels as the run and its error budget had and no end to
             its time
    models   of half_plane, finite_element
    levels   of each model
    figures  the content of result.json
    """

    scene: ResolvedScene
    models: tuple[str, ...]
    levels: int
    figures: dict
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
    figures_path = folder / "result.json"
    figures = read_table(figures_path)
    check_schema(figures_path, figures, RESULT_SCHEMA)
    try:
        check_figures(figures)
    except ValueError as error:
        raise InputError(f"{figures_path}: {error}; allowed is what a run wrote") from None
    models = _part(path, content, "models", list)
    if not models or any(name not in MODELS for name in models):
        raise InputError(f"{path}: models: is {models!r}; allowed are {', '.join(MODELS)}")
    levels = _part(path, content, "levels", int)
    if levels < 1:
        raise InputError(f"{path}: levels: is {levels}; allowed is 1 or more")
    return Record(
        scene=_scene(path, content, levels, figures),
        models=tuple(name for name in MODELS if name in models),
        levels=levels,
        figures=figures,
        **{name: _part(path, content, name, dict) for name in ("versions", "machine", "hashes")},
    )


def _scene(path: Path, content: dict, levels: int, figures: dict) -> ResolvedScene:
    tables, name = _part(path, content, "scene", dict), _part(path, content, "name", str)
    trace = None
    if tables.get("profile") is not None:
        trace = _trace(path, _part(path, content, "profile", dict))
    folder, source = path.parent, str(path)
    scene = resolve_tables(tables, name=name, folder=folder, source=source, trace=trace)
    effects = figures.get("error_budget") or {}
    return replace(
        scene,
        resolution=Resolution(scene.resolution.pitch, levels, most=levels),
        budget=replace(scene.budget, time=inf, levels=effects.get("levels")),
    )


def _trace(path: Path, profile: dict) -> KnownTrace:
    """The recorded trace, if it is still what was recorded."""
    trace = _part(path, profile, "trace", dict, "profile.")
    where = f"{path}: profile.trace"
    try:
        x, height = (np.array(trace[name], dtype=float) for name in ("x", "height"))
        samples = Profile(x, height)
        read = MeasuredProfile(
            samples, trace["format"], trace["place"], int(trace["bridged"]), int(trace["trimmed"])
        )
        same = digest(x, height) == trace["sha256"]
        wrong = "" if same else ": has another SHA-256 than recorded"
    except KeyError as error:
        wrong = f".{error.args[0]}: is missing"
    except (TypeError, ValueError, OverflowError) as error:
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
        given = f"is {schema}, of {age} crosscheck"
        raise InputError(f"{path}: schema: {given}; allowed is {known}{remedy}")


def _part(path: Path, content: Mapping, name: str, kind: type, within: str = "") -> object:
    """A named part of a table, of the kind that a run writes."""
    found = content.get(name)
    if isinstance(found, kind) and not isinstance(found, bool):
        return found
    state = "is missing" if found is None else f"is {type(found).__name__}"
    raise InputError(f"{path}: {within}{name}: {state}; allowed is {_IN_WORDS[kind]}")
