"""From a scene file to a resolved scene: checked, in SI, with its profile read or made."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path

from pydantic import ValidationError

from analytic.material import Law, Material
from comparisons.common.errors import InputError
from comparisons.common.units import describe
from comparisons.scenes.files import find_scene, name_of, read_toml
from comparisons.scenes.profile import KnownTrace, profile_of, sinusoid_length
from comparisons.scenes.scene import (
    Budget,
    Coated,
    Load,
    Resolution,
    ResolvedScene,
    RoughnessStatistics,
    StressWindow,
    Yielding,
)
from comparisons.scenes.schema.answers import answer_sources
from comparisons.scenes.schema.finite_element import settings_of
from comparisons.scenes.schema.heat import heat_of
from comparisons.scenes.schema.running_in import running_in_of
from comparisons.scenes.schema.scatter import scatter_of
from comparisons.scenes.schema.scene import (
    BodySection,
    CoatingSection,
    ElasticSection,
    RollerSection,
    SceneFile,
    plain_tables,
    scene_error,
)

LOAD_KINDS = {"per_length": "load_per_length"}  # the others are called as in the file


def load_scene(name_or_path: str | os.PathLike, answers: Sequence[str] = ()) -> ResolvedScene:
    """The scene in a file, or of a name that comes with the project.

    answers  from outside, NAME=FILE each, beside those of the file
    Raises SceneError, one line, for anything that is wrong with the file, with what it says, or
    with the profile that it names."""
    path = find_scene(name_or_path)
    name = name_of(path)
    source = os.fspath(name_or_path)  # as it was asked for: that is how to ask for it again
    tables = read_toml(path)
    if answers:
        tables |= {"answers": answers_named(answers, tables.get("answers"))}
    return resolve_tables(tables, name=name, folder=path.parent, source=source)


def answers_named(given: Sequence[str], known: object) -> dict:
    """The tables [answers.NAME] of answers given as NAME=FILE.
    A FILE takes the place of those that the `known` tables have under its name; of several each
    is a resolution. A FILE.toml holds the table itself, with files from its own folder. Raises
    InputError for what is neither."""
    found = dict(known) if isinstance(known, dict) else {}
    named: dict[str, list] = {}
    for text in given:
        name, _, file = text.partition("=")
        if not (name and file):
            raise InputError(f"--answer: is {describe(text)}; allowed is NAME=FILE")
        path = Path(file).absolute()
        files = [os.fspath(path)]
        if path.suffix == ".toml":
            found[name] = read_toml(path)
            files = found[name].get("file", [])
            files = [files] if isinstance(files, str) else files
            files = [os.fspath(path.parent / each) for each in map(str, files)]
        named.setdefault(name, []).extend(files)
        found[name] = dict(found.get(name) or {}) | {"file": named[name]}
    return found


def resolve_tables(
    tables: Mapping, *, name: str, folder: Path, source: str, trace: KnownTrace | None = None
) -> ResolvedScene:
    """The scene that `tables`, as TOML has them, describe.

    folder  that the profile's path starts from
    source  what messages call the scene
    trace   to take in place of the profile's file
    Raises SceneError as `load_scene` does."""
    try:
        scene = SceneFile.model_validate(tables)
    except ValidationError as error:
        raise scene_error(error, source) from error
    body, coating, flow = _material(scene.body), scene.coating, scene.body.yield_stress
    roller = None if scene.roller.rigid else _material(scene.roller)
    kind = scene.load.kind
    load = Load(LOAD_KINDS.get(kind, kind), getattr(scene.load, kind))
    plain = plain_tables(scene)
    if scene.body.thickness is not None:
        plain["body"].setdefault("base", "bonded")
    ratios = [table.poissons_ratio for table in (scene.roller, scene.body, scene.coating) if table]
    largest = max(ratio for ratio in ratios if ratio is not None)
    settings = settings_of(scene.finite_element, scene.load, largest)
    plain["finite_element"] = asdict(settings)
    profile = info = None
    position = scene.load.position or 0.0
    if scene.profile is not None:
        if scene.profile.kind == "sinusoid":
            length = sinusoid_length(scene.profile, load, scene.roller.radius, roller, body)
            if scene.running_in is not None:
                length += scene.running_in.travel(position)
            plain["profile"].setdefault("length", length)
        profile, info, position = profile_of(
            plain["profile"], scene.load.position, folder=folder, source=source, known=trace
        )
        if info.cutoff is not None:
            plain["profile"]["cutoff"] = info.cutoff  # of "auto", what it came to
    plain["load"]["position"] = position
    running_in = None
    if scene.running_in is not None:
        running_in, defaults = running_in_of(
            scene.running_in, scene.body.hardness, position, profile, source
        )
        plain["running_in"] |= defaults
    return ResolvedScene(
        name=name,
        source=source,
        title=scene.title or name,
        roller_radius=scene.roller.radius,
        roller=roller,
        body=body,
        hardness=scene.body.hardness,
        yielding=flow and Yielding(flow, scene.body.hardening_modulus or 0.0),
        coating=None if coating is None else Coated(_material(coating), coating.thickness),
        thickness=scene.body.thickness,
        width=scene.body.width,
        base=plain["body"].get("base"),
        profile=profile,
        profile_info=info,
        load=load,
        running_in=running_in,
        friction=scene.load.friction,
        coupled=scene.load.coupled,
        position=position,
        stress=None if scene.stress is None else StressWindow(**dict(scene.stress)),
        tolerance={name: value for name, value in scene.tolerance if value is not None},
        finite_element=settings,
        resolution=Resolution(**dict(scene.resolution)),
        budget=Budget(**dict(scene.budget)),
        tables=plain,
        scatter=scene.scatter and scatter_of(scene.scatter),
        statistics=scene.statistics and RoughnessStatistics(**dict(scene.statistics)),
        answers=answer_sources(scene.answers, folder),
        heat=scene.heat and heat_of(scene.heat, scene.roller.radius),
    )


def _material(table: BodySection | CoatingSection | RollerSection) -> Material:
    law = Law()
    if isinstance(table, ElasticSection) and table.law is not None:
        law = Law(table.law, table.murnaghan and tuple(table.murnaghan.values()))
    return Material(table.youngs_modulus, table.poissons_ratio, law)


def with_tolerance(
    scene: ResolvedScene, tolerance: float, source: str = "tolerance"
) -> ResolvedScene:
    """The scene with one relative tolerance for all that it judges.
    Raises InputError, which calls it by its `source`, unless it is above 0 and below 1."""
    is_number = isinstance(tolerance, int | float) and not isinstance(tolerance, bool)
    if not (is_number and 0.0 < tolerance < 1.0):
        given = f"{tolerance:g}" if is_number else describe(tolerance)
        raise InputError(f"{source}: is {given}; allowed is a number above 0 and below 1")
    judged_by = dict.fromkeys(scene.tolerance, tolerance)
    return replace(scene, tolerance=judged_by, tables=scene.tables | {"tolerance": dict(judged_by)})
