"""The types of a scene's fields: what each may hold, read by pydantic, and said in one place.

Every type here has `read(given)`, which returns the value or raises ValueError with
"problem; allowed is …", and `allowed()`, which is the last part alone, for a missing field.
"""

import difflib
from abc import ABC, abstractmethod
from dataclasses import dataclass

from pydantic_core import core_schema

from comparisons.common.units import LENGTH, Dimension, UnitError, describe, to_si, unit_in_si
from comparisons.scenes.scene import Extent

# Of a number in SI, but for 0. Products of some of them still fit a double.
SMALLEST, LARGEST = 1e-30, 1e30


class FieldType(ABC):
    """A field type that pydantic calls through `read`."""

    @abstractmethod
    def read(self, given: object) -> object:
        """The value that `given`, as TOML has it, stands for."""

    @abstractmethod
    def allowed(self) -> str:
        """What may be given, in words."""

    def wrong(self, problem: str) -> ValueError:
        return ValueError(f"{problem}; allowed is {self.allowed()}")

    def __get_pydantic_core_schema__(self, source: object, handler: object) -> object:
        return core_schema.no_info_plain_validator_function(self.read)


def _of_sane_size(given: object, dimension: Dimension) -> float:
    """As `to_si`; raises UnitError as well for a size that nothing can be computed with."""
    value = to_si(given, dimension)
    if value != 0.0 and not SMALLEST <= abs(value) <= LARGEST:
        raise UnitError(
            f"is {describe(given)}, whose size is not from {SMALLEST:g} to {LARGEST:g} in SI"
        )
    return value


@dataclass(frozen=True)
class Number(FieldType):
    """A float in SI, of one dimension, within bounds in SI: above < v, at_least <= v, …

    It is 0, or of a size from SMALLEST to LARGEST.
    """

    dimension: Dimension
    above: float | None = None
    at_least: float | None = None
    below: float | None = None
    at_most: float | None = None

    def read(self, given: object) -> float:
        try:
            value = _of_sane_size(given, self.dimension)
        except UnitError as error:
            raise self.wrong(str(error)) from error
        if (
            (self.above is not None and not value > self.above)
            or (self.at_least is not None and not value >= self.at_least)
            or (self.below is not None and not value < self.below)
            or (self.at_most is not None and not value <= self.at_most)
        ):
            raise self.wrong(f"is {describe(given)}")
        return value + 0.0  # -0.0 is 0.0

    def allowed(self) -> str:
        bounds = [
            f"{word} {bound:g}"
            for word, bound in (
                ("above", self.above),
                ("at least", self.at_least),
                ("below", self.below),
                ("at most", self.at_most),
            )
            if bound is not None
        ]
        phrase = " ".join([self.dimension.phrase, " and ".join(bounds)]).strip()
        return f"{phrase}{self.dimension.writing()}"


@dataclass(frozen=True)
class Whole(FieldType):
    """A whole number between two bounds, both allowed."""

    at_least: int
    at_most: int

    def read(self, given: object) -> int:
        if isinstance(given, bool) or not isinstance(given, int):
            raise self.wrong(f"is {describe(given)}")
        if not self.at_least <= given <= self.at_most:
            raise self.wrong(f"is {describe(given)}")
        return given

    def allowed(self) -> str:
        return f"a whole number from {self.at_least} to {self.at_most}"


@dataclass(frozen=True)
class Text(FieldType):
    """One line of text."""

    meaning: str

    def read(self, given: object) -> str:
        if not isinstance(given, str):
            raise self.wrong(f"is {describe(given)}")
        if not given.strip():
            raise self.wrong("is blank")
        if not given.isprintable():
            raise self.wrong("holds a control character")
        return given

    def allowed(self) -> str:
        return f"a string of one line, {self.meaning}"


@dataclass(frozen=True)
class Choice(FieldType):
    """One of a few words."""

    words: tuple[str, ...]

    def read(self, given: object) -> str:
        if given not in self.words:
            near = difflib.get_close_matches(given, self.words, 1) if isinstance(given, str) else []
            hint = f' (did you mean "{near[0]}"?)' if near else ""
            raise self.wrong(f"is {describe(given)}{hint}")
        return given

    def allowed(self) -> str:
        return " or ".join(f'"{word}"' for word in self.words)


@dataclass(frozen=True)
class Truth(FieldType):
    """true or false."""

    def read(self, given: object) -> bool:
        if not isinstance(given, bool):
            raise self.wrong(f"is {describe(given)}")
        return given

    def allowed(self) -> str:
        return "true or false"


@dataclass(frozen=True)
class Unit(FieldType):
    """The name of a unit of one dimension, kept as written."""

    dimension: Dimension

    def read(self, given: object) -> str:
        try:
            unit_in_si(given, self.dimension)
        except UnitError as error:
            raise self.wrong(str(error)) from error
        return given.strip()

    def allowed(self) -> str:
        return f'a unit of {self.dimension.phrase.removeprefix("a ")} as a string, such as "um"'


@dataclass(frozen=True)
class ExtentField(FieldType):
    """A length above 0: a number counts Hertz half-widths, a string has a unit."""

    def read(self, given: object) -> Extent:
        in_half_widths = not isinstance(given, str)
        try:
            value = _of_sane_size(given, LENGTH)
        except UnitError as error:
            raise self.wrong(str(error)) from error
        if not value > 0.0:
            raise self.wrong(f"is {describe(given)}")
        return Extent(value, in_half_widths)

    def allowed(self) -> str:
        return 'a number of half-widths above 0 or a length above 0 such as "500 um"'


@dataclass(frozen=True)
class Several(FieldType):
    """A list of what `each` reads, at least one and none twice; a single value is a list of one."""

    each: Number

    def read(self, given: object) -> tuple[float, ...]:
        values = given if isinstance(given, list | tuple) else [given]
        if not values:
            raise self.wrong("is an empty list")
        read = tuple(self.each.read(value) for value in values)
        for i, value in enumerate(read):
            if value in read[:i]:
                raise self.wrong(f"lists {value:g} twice")
        return read

    def allowed(self) -> str:
        return f"{self.each.allowed()}, or a list of such, none of them twice"


@dataclass(frozen=True)
class Grid(FieldType):
    """[columns, rows] of a field of points, at least 3 each and at most `most` in all."""

    most: int

    def read(self, given: object) -> tuple[int, int]:
        if not isinstance(given, list | tuple):
            raise self.wrong(f"is {describe(given)}")
        if len(given) != 2:
            raise self.wrong(f"is a list of {len(given)}")
        for number in given:
            if isinstance(number, bool) or not isinstance(number, int):
                raise self.wrong(f"holds {describe(number)}")
            if number < 3:
                raise self.wrong(f"holds {number}")
        columns, rows = given
        if columns * rows > self.most:
            raise self.wrong(f"asks for {describe(columns * rows)} points")
        return columns, rows

    def allowed(self) -> str:
        return (
            "a list of two whole numbers [along x, along z], at least 3 each "
            f"and at most {self.most} points in all"
        )
