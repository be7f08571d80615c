"""Figures in words: one table, facts and a line, alike for every study, in the certain digits.

In: figures, and what they are of. Out: a table with a row a quantity and a column a source, names
and values of what no model says, and what decides in a sentence."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import chain
from math import floor, isfinite, log10
from typing import TYPE_CHECKING

from comparisons.common.numbers import (
    MINUS,
    Scale,
    listed,
    percent,
    percent_as_written,
    plain,
    scale_of,
    significant,
    with_unit,
)
from comparisons.drawing.blocks import TextTable
from comparisons.figures.figure import (
    FAILED,
    PASSED,
    Column,
    Figure,
    Series,
    Statement,
    deciding,
    grouped,
)
from comparisons.figures.quantity import LABELS, Quantity

if TYPE_CHECKING:
    from analytic.exact.hertz import HertzContact

MOST_DIGITS = 5  # of a figure beside its uncertainty
PURE = Scale(1.0, "")
TINY = 1e-4  # a number whose digits begin beyond four zeros is written with a power of ten
Below = Callable[[Figure], str]  # grey lines below a value, or below the name of a difference


def stated(figure: Figure | None, scale: Scale = PURE) -> str:
    """A figure [SI] in a unit to the first digit of its uncertainty, at most to the fifth of its
    own; without one in three, an exact one in four."""
    if figure is None:
        return ""
    value, size = figure.value / scale.factor, figure.numerical * figure.scale / scale.factor
    if not (isfinite(value) and isfinite(size)) or size == 0.0:
        return scale.named(significant(value, 3 if size else 4))
    last = max(floor(log10(size)), floor(log10(abs(value) or size)) - MOST_DIGITS + 1)
    size = max(size, 10.0**last)
    if abs(value) < TINY and last < 0:
        return scale.named(f"{significant(value, 2)} ± {significant(size, 1)}")
    text = f"{value:.{max(0, -last)}f} ± {size:.{max(0, -last)}f}"
    return scale.named(text.replace("-", MINUS))


def in_its_unit(figure: Figure, quantities: Mapping[str, Quantity]) -> str:
    """`stated` in the unit that suits it."""
    return stated(figure, scale_of([figure.value], quantities[figure.quantity].unit))


def in_context(hertz: "HertzContact", quantities: Mapping[str, Quantity]) -> Below:
    """Line below a value: what it is over that of the smooth contact, or else where it is."""

    def below(figure: Figure) -> str:
        over, ends = quantities[figure.quantity].over, figure.place or ()
        if figure.against is not None:
            return ""
        if over is not None:
            scale = over[0] * quantities[figure.quantity].scale(hertz)
            return Scale(scale, over[1]).text(figure.value)
        at = zip("xz", ends, strict=False)
        return ", ".join(f"{name} = {with_unit(end, 'm')}" for name, end in at)

    return below


def figure_table(
    figures: Sequence[Figure],
    quantities: Mapping[str, Quantity],
    title: str = "",
    below: Below = lambda figure: "",
    beside: Mapping[str, Below] = {},
    off: Callable[[Figure], tuple[str, str]] | None = None,
    brief: bool = False,
) -> TextTable:
    """A row for each quantity, friction coefficient and difference, in the order of quantities;
    rows of several coefficients that look the same are joined. Each source's value ± its
    uncertainty, all in one unit; where anything is compared or judged difference, uncertainty,
    tolerance, verdict; then what `beside` says by its heads of the row's difference, or value.

    off    a difference and its uncertainty in words, where digits alone do not do
    brief  short names, and of what is compared values alone, in four digits"""
    known = _in_order(figures, quantities)
    pairs = dict.fromkeys((f.source, f.against) for f in known if f.against is not None)
    valued = [figure.source for figure in known if figure.against is None]
    sources = dict.fromkeys(name for name in (*chain(*pairs), *valued) if name in valued)
    is_judged = any(figure.bounds for figure in known)
    has_friction, rows = any(f.friction is not None for f in known), []
    for same in grouped(known, lambda figure: (figure.quantity, figure.friction)):
        values = {figure.source: figure for figure in same if figure.against is None}
        quantity = quantities[same[0].quantity]
        scale = scale_of([figure.value for figure in values.values()], quantity.unit)
        texts = []
        for source in sources:
            one = values.get(source)
            text = scale.text(one.value) if one and brief and pairs else stated(one, scale)
            texts.append(_lines(text, below(one) if one else ""))
        bounded = [figure for figure in values.values() if figure.bounds is not None]
        differences = [figure for figure in same if figure.against is not None]
        for figure in differences or bounded or same[:1]:
            name, apart, judged = quantity.short if brief else quantity.label, ("", ""), ("", "")
            if figure.against is not None:
                name = _lines(name, _pair(figure) if len(pairs) > 1 else "", below(figure))
                size = percent(figure.value, signed=bool(values), uncertainty=figure.numerical)
                apart = off(figure) if off else (size, percent(figure.numerical))
            if figure.bounds is not None:
                judged = _allowed(figure, quantity.unit), figure.verdict
            more = (say(figure) for say in beside.values())
            cells = *texts, *apart * bool(pairs), *judged * is_judged, *more
            rows.append((figure, (name, *cells)))
    joined = []
    for alike in grouped(rows, lambda row: (row[0].quantity, row[1])):
        name, *cells = alike[0][1]
        frictions = listed(f.friction for f, _ in alike if f.friction is not None)
        joined.append((name, *[frictions] * has_friction, *cells))
    head = ("quantity", *["friction"] * has_friction, *(LABELS.get(n, n) for n in sources))
    head += ("difference", "uncertainty") * bool(pairs) + ("tolerance", "verdict") * is_judged
    return TextTable(title, (*head, *beside), tuple(joined), "comparison", words=bool(beside))


def _lines(*texts: str) -> str:
    return "\n".join(filter(None, texts))


def _pair(figure: Figure) -> str:
    return " against ".join(LABELS.get(name, name) for name in (figure.source, figure.against))


def _allowed(figure: Figure, unit: str) -> str:
    """The tolerance of a difference; of a value by itself the most that it may be."""
    if figure.against is not None:
        return percent_as_written(figure.tolerance)
    return f"at most {with_unit(figure.tolerance * figure.scale, unit, 3)}"


def facts_of(
    figures: Sequence[Figure], quantities: Mapping[str, Quantity], names: Mapping[str, str] = {}
) -> list[tuple[str, str]]:
    """Names and values of facts that a table does not hold: by whom, in the words of `names` if
    there are any, and at which friction where there are several."""
    known = _in_order(figures, quantities)
    several = len({figure.friction for figure in known} - {None}) > 1
    facts = []
    for figure in known:
        by, at = names.get(figure.source, figure.source), figure.at if several else {}
        name = _named(quantities[figure.quantity].label, by, at)
        facts.append((name, in_its_unit(figure, quantities)))
    return facts


def in_words(statements: Iterable[Statement]) -> list[tuple[str, str]]:
    """Statements as names and texts."""
    return [(_named(said.name, said.source, said.at), said.text) for said in statements]


def _named(name: str, source: str, at: Mapping[str, float]) -> str:
    places = (f"{key} {plain(value)}" for key, value in at.items())
    return ", ".join(filter(None, (name, LABELS.get(source, source), *places)))


def line_of(figures: Sequence[Figure], quantities: Mapping[str, Quantity]) -> str:
    """Sentence on what is judged: the first quantity, where all agree or hold, else how many do
    not, and which is farthest outside its tolerance or nearest to it. Where nothing is judged, the
    first quantity by each source. Where there are several friction coefficients, at the largest."""
    known = _in_order(figures, quantities)
    judged = [figure for figure in known if figure.bounds is not None]
    if not known:
        return ""
    one, said, after = (deciding(judged) if judged else known[0]), "", ""
    alike = [figure for figure in judged if figure.verdict == one.verdict] or known
    if one.verdict in (None, *PASSED):
        first = [figure for figure in alike if figure.quantity == alike[0].quantity]
        after = f"; all {len(judged)} {one.verdict}" if judged[1:] else ""
        one = max(first, key=lambda figure: figure.friction or 0.0)
    elif judged[1:]:
        which = "the farthest outside" if one.verdict in FAILED else "nearest to its tolerance"
        said = f"{len(alike)} of {len(judged)} {one.verdict}{f'; {which}' * bool(alike[1:])}: "
    meaning = quantities[one.quantity]
    same = [figure for figure in known if (figure.quantity, figure.at) == (one.quantity, one.at)]
    by = [
        f"{in_its_unit(figure, quantities)} ({LABELS.get(figure.source, figure.source)})"
        for figure in same
        if figure.against is None
    ]
    at = f" at friction {plain(one.friction)}" if len({f.friction for f in known}) > 1 else ""
    said += " ".join(filter(None, (f"{meaning.label}{at}", ", ".join(by))))
    if one.bounds is not None and one.against is None:
        said += f" ({_allowed(one, meaning.unit)}: {one.verdict})"
    differences = [f for f in (one, *same) if f.against is not None][:1]
    for figure in differences:
        pair = f", {_pair(figure)}" if len({f.against for f in same}) > 2 else ""
        said += f"{':' * bool(by)} {figure.words()}{pair}"
    return said + after


def _in_order(figures: Sequence[Figure], quantities: Iterable[str]) -> list[Figure]:
    return [figure for name in quantities for figure in figures if figure.quantity == name]


def stated_text(column: Column) -> list[str]:
    """A column's cells: texts, or numbers in three digits with what they are uncertain by."""
    cells = []
    for value, size in zip(column.values, column.sizes, strict=True):
        text = value if isinstance(value, str) else with_unit(value, column.unit, 3)
        cells.append(f"{text} ± {percent(size / value, digits=1)}" if size > 0.0 else text)
    return cells


def series_table(title: str, series: Series) -> TextTable:
    """A row for each of a series' columns, by its name in words; the first is the head."""
    head, *rows = (
        (name.removeprefix("figures.").replace("_", " ").replace(".", ", "), *stated_text(column))
        for name, column in series.columns.items()
    )
    return TextTable(title, head, tuple(rows))
