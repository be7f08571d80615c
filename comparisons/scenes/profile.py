"""The [profile] section: a measured profile or a made one, each variety with fields of its own."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from pathlib import Path
from typing import Annotated

from pydantic import model_validator

from analytic.profile import MAX_SAMPLES, MIN_SAMPLES
from comparisons.common.units import DIMENSIONLESS, LENGTH, describe
from comparisons.scenes.fields import (
    FieldType,
    Length,
    Number,
    OneOf,
    SceneSection,
    Text,
    Truth,
    Unit,
    Whole,
    allowed,
)

AUTOMATIC = "auto"
FILTER = ("cutoff", "short_cutoff")
COMMON = (*FILTER, "periodic")  # fields of every variety
WHOLE = 1e-9  # relative: how near a length is to whole wavelengths
# Sections that need a single contact under a roller, and fields that bend a body or its surface:
# the bodies of a periodic surface are linear, its roughness is in the gap.
NOT_PERIODIC = ("running_in", "scatter", "statistics", "heat", "partial_slip", "answers")
ON_ONE_PERIOD = {
    "finite_element.deformation": "linear",
    "finite_element.plastic": False,
    "finite_element.roller_shape": "parabola",
    "finite_element.roller_body": "half-plane",
    "finite_element.coupled": False,
    "load.coupled": False,
    "body.width": None,
    "roller.support": None,
}
POSITIVE = Number(LENGTH, above=0.0)
PLACE = Number(LENGTH, at_least=0.0)


class CutOff(FieldType):
    """A length above 0, or "auto"."""

    def read(self, entry: object) -> float | str:
        if entry == AUTOMATIC:
            return AUTOMATIC
        try:
            return POSITIVE.read(entry)
        except ValueError as error:
            raise self.wrong(str(error).partition(";")[0]) from error

    def allowed(self) -> str:
        return f'{POSITIVE.allowed()}, or "{AUTOMATIC}"'


class Segment(FieldType):
    """[[x0, y0], [x1, y1]]: two points of two lengths each, at least 0."""

    def read(self, entry: object) -> tuple[tuple[float, float], tuple[float, float]]:
        points = self._pair(entry)
        start, stop = (tuple(map(self._length, self._pair(point))) for point in points)
        if start == stop:
            raise self.wrong("starts where it ends")
        return start, stop

    def _pair(self, entry: object) -> list | tuple:
        if isinstance(entry, list | tuple) and len(entry) == 2:
            return entry
        size = f" of {len(entry)}" if isinstance(entry, list | tuple) else ""
        raise self.wrong(f"holds {describe(entry)}{size}")

    def _length(self, entry: object) -> float:
        try:
            return PLACE.read(entry)
        except ValueError as error:
            raise self.wrong(f"holds a place that {str(error).partition(';')[0]}") from error

    def allowed(self) -> str:
        return 'two points, such as [["0 um", "10 um"], ["500 um", "10 um"]], none below 0'


@dataclass(frozen=True)
class Columns(FieldType):
    """Of a table: those of x and height, or that of heights alone, by names or numbers from 0."""

    def read(self, entry: object) -> tuple[str | int, ...]:
        values = entry if isinstance(entry, list | tuple) else [entry]
        if len(values) not in (1, 2) or values.count(values[0]) > 1:
            raise self.wrong(f"is {describe(entry)} of {len(values)}")
        for value in values:
            named = isinstance(value, str) and value.strip()
            if not named and (type(value) is not int or not 0 <= value < MAX_SAMPLES):
                raise self.wrong(f"holds {describe(value)}")
        return tuple(values)

    def allowed(self) -> str:
        return 'one or two columns by name or by number from 0, such as ["x", "z"] or [0, 2]'


Ratio = Annotated[float, Number(DIMENSIONLESS, above=0.0)]
Samples = Annotated[int, Whole(MIN_SAMPLES, MAX_SAMPLES)]


class ProfileSection(SceneSection):
    """A measured profile (`file`) or a made one (`kind`), with the parameters of
    `analytic.surface.synthetic`, which also checks how they fit together."""

    file: Annotated[str, Text("the path of a profile, from the scene's folder")] | None = None
    x_unit: Annotated[str, Unit(LENGTH)] | None = None
    z_unit: Annotated[str, Unit(LENGTH)] | None = None
    spacing: Length | None = None
    columns: Annotated[tuple, Columns()] | None = None
    channel: Annotated[str, Text("the name of a channel, or of a sheet")] | None = None
    row: Annotated[int, Whole(0, MAX_SAMPLES)] | None = None
    column: Annotated[int, Whole(0, MAX_SAMPLES)] | None = None
    line: Annotated[tuple, Segment()] | None = None
    form: Annotated[str, OneOf(("none", "mean", "line", "arc"))] | None = None
    dropouts: Annotated[str, OneOf(("refuse", "bridge"))] | None = None
    kind: Annotated[str, OneOf(("sinusoid", "self-affine", "ground", "turned"))] | None = None
    wavelength: Length | None = None
    amplitude: Length | None = None
    samples_per_wavelength: Samples | None = None
    hurst: Annotated[float, Number(DIMENSIONLESS, above=0.0, at_most=1.0)] | None = None
    rms_slope: Ratio | None = None
    rms_height: Length | None = None
    samples: Samples | None = None
    length: Length | None = None
    seed: Annotated[int, Whole(0, 2**63 - 1)] | None = None
    shortest_wavelength: Length | None = None
    roll_off_wavelength: Length | None = None
    longest_wavelength: Length | None = None
    decay: Ratio | None = None
    one_sidedness: Ratio | None = None
    feed: Length | None = None
    nose_radius: Length | None = None
    ridge_radius: Length | None = None
    phase: Annotated[float, Number(DIMENSIONLESS, at_least=0.0, below=1.0)] | None = None
    samples_per_feed: Samples | None = None
    noise: Length | None = None
    noise_wavelength: Length | None = None
    cutoff: Annotated[float | str, CutOff()] | None = None
    short_cutoff: Length | None = None
    periodic: Annotated[bool, Truth()] | None = None

    @property
    def variety(self) -> str:
        """ "file" for a measured profile, else its kind."""
        return self.kind or "file"

    @model_validator(mode="before")
    @classmethod
    def _defaults_of_the_variety(cls, entry: object) -> object:
        if not isinstance(entry, dict):
            return entry
        kind = entry.get("kind", "file")
        variety = VARIETIES.get(kind) if isinstance(kind, str) else None
        return {**variety.defaults, **entry} if variety else entry

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.file is not None and self.kind is not None:
            yield "kind", "is given beside file; allowed is one of the two"
        if self.file is None and self.kind is None:
            yield "file", "is missing; allowed is file (measured) or kind (made)"
        variety = VARIETIES[self.variety]
        for name in sorted(self.model_fields_set - variety.fields()):
            if getattr(self, name) is not None:
                others = sorted(variety.fields() - {"kind", "file", *COMMON})
                there = ", ".join([*others, *COMMON])
                yield name, f"does not belong to {variety.title}; allowed there are {there}"
        for name in variety.needed:
            if getattr(self, name) is None:
                words = allowed(ProfileSection, name)
                yield name, f"is missing; allowed is {words} ({variety.title})"
        for names in variety.one_of:
            yield from self.unless_one_of(names, " and ")
        for names in variety.at_most_one_of:
            yield from self.unless_one_of(names, " and ", or_none=True)

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        """What a periodic surface does not take: a round body, another load, what bends."""
        load = scene.load
        if not self.periodic:
            return
        if scene.roller.radius is not None:
            flat = "is given beside profile.periodic = true, where the smooth body is flat"
            yield "roller.radius", f"{flat}; allowed is none"
        if load.mean_pressure is None:
            other = "is given for a periodic surface; allowed is load.mean_pressure"
            yield f"load.{load.kind}", other
        if self.wavelength is not None and self.length is not None:
            waves = self.length / self.wavelength
            if abs(waves - round(waves)) > WHOLE * waves:
                whole = "a whole number of them where profile.periodic = true"
                yield "profile.length", f"is {waves:g} wavelengths; allowed is {whole}"
        for name in NOT_PERIODIC:
            if getattr(scene, name):
                yield name, "is given for a periodic surface; allowed is none"
        for name, fits in ON_ONE_PERIOD.items():
            value = attrgetter(name)(scene)
            if value not in (None, fits):
                words = {None: "none", False: "false"}.get(fits, f'"{fits}"')
                yield name, f"does not fit a periodic surface; allowed is {words}"
        if scene.body.base == "frictionless" and max(load.friction) > 0.0:
            slides = "is given on a frictionless base, where nothing would hold a periodic body"
            yield "load.friction", f'{slides}; allowed is friction = 0 or base = "bonded"'


@dataclass(frozen=True)
class Variety:
    """Which fields one variety of profile has: needed ones, others, groups to choose one from."""

    title: str
    needed: Sequence[str]
    optional: Sequence[str] = ()
    defaults: Mapping[str, object] = field(default_factory=dict)
    one_of: Sequence[Sequence[str]] = ()
    at_most_one_of: Sequence[Sequence[str]] = ()

    def fields(self) -> set[str]:
        groups = (*self.one_of, *self.at_most_one_of)
        return set().union(self.needed, self.optional, self.defaults, COMMON, *groups)


_TABLES = tomllib.loads(Path(__file__).with_name("varieties.toml").read_text(encoding="utf-8"))
VARIETIES = {name: Variety(**table) for name, table in _TABLES.items()}
