"""The figures of many runs as one table, a row each.

In: the folders of runs. Out: records, CSV, or a table for people. What is unknown is empty in a
CSV."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.common.errors import InputError, one_line, tell
from comparisons.common.files import check_file, csv_text, write_whole
from comparisons.common.numbers import percent_as_written, rounded_up
from comparisons.figures.figure import grouped
from comparisons.judging import contact
from comparisons.judging.study import LADDER
from comparisons.output.records import COLUMNS, Records, Row, rows_tables
from comparisons.output.result import FILE, read_result

if TYPE_CHECKING:
    from rich.console import RenderableType

FORMULA = ("=", "+", "-", "@")  # a cell that begins so is computed by spreadsheets


@dataclass(frozen=True, repr=False)
class FigureTable(Records):
    """Figures of runs, with all COLUMNS; it prints what is judged, by run."""

    title: str = "run"  # column that a run is called by

    def tables(self) -> "RenderableType":
        return rows_tables(judged_rows(self.rows), self._right_within)

    def _right_within(self, row: Row) -> str:
        """A title: the run, and what the half-plane is right within."""
        size = "unknown" if row["within"] is None else percent_as_written(rounded_up(row["within"]))
        return f"{row[self.title]}, right within {size}"

    @property
    def csv(self) -> str:
        """Comma-separated values, with a header. Neither a terminal nor a spreadsheet obeys a text
        of it: control characters are escapes, an apostrophe stands before what would be a
        formula."""
        rows = ([harmless(row[name]) for name in COLUMNS] for row in self.rows)
        return csv_text([COLUMNS, *rows])

    def write(self, path: Path) -> None:
        """Write every figure to a file FILE.csv. Raises InputError where that cannot be."""
        if path.suffix != ".csv":
            raise InputError(f"{path}: ends with {path.suffix or 'nothing'}; allowed is .csv")
        check_file(path)
        write_whole(path, self.csv)


def tidy_rows(folders: Iterable[Path]) -> list[Row]:
    """The rows of every run in or below the folders. A result that is none is passed over, with a
    line on standard error.
    Raises InputError, one line, for a folder without runs, and where no result is one."""
    rows, wrong = [], []
    for folder in _runs(folders):
        try:
            rows += read_result(folder).figures.rows
        except InputError as error:
            wrong.append(error)
    if not rows:
        raise wrong[0]
    for error in wrong:
        tell(f"{error}; it is passed over")
    return rows


def harmless(value: object) -> object:
    """A cell that neither a terminal nor a spreadsheet obeys."""
    if not isinstance(value, str):
        return value
    text = one_line(value)
    return f"'{text}" if text.startswith(FORMULA) else text


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


def judged_rows(rows: Iterable[Row]) -> list[Row]:
    """Rows that each run answers for; of a run that judges nothing those of its contact."""
    shown = []
    for same in grouped(rows, lambda row: (row["run"], row["title"])):
        judged = [row for row in same if row["verdict"] and row["study"] != LADDER]
        shown += judged or [row for row in same if row["study"] == contact.NAME]
    return shown
