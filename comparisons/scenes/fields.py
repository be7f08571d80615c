"""What a section of a scene file is: fields of a few types, checked by pydantic, and rules.

Every type of field has `read(entry)`, which returns the value or raises ValueError with "problem;
allowed is …", and `allowed()`, which is the last part alone, for a missing field."""

import operator
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Annotated, ClassVar, Self, get_args

from pydantic import BaseModel, ConfigDict, model_validator
from pydantic.fields import FieldInfo
from pydantic_core import core_schema

from comparisons.common.errors import nearest
from comparisons.common.units import (
    DIMENSIONLESS,
    LENGTH,
    Dimension,
    UnitError,
    describe,
    to_si,
    unit_in_si,
)

# Of a number in SI, but for 0. Products of some of them still fit a double.
SMALLEST, LARGEST = 1e-30, 1e30
MOST_VALUES = 1000  # of a list
LONGEST_TEXT = 1000  # characters


class FieldType(ABC):
    """A field type that pydantic calls through `read`."""

    @abstractmethod
    def read(self, entry: object) -> object:
        """The value that `entry`, as TOML has it, stands for."""

    @abstractmethod
    def allowed(self) -> str:
        """What may be given, in words."""

    def wrong(self, problem: str) -> ValueError:
        return ValueError(f"{problem}; allowed is {self.allowed()}")

    def hint(self, entry: object, words: Sequence[str]) -> str:
        """The one of the words that may be meant, for the end of a problem."""
        near = nearest(entry, words, 0.6) if isinstance(entry, str) else None
        return f' (did you mean "{near}"?)' if near else ""

    def in_si(self, entry: object, dimension: Dimension) -> float:
        """As `comparisons.common.units.to_si`, but of a size that can be computed with."""
        try:
            value = to_si(entry, dimension)
        except UnitError as error:
            raise self.wrong(str(error)) from error
        if value != 0.0 and not SMALLEST <= abs(value) <= LARGEST:
            size = f"whose size is not from {SMALLEST:g} to {LARGEST:g} in SI"
            raise self.wrong(f"is {describe(entry)}, {size}")
        return value

    def __get_pydantic_core_schema__(self, source: object, handler: object) -> object:
        return core_schema.no_info_plain_validator_function(self.read)


@dataclass(frozen=True)
class Number(FieldType):
    """A float in SI, of one dimension, within bounds: above < v, at_least <= v, …; it is 0, or of a
    size from SMALLEST to LARGEST."""

    dimension: Dimension
    above: float | None = None
    at_least: float | None = None
    below: float | None = None
    at_most: float | None = None

    def read(self, entry: object) -> float:
        value = self.in_si(entry, self.dimension)
        if not all(holds(value, bound) for _, holds, bound in self._bounds()):
            raise self.wrong(f"is {describe(entry)}")
        return value + 0.0  # -0.0 is 0.0

    def _bounds(self) -> list[tuple[str, Callable[[float, float], bool], float]]:
        bounds = (
            ("above", operator.gt, self.above),
            ("at least", operator.ge, self.at_least),
            ("below", operator.lt, self.below),
            ("at most", operator.le, self.at_most),
        )
        return [bound for bound in bounds if bound[2] is not None]

    def allowed(self) -> str:
        bounds = " and ".join(f"{word} {bound:g}" for word, _, bound in self._bounds())
        return f"{self.dimension.phrase} {bounds}".strip() + self.dimension.writing()


@dataclass(frozen=True)
class Whole(FieldType):
    """A whole number between two bounds, both allowed."""

    at_least: int
    at_most: int

    def read(self, entry: object) -> int:
        if type(entry) is not int or not self.at_least <= entry <= self.at_most:
            raise self.wrong(f"is {describe(entry)}")
        return entry

    def allowed(self) -> str:
        return f"a whole number from {self.at_least} to {self.at_most}"


