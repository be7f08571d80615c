"""Rows of numbers in the text file of a profile, whatever program wrote it.

How a file is understood, always by looking at all of it:

text       UTF-8, UTF-16 with its byte-order mark, or else Latin-1; lines end in LF, CRLF or CR
quotes     "1,5" in quotes is a number with a decimal comma, and comes out as 1.5
comments   a line that starts with # % ; or //, and what follows a blank and # % or //. Not a
           comment: `#N/A` and its like, which are dropouts, and `;` with only a number behind
           it, which is a row that lost its x
header     text lines before the first row; they do not start with a number. After them may stand,
           alone on its line, how many rows of two columns or more follow
rows       all other lines. Beside two columns a blank line means nothing; in the middle of a
           single column it is a lost height
separator  semicolon if at least half of the rows hold one; else tab likewise; else blanks if at
           least half of the rows have some between two cells (beside a comma they do not
           count); else comma if at least half of the rows hold one; else there is one column
decimal    with the comma as separator the point; otherwise comma or point, whichever more rows
           hold. Digits are not grouped
1,5        rows of this form only can be read in two ways. They are two whole numbers, unless
           the caller announces one column: then the comma is decimal, and if the numbers before
           the commas all differ, so that they may be an x after all, the file is refused
dropouts   an empty cell, a number that is not finite, only asterisks, hyphens or question
           marks, a spreadsheet's error value, or a word of `DROPOUT`"""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from analytic.surface.readers.source import NotRowsError, ProfileError, read_lines, shown

NUMBER = re.compile(r"[+-]?(\d+[.,]?\d*|[.,]\d+)([eEdD][+-]?\d+)?", re.ASCII)
ONE_COMMA = re.compile(r"[+-]?\d*,?\d*([eEdD][+-]?\d+)?", re.ASCII)
DROPOUT = re.compile(
    r"nan|inf(inity)?|bad|n/?a|null|none|missing|invalid|void|lost|dropout|overflow", re.IGNORECASE
)
# What spreadsheets write for a failed formula, and Microsoft's C library for NaN (`1.#QNAN`).
ERROR_VALUE = (
    r"#(?:(?:N/A|NA|NV|NUM!|VALUE!|WERT!|DIV/0!|REF!|NULL!|NAME\?)|(?:INF|IND|QNAN|SNAN)0*)"
    r"(?![A-Za-z0-9])"
)
ERROR_CELL = re.compile(rf"(?:[+-]?1[.,])?{ERROR_VALUE}", re.IGNORECASE)
COMMENT = re.compile(rf"(?<!\S)(?!{ERROR_VALUE})(?:#|%|//).*", re.IGNORECASE)
LEADING_SEMICOLON = re.compile(r"^[ \t]*;", re.MULTILINE)
BETWEEN_CELLS = re.compile(r"[^\s,]\s+[^\s,]")
NOTHING = " \t,;"  # a line of these alone is blank
NAMES = {";": "semicolon", "\t": "tab", " ": "blank", ",": "comma", "": "none", ".": "point"}
DECIMAL_COMMAS = (
    "where commas are decimal, separate by semicolon, tab or blank, "
    "and give heights alone their spacing"
)


@dataclass(frozen=True)
class ProfileTable:
    """The rows of a file."""

    path: Path
    numbers: np.ndarray  # (rows, columns), NaN for a dropout
    text: Sequence[str]  # each row as it stands in the file, without comments
    lines: np.ndarray  # each row's line number in the file, from 1
    separator: str = ""  # ";", tab, " " (any run of blanks), "," or "" for a single column
    decimal: str = "."  # "." or ","
    names: tuple[str, ...] = ()  # of the columns, as the file has them, or () where it has none
    head: tuple[str, ...] = ()  # the lines above the rows
    format: str = "text"  # of the file, in words

    def error(self, row: int, message: str) -> ProfileError:
        """The error to raise about one row."""
        return ProfileError(self.path, message, int(self.lines[row]))

    def commas_may_be_decimal(self) -> bool:
        """Whether the commas were taken as separators without a decimal point to prove it."""
        return self.separator == "," and not any("." in row for row in self.text)


MOST_ROWS = 0.9  # have one width in a table; a text with fewer is something else


class ColumnsError(NotRowsError):
    """There are more than two columns in `table`, and none of them were chosen."""

    def __init__(self, table: ProfileTable) -> None:
        self.table = table
        width = table.numbers.shape[1]
        message = f"{width} columns; a profile has two (x, height) or one (height), and columns "
        message += f"chooses them: by numbers from 0 to {width - 1}"
        if table.names:
            message += f", or by names, of {', '.join(map(shown, table.names))}"
        message += "; of a map row, column or line chooses one line"
        if table.commas_may_be_decimal():
            message += f"; {DECIMAL_COMMAS}"
        super().__init__(table.path, message, int(table.lines[0]))


