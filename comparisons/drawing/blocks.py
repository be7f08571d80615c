"""What a page is made of, as data: blocks of tables, pictures and notes, in order.

In: texts, names of pictures. Out: dataclasses, which a template shows by their classes' names; and
figures as cells of tables, alike wherever they are shown, in the digits that are certain."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from comparisons.common.errors import TRACEBACK, defect, tell
from comparisons.common.numbers import (
    listed,
    percent,
    percent_as_written,
    scale_of,
    with_unit,
)
from comparisons.figures.figure import Figure, Figures, grouped
from comparisons.figures.quantity import LABELS, MODELS, Quantity


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
    """How to read what stands above; *words* between asterisks are set off."""

    text: str


@dataclass(frozen=True)
class Heading:
    text: str


@dataclass(frozen=True)
class Bullets:
    texts: tuple[str, ...]


@dataclass(frozen=True)
class Pictures:
    """What the drawing functions of these names give, one below the other or, if narrow, `abreast`;
    of several those of `part`. The heading is left out where there is nothing."""

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
    # what a function among them gives for the run stands in its place: an item, several, or None
    items: tuple
    title: str = ""


def attempted(what: str, make: Callable[[], object]) -> object:
    """What `make` gives. If it fails, one line in its place, which standard error gets, too: what
    is shown of a result is never worth the result. CROSSCHECK_TRACEBACK lets the error through."""
    try:
        return make()
    except Exception as error:
        if os.environ.get(TRACEBACK):
            raise
        said = f"{what.replace('_', ' ')} is not shown: {defect(error)}"
        tell(said)
        return Note(f"{said[0].upper()}{said[1:]}")


class TableRow(NamedTuple):
    """A figure at one friction coefficient, or the first of several that look the same."""

    figure: Figure
    friction: str
    cells: tuple[str, ...]

    @property
    def quantity(self) -> str:
        return self.figure.quantity


def table_rows(
    figures: Sequence[Figure], order: Iterable[str], cells: Callable[[Figure], tuple[str, ...]]
) -> list[TableRow]:
    """Rows in the order of quantities, then of friction coefficients; equal ones are joined."""
    known = [(cells(f), f) for name in order for f in figures if f.quantity == name]
    return [
        TableRow(same[0][1], listed(figure.friction for _, figure in same), same[0][0])
        for same in grouped(known, lambda one: (one[1].quantity, one[0]))
    ]


def compared_cells(
    difference: Figure, values: tuple[Figure | None, Figure | None], unit: str
) -> tuple[str, ...]:
    """Two sources' values in one unit, empty where a norm has none, and `judged_cells`."""
    sizes = [figure and figure.value for figure in values]
    scale = scale_of(sizes, unit)
    texts = ("" if size is None else scale.text(size) for size in sizes)
    return *texts, *judged_cells(difference, is_norm=None in sizes)


def judged_cells(difference: Figure, is_norm: bool = False) -> tuple[str, str, str, str]:
    """A difference, signed but for norms, its uncertainty, tolerance and verdict, empty where it is
    not judged."""
    size = difference.numerical
    return (
        percent(difference.value, signed=not is_norm, uncertainty=size),
        percent(size),
        "" if difference.bounds is None else percent_as_written(difference.tolerance),
        difference.verdict or "",
    )


def model_cells(known: Figures, quantity: str, unit: str) -> tuple[str, ...]:
    """Both models' values of a study's figure, each in the unit that suits it, and `judged_cells`;
    of one model alone its uncertainty."""
    values = [known.one(quantity=quantity, source=name, against=None) for name in MODELS]
    texts = (with_unit(figure and figure.value, unit) for figure in values)
    difference = known.one(quantity=quantity, source=MODELS[0], against=MODELS[1])
    if difference is None:
        [only] = filter(None, values)
        return *texts, "", percent(only.numerical), "", "not compared"
    return *texts, *judged_cells(difference)


def model_table(
    known: Figures,
    quantities: Mapping[str, Quantity],
    cells: Callable[[Figures, str, str], tuple[str, ...]] = model_cells,
    others: Sequence[tuple[str, ...]] = (),
) -> TextTable:
    """A row for each of a study's quantities that a model has, and `others`."""
    plain = (figure for figure in known.of(against=None) if figure.source in MODELS)
    there = {figure.quantity for figure in plain} & set(quantities)
    rows = [(q.label, *cells(known, n, q.unit)) for n, q in quantities.items() if n in there]
    head = ("", *map(LABELS.get, MODELS), "difference", "uncertainty", "tolerance", "verdict")
    return TextTable("", head, (*rows, *others), "comparison")
