"""Refinement of the solution: errors of the judged figures over the size of the elements, each
beside its formal order."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import plain
from comparisons.drawing import curves, style
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import LABELS, QUANTITIES
from comparisons.judging import contact
from comparisons.judging.study import Run
from comparisons.output.page.tables.verification import row_name

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawn

ABREAST = 4  # panels across a wide page
HEAD, TITLE, TALL, FOOT = 0.34, 0.36, 1.5, 0.5  # inches: legend, a panel's title, panel, its axis
LEFT, BETWEEN = 0.62, 0.5  # inches
LEAST = 1e-9  # relative: what is nearer to the extrapolated value is rounding
DIFFERENCE = "difference"  # of both models, in place of one
# The difference is often the finite elements' error alone: pale around their line.
LOOKS = style.LINES | {DIFFERENCE: {**style.PALE, "color": style.DIFFERENCE["color"]}}
NAMES = LABELS | {DIFFERENCE: "difference of both models"}
SLOPES = {1.0: (0, (1, 1.3)), 2.0: (0, (6, 2))}  # lines by order


def judged_figures(run: Run) -> dict[str, list[Figure]]:
    """Figures of the models and of their difference, by quantity and friction coefficient."""
    panels: dict[str, list[Figure]] = {}
    judged = [name for name in QUANTITIES if name in run.problem.scene.tolerances]
    known = [f for f in (*run.figures.of(study=contact.NAME), *run.compared) if f.levels]
    known = [figure for figure in known if figure.quantity in judged]
    for figure in sorted(known, key=lambda f: (judged.index(f.quantity), f.friction)):
        if name := row_name(run, figure.quantity, figure.friction):
            panels.setdefault(name, []).append(figure)
    return panels


def convergence_picture(run: Run) -> style.Picture | None:
    """A panel for each judged figure; None where nothing is judged on several levels."""
    panels = {n: of for n, of in judged_figures(run).items() if len(of[0].levels) > 2}
    if not panels:
        return None
    return style.picture(
        _drawn(run, panels),
        f"Error over element size of each judged figure: {'; '.join(panels)}.",
        "Distance from the extrapolated value over the size of the pressure elements, both "
        "logarithmic; without marks, the formal order. A bar: the stated uncertainty of "
        "discretisation on the finest level. Where three levels show an order, their distances "
        "lie on its line by construction.",
    )


def _drawn(run: Run, panels: dict[str, list[Figure]]) -> "Drawn":
    abreast = -(-len(panels) // -(-len(panels) // ABREAST))  # rows of about equal lengths
    heights = [(TITLE + (FOOT if row else HEAD), TALL) for row in range(-(-len(panels) // abreast))]
    room = LEFT, BETWEEN, FOOT, abreast, BETWEEN, len(panels)
    drawn, places = curves.panels(style.WIDE, heights, *room)
    pitches = np.array([level.grid.pitch for level in next(iter(run.runs.values())).levels])
    for number, (name, figures) in enumerate(panels.items()):
        axes = places[number]
        _draw(axes, figures, 1e6 * pitches)
        axes.set_title(name.replace(", friction", ",\nfriction"))
        if number % abreast == 0:
            axes.set_ylabel("error [%]")
        if number + abreast >= len(panels):
            axes.set_xlabel("pressure elements [µm]")
    curves.joint_legend(drawn, columnspacing=1.6, borderaxespad=0.2)
    return drawn


def _draw(axes: "Axes", figures: list[Figure], pitch: np.ndarray) -> None:
    """All models' errors of one figure [%] over the pitch [µm]."""
    largest = 0.0, 0.0
    for figure in figures:
        known = figure.uncertainty.convergence
        source = DIFFERENCE if figure.against else figure.source
        error = np.abs(np.array(figure.levels) - known.limit)
        error *= 100.0 / (1.0 if figure.against else figure.scale)
        seen = np.where(error > 100.0 * LEAST, error, np.nan)
        look = LOOKS[source]
        axes.plot(pitch, seen, marker="o", markersize=3.5, label=NAMES[source], **look)
        bar = {**look, "linestyle": "none", "marker": "_", "markersize": 13}
        stated = 100.0 * figure.uncertainty.parts["discretisation"]
        if np.isfinite(stated) and stated > 0.0:
            axes.plot(pitch[-1], stated, markeredgewidth=1.3 * look["linewidth"], **bar)
        if np.isfinite(seen).any():
            largest = max(largest, (float(np.nanmax(seen)), float(pitch[np.nanargmax(seen)])))
    if largest[0] > 0.0:
        order = figures[0].uncertainty.convergence.formal_order
        slope = largest[0] * (pitch[[0, -1]] / largest[1]) ** order
        look = {**style.REFERENCE, "linestyle": SLOPES.get(order, "-.")}
        axes.plot(pitch[[0, -1]], slope, label=f"slope of order {plain(order)}", **look)
    axes.set_xscale("log")
    if any(np.nanmax(line.get_ydata(), initial=0.0) > 0.0 for line in axes.lines):
        axes.set_yscale("log")
        low, high = np.log10(axes.get_ylim())
        if np.floor(high) - np.ceil(low) >= 1.0:  # two powers of ten are in view
            axes.yaxis.set_major_formatter(style.in_powers_of_ten)
        else:
            ticks = np.outer(10.0 ** np.arange(np.floor(low), high), [1.0, 2.0, 5.0]).ravel()
            ticks = ticks[(ticks >= 10.0**low) & (ticks <= 10.0**high)]
            axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    else:
        axes.set_yticks([])
        axes.annotate("no change but rounding", (0.5, 0.5), xycoords="axes fraction", ha="center")
    axes.set_xticks(pitch, [f"{size:.3g}" for size in pitch])
    axes.minorticks_off()
    axes.set_xlim(0.8 * pitch[-1], 1.25 * pitch[0])
