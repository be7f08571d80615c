"""The sections of a scene that both models need: bodies, load, fields, tolerances, resolution."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from math import inf
from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, StrictBool, StrictInt, model_validator

from analytic.material import LAWS, Law, Material
from analytic.material.hardening import Hardening
from comparisons.common.units import (
    DIMENSIONLESS,
    LENGTH,
    LOAD,
    MEMORY,
    PRESSURE,
    TIME,
    UnitError,
    to_si,
)
from comparisons.figures.quantity import QUANTITIES, USUAL
from comparisons.scenes.fields import (
    Extent,
    ExtentField,
    Fraction,
    Length,
    Number,
    Pressure,
    SceneSection,
    Several,
    optional,
)
from comparisons.scenes.hardening import HardeningSection
from comparisons.scenes.materials import ELASTIC, Solid, SolidName, kinds_like, solid_named, solids

MOST_STRESS_POINTS = 50_000_000  # four doubles each are 1.6 GB
MOST_STRESS_LINES = 20_000  # each way: every depth takes transforms of its own

WIDEST_HUB = 0.95  # of the roller's radius
LINEAR = "linear"  # law of elasticity: small strains are the question, of every body

Friction = Annotated[float, Number(DIMENSIONLESS, ge=0.0, le=1.5)]
PoissonsRatio = Annotated[float, Number(DIMENSIONLESS, ge=0.0, lt=0.5)]
Constant = Annotated[float, Number(PRESSURE)]
Points = Annotated[StrictInt, Field(ge=3, le=MOST_STRESS_LINES)]
# Compared quantities that there are with [stress] alone.
OF_STRESS = [name for name, quantity in QUANTITIES.items() if quantity.needs_stress]


class MurnaghanSection(SceneSection):
    """Constants of Murnaghan's law."""

    l: Constant = Field(description="third-order constant")  # noqa: E741 (as the law names it)
    m: Constant = Field(description="third-order constant")
    n: Constant = Field(description="third-order constant")

    @property
    def constants(self) -> tuple[float, float, float]:
        return self.l, self.m, self.n


class ElasticSection(SceneSection):
    """A body, which may be named after a solid, and its law of elasticity at finite strains: that
    of the solid, else neo-Hookean, or LINEAR."""

    FOLLOW = tuple(ELASTIC)
    solid: Annotated[str, SolidName()] | None = optional(
        "a solid of `crosscheck materials`: gives its moduli, its measured law and, "
        "with `[heat]`, thermal constants; fields beside it win",
        alias="material",
    )
    law: Literal[(LINEAR, *LAWS)] | None = optional(
        "of elasticity at finite strains; of the material, else a range of published "
        'solids; `"linear"`, of every elastic body: nothing deforms finitely'
    )
    murnaghan: MurnaghanSection | None = optional("third-order constants, with that law")

    @model_validator(mode="before")
    @classmethod
    def _follow_solid(cls, table: object) -> object:
        solid = solid_named(table.get("material")) if isinstance(table, Mapping) else None
        if solid is None or table.get("rigid") is True:
            return table
        moduli = {field: solid.values[field].value for field in ELASTIC if field in solid.values}
        follows = {**moduli, **table}
        if solid.law is not None:
            follows |= _law_of(solid, follows)
        return follows

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.law == "murnaghan" and self.murnaghan is None:
            yield "murnaghan", "is missing"
        if self.law != "murnaghan" and self.murnaghan is not None:
            yield "murnaghan", 'is given for another law; allowed with law = "murnaghan"'

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

    @property
    def kinds(self) -> tuple[str, ...]:
        """The classes of solids that an elastic body may be of: that of the solid it is named
        after, else those of solids with about its constants."""
        if self.solid is not None:
            return (solids()[self.solid].kind,)
        return kinds_like(self.youngs_modulus, self.poissons_ratio)

    @property
    def measured_law(self) -> Law | None:
        """Law of the solid it is named after, where it has its measured constants."""
        law = solids()[self.solid].law if self.solid else None
        constants = self.murnaghan and self.murnaghan.constants
        return law if law is not None and law.murnaghan == constants is not None else None

    @property
    def material(self) -> Material | None:
        """Elastic material; None of a rigid body."""
        law, measured = Law(), self.measured_law
        if self.law not in (None, LINEAR):
            constants = self.murnaghan and self.murnaghan.constants
            law = Law(self.law, constants, measured and measured.standard_errors)
        return Material(self.youngs_modulus, self.poissons_ratio, law)


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
    with suppress(UnitError):  # of what is no such quantity, which its field then refuses
        if all(solid.agrees(field, to_si(table[field], ELASTIC[field])) for field in ELASTIC):
            return {"law": solid.law.name, "murnaghan": dict(zip("lmn", constants, strict=True))}
    return {}


