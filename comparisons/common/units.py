"""Quantities with units: a number in SI, or a string such as "8.2 mm", to an SI number.

pint knows the units. Its registry counts in decimals, so that "8.2 mm" and 0.0082 become the
same double. Loading it takes ten times as long as reading a scene, so the units that scenes use
every day stand in a table here; the tests hold every entry of it against pint."""

import datetime
import math
import re
from contextlib import suppress
from dataclasses import dataclass
from decimal import Decimal
from functools import lru_cache

from comparisons.common.errors import nearest


class UnitError(ValueError):
    """Error where a value has another dimension; `str` says what was given, not what is allowed."""


class UnknownUnitError(UnitError):
    """No unit of any dimension."""


@dataclass(frozen=True)
class Dimension:
    """Dimension of a field: `phrase` for messages, its SI unit, and an example of a value."""

    phrase: str
    si_unit: str
    example: str

    def writing(self) -> str:
        """Forms of writing a value, to follow the phrase in a message."""
        return f': a number in {self.si_unit} or "{self.example}"' if self.si_unit else ""


LENGTH = Dimension("a length", "m", "8.2 mm")
PRESSURE = Dimension("a pressure", "Pa", "207 GPa")
FORCE = Dimension("a force", "N", "100 N")
LOAD = Dimension("a load per length", "N/m", "3.85 N/um")
TIME = Dimension("a time", "s", "300 s")
MEMORY = Dimension("an amount of memory", "byte", "8 GB")
SPEED = Dimension("a speed", "m/s", "1 m/s")
TEMPERATURE = Dimension("a temperature", "K", "293 K")
CONDUCTIVITY = Dimension("a thermal conductivity", "W/m/K", "46 W/m/K")
DENSITY = Dimension("a density", "kg/m^3", "7850 kg/m^3")
SPECIFIC_HEAT = Dimension("a specific heat", "J/kg/K", "460 J/kg/K")
EXPANSION = Dimension("a coefficient of thermal expansion", "1/K", "12 um/m/K")
DIMENSIONLESS = Dimension("a number without unit", "", "0.3")
OF_HEAT = (SPEED, TEMPERATURE, CONDUCTIVITY, DENSITY, SPECIFIC_HEAT, EXPANSION)
DIMENSIONS = (LENGTH, PRESSURE, FORCE, LOAD, TIME, MEMORY, *OF_HEAT, DIMENSIONLESS)

COMMON_UNITS: dict[str, tuple[Dimension, Decimal]] = {
    unit: (dimension, Decimal(factor))
    for dimension, units in (
        (LENGTH, {"m": "1", "mm": "1e-3", "um": "1e-6", "µm": "1e-6", "nm": "1e-9"}),
        (LENGTH, {"angstrom": "1e-10", "inch": "0.0254", "mil": "2.54e-5", "microinch": "2.54e-8"}),
        (PRESSURE, {"Pa": "1", "kPa": "1e3", "MPa": "1e6", "GPa": "1e9"}),
        (FORCE, {"N": "1", "kN": "1e3"}),
        (LOAD, {"N/m": "1", "N/mm": "1e3", "kN/m": "1e3", "kN/mm": "1e6", "N/um": "1e6"}),
        (TIME, {"s": "1", "min": "60", "h": "3600"}),
        (MEMORY, {"byte": "1", "MB": "1e6", "GB": "1e9", "MiB": "1048576", "GiB": "1073741824"}),
        *((measure, {measure.si_unit: "1"}) for measure in OF_HEAT),
        (DIMENSIONLESS, {"%": "1e-2"}),
    )
    for unit, factor in units.items()
}

_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", re.ASCII)
_FACTOR = r"(?:[^\W\d]\w*|%)(?:\s*(?:\*\*|\^)\s*-?[1-9])?"
# pint evaluates whatever arithmetic it is given; it is only shown products of named units
_UNIT = re.compile(rf"(?:1\s*/\s*)?{_FACTOR}(?:\s*[*/]\s*{_FACTOR}|\s+{_FACTOR})*")
_LONGEST_UNIT = 60


def to_si(entry: object, dimension: Dimension) -> float:
    """The value of `entry` in the SI unit of `dimension`.
    `entry` is an int or float, already in SI, or a string "number unit". Raises UnitError for
    anything else, an unknown unit, another dimension, or a value that is not finite."""
    if isinstance(entry, bool) or not isinstance(entry, int | float | str):
        raise UnitError(f"is {describe(entry)}")
    number, factor = entry, None
    if isinstance(entry, str):
        match = _NUMBER.fullmatch(entry)
        if match is None:
            raise UnitError(f"is {describe(entry)}, which is not a number and a unit")
        number, unit = match.groups()
        if not unit:
            raise UnitError(f"is {describe(entry)}, which has no unit")
        factor = _factor(unit, dimension, entry)
    value = math.inf
    with suppress(OverflowError):  # of a long whole number
        value = float(number)
    if factor is not None and value != 0.0 and math.isfinite(value):
        value = float(Decimal(number) * factor)
    if not math.isfinite(value):
        raise UnitError(f"is {describe(entry)}, which is not finite")
    return value


