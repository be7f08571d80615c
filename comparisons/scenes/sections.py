"""The sections of a scene that both models need: bodies, load, fields, tolerances, resolution."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import inf
from typing import Annotated, ClassVar, Self

from pydantic import Field, model_validator

from analytic.material import LAWS, Law, Material
from analytic.material.hardening import Hardening
from comparisons.common.units import (
    DIMENSIONLESS,
    LENGTH,
    LOAD,
    MEMORY,
    PRESSURE,
    TIME,
    Dimension,
    UnitError,
    describe,
    to_si,
)
from comparisons.figures.quantity import QUANTITIES, USUAL
from comparisons.scenes.fields import (
    Extent,
    ExtentField,
    FieldType,
    Fraction,
    Grid,
    Length,
    Named,
    Number,
    OneOf,
    SceneSection,
    Several,
    Truth,
    Whole,
    allowed,
)
from comparisons.scenes.hardening import HardeningField
from comparisons.scenes.materials import ELASTIC, Solid, SolidName, kinds_like, solid_named, solids

MOST_STRESS_POINTS = 50_000_000  # four doubles each are 1.6 GB
MOST_STRESS_LINES = 20_000  # each way: every depth takes transforms of its own

WIDEST_HUB = 0.95  # of the roller's radius
LINEAR = "linear"  # law of elasticity: small strains are the question, of every body

Pressure = Annotated[float, Number(PRESSURE, above=0.0)]
Frictions = Annotated[tuple[float, ...], Several(Number(DIMENSIONLESS, at_least=0.0, at_most=1.5))]
PoissonsRatio = Annotated[float, Number(DIMENSIONLESS, at_least=0.0, below=0.5)]
# Compared quantities that there are with [stress] alone.
OF_STRESS = [name for name, quantity in QUANTITIES.items() if quantity.needs_stress]


class SolidSection(SceneSection):
    """A section that may name a solid, which a file calls its `material`. The solid gives the
    moduli and its law of elasticity, unless they are written beside the name; the measured
    constants of a law belong to the solid's own moduli alone."""

    solid: Annotated[str, SolidName()] | None = Field(None, alias="material")

    @model_validator(mode="before")
    @classmethod
    def _follow_solid(cls, table: object) -> object:
        name = table.get("material") if isinstance(table, Mapping) else None
        solid = solid_named(name) if isinstance(name, str) else None
        if solid is None or table.get("rigid") is True:
            return table
        moduli = {field: solid.values[field].value for field in ELASTIC if field in solid.values}
        follows = {**moduli, **table}
        if "law" in cls.model_fields and solid.law is not None:
            follows |= _law_of(solid, follows)
        return follows

    @property
    def departures(self) -> list[str]:
        """The moduli that are not those of the solid it is named after."""
        if self.solid is None:
            return []
        solid = solids()[self.solid]
        return [
            field
            for field in ELASTIC
            if field in solid.values and not solid.agrees(field, getattr(self, field))
        ]


def _law_of(solid: Solid, table: Mapping) -> dict[str, object]:
    """The law that a table leaves out and that follows from its solid: constants were measured at
    the solid's own moduli, and belong to no others."""
    law, constants = table.get("law"), solid.law.murnaghan
    if constants is None:
        return {} if law or "murnaghan" in table else {"law": solid.law.name}
    if law not in (None, solid.law.name):
        return {}
    if "murnaghan" in table:
        return {"law": solid.law.name}
    if not all(solid.agrees(field, _in_si(table[field], ELASTIC[field])) for field in ELASTIC):
        return {}
    return {"law": solid.law.name, "murnaghan": dict(zip("lmn", constants, strict=True))}


def _in_si(value: object, dimension: Dimension) -> float | None:
    """None for what is no such quantity, which its field then refuses."""
    try:
        return to_si(value, dimension)
    except UnitError:
        return None


class ElasticSection(SolidSection):
    """A body and its law of elasticity at finite strains, neo-Hookean by default, or LINEAR."""

    law: Annotated[str, OneOf((LINEAR, *LAWS))] | None = None
    murnaghan: Annotated[dict[str, float], Named(("l", "m", "n"), Number(PRESSURE))] | None = None

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.law == "murnaghan" and self.murnaghan is None:
            yield "murnaghan", f"is missing; allowed is {allowed(type(self), 'murnaghan')}"
        if self.law != "murnaghan" and self.murnaghan is not None:
            yield "murnaghan", 'is given for another law; allowed with law = "murnaghan"'

    @property
    def kinds(self) -> tuple[str, ...]:
        """The classes of solids that an elastic body may be of: that of the solid it is named
        after, else those of solids with about its constants."""
        if self.solid is not None:
            return (solids()[self.solid].kind,)
        return kinds_like(self.youngs_modulus, self.poissons_ratio)

    @property
    def measured_law(self) -> Law | None:
        """That of the solid it is named after, where it has its measured constants."""
        law = solids()[self.solid].law if self.solid else None
        constants = self.murnaghan and tuple(self.murnaghan.values())
        return law if law is not None and law.murnaghan == constants is not None else None

    @property
    def material(self) -> Material | None:
        """None of a rigid body."""
        law, measured = Law(), self.measured_law
        if self.law not in (None, LINEAR):
            constants = self.murnaghan and tuple(self.murnaghan.values())
            law = Law(self.law, constants, measured and measured.standard_errors)
        return Material(self.youngs_modulus, self.poissons_ratio, law)


