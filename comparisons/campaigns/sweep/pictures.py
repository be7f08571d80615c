"""The pictures of a sweep.

In: the content of sweep.json. Out: SVG, the same for the same content."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import plain, scale_of
from comparisons.common.units import DIMENSIONS, UnitError, to_si
from comparisons.drawing import style
from comparisons.drawing.curves import over, panels
from comparisons.figures.quantity import LABELS, QUANTITIES
from comparisons.studies.subsurface import bulge, quiescent_zone
from comparisons.studies.subsurface.quiescent_zone import BRIDGED, QUIESCENT, SMOOTH, UNCLEAR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PICTURE = "sweep.svg"
PICTURES = {quiescent_zone.NAME: "quiescent_zone.svg", bulge.NAME: "bulge.svg"}  # by study
POSITION, FRICTION = "load.position", "load.friction"
MARKERS = "os^Dv<>"
WIDTH, TALL, ABOVE, FOOT, LEFT = 7.2, 1.75, 0.35, 0.8, 0.9  # inches, of the sweep's own picture
DRAWN = ("peak_pressure", "contact_length", "tau1_max")
# of the bulges: by the figure's name its uncertainty's, what it is drawn over, and the axis' words
PANELS = {
    "height": ("uncertainty", "penetration", "bulge over h"),
    "end": ("end_uncertainty", "contact", "half of it at, over a\u2032"),
    "energy": ("energy_uncertainty", "work_scale", "energy over P h"),
}
DEPTH = "relative_penetration"
COLOURS = {QUIESCENT: "#56B4E9", UNCLEAR: "#F0E442", BRIDGED: "#E69F00", SMOOTH: "#e4e4e4"}
CELL, LEAST_WIDE = (0.5, 0.24), 5.0  # inches, of the zones' map
SQUARE = (-0.5, 0.5, 0.5, -0.5), (-0.5, -0.5, 0.5, 0.5)


def drawn(content: dict) -> dict[str, str]:
    """SVG by file: the sweep, and what its points have of quiescent zones and bulges."""
    has = {name for point in content["points"] for name in PICTURES if name in point}
    draws = {PICTURE: sweep_figure}
    draws |= {PICTURES[name]: DRAWS[name] for name in DRAWS if name in has}
    with style.drawing():
        return {file: style.svg(draw(content)) for file, draw in draws.items()}


def sweep_figure(content: dict) -> "Figure":
    """Each figure over the first swept field, a line for each combination of the others; of the
    first line mean and standard deviation as a band."""
    rows = [row for point in content["points"] for row in point["rows"]]
    names = [name for name in DRAWN if any(row["quantity"] == name for row in rows)]
    drawn, stack = panels(WIDTH, [(ABOVE, TALL)] * len(names), LEFT, foot=FOOT)
    for name, axes in zip(names, stack, strict=True):
        _draw_figures(axes, content, name)
    field = content["over"][0]["field"]
    moved = "position of the roller on the trace, mm"
    stack[-1].set_xlabel(moved if field == POSITION else field)
    stack[0].set_title(content["scene"]["title"], loc="left")
    handles, labels = stack[-1].get_legend_handles_labels()
    if len(labels) > 1:
        drawn.legend(handles, labels, loc="lower left", ncols=4, borderaxespad=0.2)
    return drawn


def _places(axis: dict) -> tuple[np.ndarray, list[str] | None]:
    """Where the values of a field are drawn, and what stands there where these are no numbers."""
    for dimension in DIMENSIONS:
        try:
            values = np.array([to_si(value, dimension) for value in axis["values"]])
        except UnitError:
            continue
        return (1e3 * values if axis["field"] == POSITION else values), None
    return np.arange(len(axis["values"]), dtype=float), [str(v) for v in axis["values"]]


def _lines(content: dict, name: str, places: np.ndarray) -> dict[tuple, list[tuple[float, float]]]:
    """Points of a quantity by the values of the other fields, and by friction where that is none:
    by the model that the sweep is of, the half-plane where there are both."""
    axes, lines = content["over"], {}
    model = "finite_element" if "half_plane" not in content["models"] else "half_plane"
    swept = any(axis["field"] == FRICTION for axis in axes)
    for point in content["points"]:
        at = places[axes[0]["values"].index(point["values"][0])]
        for row in point["rows"]:
            if row["quantity"] == name and row[model] is not None:
                other = (*point["values"][1:], *(() if swept else (row["friction"],)))
                lines.setdefault(other, []).append((at, row[model]))
    return lines


def _draw_figures(axes: "Axes", content: dict, name: str) -> None:
    places, names = _places(content["over"][0])
    lines = _lines(content, name, places)
    fields = [*(axis["field"] for axis in content["over"][1:]), "friction"]
    scale = scale_of([y for line in lines.values() for _, y in line], QUANTITIES[name].unit)
    for number, (other, line) in enumerate(sorted(lines.items(), key=str)):
        x, y = np.array(sorted(line)).T
        label = ", ".join(f"{f} {value}" for f, value in zip(fields, other, strict=False))
        look = {"marker": MARKERS[number % len(MARKERS)], "markersize": 3.2, "linewidth": 1.0}
        [drawn] = axes.plot(x, y / scale.factor, label=label, **look)
        if len(y) > 2 and number == 0:
            mean, spread = np.mean(y), np.std(y, ddof=1)
            band = {"color": drawn.get_color(), "alpha": 0.15, "linewidth": 0.0}
            axes.axhspan((mean - spread) / scale.factor, (mean + spread) / scale.factor, **band)
            axes.axhline(mean / scale.factor, color=drawn.get_color(), linewidth=0.6)
    axes.set_ylabel(f"{QUANTITIES[name].label}\n{scale.name}")
    if names is not None:
        axes.set_xticks(places, names)


def bulge_figure(content: dict) -> "Figure":
    """What sliding raises ahead of the contact: its height, extent and elastic energy against the
    relative penetration, a line for each friction."""
    entries = [entry for point in content["points"] for entry in point.get(bulge.NAME, ())]
    entries.sort(key=lambda entry: entry[DEPTH])
    drawn, stack = panels(style.COLUMN, [(0.2, 1.5)] * len(PANELS), 0.85, foot=0.75)
    for (name, (unsure, unit, words)), axes in zip(PANELS.items(), stack, strict=True):
        for k, friction in enumerate(sorted({entry["friction"] for entry in entries})):
            rows = [e for e in entries if e["friction"] == friction and e[unsure] is not None]
            depth = [e[DEPTH] for e in rows]
            value, bar = ([e[which] / e[unit] for e in rows] for which in (name, unsure))
            look = {"marker": MARKERS[k % len(MARKERS)], "markersize": 3.0, "capsize": 2.0}
            axes.errorbar(depth, value, bar, label=f"friction {plain(friction)}", **look)
        axes.set(xscale="log", ylabel=words)
    over(stack, "h/R", (0.9 * entries[0][DEPTH], 1.1 * entries[-1][DEPTH]))
    stack[0].legend(loc="upper left")
    stack[0].set_title(content["scene"]["title"], loc="left")
    return drawn


def zone_map_figure(content: dict) -> "Figure":
    """A field for each friction, a column for each value of the first swept field, a row for each
    combination of the others; in it the least mean shear over that of the Hertz zone."""
    names, model = [axis["field"] for axis in content["over"]], content["models"][0]
    fields = {
        axis["field"]: axis["values"] for axis in content["over"] if axis["field"] != FRICTION
    }
    by_friction: dict[float, dict[tuple, dict]] = {}  # then by values of the other fields
    for point in content["points"]:
        values = tuple(v for n, v in zip(names, point["values"], strict=True) if n != FRICTION)
        for entry in point.get(quiescent_zone.NAME, {}).get(model, ()):
            by_friction.setdefault(entry["friction"], {})[values] = entry
    first, *others = fields or [""]
    columns = list(fields.get(first, [""]))
    rows = list(dict.fromkeys(key[1:] for entries in by_friction.values() for key in entries))
    (across, down), left, right, above = CELL, 1.25, 0.3, 0.32
    wide = max(left + across * len(columns) + right, LEAST_WIDE)
    heights = [(above, down * len(rows))] * len(by_friction)
    drawn, stack = panels(wide, heights, left, right, foot=0.8)
    for axes, friction in zip(stack, sorted(by_friction), strict=True):
        _draw_zones(axes, by_friction[friction], columns, rows)
        axes.set_title(f"friction {plain(friction)}, {LABELS[model]}")
    over(stack, first)
    stack[0].set_ylabel(", ".join(others))
    look = {"marker": "s", "linestyle": "none", "markersize": 7.0}
    keys = [stack[0].plot([], [], color=c, label=n, **look)[0] for n, c in COLOURS.items()]
    drawn.legend(handles=keys, loc="lower left", ncols=4, columnspacing=1.0, handlelength=1.0)
    return drawn


def _draw_zones(axes: "Axes", entries: dict[tuple, dict], columns: list, rows: list) -> None:
    for key, entry in entries.items():
        at = columns.index(key[0] if key else ""), rows.index(key[1:])
        square = np.add(SQUARE, np.reshape(at, (2, 1)))
        axes.fill(*square, facecolor=COLOURS[entry["status"]], edgecolor="white")
        level = f"{entry['level']['value']:.2f}"
        axes.text(*at, level, ha="center", va="center", fontsize=8.0)
    axes.set(xlim=(-0.5, len(columns) - 0.5), ylim=(-0.5, len(rows) - 0.5))
    axes.set_xticks(range(len(columns)), [str(value) for value in columns], fontsize=7.5)
    axes.set_yticks(range(len(rows)), [", ".join(map(str, row)) for row in rows], fontsize=7.5)
    axes.grid(False)


DRAWS = {quiescent_zone.NAME: zone_map_figure, bulge.NAME: bulge_figure}
