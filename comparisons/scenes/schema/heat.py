"""The [heat] section: sliding speed, and how both bodies conduct the heat of friction."""

from collections.abc import Iterator
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
from comparisons.scenes.scene import Heat
from comparisons.scenes.schema.fields import (
    Fraction,
    Length,
    Number,
    OneOf,
    SceneSection,
    Truth,
    allowed,
)

Conductivity = Annotated[float, Number(CONDUCTIVITY, above=0.0)]
Density = Annotated[float, Number(DENSITY, above=0.0)]
SpecificHeat = Annotated[float, Number(SPECIFIC_HEAT, above=0.0)]
Expansion = Annotated[float, Number(EXPANSION, above=0.0, at_most=1e-3)]
CONSTANTS = ("conductivity", "density", "specific_heat")


class HeatSection(SceneSection):
    """By default the roller takes the contact with it: the body sees a moving source."""

    speed: Annotated[float, Number(SPEED, above=0.0)]
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
    base: Annotated[str, OneOf(("held", "insulated"))] | None = None
    reach: Length | None = None
    tolerance: Fraction = 0.05
    stresses: Annotated[bool, Truth()] = False
    body_expansion: Expansion | None = None
    coating_expansion: Expansion | None = None

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.slide_to_roll == 0.0:
            yield "slide_to_roll", "is 0, which slides nowhere; allowed is from -2 to 2 but for 0"

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        """What the rest of the scene lacks, or has too much of."""
        if not any(scene.load.friction):
            yield "heat", "is given without friction; allowed with load.friction above 0"
        if self.base is not None and scene.body.thickness is None:
            yield (
                "heat.base",
                "is given for a half-plane, which has none; allowed with body.thickness",
            )
        yield from self._of_stresses(scene)
        expansion = ("expansion",) if self.stresses else ()
        for name in (f"coating_{constant}" for constant in (*CONSTANTS, *expansion)):
            given = getattr(self, name) is not None
            if given and scene.coating is None:
                yield f"heat.{name}", "is given for a body without one; allowed with [coating]"
            if scene.coating is not None and not given:
                yield f"heat.{name}", f"is missing; allowed is {allowed(type(self), name)}"

    def _of_stresses(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        """What thermal stresses lack, or cannot be added to."""
        if not self.stresses:
            for name in ("body_expansion", "coating_expansion"):
                if getattr(self, name) is not None:
                    yield f"heat.{name}", "is given without use; allowed with stresses = true"
            return
        if self.body_expansion is None:
            needed = allowed(type(self), "body_expansion")
            yield "heat.body_expansion", f"is missing for stresses = true; allowed is {needed}"
        elements = scene.finite_element
        moved = elements.geometry == "rough" or elements.gap == "displaced"
        for there, what in (
            (scene.stress is None, "without [stress]; allowed with it"),
            (scene.body.width is not None, "for a body of finite width; allowed without"),
            (elements.nonlinear, "beside a nonlinear body; allowed for a linear elastic one"),
            (moved, "beside a rough boundary or a displaced gap; allowed on a flat boundary"),
        ):
            if there:
                yield "heat.stresses", f"is true {what}"


def heat_of(table: HeatSection, radius: float) -> Heat:
    """The section as both sides of the program know it; `radius` [m] of the roller."""

    def material(body: str) -> ThermalMaterial:
        return ThermalMaterial(*(getattr(table, f"{body}_{name}") for name in CONSTANTS))

    return Heat(
        speed=table.speed,
        slide_to_roll=table.slide_to_roll,
        body=material("body"),
        roller=material("roller"),
        coating=None if table.coating_conductivity is None else material("coating"),
        bulk_temperature=table.bulk_temperature,
        base=table.base or "held",
        reach=table.reach or radius,
        tolerance=table.tolerance,
        expansion=table.body_expansion,
        coating_expansion=table.coating_expansion,
    )
