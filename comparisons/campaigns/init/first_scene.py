"""From a measured profile to a scene file that `crosscheck run` takes as it is."""

import os
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from analytic.contact.problem import ContactError
from comparisons.campaigns.init.guess import ProfileFields, fields_of_profile
from comparisons.campaigns.init.picture import picture
from comparisons.campaigns.init.scene_text import scene_text, toml, value_of
from comparisons.common.errors import InputError, SceneError
from comparisons.common.files import write_whole
from comparisons.models.problem import Problem, problem_of
from comparisons.scenes.fields import field_type
from comparisons.scenes.scene import Origin, Scene, sections_of
from comparisons.scenes.surface import SceneSurface

# Options of `crosscheck init` by the fields that they are, both bodies' for moduli; others are
# fields of [profile] by the same name.
FIELDS = {
    "radius": (("roller", "radius"),),
    "load": (("load", "per_length"),),
    "peak_pressure": (("load", "hertz_peak_pressure"),),
    "friction": (("load", "friction"),),
    "youngs_modulus": (("roller", "youngs_modulus"), ("body", "youngs_modulus")),
    "poissons_ratio": (("roller", "poissons_ratio"), ("body", "poissons_ratio")),
    "hardness": (("body", "hardness"),),
}
EXCLUSIVE = (("x_unit", "spacing"), ("row", "column"), ("load", "peak_pressure"))
Sections = dict[str, dict[str, str]]


def given_sections(options: Mapping[str, str | int | None]) -> Sections:
    """Fields as TOML by section; raises InputError for an option that is wrong."""
    found: Sections = {}
    given = {name: value for name, value in options.items() if value is not None}
    kinds = sections_of(Scene)
    for name, value in given.items():
        if name in FIELDS:
            value = _number(value)
        elif name == "columns":
            value = [int(w) if w.isdecimal() else w for w in map(str.strip, value.split(","))]
        for section, field in FIELDS.get(name, (("profile", name),)):
            try:
                field_type(kinds[section], field).read(value)
            except ValueError as error:
                raise InputError(f"{_option(name)}: {error}") from error
            found.setdefault(section, {})[field] = toml(value)
    for first, second in EXCLUSIVE:
        if first in given and second in given:
            message = f"is given beside {_option(first)}; allowed is one of them"
            raise InputError(f"{_option(second)}: {message}")
    return found


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _number(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


STEEL = {"youngs_modulus": '"210 GPa"', "poissons_ratio": "0.3"}
# Of the roller, largest first: the contact must stay on the trace.
RADII = (
    "10 mm", "5 mm", "2 mm", "1 mm", "500 um", "200 um", "100 um", "50 um", "20 um", "10 um",
    "5 um", "2 um", "1 um", "500 nm", "200 nm", "100 nm", "50 nm", "20 nm", "10 nm"
)  # fmt: skip
PEAK = '"1 GPa"'


@dataclass(frozen=True)
class FirstScene:
    """A scene file that was written, what it says, how its profile is read, a picture."""

    path: Path
    picture: Path | None
    scene: Scene
    surface: SceneSurface
    profile: ProfileFields

    def as_dict(self) -> dict:
        """For JSON, SI units."""
        info = self.surface.info
        trace = ("source", "format", "place", "samples", "length", "spacing", "bridged", "trimmed")
        plain = info.as_dict()
        return {
            "scene": str(self.path),
            "picture": None if self.picture is None else str(self.picture),
            "profile": {name: plain[name] for name in (*trace, "form")},
            "fields": {name: value_of(text) for name, text in self.profile.fields.items()},
            "guesses": self.profile.reasons,
            "surface": info.surface(),
            "roller_radius": self.scene.roller.radius,
        }


def write_first_scene(
    profile: Path,
    out: Path | None = None,
    sections: Sections | None = None,
    force: bool = False,
    draw: bool = False,
) -> FirstScene:
    """Write a commented scene for the profile in a file.

    out     the scene's file; by default beside the profile, with the suffix .toml
    sections  fields as TOML, of [profile] not to be guessed, of others in place of the examples
    force   replace the scene's file, and the picture's
    draw    a picture of the trace beside the scene, as SVG
    Raises InputError, and writes nothing, where profile or place for the scene cannot be used."""
    out = profile.with_suffix(".toml") if out is None else out
    drawn = out.with_suffix(".svg") if draw else None
    _check_place(profile, out, force)
    if drawn is not None:
        _check_place(profile, drawn, force)
    others = dict(sections or {})
    found = fields_of_profile(profile, others.pop("profile", {}))
    text, problem = _fitting(profile, out, found, others)
    write_whole(out, text)
    if drawn is not None:
        write_whole(drawn, picture(problem.surface))
    return FirstScene(out, drawn, problem.scene, problem.surface, found)


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
    profile: Path, out: Path, found: ProfileFields, sections: Sections
) -> tuple[str, Problem]:
    """The scene with the given roller, or the largest whose contact stays on the trace."""
    refusal = None
    given = sections.get("roller", {}).get("radius")
    for radius in RADII if given is None else (value_of(given),):
        text = _text(profile, out, found, toml(radius), sections)
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


def _text(profile: Path, out: Path, found: ProfileFields, radius: str, sections: Sections) -> str:
    loaded = sections.get("load", {})
    load = {} if "per_length" in loaded else {"hertz_peak_pressure": PEAK}
    values = {
        "roller": {"radius": radius, **STEEL},
        "body": STEEL,
        "profile": {"file": toml(os.path.relpath(profile, out.parent)), **found.fields},
        "load": {**load, "friction": "[0.0, 0.1]"},
        "stress": {"depth": "1.0", "half_range": "1.5", "points": "[300, 100]"},
        "tolerance": dict.fromkeys(("peak_pressure", "contact_length", "tau1_max"), "0.02"),
    }
    example = "an example: put in yours"
    notes = {
        "roller": {} if "radius" in sections.get("roller", {}) else {"radius": example},
        "load": {} if load.keys() <= loaded.keys() else {"hertz_peak_pressure": example},
        "profile": found.reasons,
    }
    values |= {name: values[name] | fields for name, fields in sections.items()}
    return scene_text(f"{profile.stem} under a smooth roller", values, notes)
