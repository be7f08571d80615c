"""From a measured profile to a scene file that `crosscheck run` takes as it is.

The file has every field of a measured profile's scene in it, each explained. Meanings and examples
are those of `fields.toml`; what a field may hold is said by `comparisons.scenes.fields.allowed`, as
in error messages."""

import json
import os
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from textwrap import wrap

from analytic.contact.problem import ContactError
from comparisons.campaigns.init.guess import ProfileFields, fields_of_profile, option_of
from comparisons.campaigns.init.show import FirstScene, picture
from comparisons.common.errors import InputError, SceneError
from comparisons.common.files import write_whole
from comparisons.common.numbers import is_whole
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from comparisons.scenes.fields import allowed, field_type
from comparisons.scenes.files import value_of
from comparisons.scenes.scene import Origin, Scene, sections_of

# Options of `crosscheck init` by the fields that they are, both bodies' for moduli; others are
# fields of [profile] by the same name.
OPTIONS = {
    "radius": (("roller", "radius"),),
    "load": (("load", "per_length"),),
    "peak_pressure": (("load", "hertz_peak_pressure"),),
    "friction": (("load", "friction"),),
    "material": (("roller", "material"), ("body", "material")),
    "youngs_modulus": (("roller", "youngs_modulus"), ("body", "youngs_modulus")),
    "poissons_ratio": (("roller", "poissons_ratio"), ("body", "poissons_ratio")),
    "hardness": (("body", "hardness"),),
}
EXCLUSIVE = (("x_unit", "spacing"), ("row", "column"), ("load", "peak_pressure"))
STEEL = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3}
# Of the roller, largest first: the contact must stay on the trace.
RADII = (
    "10 mm", "5 mm", "2 mm", "1 mm", "500 um", "200 um", "100 um", "50 um", "20 um", "10 um",
    "5 um", "2 um", "1 um", "500 nm", "200 nm", "100 nm", "50 nm", "20 nm", "10 nm"
)  # fmt: skip
PEAK = "1 GPa"
FIELDS = Path(__file__).with_name("fields.toml")
WIDTH = 96
NO_BREAK = "\N{NO-BREAK SPACE}"
HEAD = """\
# A scene for crosscheck, as TOML. Numbers are in SI; text has a unit: "8.2 mm", "207 GPa".
# Lines that start with "#" and a blank explain the line below them; those that start with "#"
# alone are fields that are not used: take the sign away to use them.
"""

Sections = dict[str, dict[str, object]]  # values of fields by section


def sections_of_options(options: Mapping[str, str | int | None]) -> Sections:
    """The fields that options set; raises InputError for an option that is wrong."""
    sections: Sections = {}
    chosen = {name: value for name, value in options.items() if value is not None}
    kinds = sections_of(Scene)
    for name, value in chosen.items():
        if name in OPTIONS and name != "material":
            value = value_of(value)
        elif name == "columns":
            value = [int(w) if is_whole(w) else w for w in map(str.strip, value.split(","))]
        for section, field in OPTIONS.get(name, (("profile", name),)):
            try:
                field_type(kinds[section], field).read(value)
            except ValueError as error:
                raise InputError(f"{option_of(name)}: {error}") from error
            sections.setdefault(section, {})[field] = value
    for first, second in EXCLUSIVE:
        if first in chosen and second in chosen:
            message = f"is given beside {option_of(first)}; allowed is one of them"
            raise InputError(f"{option_of(second)}: {message}")
    return sections


def write_first_scene(
    profile: Path,
    out: Path | None = None,
    sections: Sections | None = None,
    force: bool = False,
    draw: bool = False,
) -> FirstScene:
    """Write a commented scene for the profile in a file.

    out       the scene's file; by default beside the profile, with the suffix .toml
    sections  fields of [profile] not to be guessed, of others in place of the examples
    force     replace the scene's file, and the picture's
    draw      a picture of the trace beside the scene, as SVG
    Raises InputError, and writes nothing, where profile or place for the scene cannot be used."""
    if profile.is_dir():
        raise InputError(f"{profile}: is a directory; a profile is a file")
    out = profile.with_suffix(".toml") if out is None else out
    drawn = out.with_suffix(".svg") if draw else None
    for place in filter(None, (out, drawn)):
        _check_place(profile, place, force)
    others = dict(sections or {})
    fields = fields_of_profile(profile, others.pop("profile", {}))
    text, problem = _fitting(profile, out, fields, others)
    write_whole(out, text)
    if drawn is not None:
        write_whole(drawn, picture(problem.surface))
    return FirstScene(out, drawn, problem.scene, problem.surface, fields)


