"""A measured profile of which only the file is known: read with units and form that are guessed.

A text file often names its units in the lines above its numbers ("x_um,height_um"). Where it does
not, sizes decide: samples of surfaces lie some micrometres apart, and roughness is some tenths of
one. Every guess comes with its reason."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analytic.profile import Profile
from analytic.surface.form import remove_form
from analytic.surface.readers.files import (
    MeasuredProfile,
    MissingUnitError,
    open_measured,
    profile_of,
)
from analytic.surface.readers.source import ProfileError
from analytic.surface.readers.text import ColumnsError, ProfileTable, chosen_columns
from analytic.surface.readers.topography import MapLine, Topography, UnchosenLineError
from comparisons.campaigns.init.scene_text import toml, value_of
from comparisons.common.errors import InputError
from comparisons.common.numbers import with_unit
from comparisons.common.units import (
    LENGTH,
    UnitError,
    UnknownUnitError,
    known_units,
    to_si,
    unit_in_si,
)

# Units by the patterns that files write them in.
NAMES = {
    r"Å|angstr(?:o|ö|oe)ms?": "angstrom",
    r"nm|nanomet(?:er|re)s?": "nm",
    r"[uµμ]m|microns?|micromet(?:er|re)s?": "um",
    r"[uµμ]in|(?:micro|[uµμ])-?inch(?:es)?": "microinch",
    r"mm|millimet(?:er|re)s?": "mm",
    r"mils?|thou": "mil",
    r"(?<=[\[(_])in|inch(?:es)?": "inch",
    r"(?<=[\[(_])m|met(?:er|re)s?": "m",
}
ALONE = r"(?<![A-Za-zµμ])(?<!micro-)(?:{})(?![A-Za-z])"
# a unit behind a number is that of one length ("cut-off 0.8 mm") and not of a column
UNITS = [
    (re.compile(rf"(?<!\d)(?<!\d )(?<!\d_){ALONE.format(names)}", re.I), unit)
    for names, unit in NAMES.items()
]
# What stands alone in brackets behind a column's name is its unit.
BRACKETED = re.compile(r"\[\s*([^\s\d\[\],;]+)\s*\]|\(\s*([^\s\d(),;]+)\s*\)")
NUMBER = r"(\d+(?:[.,]\d+)?(?:[eE][+-]?\d+)?)"
ANY_UNIT = "|".join(NAMES).replace(r"(?<=[\[(_])", "")
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
    """Units of columns that a line of text names, in its order. Those in brackets need not be
    known: they come out as they stand, unless they are in round ones and no unit at all."""
    found = {match.start(): unit for pattern, unit in UNITS for match in pattern.finditer(line)}
    for match in BRACKETED.finditer(line):
        group = 1 if match[1] else 2
        if match.start(group) not in found and (group == 1 or _measures(match[group])):
            found[match.start(group)] = match[group]
    return [found[start] for start in sorted(found)]


def _measures(word: str) -> bool:
    """Whether a word of two letters or more is a unit, of whatever dimension."""
    try:
        unit_in_si(word, LENGTH)
    except UnknownUnitError:
        return False
    except UnitError:
        return len(word) > 1
    return True


def units_of_head(head: list[str], columns: int) -> dict[str, Guess]:
    """x_unit and z_unit by the lines above a table of one or two columns; {} where they name none.
    The line that is nearest to the numbers counts; one that names a single unit means both."""
    for line in reversed(head):
        named = units_in(line)
        if not named:
            continue
        because = f'by "{_short(line)}" in the file'
        z_unit = Guess(toml(named[min(columns, len(named)) - 1]), because)
        return {"x_unit": Guess(toml(named[0]), because), "z_unit": z_unit}
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


LAY = 1.3  # ratio of slopes above which one way is across the lay
FEWEST_ACROSS = 64  # samples of a column that is suggested
ROUNDING = 1e-9  # of the largest height: an rms below is rounding
ARC = 0.5  # an arc is the form where less than this share of the rms beside a line is left


@dataclass(frozen=True)
class ProfileFields:
    """The fields of [profile] that read a file."""

    fields: dict[str, str]  # as TOML, without `file`
    reasons: dict[str, str]  # of those that were guessed, by field


def fields_of_profile(path: Path, given: Mapping[str, str]) -> ProfileFields:
    """The fields that read the profile in a file, guessed where neither it nor `given` has them.

    given   fields of [profile] as TOML: x_unit, z_unit, spacing, columns, channel, row, column
    Raises InputError, one line, for a file that cannot be used, or where no guess is possible."""
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
    found: dict[str, Guess] = {}
    opened = _opened(path, given, found)
    table = opened if isinstance(opened, ProfileTable) else None
    columns = None if table is None else table.numbers.shape[1]
    if columns == 1 and "x_unit" in given:
        raise InputError(f"{path}: holds heights alone; allowed is --spacing instead of --x-unit")
    if columns == 1 and "spacing" not in given:
        spacing = spacing_of_head(list(table.head))
        if spacing is None:
            raise InputError(_no_spacing(path, "holds heights alone"))
        found["spacing"] = spacing
    while True:
        fields = given | {name: guess.value for name, guess in found.items()}
        try:
            return found, _profile(opened, fields)
        except UnchosenLineError:
            found |= _line_of(opened)
        except MissingUnitError as error:
            if error.field == "spacing":
                raise InputError(_no_spacing(path, error.message)) from error
            units = {} if table is None else _units_of(table, "columns" in fields)
            units = units or _units_by_size(opened, fields)
            if "spacing" in fields:
                units.pop("x_unit")
            units = {name: guess for name, guess in units.items() if name not in given}
            for name, guess in units.items():
                _check_unit(path, name, guess)
            found |= units


def _opened(
    path: Path, given: Mapping[str, str], found: dict[str, Guess]
) -> ProfileTable | Topography:
    """What the file holds; columns that are guessed are put into `found`."""
    how = {name: value_of(given[name]) for name in ("columns", "channel") if name in given}
    try:
        opened = open_measured(path, **how, one_column="spacing" in given)
    except ColumnsError as error:
        columns = _columns_of(error.table)
        if columns is None:
            raise
        names = error.table.names or range(error.table.numbers.shape[1])
        found["columns"] = Guess(toml(columns), f"of {', '.join(map(str, names))}")
        return chosen_columns(error.table, columns)
    if isinstance(opened, Topography) and len(opened.channels) > 1 and "channel" not in given:
        found["channel"] = Guess(
            toml(opened.channel), f"the default one of {', '.join(opened.channels)}"
        )
    return opened


def _columns_of(table: ProfileTable) -> list[int] | None:
    """The columns of x and height: x is the first that ascends or descends, but no mere count of
    the rows before another such; the height follows it. None where there are none."""
    numbers, width = table.numbers, table.numbers.shape[1]
    steps = np.diff(numbers, axis=0)
    ordered = [i for i in range(width) if np.all(steps[:, i] > 0.0) or np.all(steps[:, i] < 0.0)]
    first = ordered[0] if ordered else 0
    if len(ordered) > 1 and np.all(steps[:, first] == 1.0) and numbers[0, first] <= 1.0:
        ordered = ordered[1:]
    if not ordered or ordered[0] + 1 == width:
        return None
    return [ordered[0], ordered[0] + 1]


def _units_of(table: ProfileTable, chosen: bool) -> dict[str, Guess]:
    """Units by the names of chosen columns where each names one, else by the lines above them."""
    named = [units_in(name) for name in table.names]
    if chosen and named and all(len(units) == 1 for units in named):
        head = [", ".join(table.names)]
        return units_of_head(head, len(named))
    return units_of_head(list(table.head), table.numbers.shape[1])


def _line_of(found: Topography) -> dict[str, Guess]:
    """The middle row or column of a map, whichever runs across the lay: along the steeper way."""
    rows, columns = found.heights.shape
    along, across = found.pitch or (1.0, 1.0)
    slopes = []
    for axis, pitch in ((1, along), (0, across)):
        squares = np.diff(found.heights, axis=axis) ** 2
        mean = squares[np.isfinite(squares)].mean() if np.any(np.isfinite(squares)) else 0.0
        slopes.append(float(np.sqrt(mean)) / pitch)
    by_row, by_column = slopes
    steep, gentle = max(slopes), min(slopes)
    if steep < LAY * gentle or steep == 0.0:
        why = "slopes are alike both ways, so there is no lay"
    else:
        ratio = f"{steep / gentle:.1f} times those" if gentle > 0.0 else "all that there are, none"
        ratio += " the other way"
        why = f"across the lay: slopes along {{}} are {ratio}"
    if by_column >= LAY * by_row and rows >= FEWEST_ACROSS:
        return {"column": Guess(str(columns // 2), _middle(columns, why.format("columns")))}
    if by_column >= LAY * by_row:
        why = f"along the lay: a column has {rows} samples only"
    return {"row": Guess(str(rows // 2), _middle(rows, why.format("rows")))}


def _middle(count: int, why: str) -> str:
    return f"the middle one of {count}, {why}"


def _no_spacing(path: Path, what: str) -> str:
    return (
        f"{path}: {what}, and how far apart samples are it does not say; "
        'allowed is --spacing, such as "0.5 um"'
    )


def _check_unit(path: Path, name: str, guess: Guess) -> None:
    try:
        in_metres(guess.value)
    except UnitError:
        option = f"--{name.replace('_', '-')}"
        raise InputError(
            f"{path}: {guess.value} is no known unit of length ({guess.because}); known are "
            f"{known_units(LENGTH)}; allowed is {option}"
        ) from None


def _units_by_size(opened: ProfileTable | Topography, fields: dict[str, str]) -> dict[str, Guess]:
    bare = {"x_unit": '"m"', "z_unit": '"m"'} | fields
    if "spacing" in fields:
        del bare["x_unit"]
    try:
        profile = _profile(opened, bare).profile
    except UnchosenLineError:
        line = {name: guess.value for name, guess in _line_of(opened).items()}
        profile = _profile(opened, bare | line).profile
    return units_by_size(profile.x, profile.height)


def _profile(opened: ProfileTable | Topography, fields: Mapping[str, str]) -> MeasuredProfile:
    """The profile as these fields of [profile] read it, lost samples bridged."""
    scales = {name: in_metres(fields[name]) for name in ("x_unit", "z_unit") if name in fields}
    chosen = {name: int(fields[name]) for name in ("row", "column") if name in fields}
    return profile_of(
        opened,
        x_scale=scales.get("x_unit"),
        height_scale=scales.get("z_unit"),
        spacing=in_metres(fields["spacing"]) if "spacing" in fields else None,
        dropouts="bridge",
        chosen=MapLine(**chosen) if chosen else None,
    )


def _form(profile: Profile) -> tuple[str, str]:
    straight, _ = remove_form(profile, "line")
    try:
        curved, removed = remove_form(profile, "arc")
    except ValueError:
        return "line", "no arc fits"
    left, of = np.std(curved.height), np.std(straight.height)
    if left < ARC * of and of > ROUNDING * np.abs(profile.height).max():
        return "arc", f"its radius is {with_unit(abs(removed.radius), 'm')}"
    return "line", "an arc would not remove much more"
