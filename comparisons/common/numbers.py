"""Numbers as a reader wants them: a few digits, with the unit that keeps them small."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from decimal import ROUND_CEILING, Decimal

UNKNOWN = "–"
MINUS = "−"

# Unit names by power of ten over the SI unit, largest first.
_UNITS: dict[str, tuple[tuple[float, str], ...]] = {
    "m": ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"), (1e-12, "pm")),
    "m^2": ((1.0, "m²"), (1e-6, "mm²"), (1e-12, "µm²")),
    "Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")),
    "N/m": ((1e3, "N/mm"), (1.0, "N/m")),
    "J/m": ((1.0, "J/m"), (1e-3, "mJ/m"), (1e-6, "µJ/m")),
    "Pa^2 m": ((1e9, "MPa² mm"), (1e6, "MPa² µm"), (1.0, "Pa² m")),
    "s": ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")),
    "byte": ((1e9, "GB"), (1e6, "MB"), (1e3, "kB"), (1.0, "byte")),
}


@dataclass(frozen=True)
class Scale:
    """A unit to write figures in: `factor` SI units each; `name` is empty for ratios."""

    factor: float
    name: str

    def text(self, value: float | None, digits: int = 4) -> str:
        """The figure [SI] with the unit."""
        return self.named(significant(None if value is None else value / self.factor, digits))

    def named(self, number: str) -> str:
        return f"{number} {self.name}" if self.name and number != UNKNOWN else number


def scale_of(values: Iterable[float | None], unit: str) -> Scale:
    """The unit in which the largest of `values` [SI] has one to three digits before the point."""
    known = [abs(v) for v in values if v is not None and math.isfinite(v)]
    largest = max(known, default=0.0)
    choices = _UNITS.get(unit, ((1.0, unit),))
    for factor, name in choices:
        if largest >= factor * 0.9995:
            return Scale(factor, name)
    if largest > 0.0:
        return Scale(*choices[-1])
    return Scale(*next(choice for choice in choices if choice[0] == 1.0))


def is_whole(text: str) -> bool:
    """True for a whole number from 0 on, in the digits that Python and TOML write."""
    return text.isascii() and text.isdecimal()


def with_unit(value: float | None, unit: str, digits: int = 4) -> str:
    """One figure [SI] in the unit that suits it."""
    return scale_of([value], unit).text(value, digits)


def as_written(value: float | None, unit: str) -> str:
    """A figure [SI] as a scene gives it: no digit more than it has, at most six."""
    scale = scale_of([value], unit)
    return scale.named(plain(None if value is None else value / scale.factor))


def significant(value: float | None, digits: int = 4) -> str:
    """`digits` significant digits, trailing zeros kept; a power of ten for the very small."""
    if value is None or not math.isfinite(value):
        return UNKNOWN
    if value == 0.0:
        return "0"
    if 1e-4 <= abs(value) < 10.0 ** max(digits, 5):
        text = f"{value:#.{digits}g}"
        text = f"{value:.0f}" if "e" in text else text.rstrip(".")
    else:
        mantissa, power = f"{value:.{digits - 1}e}".split("e")
        text = f"{mantissa}e{int(power)}"
    return text.replace("-", MINUS)


def decimal(value: float, places: int = 3) -> str:
    """A number with fixed decimals; what rounds to nothing is 0 without a sign."""
    text = f"{value:.{places}f}"
    return "0" if float(text) == 0.0 else text.replace("-", MINUS)


def percent(
    value: float | None, signed: bool = False, digits: int = 2, uncertainty: float | None = None
) -> str:
    """A ratio in percent with `digits` significant digits; below 1e-6 only a bound.
    Digits that an `uncertainty` (a ratio too) does not support are left out: it ends one beyond
    the uncertainty's leading digit. What rounds to nothing there is zero, without a sign."""
    if value is None or not math.isfinite(value):
        return UNKNOWN
    if value == 0.0:
        return "0 %"
    size = 100.0 * abs(value)
    decimals, last = digits - 1 - _leading(size, digits), math.inf
    if uncertainty and math.isfinite(uncertainty):
        last = 1 - _leading(100.0 * uncertainty, 2)
    if last < decimals:
        decimals = last
    elif size < 1e-4:
        return "< 0.0001 %"
    size = round(size, decimals)
    sign = "" if size == 0.0 else MINUS if value < 0.0 else "+" if signed else ""
    return f"{sign}{size:.{max(0, decimals)}f} %"


def _leading(size: float, digits: int) -> int:
    """Power of ten of the leading digit, once rounded to `digits` of them."""
    return int(f"{size:.{digits - 1}e}".partition("e")[2])


def percent_as_written(value: float) -> str:
    """A ratio of the scene in percent, no digit more than it has."""
    return f"{100.0 * value:.6g} %"


def rounded_up(size: float) -> float:
    """Round up to two digits: a tolerance that a user would write."""
    exact = Decimal(repr(size))
    step = Decimal(1).scaleb(exact.adjusted() - 1)
    return float(exact.quantize(step, ROUND_CEILING)) if size else size


def plain(value: float | None) -> str:
    """A number of the scene: no digit more than it has, at most six."""
    return UNKNOWN if value is None else f"{value:.6g}".replace("-", MINUS)


def listed(numbers: Iterable[float]) -> str:
    """Numbers of the scene, such as friction coefficients, separated by commas."""
    return ", ".join(map(plain, numbers))


def integer(value: int) -> str:
    """Thousands apart by a thin space."""
    return f"{value:,}".replace(",", "\u202f")


def finite(value: object) -> object:
    """JSON has neither NaN nor infinity: None stands for both."""
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
