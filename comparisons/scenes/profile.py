"""The [profile] section: a measured profile or a made one, each variety with fields of its own."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from typing import Annotated, Literal, Self

from pydantic import Field, StrictBool, StrictInt

from analytic.profile import MAX_SAMPLES, MIN_SAMPLES
from comparisons.common.units import DIMENSIONLESS, LENGTH
from comparisons.scenes.fields import Length, Number, SceneSection, Several, Text, Unit, optional

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
Ratio = Annotated[float, Number(DIMENSIONLESS, gt=0.0)]
Share = Annotated[float, Number(DIMENSIONLESS, gt=0.0, le=1.0)]
Phase = Annotated[float, Number(DIMENSIONLESS, ge=0.0, lt=1.0)]
Samples = Annotated[StrictInt, Field(ge=MIN_SAMPLES, le=MAX_SAMPLES)]
Count = Annotated[StrictInt, Field(ge=0, le=MAX_SAMPLES)]
Seed = Annotated[StrictInt, Field(ge=0, le=2**63 - 1)]
Coordinate = Annotated[float, Number(LENGTH, ge=0.0)]
Point = tuple[Coordinate, Coordinate]
LengthUnit = Annotated[str, Unit(LENGTH)]
Column = Annotated[Count | Text, Field(title="the name of a column, or its number from 0")]
Columns = Annotated[tuple[Column, ...], Several(most=2)]


class ProfileSection(SceneSection):
    """Rough surface, measured (`file`) or computed (`kind`); without this table the body is smooth.
    `x_unit` or `spacing`, and one of `row`, `column` and `line`, belong to some files."""

    file: Text | None = optional("measured trace: the path of its file, from the scene's folder")
    x_unit: LengthUnit | None = optional("of the positions, where the file does not say")
    z_unit: LengthUnit | None = optional("of the heights, where the file does not say")
    spacing: Length | None = optional("of the samples, where the file holds heights alone")
    columns: Columns | None = optional(
        "of a table with more than x and height, by name or by number from 0",
        examples=[["x", "z"], [0, 2]],
    )
    channel: Text | None = optional("of a file with several, an array of npz, or a sheet of xlsx")
    row: Count | None = optional("of an areal map")
    column: Count | None = optional("of an areal map instead")
    line: tuple[Point, Point] | None = optional(
        "across an areal map instead, from one point to another",
        examples=[[["0 um", "10 um"], ["500 um", "10 um"]]],
    )
    form: Literal["none", "mean", "line", "arc"] | None = optional(
        "taken off before the surface is pressed; `line` by default"
    )
    dropouts: Literal["refuse", "bridge"] | None = optional(
        "lost heights and gaps in x: an error (by default), or put on straight lines"
    )
    kind: Literal["sinusoid", "self-affine", "ground", "turned"] | None = optional(
        "computed surface"
    )
    wavelength: Length | None = optional("of a sinusoid")
    amplitude: Length | None = optional("half of its height from valley to crest; a crest at x = 0")
    samples_per_wavelength: Samples | None = optional("of a sinusoid; 64 by default")
    hurst: Share | None = optional("Hurst exponent of a self-affine surface")
    rms_slope: Ratio | None = optional("root mean square of the slope; or `rms_height`")
    rms_height: Length | None = optional("root mean square of the heights")
    samples: Samples | None = optional("of the trace")
    length: Length | None = optional(
        "of the trace; of a sinusoid as long as the contact asks for by default, one "
        "wavelength where it is periodic"
    )
    seed: Seed | None = optional("of the random numbers; 0 by default")
    shortest_wavelength: Length | None = optional("by default 4 samples of a self-affine surface")
    roll_off_wavelength: Length | None = optional(
        "longer waves are equally high, shorter ones lower"
    )
    longest_wavelength: Length | None = optional("by default the length of a self-affine surface")
    decay: Ratio | None = optional("of a ground surface: amplitudes as k^−decay; 1.25 by default")
    one_sidedness: Ratio | None = optional("skewness is about −3 times this; 0.3 by default")
    feed: Length | None = optional("of a turned surface, per revolution; at most the nose radius")
    nose_radius: Length | None = optional("of the tool")
    ridge_radius: Length | None = optional("of its ridges; by default a tenth of the nose radius")
    phase: Phase | None = optional("of the ridge at x = 0, in feeds; 0 by default")
    samples_per_feed: Samples | None = optional("as many as the ridges ask for by default")
    noise: Length | None = optional("root mean square, added to a turned surface; none by default")
    noise_wavelength: Length | None = optional("its shortest wave; by default a tenth of the feed")
    cutoff: Length | Literal[AUTOMATIC] | None = optional(
        "longer waves are taken off (Gaussian filter, ISO 16610-21); `auto`: as the "
        "standard chooses"
    )
    short_cutoff: Length | None = optional("shorter waves are taken off")
    periodic: StrictBool | None = optional("one period of an endless surface under a flat body")

    @property
    def variety(self) -> str:
        """ "file" for a measured profile, else its kind."""
        return self.kind or "file"

    def completed(self, scene: SceneSection) -> Self:
        defaults = VARIETIES[self.variety].defaults.items()
        follows = {name: value for name, value in defaults if getattr(self, name) is None}
        return self.model_copy(update=follows)

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from self.unless_one_of(("file", "kind"))
        variety = VARIETIES[self.variety]
        for name in sorted(self.model_fields_set - variety.fields()):
            if getattr(self, name) is not None:
                others = sorted(variety.fields() - {"kind", "file", *COMMON})
                there = ", ".join([*others, *COMMON])
                yield name, f"does not belong to {variety.title}; allowed there are {there}"
        for name in variety.needed:
            if getattr(self, name) is None:
                yield name, f"is missing for {variety.title}"
        if self.line is not None and self.line[0] == self.line[1]:
            yield "line", "starts where it ends"
        for names in variety.one_of:
            yield from self.unless_one_of(names)
        for names in variety.at_most_one_of:
            yield from self.unless_one_of(names, or_none=True)

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        """Misfits to a periodic surface: a round body, another load, what bends."""
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
    """Fields that one variety of profile has: needed ones, others, groups to choose one from."""

    title: str
    needed: Sequence[str]
    optional: Sequence[str] = ()
    defaults: Mapping[str, object] = field(default_factory=dict)
    one_of: Sequence[Sequence[str]] = ()
    at_most_one_of: Sequence[Sequence[str]] = ()

    def fields(self) -> set[str]:
        groups = (*self.one_of, *self.at_most_one_of)
        return set().union(self.needed, self.optional, self.defaults, COMMON, *groups)


VARIETIES = {
    "file": Variety(
        "a measured profile",
        needed=("file",),
        # a file that is not text may bring its units and its size
        optional=("z_unit", "columns", "channel"),
        defaults={"form": "line", "dropouts": "refuse"},
        at_most_one_of=(("x_unit", "spacing"), ("row", "column", "line")),
    ),
    "sinusoid": Variety(
        'kind = "sinusoid"',
        needed=("kind", "wavelength", "amplitude"),
        optional=("length",),
        defaults={"samples_per_wavelength": 64},
    ),
    "self-affine": Variety(
        'kind = "self-affine"',
        needed=("kind", "hurst", "samples", "length"),
        optional=("shortest_wavelength", "longest_wavelength"),
        defaults={"seed": 0},
        one_of=(("rms_slope", "rms_height"),),
    ),
    "ground": Variety(
        'kind = "ground"',
        needed=(
            *("kind", "rms_height", "samples", "length"),
            *("shortest_wavelength", "roll_off_wavelength", "longest_wavelength"),
        ),
        defaults={"seed": 0, "decay": 1.25, "one_sidedness": 0.3},
    ),
    "turned": Variety(
        'kind = "turned"',
        needed=("kind", "feed", "nose_radius", "length"),
        optional=("ridge_radius", "samples_per_feed", "noise", "noise_wavelength"),
        defaults={"phase": 0.0, "seed": 0},
    ),
}
