"""Short scene file from a measured profile, which `crosscheck run` takes as it is.

What no trace shows, the roller, the solids and the load, is asked for or stands there as an
example."""

import json
import os
import re
import tomllib
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from analytic.contact.problem import ContactError
from comparisons.campaigns.init.guess import fields_of_profile, option_of
from comparisons.campaigns.init.show import FirstScene, picture
from comparisons.common.errors import InputError, SceneError, one_line
from comparisons.common.files import write_whole
from comparisons.common.numbers import is_whole
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from comparisons.scenes.fields import file_fields
from comparisons.scenes.files import value_of
from comparisons.scenes.scene import Origin, Scene, sections_of
from comparisons.scenes.schema.messages import read_field
from comparisons.scenes.surface import surface_of

# Options of `crosscheck init` by the fields that they are, both bodies' for solids and moduli;
# others are fields of [profile] by the same name.
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
# What no trace shows, by its option: those that stand for it, too, and what is asked.
QUESTIONS = {
    "radius": ((), 'Radius of the roller, such as "8.2 mm"'),
    "load": (("peak_pressure",), 'Load per length, such as "3.85 N/um"'),
    "material": (
        ("youngs_modulus", "poissons_ratio"),
        "Solid of both bodies, by its name in crosscheck materials",
    ),
}
# Of the roller, largest first: the contact must stay on the trace.
RADII = (
    "10 mm", "5 mm", "2 mm", "1 mm", "500 um", "200 um", "100 um", "50 um", "20 um", "10 um",
    "5 um", "2 um", "1 um", "500 nm", "200 nm", "100 nm", "50 nm", "20 nm", "10 nm"
)  # fmt: skip
SOLID = {"material": "rail steel"}  # its law of elasticity was measured
STEEL = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3}  # where one of them is given
PEAK = {"hertz_peak_pressure": "1 GPa"}
EXAMPLE = "an example, put in yours"
HEAD = """\
# A scene for crosscheck. Numbers are in SI units, text carries its unit. All other fields:
# comparisons/docs/scene_fields.md.
"""
JUDGED = {
    "stress": {"depth": 1.0, "points": [300, 100]},
    "tolerance": dict.fromkeys(("peak_pressure", "contact_length", "tau1_max"), 0.02),
}

toml = partial(json.dumps, ensure_ascii=False)  # of text, numbers, truths and lists of them
Options = Mapping[str, str | int | None]
Sections = dict[str, dict[str, object]]  # values of fields by section


def sections_of_options(options: Options) -> Sections:
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
                read_field(kinds[section], field, value)
            except ValueError as error:
                raise InputError(f"{option_of(name)}: {error}") from error
            sections.setdefault(section, {})[field] = value
    return sections


def write_first_scene(
    profile: Path,
    out: Path | None = None,
    options: Options | None = None,
    force: bool = False,
    draw: bool = False,
    ask: Callable[[str], str] | None = None,
) -> FirstScene:
    """Write a scene for the profile in a file.

    out      the scene's file; by default beside the profile, with the suffix .toml
    options  of `crosscheck init` that set fields: in place of guesses and examples
    force    replace the scene's file, and the picture's
    draw     a picture of the trace beside the scene, as SVG
    ask      answers questions about what no trace shows, with nothing for an example
    Raises InputError, and writes nothing, where an option, profile or path for the scene cannot be
    used."""
    options = options or {}
    read_by = sections_of_options(options).get("profile", {})
    if profile.is_dir():
        raise InputError(f"{profile}: is a directory; a profile is a file")
    out = profile.with_suffix(".toml") if out is None else out
    drawn = out.with_suffix(".svg") if draw else None
    for place in filter(None, (out, drawn)):
        _check_place(profile, place, force)
    fields = fields_of_profile(profile, read_by)
    values, examples = _values(sections_of_options(_completed(options, ask) if ask else options))
    values["profile"] = {"file": os.path.relpath(profile, out.parent), **fields.fields}
    text, problem = _fitting(profile, out, values, {**fields.reasons, **examples})
    write_whole(out, text)
    if drawn is not None:
        write_whole(drawn, picture(problem.surface))
    return FirstScene(out, drawn, problem.scene, problem.surface, fields, tuple(examples))


def _completed(options: Options, ask: Callable[[str], str]) -> Options:
    """The options, with what is answered to QUESTIONS; one whose answer is wrong comes again."""
    known = dict(options)
    for name, (others, question) in QUESTIONS.items():
        while all(known.get(option) is None for option in (name, *others)):
            said = ask(f"{question} (Enter: an example): ").strip()
            try:
                sections_of_options({name: said or None})
            except InputError as error:
                question = f"{error}\n{QUESTIONS[name][1]}"
                continue
            if not said:
                break
            known[name] = said
    return known


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


def _values(asked: Sections) -> tuple[Sections, dict[str, str]]:
    """Sections of the scene beside its profile, and remarks by field on what is an example.
    The roller's radius, if it is none of `asked`, is left open."""
    roller, body, load = (dict(asked.get(name, {})) for name in ("roller", "body", "load"))
    examples = {} if "radius" in roller else {"radius": EXAMPLE}
    if "material" not in body:
        is_example = body.keys().isdisjoint(STEEL)
        solid = SOLID if is_example else STEEL
        examples |= {"material": EXAMPLE} if is_example else {}
        roller, body = solid | roller, solid | body
    if load.keys().isdisjoint(("per_length", *PEAK)):
        load, examples = PEAK | load, examples | dict.fromkeys(PEAK, EXAMPLE)
    load.setdefault("friction", [0.0, 0.1])
    return {"roller": roller, "body": body, "profile": {}, "load": load}, examples


def _fitting(
    profile: Path, out: Path, values: Sections, notes: Mapping[str, str]
) -> tuple[str, Problem]:
    """The scene with the roller that is asked for, or the largest whose contact stays on the
    trace."""
    refusal, surface, asked = None, None, values["roller"].get("radius")
    title = one_line(f"{profile.stem} under a smooth roller")
    for radius in RADII if asked is None else (asked,):
        text = scene_text(title, values | {"roller": {"radius": radius} | values["roller"]}, notes)
        try:
            scene = Scene.of(tomllib.loads(text), Origin(out.stem, out.parent, str(out)))
            surface = surface or surface_of(scene)  # whatever the roller
            return text, problem_of(scene, surface)
        except ContactError as error:
            refusal = SceneError(f"{out}: {error}")
        except SceneError as error:
            refusal = error
            if ": load: " not in str(error):
                break
    raise InputError(str(refusal).replace(str(out), str(profile), 1))


def scene_text(
    title: str, values: Mapping[str, Mapping[str, object]], notes: Mapping[str, str]
) -> str:
    """The text of a scene file.

    values  by section and field
    notes   by field: a remark, in place of what the field is; EXAMPLE stands beside that"""
    lines = [HEAD, f"title = {toml(title)}"]
    for section, fields in JUDGED.items():
        shown = ", ".join(f"{name} = {toml(value)}" for name, value in fields.items())
        lines.append(f"{section} = {{{shown}}}")
    for section, fields in values.items():
        described = file_fields(sections_of(Scene)[section])
        lines += ["", f"[{section}]"]
        for name, value in fields.items():
            note, what = notes.get(name), re.split("[:;,]", described[name].description)[0]
            note = f"{what}: {EXAMPLE}" if note == EXAMPLE else note or what
            lines.append(f"{name} = {toml(value)}  # {one_line(note)}")
    return "\n".join(lines) + "\n"
