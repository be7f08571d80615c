"""Look of every picture of the report, and how it becomes part of the page.

Colours are those of Okabe and Ito, which every kind of colour vision tells apart; each has its own
line style, for grey printers.
"""

import base64
import io
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import partial
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.files import csv_text
from comparisons.drawing.blocks import attempted

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

EDGE, LABEL = 0.17, 0.27  # inches: from the picture's left to a label, from an axis down to its own
RIGHT = 0.18  # inches: room for half a number beyond an axis
COLUMN, THIRD = 5.6, 3.7  # inches: two or three such pictures stand side by side
ROWS = 1500  # of a picture's curves as CSV, at most; contact.csv has all
WIDE = 11.4  # inches: a picture across the page
SETTINGS = Path(__file__).with_name("pictures.mplstyle")

LINES = {
    "half_plane": {"color": "#0072B2", "linestyle": "-", "linewidth": 1.5},
    "finite_element": {"color": "#D55E00", "linestyle": (0, (4, 1.6)), "linewidth": 1.1},
    "whole": {"color": "#009E73", "linestyle": (0, (7, 1.2, 1.4, 1.2)), "linewidth": 1.3},
}
DASHES = [look["linestyle"] for look in LINES.values()] + [(0, (1, 1.3))]  # for other curves
REFERENCE = {"color": "#222222", "linestyle": (0, (1, 1.3)), "linewidth": 1.3}
PALE = {"linestyle": "-", "linewidth": 5.0, "alpha": 0.3, "zorder": 1.9}  # seen around another line
DIFFERENCE = {"color": "#222222", "linestyle": "-", "linewidth": 0.9}
BAND = {"color": "#0072B2", "alpha": 0.18, "linewidth": 0.0, "label": "inputs, 95 %"}
BODY = {"facecolor": "#dcd6cb", "edgecolor": "none"}
ROLLER = {"facecolor": "#cfdbe6", "edgecolor": "none"}
OUTLINE = {"color": "#444444", "linewidth": 1.0}
HATCHED = {"hatch": "////", "rasterized": True}  # browsers print patterns as coarse pixels
BEHIND_WORDS = {"facecolor": "#ffffff", "edgecolor": "none", "pad": 0.5}  # hides the grid
BEHIND_LEGEND = {"frameon": True, "framealpha": 1.0, "edgecolor": "none", "borderpad": 0.0}

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

_OUTLINE = re.compile(r' d="([^"]*)"')
_INVISIBLE = re.compile(r"(?<=\.\d\d)\d+|\s+(?=[MLCQZz])|(?<=[MLCQZz])\s+")


@dataclass(frozen=True)
class Picture:
    """A drawn picture."""

    source: str  # data URI
    alternative: str  # what it shows, for those who cannot see it
    caption: str  # what it shows and how to read it
    wide: bool = False  # across the page
    data: tuple[str, str] | None = None  # words of a link to its curves as CSV, and their data URI


_COLLECTED: "ContextVar[list[Figure] | None]" = ContextVar("collected_figures", default=None)


@contextmanager
def drawing() -> Iterator[None]:
    """Settings of matplotlib for what is drawn inside; the caller's settings come back."""
    import matplotlib

    with matplotlib.rc_context():
        matplotlib.rc_file(SETTINGS)
        yield


@contextmanager
def collected_figures() -> "Iterator[list[Figure]]":
    """Collect the figures that are drawn inside, as figures of pyplot and not as images."""
    from matplotlib import pyplot

    pyplot.draw_if_interactive()  # a notebook's backend, once loaded, says that figures show
    drawn: list[Figure] = []
    token = _COLLECTED.set(drawn)
    try:
        with drawing():
            yield drawn
    finally:
        _COLLECTED.reset(token)


class NamedPictures:
    """NamedPictures by name: called, each returns its axes, on a figure of pyplot, which a notebook
    shows by itself."""

    def __init__(self, **draws: "Callable[[], Figure]") -> None:
        vars(self).update({name: partial(_axes_of, draw) for name, draw in draws.items()})


def _axes_of(draw: "Callable[[], Figure]") -> "list[Axes]":
    with collected_figures():
        return draw().axes


def figure(width: float, height: float) -> "Figure":
    """An empty figure of `width` by `height` inches."""
    from matplotlib.figure import Figure

    others = _COLLECTED.get()
    if others is None:
        return Figure(figsize=(width, height))
    from matplotlib import pyplot

    others.append(pyplot.figure(figsize=(width, height)))
    return others[-1]


def stacked(
    drawn: "Figure", panels: Sequence[tuple[float, float]], left: float, right: float = RIGHT
) -> "list[Axes]":
    """Axes under each other from the top, all in inches.

    panels  space above each and its height
    left, right  space beside them
    Labels have fixed positions, so that those of one picture are aligned.
    """
    width, height = drawn.get_size_inches()
    across = (width - left - right) / width
    edge, made = height, []
    for above, tall in panels:
        edge -= above + tall
        axes = drawn.add_axes((left / width, edge / height, across, tall / height))
        axes.yaxis.set_label_coords((EDGE - left) / (across * width), 0.5)
        axes.xaxis.set_label_coords(0.5, -LABEL / tall)
        made.append(axes)
    return made