class HubSection(SceneSection):
    """Rigid hub or shaft of a roller."""

    hub: Length = Field(description="radius of a hub or shaft", examples=["2 mm"])


class RollerSection(ElasticSection):
    """Smooth body. Over a periodic surface it is flat."""

    radius: Length | None = optional(
        "radius of relative curvature of the pair; needed, but over a periodic "
        "surface, where the smooth body is flat"
    )
    rigid: StrictBool = optional("the roller keeps its shape; in place of the next two", False)
    youngs_modulus: Pressure | None = optional("Young's modulus; needed unless `rigid`")
    poissons_ratio: PoissonsRatio | None = optional("Poisson's ratio; needed unless `rigid`")
    support: Literal["opposite", "half disc"] | HubSection | None = optional(
        "what holds an elastic roller as a disc"
    )

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from super().broken_rules()
        moduli = {name: getattr(self, name) for name in ELASTIC}
        elastic = {"material": self.solid, "law": self.law, "support": self.support, **moduli}
        for name, value in elastic.items():
            if self.rigid and value is not None:
                yield name, "is given beside rigid = true; allowed is one of the two"
        hub = self.hub
        if hub is not None and self.radius is not None and hub > WIDEST_HUB * self.radius:
            most = f"at most {WIDEST_HUB:g} of the radius, {WIDEST_HUB * self.radius:g} m"
            yield "support", f"has a hub of {hub:g} m; allowed is {most}"
        for name, value in moduli.items():
            if not self.rigid and value is None:
                both = "youngs_modulus with poissons_ratio, or rigid = true"
                yield name, f"is missing; allowed is {both}"

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        if self.radius is None and not (scene.profile and scene.profile.periodic):
            yield "roller.radius", "is missing"

    def completed(self, scene: SceneSection) -> Self:
        return self if self.radius is not None else self.model_copy(update={"radius": inf})

    @property
    def hub(self) -> float | None:
        """Radius [m] of the hub or shaft that holds it, None where it is held otherwise."""
        return self.support.hub if isinstance(self.support, HubSection) else None

    @property
    def material(self) -> Material | None:
        return None if self.rigid else super().material


class BodySection(ElasticSection):
    """Rough body."""

    youngs_modulus: Pressure = Field(description="Young's modulus")
    poissons_ratio: PoissonsRatio = Field(description="Poisson's ratio")
    hardness: Pressure | None = optional("cap on the contact pressure")
    yield_stress: Pressure | None = optional(
        "in tension; the verdict then says how far beyond first flow the load is"
    )
    hardening_modulus: Annotated[float, Number(PRESSURE, ge=0.0)] | None = optional(
        "stress per plastic strain, with `yield_stress`"
    )
    hardening: HardeningSection | None = optional(
        "another law, with `yield_stress` Y: true stress in tension over the "
        "logarithmic plastic strain k"
    )
    thickness: Length | None = optional("a layer on a rigid base; without it a half-plane")
    width: Length | None = optional("a block between free sides; without it unbounded")
    base: Literal["bonded", "frictionless"] | None = optional(
        "what holds the layer, with `thickness`; bonded by default"
    )

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
                yield "hardening", f"is no law: {error}"

    def flow_stress(self) -> Hardening:
        """Flow stress of a body with a yield stress; ValueError, one line, where it is no law."""
        laws = self.hardening.laws if self.hardening else {}
        return Hardening(self.yield_stress, self.hardening_modulus or 0.0, **laws)

    def completed(self, scene: SceneSection) -> Self:
        is_layer = self.thickness is not None
        return self.model_copy(update={"base": self.base or "bonded"}) if is_layer else self


