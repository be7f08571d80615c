"""Principal shear over depth on two verticals, after Bailey and Sayles (1991), figure 11."""

from typing import TYPE_CHECKING

import numpy as np

from analytic.exact.hertz import hertz_stress
from comparisons.common.numbers import decimal, plain, significant
from comparisons.drawing import style
from comparisons.figures.quantity import LABELS
from comparisons.output.page.pictures.pressures import reference_level
from comparisons.studies.contact import peak_position
from comparisons.studies.quiescent_zone import NAME as ZONE
from comparisons.studies.quiescent_zone import zones_of
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NEAR = 0.1  # half-widths: depth of the enlarged part of a rough section
TOP, TITLE, TALL, FOOT = 0.24, 0.3, 1.85, 0.46  # inches
LEFT, ROOM, BETWEEN = 0.616, 4.872, 0.28  # inches


def section_pictures(outcome: Run) -> list[style.Picture]:
    """Through the highest pressure and through the edge of the smooth contact; none without field.
    The verticals are the columns of the common window that lie nearest."""
    if outcome.window is None:
        return []
    wanted = {
        "the highest pressure": peak_position(reference_level(outcome)),
        "the edge of the smooth contact, x = +a": outcome.problem.hertz.half_width,
    }
    x = outcome.window.x
    spacing = x[1] - x[0]
    return [
        _picture(outcome, int(np.argmin(np.abs(x - place))), words)
        for words, place in wanted.items()
        if x[0] - spacing <= place <= x[-1] + spacing
    ]


def _picture(outcome: Run, column: int, words: str) -> style.Picture:
    frictions, hertz = outcome.problem.scene.load.friction, outcome.problem.hertz
    drawn = style.figure(style.COLUMN, TOP + FOOT + (TITLE + TALL) * len(frictions))
    depths = [outcome.window.z[-1] / hertz.half_width]
    if outcome.problem.scene.profile is not None and depths[0] > 2.0 * NEAR:
        depths.append(NEAR)
    share = ROOM / len(depths)
    rows = [(TITLE + TOP * (place == 0), TALL) for place in range(len(frictions))]
    columns = []
    for side in range(len(depths)):
        left = LEFT + side * share
        columns.append(style.stacked(drawn, rows, left, style.COLUMN - left - share + BETWEEN))
    for friction, panels in zip(frictions, zip(*columns, strict=True), strict=True):
        for panel, depth in zip(panels, depths, strict=True):
            _section(panel, outcome, column, friction, depth)
            panel.tick_params(labelbottom=friction == frictions[-1], labelleft=panel is panels[0])
        for panel in panels:
            panel.set_ylim(0.0, max(p.dataLim.y1 for p in panels) * 1.08)
        panels[0].set_ylabel("τ₁/p₀")
        panels[0].set_title(f"friction {plain(friction)}")
    for panels in columns:
        panels[-1].set_xlabel("z/a")
    every = [axes.get_legend_handles_labels() for axes in drawn.axes]
    lines, place = max(every, key=lambda known: len(known[1])), (0.985, 1.0)
    room = {"ncols": len(lines[0]), "borderaxespad": 0.1, "columnspacing": 1.2}
    drawn.legend(*lines, loc="upper right", bbox_to_anchor=place, **room)
    at = decimal(outcome.window.x[column] / hertz.half_width)
    largest = "; ".join(
        f"friction {plain(mu)}: "
        + ", ".join(
            f"{LABELS[name]} {significant(np.nanmax(_tau1(outcome, name, mu, column)), 3)} p₀"
            for name in outcome.levels(mu)
        )
        for mu in frictions
    )
    near = f" The right half enlarges the first {NEAR} a." if len(depths) > 1 else ""
    return style.picture(
        drawn,
        f"Principal shear over depth through {words}. Largest: {largest}.",
        f"Principal shear stress τ₁ over depth through {words} (x = {at} a), with the exact "
        f"section of the smooth contact at the same place.{near} Largest: {largest}.",
    )


def _tau1(outcome: Run, name: str, friction: float, column: int) -> np.ndarray:
    field = outcome.levels(friction)[name].stress(friction).field
    return field.tau1[:, column] / outcome.problem.hertz.peak_pressure


def _section(axes: "Axes", outcome: Run, column: int, friction: float, depth: float) -> None:
    hertz = outcome.problem.hertz
    x, z = outcome.window.x[column], outcome.window.z
    shown = z <= 1.000001 * depth * hertz.half_width
    first = next(iter(outcome.runs))
    for name in outcome.levels(friction):
        values = _tau1(outcome, name, friction, column)[shown]
        axes.plot(z[shown] / hertz.half_width, values, label=LABELS[name], **style.LINES[name])
    exact = hertz_stress(hertz, x, z[shown], friction).tau1 / hertz.peak_pressure
    axes.plot(z[shown] / hertz.half_width, exact, label="Hertz, exact", **style.REFERENCE)
    for zone in zones_of(outcome.found.get(ZONE)):
        if (zone.model, zone.friction) == (first, friction) and "start" in zone.figures:
            ends = (zone.figures[name].value / hertz.half_width for name in ("start", "stop"))
            axes.axvspan(*ends, color="#009E73", alpha=0.14, linewidth=0.0, label="quiescent zone")
    axes.set_xlim(0.0, depth)
    axes.locator_params(axis="x", nbins=6)
