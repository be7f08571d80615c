"""The [published.NAME] sections: what others state of the same contact."""

from collections.abc import Iterator
from decimal import Decimal
from typing import Literal

from pydantic import Field, StrictBool

from comparisons.common.numbers import significant
from comparisons.common.units import LENGTH, PRESSURE, UnitError, to_si, unit_in_si
from comparisons.figures.quantity import HYPHENATED
from comparisons.scenes.fields import Fraction, SceneSection, Text, optional

DIGITS = 5  # of ours
LOWERING = "lowering"  # of the body's surface under the roller's centre, against its base
# The same and the largest pressure, held by friction, at the end of the path of [partial_slip]
HELD_LOWERING, HELD_PRESSURE = "held_lowering", "held_pressure"
PRESSURES = "peak_pressure", "tau1_max", "txz_max_abs", "edge_tension", HELD_PRESSURE
LENGTHS = "contact_length", "tau1_max_depth", "stick_length", "tangential_displacement"
LENGTHS += LOWERING, HELD_LOWERING
DIMENSIONS = dict.fromkeys(PRESSURES, PRESSURE) | dict.fromkeys(LENGTHS, LENGTH)


class PublishedSection(SceneSection):
    """Figures that others state of the same contact, one table a figure; NAME is any text."""

    quantity: Literal[tuple(DIMENSIONS)] = Field(
        description="which figure; `lowering` is that of the body's surface under the roller "
        "against its base, by the finite elements; `held_lowering` and `held_pressure` that and "
        "the largest pressure at the end of `[partial_slip]`"
    )
    value: Text = Field(description="the figure with its unit, as printed", examples=["3585.4 MPa"])
    scatter: Fraction | None = optional("relative; by default half a unit of the last digit")
    model: Literal[tuple(HYPHENATED.values())] | None = optional(
        "which of ours is judged by it; by default the last that is run"
    )
    source: Text = Field(description="document and page")
    read: StrictBool = optional("whether the source itself was read", True)
    doubtful: StrictBool = optional(
        "shown, and not judged, because its own source speaks against it; needs `note`", False
    )
    note: Text | None = optional("what a reader should know, or why the figure is doubtful")

    @property
    def size(self) -> float:
        """The value [SI]."""
        return to_si(self.value, DIMENSIONS[self.quantity])

    def as_published(self, size: float) -> str:
        """A size [SI] in the unit that is published."""
        unit = self.value.split(maxsplit=1)[1]
        return f"{significant(size / unit_in_si(unit, DIMENSIONS[self.quantity]), DIGITS)} {unit}"

    @property
    def spread(self) -> float:
        """The scatter, relative."""
        if self.scatter is not None:
            return self.scatter
        number = Decimal(self.value.split()[0])
        return float(Decimal((0, (5,), number.as_tuple().exponent - 1)) / abs(number))

    @property
    def judged_by(self) -> str | None:
        """The model's name."""
        return self.model and self.model.replace("-", "_")

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        try:
            if self.size <= 0.0:
                yield "value", f"is {self.value}; allowed is a size above 0"
        except UnitError as error:
            yield "value", f'{error}; allowed is a number and its unit, such as "3585.4 MPa"'
        if self.doubtful and not self.note:
            yield "note", "is missing beside doubtful = true; allowed is why"


SECTION = dict[str, PublishedSection]
