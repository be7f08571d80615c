"""A scene file as tables: which sections and fields there are, and what must hold between them.

What is wrong is one line: "file: section.field: problem; allowed is …"."""

from collections.abc import Iterator
from decimal import Decimal
from typing import Annotated, ClassVar, get_args

from pydantic import ValidationError

from analytic.material import LAWS
from comparisons.common.errors import SceneError, nearest
from comparisons.common.units import DIMENSIONLESS, LENGTH, LOAD, MEMORY, PRESSURE, TIME, describe
from comparisons.figures.quantity import QUANTITIES
from comparisons.scenes.scene import Extent, Spread
from comparisons.scenes.schema.answers import AnswerSection, wrong_name
from comparisons.scenes.schema.fields import (
    ExtentField,
    FieldError,
    Fraction,
    Grid,
    Length,
    Named,
    Number,
    OneOf,
    SceneSection,
    Several,
    Text,
    Truth,
    Whole,
    allowed,
)
from comparisons.scenes.schema.finite_element import SEVERAL_FRICTIONS, FiniteElementSection
from comparisons.scenes.schema.heat import HeatSection
from comparisons.scenes.schema.profile import ProfileSection
from comparisons.scenes.schema.running_in import RunningInSection
from comparisons.scenes.schema.scatter import ScatterSection
from comparisons.scenes.schema.statistics import StatisticsSection

MOST_STRESS_POINTS = 50_000_000  # four doubles each are 1.6 GB
MOST_STRESS_LINES = 20_000  # each way: every depth takes transforms of its own

Pressure = Annotated[float, Number(PRESSURE, above=0.0)]
Frictions = Annotated[tuple[float, ...], Several(Number(DIMENSIONLESS, at_least=0.0, at_most=1.5))]
PoissonsRatio = Annotated[float, Number(DIMENSIONLESS, at_least=0.0, below=0.5)]


class ElasticSection(SceneSection):
    """A body and its law of elasticity at finite strains, neo-Hookean by default."""

    law: Annotated[str, OneOf(LAWS)] | None = None
    murnaghan: Annotated[dict[str, float], Named(("l", "m", "n"), Number(PRESSURE))] | None = None

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.law == "murnaghan" and self.murnaghan is None:
            yield "murnaghan", f"is missing; allowed is {allowed(type(self), 'murnaghan')}"
        if self.law != "murnaghan" and self.murnaghan is not None:
            yield "murnaghan", 'is given for another law; allowed with law = "murnaghan"'


class RollerSection(ElasticSection):
    radius: Length
    rigid: Annotated[bool, Truth()] = False
    youngs_modulus: Pressure | None = None
    poissons_ratio: PoissonsRatio | None = None

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from super().broken_rules()
        if self.rigid and self.law is not None:
            yield "law", "is given beside rigid = true; allowed is one of the two"
        for name in ("youngs_modulus", "poissons_ratio"):
            given = getattr(self, name) is not None
            if self.rigid and given:
                yield name, "is given beside rigid = true; allowed is one of the two"
            if not self.rigid and not given:
                both = "youngs_modulus with poissons_ratio, or rigid = true"
                yield name, f"is missing; allowed is {both}"


class BodySection(ElasticSection):
    youngs_modulus: Pressure
    poissons_ratio: PoissonsRatio
    hardness: Pressure | None = None
    yield_stress: Pressure | None = None
    hardening_modulus: Annotated[float, Number(PRESSURE, at_least=0.0)] | None = None
    thickness: Length | None = None
    width: Length | None = None
    base: Annotated[str, OneOf(("bonded", "frictionless"))] | None = None

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from super().broken_rules()
        if self.base is not None and self.thickness is None:
            yield "base", "is given for a half-plane, which has none; allowed only with thickness"
        if self.hardening_modulus is not None and self.yield_stress is None:
            problem = "is given for a body that does not yield; allowed only with yield_stress"
            yield "hardening_modulus", problem


class CoatingSection(SceneSection):
    thickness: Length
    youngs_modulus: Pressure
    poissons_ratio: PoissonsRatio


class LoadSection(SceneSection):
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

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from self.unless_one_of(self.KINDS, ", ")
        if self.coupled and len(self.friction) != 1:
            yield "coupled", SEVERAL_FRICTIONS.format(len(self.friction))


