"""The [finite_element] section: which of the half-plane's assumptions the finite elements keep."""

from collections.abc import Iterator
from typing import Annotated

from comparisons.common.units import DIMENSIONLESS
from comparisons.scenes.scene import FiniteElementSettings
from comparisons.scenes.schema.fields import Number, OneOf, SceneSection, Truth

HELD_BLOCK = 400.0  # half-widths: what a fixed boundary there does to stresses is below 0.3 %
# Poisson's ratio beyond which cubic elements are the default: at 0.4999 quadratic ones leave
# stresses at the edge of a contact half as large again as the largest below it.
QUADRATIC_UP_TO = 0.49
HALF_PLANE_BLOCK = 20.0  # half-widths: the series of the far field is exact to round-off there
SEVERAL_FRICTIONS = "is true with {} friction coefficients; allowed is one, each moves the contact"


class FiniteElementSection(SceneSection):
    """Defaults keep every assumption that the classic method makes, but for the flat half-plane."""

    geometry: Annotated[str, OneOf(("flat", "rough"))] = "flat"
    gap: Annotated[str, OneOf(("reference", "displaced"))] | None = None
    roller_shape: Annotated[str, OneOf(("parabola", "circle"))] = "parabola"
    roller_body: Annotated[str, OneOf(("half-plane", "disc"))] = "half-plane"
    coupled: Annotated[bool, Truth()] | None = None
    deformation: Annotated[str, OneOf(("linear", "finite"))] = "linear"
    plastic: Annotated[bool, Truth()] = False
    element: Annotated[str, OneOf(("P1", "P2", "P3"))] | None = None
    far_field: Annotated[str, OneOf(("held", "half-plane"))] = "held"
    block: Annotated[float, Number(DIMENSIONLESS, at_least=10.0, at_most=5000.0)] | None = None
    growth: Annotated[float, Number(DIMENSIONLESS, at_least=0.05, at_most=0.5)] = 0.2

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.deformation == "finite" and self.plastic:
            yield "plastic", 'is true beside deformation = "finite"; allowed is one of the two'
        if self.nonlinear and self.element not in (None, "P2"):
            cause = "finite_element.deformation" if self.deformation == "finite" else "plastic"
            yield "element", f'is "{self.element}" with {cause}; allowed there is "P2"'

    @property
    def nonlinear(self) -> bool:
        return self.deformation == "finite" or self.plastic

    def defaults(self, poissons_ratio: float) -> dict:
        """Fields that follow from others and from the bodies' largest Poisson's ratio."""
        found = {}
        if self.element is None:
            cubic = poissons_ratio > QUADRATIC_UP_TO and not self.nonlinear
            found["element"] = "P3" if cubic else "P2"
        if self.gap is None:
            found["gap"] = "displaced" if self.geometry == "rough" else "reference"
        if self.block is None:
            found["block"] = HELD_BLOCK if self.far_field == "held" else HALF_PLANE_BLOCK
        return found

    def conflicts(
        self,
        roller: SceneSection,
        body: SceneSection,
        load: SceneSection,
        profile: SceneSection | None,
        coating: SceneSection | None,
    ) -> Iterator[tuple[str, str]]:
        """Fields of this section that do not fit the rest of the scene, and what is wrong."""
        coated, finite = coating is not None, self.deformation == "finite"
        far = self.far_field == "half-plane"
        frictions, apart = len(load.friction), max(load.friction) > 0.0 and self.coupled is False
        if self.geometry == "rough" and profile is None:
            yield "geometry", 'is "rough" for a smooth body; allowed with [profile]'
        if self.plastic and far:
            yield "far_field", 'is "half-plane" for a body that yields; allowed is "held"'
        if self.nonlinear and frictions != 1:
            yield (
                "plastic" if self.plastic else "deformation",
                f"wants one friction coefficient, not {frictions}; allowed is a single number",
            )
        if finite and body.hardness is not None:
            yield "deformation", 'is "finite" for a body with a hardness; allowed without one'
        if self.roller_body == "disc" and roller.rigid:
            yield "roller_body", 'is "disc", but the roller is rigid; allowed with an elastic one'
        for bound in ("thickness", "width"):
            if far and getattr(body, bound) is not None:
                yield "far_field", f'is "half-plane", but the body has a {bound}; allowed is "held"'
        if far and coated:
            yield "far_field", 'is "half-plane", but the body has a coating; allowed is "held"'
        if self.plastic and body.yield_stress is None:
            yield "plastic", "is true, but the body has no yield stress; allowed with one"
        if self.coupled and frictions != 1:
            yield "coupled", SEVERAL_FRICTIONS.format(frictions)
        if finite and coated:
            yield "deformation", 'is "finite" for a coated body; allowed without [coating]'
        if finite and profile is not None and self.geometry == "flat":
            yield "geometry", 'is "flat" at finite deformation with a profile; allowed is "rough"'
        if finite and apart:
            yield "coupled", "is false at finite deformation with friction; allowed is true"
        if self.plastic and load.kind == "approach":
            yield "plastic", "is true with load.approach; allowed with per_length"
        if self.plastic and apart:
            yield "coupled", "is false for a body that yields under friction; allowed is true"


def settings_of(
    table: FiniteElementSection, load: SceneSection, poissons_ratio: float
) -> FiniteElementSettings:
    """The section with its defaults. Friction moves the contact where [load] says so of both
    models, at finite deformation, and where a body flows."""
    given = dict(table) | table.defaults(poissons_ratio)
    if table.coupled is None:
        given["coupled"] = load.coupled or (table.nonlinear and max(load.friction) > 0.0)
    return FiniteElementSettings(**given)
