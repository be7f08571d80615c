"""From a measured profile to a scene file that `crosscheck run` takes as it is."""

import os
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from comparisons.common.errors import InputError, SceneError
from comparisons.common.files import write_whole
from comparisons.models.problem import problem_of
from comparisons.scenes.resolve import resolve_tables
from comparisons.scenes.scene import ResolvedScene
from comparisons.studies.init.look import Look, look
from comparisons.studies.init.scene_text import scene_text, toml

STEEL = {"youngs_modulus": '"210 GPa"', "poissons_ratio": "0.3"}
# Of the roller, largest first: the contact has to stay on the trace.
RADII = ("10 mm", "5 mm", "2 mm", "1 mm", "500 um", "200 um", "100 um", "50 um", "20 um", "10 um")
PEAK = '"1 GPa"'


@dataclass(frozen=True)
class Begun:
    """A scene file that was written, what it says, and how its profile was read."""

    path: Path
    scene: ResolvedScene
    look: Look

    def as_dict(self) -> dict:
        """For JSON, SI units."""
        info = self.scene.profile_info
        trace = ("source", "format", "place", "samples", "length", "spacing", "bridged", "trimmed")
        plain = info.as_dict()
        return {
            "scene": str(self.path),
            "profile": {name: plain[name] for name in (*trace, "form")},
            "fields": {name: _value(text) for name, text in self.look.fields.items()},
            "guesses": self.look.guesses,
            "surface": info.surface(),
            "roller_radius": self.scene.roller_radius,
        }


def begin(
    profile: Path, out: Path | None = None, asked: Mapping[str, str] | None = None,
    force: bool = False,
) -> Begun:  # fmt: skip
    """Write a commented scene for the profile in a file.

    out     the scene's file, beside the profile and called as it by default
    asked   fields of [profile] as TOML that are not to be guessed
    force   replace the scene's file
    Raises InputError, one line, and writes nothing, where the profile or the place for the scene
    cannot be used.
    """
    out = profile.with_suffix(".toml") if out is None else out
    _check_place(profile, out, force)
    found = look(profile, asked or {})
    text, scene = _fitting(profile, out, found)
    write_whole(out, text)
    return Begun(out, scene, found)


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


def _fitting(profile: Path, out: Path, found: Look) -> tuple[str, ResolvedScene]:
    """The scene with the largest roller whose contact stays on the trace."""
    refusal = None
    for radius in RADII:
        text = _text(profile, out, found, radius)
        try:
            scene = resolve_tables(
                tomllib.loads(text), name=out.stem, folder=out.parent, source=str(out)
            )
            problem_of(scene)
            return text, scene
        except SceneError as error:
            refusal = error
            if ": load: " not in str(error):
                break
    raise InputError(str(refusal).replace(str(out), str(profile), 1))


def _text(profile: Path, out: Path, found: Look, radius: str) -> str:
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
        "profile": found.guesses,
    }
    return scene_text(f"{profile.stem} under a smooth roller", values, notes)


def _value(text: str) -> object:
    return tomllib.loads(f"value = {text}")["value"]