class StressWindowSection(SceneSection):
    depth: Annotated[Extent, ExtentField()] = Extent(1.0, in_half_widths=True)
    half_range: Annotated[Extent, ExtentField()] = Extent(1.5, in_half_widths=True)
    points: Annotated[tuple[int, int], Grid(MOST_STRESS_POINTS, MOST_STRESS_LINES)] = (600, 200)
    bulge: Annotated[bool, Truth()] = False


class ToleranceSection(SceneSection):
    peak_pressure: Fraction = 0.02
    contact_length: Fraction = 0.02
    tau1_max: Fraction = 0.02
    contact_ratio: Fraction | None = None
    pressure_l2: Fraction | None = None
    tau1_max_depth: Fraction | None = None
    txz_max_abs: Fraction | None = None
    tau1_field_near: Fraction | None = None
    tau1_field_deep: Fraction | None = None


class ResolutionSection(SceneSection):
    pitch: Length | None = None
    elements: Annotated[float, Number(DIMENSIONLESS, at_least=1.0, at_most=1e4)] | None = None
    levels: Annotated[int, Whole(2, 6)] = 3

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.pitch is not None and self.elements is not None:
            yield "elements", "is given beside pitch; allowed is one of the two"


class BudgetSection(SceneSection):
    time: Annotated[float, Number(TIME, above=0.0)] = 300.0
    memory: Annotated[float, Number(MEMORY, above=0.0)] = 8e9
    effects: Annotated[bool | str, Truth(("all",))] = True


class SceneFile(SceneSection):
    """The whole file."""

    title: Annotated[str, Text("what the scene shows")] | None = None
    roller: RollerSection
    body: BodySection
    coating: CoatingSection | None = None
    profile: ProfileSection | None = None
    load: LoadSection
    running_in: RunningInSection | None = None
    stress: StressWindowSection | None = None
    tolerance: ToleranceSection = ToleranceSection()
    finite_element: FiniteElementSection = FiniteElementSection()
    resolution: ResolutionSection = ResolutionSection()
    budget: BudgetSection = BudgetSection()
    scatter: ScatterSection | None = None
    statistics: StatisticsSection | None = None
    heat: HeatSection | None = None
    answers: dict[str, AnswerSection] | None = None

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        body, load, coating = self.body, self.load, self.coating
        for there, where, needed in (
            (body.thickness is not None, "on a half-plane", "body.thickness"),
            (self.roller.rigid, "for an elastic roller", "roller.rigid = true"),
        ):
            if load.approach is not None and not there:
                why = f"has no meaning {where}, whose displacement has no datum"
                yield "load.approach", f"{why}; allowed is per_length, or approach with {needed}"
        if self.running_in is not None:
            yield from self.running_in.missing(self.profile, body.hardness, load.kind)
        if (name := wrong_name(self.answers)) is not None:
            short = "a letter and up to 39 letters, digits, - and _, and no model's name"
            yield "answers", f"has the name {describe(name)}; allowed is {short}"
        for field, problem in self.finite_element.conflicts(
            self.roller, body, load, self.profile, coating
        ):
            yield f"finite_element.{field}", problem
        if self.scatter is not None:
            yield from self.scatter.misfits(self)
        if self.statistics is not None and self.profile is None:
            yield "statistics", "is given for a smooth surface; allowed only with [profile]"
        if self.heat is not None:
            yield from self.heat.misfits(self)
        if coating and body.thickness is not None and coating.thickness >= body.thickness:
            given = f"is {coating.thickness:g} m on a body of {body.thickness:g} m"
            yield "coating.thickness", f"{given}; allowed is less, the body's thickness contains it"
        if coating and self.finite_element.plastic:
            yield "finite_element.plastic", "is true for a coated body; allowed without [coating]"
        if body.base == "frictionless" and body.width is not None and max(load.friction) > 0.0:
            held = 'allowed is friction = 0, base = "bonded" or no width'
            given = f"is {max(load.friction):g} on a body of finite width on a frictionless base"
            yield "load.friction", f"{given}, which nothing would hold; {held}"
        for name in _of_stress():
            if self.stress is None and name in self.tolerance.model_fields_set:
                others = ", ".join(sorted(set(QUANTITIES) - set(_of_stress())))
                problem = f"needs a [stress] section; allowed is {others} without one"
                yield f"tolerance.{name}", problem


