"""A scene file as tables: which sections and fields there are, and what must hold between them.

Field types are in `scene_fields`; every validator here is a rule between fields, and raises
FieldError so that the message can name the field that is to be changed.
"""

from typing import Annotated, ClassVar

from pydantic import model_validator

from comparisons.common.quantities import QUANTITIES
from comparisons.common.units import DIMENSIONLESS, LENGTH, LOAD, MEMORY, PRESSURE, TIME
from comparisons.scenes.scene import Extent
from comparisons.scenes.schema.fields import (
    Choice,
    ExtentField,
    Grid,
    Number,
    Several,
    Text,
    Truth,
    Whole,
)
from comparisons.scenes.schema.finite_element import FiniteElementTable
from comparisons.scenes.schema.profile import ProfileTable
from comparisons.scenes.schema.running_in import RunningInTable
from comparisons.scenes.schema.section import FieldError, Fraction, Length, Table

MOST_STRESS_POINTS = 50_000_000  # four doubles each are 1.6 GB

Pressure = Annotated[float, Number(PRESSURE, above=0.0)]
Frictions = Annotated[tuple[float, ...], Several(Number(DIMENSIONLESS, at_least=0.0, at_most=1.5))]
PoissonsRatio = Annotated[float, Number(DIMENSIONLESS, at_least=0.0, below=0.5)]


class RollerTable(Table):
    radius: Length
    rigid: Annotated[bool, Truth()] = False
    youngs_modulus: Pressure | None = None
    poissons_ratio: PoissonsRatio | None = None

    @model_validator(mode="after")
    def _elastic_or_rigid(self) -> "RollerTable":
        for name in ("youngs_modulus", "poissons_ratio"):
            given = getattr(self, name) is not None
            if self.rigid and given:
                raise FieldError(
                    name, "is given beside rigid = true; allowed is either, a rigid roller has none"
                )
            if not self.rigid and not given:
                raise FieldError(
                    name,
                    "is missing; allowed is youngs_modulus with poissons_ratio, or rigid = true",
                )
        return self


class BodyTable(Table):
    youngs_modulus: Pressure
    poissons_ratio: PoissonsRatio
    hardness: Pressure | None = None
    yield_stress: Pressure | None = None
    hardening_modulus: Annotated[float, Number(PRESSURE, at_least=0.0)] | None = None
    thickness: Length | None = None
    width: Length | None = None
    base: Annotated[str, Choice(("bonded", "frictionless"))] | None = None

    @model_validator(mode="after")
    def _base_of_a_layer(self) -> "BodyTable":
        if self.base is not None and self.thickness is None:
            raise FieldError(
                "base", "is given for a half-plane, which has none; allowed only with thickness"
            )
        return self

    @model_validator(mode="after")
    def _hardening_of_what_yields(self) -> "BodyTable":
        if self.hardening_modulus is not None and self.yield_stress is None:
            raise FieldError(
                "hardening_modulus",
                "is given for a body that does not yield; allowed only with yield_stress",
            )
        return self


class CoatingTable(Table):
    thickness: Length
    youngs_modulus: Pressure
    poissons_ratio: PoissonsRatio


class LoadTable(Table):
    per_length: Annotated[float, Number(LOAD, above=0.0)] | None = None
    hertz_peak_pressure: Pressure | None = None
    approach: Length | None = None
    friction: Frictions = (0.0,)
    position: Annotated[float, Number(LENGTH)] | None = None
    coupled: Annotated[bool, Truth()] = False

    KINDS: ClassVar[tuple[str, ...]] = ("per_length", "hertz_peak_pressure", "approach")

    @property
    def kind(self) -> str:
        """The one load that is given."""
        return next(name for name in self.KINDS if getattr(self, name) is not None)

    @model_validator(mode="after")
    def _one_load(self) -> "LoadTable":
        given = [name for name in self.KINDS if getattr(self, name) is not None]
        if len(given) != 1:
            raise FieldError(
                given[1] if given else "per_length",
                f"is {f'given beside {given[0]}' if given else 'missing'}; "
                "allowed is exactly one of " + ", ".join(self.KINDS),
            )
        return self

    @model_validator(mode="after")
    def _one_friction_where_it_moves_the_contact(self) -> "LoadTable":
        if self.coupled and len(self.friction) != 1:
            raise FieldError(
                "coupled",
                f"is true with {len(self.friction)} friction coefficients, each of which has "
                "pressures of its own then; allowed is one friction coefficient",
            )
        return self


class StressTable(Table):
    depth: Annotated[Extent, ExtentField()] = Extent(1.0, in_half_widths=True)
    half_range: Annotated[Extent, ExtentField()] = Extent(1.5, in_half_widths=True)
    points: Annotated[tuple[int, int], Grid(MOST_STRESS_POINTS)] = (600, 200)


