"""The [answers.NAME] sections: where an answer from outside is, and how to read it."""

import os
import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator

from comparisons.common.errors import InputError
from comparisons.common.units import (
    DIMENSIONLESS,
    LENGTH,
    PRESSURE,
    UnitError,
    describe,
    unit_in_si,
)
from comparisons.figures.quantity import LABELS
from comparisons.scenes.fields import (
    FieldType,
    Fraction,
    Number,
    OneOf,
    SceneSection,
    Several,
    Text,
    Unit,
    Whole,
)
from comparisons.scenes.files import read_toml
from comparisons.scenes.header_units import unit_of_column
from comparisons.scenes.profile import Columns

NAME = re.compile(r"[A-Za-z][\w-]{0,39}", re.ASCII)
PATH = Text("the path of a file, from the scene's folder")
UNITS = {"length": Unit(LENGTH), "stress": Unit(PRESSURE)}
COMMON = {"length": "mm", "stress": "MPa"}  # an example of each


@dataclass(frozen=True)
class Units(FieldType):
    """A table of the file's units, {length = "mm", stress = "MPa"}; those of SI where not named."""

    def read(self, entry: object) -> dict[str, str]:
        if not isinstance(entry, dict) or set(entry) - set(UNITS):
            raise self.wrong(f"is {describe(entry)}")
        return {name: UNITS[name].read(unit) for name, unit in entry.items()}

    def allowed(self) -> str:
        return 'a table such as {length = "mm", stress = "MPa"}'


class AnswerSection(SceneSection):
    file: Annotated[tuple[str, ...], Several(PATH, repeated=True)]  # one for each resolution
    columns: Annotated[tuple, Columns()] = (0, 1)  # of a table: those of x and pressure
    # the column of a table, or the array of a mesh, that holds the traction on the body towards +x;
    # with a minus before its name, the opposite one; None: of a mesh the stress on its top
    shear: Annotated[tuple, Columns()] | None = None
    units: Annotated[dict[str, str], Units()] | None = None
    # axis of the file out of the rough body, with its sign; None: found out
    up: Annotated[str, OneOf(("y", "-y", "z", "-z"))] | None = None
    # [m] where the scene's origin lies in the file, along its x and along `up`
    x_origin: Annotated[float, Number(LENGTH)] = 0.0
    z_origin: Annotated[float, Number(LENGTH)] = 0.0
    # array of a mesh that holds it; None: minus the stress on its top
    pressure: Annotated[str, Text("the name of an array, or of a component of one")] | None = None
    step: Annotated[int, Whole(0, 10**6)] | None = None  # of several in time; None: the last
    # coefficient that it is of; None: the only one
    friction: Annotated[float, Number(DIMENSIONLESS, at_least=0.0)] | None = None
    scatter: Fraction | None = None  # relative, of measured data

    def unit(self, kind: str, column: str = "") -> float:
        """In SI, that of a length or a stress: as `units` has it, else as the column's name does,
        else 1. Raises ValueError for a column that says it has another dimension."""
        dimension, unit = UNITS[kind].dimension, (self.units or {}).get(kind)
        try:
            unit = unit or unit_of_column(column, dimension)
        except UnitError as error:
            allowed = f'{dimension.phrase}, or units = {{{kind} = "{COMMON[kind]}"}} if it is one'
            raise ValueError(
                f"its column {describe(column)} {error}; allowed is {allowed}"
            ) from None
        return 1.0 if unit is None else unit_in_si(unit, dimension)

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if len(self.columns) != 2:
            yield "columns", "is one column; allowed are two, those of x and pressure"
        if self.shear is not None and len(self.shear) != 1:
            yield "shear", "is two columns; allowed is one"


def checked_names(answers: dict) -> dict:
    """The answers themselves; raises ValueError for the first name that is none for an answer."""
    wrong = next((n for n in answers if n in LABELS or not NAME.fullmatch(n)), None)
    if wrong is not None:
        short = "a letter and up to 39 letters, digits, - and _, and no model's name"
        raise ValueError(f"has the name {describe(wrong)}; allowed is {short}")
    return answers


SECTION = Annotated[dict[str, AnswerSection], AfterValidator(checked_names)]


def units_named(text: str) -> dict[str, str]:
    """A unit of length and one of stress, or one of them: mm,MPa. Raises InputError for others."""
    units, words = {}, text.split(",")
    for kind, unit in product(UNITS, words):
        with suppress(ValueError):
            units[kind] = UNITS[kind].read(unit)
    if len(units) != len(words):
        allowed = "a unit of length and one of stress, such as mm,MPa"
        raise InputError(f"--units: is {describe(text)}; allowed is {allowed}")
    return units


def answers_named(options: Sequence[str], known: object, units: str | None = None) -> dict:
    """The tables [answers.NAME] of answers given as NAME=FILE, all in the same units.
    A FILE replaces those that the `known` tables have under its name; several of one name are
    its resolutions. A FILE.toml holds the table itself, with files from its own folder. Raises
    InputError for what is neither."""
    tables = dict(known) if isinstance(known, dict) else {}
    named: dict[str, list] = {}
    for text in options:
        name, _, file = text.partition("=")
        if not (name and file):
            raise InputError(f"--answer: is {describe(text)}; allowed is NAME=FILE")
        path = Path(file).absolute()
        table, files = dict(tables.get(name) or {}), [path.name]
        if path.suffix == ".toml":
            table = read_toml(path)
            files = table.get("file", [])
            files = [files] if isinstance(files, str) else files
        named.setdefault(name, []).extend(os.fspath(path.parent / str(one)) for one in files)
        tables[name] = table | {"file": named[name]}
        if units is not None:
            tables[name]["units"] = units_named(units)
    return tables
