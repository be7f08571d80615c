"""Types of a scene's fields that pydantic lacks, and what a section of a scene is.

A type raises ValueError with what is wrong alone. What is allowed, in words, is the title of its
JSON Schema: messages and the reference page take it from there (`comparisons.scenes.schema`)."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Annotated, Any, ClassVar, Self, get_args

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, StrictStr, model_validator
from pydantic.fields import FieldInfo
from pydantic_core import core_schema

from comparisons.common.units import (
    DIMENSIONLESS,
    LENGTH,
    PRESSURE,
    Dimension,
    describe,
    to_si,
    unit_in_si,
)

# Of a number in SI, but for 0. Products of some of them still fit a double.
SMALLEST, LARGEST = 1e-30, 1e30
MOST_VALUES = 1000  # of a list
LONGEST_TEXT = 1000  # characters
# Of a text with a number and a unit, as JSON Schema has it.
WITH_UNIT = {"type": "string", "pattern": r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*[^\s\d.]"}


def in_si(entry: object, dimension: Dimension) -> float:
    """The value of a number or a text with a unit [SI], of a size that can be computed with."""
    value = to_si(entry, dimension)
    if value != 0.0 and not SMALLEST <= abs(value) <= LARGEST:
        size = f"whose size is not from {SMALLEST:g} to {LARGEST:g} in SI"
        raise ValueError(f"is {describe(entry)}, {size}")
    return value + 0.0  # -0.0 is 0.0


@dataclass(frozen=True)
class Number:
    """A float in SI, of one dimension, within bounds that are named as pydantic's are."""

    dimension: Dimension
    gt: float | None = None
    ge: float | None = None
    lt: float | None = None
    le: float | None = None

    def read(self, entry: object) -> float:
        return in_si(entry, self.dimension)

    def allowed(self) -> str:
        words = {"above": self.gt, "at least": self.ge, "below": self.lt, "at most": self.le}
        bounds = [f"{word} {bound:g}" for word, bound in words.items() if bound is not None]
        return " ".join([self.dimension.phrase, " and ".join(bounds)]).strip() + (
            self.dimension.writing()
        )

    def __get_pydantic_core_schema__(self, source: object, handler: object) -> object:
        number = core_schema.float_schema(gt=self.gt, ge=self.ge, lt=self.lt, le=self.le)
        return core_schema.no_info_before_validator_function(self.read, number)

    def __get_pydantic_json_schema__(self, schema: Mapping, handler: Any) -> dict:
        example = self.dimension.example if self.dimension.si_unit else "2 %"
        text = WITH_UNIT | {"examples": [example]}
        return {"title": self.allowed(), "anyOf": [handler(schema), text]}


@dataclass(frozen=True)
class Several:
    """A list of such; one alone is a list of one."""

    most: int = MOST_VALUES
    repeated: bool = False  # whether one may stand there twice

    def read(self, entry: object, handler: Any) -> tuple:
        values = entry if isinstance(entry, list | tuple) else [entry]
        if not 1 <= len(values) <= self.most:
            raise ValueError(f"is a list of {len(values)} values, not of 1 to {self.most}")
        read = handler(tuple(values))
        for value in () if self.repeated else read:
            if read.count(value) > 1:
                shown = f"{value:g}" if isinstance(value, float) else describe(value)
                raise ValueError(f"lists {shown} twice")
        return read

    def __get_pydantic_core_schema__(self, source: object, handler: Any) -> object:
        return core_schema.no_info_wrap_validator_function(self.read, handler(source))

    def __get_pydantic_json_schema__(self, schema: Mapping, handler: Any) -> dict:
        several = handler(schema) | {"minItems": 1, "maxItems": self.most}
        words = "a list of such" + ", none of them twice" * (not self.repeated)
        return {"anyOf": [several["items"], several | {"title": words}]}


class FieldType(ABC):
    """A type of field that is read by a function of its own."""

    @abstractmethod
    def read(self, entry: object) -> object:
        """The value that `entry`, as TOML has it, stands for."""

    @abstractmethod
    def schema(self) -> dict:
        """JSON Schema of the field; the title is what is allowed, in words."""

    def __get_pydantic_core_schema__(self, source: object, handler: object) -> object:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: Mapping, handler: object) -> dict:
        return self.schema()


