"""Blocks that a page is made of, as data: tables, pictures and notes, in order.

In: texts, names of pictures. Out: dataclasses, which a template shows by their classes' names."""

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from comparisons.common.errors import TRACEBACK, defect, tell


@dataclass(frozen=True)
class TextTable:
    """Text cells by row; the first column names the row. Lines after a cell's first are grey."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    # "comparison": on narrow screens a row becomes a list, and verdicts have colours; with
    # "prose": its cells are words
    style: str = ""
    words: bool = False  # the last column of a comparison holds words


@dataclass(frozen=True)
class Names:
    """Rows of a name and what it stands for; before them such of a name and a command."""

    rows: Sequence[tuple[str, str]]
    commands: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class Note:
    """Note on how to read what stands above; *words* between asterisks are set off."""

    text: str


@dataclass(frozen=True)
class Heading:
    text: str


@dataclass(frozen=True)
class Bullets:
    texts: tuple[str, ...]


@dataclass(frozen=True)
class Pictures:
    """Pictures by these functions, one below the other or, if narrow, `abreast`; where one gives
    several, those of `part`. The heading is left out where there is nothing."""

    names: tuple[str, ...]
    heading: str = ""
    abreast: bool = False
    part: slice | None = None  # all


@dataclass(frozen=True)
class Box:
    """Items together, of a class of the page's style: columns | thirds | sheet | half | signed."""

    style: str
    items: tuple


@dataclass(frozen=True)
class Block:
    """Items of a section of the page, which the first block of a section gives its title."""

    section: str  # id
    # what a function among them gives for the run stands instead: an item, several, or None
    items: tuple
    title: str = ""


def attempted(what: str, make: Callable[[], object]) -> object:
    """Result of `make`. If it fails, one line in its stead, which standard error gets, too: what
    is shown of a result is never worth the result. CROSSCHECK_TRACEBACK lets the error through."""
    try:
        return make()
    except Exception as error:
        if os.environ.get(TRACEBACK):
            raise
        said = f"{what.replace('_', ' ')} is not shown: {defect(error)}"
        tell(said)
        return Note(f"{said[0].upper()}{said[1:]}")
