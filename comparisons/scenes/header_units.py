"""Units that a text file names in the lines above its numbers, such as "x_um,height_um"; those of
columns of any dimension, such as "p [MPa]"."""

import re

from analytic.surface.readers.text import ProfileTable
from comparisons.common.units import LENGTH, Dimension, UnitError, UnknownUnitError, unit_in_si

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
# So does what stands behind an underscore or a slash, where it is one: "p_MPa", "x / mm", "p_max".
BEHIND = re.compile(r"(?:_|\s/\s*)([^\W\d_][^\s_,;]*)$")
SQUARE = re.compile(r"(?<=m)\s?(?:2|²)$")  # mm2
Guesses = dict[str, tuple[object, str]]  # by field of [profile]: its value, and the reason for it


def units_in(line: str) -> list[str]:
    """Units of columns that a line of text names, in its order. Those in brackets need not be
    known: they come out as they stand, unless they are in round ones and no unit at all."""
    units = {match.start(): unit for pattern, unit in UNITS for match in pattern.finditer(line)}
    for match in BRACKETED.finditer(line):
        group = 1 if match[1] else 2
        if match.start(group) not in units and (group == 1 or _measures(match[group])):
            units[match.start(group)] = match[group]
    return [units[start] for start in sorted(units)]


def unit_of_column(name: str, dimension: Dimension) -> str | None:
    """The unit that a column's name says its numbers are in; None where it says none. Raises
    UnitError for one of another dimension in brackets."""
    for pattern in (BRACKETED, BEHIND):
        if (match := pattern.search(name)) is not None:
            unit = SQUARE.sub("^2", next(filter(None, match.groups())))
            try:
                unit_in_si(unit, dimension)
                return unit
            except UnitError as error:
                if pattern is BRACKETED and not isinstance(error, UnknownUnitError):
                    raise
    return None


def _measures(word: str) -> bool:
    """True if a word of two letters or more is a unit, of whatever dimension."""
    try:
        unit_in_si(word, LENGTH)
    except UnknownUnitError:
        return False
    except UnitError:
        return len(word) > 1
    return True


def header_units(table: ProfileTable, chosen: bool) -> Guesses:
    """Units by the names of chosen columns where each names one, else by the lines above a table
    of one or two columns; {} where they name none. The line that is nearest to the numbers counts;
    one that names a single unit means both."""
    head, columns = table.head, table.numbers.shape[1]
    named = [units_in(name) for name in table.names]
    if chosen and named and all(len(units) == 1 for units in named):
        head, columns = [", ".join(table.names)], len(named)
    for line in reversed(head):
        if units := units_in(line):
            because = f'by "{short(line)}" in the file'
            last = units[min(columns, len(units)) - 1]
            return {"x_unit": (units[0], because), "z_unit": (last, because)}
    return {}


def short(line: str) -> str:
    """A line of a file as a reason quotes it."""
    line = line.strip(" #%;/\t").replace('"', "'")
    return line if len(line) <= 40 else f"{line[:37]}..."
