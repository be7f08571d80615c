"""The surface of a scene: its trace read or made, without form, filtered, under the roller.

x along the surface with its origin under the roller's centre, heights positive out of the body
with their zero on the mean line."""

import hashlib
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field, replace
from math import hypot, sqrt
from pathlib import Path

from numpy import diff

from analytic.exact.hertz import HertzContact, hertz_from_load, hertz_from_peak_pressure
from analytic.material import combined_modulus
from analytic.profile import Profile
from analytic.running_in import RunIn
from analytic.surface.filters import check_cutoff, filtered
from analytic.surface.form import RemovedForm, remove_form
from analytic.surface.readers.files import (
    MeasuredProfile,
    MissingUnitError,
    open_measured,
    profile_of,
)
from analytic.surface.readers.text import ProfileTable
from analytic.surface.readers.topography import MapLine
from analytic.surface.roughness import Roughness, roughness
from analytic.surface.roughness_standard import (
    StandardRoughness,
    standard_cutoff,
    standard_roughness,
    standard_short_cutoff,
)
from analytic.surface.synthetic import ground_texture, self_affine, sinusoid
from analytic.surface.turned import turned
from comparisons.common.errors import SceneError
from comparisons.common.numbers import finite
from comparisons.common.provenance import digest
from comparisons.common.units import LENGTH, UnitError, unit_in_si
from comparisons.scenes.fields import plain
from comparisons.scenes.header_units import Guesses, header_units
from comparisons.scenes.profile import AUTOMATIC, COMMON, ProfileSection
from comparisons.scenes.scene import SceneBase
from comparisons.scenes.schema.json_schema import allowed

SINUSOID_REACH = 4.0  # length of a sinusoid over the widest contact, where the scene gives none
SINUSOID_WAVES = 3.0  # and at least so many wavelengths

_MAKERS = {"sinusoid": sinusoid, "self-affine": self_affine}
_MAKERS |= {"ground": ground_texture, "turned": turned}


@dataclass(frozen=True)
class KnownTrace:
    """A trace that is read or made already, and the SHA-256 of its file, None for a made one."""

    read: MeasuredProfile
    sha256: str | None
    doubt: str = ""  # where the file's header names other units than the scene


@dataclass(frozen=True)
class ProfileInfo:
    """Origin of the profile, and its figures after the form was removed."""

    source: str  # the file as the scene names it, or the kind of a made profile
    samples: int  # of the whole trace
    length: float  # [m]
    spacing: float  # [m], median
    form: RemovedForm  # what was taken away
    roughness: Roughness  # figures of what is left and is pressed
    path: Path | None = field(default=None, compare=False)  # of the file, None for a made profile
    # as read or made: with its form, unfiltered, at its own positions
    trace: Profile | None = field(default=None, compare=False, repr=False)
    sha256: str | None = None  # of the file
    doubt: str = field(default="", compare=False)  # about its units, in words
    bridged: int = 0  # lost samples that were interpolated between their neighbours
    trimmed: int = 0  # lost samples that were dropped at the ends
    stretch: tuple[float, float] | None = None  # [m] of the longest bridge, from where to where
    format: str | None = None  # of the file
    place: str | None = None  # the line of a map that it is, in words
    cutoff: float | None = None  # [m] of the filter, None where there is none
    short_cutoff: float | None = None  # [m]
    # parameters after ISO 21920-2 of the whole trace, whatever is pressed
    standard: StandardRoughness | None = None
    standard_why: str | None = None  # why there are none
    seam: float | None = None  # [m] between the heights of a periodic trace's ends, before they met

    def as_dict(self) -> dict:
        """Fields for JSON, without `path`, which another machine does not have, `trace` and
        `doubt`."""
        figures = asdict(replace(self, path=None, trace=None))
        del figures["path"], figures["trace"], figures["doubt"]
        if self.seam is None:
            del figures["seam"]
        nested = ("form", "roughness", "standard")
        return figures | {name: finite(figures[name]) for name in nested if figures[name]}


@dataclass(frozen=True)
class SceneSurface:
    """Surface that a scene presses on."""

    profile: Profile | None  # None: smooth
    info: ProfileInfo | None
    position: float  # [m] where x = 0 lies on the trace as it was given
    length: float | None = None  # [m] asked for a sinusoid that says none itself
    # what running-in did, None until it was done; then the profile and its figures are after it
    run_in: RunIn | None = None

    def completed(self, tables: dict) -> dict:
        """The tables of the scene with the fields that follow from its surface: reading them
        again, in a folder that holds the profile's file, gives scene and surface."""
        completed = dict(tables) | {"load": tables["load"] | {"position": self.position}}
        if self.profile is not None:
            follows = {"length": self.length, "cutoff": self.info.cutoff}
            known = {name: value for name, value in follows.items() if value is not None}
            completed["profile"] = tables["profile"] | known
        return completed

    def as_dict(self, scene: SceneBase) -> dict:
        """The scene for JSON: its completed tables, its name, what became of its profile."""
        return {
            "name": scene.name,
            "title": scene.title,
            **dict.fromkeys(("profile", "running_in", "stress")),
            **self.completed(scene.tables),
            "profile_info": self.info.as_dict() if self.info else None,
        }


