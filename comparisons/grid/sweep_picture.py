"""The pictures of a sweep.

In: the content of sweep.json. Out: SVG, the same for the same content."""

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from comparisons.common.numbers import plain, scale_of
from comparisons.common.units import DIMENSIONLESS, UnitError, to_si
from comparisons.drawing import style
from comparisons.drawing.curves import distinct, over, panels
from comparisons.figures.quantity import LABELS, QUANTITIES
from comparisons.grid.points import SCENE, TRACE
from comparisons.judging import contact
from comparisons.scenes.scene import dimension_of
from comparisons.studies import quiescent_zone
from comparisons.studies.quiescent_zone import BRIDGED, QUIESCENT, SMOOTH, UNCLEAR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

POSITION, FRICTION = "load.position", "load.friction"
SAMPLES = POSITION, TRACE  # axes whose values are a sample; others are chosen
WORDS = {POSITION: "position of the roller on the trace", TRACE: "trace", SCENE: "scene"}
MARKERS = "os^Dv<>"
WIDTH, TALL, ABOVE, FOOT, LEFT = 7.2, 1.75, 0.3, 0.55, 0.9  # inches, of the sweep's own picture
HANDLE, CHARACTER, ENTRY = 0.6, 0.075, 0.19  # inches, of its legend
NAME, MOST_NAMES = 0.17, 100  # inches of each name along x, upright; how many are written
BAND = "mean ± standard deviation"
DRAWN = {
    "peak_pressure": "peak pressure",
    "contact_length": "contact length",
    "tau1_max": "largest τ₁",
}
NUMBERS = "numbers: least mean shear over the Hertz zone's"
COLOURS = {QUIESCENT: "#56B4E9", UNCLEAR: "#F0E442", BRIDGED: "#E69F00", SMOOTH: "#e4e4e4"}
CELL, LEAST_WIDE = (0.5, 0.24), 5.0  # inches, of the zones' map
SQUARE = (-0.5, 0.5, 0.5, -0.5), (-0.5, -0.5, 0.5, 0.5)


@dataclass(frozen=True)
class Axis:
    """A swept field as it is drawn: its values in one unit, or as they are written where they are
    no numbers."""

    field: str
    values: list  # as the scene has them
    places: np.ndarray
    texts: list[str]
    unit: str = ""
    is_number: bool = True

    @classmethod
    def of(cls, field: str, values: list) -> Self:
        dimension = dimension_of(field) or DIMENSIONLESS
        try:
            numbers = np.array([to_si(value, dimension) for value in values])
        except UnitError:
            places, texts = np.arange(len(values), dtype=float), list(map(str, values))
            names = [os.path.basename(text) for text in texts] if field == TRACE else texts
            texts = names if len(set(names)) == len(names) else texts
            return cls(field, values, places, texts, is_number=False)
        scale = scale_of(numbers, dimension.si_unit)
        places = numbers / scale.factor
        return cls(field, values, places, [plain(float(f"{p:.5g}")) for p in places], scale.name)

    @property
    def label(self) -> str:
        words = WORDS.get(self.field, self.field)
        return f"{words} [{self.unit}]" if self.unit else words

    def text(self, value: object) -> str:
        return self.texts[self.values.index(value)]

    def said(self, value: object) -> str:
        return f"{self.field} {self.text(value)} {self.unit}".rstrip()


