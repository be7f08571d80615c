"""The hardening of a body that flows, as a scene has it: `body.hardening`."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from comparisons.common.units import DIMENSIONLESS
from comparisons.scenes.fields import MOST_VALUES, Number, Pressure, SceneSection, optional

Positive = Annotated[float, Number(DIMENSIONLESS, gt=0.0)]
Strain = Annotated[float, Number(DIMENSIONLESS, ge=0.0)]
Exponent = Annotated[float, Number(DIMENSIONLESS, gt=0.0, le=1.0)]
Point = tuple[Strain, Pressure]


class VoceSection(SceneSection):
    """Voce's law: S - (S - Y) exp(-rate k)."""

    saturated: Pressure = Field(description="flow stress S at large strains")
    rate: Positive = Field(description="of saturation, per plastic strain")


class LudwikSection(SceneSection):
    """Ludwik's law: Y + strength k^exponent."""

    strength: Pressure = Field(description="factor of the power")
    exponent: Exponent = Field(description="of the plastic strain")


class HardeningSection(SceneSection):
    """One isotropic law, a kinematic one, or both."""

    table: Annotated[tuple[Point, ...], Field(min_length=2, max_length=MOST_VALUES)] | None = (
        optional(
            "pairs of plastic strain and stress, linear between them, constant beyond",
            examples=[[[0, "280 MPa"], [0.05, "340 MPa"]]],
        )
    )
    voce: VoceSection | None = optional("S − (S − Y) exp(−rate k)")
    ludwik: LudwikSection | None = optional("Y + strength k^exponent")
    kinematic: Pressure | None = optional("shift of the yield surface: stress per plastic strain")

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if not self.laws:
            yield "table", "is missing; allowed is at least one of table, voce, ludwik, kinematic"

    @property
    def laws(self) -> dict[str, object]:
        """Laws that are given, by name, as `analytic.material.hardening` takes them."""
        given = {name: getattr(self, name) for name in type(self).model_fields}
        return {
            name: tuple(dict(law).values()) if isinstance(law, SceneSection) else law
            for name, law in given.items()
            if law is not None
        }
