"""Error against time, a diagram a quantity: methods as lines, the floor, and the Pareto front."""

import math

from comparisons.campaigns.cost.methods import METHODS
from comparisons.campaigns.cost.recommend import Cost, needs_stress
from comparisons.campaigns.cost.study import OK
from comparisons.common.numbers import given_percent, percent, with_unit
from comparisons.drawing.style import COLUMN, REFERENCE, Picture, data_uri, figure
from comparisons.figures.quantity import label

# Okabe and Ito's colours, a line style and a mark of its own for each.
DASHED = (0, (4, 1.6))
LOOKS = {
    "strips, FFT": ("#56B4E9", "-", "s"),
    "hats, FFT": ("#0072B2", "-", "o"),
    "P1": ("#CC79A7", DASHED, "^"),
    "P2": ("#D55E00", DASHED, "o"),
    "P3": ("#009E73", DASHED, "s"),
}
SMALL = {"textcoords": "offset points", "fontsize": 8.0}
HEIGHT = 3.9
LEAST = 1e-7  # smaller errors are drawn there


def cost_picture(cost: Cost, quantity: str) -> Picture:
    stresses = needs_stress([quantity])
    reference = cost.references[quantity]
    drawn = figure(COLUMN, HEIGHT)
    axes = drawn.add_axes((0.125, 0.115, 0.855, 0.735))
    floor = max(reference.floor, LEAST)
    for method in METHODS:
        points = [
            (row.seconds(stresses), max(row.errors[quantity].value, LEAST))
            for row in cost.rows
            if row.method == method and row.status == OK and quantity in row.errors
        ]
        if points:
            colour, line, mark = LOOKS[method.name]
            look = {"color": colour, "linestyle": line, "marker": mark, "markersize": 4.5}
            axes.plot(*zip(*points, strict=True), linewidth=1.1, label=method.name, **look)
    front = [
        (row.seconds(stresses), max(row.errors[quantity].value, floor))
        for row in cost.fronts[quantity]
    ]
    if front:
        look = {"linestyle": "none", "marker": "o", "markersize": 10.0, "markerfacecolor": "none"}
        look |= {"markeredgecolor": "#222222", "markeredgewidth": 0.9}
        axes.plot(*zip(*front, strict=True), label="Pareto front", **look)
    axes.set(xscale="log", yscale="log")
    first, last = axes.get_xlim()
    if reference.row is not None and math.isfinite(floor):
        low = min(axes.get_ylim()[0], 0.5 * floor)
        axes.axhspan(low, floor, facecolor="#eceff1", zorder=0)
        axes.set_ylim(bottom=low)
        look = {"ha": "right", "va": "top", "color": "#555555", **SMALL}
        axes.annotate(f"reference uncertain to {percent(floor)}", (last, floor), (-3, -3), **look)
    tolerance = cost.problem.scene.tolerances.get(quantity)
    if tolerance is not None:
        axes.axhline(tolerance, **REFERENCE)
        axes.annotate(f"tolerance {given_percent(tolerance)}", (first, tolerance), (3, 3), **SMALL)
    part = "stresses included" if stresses else "contact alone"
    axes.set(xlim=(first, last), xlabel=f"processor time [s], {part}", ylabel="relative error")
    drawn.legend(loc="upper left", ncol=4, bbox_to_anchor=(0.1, 1.0), columnspacing=1.2)
    return Picture(
        source=data_uri(drawn),
        alternative=_in_words(cost, quantity, stresses),
        caption=f"{label(quantity).capitalize()}: error against {reference.source}, over time.",
    )


def _in_words(cost: Cost, quantity: str, stresses: bool) -> str:
    rows = "; ".join(
        f"{row.method.name} {row.label} {percent(row.errors[quantity].value)} in "
        f"{with_unit(row.seconds(stresses), 's', 2)}"
        for row in cost.fronts[quantity]
    )
    return f"Error of the {label(quantity)} over time. Pareto front: {rows}."
