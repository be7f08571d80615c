"""Rows of numbers in the text file of a profile, whatever program wrote it.

How a file is understood, always by looking at all of it:

text       UTF-8, UTF-16 with its byte-order mark, or else Latin-1; lines end in LF, CRLF or CR
quotes     "1,5" in quotes is a number with a decimal comma, and comes out as 1.5
comments   a line that starts with # % ; or //, and what follows a blank and # % or //. Not a
           comment: `#N/A` and its like, which are dropouts, and `;` with only a number behind
           it, which is a row that lost its x
header     text lines before the first row; they do not start with a number
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
           marks, a spreadsheet's error value, or a word of `DROPOUT`
"""

import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np

QUOTED = re.compile(r'"([^"\n]*)"')
OTHER_BLANKS = re.compile(r"[^\S\n\t ]")  # form feed, no-break blank and the like
NOT_TEXT = re.compile("[\x00-\x08\x0e-\x1f\x7f]")


class ProfileError(ValueError):
    """A profile file that cannot be used. One line: file, line, what is wrong, what is allowed."""

    def __init__(self, path: object, message: str, line: int | None = None) -> None:
        self.message, self.line = message, line
        place = str(path) if str(path).isprintable() else repr(str(path))
        super().__init__(f"{place}{f', line {line}' if line else ''}: {message}")


class NotTextError(ProfileError):
    """The file is not text; another reader may know it."""


def regular_file(path: Path) -> int:
    """Size [bytes] of the file at `path`; ProfileError unless there is one that can be read."""
    try:
        if path.exists() and not path.is_file():  # a pipe would block
            kind = "a directory" if path.is_dir() else "no regular file"
            raise ProfileError(path, f"is {kind}; a profile is a text file")
        return path.stat().st_size
    except FileNotFoundError:
        raise ProfileError(path, "there is no such file") from None
    except ProfileError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a null character in the path
        raise unreadable(path, error) from error


def unreadable(path: Path, error: Exception) -> ProfileError:
    """The error to raise where the system does not let a file be read."""
    reason = getattr(error, "strerror", None) or str(error)
    return ProfileError(path, f"cannot be read ({reason})")


def read_lines(path: Path, max_bytes: int) -> list[str]:
    """The file's lines without their ends; it may have `max_bytes` at most."""
    if regular_file(path) > max_bytes:
        raise ProfileError(path, f"is too large; a profile may have {max_bytes / 1e6:.3g} MB")
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise unreadable(path, error) from error
    text = _decoded(path, raw).replace("\r\n", "\n").replace("\r", "\n").rstrip("\x1a")
    if not text.strip():
        raise ProfileError(path, "is empty; a profile has lines of numbers")
    binary = NOT_TEXT.search(text)
    if binary:
        line = text.count("\n", 0, binary.start()) + 1
        code = f"byte {ord(binary[0]):#04x}"
        raise NotTextError(path, f"is not text ({code}); export the profile as text or CSV", line)
    text = OTHER_BLANKS.sub(" ", text.replace("\u2212", "-"))  # the typographer's minus sign
    if '"' in text:
        text = QUOTED.sub(lambda cell: cell[1].replace(",", "."), text)
    return text.split("\n")


def _decoded(path: Path, raw: bytes) -> str:
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff"):
        try:
            return raw.decode("utf-16")
        except UnicodeDecodeError:
            message = "is not text (broken UTF-16); export the profile as text or CSV"
            raise NotTextError(path, message) from None
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def shown(text: str) -> str:
    """Text from a file, quoted, on one line and not too long."""
    text = text.strip()
    return repr(text if len(text) <= 40 else text[:37] + "...")


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


class ColumnsError(ProfileError):
    """Most rows have more than two columns; another reader may know the file as a map."""