@dataclass(frozen=True)
class Unit(FieldType):
    """The name of a unit of one dimension, kept as written."""

    dimension: Dimension

    def read(self, entry: object) -> str:
        unit_in_si(entry, self.dimension)
        return entry.strip()

    def schema(self) -> dict:
        measure, example = self.dimension.phrase.removeprefix("a "), EXAMPLES[self.dimension]
        return {
            "title": f'a unit of {measure} as a string, such as "{example}"',
            "type": "string",
            "examples": [example],
        }


EXAMPLES = {LENGTH: "um", PRESSURE: "MPa"}  # of units


@dataclass(frozen=True)
class Extent:
    """A positive length, in m or in Hertz half-widths as the scene has it."""

    value: float
    in_half_widths: bool

    def metres(self, half_width: float) -> float:
        """The length [m] where the Hertz half-width is `half_width` [m]."""
        return self.value * half_width if self.in_half_widths else self.value

    def plain(self) -> float | str:
        """Value as a scene file has it."""
        return self.value if self.in_half_widths else f"{self.value!r} m"


class ExtentField(FieldType):
    """A length above 0: a number counts Hertz half-widths, a string has a unit."""

    def read(self, entry: object) -> Extent:
        value = in_si(entry, LENGTH)
        if not value > 0.0:
            raise ValueError(f"is {describe(entry)}")
        return Extent(value, in_half_widths=not isinstance(entry, str))

    def schema(self) -> dict:
        words = 'a number of half-widths above 0 or a length above 0 such as "500 um"'
        return {"title": words, "anyOf": [{"type": "number", "exclusiveMinimum": 0}, WITH_UNIT]}


def _printable(text: str) -> str:
    if not text.strip():
        raise ValueError("is blank")
    if not text.isprintable():
        raise ValueError("holds a control character")
    if len(text) > LONGEST_TEXT:
        raise ValueError(f"has {len(text)} characters, more than {LONGEST_TEXT}")
    return text


Text = Annotated[StrictStr, AfterValidator(_printable)]
Length = Annotated[float, Number(LENGTH, gt=0.0)]
Pressure = Annotated[float, Number(PRESSURE, gt=0.0)]
Fraction = Annotated[float, Number(DIMENSIONLESS, gt=0.0, lt=1.0)]


def optional(description: str, default: Any = None, **more: Any) -> Any:
    """A field that a file may leave out: what it is, for the reference page, JSON Schema and
    `init`; its value then; what else pydantic's `Field` takes."""
    return Field(default, description=description, **more)


class FieldError(ValueError):
    """A rule between fields is broken; `field` names the one to change, within its section."""

    def __init__(self, field: str, message: str) -> None:
        super().__init__(message)
        self.field = field


class SceneSection(BaseModel):
    """One section: unknown fields are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)
    STEP: ClassVar[str | None] = None  # of a run, that is skipped where a scene has no such section
    FOLLOW: ClassVar[tuple[str, ...]] = ()  # fields that a named solid may stand for

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        """Rules between fields that do not hold: the field to change, and what is wrong with it.
        Where this does not say what is allowed, the message has it from the field."""
        yield from ()

    def misfits(self, scene: "SceneSection") -> Iterator[tuple[str, str]]:
        """Misfits to the rest of the scene: "section.field" to change, and what is wrong."""
        yield from ()

    def completed(self, scene: "SceneSection") -> Self:
        """Fill in the fields that it leaves out and that follow from the rest of the scene."""
        return self

    @model_validator(mode="after")
    def _hold_to_rules(self) -> Self:
        for field, problem in self.broken_rules():
            raise FieldError(field, problem)
        return self

    def unless_one_of(
        self, names: Sequence[str], or_none: bool = False
    ) -> Iterator[tuple[str, str]]:
        """A broken rule unless exactly one of these fields is given, or none with `or_none`."""
        present = [name for name in names if getattr(self, name) is not None]
        if len(present) > 1 or not (present or or_none):
            how = f"given beside {present[0]}" if present else "missing"
            field = present[1] if present else names[0]
            least = "at most" if or_none else "exactly"
            yield field, f"is {how}; allowed is {least} one of {', '.join(names)}"


def file_fields(table: type[BaseModel]) -> dict[str, FieldInfo]:
    """The fields of a section by the names that a scene file has for them."""
    return {info.alias or name: info for name, info in table.model_fields.items()}


def notes_in(hint: object) -> Iterator[object]:
    """Notes in `Annotated` anywhere in a type hint."""
    for part in get_args(hint):
        yield part
        yield from notes_in(part)


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
