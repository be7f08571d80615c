"""From a measured profile to a scene file that `crosscheck run` takes as it is."""

import os
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from comparisons.common.errors import InputError, SceneError
from comparisons.common.files import write_whole
from comparisons.common.units import LENGTH
from comparisons.models.problem import problem_of
from comparisons.scenes.resolve import resolve_tables
from comparisons.scenes.scene import ResolvedScene
from comparisons.scenes.schema.fields import Number, Unit, Whole
from comparisons.studies.init.guess import ProfileFields, fields_of_profile
from comparisons.studies.init.scene_text import scene_text, toml

# Options of `crosscheck init` that are fields of [profile].
TYPES = {
    "x_unit": Unit(LENGTH),
    "z_unit": Unit(LENGTH),
    "spacing": Number(LENGTH, above=0.0),
    "row": Whole(0, 2**31),
    "column": Whole(0, 2**31),
}
EXCLUSIVE = (("x_unit", "spacing"), ("row", "column"))


def given_fields(options: Mapping[str, str | int | None]) -> dict[str, str]:
    """Fields of [profile] as TOML from the options; raises InputError for a wrong one."""
    given = {name: value for name, value in options.items() if value is not None}
    for name, value in given.items():
        try:
            TYPES[name].read(value)
        except ValueError as error:
            raise InputError(f"--{name.replace('_', '-')}: {error}") from error
    for first, second in EXCLUSIVE:
        if first in given and second in given:
            raise InputError(
                f"--{second}: is given beside --{first.replace('_', '-')}; allowed is one of them"
            )
    return {name: toml(v) if isinstance(v, str) else str(v) for name, v in given.items()}


STEEL = {"youngs_modulus": '"210 GPa"', "poissons_ratio": "0.3"}
# Of the roller, largest first: the contact must stay on the trace.
RADII = ("10 mm", "5 mm", "2 mm", "1 mm", "500 um", "200 um", "100 um", "50 um", "20 um", "10 um")
PEAK = '"1 GPa"'


@dataclass(frozen=True)
class FirstScene:
    """A scene file that was written, what it resolves to, and how its profile is read."""

    path: Path
    scene: ResolvedScene
    profile: ProfileFields

    def as_dict(self) -> dict:
        """For JSON, SI units."""
        info = self.scene.profile_info
        trace = ("source", "format", "place", "samples", "length", "spacing", "bridged", "trimmed")
        plain = info.as_dict()
        return {
            "scene": str(self.path),
            "profile": {name: plain[name] for name in (*trace, "form")},
            "fields": {name: _value(text) for name, text in self.profile.fields.items()},
            "guesses": self.profile.reasons,
            "surface": info.surface(),
            "roller_radius": self.scene.roller_radius,
        }


def write_first_scene(
    profile: Path,
    out: Path | None = None,
    given: Mapping[str, str] | None = None,
    force: bool = False,
) -> FirstScene:
    """Write a commented scene for the profile in a file.

    out     the scene's file; by default beside the profile, with the suffix .toml
    given   fields of [profile] as TOML that are not to be guessed
    force   replace the scene's file
    Raises InputError, one line, and writes nothing, where the profile or the place for the scene
    cannot be used.
    """
    out = profile.with_suffix(".toml") if out is None else out
    _check_place(profile, out, force)
    found = fields_of_profile(profile, given or {})
    text, scene = _fitting(profile, out, found)
    write_whole(out, text)
    return FirstScene(out, scene, found)


def _check_place(profile: Path, out: Path, force: bool) -> None:
    """Refuse a scene's file that is there already, or has no folder."""
    if os.path.lexists(out):
        if out.is_dir():
            raise InputError(f"{out}: is a folder; allowed is --out FILE.toml")
        if profile.exists() and out.samefile(profile):
            raise InputError(f"{out}: is the profile itself; allowed is another --out")
        if not force:
            raise InputError(f"{out}: is there already; allowed is --force, or another --out")
    if not out.parent.is_dir():
        raise InputError(f"{out}: {out.parent} is no folder; allowed is one that is there")


def _fitting(profile: Path, out: Path, found: ProfileFields) -> tuple[str, ResolvedScene]:
    """The scene with the largest roller whose contact stays on the trace."""
    refusal = None
    for radius in RADII:
        text = _text(profile, out, found, radius)
        try:
            tables = tomllib.loads(text)
            scene = resolve_tables(tables, name=out.stem, folder=out.parent, source=str(out))
            problem_of(scene)
            return text, scene
        except SceneError as error:
            refusal = error
            if ": load: " not in str(error):
                break
    raise InputError(str(refusal).replace(str(out), str(profile), 1))


def _text(profile: Path, out: Path, found: ProfileFields, radius: str) -> str:
    values = {
        "roller": {"radius": toml(radius), **STEEL},
        "body": STEEL,
        "profile": {"file": toml(os.path.relpath(profile, out.parent)), **found.fields},
        "load": {"hertz_peak_pressure": PEAK, "friction": "[0.0, 0.1]"},
        "stress": {"depth": "1.0", "half_range": "1.5", "points": "[300, 100]"},
        "tolerance": dict.fromkeys(("peak_pressure", "contact_length", "tau1_max"), "0.02"),
    }
    notes = {
        "roller": {"radius": "an example: put in yours"},
        "load": {"hertz_peak_pressure": "an example: put in yours"},
        "profile": found.reasons,
    }
    return scene_text(f"{profile.stem} under a smooth roller", values, notes)


def _value(text: str) -> object:
    return tomllib.loads(f"value = {text}")["value"]