@dataclass(frozen=True)
class ProfileTable:
    """The rows of a file.

    numbers    (rows, columns), 1 or 2 columns, NaN for a dropout
    text       each row as it stands in the file, without comments
    lines      each row's line number in the file, from 1
    separator  ";", tab, " " (any run of blanks), "," or "" for a single column
    decimal    "." or ","
    """

    path: Path
    numbers: np.ndarray
    text: list[str]
    lines: np.ndarray
    separator: str
    decimal: str

    def error(self, row: int, message: str) -> ProfileError:
        """The error to raise about one row."""
        return ProfileError(self.path, message, int(self.lines[row]))

    def commas_may_be_decimal(self) -> bool:
        """Whether the commas were taken as separators without a decimal point to prove it."""
        return self.separator == "," and not any("." in row for row in self.text)


def read_table(path: Path, max_bytes: int, one_column: bool) -> ProfileTable:
    """The rows of the file at `path`, which may have `max_bytes` at most.

    one_column   what the caller announces; it decides only how rows like `1,5` are read
    Raises ProfileError at the first row that is not a row of numbers and dropouts.
    """
    file_lines = read_lines(path, max_bytes)
    first = _first_row(path, file_lines)
    rows, lines = _rows(file_lines, first)
    filled = [i for i, row in enumerate(rows) if row.strip(NOTHING)]
    some_blank = len(filled) < len(rows)
    text = [rows[i] for i in filled] if some_blank else rows
    separator, decimal = _dialect(path, int(lines[0]), text, one_column)
    numbers = _fast_numbers(text, separator, decimal)
    if numbers is None:
        table = ProfileTable(path, np.empty((0, 0)), text, lines[filled], separator, decimal)
        numbers = _careful_numbers(table)
    numbers = np.where(np.isfinite(numbers), numbers, np.nan)
    if some_blank and numbers.shape[1] == 1:
        every = np.full((len(rows), 1), np.nan)
        every[filled] = numbers
        return ProfileTable(path, every, rows, lines, separator, decimal)
    return ProfileTable(path, numbers, text, lines[filled], separator, decimal)


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
    raise ProfileError(path, f"has no samples: {what}; a row is x and height, or a height")


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
    return numbers if len(numbers) == len(rows) and numbers.shape[1] <= 2 else None


def _careful_numbers(table: ProfileTable) -> np.ndarray:
    """The numbers row by row, dropouts as NaN; `table` has everything but its numbers."""
    cells = _split(table.text, table.separator)
    width = Counter(map(len, cells)).most_common(1)[0][0]
    numbers = np.empty((len(cells), width))
    for row, found in enumerate(cells):
        values = [_number(cell.strip(), table.decimal) for cell in found]
        if None in values:
            raise table.error(
                row,
                f"{shown(found[values.index(None)])} is not a number (decimal "
                f"{NAMES[table.decimal]}, separator {NAMES[table.separator]}); "
                "comments start with # % ; or //",
            )
        if len(found) != width or width > 2:
            kind = ColumnsError if width > 2 else ProfileError
            message = _wrong_columns(table, len(found), width)
            raise kind(table.path, message, int(table.lines[row]))
        numbers[row] = values
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
    if all(len(row) > 1 and not row[-1].strip() for row in cells):
        cells = [row[:-1] for row in cells]
    return cells


def _number(cell: str, decimal: str) -> float | None:
    """The cell's number, NaN for a dropout, None for anything else."""
    foreign = "." if decimal == "," else ","
    if NUMBER.fullmatch(cell) and foreign not in cell:
        return float(re.sub("[dD]", "e", cell.replace(",", ".")))
    return float("nan") if _is_dropout(cell) else None


def _wrong_columns(table: ProfileTable, found: int, width: int) -> str:
    if found == width:
        message = f"{found} columns; a profile has two (x, height) or one (height)"
    else:
        message = f"{found} column{'s' * (found > 1)} where most lines have {width}"
        message += "; a profile has two (x, height) or one (height) in every line"
    return f"{message}; {DECIMAL_COMMAS}" if table.commas_may_be_decimal() else message