@dataclass(frozen=True)
class RollerSupport:
    """What holds an elastic roller: one of PLACES, or a rigid hub or shaft of a radius [m]."""

    place: str | None = None
    hub: float | None = None

    PLACES: ClassVar[tuple[str, ...]] = ("opposite", "half disc")

    def plain(self) -> str | dict[str, float]:
        """As a scene file has it."""
        return self.place or {"hub": self.hub}


@dataclass(frozen=True)
class RollerSupportField(FieldType):
    """A place, or a table {hub = …}."""

    hub = Named(("hub",), Number(LENGTH, above=0.0))

    def read(self, entry: object) -> RollerSupport:
        if isinstance(entry, RollerSupport):
            return entry
        if isinstance(entry, dict):
            return RollerSupport(hub=self.hub.read(entry)["hub"])
        if entry not in RollerSupport.PLACES:
            hint = self.hint(entry, RollerSupport.PLACES)
            raise self.wrong(f"is {describe(entry)}{hint}")
        return RollerSupport(entry)

    def allowed(self) -> str:
        places = ", ".join(f'"{place}"' for place in RollerSupport.PLACES)
        return f'{places} or a table {{hub = …}}, the radius of a hub or shaft such as "2 mm"'


class RollerSection(ElasticSection):
    """The smooth body. Over a periodic surface it is flat: a file has no radius, which is infinite
    once the scene is read."""

    radius: Length | None = None
    rigid: Annotated[bool, Truth()] = False
    support: Annotated[RollerSupport, RollerSupportField()] | None = None
    youngs_modulus: Pressure | None = None
    poissons_ratio: PoissonsRatio | None = None

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from super().broken_rules()
        moduli = {name: getattr(self, name) for name in ELASTIC}
        elastic = {"material": self.solid, "law": self.law, "support": self.support, **moduli}
        for name, value in elastic.items():
            if self.rigid and value is not None:
                yield name, "is given beside rigid = true; allowed is one of the two"
        hub = self.support and self.support.hub
        if hub and self.radius is not None and hub > WIDEST_HUB * self.radius:
            most = f"at most {WIDEST_HUB:g} of the radius, {WIDEST_HUB * self.radius:g} m"
            yield "support", f"has a hub of {hub:g} m; allowed is {most}"
        for name, value in moduli.items():
            if not self.rigid and value is None:
                both = "youngs_modulus with poissons_ratio, or rigid = true"
                yield name, f"is missing; allowed is {both}"

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        if self.radius is None and not (scene.profile and scene.profile.periodic):
            yield "roller.radius", f"is missing; allowed is {allowed(type(self), 'radius')}"

    def completed(self, scene: SceneSection) -> Self:
        return self if self.radius is not None else self.model_copy(update={"radius": inf})

    @property
    def material(self) -> Material | None:
        return None if self.rigid else super().material


class BodySection(ElasticSection):
    youngs_modulus: Pressure
    poissons_ratio: PoissonsRatio
    hardness: Pressure | None = None
    yield_stress: Pressure | None = None
    hardening_modulus: Annotated[float, Number(PRESSURE, at_least=0.0)] | None = None
    hardening: Annotated[dict[str, object], HardeningField()] | None = None
    thickness: Length | None = None
    width: Length | None = None
    base: Annotated[str, OneOf(("bonded", "frictionless"))] | None = None

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from super().broken_rules()
        if self.base is not None and self.thickness is None:
            yield "base", "is given for a half-plane, which has none; allowed only with thickness"
        for name in ("hardening_modulus", "hardening"):
            if getattr(self, name) is not None and self.yield_stress is None:
                problem = "is given for a body that does not yield; allowed only with yield_stress"
                yield name, problem
        if self.hardening is not None and self.yield_stress is not None:
            try:
                self.flow_stress()
            except ValueError as error:
                right = allowed(type(self), "hardening")
                yield "hardening", f"is no law: {error}; allowed is {right}"

    def flow_stress(self) -> Hardening:
        """Of a body with a yield stress; raises ValueError, in one line, where it is no law."""
        law = self.hardening or {}
        named = {name: tuple(law[name].values()) for name in HardeningField.LAWS if name in law}
        modulus, table = self.hardening_modulus or 0.0, law.get("table")
        kinematic = law.get("kinematic", 0.0)
        return Hardening(self.yield_stress, modulus, table=table, kinematic=kinematic, **named)

    def completed(self, scene: SceneSection) -> Self:
        is_layer = self.thickness is not None
        return self.model_copy(update={"base": self.base or "bonded"}) if is_layer else self


