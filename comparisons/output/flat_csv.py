"""The figures of many runs as one table, a row each.

In: the result.json of runs. Out: records, CSV, or a table for people. Columns:
  run, scene, title      folder, name, title
  study, quantity, source, against, friction   name the figure within its run
  value                  in `unit`, SI; relative where it is `against` a reference
  uncertainty, not_modelled   relative
  low, high              the bounds of what is judged, and its verdict
  within                 of the run: the least tolerance at which every judged figure holds

What is unknown is empty in a CSV."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.common.errors import InputError, one_line, tell
from comparisons.common.files import check_file, csv_text, write_whole
from comparisons.common.numbers import (
    finite,
    percent,
    percent_as_written,
    plain,
    rounded_up,
    with_unit,
)
from comparisons.figures.figure import grouped
from comparisons.figures.quantity import LABELS
from comparisons.judging import contact
from comparisons.judging.study import LADDER
from comparisons.output.result import FILE, Result, read_result
from comparisons.output.terminal import Printed, plain_table, plain_text
from comparisons.studies import meaning

if TYPE_CHECKING:
    from pandas import DataFrame
    from rich.console import Group, RenderableType

FORMULA = ("=", "+", "-", "@")  # a cell that begins so is computed by spreadsheets
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


@dataclass(frozen=True, repr=False)
class FigureTable(Records):
    """Figures of runs, with all COLUMNS; it prints what is judged, by run."""

    rows: Sequence[Row]
    title: str = "run"  # column that a run is called by

    def tables(self) -> "RenderableType":
        return rows_tables(judged_rows(self.rows), partial(right_within, name=self.title))

    def write(self, path: Path) -> None:
        """Write every figure to a file FILE.csv."""
        write_whole(path, as_csv(self.rows))


def tidy_rows(folders: Iterable[Path]) -> list[Row]:
    """The rows of every run in or below the folders. A result that is none is passed over, with a
    line on standard error.
    Raises InputError, one line, for a folder without runs, and where no result is one."""
    rows, wrong = [], []
    for folder in _runs(folders):
        try:
            rows += rows_of(read_result(folder), one_line(str(folder)))
        except InputError as error:
            wrong.append(error)
    if not rows:
        raise wrong[0]
    for error in wrong:
        tell(f"{error}; it is passed over")
    return rows


def as_csv(rows: Iterable[Row]) -> str:
    """The table as comma-separated values, with a header.
    Neither a terminal nor a spreadsheet obeys a text of it: control characters are written as
    escapes, and an apostrophe stands before what would be a formula."""
    return csv_text([COLUMNS, *([harmless(row[name]) for name in COLUMNS] for row in rows)])


def harmless(value: object) -> object:
    """A cell that neither a terminal nor a spreadsheet obeys."""
    if not isinstance(value, str):
        return value
    text = one_line(value)
    return f"'{text}" if text.startswith(FORMULA) else text


def check_place(path: Path) -> None:
    """Raise InputError, one line, unless a table can be written to a file of this name."""
    if path.suffix != ".csv":
        raise InputError(f"{path}: ends with {path.suffix or 'nothing'}; allowed is .csv")
    check_file(path)


def _runs(folders: Iterable[Path]) -> list[Path]:
    """The folder of every run in or below the folders, once, in the order of their paths."""
    runs: dict[Path, Path] = {}
    for folder in folders:
        every = sorted(folder.rglob(FILE))
        # what is hidden is being written
        below = [p for p in every if "/." not in f"/{p.relative_to(folder).as_posix()}"]
        if not below:
            raise InputError(f"{folder}: holds no run; allowed is a folder with {FILE} below it")
        for path in below:
            runs.setdefault(path.resolve(), path.parent)
    return list(runs.values())


def rows_of(result: Result, run: str) -> list[Row]:
    """A row a figure, of every study of one run, each with all COLUMNS."""
    common = {"run": run, "scene": result.scene["name"], "title": result.scene["title"]}
    common["within"] = result.within
    names = ("study", "quantity", "source", "against", "friction", "value", "not_modelled")
    rows = []
    for figure in result.figures:
        row = common | {name: getattr(figure, name) for name in (*names, "verdict")}
        row["unit"] = "" if figure.against else meaning(figure).unit
        row["uncertainty"] = figure.numerical
        row["low"], row["high"] = figure.bounds or (None, None)
        rows.append(finite({name: row[name] for name in COLUMNS}))
    return rows


def judged_rows(rows: Iterable[Row]) -> list[Row]:
    """What each run answers for; of a run that judges nothing its contact."""
    shown = []
    for same in grouped(rows, lambda row: (row["run"], row["title"])):
        judged = [row for row in same if row["verdict"] and row["study"] != LADDER]
        shown += judged or [row for row in same if row["study"] == contact.NAME]
    return shown


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


def right_within(row: Row, name: str = "run") -> str:
    """A title: the run, by its folder or another column, and what the half-plane is right
    within."""
    size = "unknown" if row["within"] is None else percent_as_written(rounded_up(row["within"]))
    return f"{row[name]}, right within {size}"


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