@dataclass(frozen=True)
class Text(FieldType):
    """One line of text."""

    meaning: str

    def read(self, entry: object) -> str:
        if not isinstance(entry, str):
            raise self.wrong(f"is {describe(entry)}")
        if not entry.strip():
            raise self.wrong("is blank")
        if not entry.isprintable():
            raise self.wrong("holds a control character")
        if len(entry) > LONGEST_TEXT:
            raise self.wrong(f"has {len(entry)} characters, more than {LONGEST_TEXT}")
        return entry

    def allowed(self) -> str:
        return f"a string of one line, {self.meaning}"


@dataclass(frozen=True)
class OneOf(FieldType):
    """One of a few words."""

    words: tuple[str, ...]

    def read(self, entry: object) -> str:
        if entry not in self.words:
            raise self.wrong(f"is {describe(entry)}{self.hint(entry, self.words)}")
        return entry

    def allowed(self) -> str:
        return " or ".join(f'"{word}"' for word in self.words)


@dataclass(frozen=True)
class Truth(FieldType):
    """true or false, or one of a few words beside them."""

    words: tuple[str, ...] = ()

    def read(self, entry: object) -> bool | str:
        if not isinstance(entry, bool) and entry not in self.words:
            raise self.wrong(f"is {describe(entry)}")
        return entry

    def allowed(self) -> str:
        words = ["true", "false", *(f'"{word}"' for word in self.words)]
        return f"{', '.join(words[:-1])} or {words[-1]}"


@dataclass(frozen=True)
class Unit(FieldType):
    """The name of a unit of one dimension, kept as written."""

    dimension: Dimension

    def read(self, entry: object) -> str:
        try:
            unit_in_si(entry, self.dimension)
        except UnitError as error:
            raise self.wrong(str(error)) from error
        return entry.strip()

    def allowed(self) -> str:
        return f'a unit of {self.dimension.phrase.removeprefix("a ")} as a string, such as "um"'


@dataclass(frozen=True)
class Extent:
    """A positive length, in m or in Hertz half-widths as the scene has it."""

    value: float
    in_half_widths: bool

    def metres(self, half_width: float) -> float:
        """The length [m] where the Hertz half-width is `half_width` [m]."""
        return self.value * half_width if self.in_half_widths else self.value

    def plain(self) -> float | str:
        """As a scene file has it."""
        return self.value if self.in_half_widths else f"{self.value!r} m"


@dataclass(frozen=True)
class ExtentField(FieldType):
    """A length above 0: a number counts Hertz half-widths, a string has a unit."""

    def read(self, entry: object) -> Extent:
        value = self.in_si(entry, LENGTH)
        if not value > 0.0:
            raise self.wrong(f"is {describe(entry)}")
        return Extent(value, in_half_widths=not isinstance(entry, str))

    def allowed(self) -> str:
        return 'a number of half-widths above 0 or a length above 0 such as "500 um"'


@dataclass(frozen=True)
class Several(FieldType):
    """A list of what `item` reads, at least one; a single value is a list of one."""

    item: FieldType
    repeated: bool = False  # whether one may stand there twice

    def read(self, entry: object) -> tuple:
        values = entry if isinstance(entry, list | tuple) else [entry]
        if not values:
            raise self.wrong("is an empty list")
        if len(values) > MOST_VALUES:
            raise self.wrong(f"is a list of {len(values)} values, more than {MOST_VALUES}")
        read = tuple(self.item.read(value) for value in values)
        for value in () if self.repeated else read:
            if read.count(value) > 1:
                shown = f"{value:g}" if isinstance(value, float) else describe(value)
                raise self.wrong(f"lists {shown} twice")
        return read

    def allowed(self) -> str:
        return f"{self.item.allowed()}, or a list of such" + ", none of them twice" * (
            not self.repeated
        )


@dataclass(frozen=True)
class Named(FieldType):
    """A table of numbers, one of each of the `names`: what `item` reads."""

    names: tuple[str, ...]
    item: Number

    def read(self, entry: object) -> dict[str, float]:
        if not isinstance(entry, dict):
            raise self.wrong(f"is {describe(entry)}")
        for name in (*entry, *self.names):
            if name not in entry or name not in self.names:
                raise self.wrong(f"{'lacks' if name in self.names else 'holds'} {describe(name)}")
        return {name: self.item.read(entry[name]) for name in self.names}

    def allowed(self) -> str:
        shown = ", ".join(f"{name} = …" for name in self.names)
        return f"a table {{{shown}}}, each {self.item.allowed()}"