def chosen_columns(table: ProfileTable, columns: Sequence[str | int] | None) -> ProfileTable:
    """The table with the chosen columns alone; ProfileError where there is none such.

    columns   one or two numbers, counted from 0, or names; None where there are no others"""
    width = table.numbers.shape[1]
    if columns is None:
        if width > 2:
            raise ColumnsError(table)
        return table
    picks = [_pick(table, wanted, width) for wanted in columns]
    names = tuple(table.names[pick] for pick in picks) if table.names else ()
    return replace(table, numbers=table.numbers[:, picks], names=names)


def _pick(table: ProfileTable, wanted: str | int, width: int) -> int:
    if isinstance(wanted, int):
        if wanted < width:
            return wanted
        allowed = f"numbers from 0 to {width - 1}"
    else:
        if table.names.count(wanted) == 1:
            return table.names.index(wanted)
        allowed = ", ".join(map(shown, table.names)) or f"numbers from 0 to {width - 1}, no names"
    what = shown(wanted) if isinstance(wanted, str) else wanted
    raise ProfileError(table.path, f"has no column {what}; allowed is {allowed}")


def read_table(
    path: Path, max_bytes: int, one_column: bool, columns: Sequence[str | int] | None = None
) -> ProfileTable:
    """The rows of the file at `path`, which may have `max_bytes` at most.

    one_column   what the caller announces; it decides only how rows like `1,5` are read
    columns      as `chosen_columns` has them; others may hold anything
    Raises ProfileError at the first row that is not a row of numbers and dropouts."""
    file_lines = read_lines(path, max_bytes)
    first = _first_row(path, file_lines)
    rows, lines = _rows(file_lines, first)
    if _is_count(rows):
        rows, lines, first = rows[1:], lines[1:], first + 1
    filled = [i for i, row in enumerate(rows) if row.strip(NOTHING)]
    some_blank = len(filled) < len(rows)
    text = [rows[i] for i in filled] if some_blank else rows
    separator, decimal = _dialect(path, int(lines[0]), text, one_column)
    head = tuple(file_lines[:first])
    table = ProfileTable(path, np.empty((0, 0)), text, lines[filled], separator, decimal, (), head)
    numbers = _fast_numbers(text, separator, decimal)
    if numbers is None:
        numbers = _careful_numbers(table, columns)
    numbers = np.where(np.isfinite(numbers), numbers, np.nan)
    if some_blank and numbers.shape[1] == 1:
        every = np.full((len(rows), 1), np.nan)
        every[filled] = numbers
        return replace(table, numbers=every, text=rows, lines=lines)
    table = replace(table, numbers=numbers, names=_names(table, numbers.shape[1]))
    return chosen_columns(table, columns)


def _names(table: ProfileTable, width: int) -> tuple[str, ...]:
    """Names of columns by the last line above the rows, () where these are not as many."""
    for line in reversed(table.head):
        if bare := line.strip(" \t#%/"):
            (cells,) = _split([bare], table.separator)
            names = tuple(cell.strip() for cell in cells)
            return names if len(names) == width and all(names) else ()
    return ()


def _first_row(path: Path, lines: list[str]) -> int:
    """Index of the first row, behind the header."""
    header: list[str] = []
    for index, line in enumerate(lines):
        bare = _without_comment(line)
        if not bare.strip(NOTHING):
            continue
        pieces = [piece for piece in re.split(r"[;,\s]+", bare) if piece]
        if NUMBER.fullmatch(pieces[0]) or all(
            NUMBER.fullmatch(p) or _is_dropout(p) for p in pieces
        ):
            return index
        header.append(bare.strip())
    what = f"{shown(header[0])} is no row of numbers" if header else "it holds only comments"
    raise NotRowsError(path, f"has no samples: {what}; a row is x and height, or a height")


def _rows(lines: list[str], first: int) -> tuple[list[str], np.ndarray]:
    """The rows from the first to the last, blank lines between them included, and their numbers."""
    last = len(lines)
    while not _without_comment(lines[last - 1]).strip(NOTHING):
        last -= 1
    rows, numbers = lines[first:last], np.arange(first + 1, last + 1)
    whole = "\n".join(rows)
    if not any(sign in whole for sign in ("#", "%", "//")) and not LEADING_SEMICOLON.search(whole):
        return rows, numbers
    bare = [_without_comment(row) for row in rows]
    kept = [i for i, row in enumerate(rows) if bare[i].strip() or not row.strip()]
    return [bare[i] for i in kept], numbers[kept]


def _is_count(rows: list[str]) -> bool:
    """Whether the first row is no sample but says how many of two columns or more follow."""
    count = rows[0].strip()
    if not count.isdecimal() or len(rows) < 2 or len(re.split(r"[;,\s]+", rows[1].strip())) < 2:
        return False
    return int(count[:9]) == sum(bool(row.strip(NOTHING)) for row in rows) - 1


