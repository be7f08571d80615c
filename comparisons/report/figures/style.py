"""How every picture of the report looks, and how it becomes part of the page.

Colours are those of Okabe and Ito, which every kind of colour vision tells apart; each has its own
line style, for grey printers.
"""

import base64
import io
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMN = 5.6  # inches: two such pictures stand side by side on a wide screen
WIDE = 11.4  # inches: a picture across the page

LINES = {
    "half_plane": {"color": "#0072B2", "linestyle": "-", "linewidth": 1.5},
    "finite_element": {"color": "#D55E00", "linestyle": (0, (4, 1.6)), "linewidth": 1.1},
    "whole": {"color": "#009E73", "linestyle": (0, (7, 1.2, 1.4, 1.2)), "linewidth": 1.3},
}
REFERENCE = {"color": "#222222", "linestyle": (0, (1, 1.3)), "linewidth": 1.3}
DIFFERENCE = {"color": "#222222", "linestyle": "-", "linewidth": 0.9}
BODY = {"facecolor": "#dcd6cb", "edgecolor": "none"}
ROLLER = {"facecolor": "#cfdbe6", "edgecolor": "none"}
OUTLINE = {"color": "#444444", "linewidth": 1.0}

_OUTLINE = re.compile(rb' d="([^"]*)"')
_DECIMALS = re.compile(rb"(\.\d\d)\d+")
_BLANKS = re.compile(rb"\s*([MLCQZz])\s*")

_SETTINGS = {
    "axes.axisbelow": True,
    "axes.edgecolor": "#555555",
    "axes.grid": True,
    "axes.labelsize": 9.0,
    "axes.linewidth": 0.7,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlelocation": "left",
    "axes.titlesize": 9.0,
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "grid.color": "#e2e2e2",
    "grid.linewidth": 0.6,
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "legend.handlelength": 2.6,
    "path.simplify_threshold": 0.2,
    "savefig.dpi": 170.0,  # of what is rasterised inside a picture
    "svg.fonttype": "path",  # the same letters on every machine
    "svg.hashsalt": "crosscheck",  # the same names inside for the same picture
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
}


@dataclass(frozen=True)
class Picture:
    """A drawn picture.

    source       data URI
    alternative  what it shows, for those who cannot see it
    caption      what it shows and how to read it
    narrow       data URI of a version for narrow screens
    wide         across the page
    field        JSON: which field is drawn where, for values under the pointer
    """

    source: str
    alternative: str
    caption: str
    narrow: str | None = None
    wide: bool = False
    field: str | None = None


_COLLECTED: "ContextVar[list[Figure] | None]" = ContextVar("collected_figures", default=None)


@contextmanager
def drawing() -> Iterator[None]:
    """Settings of matplotlib for what is drawn inside; the caller's settings come back."""
    import matplotlib

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_SETTINGS)
        yield


@contextmanager
def collected_figures() -> "Iterator[list[Figure]]":
    """Collect the figures that are drawn inside, as figures of pyplot and not as images."""
    drawn: list[Figure] = []
    token = _COLLECTED.set(drawn)
    try:
        with drawing():
            yield drawn
    finally:
        _COLLECTED.reset(token)


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
    drawn: "Figure", panels: Sequence[tuple[float, float]], left: float, right: float = 0.12
) -> "list[Axes]":
    """Axes under each other from the top, all in inches.

    panels  space above each and its height
    left, right  space beside them
    """
    width, height = drawn.get_size_inches()
    across = (width - left - right) / width
    edge, made = height, []
    for above, tall in panels:
        edge -= above + tall
        made.append(drawn.add_axes((left / width, edge / height, across, tall / height)))
    return made


def near(x: np.ndarray, across: tuple[float, float], margin: float) -> np.ndarray:
    """Which places lie between two ends, or at most `margin` beyond them."""
    return (x >= across[0] - margin) & (x <= across[1] + margin)


def fill_bodies(
    axes: "Axes", x: np.ndarray, body: np.ndarray, roller: np.ndarray, low: float, high: float
) -> None:
    """Fill the body down to `low` and the roller up to `high`."""
    axes.fill_between(x, low, body, **BODY)
    axes.fill_between(x, roller, high, **ROLLER)
    axes.set_ylim(low, high)
    axes.grid(False)


def horizontal_bars(axes: "Axes", places: np.ndarray, names: list[str]) -> None:
    """Axes of bars that lie under each other at `places`, which descend from 0."""
    axes.set_ylim(places[-1] - 0.6, 0.6)
    axes.set_yticks(places, names)
    axes.tick_params(axis="y", length=0.0)
    axes.grid(False, axis="y")


def symmetric(axes: "Axes", values: np.ndarray) -> None:
    """Limits of a difference's axis: zero in the middle, few ticks."""
    largest = 1.25 * (np.max(np.abs(values), initial=0.0) or 1.0)
    axes.set_ylim(-largest, largest)
    axes.locator_params(axis="y", nbins=3)


def svg(drawn: "Figure") -> str:
    """The figure as SVG; equal figures give equal text."""
    buffer = io.BytesIO()
    drawn.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    # a hundredth of a point is enough for outlines, and half the size
    short = _OUTLINE.sub(_shortened, buffer.getvalue())
    return short.decode("utf-8")


def _shortened(outline: re.Match[bytes]) -> bytes:
    """An outline without invisible decimals and blanks."""
    return b' d="' + _BLANKS.sub(rb"\1", _DECIMALS.sub(rb"\1", outline[1])).strip() + b'"'


def data_uri(drawn: "Figure") -> str:
    """The figure as an SVG image; empty inside `collected_figures`."""
    if _COLLECTED.get() is not None:
        return ""
    text = base64.b64encode(svg(drawn).encode()).decode("ascii")
    return "data:image/svg+xml;base64," + text
