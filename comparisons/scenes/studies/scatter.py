"""The [scatter] section: by how much inputs of the scene are uncertain."""

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal
from typing import Annotated

from comparisons.common.units import DIMENSIONLESS, LENGTH, PRESSURE, Dimension, describe
from comparisons.scenes.fields import FieldType, Length, Number, SceneSection, Whole, field_type

CUT_OFF = 3.0  # standard deviations beyond which an uncertain input is not sampled
FEWEST, MOST = 8, 4096  # samples
# Inputs that are fields of the scene, with their section; the load is a field of two kinds.
FIELDS = {
    "roller_radius": ("roller", "radius"),
    "roller_youngs_modulus": ("roller", "youngs_modulus"),
    "roller_poissons_ratio": ("roller", "poissons_ratio"),
    "body_youngs_modulus": ("body", "youngs_modulus"),
    "body_poissons_ratio": ("body", "poissons_ratio"),
    "friction": ("load", "friction"),
}
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
        """As a scene file has it."""
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
            raise self.wrong(f"is {describe(entry)}")
        value = self.in_si(entry, self.dimension if way == "absolute" else DIMENSIONLESS)
        if not value > 0.0:
            raise self.wrong(f"is {describe(entry)}")
        return Spread(value, relative=way == "relative")

    def _range(self, entry: dict) -> Spread:
        ends = entry.get("range")
        if set(entry) != {"range"} or not isinstance(ends, list | tuple) or len(ends) != 2:
            raise self.wrong("is a table that is no range of two values")
        low, high = (self.in_si(end, self.dimension) for end in ends)
        if not low < high:
            raise self.wrong(f"has a range from {low:g} to {high:g}")
        return Spread(range=(low, high))

    def allowed(self) -> str:
        number = Number(self.dimension, above=0.0).allowed()
        words = {
            "absolute": f"a standard deviation, {number}",
            "relative": 'a standard deviation in per cent, as "2 %"',
            "range": "{range = [low, high]}",
        }
        return ", or ".join(words[way] for way in self.ways)


Modulus = Annotated[Spread, SpreadField(PRESSURE)] | None
Ratio = Annotated[Spread, SpreadField(DIMENSIONLESS)] | None


class ScatterSection(SceneSection):
    """Inputs by name. `samples` of each of two independent designs, a power of two, after Sobol;
    `correlation_length` [m] of the noise, by default white."""

    samples: Annotated[int, Whole(FEWEST, MOST)] = 64
    seed: Annotated[int, Whole(0, 2**32 - 1)] = 0
    roller_radius: Annotated[Spread, SpreadField(LENGTH)] | None = None
    roller_youngs_modulus: Modulus = None
    roller_poissons_ratio: Ratio = None
    body_youngs_modulus: Modulus = None
    body_poissons_ratio: Ratio = None
    load: Annotated[Spread, SpreadField(PRESSURE, ("relative",))] | None = None
    friction: Ratio = None
    position: Annotated[Spread, SpreadField(LENGTH, ("absolute", "range"))] | None = None
    noise: Length | None = None
    correlation_length: Length | None = None
    tip_radius: Annotated[Spread, SpreadField(LENGTH, ("range",))] | None = None

    @property
    def inputs(self) -> dict[str, Spread]:
        """What is uncertain, by name; of the noise its deviation [m]."""
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
        limits: dict[str, tuple[float | None, FieldType]] = {
            "load": (1.0, Number(DIMENSIONLESS, above=0.0)),
            "tip_radius": (0.0, Number(LENGTH, above=0.0)),
        }
        for name, (section, field) in FIELDS.items():
            table = getattr(scene, section)
            nominal = getattr(table, field)
            nominal = nominal[0] if isinstance(nominal, tuple) else nominal
            limits[name] = nominal, field_type(type(table), field)
        for name, (nominal, field) in limits.items():
            spread = getattr(self, name)
            if spread is not None and nominal is None:
                yield (
                    f"scatter.{name}",
                    f"is given without {'.'.join(FIELDS[name])}; allowed beside it",
                )
            for end in spread.ends(nominal) if None not in (spread, nominal) else ():
                try:
                    field.read(end)
                except ValueError:
                    how = "" if spread.range else f" (normal, cut off at {CUT_OFF:g} deviations)"
                    yield f"scatter.{name}", f"reaches {end:g}{how}; allowed is {field.allowed()}"


SECTION = ScatterSection
