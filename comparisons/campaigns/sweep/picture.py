"""A sweep as a picture: each figure over the first swept field, a line for each combination of the
others, and its mean and standard deviation as a band."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.campaigns.sweep.request import POSITION
from comparisons.common.numbers import scale_of
from comparisons.common.units import DIMENSIONS, UnitError, to_si
from comparisons.drawing import style
from comparisons.figures.quantity import QUANTITIES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDTH, TALL, ABOVE, FOOT = 7.2, 1.75, 0.35, 0.8  # inches
LEFT = 0.9
DRAWN = ("peak_pressure", "contact_length", "tau1_max")
MARKERS = "os^Dv<>"


def sweep_picture(content: dict) -> str:
    """SVG of a sweep's content; the same for the same content."""
    with style.drawing():
        return style.svg(sweep_figure(content))


def sweep_figure(content: dict) -> "Figure":
    rows = [row for point in content["points"] for row in point["rows"]]
    names = [name for name in DRAWN if any(row["quantity"] == name for row in rows)]
    drawn = style.figure(WIDTH, len(names) * (ABOVE + TALL) + FOOT)
    panels = style.stacked(drawn, [(ABOVE, TALL)] * len(names), LEFT)
    for name, axes in zip(names, panels, strict=True):
        _draw(axes, content, name)
    field = content["over"][0]["field"]
    moved = "position of the roller on the trace, mm"
    panels[-1].set_xlabel(moved if field == POSITION else field)
    panels[0].set_title(content["scene"]["title"], loc="left")
    handles, labels = panels[-1].get_legend_handles_labels()
    if len(labels) > 1:
        drawn.legend(handles, labels, loc="lower left", ncols=4, borderaxespad=0.2)
    return drawn


def _places(over: dict) -> tuple[np.ndarray, list[str] | None]:
    """Where the values of a field are drawn, and what stands there where these are no numbers."""
    for dimension in DIMENSIONS:
        try:
            values = np.array([to_si(value, dimension) for value in over["values"]])
        except UnitError:
            continue
        return (1e3 * values if over["field"] == POSITION else values), None
    return np.arange(len(over["values"]), dtype=float), [str(v) for v in over["values"]]


def _draw(axes: "Axes", content: dict, name: str) -> None:
    """One quantity by the model that the sweep is of: finite elements where there are both."""
    over, first = content["over"], content["over"][0]["values"]
    places, names = _places(over[0])
    figure = "finite_element" if "half_plane" not in content["models"] else "half_plane"
    lines: dict[tuple, list[tuple[float, float]]] = {}
    for point in content["points"]:
        for row in point["rows"]:
            if row["quantity"] == name and row[figure] is not None:
                swept = any(each["field"] == "load.friction" for each in over)
                other = (*point["values"][1:], *(() if swept else (row["friction"],)))
                at = places[first.index(point["values"][0])]
                lines.setdefault(other, []).append((at, row[figure]))
    scale = scale_of([y for line in lines.values() for _, y in line], QUANTITIES[name].unit)
    factor = scale.factor
    for number, (other, line) in enumerate(sorted(lines.items(), key=str)):
        x, y = np.array(sorted(line)).T
        label = ", ".join(
            f"{field} {value}"
            for field, value in zip(
                [*(o["field"] for o in over[1:]), "friction"], other, strict=False
            )
        )
        look = {"marker": MARKERS[number % len(MARKERS)], "markersize": 3.2, "linewidth": 1.0}
        [drawn] = axes.plot(x, y / factor, label=label, **look)
        if len(y) > 2 and number == 0:
            mean, spread = np.mean(y), np.std(y, ddof=1)
            band = {"color": drawn.get_color(), "alpha": 0.15, "linewidth": 0.0}
            axes.axhspan((mean - spread) / factor, (mean + spread) / factor, **band)
            axes.axhline(mean / factor, color=drawn.get_color(), linewidth=0.6)
    axes.set_ylabel(f"{QUANTITIES[name].label}\n{scale.name}")
    if names is not None:
        axes.set_xticks(places, names)