@dataclass(frozen=True)
class Grid(FieldType):
    """[columns, rows] of a field of points: from 3 to `longest` of both, at most `most` in all."""

    most: int
    longest: int

    def read(self, entry: object) -> tuple[int, int]:
        if not isinstance(entry, list | tuple):
            raise self.wrong(f"is {describe(entry)}")
        if len(entry) != 2:
            raise self.wrong(f"is a list of {len(entry)}")
        for number in entry:
            if type(number) is not int or not 3 <= number <= self.longest:
                raise self.wrong(f"holds {describe(number)}")
        columns, rows = entry
        if columns * rows > self.most:
            raise self.wrong(f"asks for {describe(columns * rows)} points")
        return columns, rows

    def allowed(self) -> str:
        both = f"a list of two whole numbers [along x, along z], from 3 to {self.longest} each"
        return f"{both}, at most {self.most} points in all"


Length = Annotated[float, Number(LENGTH, above=0.0)]
Fraction = Annotated[float, Number(DIMENSIONLESS, above=0.0, below=1.0)]


class FieldError(ValueError):
    """A rule between fields is broken; `field` names the one to change, within its section."""

    def __init__(self, field: str, message: str) -> None:
        super().__init__(message)
        self.field = field


class SceneSection(BaseModel):
    """One section: unknown fields are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)
    STEP: ClassVar[str | None] = None  # of a run, that is skipped where a scene has no such section

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        """Rules between fields that do not hold: the field to change, and what is wrong with it."""
        yield from ()

    def misfits(self, scene: "SceneSection") -> Iterator[tuple[str, str]]:
        """What does not fit the rest of the scene: "section.field" to change, and what is wrong."""
        yield from ()

    @classmethod
    def followed(cls, tables: Mapping) -> Mapping:
        """A scene's tables, as TOML has them, with what this section leaves to others."""
        return tables

    def completed(self, scene: "SceneSection") -> Self:
        """With the fields that it leaves out and that follow from the rest of the scene."""
        return self

    @model_validator(mode="after")
    def _hold_to_rules(self) -> Self:
        for field, problem in self.broken_rules():
            raise FieldError(field, problem)
        return self

    def unless_one_of(
        self, names: Sequence[str], joint: str, or_none: bool = False
    ) -> Iterator[tuple[str, str]]:
        """A broken rule unless exactly one of these fields is given, or none with `or_none`."""
        present = [name for name in names if getattr(self, name) is not None]
        if len(present) > 1 or not (present or or_none):
            how = f"given beside {present[0]}" if present else "missing"
            field = present[1] if present else names[0]
            yield field, f"is {how}; allowed is exactly one of {joint.join(names)}"


def allowed(table: type[SceneSection], name: str) -> str:
    """What a field may hold, in words."""
    return field_type(table, name).allowed()


def file_fields(table: type[BaseModel]) -> dict[str, FieldInfo]:
    """The fields of a section by the names that a scene file has for them."""
    return {info.alias or name: info for name, info in table.model_fields.items()}


def field_type(table: type[SceneSection], name: str) -> FieldType:
    """What reads a field; the notes of `Annotated[…] | None` stand inside the union."""
    info = file_fields(table)[name]
    inner = [note for part in get_args(info.annotation) for note in get_args(part)[1:]]
    return next(note for note in (*info.metadata, *inner) if isinstance(note, FieldType))


def plain(value: object) -> object:
    """A section, or a value of a field, as a scene file would have it: defaults written out, SI
    numbers, lists, no None, and no infinity, which stands for what a file leaves out."""
    if isinstance(value, SceneSection):
        fields = type(value).model_fields.items()
        pairs = ((info.alias or name, getattr(value, name)) for name, info in fields)
        return {name: plain(item) for name, item in pairs if item not in (None, inf)}
    if isinstance(value, dict):
        return {name: plain(item) for name, item in value.items()}
    if isinstance(value, tuple):
        return [plain(item) for item in value]
    return value.plain() if hasattr(value, "plain") else value
