"""The [scatter] section: by how much inputs of the scene are uncertain."""

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal
from typing import Annotated

from pydantic import Field, StrictInt

from comparisons.common.units import DIMENSIONLESS, LENGTH, PRESSURE, Dimension, describe
from comparisons.scenes.fields import (
    WITH_UNIT,
    FieldType,
    Length,
    Number,
    SceneSection,
    in_si,
    optional,
)
from comparisons.scenes.materials import ELASTIC
from comparisons.scenes.schema.messages import read_field

CUT_OFF = 3.0  # standard deviations beyond which an uncertain input is not sampled
FEWEST, MOST = 8, 4096  # samples
# Inputs that are fields of the scene, with their section; the load is a field of two kinds.
FIELDS = {
    f"{section}_{field}": (section, field)
    for section, fields in (("roller", ("radius", *ELASTIC)), ("body", ELASTIC))
    for field in fields
} | {"friction": ("load", "friction")}
OF_PROFILE = ("position", "noise", "tip_radius")


@dataclass(frozen=True)
class Spread:
    """How uncertain an input is: normal by a standard `deviation`, `relative` to the scene's own
    value or in SI, cut off at CUT_OFF deviations; or uniform over a `range` in SI."""

    deviation: float = 0.0
    relative: bool = False
    range: tuple[float, float] | None = None

    def size(self, nominal: float) -> float:
        """Standard deviation about the scene's value, in SI."""
        return self.deviation * (abs(nominal) if self.relative else 1.0)

    def ends(self, nominal: float) -> tuple[float, float]:
        """The smallest and the largest value that is sampled."""
        far = CUT_OFF * self.size(nominal)
        return self.range or (nominal - far, nominal + far)

    def plain(self) -> dict | str | float:
        """Value as a scene file has it."""
        if self.range:
            return {"range": list(self.range)}
        return f"{100 * Decimal(repr(self.deviation))} %" if self.relative else self.deviation


@dataclass(frozen=True)
class SpreadField(FieldType):
    """A standard deviation, in the field's unit (`absolute`) or in per cent of the scene's own
    value (`relative`), or {range = [low, high]} with all between as likely (`range`)."""

    dimension: Dimension
    ways: tuple[str, ...] = ("absolute", "relative", "range")

    def read(self, entry: object) -> Spread:
        if isinstance(entry, dict) and "range" in self.ways:
            return self._range(entry)
        way = "relative" if isinstance(entry, str) and entry.rstrip().endswith("%") else "absolute"
        if way not in self.ways:
            raise ValueError(f"is {describe(entry)}")
        value = in_si(entry, self.dimension if way == "absolute" else DIMENSIONLESS)
        if not value > 0.0:
            raise ValueError(f"is {describe(entry)}")
        return Spread(value, relative=way == "relative")

    def _range(self, entry: dict) -> Spread:
        ends = entry.get("range")
        if set(entry) != {"range"} or not isinstance(ends, list | tuple) or len(ends) != 2:
            raise ValueError("is a table that is no range of two values")
        low, high = (in_si(end, self.dimension) for end in ends)
        if not low < high:
            raise ValueError(f"has a range from {low:g} to {high:g}")
        return Spread(range=(low, high))

    def schema(self) -> dict:
        ends = {"type": "array", "minItems": 2, "maxItems": 2}
        forms = {
            "absolute": {
                "title": f"a standard deviation, {Number(self.dimension, gt=0.0).allowed()}",
                "anyOf": [{"type": "number", "exclusiveMinimum": 0}, WITH_UNIT],
            },
            "relative": {
                "title": 'a standard deviation in per cent, as "2 %"',
                "type": "string",
                "pattern": "%\\s*$",
            },
            "range": {
                "title": "{range = [low, high]}",
                "type": "object",
                "properties": {"range": ends},
                "required": ["range"],
                "additionalProperties": False,
            },
        }
        return {"anyOf": [forms[way] for way in self.ways]}