def near(x: np.ndarray, across: tuple[float, float], margin: float) -> np.ndarray:
    """True where x lies between two ends, or at most `margin` beyond them."""
    return (x >= across[0] - margin) & (x <= across[1] + margin)


def fill_bodies(
    axes: "Axes", x: np.ndarray, body: np.ndarray, roller: np.ndarray, low: float, high: float
) -> None:
    """Fill the body down to `low` and the roller up to `high`."""
    axes.fill_between(x, low, body, **BODY)
    axes.fill_between(x, roller, high, **ROLLER)
    axes.set_ylim(low, high)
    axes.grid(False)


def beside_bar(axes: "Axes", x: float, y: float, text: str) -> None:
    """Words to the right of a bar's end."""
    beside = {"textcoords": "offset points", "va": "center", "bbox": BEHIND_WORDS}
    axes.annotate(text, (x, y), (5, 0), **beside)


def whisker(
    axes: "Axes", x: float, y: float, reach: tuple[float, float], thick: float = 1.4, cap: float = 3
) -> None:
    """Draw how far a bar's end may be wrong to the left and to the right."""
    look = {"elinewidth": thick, "capsize": cap, "color": "#000000", "fmt": "none"}
    axes.errorbar(x, y, xerr=[[reach[0]], [reach[1]]], **look)


def power_of_ten(power: int) -> str:
    """Power of ten as text: matplotlib's own labels are formulas, which it takes a parser for."""
    return "10" + str(power).translate(SUPERSCRIPT)


def in_powers_of_ten(value: float, _: int) -> str:
    """Label of a tick at a power of ten."""
    return power_of_ten(round(math.log10(value)))


def svg(drawn: "Figure") -> str:
    """The figure as SVG; equal figures give equal text."""
    buffer = io.StringIO()
    drawn.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    # a hundredth of a point is enough for outlines, and half the size
    return _OUTLINE.sub(
        lambda outline: f' d="{_INVISIBLE.sub("", outline[1]).strip()}"', buffer.getvalue()
    )


def svgs(draws: "Mapping[str, Callable[[], Figure]]") -> dict[str, str]:
    """Drawings as SVG, by file name; without those that fail."""
    with drawing():
        made = {
            name: attempted(name, lambda draw=draw: svg(draw())) for name, draw in draws.items()
        }
    return {name: text for name, text in made.items() if isinstance(text, str)}


def picture(
    drawn: "Figure", alternative: str, caption: str, data: bool | tuple[str, str] = True
) -> Picture:
    """A figure as an SVG image, with its words; inside `collected_figures` words alone.

    data  whether its curves are offered as CSV, or words of a link and what it leads to"""
    if _COLLECTED.get() is not None:
        return Picture("", alternative, caption)
    text = base64.b64encode(svg(drawn).encode()).decode("ascii")
    return Picture(
        source="data:image/svg+xml;base64," + text,
        data=csv_link(drawn) if data is True else data or None,
        alternative=alternative,
        caption=caption,
        wide=drawn.get_figwidth() > COLUMN,
    )


def csv_link(drawn: "Figure") -> tuple[str, str]:
    """The figure's curves as CSV, columns side by side: x where it is another one, then y, of long
    curves not every point."""
    longest = max(len(line.get_xdata()) for axes in drawn.axes for line in axes.lines)
    step = -(-longest // ROWS)
    columns: list[tuple[str, np.ndarray]] = []
    across = next(filter(None, (axes.get_xlabel() for axes in reversed(drawn.axes))), "x")
    for axes in drawn.axes:
        panel = " ".join(filter(None, (axes.get_title(loc="left"), axes.get_ylabel())))
        last = np.empty(0)
        for line in axes.lines:
            x, y = (values[::step] for values in line.get_data())
            if line.get_transform() != axes.transData or len(x) < 3:
                continue
            label = str(line.get_label())
            name = ", ".join(filter(None, (panel, "" if label.startswith("_") else label)))
            columns += [] if np.array_equal(x, last) else [(axes.get_xlabel() or across, x)]
            columns.append((" ".join(name.split()), y))
            last = x
    rows = zip_longest(*([f"{v:.6g}" for v in values] for _, values in columns), fillvalue="")
    words = "CSV" if step == 1 else f"CSV, 1 point in {step}"
    return words, csv_uri([[name for name, _ in columns], *rows])


def csv_uri(rows: Sequence[Sequence[object]]) -> str:
    """Rows of a table as the data URI of a CSV file."""
    content = base64.b64encode(csv_text(rows).encode()).decode("ascii")
    return f"data:text/csv;charset=utf-8;base64,{content}"
