"""Figures as records, one each, with all COLUMNS; and tables of them for people.

run, scene, title      folder, or the scene's name; name and title of the scene
study, quantity, source, against, friction   name the figure within its run
value                  in `unit`, SI; relative where it is `against` a reference
uncertainty, not_modelled   relative
low, high              the bounds of what is judged, and its verdict
within                 of the run: the least tolerance at which every judged figure holds"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import itemgetter
from typing import TYPE_CHECKING

from comparisons.common.errors import InputError
from comparisons.common.numbers import finite, percent, percent_as_written, plain, with_unit
from comparisons.figures.figure import Figures, grouped
from comparisons.figures.quantity import LABELS
from comparisons.output.terminal import Printed, plain_table, plain_text
from comparisons.studies import meaning

if TYPE_CHECKING:
    from pandas import DataFrame
    from rich.console import Group, RenderableType

COLUMNS = (
    *("run", "scene", "title", "study", "quantity", "unit", "source", "against", "friction"),
    *("value", "uncertainty", "not_modelled", "low", "high", "verdict", "within"),
)
NAMES = "quantity", "source", "against"  # of a figure, as in result.json

Row = dict[str, str | float | None]


@dataclass(frozen=True, repr=False)
class Records(Printed):
    """Figures as records, one each."""

    rows: Sequence[Row]

    @property
    def figures(self) -> "Records":
        return self

    def frame(self) -> "DataFrame":
        """The records as a table of pandas. Raises InputError where pandas is not installed."""
        try:
            from pandas import DataFrame
        except ImportError:
            raise InputError("frame: pandas is not installed; `rows` are records") from None
        return DataFrame(list(self.rows))

    def tables(self) -> "RenderableType":
        """All columns."""
        cells = [
            ["" if value is None else str(value) for value in row.values()] for row in self.rows
        ]
        return plain_table(*next(iter(self.rows), ()), rows=cells)


class RunFigures(Printed, Figures):
    """Every number of a run that is a result, with its uncertainty and verdict."""

    common: Row  # what all rows of the run have alike: run, scene, title, within
    frame = Records.frame

    @cached_property
    def rows(self) -> list[Row]:
        """The figures as records."""
        names = ("study", "quantity", "source", "against", "friction", "value", "not_modelled")
        rows = []
        for figure in self:
            row = self.common | {name: getattr(figure, name) for name in (*names, "verdict")}
            row["unit"] = "" if figure.against else meaning(figure).unit
            row["uncertainty"] = figure.numerical
            row["low"], row["high"] = figure.bounds or (None, None)
            rows.append(finite({name: row[name] for name in COLUMNS}))
        return rows

    def tables(self) -> "RenderableType":
        return rows_tables(self.rows, itemgetter("study"), say=str)


def in_words(name: str) -> str:
    """A quantity's or a model's name for people."""
    return LABELS.get(name, name.replace("_", " "))


def rows_tables(
    rows: Iterable[Row], title: Callable[[Row], str], say: Callable[[str], str] = in_words
) -> "Group":
    """Tables for people, by run and title: four digits with their unit, differences in per cent;
    `say` words the names."""
    from rich.console import Group

    tables, numbers = [], ("mu", "value", "+-", "tol.")
    for same in grouped(rows, lambda row: (row["run"], row["title"], title(row))):
        table = plain_table(
            *NAMES, numbers=numbers, last="verdict", rows=(_cells(row, say) for row in same)
        )
        table.columns[-1].no_wrap = True
        table.title = plain_text(title(same[0]))
        tables += [table, ""]
    return Group(*tables[:-1])


def _cells(row: Row, say: Callable[[str], str]) -> tuple[str, ...]:
    value, unsure, friction, high = (row[n] for n in ("value", "uncertainty", "friction", "high"))
    difference = row["against"] is not None
    return (
        *(say(row[name] or "") for name in NAMES),
        "" if friction is None else plain(friction),
        percent(value, signed=True) if difference else with_unit(value, row["unit"]),
        "" if unsure is None else percent(unsure),
        "" if high is None else percent_as_written(high),
        row["verdict"] or "",
    )
