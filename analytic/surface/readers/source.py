"""Bytes or lines in the file of a profile, bounded, and why it cannot be used."""

import gzip
import re
import zlib
from pathlib import Path
from zipfile import BadZipFile, ZipFile

import numpy as np

QUOTED = re.compile(r'"([^"\n]*)"')
GROUPED = re.compile(r"[+-]?\d{1,3}(,\d{3}){2,}(\.\d*)?")  # digits; shown as they are, not read
OTHER_BLANKS = re.compile(r"[^\S\n\t ]")  # form feed, no-break blank and the like
NOT_TEXT = re.compile("[\x00-\x08\x0e-\x1f\x7f]")
# Limits of what is in any file, held before it is converted to anything larger.
MAX_BYTES = 2**31
MAX_NUMBERS = 2**26  # 0.5 GB as doubles
MAX_UNPACKED = 8 * MAX_NUMBERS  # bytes of a packed file: of zeros, 2 MB hold 2 GB
MAX_LINES, MAX_CELLS = 2**22, 20_000_000  # of text: each is an object of sixty bytes
LONGEST_LINE = 2**20  # bytes of text
BEGINNING = 256  # bytes that tell how text is encoded
GZIP = b"\x1f\x8b"
SPLITS = (b",", b";", b"\t")  # between cells, beside blanks


class ProfileError(ValueError):
    """A profile file that cannot be used. One line: file, line, what is wrong, what is allowed."""

    def __init__(self, path: object, message: str, line: int | None = None) -> None:
        self.message, self.line = message, line
        place = str(path) if str(path).isprintable() else repr(str(path))
        super().__init__(f"{place}{f', line {line}' if line else ''}: {message}")


class NotTextError(ProfileError):
    """The file is not text; another reader may know it."""


class NotRowsError(ProfileError):
    """The file is text and no table of numbers; another reader may know it."""


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


def beginning(path: Path, count: int) -> bytes:
    """The first `count` bytes of the file, unpacked where it is gz."""
    try:
        with path.open("rb") as file:
            if file.read(len(GZIP)) != GZIP:
                file.seek(0)
                return file.read(min(count, path.stat().st_size + 1))  # room is made for so many
        with gzip.open(path) as file:
            return file.read(count)
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        raise ProfileError(path, f"is a damaged gz file ({error})") from error
    except OSError as error:
        raise unreadable(path, error) from error


def contents(path: Path, max_bytes: int) -> bytes:
    """Bytes in the file, unpacked where it is gz, `max_bytes` at most either way."""

    def too_large(most: int) -> ProfileError:
        return ProfileError(path, f"is too large; a profile may have {most / 1e6:.3g} MB")

    if (packed := regular_file(path)) > max_bytes:
        raise too_large(max_bytes)
    most = min(max_bytes, max(packed, MAX_UNPACKED))
    if len(raw := beginning(path, most + 1)) > most:
        raise too_large(most)
    return raw


def check_numbers(path: Path, count: float) -> None:
    """Raise ProfileError for more numbers than may be converted to doubles."""
    if count > MAX_NUMBERS:
        message = f"is too large: it holds {count:.3g} numbers; allowed are {MAX_NUMBERS:.3g}"
        raise ProfileError(path, message)


def check_unpacked(path: Path) -> None:
    """Raise ProfileError for an archive, as npz, X3P and xlsx are, that unpacks to too much."""
    try:
        with ZipFile(path) as archive:
            size = sum(member.file_size for member in archive.infolist())
    except (BadZipFile, OSError, ValueError, NotImplementedError):
        return  # none, or one that is damaged or of another kind of ZIP, which its reader tells
    if size > MAX_UNPACKED:
        message = f"unpacks to {size / 1e9:.3g} GB; allowed are {MAX_UNPACKED / 1e9:.3g} GB"
        raise ProfileError(path, message)


def check_text(path: Path, raw: bytes) -> None:
    """Raise ProfileError for text of so many lines or cells, or so long a line, that taking it
    apart needs gigabytes."""

    def check(size: int, most: int, what: str) -> None:
        if size > most:
            raise ProfileError(path, f"is too large: it has {size} {what}; allowed are {most}")

    lines = max(raw.count(b"\n"), raw.count(b"\r"))
    check(lines, MAX_LINES, "lines")
    codes = np.frombuffer(raw, np.uint8)
    is_blank = codes == ord(" ")
    blanks = int(np.count_nonzero(is_blank[:-1] & ~is_blank[1:]))
    check(lines + blanks + sum(map(raw.count, SPLITS)), MAX_CELLS, "cells")
    ends = np.flatnonzero((codes == ord("\n")) | (codes == ord("\r")))
    check(int(np.diff(ends, prepend=-1, append=len(raw)).max()), LONGEST_LINE, "bytes in a line")


def read_lines(path: Path, max_bytes: int) -> list[str]:
    """The file's lines without their ends; it may have `max_bytes` at most."""
    raw = contents(path, max_bytes)
    check_text(path, raw)
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
        text = QUOTED.sub(
            lambda cell: cell[0] if GROUPED.fullmatch(cell[1]) else cell[1].replace(",", "."), text
        )
    return text.split("\n")


def wide_encoding(content: bytes) -> str | None:
    """The name of UTF-16, where the content is text in it; without a byte-order mark it is known
    by its beginning: of letters and digits, one of two bytes is 0."""
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "utf-16"
    halves = content[:BEGINNING:2], content[1:BEGINNING:2]
    for letters, zeros, name in ((*halves, "utf-16-le"), (*halves[::-1], "utf-16-be")):
        if letters.count(0) == 0 and 2 * zeros.count(0) > len(zeros):
            return name
    return None


def _decoded(path: Path, raw: bytes) -> str:
    if encoding := wide_encoding(raw):
        try:
            return raw.decode(encoding)
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
