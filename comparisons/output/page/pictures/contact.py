"""Pressures and surfaces of a contact, in the manner of Bailey and Sayles (1991), figure 1.

From the top, over the same x: pressures of all models over the Hertz curve, the half-plane's
difference from the whole model, the deformed surfaces; once over the whole contact, once around the
highest peak or the edge, where the nodes of the piecewise-linear pressures can be seen. Besides,
both bodies' surfaces before and under load on one datum, and the gap between them.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import Scale, scale_of, significant, with_unit
from comparisons.drawing import style
from comparisons.drawing.curves import COINCIDE, FOOT, distinct, draw, over, panels
from comparisons.drawing.field import SMALLEST_POWER
from comparisons.figures.quantity import LABELS
from comparisons.judging.contact import closed, draw_pressures, peak_position, seen
from comparisons.judging.study import Run
from comparisons.models.level import deformed_height
from comparisons.models.problem import mean_height

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

TOP, BETWEEN = 0.24, 0.16  # inches above the panels
ROOM = 0.05  # beside the contact, of half of it
FARTHEST_CAP = 2.0  # peak pressures: a hardness beyond would only flatten the curves
CLOSE_HATS = 14  # pressure elements to either side in the close-up, at least
CLOSE_REACH = 0.1  # half-widths to either side, at most
TICKS, STEPS = 7, (1, 2, 2.5, 5, 10)  # of x/a: how many at most, and how far apart, by tens
CLEAR = 0.04  # share of that axis at either end without one
UNSEEN = 0.01  # share of it that is too narrow to be seen
POINTS_PER_INCH = 90  # of an outline across a panel


def pressure_picture(run: Run) -> style.Picture:
    """Pressures and surfaces over the whole contact."""
    levels, hertz = run.levels(run.deciding_friction), run.problem.hertz
    [*_, last] = levels.values()
    difference = " − ".join(LABELS[name] for name in run.pair(run.deciding_friction))
    middle = f", their difference ({difference})," if len(run.runs) > 1 else ""
    low, high = seen(run, ROOM)
    across = min(last.grid.x[0], low), max(last.grid.x[-1], high)
    short = np.ptp(last.grid.x) < (1.0 - UNSEEN) * (across[1] - across[0])
    peaks = ", ".join(
        f"{LABELS[name]} "
        f"{significant(level.solution.pressure.max() / hertz.peak_pressure)} p₀ at x = "
        f"{with_unit(peak_position(level), 'm')}"
        for name, level in levels.items()
    )
    return style.picture(
        _drawn(run, across, style.WIDE, 5.2),
        f"Contact pressure over x above the deformed surfaces. Largest: {peaks}.",
        f"Contact pressure over Hertz's peak pressure p₀{middle} and the surfaces under load. "
        f"Largest pressure: {peaks}. "
        "Heights are stretched and known but for a constant; in contact both surfaces coincide."
        f"{' They are drawn where contact was sought.' if short else ''}",
    )


def close_up_picture(run: Run) -> style.Picture:
    """Pressures and surfaces about the highest pressure; of a smooth body, about an edge."""
    levels = run.levels(run.deciding_friction)
    name, level = list(levels.items())[-1]
    pitch = level.grid.pitch
    if run.problem.scene.profile is None:
        centre, reach, place = level.patches[-1, 1], CLOSE_HATS * pitch, "the right-hand edge"
    else:
        centre, place = peak_position(level), "the highest peak"
        holding = (level.patches[:, 0] <= centre) & (level.patches[:, 1] >= centre)
        most = max(CLOSE_REACH * run.problem.hertz.half_width, CLOSE_HATS * pitch)
        reach = np.clip(0.75 * np.ptp(level.patches[holding]), CLOSE_HATS * pitch, most)
        first = next(iter(levels.values()))
        reach += min(abs(peak_position(first) - centre), most)  # the same peak, beside it
    at = f"x = {with_unit(float(centre), 'm')}"
    across = max(centre - reach, level.grid.x[0]), min(centre + reach, level.grid.x[-1])
    drawn = _drawn(run, across, style.COLUMN, 5.6, nodes=True)
    return style.picture(
        drawn,
        f"Pressures of the models around {place}, {at}.",
        f"Around {place}, {at}: the pressures are piecewise linear between nodes "
        f"{with_unit(pitch, 'm', 3)} apart ({LABELS[name]}).",
    )


def _drawn(
    run: Run, across: tuple[float, float], width: float, height: float, nodes: bool = False
) -> "Figure":
    """The stack over x, with x/a along the top."""
    shares = (0.50, 0.13, 0.37) if len(run.runs) > 1 else (0.58, 0.42)
    room = height - FOOT - TOP - BETWEEN * (len(shares) - 1)
    rows = [(BETWEEN if k else TOP, share * room) for k, share in enumerate(shares)]
    drawn, axes = panels(width, rows)
    unit = scale_of(np.abs(across), "m")
    draw_stack(axes, run, across, unit, nodes)
    over(axes, f"x [{unit.name}]", [end / unit.factor for end in across])
    _second_axis(axes[0], run.problem.hertz.half_width / unit.factor)
    return drawn


def draw_stack(
    axes: Sequence["Axes"], run: Run, across: tuple[float, float], unit: Scale, nodes: bool = False
) -> None:
    """Pressures, their difference where there are two models, and surfaces, on the first of the
    axes; over `across` [m], x in `unit`."""
    draw_pressures(axes[0], run, across, unit, nodes)
    _cap_and_legend(axes[0], run)
    if len(run.runs) > 1:
        draw_difference(axes[1], run, across, unit)
    draw_surfaces(axes[1 + (len(run.runs) > 1)], run, across, unit)


def _second_axis(axes: "Axes", half_width: float) -> None:
    """x/a along the top."""
    from matplotlib.ticker import MaxNLocator

    top = axes.secondary_xaxis(
        "top", functions=(lambda x: x / half_width, lambda s: s * half_width)
    )
    top.tick_params(pad=1.5)
    top.xaxis.set_label_coords(0.5, 1.0)  # else numbers are measured for a label that it has not
    # at the ends a number would be cut, or stand on the axis' name
    low, high = (x / half_width for x in axes.get_xlim())
    ticks = MaxNLocator(TICKS, steps=STEPS).tick_values(low, high)
    end = CLEAR * (high - low)
    top.set_ticks(ticks[(ticks >= low + end) & (ticks <= high - end)])
    axes.annotate("x/a", (0.0, 1.0), (-22, 6), "axes fraction", "offset points", ha="right")


def _cap_and_legend(axes: "Axes", run: Run) -> None:
    """The hardness, if it is near; the lines' names above the curves, in two rows if narrow."""
    hardness, p0 = run.problem.scene.body.hardness, run.problem.hertz.peak_pressure
    levels = run.levels(run.deciding_friction)
    peak = max(level.solution.pressure.max() for level in levels.values())
    if hardness is not None and hardness < FARTHEST_CAP * peak:
        look = {"color": "#777777", "linestyle": "-.", "linewidth": 0.9}
        axes.axhline(hardness / p0, label="hardness", **look)
    names = len(axes.get_legend_handles_labels()[1])
    if axes.figure.get_figwidth() < 0.75 * style.WIDE:
        rows = -(-names // 2)
        side, corner, room = "upper left", (0.008, 0.91), 1.22 + 0.12 * rows
        columns = -(-names // rows)
    else:
        side, corner, room, columns = "upper right", (0.996, 0.97), 1.19, names
    axes.set_ylim(0.0, room * axes.dataLim.y1)
    gaps = {"borderaxespad": 0.1, "columnspacing": 1.0, "handlelength": 2.0, "handletextpad": 0.5}
    gaps |= style.BEHIND_LEGEND
    axes.legend(loc=side, bbox_to_anchor=corner, ncols=columns, **gaps)


def draw_difference(axes: "Axes", run: Run, across: tuple[float, float], unit: Scale) -> None:
    """Pressures of the half-plane less those of the whole model, or of the finite elements where
    there is no other, on the same pressure elements; over `across` [m], x in `unit`."""
    one, other = run.pair(run.deciding_friction).values()
    x, reference = closed(other)
    difference = np.interp(x, *closed(one)) - reference
    difference /= run.problem.hertz.peak_pressure
    shown = style.near(x, across, other.grid.pitch)
    power, name = 0, "Δp/p₀"
    largest = np.max(np.abs(difference[shown]), initial=0.0)
    if 0.0 < largest < 10.0**SMALLEST_POWER:
        power = -int(np.floor(np.log10(largest)))
        name = f"{style.power_of_ten(power)} {name}"
    axes.plot(x[shown] / unit.factor, difference[shown] * 10.0**power, **style.DIFFERENCE)
    reach = 1.25 * (largest * 10.0**power or 1.0)
    axes.set_ylim(-reach, reach)
    axes.locator_params(axis="y", nbins=3)
    axes.set_ylabel(name)


def draw_surfaces(
    axes: "Axes", run: Run, across: tuple[float, float], unit: Scale
) -> tuple[float, Scale]:
    """Every model's surfaces under load over `across` [m], x in `unit`; filled as the last's. The
    height [m] that is drawn as 0, and the unit of the others."""
    drawn: dict[str, tuple[np.ndarray, ...]] = {}
    for name, level in reversed(run.levels(run.deciding_friction).items()):
        shown = style.near(level.grid.x, across, level.grid.pitch)
        x, body = level.grid.x[shown], deformed_height(run.problem, level)[shown]
        if drawn:
            # displacements are known but for a constant: laid on each other at their mean
            place, height, _ = next(iter(drawn.values()))
            body = body + np.mean(np.interp(x, place, height) - body)
        drawn[name] = x, body, body + level.solution.gap[shown]
    x, body, roller = next(iter(drawn.values()))
    low, high = body.min(), roller.max()
    # a flat contact enlarged is no picture of its rounding
    least = COINCIDE * np.ptp(deformed_height(run.problem, level))
    middle, span = 0.5 * (low + high), max(high - low, least) or 1.0
    low, high = middle - 0.9 * span, middle + 0.9 * span
    up = scale_of([high - low], "m")

    def scaled(height: np.ndarray) -> np.ndarray:
        return height / up.factor - middle / up.factor

    few = slice(None, None, 1 + len(x) // int(POINTS_PER_INCH * axes.figure.get_figwidth()))
    x = x[few] / unit.factor
    style.fill_bodies(axes, x, scaled(body[few]), scaled(roller[few]), scaled(low), scaled(high))
    for surface in (1, 0):
        curves = {name: (drawn[name][0], drawn[name][1 + surface]) for name in reversed(drawn)}
        for names, (place, heights) in distinct(curves, least).items():
            look = style.LINES[names[0]] if len(drawn) > 1 else style.OUTLINE
            line = {**look, "linewidth": 0.7 * look["linewidth"]}
            axes.plot(place / unit.factor, scaled(heights), **line)
    # names where something is drawn: a light load may touch a rough body beside the middle only
    first, last = np.clip(x[[0, -1]], *(end / unit.factor for end in across))
    names = {"transform": axes.get_xaxis_transform(), "clip_on": True}
    pressing = run.problem.scene.smooth_body
    axes.text(0.5 * (first + last), 0.95, pressing, ha="center", va="top", **names)
    axes.text(first + 0.01 * (last - first), 0.05, "body", va="bottom", **names)
    axes.set_ylabel(f"height [{up.name}]")
    return middle, up


def surface_picture(run: Run) -> style.Picture:
    """Surfaces before and under load; below, the gaps. Heights are means over pressure elements;
    the body's displacement vanishes at the mean of both ends."""
    problem, levels = run.problem, run.levels(run.deciding_friction)
    name, level = list(levels.items())[-1]
    x, body = level.grid.x, mean_height(problem, level.grid)
    parabola = x**2 / (2.0 * problem.scene.roller.radius)
    roller = parabola + np.max(body - parabola)  # at first touch
    drawn, (above, below) = panels(style.COLUMN, [(0.22, 3.08), (0.28, 1.51)], 0.7, 0.14, foot=0.51)
    along = scale_of(x, "m")
    place, (middle, up) = x / along.factor, draw_surfaces(above, run, (x[0], x[-1]), along)
    for heights, words in ((body, None), (roller, "before loading, at first touch")):
        thin = {**style.REFERENCE, "linewidth": 0.8}
        above.plot(place, (heights - middle) / up.factor, label=words, **thin)
    above.legend(loc="lower right", borderaxespad=0.2)
    gaps = {model: np.maximum(shown.solution.gap, 0.0) for model, shown in levels.items()}
    unit = scale_of([np.max(gap) for gap in gaps.values()], "m")
    curves = {m: (levels[m].grid.x / along.factor, gap / unit.factor) for m, gap in gaps.items()}
    draw(below, curves)
    over((above, below), f"x [{along.name}]", place)
    below.set_ylabel(f"gap [{unit.name}]")
    below.set_ylim(0.0, 1.3 * below.dataLim.y1)  # names stand above the curves
    below.legend(loc="upper center", ncols=3, columnspacing=1.0, borderaxespad=0.1)
    approach = with_unit(float(np.max(body - deformed_height(problem, level))), "m", 3)
    pressing = problem.scene.smooth_body
    return style.picture(
        drawn,
        f"Surfaces of {pressing} and body before and under load, and the gap between them; the "
        f"body's surface gives way by {approach}.",
        f"Surfaces before and under load ({LABELS[name]}), heights stretched, and the gap "
        f"that is left. The body's surface sinks by up to {approach} against the ends of the "
        f"stretch that is drawn; the {pressing} is set on it.",
    )
