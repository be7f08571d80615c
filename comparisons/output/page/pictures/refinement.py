"""How the solution was refined: errors of the judged figures over the size of the elements, each
beside its formal order."""

import math
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import plain
from comparisons.drawing import style
from comparisons.drawing.curves import columns, joint_legend
from comparisons.figures.figure import grouped
from comparisons.figures.quantity import LABELS
from comparisons.judging.study import Run
from comparisons.output.page.tables.verification import DIFFERENCE, JudgedSequence, judged_sequences

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ABREAST = 4  # panels across a wide page
HEAD, TITLE, TALL, FOOT = 0.34, 0.36, 1.5, 0.5  # inches: legend, a panel's title, panel, its axis
LEFT, BETWEEN = 0.62, 0.5  # inches
LEAST = 1e-9  # relative: what is nearer to the extrapolated value is rounding
# The difference is often the finite elements' error alone: pale around their line.
LOOKS = style.LINES | {DIFFERENCE: {**style.PALE, "color": style.DIFFERENCE["color"]}}
NAMES = LABELS | {DIFFERENCE: "difference of both models"}
SLOPES = {1.0: (0, (1, 1.3)), 2.0: (0, (6, 2))}  # lines by order


def convergence_picture(run: Run) -> style.Picture | None:
    """A panel for each judged figure; None where nothing is judged on several levels."""
    known = [s for s in judged_sequences(run) if len(s.figure.levels) > 2]
    panels = grouped(known, lambda sequence: sequence.name)
    if not panels:
        return None
    said = "; ".join(f"{s.name}, {NAMES[s.source]}: {s.known.behaviour}" for s in known)
    return style.picture(
        _drawn(panels),
        f"Error over element size of each judged figure. {said}.",
        "Distance from the extrapolated value over the size of the pressure elements, both "
        "logarithmic; without marks, the formal order. A bar: the stated uncertainty of "
        "discretisation on the finest level. Where three levels show an order, their distances "
        "lie on its line by construction.",
    )


def _drawn(panels: list[list[JudgedSequence]]) -> "Figure":
    abreast = -(-len(panels) // -(-len(panels) // ABREAST))  # rows of about equal lengths
    heights = [(TITLE + (FOOT if row else HEAD), TALL) for row in range(-(-len(panels) // abreast))]
    drawn = style.figure(style.WIDE, sum(map(sum, heights)) + FOOT)
    sides = columns(drawn, heights, len(panels), abreast, LEFT, BETWEEN, BETWEEN)
    for number, panel in enumerate(panels):
        axes = sides[number % abreast][number // abreast]
        _draw(axes, panel)
        if number % abreast == 0:
            axes.set_ylabel("error [%]")
        if number + abreast >= len(panels):
            axes.set_xlabel("pressure elements [µm]")
    joint_legend(drawn, columnspacing=1.6, borderaxespad=0.2)
    return drawn


def _draw(axes: "Axes", panel: list[JudgedSequence]) -> None:
    """All models' errors of one figure [%] over the pitch [µm]."""
    largest = 0.0, 0.0
    for sequence in panel:
        pitch, error = 1e6 * np.array(sequence.pitches), 100.0 * np.array(sequence.errors)
        seen = np.where(error > 100.0 * LEAST, error, np.nan)
        look, name = LOOKS[sequence.source], NAMES[sequence.source]
        axes.plot(pitch, seen, marker="o", markersize=3.5, label=name, **look)
        bar = {**look, "linestyle": "none", "marker": "_", "markersize": 13}
        stated = 100.0 * sequence.figure.uncertainty.parts["discretisation"]
        if np.isfinite(stated) and stated > 0.0:
            axes.plot(pitch[-1], stated, markeredgewidth=1.3 * look["linewidth"], **bar)
        if np.isfinite(seen).any():
            largest = max(largest, (float(np.nanmax(seen)), float(pitch[np.nanargmax(seen)])))
    order = panel[0].known.formal_order
    pitch = 1e6 * np.array([max(panel[0].pitches), min(panel[0].pitches)])
    if largest[0] > 0.0:
        slope = largest[0] * (pitch / largest[1]) ** order
        look = {**style.REFERENCE, "linestyle": SLOPES.get(order, "-.")}
        axes.plot(pitch, slope, label=f"slope of order {plain(order)}", **look)
    axes.set_xscale("log")
    if any(np.nanmax(line.get_ydata(), initial=0.0) > 0.0 for line in axes.lines):
        axes.set_yscale("log")
        low, high = np.log10(axes.get_ylim())
        if np.floor(high) - np.ceil(low) >= 1.0:  # two powers of ten are in view
            axes.yaxis.set_major_formatter(
                lambda value, place: style.power_of_ten(round(math.log10(value)))
            )
        else:
            ticks = np.outer(10.0 ** np.arange(np.floor(low), high), [1.0, 2.0, 5.0]).ravel()
            ticks = ticks[(ticks >= 10.0**low) & (ticks <= 10.0**high)]
            axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    else:
        axes.set_yticks([])
        axes.annotate("no change but rounding", (0.5, 0.5), xycoords="axes fraction", ha="center")
    ticks = sorted({1e6 * pitch for sequence in panel for pitch in sequence.pitches})
    axes.set_xticks(ticks, [f"{tick:.3g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlim(0.8 * ticks[0], 1.25 * ticks[-1])
    axes.set_title(panel[0].name.replace(", friction", ",\nfriction"))
