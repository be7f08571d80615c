"""Units that a profile's file does not state in a way that a reader must: guessed, and said so.

A text file often names its units in what stands above its numbers ("x_um,height_um"). Where it
does not, sizes tell: samples of surfaces lie some micrometres apart, and roughness is some tenths
of one.
"""

import re
from dataclasses import dataclass

import numpy as np

from comparisons.common.units import LENGTH, UnitError, to_si, unit_in_si

# As they are written, and as a scene has them.
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
    """A value of a field of [profile], as TOML, and how it was come by."""

    value: str
    because: str


def units_in(line: str) -> list[str]:
    """Units of columns that a line of text names, in its order."""
    found = [(match.start(), unit) for pattern, unit in UNITS for match in pattern.finditer(line)]
    return [unit for _, unit in sorted(found)]


def units_of_head(head: list[str], columns: int) -> dict[str, Guess]:
    """x_unit and z_unit by the lines above a table of one or two columns; {} where they are mute.

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
    """Sample spacing by the lines above a column of heights, None where they are mute."""
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
        far = [
            abs(np.log10(max(size, 1e-300) * unit_in_si(unit, LENGTH) / typical))
            for unit in BY_SIZE[name]
        ]
        unit = BY_SIZE[name][int(np.argmin(far))]
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