class CoatingSection(ElasticSection):
    """Bonded to the body."""

    thickness: Length
    youngs_modulus: Pressure
    poissons_ratio: PoissonsRatio


class LoadSection(SceneSection):
    """One kind of load: `per_length` [N/m], `hertz_peak_pressure` [Pa] of the smooth pair,
    `approach` [m], or `mean_pressure` [Pa] on a periodic surface."""

    per_length: Annotated[float, Number(LOAD, above=0.0)] | None = None
    hertz_peak_pressure: Pressure | None = None
    approach: Length | None = None
    mean_pressure: Pressure | None = None
    friction: Frictions = (0.0,)
    position: Annotated[float, Number(LENGTH)] | None = None
    coupled: Annotated[bool, Truth()] = False

    KINDS: ClassVar[tuple[str, ...]] = (
        "per_length",
        "hertz_peak_pressure",
        "approach",
        "mean_pressure",
    )

    @property
    def kind(self) -> str:
        """The one load that is given."""
        return next(name for name in self.KINDS if getattr(self, name) is not None)

    @property
    def value(self) -> float:
        return getattr(self, self.kind)

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from self.unless_one_of(self.KINDS, ", ")

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        for there, where, needed in (
            (scene.body.thickness is not None, "on a half-plane", "body.thickness"),
            (scene.roller.rigid, "for an elastic roller", "roller.rigid = true"),
        ):
            if self.approach is not None and not there:
                why = f"has no meaning {where}, whose displacement has no datum"
                yield "load.approach", f"{why}; allowed is per_length, or approach with {needed}"
        if self.position and scene.profile is None and scene.body.width is None:
            why = "is on a smooth body without ends, which is the same everywhere"
            yield "load.position", f"{why}; allowed is 0, or one beside [profile] or body.width"
        if self.mean_pressure is not None and not (scene.profile and scene.profile.periodic):
            where = "under a roller, whose load is per length"
            yield "load.mean_pressure", f"is given {where}; allowed with profile.periodic = true"


class StressSection(SceneSection):
    """The points of the subsurface field: |x| <= half_range (None: about the contact), 0 <= z <=
    depth; `points` (nx, nz)."""

    STEP = "subsurface stresses"
    depth: Annotated[Extent, ExtentField()] = Extent(1.0, in_half_widths=True)
    half_range: Annotated[Extent, ExtentField()] | None = None
    points: Annotated[tuple[int, int], Grid(MOST_STRESS_POINTS, MOST_STRESS_LINES)] = (600, 200)


class ToleranceSection(SceneSection):
    peak_pressure: Fraction = USUAL
    contact_length: Fraction = USUAL
    tau1_max: Fraction = USUAL
    tau1_max_depth: Fraction | None = None
    txz_max_abs: Fraction | None = None

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        for name in OF_STRESS:
            if scene.stress is None and name in self.model_fields_set:
                others = ", ".join(sorted(set(QUANTITIES) - set(OF_STRESS)))
                problem = f"needs a [stress] section; allowed is {others} without one"
                yield f"tolerance.{name}", problem


class ResolutionSection(SceneSection):
    """`pitch` [m] of the coarsest pressure elements, or `elements` of them on a half-width of the
    smooth contact, or `nodes` of the finest of the first levels (none: automatic), and `levels` to
    begin with."""

    pitch: Length | None = None
    elements: Annotated[float, Number(DIMENSIONLESS, at_least=1.0, at_most=1e4)] | None = None
    nodes: Annotated[int, Whole(64, 2_000_000)] | None = None
    levels: Annotated[int, Whole(2, 6)] = 3

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.pitch is not None and self.elements is not None:
            yield "elements", "is given beside pitch; allowed is one of the two"
        if self.nodes is not None and (self.pitch or self.elements):
            beside = "pitch" if self.pitch else "elements"
            yield "nodes", f"is given beside {beside}; allowed is one of the two"


class BudgetSection(SceneSection):
    """What a run may take: `time` [s] by the laws of cost, not by a clock, and `memory` [bytes];
    whether it computes `effects` that the scene's finite elements do not model, and where "all",
    those too that cannot change a verdict."""

    time: Annotated[float, Number(TIME, above=0.0)] = 300.0
    memory: Annotated[float, Number(MEMORY, above=0.0)] = 8e9
    effects: Annotated[bool | str, Truth(("all",))] = True
