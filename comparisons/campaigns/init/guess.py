"""A measured profile of which only the file is known: read with units and form that are guessed.

A text file often names its units in the lines above its numbers ("x_um,height_um"). Where it does
not, sizes decide: samples of surfaces lie some micrometres apart, and roughness is some tenths of
one. Every guess comes with its reason."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
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
from comparisons.common.errors import InputError
from comparisons.common.numbers import with_unit
from comparisons.common.units import LENGTH, UnitError, known_units, to_si, unit_in_si
from comparisons.scenes.header_units import NAMES, Guesses, header_units, short, units_in

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
LINES = ("row", "column")  # fields that choose a line of a map
LAY = 1.3  # ratio of slopes above which one way is across the lay
FEWEST_ACROSS = 64  # samples of a column that is suggested
ROUNDING = 1e-9  # of the largest height: an rms below is rounding
ARC = 0.5  # an arc is the form where less than this share of the rms beside a line is left

Opened = ProfileTable | Topography


@dataclass(frozen=True)
class ProfileFields:
    """The fields of [profile] that read a file, without `file`: those that are set, and guesses."""

    fields: dict[str, object]
    reasons: dict[str, str] = field(default_factory=dict)  # of those that were guessed

    def add(self, guesses: Guesses) -> None:
        for name, (value, because) in guesses.items():
            self.fields[name], self.reasons[name] = value, because


def fields_of_profile(path: Path, fields: Mapping[str, object]) -> ProfileFields:
    """The fields that read the profile in a file, guessed where neither it nor `fields` has them.

    fields  of [profile]: x_unit, z_unit, spacing, columns, channel, row, column
    Raises InputError, one line, for a file that cannot be used, or where no guess is possible."""
    chosen = ProfileFields(dict(fields))
    try:
        measured = _completed(path, chosen)
    except (ProfileError, OSError) as error:
        raise InputError(str(error)) from error
    if measured.bridged or measured.trimmed:
        chosen.add({"dropouts": ("bridge", "samples were lost")})
    chosen.add({"form": _form(measured.profile)})
    return chosen


def _completed(path: Path, chosen: ProfileFields) -> MeasuredProfile:
    """The profile, read with what was guessed because it could not be read without."""
    fields = chosen.fields
    opened = _opened(path, chosen)
    table = opened if isinstance(opened, ProfileTable) else None
    if table is not None and table.numbers.shape[1] == 1:
        if "x_unit" in fields:
            what = "holds heights alone; allowed is --spacing instead of --x-unit"
            raise InputError(f"{path}: {what}")
        if "spacing" not in fields:
            chosen.add(spacing_of_head(table.head))
            if "spacing" not in fields:
                raise InputError(_no_spacing(path, "holds heights alone"))
    while True:
        try:
            return _profile(opened, fields)
        except UnchosenLineError:
            chosen.add(_line_of(opened))
        except MissingUnitError as error:
            if error.field == "spacing":
                raise InputError(_no_spacing(path, error.message)) from error
            units = {} if table is None else header_units(table, "columns" in fields)
            units = units or _units_by_size(opened, fields)
            needed = {"z_unit"} if "spacing" in fields else {"x_unit", "z_unit"}
            units = {name: units[name] for name in units if name in needed - fields.keys()}
            _check_units(path, units)
            chosen.add(units)


def _opened(path: Path, chosen: ProfileFields) -> Opened:
    """Table or topography in the file, with guessed columns or channel where it has several."""
    fields = chosen.fields
    how = {name: fields[name] for name in ("columns", "channel") if name in fields}
    how |= {"one_column": "spacing" in fields, "is_map": not fields.keys().isdisjoint(LINES)}
    try:
        opened = open_measured(path, **how)
    except ColumnsError as error:
        columns = _columns_of(error.table)
        if columns is None:
            raise
        names = error.table.names or range(error.table.numbers.shape[1])
        chosen.add({"columns": (columns, f"of {', '.join(map(str, names))}")})
        return chosen_columns(error.table, columns)
    if isinstance(opened, Topography) and len(opened.channels) > 1 and "channel" not in fields:
        because = f"the default one of {', '.join(opened.channels)}"
        chosen.add({"channel": (opened.channel, because)})
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


def spacing_of_head(head: list[str] | tuple[str, ...]) -> Guesses:
    """Sample spacing by the lines above a column of heights, {} where they state none."""
    for line in head:
        for pattern in SPACINGS:
            if match := pattern.search(line):
                (unit,) = units_in(f"({match[2].lower()})")
                number = match[1].replace(",", ".")
                return {"spacing": (f"{number} {unit}", f'by "{short(line)}" in the file')}
    return {}


def _units_by_size(opened: Opened, fields: Mapping[str, object]) -> Guesses:
    """x_unit and z_unit that bring spacing and roughness nearest to what is usual."""
    bare = {"x_unit": "m", "z_unit": "m"} | fields
    if "spacing" in fields:
        del bare["x_unit"]
    profile = _profile(opened, bare).profile
    x, height = profile.x - profile.x.mean(), profile.height
    rough = height - np.polyval(np.polyfit(x, height, 1), x)
    guesses = {}
    for name, size, typical in (
        ("x_unit", np.median(np.diff(profile.x)), TYPICAL_SPACING),
        ("z_unit", np.std(rough), TYPICAL_HEIGHT),
    ):
        sizes = [max(size, 1e-300) * unit_in_si(unit, LENGTH) for unit in BY_SIZE[name]]
        unit = BY_SIZE[name][int(np.argmin([abs(np.log10(size / typical)) for size in sizes]))]
        guesses[name] = unit, "guessed by size alone, the file names none: check it"
    return guesses


def _in_metres(quantity: str) -> float:
    """A unit, or a number with one [m]."""
    try:
        return unit_in_si(quantity, LENGTH)
    except UnitError:
        return to_si(quantity, LENGTH)


def _check_units(path: Path, units: Guesses) -> None:
    for name, (unit, because) in units.items():
        try:
            _in_metres(unit)
        except UnitError:
            raise InputError(
                f'{path}: "{unit}" is no known unit of length ({because}); known are '
                f"{known_units(LENGTH)}; allowed is {option_of(name)}"
            ) from None


def option_of(field: str) -> str:
    """The option of `crosscheck init` for a field of [profile]."""
    return f"--{field.replace('_', '-')}"


def _line_of(topography: Topography) -> Guesses:
    """The middle row or column of a map, whichever runs across the lay: along the steeper way."""
    rows, columns = topography.heights.shape
    along, across = topography.pitch or (1.0, 1.0)
    slopes = []
    for axis, pitch in ((1, along), (0, across)):
        squares = np.diff(topography.heights, axis=axis) ** 2
        mean = squares[np.isfinite(squares)].mean() if np.any(np.isfinite(squares)) else 0.0
        slopes.append(float(np.sqrt(mean)) / pitch)
    by_row, by_column = slopes
    steep, gentle = max(slopes), min(slopes)
    if steep < LAY * gentle or steep == 0.0:
        why = "slopes are alike both ways, so there is no lay"
    else:
        ratio = f"{steep / gentle:.1f} times those" if gentle > 0.0 else "all that there are, none"
        why = f"across the lay: slopes along {{}} are {ratio} the other way"
    if by_column >= LAY * by_row and rows >= FEWEST_ACROSS:
        because = f"the middle one of {columns}, {why.format('columns')}"
        return {"column": (columns // 2, because)}
    if by_column >= LAY * by_row:
        why = f"along the lay: a column has {rows} samples only"
    return {"row": (rows // 2, f"the middle one of {rows}, {why.format('rows')}")}


def _no_spacing(path: Path, what: str) -> str:
    return (
        f"{path}: {what}, and how far apart samples are it does not say; "
        'allowed is --spacing, such as "0.5 um"'
    )


def _profile(opened: Opened, fields: Mapping[str, object]) -> MeasuredProfile:
    """The profile as these fields of [profile] read it, lost samples bridged."""
    lengths = ("x_unit", "z_unit", "spacing")
    metres = {name: _in_metres(fields[name]) for name in lengths if name in fields}
    line = {name: fields[name] for name in LINES if name in fields}
    return profile_of(
        opened,
        x_scale=metres.get("x_unit"),
        height_scale=metres.get("z_unit"),
        spacing=metres.get("spacing"),
        dropouts="bridge",
        chosen=MapLine(**line) if line else None,
    )


def _form(profile: Profile) -> tuple[str, str]:
    """The kind of form to remove, and why."""
    straight, _ = remove_form(profile, "line")
    try:
        curved, removed = remove_form(profile, "arc")
    except ValueError:
        return "line", "no arc fits"
    left, of = np.std(curved.height), np.std(straight.height)
    if left < ARC * of and of > ROUNDING * np.abs(profile.height).max():
        return "arc", f"its radius is {with_unit(abs(removed.radius), 'm')}"
    return "line", "an arc would not remove much more"