def unit_in_si(unit: object, dimension: Dimension) -> float:
    """SI units in one `unit` (a string such as "um"). Raises UnitError as `to_si` does."""
    if not isinstance(unit, str):
        raise UnitError(f"is {describe(unit)}")
    return float(_factor(unit.strip(), dimension, unit))


def known_units(dimension: Dimension) -> str:
    """Units of every day, for messages."""
    return ", ".join(_everyday(dimension))


def _everyday(dimension: Dimension) -> list[str]:
    return [name for name, (known, _) in COMMON_UNITS.items() if known is dimension]


def describe(entry: object) -> str:
    """A value of a TOML file in the words of a message, cut short where it is long."""
    if isinstance(entry, bool):
        return "true" if entry else "false"
    if isinstance(entry, str):
        shown = entry if len(entry) <= 40 else entry[:37] + "..."
        return f'"{shown}"' if shown.isprintable() else ascii(shown)
    if isinstance(entry, int | float):
        if abs(entry) < 10**20:
            return repr(entry)
        return f"{entry if isinstance(entry, float) else Decimal(entry):.3e}"
    if isinstance(entry, list | tuple):
        return "a list"
    if isinstance(entry, dict):
        return "a table"
    dates = datetime.date | datetime.time
    return "a date or time" if isinstance(entry, dates) else f"of type {type(entry).__name__}"


def _factor(unit: str, dimension: Dimension, entry: str) -> Decimal:
    """SI units in one `unit`, which must measure `dimension`."""
    if unit in COMMON_UNITS:
        known, factor = COMMON_UNITS[unit]
        if known is not dimension:
            hint = (
                f': a force per length is "{entry.strip()}/mm"'
                if (known, dimension) == (FORCE, LOAD)
                else ""
            )
            raise UnitError(f"is {describe(entry)}, {known.phrase}{hint}")
        return factor
    return pint_factor(unit, dimension, entry)


def pint_factor(unit: str, dimension: Dimension, entry: str) -> Decimal:
    """SI units in one `unit`, by pint. Raises UnitError, which quotes `entry`."""
    if _UNIT.fullmatch(unit) is None or len(unit) > _LONGEST_UNIT:
        raise UnknownUnitError(f"is {describe(entry)}, and {describe(unit)} is not a unit")
    registry = _registry()
    try:
        parsed = registry.parse_units(unit)
        # not dimensions: to pint a byte, a radian and a bare number are all dimensionless
        root = registry.get_root_units(parsed)[1]
    except (AttributeError, ValueError, TypeError, ArithmeticError, SyntaxError) as error:
        unknown = f"is {describe(entry)}, and {_unknown(unit, dimension)}"
        raise UnknownUnitError(unknown) from error
    if root != _root(dimension):
        phrases = (known.phrase for known in DIMENSIONS if root == _root(known))
        its = parsed.dimensionality
        other = f"of dimension {its}" if its else "without dimension"
        raise UnitError(f"is {describe(entry)}, {next(phrases, other)}")
    try:
        none, one = (
            Decimal(registry.Quantity(Decimal(count), parsed).to(dimension.si_unit).magnitude)
            for count in (0, 1)
        )
    except (ArithmeticError, TypeError) as error:
        raise UnitError(f"is {describe(entry)}, which cannot be converted") from error
    # 0 dB is 1: a logarithm or a shifted scale has no factor, though some pints convert it
    if none != 0:
        raise UnitError(f"is {describe(entry)}, which cannot be converted")
    return one


def _unknown(unit: str, dimension: Dimension) -> str:
    folded = {name.casefold(): name for name in reversed(_everyday(dimension))}
    near = nearest(unit.casefold(), folded, 0.6)
    hint = f' (did you mean "{folded[near]}"?)' if near else ""
    return f"{describe(unit)} is no known unit{hint}"


def _root(dimension: Dimension) -> object:
    registry = _registry()
    return registry.get_root_units(registry.parse_units(dimension.si_unit))[1]


@lru_cache(maxsize=1)
def _registry():
    import pint

    registry = pint.UnitRegistry(non_int_type=Decimal)
    registry.define("@alias thou = mil")  # the workshop's, not the artillery's
    return registry
