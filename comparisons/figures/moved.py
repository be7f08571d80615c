"""Changes between a run and its repetition, and whether they are larger than is stated.

In: the figures and series of a recorded run and of its repetition. Out: a row for each that moved.

A figure may move by the uncertainty that it states itself, as far as its parts are known; an
uncertainty by its own size; a column of a series by the norm of its uncertainties; a verdict not at
all. What states nothing may move by rounding. What a run took or planned is not compared, nor are
estimates, positions, and the levels behind a figure."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from analytic.contact.problem import KKT_TOLERANCE
from comparisons.figures.figure import Figure, Findings, Series

# Relative, between converged solutions on other processors; the same machine gives the same bits.
ROUNDING = KKT_TOLERANCE
Value = float | str | tuple | None


@dataclass(frozen=True)
class Item:
    """Value that is compared, and how far it may move, both over a scale."""

    value: Value  # a number, a text, or the values of a column
    allowed: float = 0.0
    scale: float = 1.0


@dataclass(frozen=True)
class Moved:
    """Something that moved."""

    name: str
    recorded: Value  # None where there is none, as repeated
    repeated: Value
    change: float | None  # relative; None where it has no meaning: verdicts, what came or went
    stated: float | None  # relative
    beyond: bool  # whether it moved by more than is stated


@dataclass(frozen=True)
class Movement:
    """Movements: rows of what `moved`, how many are the `same`, moved by no more than `rounding`,
    and are `new`, of which the record knows nothing."""

    moved: tuple[Moved, ...]
    same: int
    rounding: int
    new: int

    @property
    def beyond(self) -> tuple[Moved, ...]:
        return tuple(row for row in self.moved if row.beyond)


def movement(before: Mapping[str, Item], after: Mapping[str, Item]) -> Movement:
    """Movement of items by their names."""
    rows, same, rounding = [], 0, 0
    for name, item in before.items():
        new = after[name].value if name in after else None
        if item.value == new:
            same += 1
            continue
        row = _moved(name, item, new)
        if row.change is not None and abs(row.change) <= ROUNDING:
            rounding += 1
        else:
            rows.append(row)
    return Movement(tuple(rows), same, rounding, len(set(after) - set(before)))


def items_of(findings: Mapping[str, Findings], other: Mapping[str, object]) -> dict[str, Item]:
    """All that is compared of a run's findings, and `other` numbers and texts, which are exact."""
    items = {}
    for study, of_study in findings.items():
        for figure in of_study.figures:
            items |= dict(_of_figure(figure))
        for series in of_study.series:
            if not series.is_account:
                items |= dict(_of_series(study, series))
    sizes = {name: abs(value) if _is_number(value) else 1.0 for name, value in other.items()}
    return {name: Item(value, 0.0, sizes[name] or 1.0) for name, value in other.items()} | items


def named(study: str, name: str, source: str, at: Mapping[str, float]) -> str:
    """Name as one would say it: contact.peak_pressure [half_plane, friction 0.1]."""
    of = ", ".join(filter(None, (source, *(f"{key} {value:g}" for key, value in at.items()))))
    return f"{study}.{name}" + (f" [{of}]" if of else "")


def _of_figure(figure: Figure) -> Iterator[tuple[str, Item]]:
    source = figure.source + (f" against {figure.against}" if figure.against else "")
    name = named(figure.study, figure.quantity, source, figure.at)
    stated = figure.uncertainty
    sizes = [] if stated is None else [s for s in stated.parts.values() if math.isfinite(s)]
    allowed = sum(sizes)
    scale = 1.0 if figure.against else figure.scale
    yield name, Item(figure.value, allowed, scale)
    if figure.verdict is not None:
        yield f"{name}, verdict", Item(figure.verdict)
    if sizes:
        yield f"{name}, uncertainty", Item(allowed, allowed)
    for part in figure.parts:
        size = allowed if part.uncertainty is None else part.uncertainty
        yield f"{name}, {part.name}", Item(part.value, size if math.isfinite(size) else allowed)
    if figure.spread is not None:
        ends = dict(zip(("low", "high"), figure.spread.interval, strict=True))
        sizes = {"mean": figure.spread.mean, "deviation": figure.spread.deviation} | ends
        for word, value in sizes.items():
            yield f"{name}, {word}", Item(value, allowed, figure.scale)


def _of_series(study: str, series: Series) -> Iterator[tuple[str, Item]]:
    """Columns of numbers; intervals, from start to stop, as one."""
    columns = series.columns
    if set(columns) == {"start", "stop"}:
        name = named(study, series.name, series.source, series.at)
        ends = tuple(zip(columns["start"].values, columns["stop"].values, strict=True))
        length = sum(stop - start for start, stop in ends) or 1.0
        allowed = max(columns["start"].uncertainty or (0.0,)) / length
        yield name, Item(ends, allowed, length)
        return
    for word, column in columns.items():
        if any(isinstance(value, str) for value in column.values):
            continue
        values = tuple(math.nan if value is None else float(value) for value in column.values)
        scale = float(np.sqrt(np.nansum(np.square(values)))) or 1.0
        sizes = [size for size in column.uncertainty or () if math.isfinite(size)]
        name = named(study, f"{series.name}.{word}", series.source, series.at)
        yield name, Item(column.values, math.hypot(*sizes) / scale, scale)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _moved(name: str, item: Item, new: Value) -> Moved:
    old, change = item.value, None
    if isinstance(old, tuple) and isinstance(new, tuple):
        change = _of_columns(old, new)
    elif _is_number(old) and _is_number(new):
        change = new - old
    if change is None:
        return Moved(name, old, new, None, None, True)
    change /= item.scale
    return Moved(name, old, new, change, item.allowed, abs(change) > max(item.allowed, ROUNDING))


def _of_columns(old: tuple, new: tuple) -> float | None:
    """Norm by which two columns differ, or length by which two sets of intervals do; None where one
    is longer, or has a value where the other has none."""
    if old and isinstance(old[0], tuple):
        return _uncovered(old, new)
    if [value is None for value in old] != [value is None for value in new]:
        return None
    known = [(a, b) for a, b in zip(old, new, strict=True) if a is not None]
    return math.hypot(*(b - a for a, b in known))


def _uncovered(one: tuple, other: tuple) -> float:
    """Length [m] that one of two sets of intervals covers and the other does not."""
    ends = np.unique([end for patch in [*one, *other] for end in patch])
    middle = 0.5 * (ends[1:] + ends[:-1])
    covered = np.zeros((2, len(middle)), dtype=bool)
    for row, patches in zip(covered, (one, other), strict=True):
        for start, stop in patches:
            row |= (start < middle) & (middle < stop)
    return float(np.diff(ends) @ (covered[0] ^ covered[1]))