def _check_place(profile: Path, out: Path, force: bool) -> None:
    if os.path.lexists(out):
        if out.is_dir():
            raise InputError(f"{out}: is a folder; allowed is --out FILE.toml")
        if profile.exists() and out.samefile(profile):
            raise InputError(f"{out}: is the profile itself; allowed is another --out")
        if not force:
            raise InputError(f"{out}: is there already; allowed is --force, or another --out")
    if not out.parent.is_dir():
        raise InputError(f"{out}: {out.parent} is no folder; allowed is one that is there")


def _fitting(
    profile: Path, out: Path, fields: ProfileFields, sections: Sections
) -> tuple[str, Problem]:
    """The scene with the roller that is asked for, or the largest whose contact stays on the
    trace."""
    refusal, asked = None, sections.get("roller", {}).get("radius")
    for radius in RADII if asked is None else (asked,):
        text = _text(profile, out, fields, radius, sections)
        try:
            scene = Scene.of(tomllib.loads(text), Origin(out.stem, out.parent, str(out)))
            return text, problem_of(scene)
        except ContactError as error:
            refusal = SceneError(f"{out}: {error}")
        except SceneError as error:
            refusal = error
            if ": load: " not in str(error):
                break
    raise InputError(str(refusal).replace(str(out), str(profile), 1))


def _text(
    profile: Path, out: Path, fields: ProfileFields, radius: object, sections: Sections
) -> str:
    load = sections.get("load", {})
    example_load = {} if "per_length" in load else {"hertz_peak_pressure": PEAK}
    moduli = {} if "material" in sections.get("body", {}) else STEEL
    values = {
        "roller": {"radius": radius, **moduli},
        "body": moduli,
        "profile": {"file": os.path.relpath(profile, out.parent), **fields.fields},
        "load": {**example_load, "friction": [0.0, 0.1]},
        "stress": {"depth": 1.0, "points": [300, 100]},
        "tolerance": dict.fromkeys(("peak_pressure", "contact_length", "tau1_max"), 0.02),
    }
    example = "an example: put in yours"
    notes = {
        "roller": {} if "radius" in sections.get("roller", {}) else {"radius": example},
        "load": {} if example_load.keys() <= load.keys() else {"hertz_peak_pressure": example},
        "profile": fields.reasons,
    }
    values |= {name: values[name] | others for name, others in sections.items()}
    return scene_text(f"{profile.stem} under a smooth roller", values, notes)


def scene_text(
    title: str,
    values: Mapping[str, Mapping[str, object]],
    notes: Mapping[str, Mapping[str, str]],
) -> str:
    """The text of a scene file.

    values  by section and field: what it is set to; other fields stand there unused
    notes   by section and field: a remark"""
    sections, kinds = tomllib.loads(FIELDS.read_text(encoding="utf-8")), sections_of(Scene)
    heading = f"{sections.pop('title')}; allowed is {allowed(Scene, 'title')}"
    lines = [HEAD, *_comment(heading), f"title = {_toml(title)}"]
    for section, fields in sections.items():
        used = values.get(section, {})
        lines += ["", *_comment(fields.pop("section")), f"{'' if used else '#'}[{section}]"]
        for name, (meaning, example) in fields.items():
            said = f"{meaning}; allowed is {allowed(kinds[section], name)}"
            note = notes.get(section, {}).get(name)
            lines += _comment(f"{said} ({note})" if note else said)
            lines.append(
                f"{name} = {_toml(used[name])}" if name in used else f"#{name} = {example}"
            )
    return "\n".join(lines) + "\n"


def _toml(value: object) -> str:
    """Text, numbers, truths and lists of them as TOML."""
    return json.dumps(value, ensure_ascii=False)


def _comment(text: str) -> list[str]:
    whole = re.sub(r'"[^"]*"', lambda quoted: quoted[0].replace(" ", NO_BREAK), text)
    lines = wrap(whole, WIDTH, break_long_words=False, break_on_hyphens=False)
    return [f"# {line}".replace(NO_BREAK, " ") for line in lines]