class CoatingSection(ElasticSection):
    """Layer bonded to the body. The finite elements have it."""

    thickness: Length = Field(description="of the layer bonded to the body")
    youngs_modulus: Pressure = Field(description="Young's modulus")
    poissons_ratio: PoissonsRatio = Field(description="Poisson's ratio")


class LoadSection(SceneSection):
    """Load that presses the roller on, by one of the first four fields. Sliding traction is
    friction times pressure and pulls the rough body towards +x."""

    per_length: Annotated[float, Number(LOAD, gt=0.0)] | None = optional("load; one of these four")
    hertz_peak_pressure: Pressure | None = optional("peak pressure of the smooth pair")
    approach: Length | None = optional("of a rigid roller to a layer")
    mean_pressure: Pressure | None = optional("of a flat body on a periodic surface")
    friction: Annotated[tuple[Friction, ...], Several()] = optional(
        "coefficient; several give a result for each", (0.0,)
    )
    position: Annotated[float, Number(LENGTH)] | None = optional(
        "of the roller's centre on the trace; the middle by default, on a periodic "
        "surface half a period from its lowest point"
    )
    coupled: StrictBool = optional("sliding traction moves the surfaces in both models", False)

    KINDS: ClassVar = ("per_length", "hertz_peak_pressure", "approach", "mean_pressure")

    @property
    def kind(self) -> str:
        """The one load that is given."""
        return next(name for name in self.KINDS if getattr(self, name) is not None)

    @property
    def value(self) -> float:
        return getattr(self, self.kind)

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from self.unless_one_of(self.KINDS)

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
    """Points of the field below the surface; without this table none is computed. A plain number
    counts half-widths of the smooth contact."""

    STEP = "subsurface stresses"
    depth: Annotated[Extent, ExtentField()] = optional(
        "down to which the field reaches", Extent(1.0, in_half_widths=True)
    )
    half_range: Annotated[Extent, ExtentField()] | None = optional(
        "to both sides of the roller's centre, 1.5 half-widths by default; about the "
        "contact where that lies beyond"
    )
    points: tuple[Points, Points] = optional("along x and z, at most 50 million in all", (600, 200))

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if (count := self.points[0] * self.points[1]) > MOST_STRESS_POINTS:
            yield "points", f"asks for {count} points; allowed are {MOST_STRESS_POINTS} in all"


class ToleranceSection(SceneSection):
    """Relative tolerances. Quantities without one are shown only. Those of stresses need
    `[stress]`."""

    peak_pressure: Fraction = optional("largest pressure", USUAL)
    contact_length: Fraction = optional("sum of the patches that touch", USUAL)
    tau1_max: Fraction = optional("largest principal shear stress", USUAL)
    tau1_max_depth: Fraction | None = optional("depth of the largest principal shear stress")
    txz_max_abs: Fraction | None = optional("largest orthogonal shear stress")

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        for name in OF_STRESS:
            if scene.stress is None and name in self.model_fields_set:
                others = ", ".join(sorted(set(QUANTITIES) - set(OF_STRESS)))
                problem = f"needs a [stress] section; allowed is {others} without one"
                yield f"tolerance.{name}", problem


class ResolutionSection(SceneSection):
    """How fine a run begins."""

    pitch: Length | None = optional("of the coarsest pressure elements")
    elements: Annotated[float, Number(DIMENSIONLESS, ge=1.0, le=1e4)] | None = optional(
        "or their number on a half-width of the smooth contact; without all three as "
        "the surface asks for"
    )
    nodes: Annotated[StrictInt, Field(ge=64, le=2_000_000)] | None = optional(
        "or pressures of the finest of the first levels, at least; "
        "`--models half-plane` takes a million in seconds"
    )
    levels: Annotated[StrictInt, Field(ge=2, le=6)] = optional("to begin with", 3)

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from self.unless_one_of(("pitch", "elements", "nodes"), or_none=True)


class BudgetSection(SceneSection):
    """Limits of a run, at which refinement ends."""

    time: Annotated[float, Number(TIME, gt=0.0)] = optional(
        "of a run, counted by the laws of cost and not by a clock", 300.0
    )
    memory: Annotated[float, Number(MEMORY, gt=0.0)] = optional("of the finite elements", 8e9)
    effects: StrictBool | Literal["all"] = optional(
        'compute the effects that may matter; `"all"`: those too that cannot change a verdict', True
    )
