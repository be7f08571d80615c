"""The quiescent zone over a sweep: at each point how low the shear falls in it, and whether."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import plain
from comparisons.drawing import style
from comparisons.figures.quantity import LABELS
from comparisons.studies.quiescent_zone import BRIDGED, QUIESCENT, SMOOTH, UNCLEAR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = {QUIESCENT: "#56B4E9", UNCLEAR: "#F0E442", BRIDGED: "#E69F00", SMOOTH: "#e4e4e4"}
CELL, LEFT, RIGHT, ABOVE, FOOT = (0.5, 0.24), 1.25, 0.3, 0.32, 0.8  # inches
LEAST_WIDE = 5.0
SQUARE = (-0.5, 0.5, 0.5, -0.5), (-0.5, -0.5, 0.5, 0.5)
FRICTION = "load.friction"

Entries = dict[tuple, dict]  # of result.json by values of the swept fields without friction


def zone_map(content: dict) -> str:
    """SVG of a sweep's content; the same for the same content."""
    with style.drawing():
        return style.svg(zone_map_figure(content))


def zone_map_figure(content: dict) -> "Figure":
    """A field for each friction, a column for each value of the first swept field, a row for each
    combination of the others; in it the least mean shear over that of the Hertz zone."""
    names = [each["field"] for each in content["over"]]
    over = [each for each in content["over"] if each["field"] != FRICTION]
    model = content["models"][0]
    panels: dict[float, Entries] = {}
    for point in content["points"]:
        values = tuple(v for n, v in zip(names, point["values"], strict=True) if n != FRICTION)
        for entry in point.get("quiescent_zone", {}).get(model, ()):
            panels.setdefault(entry["friction"], {})[values] = entry
    columns = list(over[0]["values"]) if over else [""]
    rows = list(dict.fromkeys(key[1:] for entries in panels.values() for key in entries))
    height = CELL[1] * len(rows)
    wide = max(LEFT + CELL[0] * len(columns) + RIGHT, LEAST_WIDE)
    drawn = style.figure(wide, (ABOVE + height) * len(panels) + FOOT)
    places = style.stacked(drawn, [(ABOVE, height)] * len(panels), LEFT, RIGHT)
    for axes, friction in zip(places, sorted(panels), strict=True):
        _draw(axes, panels[friction], columns, rows)
        axes.set_title(f"friction {plain(friction)}, {LABELS[model]}")
        axes.tick_params(labelbottom=axes is places[-1])
    places[-1].set_xlabel(over[0]["field"] if over else "")
    places[0].set_ylabel(", ".join(each["field"] for each in over[1:]))
    look = {"marker": "s", "linestyle": "none", "markersize": 7.0}
    keys = [places[0].plot([], [], color=c, label=n, **look)[0] for n, c in COLOURS.items()]
    drawn.legend(handles=keys, loc="lower left", ncols=4, columnspacing=1.0, handlelength=1.0)
    return drawn


def _draw(axes: "Axes", entries: Entries, columns: list, rows: list[tuple]) -> None:
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