def surface_of(
    scene: SceneBase, known: KnownTrace | None = None, standard: bool = True
) -> SceneSurface:
    """The surface that a scene asks for, as measured: not run in yet.

    known     trace to take in place of the profile's file
    standard  give the standard's figures, too, which take the most of the time
    Raises SceneError where the profile cannot be read or made, or the roller leaves the trace."""
    if scene.profile is None:
        return SceneSurface(None, None, scene.load.position or 0.0)
    table, length = plain(scene.profile), None
    if scene.profile.variety == "sinusoid" and scene.profile.length is None:
        one_wave = scene.profile.wavelength
        length = table["length"] = one_wave if scene.periodic else _sinusoid_length(scene)
    if scene.profile.file is not None:
        trace, origin = _measured(table, scene, known)
    else:
        trace, origin = _made(table, scene.source, known)
    pressed, filtering = _filtered(trace, table, scene.source, standard)
    if scene.periodic:
        pressed, filtering["seam"] = _closed(pressed, scene.source)
    position = _position(scene, trace, pressed)
    info = ProfileInfo(
        **origin,
        **filtering,
        samples=len(trace.x),
        length=trace.length,
        spacing=trace.spacing,
        roughness=roughness(pressed),
    )
    surface = SceneSurface(pressed.shifted(position), info, position, length)
    if scene.running_in is not None:
        _check_places(scene, surface)
    return surface


def scene_key(scene: SceneBase, surface: SceneSurface) -> list:
    """Tables and profile of a scene: what of it shapes results."""
    profile = surface.profile
    traced = "" if profile is None else digest(profile.x, profile.height)
    return [surface.completed(scene.tables), traced]


def smooth_contact(scene: SceneBase) -> HertzContact:
    """Hertz's contact under the load per length of a scene, or to its peak pressure."""
    hertz = hertz_from_load if scene.load.kind == "per_length" else hertz_from_peak_pressure
    modulus = combined_modulus(scene.body.material, scene.roller.material)
    return hertz(scene.load.value, scene.roller.radius, modulus)


def _sinusoid_length(scene: SceneBase) -> float:
    """Length [m] of a sinusoid that outlasts its contact, and the roller's way while it runs in.
    Crests touch where the roller is no higher than Hertz' compression and the waves make up
    for: x^2 < a^2 + 4 R amplitude, a the Hertz half-width, R = `radius` [m]."""
    radius, load = scene.roller.radius, scene.load
    if load.kind == "approach":
        half_width = sqrt(2.0 * radius * load.value)
    else:
        half_width = smooth_contact(scene).half_width
    widest = hypot(half_width, sqrt(4.0 * radius * scene.profile.amplitude))
    length = max(SINUSOID_REACH * widest, SINUSOID_WAVES * scene.profile.wavelength)
    if scene.running_in is not None:
        length += scene.running_in.travel(load.position or 0.0)
    return length


def _measured(table: Mapping, scene: SceneBase, known: KnownTrace | None) -> tuple[Profile, dict]:
    """The profile in a file without its form, and where it comes from."""
    path, source = scene.folder / table["file"], scene.source
    try:
        known = known or _read(table, path)
    except MissingUnitError as error:
        words = allowed(ProfileSection, error.field)
        words += ", or spacing where the file has no x" if error.field == "x_unit" else ""
        missing = f"profile.{error.field}: is missing; allowed is {words}"
        raise SceneError(f"{source}: {missing} ({table['file']} {error.message})") from error
    except (ValueError, OSError) as error:
        raise SceneError(f"{source}: profile.file: {error}") from error
    try:
        trace, form = _without_form(known.read.profile, table["form"])
    except ValueError as error:
        raise SceneError(f"{source}: profile.form: {error}") from error
    names = ("bridged", "trimmed", "stretch", "format", "place")
    how = {name: getattr(known.read, name) for name in names}
    origin = {"source": table["file"], "path": path, "trace": known.read.profile, "form": form}
    return trace, origin | how | {"sha256": known.sha256, "doubt": known.doubt}


def _read(table: Mapping, path: Path) -> KnownTrace:
    place = {name: table[name] for name in ("row", "column", "line") if name in table}
    x_scale, height_scale = (
        unit_in_si(table[unit], LENGTH) if unit in table else None for unit in ("x_unit", "z_unit")
    )
    spacing, columns = table.get("spacing"), table.get("columns")
    which = {"columns": columns, "channel": table.get("channel"), "is_map": bool(place)}
    opened, doubt = open_measured(path, **which, one_column=spacing is not None), ""
    if isinstance(opened, ProfileTable):  # its header may name them
        guesses = header_units(opened, columns is not None)
        named, doubt = {name: unit for name, (unit, _) in guesses.items()}, _doubt(table, guesses)
        if x_scale is None and spacing is None and "x_unit" in named:
            x_scale = unit_in_si(named["x_unit"], LENGTH)
        if height_scale is None and "z_unit" in named:
            height_scale = unit_in_si(named["z_unit"], LENGTH)
    read = profile_of(
        opened,
        x_scale=x_scale,
        height_scale=height_scale,
        spacing=spacing,
        dropouts=table["dropouts"],
        chosen=MapLine(**place) if place else None,
    )
    return KnownTrace(read, hashlib.sha256(path.read_bytes()).hexdigest(), doubt)


