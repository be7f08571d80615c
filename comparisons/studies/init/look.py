"""A measured profile of which nothing is known but its file: read, and what had to be guessed."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analytic.profile import MAX_SAMPLES, Profile
from analytic.surface.form import remove_form
from analytic.surface.readers.columns import BYTES_OF_HEADER, BYTES_PER_SAMPLE
from analytic.surface.readers.files import MeasuredProfile, MissingUnitError, read_measured
from analytic.surface.readers.text import ProfileError, read_lines, read_table
from analytic.surface.readers.topography import MapLine, UnchosenLineError
from comparisons.common.errors import InputError
from comparisons.common.numbers import with_unit
from comparisons.studies.init.guess import (
    Guess,
    in_metres,
    spacing_of_head,
    units_by_size,
    units_of_head,
)

MOST_BYTES = BYTES_PER_SAMPLE * MAX_SAMPLES + BYTES_OF_HEADER
ROUNDING = 1e-9  # of the largest height, below which an rms is none
ROUND = 0.5  # of the heights' rms that an arc takes off more than a line, beyond which it is form


@dataclass(frozen=True)
class Look:
    """A profile and the fields of [profile] that read it.

    fields   as TOML, without `file`
    guesses  field: how it was come by, of those that the caller did not give
    """

    read: MeasuredProfile
    fields: dict[str, str]
    guesses: dict[str, str]


def look(path: Path, asked: Mapping[str, str]) -> Look:
    """Read the profile in a file, guessing what neither the file nor `asked` says.

    asked   fields of [profile] as TOML: x_unit, z_unit, spacing, row, column
    Raises InputError, one line, for a file that cannot be used, or that lacks what no guess gives.
    """
    try:
        found, read = _complete(path, dict(asked))
    except (ProfileError, OSError) as error:
        raise InputError(str(error)) from error
    fields = dict(asked)
    if read.bridged or read.trimmed:
        found["dropouts"] = Guess('"bridge"', "samples were lost")
    form, because = _form(read.profile)
    found["form"] = Guess(f'"{form}"', because)
    fields |= {name: guess.value for name, guess in found.items()}
    return Look(read, fields, {name: guess.because for name, guess in found.items()})


def _complete(path: Path, given: dict[str, str]) -> tuple[dict[str, Guess], MeasuredProfile]:
    """Guesses of what it takes to read the file at all, and what they read."""
    head, columns = _head(path)
    found: dict[str, Guess] = {}
    if columns == 1 and "x_unit" in given:
        raise InputError(f"{path}: holds heights alone; allowed is --spacing instead of --x-unit")
    if columns == 1 and "spacing" not in given:
        spacing = spacing_of_head(head)
        if spacing is None:
            raise InputError(_no_spacing(path, "holds heights alone"))
        found["spacing"] = spacing
    while True:
        fields = given | {name: guess.value for name, guess in found.items()}
        try:
            return found, _read(path, fields)
        except UnchosenLineError as error:
            found["row"] = _middle(error.rows)
        except MissingUnitError as error:
            if error.field == "spacing":
                raise InputError(_no_spacing(path, error.message)) from error
            units = units_of_head(head, columns) if columns else {}
            units = units or _units_by_size(path, fields)
            if "spacing" in fields:
                units.pop("x_unit")
            found |= {name: guess for name, guess in units.items() if name not in given}


def _no_spacing(path: Path, what: str) -> str:
    return (
        f"{path}: {what}, and how far apart samples are it does not say; "
        'allowed is --spacing, such as "0.5 um"'
    )


def _middle(rows: int) -> Guess:
    return Guess(str(rows // 2), f"the middle one of {rows}")


def _units_by_size(path: Path, fields: dict[str, str]) -> dict[str, Guess]:
    bare = {"x_unit": '"m"', "z_unit": '"m"'} | fields
    if "spacing" in fields:
        del bare["x_unit"]
    try:
        profile = _read(path, bare).profile
    except UnchosenLineError as error:
        profile = _read(path, bare | {"row": _middle(error.rows).value}).profile
    return units_by_size(profile.x, profile.height)


def _head(path: Path) -> tuple[list[str], int | None]:
    """Lines above the numbers of a text file, and its columns; none for any other file."""
    try:
        table = read_table(path, MOST_BYTES, one_column=False)
        return read_lines(path, MOST_BYTES)[: table.lines[0] - 1], table.numbers.shape[1]
    except ProfileError:
        return [], None


def _read(path: Path, fields: Mapping[str, str]) -> MeasuredProfile:
    """The profile as these fields of [profile] read it, lost samples bridged."""
    scales = {name: in_metres(fields[name]) for name in ("x_unit", "z_unit") if name in fields}
    chosen = {name: int(fields[name]) for name in ("row", "column") if name in fields}
    return read_measured(
        path,
        x_scale=scales.get("x_unit"),
        height_scale=scales.get("z_unit"),
        spacing=in_metres(fields["spacing"]) if "spacing" in fields else None,
        dropouts="bridge",
        chosen=MapLine(**chosen) if chosen else None,
    )


def _form(profile: Profile) -> tuple[str, str]:
    """The form to take off: an arc where that leaves far less than a line does."""
    straight, _ = remove_form(profile, "line")
    try:
        curved, removed = remove_form(profile, "arc")
    except ValueError:
        return "line", "no arc fits"
    left, of = np.std(curved.height), np.std(straight.height)
    if left < ROUND * of and of > ROUNDING * np.abs(profile.height).max():
        return "arc", f"its radius is {with_unit(abs(removed.radius), 'm')}"
    return "line", "an arc would not take off much more"