LengthSpread = Annotated[Spread, SpreadField(LENGTH)]
Modulus = Annotated[Spread, SpreadField(PRESSURE)]
Ratio = Annotated[Spread, SpreadField(DIMENSIONLESS)]
Position = Annotated[Spread, SpreadField(LENGTH, ("absolute", "range"))]
Relative = Annotated[Spread, SpreadField(DIMENSIONLESS, ("relative",))]
Range = Annotated[Spread, SpreadField(LENGTH, ("range",))]


class ScatterSection(SceneSection):
    """How uncertain inputs are. A text in per cent counts from the scene's value. Normal
    distributions are cut off at 3 standard deviations."""

    samples: Annotated[StrictInt, Field(ge=FEWEST, le=MOST)] = optional(
        "of each of two designs by Sobol's sequence; a power of two", 64
    )
    seed: Annotated[StrictInt, Field(ge=0, le=2**32 - 1)] = optional("of the samples", 0)
    roller_radius: LengthSpread | None = optional("radius of the roller")
    roller_youngs_modulus: Modulus | None = optional("its Young's modulus")
    roller_poissons_ratio: Ratio | None = optional("its Poisson's ratio")
    body_youngs_modulus: Modulus | None = optional("Young's modulus of the body")
    body_poissons_ratio: Ratio | None = optional("its Poisson's ratio")
    load: Relative | None = optional("load")
    friction: Ratio | None = optional("the scene's one coefficient")
    position: Position | None = optional("of the roller on the trace")
    noise: Length | None = optional("standard deviation of what is added to the heights")
    correlation_length: Length | None = optional("of the noise; white by default")
    tip_radius: Range | None = optional("of the stylus: crests sharper than the tip are rounded")

    @property
    def inputs(self) -> dict[str, Spread]:
        """Uncertain inputs by name; the noise by its deviation [m]."""
        spreads = {name: spread for name, spread in self if isinstance(spread, Spread)}
        return spreads if self.noise is None else spreads | {"noise": Spread(self.noise)}

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.samples & (self.samples - 1):
            near = 1 << self.samples.bit_length()
            allowed = f"allowed is a power of two, as {near // 2} or {near}"
            yield "samples", f"is {self.samples}; {allowed}"
        if not self.inputs:
            yield "load", 'is missing, as every input is; allowed is at least one, as load = "2 %"'
        if self.correlation_length is not None and self.noise is None:
            yield "correlation_length", "is given without noise; allowed beside it"

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        if scene.load.approach is not None and scene.coating is not None:
            why = (
                "is given with a coating and load.approach, whose load no layer of one solid tells"
            )
            yield "scatter", f"{why}; allowed with per_length"
        for name in OF_PROFILE:
            if name in self.inputs and scene.profile is None:
                yield f"scatter.{name}", "is given for a smooth surface; allowed with [profile]"
        if self.friction is not None and len(scene.load.friction) > 1:
            several = f"is given for {len(scene.load.friction)} coefficients"
            yield "scatter.friction", f"{several}; allowed with one"
        nominals: dict[str, float | None] = {"load": 1.0, "tip_radius": 0.0}
        for name, (section, field) in FIELDS.items():
            value = getattr(getattr(scene, section), field)
            nominals[name] = value[0] if isinstance(value, tuple) else value
        for name, nominal in nominals.items():
            spread, own = getattr(self, name), f"scatter.{name}"
            if spread is not None and nominal is None:
                yield own, f"is given without {'.'.join(FIELDS[name])}; allowed beside it"
            for end in spread.ends(nominal) if None not in (spread, nominal) else ():
                if limits := _limits(name, end, scene):
                    how = "" if spread.range else f" (normal, cut off at {CUT_OFF:g} deviations)"
                    yield own, f"reaches {end:g}{how}; {limits}"


def _limits(name: str, value: float, scene: SceneSection) -> str:
    """Limits of an input that may not have the value; empty where it may."""
    if name not in FIELDS:
        return "" if value > 0.0 else "allowed is above 0"
    section, field = FIELDS[name]
    try:
        read_field(type(getattr(scene, section)), field, value)
    except ValueError as error:
        return str(error).partition("; ")[2]
    return ""


SECTION = ScatterSection
