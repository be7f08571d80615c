"""The [partial_slip] section: a tangential load that does not make the contact slide."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field, StrictInt

from comparisons.common.units import DIMENSIONLESS, PRESSURE
from comparisons.scenes.fields import Fraction, Number, SceneSection, Several, optional

Share = Annotated[float, Number(DIMENSIONLESS, gt=-1.0, lt=1.0)]


class PartialSlipSection(SceneSection):
    """Tangential load that does not make the contact slide, at small strains; it needs
    `load.friction` above 0."""

    load: Fraction | None = optional("tangential, over friction times normal load; or `loads`")
    loads: Annotated[tuple[Share, ...], Several(repeated=True)] | None = optional(
        "several, one after the other; 0 alone presses unlike bodies, which friction holds"
    )
    bulk_stress: Annotated[float, Number(PRESSURE)] = optional(
        "of the body along x, tensile, at the largest load and in phase with all", 0.0
    )
    increments: Annotated[StrictInt, Field(ge=2, le=512)] = optional(
        "of the normal load, and of a tangential one up to sliding, where bodies are unlike", 16
    )
    tolerance: Fraction = optional("of both models' figures", 0.05)

    @property
    def path(self) -> tuple[float, ...]:
        """The loads in turn."""
        return (self.load,) if self.loads is None else self.loads

    @property
    def largest(self) -> float:
        """Amount of the largest load; 1 where the bodies are pressed alone."""
        return max(map(abs, self.path)) or 1.0

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from self.unless_one_of(("load", "loads"))
        if self.bulk_stress and not any(self.path):
            yield "bulk_stress", "is given without a load that it goes with; allowed beside one"

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        if not any(scene.load.friction):
            yield "partial_slip", "is given without friction; allowed with load.friction above 0"
        if scene.finite_element.deformation == "finite":
            problem = 'is of small strains; allowed with finite_element.deformation = "linear"'
            yield "partial_slip", problem


SECTION = PartialSlipSection
