"""The [answers.NAME] sections: where an answer from outside is, and how to read it."""

import os
import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import product
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, StrictInt

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
from comparisons.scenes.fields import Fraction, Number, SceneSection, Several, Text, Unit, optional
from comparisons.scenes.files import read_toml
from comparisons.scenes.header_units import unit_of_column
from comparisons.scenes.profile import Columns

NAME = re.compile(r"[A-Za-z][\w-]{0,39}", re.ASCII)
UNITS = {"length": LENGTH, "stress": PRESSURE}
COMMON = {"length": "mm", "stress": "MPa"}  # an example of each
Offset = Annotated[float, Number(LENGTH)]


class UnitsSection(SceneSection):
    """Units of a file; those of SI where not named."""

    length: Annotated[str, Unit(LENGTH)] | None = optional("of positions")
    stress: Annotated[str, Unit(PRESSURE)] | None = optional("of stresses")


class AnswerSection(SceneSection):
    """Answer of another code, one table for each: NAME begins with a letter and has up to 39 more
    letters, digits, `-` and `_`. A FILE.toml after `--answer` holds such a table itself, with the
    file beside it."""

    file: Annotated[tuple[Text, ...], Several(repeated=True)] = Field(
        description="a file for each resolution of the answer, from the scene's folder"
    )
    columns: Columns = optional(
        "of a table: x and pressure, by name or by number from 0",
        (0, 1),
        examples=[["x", "p"], [0, 2]],
    )
    shear: Columns | None = optional(
        "beside `[partial_slip]`: the column of a table, or the array of a mesh such "
        'as `"-CONTACT.4"`, that holds the traction on the body towards +x, after a minus its '
        "opposite; by default the stress on a mesh's top"
    )
    units: UnitsSection | None = optional("of the file; by default as its columns say, else SI")
    up: Literal["y", "-y", "z", "-z"] | None = optional(
        "axis of the file out of the rough body, with its sign; found by default: the "
        "body reaches far to one side"
    )
    x_origin: Offset = optional("where the scene's origin lies in the file", 0.0)
    z_origin: Offset = optional("the same along `up`", 0.0)
    pressure: Text | None = optional(
        'array of a mesh that holds the pressure, such as `"CONTACT.3"`; by default '
        "minus the normal stress on the body's top"
    )
    step: Annotated[StrictInt, Field(ge=0, le=10**6)] | None = optional(
        "of several in time; the last by default"
    )
    friction: Annotated[float, Number(DIMENSIONLESS, ge=0.0)] | None = optional(
        "coefficient, where the scene has several"
    )
    scatter: Fraction | None = optional("of measured data, relative")

    def unit(self, kind: str, column: str = "") -> float:
        """Unit of a length or a stress in SI: as `units` has it, else as the column's name does,
        else 1. Raises ValueError for a column that says it has another dimension."""
        dimension, unit = UNITS[kind], getattr(self.units, kind, None)
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
        with suppress(UnitError):
            units[kind] = Unit(UNITS[kind]).read(unit)
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
