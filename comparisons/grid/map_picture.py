"""A map as a picture: colours by the model error of the half-plane, lines at the tolerances.

Each point is a cell. Where the error is within its numerical uncertainty the cell is hatched,
without colour: dots where both are below the first tolerance, lines where the error may be above. A
failed point has a cross. A scene of the user's own may be marked.
"""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.drawing.style import figure
from comparisons.figures.quantity import label
from comparisons.grid.groups import GROUPS
from comparisons.grid.map_error import BELOW, INCONCLUSIVE, SIGNIFICANT, of_points
from comparisons.grid.points import FAILED

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Mark = tuple[str, tuple[float, float]]
SIZE = (7.2, 5.9)  # inches
BOX = (0.105, 0.2, 0.74, 0.71)
BAR = (0.87, 0.2, 0.028, 0.71)
BANDS = (0.0, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 0.1, 0.2, 0.5)
COLOURS = "cividis_r"  # for every kind of colour vision; darker is worse
LETTERED = 12  # columns up to which each cell states its error
STYLES = ((0, (1, 1.2)), (0, (5, 1.5)), "-", (0, (7, 1.5, 1, 1.5)))
HATCHES = {BELOW: "....", INCONCLUSIVE: "////"}


def map_figure(content: dict, mark: Mark | None = None) -> "Figure":
    """A map's content; the same for the same content.

    mark  name of a scene, and its values of the groups of x and y
    """
    drawn = figure(*SIZE)
    axes = drawn.add_axes(BOX)
    x, y = (places(content[name]) for name in ("x", "y"))
    edges = _edges(x), _edges(y)
    axes.set(xlim=edges[0][[0, -1]], ylim=edges[1][[0, -1]])
    axes.grid(False)
    kinds = _cells(axes, content, edges)
    lines = _lines(axes, content, x, y)
    _ticks(axes.xaxis, content["x"], x)
    _ticks(axes.yaxis, content["y"], y)
    _bar(drawn)
    what = label(content["quantity"])
    axes.set_title(f"Model error of the half-plane: {what}, per cent\n{content['scene']['title']}")
    marked = []
    if mark is not None:
        name, values = mark
        at = [places(content[axis], value)[0] for axis, value in zip("xy", values, strict=True)]
        look = {"marker": "*", "markersize": 15.0, "color": "#E6007A", "markeredgecolor": "white"}
        look |= {"linestyle": "none", "label": name}
        marked = axes.plot(*at, zorder=5, clip_on=False, **look)
    _legend(axes, content, kinds, lines, marked)
    return drawn


def places(axis: dict, *values: float) -> np.ndarray:
    """Where values lie on an axis, its own by default: their logarithms on a logarithmic axis."""
    values = np.array(values or axis["values"])
    return np.log10(values) if axis["logarithmic"] else values


def scaled(error: np.ndarray | float, content: dict) -> np.ndarray | float:
    """Error on a map's scale: nearly logarithmic for either sign, straight as its groups say."""
    straight = max(GROUPS[content[axis]["group"]].straight for axis in "xy")
    return np.arcsinh(np.asarray(error) / straight)


def _edges(places: np.ndarray) -> np.ndarray:
    middles = 0.5 * (places[1:] + places[:-1])
    return np.concatenate([[2 * places[0] - middles[0]], middles, [2 * places[-1] - middles[-1]]])


def _cells(axes: "Axes", content: dict, edges: tuple[np.ndarray, np.ndarray]) -> set[str]:
    """Draw the cell of every point; the kinds that are drawn beside the coloured ones."""
    from matplotlib import colormaps
    from matplotlib.patches import Rectangle

    colours, kinds = colormaps[COLOURS], set()
    columns = len(content["x"]["values"])
    for number, point in enumerate(content["points"]):
        row, column = divmod(number, columns)
        left, low = edges[0][column], edges[1][row]
        wide, high = edges[0][column + 1] - left, edges[1][row + 1] - low
        middle = (left + 0.5 * wide, low + 0.5 * high)
        look = {"edgecolor": "white", "linewidth": 0.4, "facecolor": "none"}
        if point["status"] == FAILED:
            kinds.add(FAILED)
            axes.plot(*middle, "x", color="#222222", markersize=7.0, markeredgewidth=1.2)
            continue
        if point["error"] == SIGNIFICANT:
            error = point["quantities"][content["quantity"]]["difference"]
            share = _share(abs(error))
            look["facecolor"] = colours(share)
            if columns <= LETTERED:
                ink = _ink(look["facecolor"])
                digits = "#.2g" if abs(error) < 0.995 else ".0f"
                text = f"{100.0 * error:+{digits}}".rstrip(".").replace("-", "−")
                # lines stop short of letters
                box = {"facecolor": look["facecolor"], "edgecolor": "none", "pad": 0.8}
                letters = {"color": ink, "fontsize": 7.0, "ha": "center", "va": "center"}
                axes.text(*middle, text, zorder=4, bbox=box, **letters)
        else:
            kinds.add(point["error"])
            look |= {"hatch": HATCHES[point["error"]], "edgecolor": "#777777"}
        axes.add_patch(Rectangle((left, low), wide, high, **look))
    return kinds


