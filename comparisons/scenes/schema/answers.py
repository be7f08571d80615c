"""The [answers.NAME] sections: where an answer from outside is, and how to read it."""

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from comparisons.common.units import DIMENSIONLESS, LENGTH, PRESSURE, describe, unit_in_si
from comparisons.figures.quantity import LABELS
from comparisons.scenes.scene import AnswerSource
from comparisons.scenes.schema.fields import (
    FieldType,
    Fraction,
    Number,
    OneOf,
    SceneSection,
    Text,
    Unit,
    Whole,
)
from comparisons.scenes.schema.profile import Columns

NAME = re.compile(r"[A-Za-z][\w-]{0,39}", re.ASCII)
PATH = Text("the path of a file, from the scene's folder")
UNITS = {"length": Unit(LENGTH), "stress": Unit(PRESSURE)}


@dataclass(frozen=True)
class Files(FieldType):
    """A path, or one for each resolution."""

    def read(self, given: object) -> tuple[str, ...]:
        values = given if isinstance(given, list | tuple) and given else [given]
        return tuple(PATH.read(value) for value in values)

    def allowed(self) -> str:
        return f"{PATH.allowed()}, or a list of such, one for each resolution"


@dataclass(frozen=True)
class Units(FieldType):
    """A table of the file's units, {length = "mm", stress = "MPa"}; those of SI where not named."""

    def read(self, given: object) -> dict[str, str]:
        if not isinstance(given, dict) or set(given) - set(UNITS):
            raise self.wrong(f"is {describe(given)}")
        return {name: UNITS[name].read(unit) for name, unit in given.items()}

    def allowed(self) -> str:
        return 'a table such as {length = "mm", stress = "MPa"}'


class AnswerSection(SceneSection):
    file: Annotated[tuple[str, ...], Files()]
    columns: Annotated[tuple, Columns()] = (0, 1)
    units: Annotated[dict[str, str], Units()] | None = None
    up: Annotated[str, OneOf(("y", "-y", "z", "-z"))] | None = None
    x_origin: Annotated[float, Number(LENGTH)] = 0.0
    z_origin: Annotated[float, Number(LENGTH)] = 0.0
    pressure: Annotated[str, Text("the name of an array, or of a component of one")] | None = None
    step: Annotated[int, Whole(0, 10**6)] | None = None
    friction: Annotated[float, Number(DIMENSIONLESS, at_least=0.0)] | None = None
    scatter: Fraction | None = None

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if len(self.columns) != 2:
            yield "columns", "is one column; allowed are two, those of x and pressure"


def wrong_name(answers: dict | None) -> str | None:
    """The first name that is none for an answer."""
    return next((n for n in answers or {} if n in LABELS or not NAME.fullmatch(n)), None)


def answer_sources(
    answers: dict[str, AnswerSection] | None, folder: Path
) -> tuple[AnswerSource, ...]:
    """What the sections of a scene in a folder name, in SI units."""
    found = []
    for name, section in (answers or {}).items():
        given = {field: getattr(section, field) for field in AnswerSection.model_fields}
        files = tuple(os.fspath(folder / file) for file in given.pop("file"))
        units = {"length": "m", "stress": "Pa"} | (given.pop("units") or {})
        factors = (unit_in_si(units[name], each.dimension) for name, each in UNITS.items())
        found.append(AnswerSource(name, files, *factors, **given))
    return tuple(found)