SECTIONS: dict[str, type[SceneSection]] = {
    name: part
    for name, info in SceneFile.model_fields.items()
    for part in (info.annotation, *get_args(info.annotation))  # of a section, or one or None
    if isinstance(part, type) and issubclass(part, SceneSection)
}
EVERY_SECTION = SECTIONS | {"answers": AnswerSection}  # of which there may be several, by name


def plain_tables(scene: SceneFile) -> dict:
    """The scene as a file would have it, for JSON and TOML: defaults written out, SI numbers, no
    None; reading it gives the same scene."""
    plain = _plain(scene)
    if scene.stress is None:  # defaults that have nothing to judge
        for name in _of_stress():
            plain["tolerance"].pop(name, None)
    return plain


def _of_stress() -> list[str]:
    """Compared quantities that there are with [stress] alone."""
    return [name for name, quantity in QUANTITIES.items() if quantity.needs_stress]


def _plain(value: object) -> object:
    if isinstance(value, SceneSection):
        pairs = ((name, getattr(value, name)) for name in type(value).model_fields)
        return {name: _plain(item) for name, item in pairs if item is not None}
    if isinstance(value, dict):
        return {name: _plain(item) for name, item in value.items()}
    if isinstance(value, Extent):
        return value.value if value.in_half_widths else f"{value.value!r} m"
    if isinstance(value, Spread):
        per_cent = f"{100 * Decimal(repr(value.deviation))} %" if value.relative else None
        return {"range": list(value.range)} if value.range else per_cent or value.deviation
    return [_plain(item) for item in value] if isinstance(value, tuple) else value


def scene_error(error: ValidationError, where: str) -> SceneError:
    """The one line that stands for `error`; `where` names the scene.
    A misspelt name usually leaves a needed field missing as well, so unknown names come first."""
    problems = error.errors(include_url=False)
    unknown = [problem for problem in problems if problem["type"] == "extra_forbidden"]
    return SceneError(f"{where}: {_line((unknown or problems)[0])}")


def _line(problem: dict) -> str:
    location, kind = problem["loc"], problem["type"]
    if kind == "extra_forbidden":
        return _unknown(location, problem["input"])
    if kind == "missing" and len(location) == 1:
        return f"{location[0]}: is missing; allowed is a section [{location[0]}]"
    if kind == "missing":
        section, name = EVERY_SECTION[location[0]], location[-1]
        return f"{'.'.join(location)}: is missing; allowed is {allowed(section, name)}"
    if kind in ("model_type", "dict_type"):
        name = location[0]
        return f"{name}: is {describe(problem['input'])}; allowed is a section [{name}]"
    cause = problem.get("ctx", {}).get("error")
    if isinstance(cause, FieldError):
        location = (*location, cause.field)
    return f"{'.'.join(map(str, location))}: {cause or problem['msg']}"


def _unknown(location: tuple, given: object) -> str:
    """A name that no section has: the nearest one, in its own section if there is one alike."""
    *section, name = map(str, location)
    place = ".".join([*section, name])
    sections = {table: f"[{table}]" for table in SECTIONS}
    if not section and isinstance(given, dict):
        return f"{place}: is no known section; the nearest is {_nearest(name, sections)}"
    fields = {
        table: {field: f"{table}.{field}" for field in model.model_fields}
        for table, model in EVERY_SECTION.items()
    }
    own = fields[section[0]] if section else {"title": "title", **sections}
    # of the same name in two sections, the first's: what is pressed, not how uncertain it is
    anywhere = {f: shown for table in reversed(fields.values()) for f, shown in table.items()}
    near = _nearest(name, own, 0.6) or _nearest(name, anywhere, 0.6) or _nearest(name, own)
    return f"{place}: is no known field; the nearest is {near}"


def _nearest(name: str, shown: dict[str, str], alike: float = 0.0) -> str | None:
    """How the name most like `name` is shown."""
    return shown.get(nearest(name.casefold(), shown, alike))
