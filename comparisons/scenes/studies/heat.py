"""The [heat] section: sliding speed, and how both bodies conduct the heat of friction."""

from collections.abc import Iterator
from typing import Annotated, Literal, Self

from pydantic import Field, StrictBool

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
from comparisons.scenes.fields import Fraction, Length, Number, SceneSection, optional
from comparisons.scenes.materials import solids

Conductivity = Annotated[float, Number(CONDUCTIVITY, gt=0.0)]
Density = Annotated[float, Number(DENSITY, gt=0.0)]
SpecificHeat = Annotated[float, Number(SPECIFIC_HEAT, gt=0.0)]
Expansion = Annotated[float, Number(EXPANSION, gt=0.0, le=1e-3)]
CONSTANTS = ("conductivity", "density", "specific_heat")


class HeatSection(SceneSection):
    """Heat of friction; it needs `load.friction` above 0."""

    STEP = "frictional heat"
    FOLLOW = tuple(f"{body}_{constant}" for body in ("body", "roller") for constant in CONSTANTS)
    speed: Annotated[float, Number(SPEED, gt=0.0)] = Field(description="of sliding")
    slide_to_roll: Annotated[float, Number(DIMENSIONLESS, ge=-2.0, le=2.0)] = optional(
        "speed over the mean speed of both surfaces past the contact, not 0; -2: the "
        "contact stays on the body, 2: on the roller",
        2.0,
    )
    body_conductivity: Conductivity | None = optional("of the rough body")
    body_density: Density | None = optional("of the rough body")
    body_specific_heat: SpecificHeat | None = optional("of the rough body")
    roller_conductivity: Conductivity | None = optional("of the roller")
    roller_density: Density | None = optional("of the roller")
    roller_specific_heat: SpecificHeat | None = optional("of the roller")
    coating_conductivity: Conductivity | None = optional("needed with `[coating]`")
    coating_density: Density | None = optional("needed with `[coating]`")
    coating_specific_heat: SpecificHeat | None = optional("needed with `[coating]`")
    bulk_temperature: Annotated[float, Number(TEMPERATURE, ge=0.0)] = optional(
        "of both bodies [K]", 293.15
    )
    base: Literal["held", "insulated"] | None = optional(
        "of a body with `thickness`: at the bulk temperature (by default) or insulated"
    )
    reach: Length | None = optional(
        "from the contact to where a body at rest, and the disc, has the bulk "
        "temperature; by default the roller's radius"
    )
    tolerance: Fraction = optional("of temperatures and thermal stresses", 0.05)
    stresses: StrictBool = optional("add the thermal stresses of the body; needs `[stress]`", False)
    body_expansion: Expansion | None = optional("needed with `stresses`")
    coating_expansion: Expansion | None = optional("needed with `stresses` and `[coating]`")

    def completed(self, scene: SceneSection) -> Self:
        """Fill in the constants of bodies that are named after a solid; expansions where stresses
        are asked for."""
        follows = {}
        for body, section in scene.elastic_sections.items():
            known = solids()[section.solid].values if section.solid else {}
            more = ("expansion",) if self.stresses and body != "roller" else ()
            for constant in known.keys() & {*CONSTANTS, *more}:
                if getattr(self, f"{body}_{constant}") is None:
                    follows[f"{body}_{constant}"] = known[constant].value
        return self.model_copy(update=follows)

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
        """Thermal material of the coating; None without one."""
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
        needed = dict.fromkeys(self.FOLLOW, True)
        needed |= {f"coating_{constant}": coated for constant in CONSTANTS}
        needed |= {"body_expansion": self.stresses, "coating_expansion": self.stresses and coated}
        for name, is_needed in needed.items():
            is_there = getattr(self.completed(scene), name) is not None
            if is_there and name.startswith("coating") and not coated:
                yield f"heat.{name}", "is given for a body without one; allowed with [coating]"
            elif is_there and not is_needed:
                yield f"heat.{name}", "is given without use; allowed with stresses = true"
            elif is_needed and not is_there:
                why = " for stresses = true" if name == "body_expansion" else ""
                yield f"heat.{name}", f"is missing{why}"
        for there, what in (
            (scene.stress is None, "without [stress]; allowed with it"),
            (scene.body.width is not None, "for a body of finite width; allowed without"),
            (elements.nonlinear, "beside a nonlinear body; allowed for a linear elastic one"),
            (elements.element == "P1", 'with linear elements; allowed with element = "P2" or "P3"'),
        ):
            if self.stresses and there:
                yield "heat.stresses", f"is true {what}"


SECTION = HeatSection