class ToleranceTable(Table):
    peak_pressure: Fraction = 0.02
    contact_length: Fraction = 0.02
    tau1_max: Fraction = 0.02
    contact_ratio: Fraction | None = None
    pressure_l2: Fraction | None = None
    tau1_max_depth: Fraction | None = None
    txz_max_abs: Fraction | None = None
    tau1_field_near: Fraction | None = None
    tau1_field_deep: Fraction | None = None


class ResolutionTable(Table):
    pitch: Length | None = None
    levels: Annotated[int, Whole(2, 6)] = 3


class BudgetTable(Table):
    time: Annotated[float, Number(TIME, above=0.0)] = 300.0
    memory: Annotated[float, Number(MEMORY, above=0.0)] = 8e9
    effects: Annotated[bool, Truth()] = True


class SceneTables(Table):
    """The whole file."""

    title: Annotated[str, Text("what the scene shows")] | None = None
    roller: RollerTable
    body: BodyTable
    coating: CoatingTable | None = None
    profile: ProfileTable | None = None
    load: LoadTable
    running_in: RunningInTable | None = None
    stress: StressTable | None = None
    tolerance: ToleranceTable = ToleranceTable()
    finite_element: FiniteElementTable = FiniteElementTable()
    resolution: ResolutionTable = ResolutionTable()
    budget: BudgetTable = BudgetTable()

    @model_validator(mode="after")
    def _approach_has_a_datum(self) -> "SceneTables":
        if self.load.approach is None:
            return self
        if self.body.thickness is None:
            raise FieldError(
                "load.approach",
                "has no meaning on a half-plane, whose displacement has no datum; "
                "allowed is per_length or hertz_peak_pressure, or approach with body.thickness",
            )
        if not self.roller.rigid:
            raise FieldError(
                "load.approach",
                "has no meaning for an elastic roller, whose displacement has no datum; allowed "
                "is per_length or hertz_peak_pressure, or approach with roller.rigid = true",
            )
        return self

    @model_validator(mode="after")
    def _running_in_has_what_it_takes(self) -> "SceneTables":
        if self.running_in is not None:
            self.running_in.check(self.profile, self.body.hardness, self.load.kind)
        return self

    @model_validator(mode="after")
    def _finite_elements_have_what_they_take(self) -> "SceneTables":
        self.finite_element.check(self.roller, self.body, self.load, self.profile, self.coating)
        return self

    @model_validator(mode="after")
    def _coating_is_on_something(self) -> "SceneTables":
        if self.coating is None:
            return self
        thickness = self.body.thickness
        if thickness is not None and self.coating.thickness >= thickness:
            raise FieldError(
                "coating.thickness",
                f"is {self.coating.thickness:g} m on a body of {thickness:g} m; allowed is less, "
                "the body's thickness contains it",
            )
        if self.finite_element.plastic:
            raise FieldError(
                "finite_element.plastic",
                "is true for a coated body; allowed without [coating]",
            )
        return self

    @model_validator(mode="after")
    def _friction_is_held(self) -> "SceneTables":
        body = self.body
        if body.base == "frictionless" and body.width is not None and max(self.load.friction) > 0.0:
            raise FieldError(
                "load.friction",
                f"is {max(self.load.friction):g} on a body of finite width on a frictionless base, "
                'which nothing would hold; allowed is friction = 0, base = "bonded" or no width',
            )
        return self

    @model_validator(mode="after")
    def _judged_stress_is_asked_for(self) -> "SceneTables":
        if self.stress is None:
            for name in _of_stress():
                if name in self.tolerance.model_fields_set:
                    raise FieldError(
                        f"tolerance.{name}",
                        "needs a [stress] section; allowed is "
                        + ", ".join(sorted(set(QUANTITIES) - set(_of_stress())))
                        + " without one",
                    )
        return self


SECTIONS: dict[str, type[Table]] = {
    "roller": RollerTable,
    "body": BodyTable,
    "coating": CoatingTable,
    "profile": ProfileTable,
    "load": LoadTable,
    "running_in": RunningInTable,
    "stress": StressTable,
    "tolerance": ToleranceTable,
    "finite_element": FiniteElementTable,
    "resolution": ResolutionTable,
    "budget": BudgetTable,
}


def plain_tables(scene: SceneTables) -> dict:
    """The scene as a file would have it: defaults written out, SI numbers, no None.

    Reading the result as a scene gives the same scene. JSON and TOML can hold it.
    """
    plain = _plain(scene)
    if scene.stress is None:  # defaults that have nothing to judge
        for name in _of_stress():
            plain["tolerance"].pop(name, None)
    return plain


def _of_stress() -> list[str]:
    """Compared quantities that there are with [stress] alone."""
    return [name for name, quantity in QUANTITIES.items() if quantity.needs_stress]


def _plain(value: object) -> object:
    if isinstance(value, Table):
        pairs = ((name, getattr(value, name)) for name in type(value).model_fields)
        return {name: _plain(item) for name, item in pairs if item is not None}
    if isinstance(value, Extent):
        return value.value if value.in_half_widths else f"{value.value!r} m"
    return [_plain(item) for item in value] if isinstance(value, tuple) else value
