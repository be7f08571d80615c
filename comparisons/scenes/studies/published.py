"""The [published.NAME] sections: what others state of the same contact."""

from collections.abc import Iterator
from decimal import Decimal
from typing import Annotated

from comparisons.common.numbers import significant
from comparisons.common.units import LENGTH, PRESSURE, UnitError, to_si, unit_in_si
from comparisons.figures.quantity import HYPHENATED
from comparisons.scenes.fields import Fraction, OneOf, SceneSection, Text, Truth

DIGITS = 5  # of ours
LOWERING = "lowering"  # of the body's surface under the roller's centre, against its base
# The same and the largest pressure, held by friction, at the end of the path of [partial_slip]
HELD_LOWERING, HELD_PRESSURE = "held_lowering", "held_pressure"
PRESSURES = "peak_pressure", "tau1_max", "txz_max_abs", "edge_tension", HELD_PRESSURE
LENGTHS = "contact_length", "tau1_max_depth", "stick_length", "tangential_displacement"
LOWERINGS = LOWERING, HELD_LOWERING
DIMENSIONS = dict.fromkeys(PRESSURES, PRESSURE) | dict.fromkeys((*LENGTHS, *LOWERINGS), LENGTH)


class PublishedSection(SceneSection):
    quantity: Annotated[str, OneOf(tuple(DIMENSIONS))]
    value: Annotated[str, Text('a number and its unit, as printed, such as "3585.4 MPa"')]
    # relative, of what is published; None: half a unit of the last digit
    scatter: Fraction | None = None
    # of ours, which is judged by it; None: the last that is run
    model: Annotated[str, OneOf(tuple(HYPHENATED.values()))] | None = None
    source: Annotated[str, Text("where it stands")]
    read: Annotated[bool, Truth()] = True  # whether the source itself was read
    doubtful: Annotated[bool, Truth()] = False  # shown, and not judged
    note: Annotated[str, Text("what it is, or why it is doubtful")] | None = None

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
