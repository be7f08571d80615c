"""The [heat] section: sliding speed, and how both bodies conduct the heat of friction."""

from collections.abc import Iterator, Mapping
from typing import Annotated

from analytic.material import ThermalMaterial
from comparisons.common.units import (
    CONDUCTIVITY,
    DENSITY,
    DIMENSIONLESS,
    EXPANSION,
    SPECIFIC_HEAT,
    SPEED,
    TEMPERATURE,
)
from comparisons.scenes.fields import Fraction, Length, Number, OneOf, SceneSection, Truth, allowed
from comparisons.scenes.materials import solid_named

Conductivity = Annotated[float, Number(CONDUCTIVITY, above=0.0)]
Density = Annotated[float, Number(DENSITY, above=0.0)]
SpecificHeat = Annotated[float, Number(SPECIFIC_HEAT, above=0.0)]
Expansion = Annotated[float, Number(EXPANSION, above=0.0, at_most=1e-3)]
CONSTANTS = ("conductivity", "density", "specific_heat")


class HeatSection(SceneSection):
    """By default the roller takes the contact with it: the body sees a moving source."""

    STEP = "frictional heat"
    speed: Annotated[float, Number(SPEED, above=0.0)]  # [m/s] of sliding
    # speed over the mean of both surfaces' speeds past the contact: -2, the contact stays on the
    # body; 2, it stays on the roller
    slide_to_roll: Annotated[float, Number(DIMENSIONLESS, at_least=-2.0, at_most=2.0)] = 2.0
    body_conductivity: Conductivity
    body_density: Density
    body_specific_heat: SpecificHeat
    roller_conductivity: Conductivity
    roller_density: Density
    roller_specific_heat: SpecificHeat
    coating_conductivity: Conductivity | None = None
    coating_density: Density | None = None
    coating_specific_heat: SpecificHeat | None = None
    bulk_temperature: Annotated[float, Number(TEMPERATURE, at_least=0.0)] = 293.15
    # of a body with thickness, by default held at that temperature
    base: Annotated[str, OneOf(("held", "insulated"))] | None = None
    # from the contact to where a body that it stays on has that temperature: by default the radius
    reach: Length | None = None
    tolerance: Fraction = 0.05  # relative, of temperatures and thermal stresses
    stresses: Annotated[bool, Truth()] = False
    body_expansion: Expansion | None = None
    coating_expansion: Expansion | None = None

    @classmethod
    def followed(cls, tables: Mapping) -> Mapping:
        """With the constants of bodies that are named after a solid; expansions where stresses are
        asked for."""
        heat, follows = tables.get("heat"), {}
        if not isinstance(heat, Mapping):
            return tables
        for body in ("body", "roller", "coating"):
            section = tables.get(body)
            name = section.get("material") if isinstance(section, Mapping) else None
            solid = solid_named(name) if isinstance(name, str) else None
            names = CONSTANTS
            if heat.get("stresses") is True and body != "roller":
                names = (*CONSTANTS, "expansion")
            for constant in names if solid is not None else ():
                if constant in solid.values:
                    follows[f"{body}_{constant}"] = solid.values[constant].value
        return {**tables, "heat": {**follows, **heat}}

    @property
    def velocities(self) -> tuple[float, float]:
        """[m/s] of the body's and the roller's surface past the contact, towards +x. Their
        difference is minus the speed: the roller drags the body towards +x."""
        mean = -self.speed / self.slide_to_roll
        return mean - 0.5 * self.speed, mean + 0.5 * self.speed

    @property
    def body(self) -> ThermalMaterial:
        return self._material("body")

    @property
    def roller(self) -> ThermalMaterial:
        return self._material("roller")

    @property
    def coating(self) -> ThermalMaterial | None:
        """None without one."""
        return None if self.coating_conductivity is None else self._material("coating")

    def _material(self, body: str) -> ThermalMaterial:
        return ThermalMaterial(*(getattr(self, f"{body}_{name}") for name in CONSTANTS))

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.slide_to_roll == 0.0:
            yield "slide_to_roll", "is 0, which slides nowhere; allowed is from -2 to 2 but for 0"

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        elements, coated = scene.finite_element, scene.coating is not None
        if not any(scene.load.friction):
            yield "heat", "is given without friction; allowed with load.friction above 0"
        if self.base is not None and scene.body.thickness is None:
            unbounded = "is given for a half-plane, which has none"
            yield "heat.base", f"{unbounded}; allowed with body.thickness"
        needed = {f"coating_{constant}": coated for constant in CONSTANTS}
        needed |= {"body_expansion": self.stresses, "coating_expansion": self.stresses and coated}
        for name, is_needed in needed.items():
            is_there = getattr(self, name) is not None
            if is_there and name.startswith("coating") and not coated:
                yield f"heat.{name}", "is given for a body without one; allowed with [coating]"
            elif is_there and not is_needed:
                yield f"heat.{name}", "is given without use; allowed with stresses = true"
            elif is_needed and not is_there:
                why = " for stresses = true" if name == "body_expansion" else ""
                yield f"heat.{name}", f"is missing{why}; allowed is {allowed(type(self), name)}"
        for there, what in (
            (scene.stress is None, "without [stress]; allowed with it"),
            (scene.body.width is not None, "for a body of finite width; allowed without"),
            (elements.nonlinear, "beside a nonlinear body; allowed for a linear elastic one"),
            (elements.element == "P1", 'with linear elements; allowed with element = "P2" or "P3"'),
        ):
            if self.stresses and there:
                yield "heat.stresses", f"is true {what}"


SECTION = HeatSection
