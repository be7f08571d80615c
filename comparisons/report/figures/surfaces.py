"""Both surfaces before and under load, and the gap that is left between them."""

import numpy as np

from comparisons.common.model_names import LABELS
from comparisons.common.numbers import scale_of, with_unit
from comparisons.report.figures.style import (
    BODY,
    COLUMN,
    LINES,
    OUTLINE,
    REFERENCE,
    ROLLER,
    Picture,
    data_uri,
    figure,
)
from comparisons.report.figures.surfaces_under_load import surfaces_of
from comparisons.results.outcome import Outcome

MOST_POINTS = 600  # of a filled outline


def surface_picture(outcome: Outcome) -> Picture:
    """Surfaces of the last model before and under load; below, the gaps of all."""
    name, run = list(outcome.runs.items())[-1]
    found = surfaces_of(outcome.problem, run.finest)
    x_unit = scale_of(found.x, "m")
    unit = scale_of([np.ptp(found.roller), np.ptp(found.body)], "m")
    drawn = figure(COLUMN, 5.6)
    axes = drawn.add_axes((0.125, 0.41, 0.85, 0.55))
    few = slice(None, None, 1 + len(found.x) // MOST_POINTS)
    x = found.x / x_unit.factor
    low = min(found.body.min(), found.ground.min())
    high = max(found.roller.max(), found.parabola.max())
    low, high = (low - 0.2 * (high - low)) / unit.factor, high / unit.factor
    axes.fill_between(x[few], low, found.body[few] / unit.factor, **BODY)
    axes.fill_between(x[few], found.roller[few] / unit.factor, high, **ROLLER)
    for under, before, label in (
        (found.body, found.ground, None),
        (found.roller, found.parabola, "before loading, at first touch"),
    ):
        axes.plot(x, before / unit.factor, label=label, **{**REFERENCE, "linewidth": 0.8})
        axes.plot(x, under / unit.factor, label=label and "under load", **OUTLINE)
    axes.set(xlim=(x[0], x[-1]), ylim=(low, high), ylabel=f"height [{unit.name}]")
    axes.text(0.02, 0.04, "body", transform=axes.transAxes)
    axes.text(0.5, 0.95, "roller", transform=axes.transAxes, ha="center", va="top")
    axes.legend(loc="lower right", borderaxespad=0.2)
    axes.tick_params(labelbottom=False)
    axes.grid(False)
    below = drawn.add_axes((0.125, 0.09, 0.85, 0.27), sharex=axes)
    gaps = {key: np.maximum(r.finest.solution.gap, 0.0) for key, r in outcome.runs.items()}
    gap_unit = scale_of([np.max(gap) for gap in gaps.values()], "m")
    for key, gap in gaps.items():
        place = outcome.runs[key].finest.grid.x / x_unit.factor
        below.plot(place, gap / gap_unit.factor, label=LABELS[key], **LINES[key])
    below.set(xlabel=f"x [{x_unit.name}]", ylabel=f"gap [{gap_unit.name}]")
    below.set_ylim(bottom=0.0)
    below.legend(loc="upper center")
    approach = with_unit(float(np.max(found.ground - found.body)), "m", 3)
    return Picture(
        source=data_uri(drawn),
        alternative=(
            "Surfaces of roller and body before and under load, and the gap between them; the "
            f"body's surface gives way by {approach}."
        ),
        caption=(
            f"Surfaces before and under load ({LABELS[name]}), heights stretched, and the gap "
            f"that is left. The body's surface sinks by up to {approach} against the ends of the "
            "stretch that is drawn; the roller is set on it."
        ),
    )