def _without_comment(line: str) -> str:
    line = COMMENT.sub("", line)
    start = line.strip()
    if start.startswith(";") and not NUMBER.fullmatch(start[1:].strip()):
        return ""
    return line


def _is_dropout(cell: str) -> bool:
    word = cell.strip("*?+-")
    return not word or bool(DROPOUT.fullmatch(word) or ERROR_CELL.fullmatch(cell))


def _dialect(path: Path, line: int, rows: list[str], one_column: bool) -> tuple[str, str]:
    """Separator and decimal sign of the whole file, by the rules at the head of this module."""
    half = 0.5 * len(rows)
    commas = sum("," in row for row in rows)
    decimal = "," if commas > sum("." in row for row in rows) else "."
    for separator in (";", "\t"):
        if sum(separator in row for row in rows) >= half:
            return separator, decimal
    blanks = (row for row in rows if " " in row or "\t" in row)
    if sum(BETWEEN_CELLS.search(row) is not None for row in blanks) >= half:
        return " ", decimal
    bare = [row.strip() for row in rows] if one_column and commas else []
    if bare and all(ONE_COMMA.fullmatch(row) or _is_dropout(row) for row in bare):
        if commas == len(rows) == len({row.partition(",")[0] for row in bare}):
            raise ProfileError(
                path,
                "the comma may stand between x and height or be decimal; write a decimal point, "
                "or separate by semicolon, tab or blank",
                line,
            )
        return "", ","
    return (",", ".") if commas >= half else ("", decimal)


def _fast_numbers(rows: list[str], separator: str, decimal: str) -> np.ndarray | None:
    """The numbers of an orderly file, or None if any row needs a closer look."""
    if decimal == ",":
        if any("." in row for row in rows):
            return None
        rows = [row.replace(",", ".") for row in rows]
    try:
        numbers = np.loadtxt(rows, delimiter=separator.strip(" ") or None, comments=None, ndmin=2)
    except ValueError:
        return None
    return numbers if len(numbers) == len(rows) else None


def _careful_numbers(table: ProfileTable, columns: Sequence[str | int] | None) -> np.ndarray:
    """The numbers row by row, dropouts as NaN; `table` has everything but its numbers. What columns
    hold that are not chosen, or are yet to be, is NaN where it is no number."""
    cells = _split(table.text, table.separator)
    width = Counter(map(len, cells)).most_common(1)[0][0]
    numbers = np.empty((len(cells), width))
    picks = range(width)
    if columns is not None:
        bare = replace(table, numbers=numbers, names=_names(table, width))
        picks = [_pick(bare, wanted, width) for wanted in columns]
    elif width > 2:
        picks = ()
    fit = sum(len(line) == width for line in cells)
    kind = ProfileError if fit >= MOST_ROWS * len(cells) else NotRowsError
    for row, line in enumerate(cells):
        values = [_number(cell.strip(), table.decimal) for cell in line]
        if any(i in picks and value is None for i, value in enumerate(values)):
            value = next(cell for i, cell in enumerate(line) if i in picks and values[i] is None)
            message = f"{shown(value)} is not a number (decimal {NAMES[table.decimal]}, separator "
            message += f"{NAMES[table.separator]}); comments start with # % ; or //"
            raise kind(table.path, message, int(table.lines[row]))
        if len(line) != width:
            message = _wrong_columns(table, len(line), width)
            if row == 0 and line[0].strip().isdecimal() and len(line) == 1:
                says = f"says that {line[0].strip()} rows follow, and {len(cells) - 1} are there"
                message = f"{says}; if it is no count, it has {message}"
            raise kind(table.path, message, int(table.lines[row]))
        numbers[row] = [np.nan if value is None else value for value in values]
    return numbers


def _split(rows: list[str], separator: str) -> list[list[str]]:
    """The cells of every row, without columns that are empty in all of them at either end."""
    if not separator:
        return [[row] for row in rows]
    if separator == " ":
        return [row.split() for row in rows]
    cells = [row.split(separator) for row in rows]
    if all(len(row) > 1 and not row[0].strip() for row in cells):
        cells = [row[1:] for row in cells]
    while all(len(row) > 1 and not row[-1].strip() for row in cells):
        cells = [row[:-1] for row in cells]
    return cells


def _number(cell: str, decimal: str) -> float | None:
    """The cell's number, NaN for a dropout, None for anything else."""
    foreign = "." if decimal == "," else ","
    if NUMBER.fullmatch(cell) and foreign not in cell:
        return float(re.sub("[dD]", "e", cell.replace(",", ".")))
    return float("nan") if _is_dropout(cell) else None


def _wrong_columns(table: ProfileTable, columns: int, width: int) -> str:
    message = f"{columns} column{'s' * (columns > 1)} where most lines have {width}"
    message += "; a profile has two (x, height) or one (height) in every line"
    return f"{message}; {DECIMAL_COMMAS}" if table.commas_may_be_decimal() else message