def _ink(colour: tuple[float, ...]) -> str:
    """Black or white, whichever stands out more from a colour (WCAG's relative luminance)."""
    red, green, blue = (
        c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in colour[:3]
    )
    luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue
    return "black" if (luminance + 0.05) / 0.05 > 1.05 / (luminance + 0.05) else "white"


def _share(error: float) -> float:
    return (np.searchsorted(BANDS, error, side="right") - 1) / (len(BANDS) - 1)


def _lines(axes: "Axes", content: dict, x: np.ndarray, y: np.ndarray) -> dict[float, object]:
    """Where the error is at each tolerance, either sign, straight between points on its scale.
    Returns the style of the line of every tolerance that the map reaches."""
    from matplotlib.patheffects import Normal, Stroke

    error = of_points(content, "difference")
    drawn = {}
    for tolerance, style in zip(content["tolerances"], STYLES, strict=True):
        for side in (-1.0, 1.0):
            if np.nanmax(side * error, initial=-np.inf) <= tolerance:
                continue
            drawn[tolerance] = style
            values = np.ma.masked_invalid(scaled(side * error, content))
            look = {"colors": "#D55E00", "linewidths": 1.3, "linestyles": [style]}
            lines = axes.contour(x, y, values, levels=[scaled(tolerance, content)], **look)
            lines.set(path_effects=[Stroke(linewidth=2.6, foreground="white"), Normal()])
    return drawn


def _ticks(side: object, axis: dict, places: np.ndarray) -> None:
    side.set_label_text(f"{axis['symbol']}, {axis['label']}")
    if not axis["logarithmic"]:
        return
    low, high = np.floor(places[0]), np.ceil(places[-1])
    decades = 10.0 ** np.arange(low, high + 1)
    values = [m * d for d in decades for m in (1, 2, 5)]
    ends = side.get_view_interval()
    values = [v for v in values if ends[0] <= np.log10(v) <= ends[1]]
    side.set_ticks(np.log10(values), [f"{v:g}" for v in values])
    minor = np.log10([m * d for d in decades for m in range(1, 10)])
    side.set_ticks(minor[(minor >= ends[0]) & (minor <= ends[1])], minor=True)


def _bar(drawn: "Figure") -> None:
    from matplotlib import colormaps
    from matplotlib.patches import Rectangle

    bar = drawn.add_axes(BAR)
    count = len(BANDS)
    for number, low in enumerate(BANDS):
        colour = colormaps[COLOURS](_share(low))
        bar.add_patch(Rectangle((0.0, number), 1.0, 1.0, facecolor=colour, edgecolor="white"))
    bar.set(xlim=(0.0, 1.0), ylim=(0.0, count), xticks=[])
    bar.grid(False)
    bar.yaxis.tick_right()
    bar.set_yticks(range(1, count), [f"{100.0 * band:g} %" for band in BANDS[1:]])
    bar.tick_params(length=0.0)
    for spine in bar.spines.values():
        spine.set_visible(False)


def _legend(
    axes: "Axes", content: dict, kinds: set[str], lines: dict[float, object], marked: list[object]
) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    look = {"color": "#D55E00", "linewidth": 1.3}
    entries = [
        Line2D([], [], linestyle=style, label=f"error of {100 * t:g} %", **look)
        for t, style in lines.items()
    ]
    first = f"{100.0 * content['tolerances'][0]:g} %"
    words = {
        BELOW: f"within its uncertainty, below {first}",
        INCONCLUSIVE: "within its uncertainty",
    }
    for kind, said in words.items():
        if kind in kinds:
            look = {"facecolor": "none", "edgecolor": "#777777", "hatch": HATCHES[kind]}
            entries.append(Patch(label=said, linewidth=0.4, **look))
    if FAILED in kinds:
        cross = {"marker": "x", "color": "#222222", "linestyle": "none"}
        entries.append(Line2D([], [], label="failed", **cross))
    entries += marked
    if entries:
        place = {"loc": "upper left", "bbox_to_anchor": (-0.1, -0.115), "borderaxespad": 0.0}
        axes.legend(handles=entries, ncols=4, columnspacing=1.4, **place)
