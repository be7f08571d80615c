"""Cells of tables that figures give, alike wherever they are shown.

In: figures. Out: texts with units, in the digits that are certain."""

from math import isfinite

from comparisons.common.numbers import given_percent, percent, scale_of, significant
from comparisons.figures.figure import Figure


def compared_cells(
    difference: Figure, values: tuple[Figure | None, Figure | None], unit: str
) -> tuple[str, ...]:
    """Two sources' values in one unit, empty where a norm has none, and `judged_cells`."""
    sizes = [figure and figure.value for figure in values]
    scale = scale_of(sizes, unit)
    texts = ("" if size is None else scale.text(size) for size in sizes)
    return *texts, *judged_cells(difference, is_norm=None in sizes)


def judged_cells(difference: Figure, is_norm: bool = False) -> tuple[str, str, str, str]:
    """A difference, signed but for norms, its uncertainty, tolerance and verdict, empty where it is
    not judged."""
    size = difference.numerical
    return (
        percent(difference.value, signed=not is_norm, uncertainty=size),
        percent(size),
        "" if difference.bounds is None else given_percent(difference.tolerance),
        difference.verdict or "",
    )


def stated(figure: Figure | None, unit: float = 1.0, digits: int = 3) -> str:
    """A figure in a unit [SI] with its uncertainty, as far as that is known."""
    if figure is None:
        return ""
    text, size = significant(figure.value / unit, digits), figure.numerical * figure.scale / unit
    return f"{text} ± {significant(size, 1)}" if isfinite(size) else text