def sweep_figure(content: dict) -> "Figure":
    """Each figure over the first swept field, a line for each combination of the others; over
    placements, mean and standard deviation of the first line as a band."""
    axes = [Axis.of(**swept) for swept in content["over"]]
    every = {name: _lines(content, name, axes) for name in DRAWN}
    lines = {name: known for name, known in every.items() if known}
    names = list(lines)
    line = next(iter(lines[names[0]].values()), ())
    sample = axes[0].field in SAMPLES and len(line) > 2
    labels = [*filter(None, lines[names[0]]), *([BAND] if sample else ())]
    wide = HANDLE + CHARACTER * max(map(len, labels), default=0)
    abreast = max(1, int((WIDTH - 0.2) / wide))
    every_nth = -(-len(axes[0].texts) // MOST_NAMES)
    written = axes[0].texts[::every_nth]
    upright = not axes[0].is_number and CHARACTER * len("".join(written)) > WIDTH - LEFT
    width = max(WIDTH, LEFT + NAME * len(written)) if upright else WIDTH
    foot = FOOT + ENTRY * -(-len(labels) // abreast)
    foot += CHARACTER * max(map(len, written)) if upright else 0.0
    drawn, stack = panels(width, [(ABOVE, TALL)] * len(names), LEFT, foot=foot)
    for name, panel in zip(names, stack, strict=True):
        _draw_lines(panel, lines[name], name, sample)
        if not axes[0].is_number:
            panel.set_xticks(axes[0].places[::every_nth], written, rotation=90.0 * upright)
    over(stack, "" if upright else axes[0].label)
    stack[0].set_title(content["scene"]["title"], loc="left")
    if labels:
        drawn.legend(*stack[0].get_legend_handles_labels(), loc="lower left", ncols=abreast)
    return drawn


def _lines(content: dict, name: str, axes: list[Axis]) -> dict[str, list[tuple[float, float]]]:
    """Points of a quantity over the first field by what the others are, and by friction where there
    are several: by the half-plane, or the model that the sweep is of."""
    model = "finite_element" if "half_plane" not in content["models"] else "half_plane"
    points = content["points"]
    wanted = {"study": contact.NAME, "quantity": name, "source": model}.items()
    known = [[row for row in point["rows"] if wanted <= row.items()] for point in points]
    several = len({row["friction"] for rows in known for row in rows}) > 1
    several = several and all(axis.field != FRICTION for axis in axes)
    lines: dict[str, list[tuple[float, float]]] = {}
    for point, rows in zip(points, known, strict=True):
        first, *others = point["values"]
        at = axes[0].places[axes[0].values.index(first)]
        words = [axis.said(value) for axis, value in zip(axes[1:], others, strict=True)]
        for row in rows:
            friction = [f"friction {plain(row['friction'])}"] if several else []
            lines.setdefault(", ".join([*words, *friction]), []).append((at, row["value"]))
    return lines


def _draw_lines(axes: "Axes", lines: dict[str, list], name: str, sample: bool) -> None:
    scale = scale_of([y for line in lines.values() for _, y in line], QUANTITIES[name].unit)
    curves = {label: tuple(np.array(sorted(line)).T) for label, line in lines.items()}
    apart = {names[0]: names for names in distinct(curves)}
    for number, (label, (x, y)) in enumerate(curves.items()):
        look = {"marker": MARKERS[number % len(MARKERS)], "markersize": 3.2, "linewidth": 1.0}
        look |= {"linestyle": style.DASHES[number % len(style.DASHES)], "color": f"C{number}"}
        shown = slice(None if label in apart else 0)  # one line over another is a third colour
        axes.plot(x[shown], y[shown] / scale.factor, label=label, **look)
        if sample and number == 0:
            mean, spread = np.mean(y) / scale.factor, np.std(y, ddof=1) / scale.factor
            band = {"color": "C0", "alpha": 0.15, "linewidth": 0.0, "label": BAND}
            axes.axhspan(mean - spread, mean + spread, **band)
            axes.axhline(mean, color="C0", linewidth=0.6)
    joint = [" = ".join(names) for names in apart.values() if names[1:]]
    said = "all lines coincide" if len(apart) == 1 else ", ".join(joint)
    axes.set_title(said if joint else "", loc="right")
    axes.set_ylabel(f"{DRAWN[name]} [{scale.name}]")


def zone_map_figure(content: dict) -> "Figure":
    """A field for each friction, a column for each value of the first swept field, a row for each
    combination of the others; in it the least mean shear over that of the Hertz zone."""
    model = content["models"][0]
    axes = [Axis.of(**swept) for swept in content["over"]]
    by_friction: dict[float, dict[tuple[str, str], dict]] = {}  # then by column and row
    for point in content["points"]:
        texts = [
            axis.text(value)
            for axis, value in zip(axes, point["values"], strict=True)
            if axis.field != FRICTION
        ]
        place = texts[0] if texts else "", ", ".join(texts[1:])
        for entry in point.get(quiescent_zone.NAME, {}).get(model, ()):
            by_friction.setdefault(entry["friction"], {})[place] = entry
    axes = [axis for axis in axes if axis.field != FRICTION]
    columns = axes[0].texts if axes else [""]
    rows = list(dict.fromkeys(row for entries in by_friction.values() for _, row in entries))
    (across, down), left, right, above = CELL, 1.25, 0.3, 0.32
    wide = max(left + across * len(columns) + right, LEAST_WIDE)
    heights = [(above, down * len(rows))] * len(by_friction)
    drawn, stack = panels(wide, heights, left, right, foot=1.17 if axes[1:] else 0.97)
    for panel, friction in zip(stack, sorted(by_friction), strict=True):
        _draw_zones(panel, by_friction[friction], columns, rows)
        panel.set_title(f"friction {plain(friction)}, {LABELS[model]}")
    upwards = f"\nupwards: {'; '.join(axis.label for axis in axes[1:])}" if axes[1:] else ""
    over(stack, f"{axes[0].label if axes else ''}{upwards}\n{NUMBERS}")
    look = {"marker": "s", "linestyle": "none", "markersize": 7.0}
    keys = [stack[0].plot([], [], color=c, label=n, **look)[0] for n, c in COLOURS.items()]
    drawn.legend(handles=keys, loc="lower left", ncols=4, columnspacing=1.0, handlelength=1.0)
    return drawn


def _draw_zones(axes: "Axes", entries: dict[tuple, dict], columns: list, rows: list) -> None:
    for (column, row), entry in entries.items():
        at = columns.index(column), rows.index(row)
        square = np.add(SQUARE, np.reshape(at, (2, 1)))
        axes.fill(*square, facecolor=COLOURS[entry["status"]], edgecolor="white")
        axes.text(*at, f"{entry['level']:.2f}", ha="center", va="center")
    axes.set(xlim=(-0.5, len(columns) - 0.5), ylim=(-0.5, len(rows) - 0.5))
    axes.set_xticks(range(len(columns)), columns)
    axes.set_yticks(range(len(rows)), rows)
    axes.tick_params(axis="y", length=0.0)
    axes.grid(False)
