"""Errors of the judged figures over the size of the elements, each beside its formal order."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import plain
from comparisons.drawing import style
from comparisons.figures.figure import grouped
from comparisons.figures.quantity import LABELS
from comparisons.output.page.tables.convergence import DIFFERENCE, JudgedSequence, judged_sequences
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMNS = 4
HEAD, TITLE, TALL, FOOT = 0.34, 0.36, 1.7, 0.5  # inches: legend, a panel's title, panel, its axis
LEFT, BETWEEN, LINE = 0.62, 0.5, 0.17  # inches
LEAST = 1e-9  # relative: what is nearer to the extrapolated value is rounding
LOOKS = style.LINES | {DIFFERENCE: style.DIFFERENCE}
NAMES = LABELS | {DIFFERENCE: "difference of both models"}


def convergence_picture(outcome: Run) -> style.Picture | None:
    """A panel for each judged figure; None where nothing is judged on several levels."""
    known = [each for each in judged_sequences(outcome) if len(each.figure.levels) > 2]
    panels = grouped(known, lambda each: each.name)
    if not panels:
        return None
    said = "; ".join(f"{each.name}, {NAMES[each.source]}: {each.known.behaviour}" for each in known)
    return style.picture(
        lambda width: _drawn(panels, width),
        f"Error over element size of each judged figure. {said}.",
        "Distance from the extrapolated value over the size of the pressure elements, both "
        "logarithmic; dotted, the slope of the formal order. A bar: the stated uncertainty of "
        "discretisation on the finest level. Where three levels show an order, their distances "
        "lie on its line by construction.",
    )


def _drawn(panels: list[list[JudgedSequence]], width: float) -> "Figure":
    columns = max(1, round(COLUMNS * width / style.WIDE))
    rows = -(-len(panels) // columns)
    head = HEAD if columns == COLUMNS else HEAD + 2.0 * LINE  # where names take three lines
    heights = [(TITLE + (FOOT if row else head), TALL) for row in range(rows)]
    drawn = style.figure(width, sum(map(sum, heights)) + FOOT)
    share = (width - LEFT) / columns
    sides = []
    for side in range(columns):
        left = LEFT + side * share
        here = heights[: -(-(len(panels) - side) // columns)]
        right = width - left - share + BETWEEN
        sides.append(style.stacked(drawn, here, left, right))
    for number, panel in enumerate(panels):
        axes = sides[number % columns][number // columns]
        _draw(axes, panel)
        if number % columns == 0:
            axes.set_ylabel("error, %")
        if number + columns >= len(panels):
            axes.set_xlabel("pressure elements, µm")
    entries = {}
    for axes in drawn.axes:
        handles, labels = axes.get_legend_handles_labels()
        entries = dict(zip(labels, handles, strict=True)) | entries
    beside = len(entries) if columns == COLUMNS else columns
    room = {"ncols": beside, "columnspacing": 1.6, "borderaxespad": 0.2}
    drawn.legend(entries.values(), entries, loc="upper left", **room)
    return drawn


def _draw(axes: "Axes", panel: list[JudgedSequence]) -> None:
    """All models' errors of one figure [%] over the pitch [µm]."""
    largest = 0.0, 0.0
    for each in panel:
        pitch, error = 1e6 * np.array(each.pitches), 100.0 * np.array(each.errors)
        seen = np.where(error > 100.0 * LEAST, error, np.nan)
        look, name = LOOKS[each.source], NAMES[each.source]
        axes.plot(pitch, seen, marker="o", markersize=3.5, label=name, **look)
        bar = {"marker": "_", "markersize": 13, "markeredgewidth": 2.0, "color": look["color"]}
        stated = 100.0 * each.figure.uncertainty.parts["discretisation"]
        if np.isfinite(stated) and stated > 0.0:
            axes.plot(pitch[-1], stated, linestyle="none", **bar)
        if np.isfinite(seen).any():
            largest = max(largest, (float(np.nanmax(seen)), float(pitch[np.nanargmax(seen)])))
    order = panel[0].known.formal_order
    pitch = 1e6 * np.array([max(panel[0].pitches), min(panel[0].pitches)])
    if largest[0] > 0.0:
        slope = largest[0] * (pitch / largest[1]) ** order
        axes.plot(pitch, slope, label=f"slope of order {plain(order)}", **style.REFERENCE)
    axes.set_xscale("log")
    if any(np.nanmax(line.get_ydata(), initial=0.0) > 0.0 for line in axes.lines):
        axes.set_yscale("log")
    else:
        axes.set_yticks([])
        axes.annotate("no change but rounding", (0.5, 0.5), xycoords="axes fraction", ha="center")
    ticks = sorted({1e6 * pitch for each in panel for pitch in each.pitches})
    axes.set_xticks(ticks, [f"{tick:.3g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlim(0.8 * ticks[0], 1.25 * ticks[-1])
    axes.set_title(panel[0].name.replace(", friction", ",\nfriction"), fontsize=8.5)