def _doubt(table: Mapping, guesses: Guesses) -> str:
    """Text on what the header says otherwise. A single unit in it may mean either column."""
    asked, others = [name for name in guesses if name in table], []
    for name in asked:
        unit, why = guesses[name]
        with suppress(UnitError):  # what stands in brackets need be none
            if unit_in_si(unit, LENGTH) != unit_in_si(table[name], LENGTH):
                others.append(f'profile.{name} is "{table[name]}", but "{unit}" {why}')
    is_single = len({unit for unit, _ in guesses.values()}) == 1
    return "" if is_single and len(others) < len(asked) else "; ".join(others)


def _made(table: Mapping, source: str, known: KnownTrace | None) -> tuple[Profile, dict]:
    """The profile that `analytic.surface.synthetic` makes, about its mean line, and its origin."""
    parameters = {name: value for name, value in table.items() if name not in ("kind", *COMMON)}
    try:
        trace = known.read.profile if known else _MAKERS[table["kind"]](**parameters)
    except ValueError as error:
        raise SceneError(f"{source}: profile: {error}") from error
    return trace, {"source": table["kind"], "form": RemovedForm("none"), "trace": trace}


def _filtered(trace: Profile, table: Mapping, source: str, standard: bool) -> tuple[Profile, dict]:
    """Pressed part of the trace, and the filter and the standard's figures for the account."""
    cutoff, short = table.get("cutoff"), table.get("short_cutoff")
    field = "cutoff"
    try:
        if cutoff == AUTOMATIC:
            cutoff = standard_cutoff(trace)
        field = "short_cutoff"
        if short is not None:
            check_cutoff(trace, short)
        field = "cutoff" if cutoff is not None else field
        pressed = filtered(trace, cutoff, short)
    except ValueError as error:
        raise SceneError(f"{source}: profile.{field}: {error}") from error
    account = {"cutoff": cutoff, "short_cutoff": short}
    if not standard:
        return pressed, account
    try:
        cutoff = standard_cutoff(trace) if cutoff is None else cutoff
        short = short or standard_short_cutoff(trace, cutoff)
        account["standard"] = standard_roughness(trace, cutoff, short)
    except ValueError as error:
        account["standard_why"] = str(error).partition(";")[0]
    return pressed, account


def _without_form(profile: Profile, form: str) -> tuple[Profile, RemovedForm]:
    """Profile after `remove_form`; heights count from the mean line even if no form is removed."""
    if form == "none":
        level, removed = remove_form(profile, "mean")
        return level, replace(removed, kind="none")
    return remove_form(profile, form)


def _closed(trace: Profile, source: str) -> tuple[Profile, float]:
    """The trace as one period, whose last sample is the first, and what was between the two [m].
    They meet at their mean where they are no further apart than neighbouring samples."""
    height = trace.height.copy()
    step, largest = abs(float(height[-1] - height[0])), float(abs(diff(height)).max())
    if step > largest:
        raise SceneError(
            f"{source}: profile.periodic: is true, but the ends of the trace are {step:.3g} m "
            f"apart, neighbouring samples {largest:.3g} m at most; allowed is a trace of whole "
            'periods, whose last sample repeats the first (profile.form = "line" takes a tilt away)'
        )
    height[[0, -1]] = 0.5 * (height[0] + height[-1])
    return Profile(trace.x, height, periodic=True), step


def _position(scene: SceneBase, trace: Profile, pressed: Profile) -> float:
    """Position of the roller's centre on the trace [m], by default the middle; of a periodic one
    half a period from its lowest point, where one period then ends and the next begins."""
    first, last, wanted = float(trace.x[0]), float(trace.x[-1]), scene.load.position
    if wanted is None and scene.periodic:
        lowest = float(pressed.x[pressed.height.argmin()])
        return lowest + 0.5 * pressed.length * (1.0 if lowest < 0.5 * (first + last) else -1.0)
    if wanted is None:
        return 0.5 * (first + last)
    if not first < wanted < last:
        raise SceneError(
            f"{scene.source}: load.position: is {wanted:g} m; allowed is inside the trace, "
            f"above {first:g} m and below {last:g} m"
        )
    return wanted


def _check_places(scene: SceneBase, surface: SceneSurface) -> None:
    """Raise SceneError where running-in would take the roller off the trace."""
    position, stroke = surface.position, scene.running_in.stroke
    first, last = position + surface.profile.x[[0, -1]]
    for place in scene.running_in.places(position):
        if first < place < last:
            continue
        field, wrong = "positions", place
        where = f"inside the trace, above {first:g} m and below {last:g} m"
        if stroke is not None:
            field, wrong = "stroke", stroke
            room = 2.0 * min(position - first, last - position)
            where = f"below {room:g} m, to stay on the trace about the roller's centre"
        raise SceneError(f"{scene.source}: running_in.{field}: is {wrong:g} m; allowed is {where}")
