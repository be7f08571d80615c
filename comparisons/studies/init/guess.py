"""A measured profile of which only the file is known: read with units and form that are guessed.

A text file often names its units in the lines above its numbers ("x_um,height_um"). Where it does
not, sizes decide: samples of surfaces lie some micrometres apart, and roughness is some tenths of
one. Every guess comes with its reason.
"""

import re
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
from comparisons.common.units import LENGTH, UnitError, to_si, unit_in_si

# Units by the patterns that files write them in.
NAMES = {
    r"nm|nanomet(?:er|re)s?": "nm",
    r"[uµμ]m|microns?|micromet(?:er|re)s?": "um",
    r"mm|millimet(?:er|re)s?": "mm",
    r"(?<=[\[(_])m|met(?:er|re)s?": "m",
}
ALONE = r"(?<![A-Za-zµμ])(?:{})(?![A-Za-z])"
# a unit behind a number is that of one length ("cut-off 0.8 mm") and not of a column
UNITS = [
    (re.compile(rf"(?<!\d)(?<!\d )(?<!\d_){ALONE.format(names)}"), unit)
    for names, unit in NAMES.items()
]
NUMBER = r"(\d+(?:[.,]\d+)?(?:[eE][+-]?\d+)?)"
ANY_UNIT = "|".join(NAMES).replace(r"(?<=[\[(_])m", "m")
SPACINGS = [
    re.compile(
        rf"(?:spacing|step|pitch|increment|interval|dx)\b[^\d\n]*{NUMBER}\W*({ANY_UNIT})\b", re.I
    ),
    re.compile(rf"{NUMBER}\s*({ANY_UNIT})\s+(?:apart|spacing|step|pitch)", re.I),
]
TYPICAL_SPACING, TYPICAL_HEIGHT = 1e-6, 0.5e-6  # [m]
BY_SIZE = {"x_unit": ("mm", "um", "nm", "m"), "z_unit": ("um", "nm", "mm", "m")}


@dataclass(frozen=True)
class Guess:
    """A value of a field of [profile], as TOML, and the reason for it."""

    value: str
    because: str


def units_in(line: str) -> list[str]:
    """Units of columns that a line of text names, in its order."""
    found = [(match.start(), unit) for pattern, unit in UNITS for match in pattern.finditer(line)]
    return [unit for _, unit in sorted(found)]


def units_of_head(head: list[str], columns: int) -> dict[str, Guess]:
    """x_unit and z_unit by the lines above a table of one or two columns; {} where they name none.

    The line that is nearest to the numbers counts; one that names a single unit means both.
    """
    for line in reversed(head):
        named = units_in(line)
        if not named:
            continue
        because = f'by "{_short(line)}" in the file'
        z_unit = Guess(f'"{named[min(columns, len(named)) - 1]}"', because)
        return {"x_unit": Guess(f'"{named[0]}"', because), "z_unit": z_unit}
    return {}


def spacing_of_head(head: list[str]) -> Guess | None:
    """Sample spacing by the lines above a column of heights, None where they state none."""
    for line in head:
        for pattern in SPACINGS:
            if match := pattern.search(line):
                (unit,) = units_in(f"({match[2].lower()})")
                number = match[1].replace(",", ".")
                return Guess(f'"{number} {unit}"', f'by "{_short(line)}" in the file')
    return None


def units_by_size(x: np.ndarray, height: np.ndarray) -> dict[str, Guess]:
    """x_unit and z_unit that bring spacing and roughness nearest to what is usual."""
    rough = height - np.polyval(np.polyfit(x - x.mean(), height, 1), x - x.mean())
    found = {}
    for name, size, typical in (
        ("x_unit", np.median(np.diff(x)), TYPICAL_SPACING),
        ("z_unit", np.std(rough), TYPICAL_HEIGHT),
    ):
        sizes = [max(size, 1e-300) * unit_in_si(unit, LENGTH) for unit in BY_SIZE[name]]
        unit = BY_SIZE[name][int(np.argmin([abs(np.log10(size / typical)) for size in sizes]))]
        found[name] = Guess(f'"{unit}"', "guessed by size alone, the file names none: check it")
    return found


def in_metres(quantity: str) -> float:
    """A unit, or a number with one, as a scene has it in quotes [m]."""
    text = quantity.strip('"')
    try:
        return unit_in_si(text, LENGTH)
    except UnitError:
        return to_si(text, LENGTH)


def _short(line: str) -> str:
    line = line.strip(" #%;/\t").replace('"', "'")
    return line if len(line) <= 40 else f"{line[:37]}..."


MOST_BYTES = BYTES_PER_SAMPLE * MAX_SAMPLES + BYTES_OF_HEADER
ROUNDING = 1e-9  # of the largest height: an rms below is rounding
ARC = 0.5  # an arc is the form where less than this share of the rms beside a line is left


@dataclass(frozen=True)
class ProfileFields:
    """The fields of [profile] that read a file.

    fields   as TOML, without `file`
    reasons  of those that were guessed, by field
    """

    fields: dict[str, str]
    reasons: dict[str, str]


def fields_of_profile(path: Path, given: Mapping[str, str]) -> ProfileFields:
    """The fields that read the profile in a file, guessed where neither it nor `given` has them.

    given   fields of [profile] as TOML: x_unit, z_unit, spacing, row, column
    Raises InputError, one line, for a file that cannot be used, or where no guess is possible.
    """
    try:
        found, read = _complete(path, dict(given))
    except (ProfileError, OSError) as error:
        raise InputError(str(error)) from error
    if read.bridged or read.trimmed:
        found["dropouts"] = Guess('"bridge"', "samples were lost")
    form, because = _form(read.profile)
    found["form"] = Guess(f'"{form}"', because)
    fields = dict(given) | {name: guess.value for name, guess in found.items()}
    return ProfileFields(fields, {name: guess.because for name, guess in found.items()})


def _complete(path: Path, given: dict[str, str]) -> tuple[dict[str, Guess], MeasuredProfile]:
    """The guesses without which the file cannot be read, and the profile read with them."""
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
    """Lines above the numbers of a text file, and its columns; [] and None for any other file."""
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
    """The form to remove, and why: an arc where it leaves far less than a line does."""
    straight, _ = remove_form(profile, "line")
    try:
        curved, removed = remove_form(profile, "arc")
    except ValueError:
        return "line", "no arc fits"
    left, of = np.std(curved.height), np.std(straight.height)
    if left < ARC * of and of > ROUNDING * np.abs(profile.height).max():
        return "arc", f"its radius is {with_unit(abs(removed.radius), 'm')}"
    return "line", "an arc would not remove much more"
