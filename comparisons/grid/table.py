"""The tables of a sweep: a row a point, the scatter of every figure; and its warnings.

In: the content of sweep.json. Out: tables for the terminal, lines."""

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from operator import itemgetter
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import percent, percent_as_written, rounded_up, with_unit
from comparisons.figures.figure import grouped
from comparisons.figures.quantity import MODELS, QUANTITIES, WHOLE, error_text
from comparisons.grid.points import FAILED
from comparisons.grid.sweep_picture import DRAWN, SAMPLES, Axis
from comparisons.judging import contact
from comparisons.judging.study import MODEL_ERROR
from comparisons.output.records import Row
from comparisons.output.terminal import PLAIN, plain_table
from comparisons.studies import quantity_of
from comparisons.studies.friction import PARTIAL_SLIP
from comparisons.studies.heat import STUDY as HEAT

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.table import Table

NAMED = ("study", "quantity", "source", "friction")  # of the figures whose scatter is stated
MOST_SHOWN = 100  # points of the table; all are in the files
NOT_COMPARED = "not compared"  # verdict of a run of one model

Cell = Callable[[dict], str]  # of a column, by point


def warnings_of(content: dict) -> Iterator[str]:
    """Every plausibility warning once, with the values of the first point that has it and how many
    more have it; without where all have."""
    points = content["points"]
    by_text: dict[str, list[str]] = {}
    axes = [Axis.of(**swept) for swept in content["over"]]
    for point in points:
        at = ", ".join(a.said(v) for a, v in zip(axes, point["values"], strict=True))
        for text in point.get("warnings", ()):
            by_text.setdefault(text, []).append(at)
    for text, (at, *others) in by_text.items():
        more = f" and {len(others)} more" if others else ""
        yield text if len(others) + 1 == len(points) > 1 else f"at {at}{more}: {text}"


def points_table(content: dict) -> "tuple[RenderableType, ...]":
    """A row a point: its values, and every column that has something to say of any point; and how
    many more there are."""
    from rich.text import Text

    shown = content["points"][:MOST_SHOWN]
    axes = [Axis.of(**swept) for swept in content["over"]]
    titles = [f"{axis.field}\n[{axis.unit}]" if axis.unit else axis.field for axis in axes]
    columns = POINT_COLUMNS | (_errors(shown) or FIGURES)
    cells = {title: [cell(point) for point in shown] for title, cell in columns.items()}
    cells = {title: column for title, column in cells.items() if any(column)}
    values = zip(*(point["values"] for point in shown), strict=True)
    at = [map(axis.text, column) for axis, column in zip(axes, values, strict=True)]
    heads = (Text(title.translate(PLAIN)) for title in (*titles, *cells))
    table = plain_table(numbers=heads, rows=zip(*at, *cells.values(), strict=True))
    left = len(content["points"]) - MOST_SHOWN
    return table, *([f"{left} points more are in the files"] if left > 0 else [])


def _verdict(point: dict) -> str:
    verdict = point.get("verdict", FAILED)
    return "" if verdict == NOT_COMPARED else verdict


def _within(point: dict) -> str:
    size = point.get("within")
    return "" if size is None else percent_as_written(rounded_up(size))


def _figure(quantity: str, point: dict) -> str:
    """The largest value over friction, by the first model."""
    rows = [row for row in point["rows"] if row["study"] == contact.NAME and not row["against"]]
    wanted = {"quantity": quantity, "source": rows[0]["source"]}.items() if rows else {}
    values = [row["value"] for row in rows if wanted <= row.items()]
    return with_unit(max(values), QUANTITIES[quantity].unit) if values else ""


# Columns by title, beside the swept values: what each says of a point.
POINT_COLUMNS: dict[str, Cell] = {"verdict": _verdict, "right\nwithin": _within}
POINT_COLUMNS |= {"warnings": lambda point: str(len(point.get("warnings", ())) or "")}
FIGURES: dict[str, Cell] = {QUANTITIES[n].short: partial(_figure, n) for n in DRAWN}


def _errors(points: list[dict]) -> dict[str, Cell]:
    """Columns of the half-plane's judged errors."""
    names = {row["quantity"] for point in points for row in _judged(point)}
    ordered = (name for name in QUANTITIES if name in names)
    return {f"{QUANTITIES[n].short}\nerror, %": partial(_error, n) for n in ordered}


def _judged(point: dict) -> list[Row]:
    return [row for row in point["rows"] if row["study"] == MODEL_ERROR and row["verdict"]]


def _error(quantity: str, point: dict) -> str:
    """The largest over friction, and its uncertainty."""
    errors = (row for row in _judged(point) if row["quantity"] == quantity)
    largest = max(errors, key=lambda row: abs(row["value"]), default=None)
    if largest is None:
        return ""
    unsure = largest["uncertainty"]
    return f"{error_text(largest['value'], unsure)} ± {percent(unsure)}".replace(" %", "")


def scatter(points: Iterable[dict], over_friction: bool) -> list[dict]:
    """Scatter by what names a figure, friction None where it is swept: number of values, mean,
    standard deviation of the sample, smallest and largest."""
    order = {name: number for number, name in enumerate(QUANTITIES)}
    swept = {"friction": None} if over_friction else {}
    known = [row | swept for point in points for row in point["rows"] if _is_scattered(row)]
    groups = grouped(known, itemgetter(*NAMED))
    groups.sort(key=lambda g: (order.get(g[0]["quantity"], len(order)), g[0]["friction"] or 0.0))
    spreads = []
    for group in groups:
        values = [row["value"] for row in group]
        deviation = float(np.std(values, ddof=1)) if len(values) > 1 else None
        spreads.append(
            {
                **{name: group[0][name] for name in NAMED},
                "count": len(values),
                "mean": float(np.mean(values)),
                "standard_deviation": deviation,
                "smallest": min(values),
                "largest": max(values),
            }
        )
    return spreads


def _is_scattered(row: Row) -> bool:
    """True where a row is a figure by a model or a model error, of what models are compared by."""
    study, model = row["study"], row["source"] in MODELS
    if study in (PARTIAL_SLIP.name, HEAT.name):
        return model and row["against"] is None
    compared = (study, row["against"]) in ((contact.NAME, None), (MODEL_ERROR, WHOLE))
    return model and compared and row["quantity"] in QUANTITIES


def scatter_table(content: dict) -> "Table":
    """Smallest and largest of every figure; over placements and traces mean and standard deviation,
    too, which mean nothing of values that are chosen. All of an error are in its per cent, of a
    figure the deviation in per cent of the mean."""
    is_sample = all(axis["field"] in SAMPLES for axis in content["over"])
    spread = ("mean", "std") if is_sample else ()
    rows = []
    for row in content["scatter"]:
        quantity, relative = quantity_of(row["study"], row["quantity"]), row["study"] == MODEL_ERROR
        mean, *ends = (
            percent(row[name], signed=True) if relative else with_unit(row[name], quantity.unit)
            for name in ("mean", "smallest", "largest")
        )
        whole = 1.0 if relative or row["mean"] == 0.0 else abs(row["mean"])
        deviation = row["standard_deviation"]
        sample = (mean, "" if deviation is None else percent(deviation / whole))
        source = row["study" if relative else "source"].replace("_", " ")
        friction = "" if row["friction"] is None else f"{row['friction']:g}"
        names = quantity.short or quantity.label, source, friction
        rows.append((*names, *(sample if is_sample else ()), *ends))
    return plain_table("quantity", "", numbers=("mu", *spread, "smallest", "largest"), rows=rows)
