"""The profile of a scene: read or made, without its form, filtered, put under the roller."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import hypot, sqrt
from pathlib import Path

from analytic.exact.hertz import hertz_from_load, hertz_from_peak_pressure
from analytic.material import Material, combined_modulus
from analytic.profile import Profile
from analytic.surface.filters import check_cutoff, filtered
from analytic.surface.form import RemovedForm, remove_form
from analytic.surface.readers.files import MeasuredProfile, MissingUnitError, read_measured
from analytic.surface.readers.topography import MapLine
from analytic.surface.roughness import roughness
from analytic.surface.roughness_standard import (
    standard_cutoff,
    standard_roughness,
    standard_short_cutoff,
)
from analytic.surface.synthetic import ground_texture, self_affine, sinusoid
from analytic.surface.turned import turned
from comparisons.common.errors import SceneError
from comparisons.common.units import LENGTH, unit_in_si
from comparisons.scenes.scene import Load, ProfileInfo
from comparisons.scenes.schema.fields import allowed
from comparisons.scenes.schema.profile import AUTOMATIC, FILTER, ProfileSection

SINUSOID_REACH = 4.0  # length of a sinusoid over the widest contact, where the scene gives none
SINUSOID_WAVES = 3.0  # and at least so many wavelengths

_MAKERS = {"sinusoid": sinusoid, "self-affine": self_affine}
_MAKERS |= {"ground": ground_texture, "turned": turned}
# What a message allows for a field that neither the file nor the scene gives.
_ALLOWED = {
    "x_unit": "exactly one of x_unit and spacing",
    "z_unit": allowed(ProfileSection, "z_unit"),
    "spacing": allowed(ProfileSection, "spacing"),
}


@dataclass(frozen=True)
class KnownTrace:
    """A trace that is read or made already, and the SHA-256 of its file, None for a made one."""

    read: MeasuredProfile
    sha256: str | None


def profile_of(
    table: Mapping,
    position: float | None,
    *,
    folder: Path,
    source: str,
    known: KnownTrace | None = None,
) -> tuple[Profile, ProfileInfo, float]:
    """The profile with x = 0 under the roller's centre and height 0 on the mean line.

    table     [profile] with SI numbers and its defaults
    position  [m] of the roller's centre on the trace; None is the middle
    folder, source, known   as in `comparisons.scenes.resolve.resolve_tables`
    Returns the account of the whole trace and the position as well. Raises SceneError."""
    if "file" in table:
        trace, origin = _measured(table, folder / table["file"], source, known)
    else:
        trace, origin = _made(table, source, known)
    position = _position(position, trace, source)
    pressed, filtering = _filtered(trace, table, source)
    account = ProfileInfo(
        **origin,
        **filtering,
        samples=len(trace.x),
        length=trace.length,
        spacing=trace.spacing,
        roughness=roughness(pressed),
    )
    return pressed.shifted(position), account, position


def sinusoid_length(
    table: ProfileSection, load: Load, radius: float, roller: Material | None, body: Material
) -> float:
    """Length [m] of a sinusoid that outlasts its contact under `load`.
    Crests touch where the roller is no higher than Hertz' compression and the waves make up
    for: x^2 < a^2 + 4 R amplitude, a the Hertz half-width, R = `radius` [m]."""
    if load.kind == "approach":
        half_width = sqrt(2.0 * radius * load.value)
    else:
        hertz = hertz_from_load if load.kind == "load_per_length" else hertz_from_peak_pressure
        half_width = hertz(load.value, radius, combined_modulus(body, roller)).half_width
    widest = hypot(half_width, sqrt(4.0 * radius * table.amplitude))
    return max(SINUSOID_REACH * widest, SINUSOID_WAVES * table.wavelength)


def _measured(
    table: Mapping, path: Path, source: str, known: KnownTrace | None
) -> tuple[Profile, dict]:
    """The profile in a file without its form, and where it comes from."""
    try:
        known = known or _read(table, path)
    except MissingUnitError as error:
        raise SceneError(
            f"{source}: profile.{error.field}: is missing; allowed is {_ALLOWED[error.field]} "
            f"({table['file']} {error.message})"
        ) from error
    except (ValueError, OSError) as error:
        raise SceneError(f"{source}: profile.file: {error}") from error
    try:
        trace, form = _without_form(known.read.profile, table["form"])
    except ValueError as error:
        raise SceneError(f"{source}: profile.form: {error}") from error
    names = ("bridged", "trimmed", "stretch", "format", "place")
    how = {name: getattr(known.read, name) for name in names}
    origin = {"source": table["file"], "path": path, "trace": known.read.profile, "form": form}
    return trace, origin | how | {"sha256": known.sha256}


def _read(table: Mapping, path: Path) -> KnownTrace:
    place = {name: table[name] for name in ("row", "column", "line") if name in table}
    x_scale, height_scale = (
        unit_in_si(table[unit], LENGTH) if unit in table else None for unit in ("x_unit", "z_unit")
    )
    read = read_measured(
        path,
        x_scale=x_scale,
        height_scale=height_scale,
        spacing=table.get("spacing"),
        columns=table.get("columns"),
        channel=table.get("channel"),
        dropouts=table["dropouts"],
        chosen=MapLine(**place) if place else None,
    )
    return KnownTrace(read, hashlib.sha256(path.read_bytes()).hexdigest())


def _made(table: Mapping, source: str, known: KnownTrace | None) -> tuple[Profile, dict]:
    """The profile that `analytic.surface.synthetic` makes, about its mean line, and its origin."""
    parameters = {name: value for name, value in table.items() if name not in ("kind", *FILTER)}
    try:
        trace = known.read.profile if known else _MAKERS[table["kind"]](**parameters)
    except ValueError as error:
        raise SceneError(f"{source}: profile: {error}") from error
    return trace, {"source": table["kind"], "form": RemovedForm("none"), "trace": trace}


def _filtered(trace: Profile, table: Mapping, source: str) -> tuple[Profile, dict]:
    """What is pressed of the trace, and the filter and the standard's figures for the account."""
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
    try:
        cutoff = standard_cutoff(trace) if cutoff is None else cutoff
        short = short or standard_short_cutoff(trace, cutoff)
        account["standard"] = standard_roughness(trace, cutoff, short)
    except ValueError as error:
        account["standard_why"] = str(error).partition(";")[0]
    return pressed, account


def _without_form(profile: Profile, form: str) -> tuple[Profile, RemovedForm]:
    """As `remove_form`, but heights count from the mean line even where no form is removed."""
    if form == "none":
        level, removed = remove_form(profile, "mean")
        return level, replace(removed, kind="none")
    return remove_form(profile, form)


def _position(given: float | None, trace: Profile, source: str) -> float:
    first, last = float(trace.x[0]), float(trace.x[-1])
    if given is None:
        return 0.5 * (first + last)
    if not first < given < last:
        raise SceneError(
            f"{source}: load.position: is {given:g} m; allowed is inside the trace, "
            f"above {first:g} m and below {last:g} m"
        )
    return given
