"""Pressures over the profile, in the manner of Bailey and Sayles (1991), figure 1.

From the top, over the same x: pressures of all models over the Hertz curve, the half-plane's
difference from the whole model, the deformed surfaces; once over the whole contact, once around the
highest peak or the edge, where the nodes of the piecewise-linear pressures can be seen.
"""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import Scale, percent, plain, scale_of, significant, with_unit
from comparisons.drawing import style
from comparisons.drawing.curves import FOOT, LEFT, over
from comparisons.figures.quantity import LABELS, WHOLE
from comparisons.models.level import Level
from comparisons.output.page.pictures.surfaces import draw_surfaces
from comparisons.studies.contact import closed, draw_pressures, peak_position
from comparisons.studies.model_error.show import moved_text
from comparisons.studies.study import MODEL_ERROR, Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

TOP, BETWEEN = 0.24, 0.16  # inches above the panels
FARTHEST_CAP = 2.0  # peak pressures: a hardness beyond would only flatten the curves
CLOSE_HATS = 14  # pressure elements to either side in the close-up, at least
CLOSE_REACH = 0.1  # half-widths to either side, at most
TICKS, STEPS = 7, (1, 2, 2.5, 5, 10)  # of x/a: how many at most, and how far apart, by tens
CLEAR = 0.04  # share of that axis at either end without one


def shown_levels(outcome: Run) -> dict[str, Level]:
    """Every model's finest level, at the friction coefficient that decides."""
    return outcome.levels(outcome.deciding_friction)


def reference_level(outcome: Run) -> Level:
    """The whole model's, the finite elements', or that of the only model."""
    return list(shown_levels(outcome).values())[-1]


def pressure_picture(outcome: Run) -> style.Picture:
    """The whole contact."""
    x, hertz = reference_level(outcome).grid.x, outcome.problem.hertz
    difference = " − ".join(LABELS[name] for name in outcome.pair(outcome.deciding_friction))
    middle = f", their difference ({difference})," if len(outcome.runs) > 1 else ""
    beyond = 1.05 * hertz.half_width
    across = min(x[0], -beyond), max(x[-1], beyond)
    peaks = ", ".join(
        f"{LABELS[name]} "
        f"{significant(level.solution.pressure.max() / hertz.peak_pressure)} p₀ at x = "
        f"{with_unit(peak_position(level), 'm')}"
        for name, level in shown_levels(outcome).items()
    )
    return style.picture(
        lambda width: _drawn(outcome, across, width, 5.2),
        f"Contact pressure over x above the deformed surfaces. Largest: {peaks}.",
        f"Contact pressure over Hertz's peak pressure p₀{middle} and the surfaces under load. "
        f"Largest pressure: {peaks}. {_norm(outcome)}"
        "Heights are stretched and known but for a constant; in contact both surfaces coincide.",
    )


def close_up_picture(outcome: Run) -> style.Picture:
    """Around the highest pressure; of a smooth body, around the contact's edge."""
    level = reference_level(outcome)
    pitch = level.grid.pitch
    if outcome.problem.scene.profile is None:
        centre, reach, place = level.patches[-1, 1], CLOSE_HATS * pitch, "the right-hand edge"
    else:
        centre, place = peak_position(level), "the highest peak"
        holding = (level.patches[:, 0] <= centre) & (level.patches[:, 1] >= centre)
        most = max(CLOSE_REACH * outcome.problem.hertz.half_width, CLOSE_HATS * pitch)
        reach = np.clip(0.75 * np.ptp(level.patches[holding]), CLOSE_HATS * pitch, most)
        first = next(iter(shown_levels(outcome).values()))
        reach += min(abs(peak_position(first) - centre), most)  # the same peak, beside it
    at = f"x = {with_unit(float(centre), 'm')}"
    across = (centre - reach, centre + reach)
    drawn = _drawn(outcome, across, style.COLUMN, 5.6, nodes=True)
    caption = (
        f"Around {place}, {at}: the pressures are piecewise linear between the marked nodes, "
        f"{with_unit(pitch, 'm', 3)} apart ({LABELS[list(shown_levels(outcome))[-1]]})."
    )
    return style.picture(drawn, f"Pressures of the models around {place}, {at}.", caption)


