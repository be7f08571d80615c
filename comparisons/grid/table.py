"""What a sweep prints: a table by point, the scatter of every figure, and warnings.

In: the content of sweep.json. Out: tables for the terminal, and lines."""

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.common.errors import ExitStatus
from comparisons.common.numbers import percent, percent_as_written, rounded_up, with_unit
from comparisons.drawing.style import NamedPictures
from comparisons.figures.quantity import QUANTITIES, error_text
from comparisons.grid.points import FAILED, exit_status, failures
from comparisons.grid.sweep import SWEEP, TABLE, rows_of_points, write_sweep
from comparisons.grid.sweep_picture import (
    DRAWN,
    PICTURE,
    SAMPLES,
    ZONES,
    Axis,
    has_zones,
    sweep_figure,
    zone_map_figure,
)
from comparisons.judging import contact
from comparisons.judging.study import MODEL_ERROR
from comparisons.output.records import Records, Row
from comparisons.output.terminal import PLAIN, Printed, plain_table, plain_text
from comparisons.studies import quantity_of

if TYPE_CHECKING:
    from rich.console import Group
    from rich.table import Table

MOST_SHOWN = 100  # points of the table; all are in the files
NOT_COMPARED = "not compared"  # verdict of a run of one model

Cell = Callable[[dict], str]  # of a column, by point


@dataclass(frozen=True, repr=False)
class Sweep(Printed):
    """Scenes at many values of their fields; `content` is that of sweep.json, in `folder`."""

    content: dict
    folder: Path | None

    @property
    def figures(self) -> Records:
        """Those of every point, each with the values of the swept fields, as records."""
        return Records(rows_of_points(self.content))

    @property
    def exit_status(self) -> ExitStatus:
        return exit_status(self.content["points"])

    @property
    def plot(self) -> NamedPictures:
        """`plot.sweep()`, each figure over the first swept field; `plot.zones()`, quiescent zones,
        where there are any."""
        zones = {"zones": zone_map_figure} if has_zones(self.content) else {}
        draws = {"sweep": sweep_figure, **zones}
        return NamedPictures(**{name: partial(draw, self.content) for name, draw in draws.items()})

    def write(self, folder: str | os.PathLike) -> None:
        """Write sweep.json, the table and the pictures into a folder."""
        write_sweep(self.content, Path(folder))

    def tables(self) -> "Group":
        return sweep_table(self.content, self.folder)


def sweep_table(content: dict, out: Path | None) -> "Group":
    """The points, the scatter over all of them, and how many failed, by why."""
    from rich.console import Group

    points, whys = content["points"], failures(content["points"])
    over = " x ".join(f"{len(axis['values'])} of {axis['field']}" for axis in content["over"])
    files = TABLE, PICTURE, *([ZONES] if has_zones(content) else []), SWEEP
    written = [] if out is None else [f"sweep: {', '.join(str(out / name) for name in files)}"]
    left = len(points) - MOST_SHOWN
    return Group(
        _points(content),
        *([f"{left} points more are in the files"] if left > 0 else []),
        "",
        _scatter(content),
        plain_text(f"{len(points)} scenes ({over}), {whys.total()} failed"),
        *(plain_text(f"failed, {count}: {why}") for why, count in whys.items()),
        *map(plain_text, written),
    )


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


def _points(content: dict) -> "Table":
    """A row a point: its values, and every column that has something to say of any point."""
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
    return plain_table(numbers=heads, rows=zip(*at, *cells.values(), strict=True))


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


def _scatter(content: dict) -> "Table":
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
