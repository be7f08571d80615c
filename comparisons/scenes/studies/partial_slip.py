"""The [partial_slip] section: a tangential load that does not make the contact slide."""

from collections.abc import Iterator
from typing import Annotated

from comparisons.common.units import DIMENSIONLESS, PRESSURE
from comparisons.scenes.fields import Fraction, Number, SceneSection, Several, Whole

Share = Number(DIMENSIONLESS, above=-1.0, below=1.0)


class PartialSlipSection(SceneSection):
    """Tangential loads, towards +x on the body, over that of sliding (friction times load)."""

    load: Annotated[float, Number(DIMENSIONLESS, above=0.0, below=1.0)] | None = None
    # one after the other
    loads: Annotated[tuple[float, ...], Several(Share, repeated=True)] | None = None
    # [Pa] of the body along x, tensile, at the largest load; in phase with the loads
    bulk_stress: Annotated[float, Number(PRESSURE)] = 0.0
    # steps of the normal load that unlike bodies are pressed by, and of a tangential one from
    # nothing to sliding
    increments: Annotated[int, Whole(2, 512)] = 16
    tolerance: Fraction = 0.05  # relative, of both models' figures

    @property
    def path(self) -> tuple[float, ...]:
        """The loads in turn."""
        return (self.load,) if self.loads is None else self.loads

    @property
    def largest(self) -> float:
        """Amount of the largest load; 1 where the bodies are pressed alone."""
        return max(map(abs, self.path)) or 1.0

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from self.unless_one_of(("load", "loads"), " and ")
        if self.bulk_stress and not any(self.path):
            yield "bulk_stress", "is given without a load that it goes with; allowed beside one"

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        if not any(scene.load.friction):
            yield "partial_slip", "is given without friction; allowed with load.friction above 0"
        if scene.finite_element.deformation == "finite":
            problem = 'is of small strains; allowed with finite_element.deformation = "linear"'
            yield "partial_slip", problem


SECTION = PartialSlipSection