def _norm(outcome: Run) -> str:
    """How far the half-plane's pressures are from the finite elements', and the whole model's."""
    friction = outcome.deciding_friction
    known = outcome.figures.of(quantity="pressure_l2", friction=friction)
    difference, error = known.one(study="comparison"), known.one(study=MODEL_ERROR)
    if error is None:
        return ""
    sizes = [percent(difference.value, uncertainty=difference.numerical)]
    if WHOLE in shown_levels(outcome):
        sizes.append(percent(error.value, uncertainty=error.numerical))
    names = list(shown_levels(outcome))[1:]
    said = " and ".join(
        f"{size} from the {LABELS[name]}" for size, name in zip(sizes, names, strict=True)
    )
    left = "".join(f" ({text} on average)" for text in moved_text(outcome, friction))
    at = f" at friction {plain(friction)}" if len(outcome.problem.scene.load.friction) > 1 else ""
    return f"The half-plane's pressures differ by {said}{left}{at} (relative L2 norms). "


def _drawn(
    outcome: Run, across: tuple[float, float], width: float, height: float, nodes: bool = False
) -> "Figure":
    """Pressures, their difference where there are two models, and surfaces."""
    comparing = len(outcome.runs) > 1
    shares = (0.50, 0.13, 0.37) if comparing else (0.58, 0.42)
    room = height - FOOT - TOP - BETWEEN * (len(shares) - 1)
    above = (TOP, *[BETWEEN] * (len(shares) - 1))
    rows = [(space, share * room) for space, share in zip(above, shares, strict=True)]
    drawn = style.figure(width, height)
    axes = style.stacked(drawn, rows, LEFT)
    unit = scale_of(np.abs(across), "m")
    draw_pressures(axes[0], outcome, across, unit, nodes)
    _cap_and_legend(axes[0], outcome)
    if comparing:
        draw_difference(axes[1], outcome, across, unit)
    draw_surfaces(axes[-1], outcome, across, unit)
    over(axes, f"x [{unit.name}]", [end / unit.factor for end in across])
    _second_axis(axes[0], outcome.problem.hertz.half_width / unit.factor)
    return drawn


def _second_axis(axes: "Axes", half_width: float) -> None:
    """x/a along the top."""
    from matplotlib.ticker import MaxNLocator

    top = axes.secondary_xaxis(
        "top", functions=(lambda x: x / half_width, lambda s: s * half_width)
    )
    top.tick_params(pad=1.5)
    # at the ends a number would be cut, or stand on the axis' name
    low, high = (x / half_width for x in axes.get_xlim())
    ticks = MaxNLocator(TICKS, steps=STEPS).tick_values(low, high)
    end = CLEAR * (high - low)
    top.set_ticks(ticks[(ticks >= low + end) & (ticks <= high - end)])
    axes.annotate("x/a", (0.0, 1.0), (-22, 4), "axes fraction", "offset points", ha="right")


def _cap_and_legend(axes: "Axes", outcome: Run) -> None:
    """The hardness, if it is near; the lines' names above the curves, in two rows if narrow."""
    hardness, p0 = outcome.problem.scene.body.hardness, outcome.problem.hertz.peak_pressure
    peak = max(level.solution.pressure.max() for level in shown_levels(outcome).values())
    if hardness is not None and hardness < FARTHEST_CAP * peak:
        look = {"color": "#777777", "linestyle": "-.", "linewidth": 0.9}
        axes.axhline(hardness / p0, label="hardness", **look)
    names = len(axes.get_legend_handles_labels()[1])
    if axes.figure.get_figwidth() < 0.75 * style.WIDE:
        rows = 1 + (len(shown_levels(outcome)) > len(outcome.runs))
        side, corner, room = "upper left", (0.0, 0.91), 1.22 + 0.12 * rows
        columns = -(-names // rows)
    else:
        side, corner, room, columns = "upper right", (1.0, 1.02), 1.17, names
    axes.set_ylim(0.0, room * axes.dataLim.y1)
    gaps = {"borderaxespad": 0.1, "columnspacing": 1.0, "handlelength": 2.0, "handletextpad": 0.5}
    axes.legend(loc=side, bbox_to_anchor=corner, ncols=columns, **gaps)


def draw_difference(axes: "Axes", outcome: Run, across: tuple[float, float], unit: Scale) -> None:
    """Pressures of the half-plane less those of the whole model, or of the finite elements where
    there is no other, on the same pressure elements."""
    one, other = outcome.pair(outcome.deciding_friction).values()
    x, reference = closed(other)
    difference = np.interp(x, *closed(one)) - reference
    difference /= outcome.problem.hertz.peak_pressure
    shown = style.near(x, across, other.grid.pitch)
    axes.plot(x[shown] / unit.factor, difference[shown], **style.DIFFERENCE)
    style.symmetric(axes, difference[shown])
    axes.set_ylabel("Δp/p₀")
