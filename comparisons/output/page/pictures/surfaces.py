"""Both bodies' surfaces before and under load, on one datum, and the gap between them."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import Scale, scale_of, with_unit
from comparisons.drawing import style
from comparisons.drawing.curves import over, panels
from comparisons.figures.quantity import LABELS
from comparisons.models.level import Level, deformed_height
from comparisons.models.problem import Problem, mean_height
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_POINTS = 600  # of a filled outline
POINTS_PER_INCH = 90  # of an outline across a panel


@dataclass(frozen=True)
class Surfaces:
    """Heights [m] on a level's pressure elements, averaged over each; all (n,)."""

    x: np.ndarray  # [m]
    # under load; they coincide in the contact
    body: np.ndarray
    roller: np.ndarray
    # before loading, at first touch
    body_before: np.ndarray
    roller_before: np.ndarray


def surfaces_of(problem: Problem, level: Level) -> Surfaces:
    """Surfaces of a solved level; the body's displacement vanishes at the mean of both ends."""
    before = mean_height(problem, level.grid)
    parabola = level.grid.x**2 / (2.0 * problem.scene.roller.radius)
    body = deformed_height(problem, level)
    return Surfaces(
        x=level.grid.x,
        body=body,
        roller=body + level.solution.gap,
        body_before=before,
        roller_before=parabola + np.max(before - parabola),
    )


def surface_picture(outcome: Run) -> style.Picture:
    """Surfaces of the last model before and under load; below, the gaps of all."""
    levels = outcome.levels(outcome.deciding_friction)
    name, level = list(levels.items())[-1]
    found = surfaces_of(outcome.problem, level)
    drawn, both = panels(style.COLUMN, [(0.22, 3.08), (0.28, 1.51)], 0.7, 0.14, foot=0.51)
    axes, below = both
    along, up = scale_of(found.x, "m"), scale_of([np.ptp(found.roller), np.ptp(found.body)], "m")
    low = min(found.body.min(), found.body_before.min())
    high = max(found.roller.max(), found.roller_before.max())
    low -= 0.2 * (high - low)
    few = slice(None, None, 1 + len(found.x) // MOST_POINTS)
    x, body, roller = found.x / along.factor, found.body / up.factor, found.roller / up.factor
    style.fill_bodies(axes, x[few], body[few], roller[few], low / up.factor, high / up.factor)
    for under, before, label in (
        (body, found.body_before, None),
        (roller, found.roller_before, "before loading, at first touch"),
    ):
        axes.plot(x, before / up.factor, label=label, **{**style.REFERENCE, "linewidth": 0.8})
        axes.plot(x, under, label=label and "under load", **style.OUTLINE)
    axes.set_ylabel(f"height [{up.name}]")
    axes.text(0.02, 0.04, "body", transform=axes.transAxes)
    axes.text(0.5, 0.95, "roller", transform=axes.transAxes, ha="center", va="top")
    axes.legend(loc="lower right", borderaxespad=0.2)
    gaps = {key: np.maximum(each.solution.gap, 0.0) for key, each in levels.items()}
    unit = scale_of([np.max(gap) for gap in gaps.values()], "m")
    for key, gap in gaps.items():
        place = levels[key].grid.x / along.factor
        below.plot(place, gap / unit.factor, label=LABELS[key], **style.LINES[key])
    over(both, f"x [{along.name}]", x)
    below.set_ylabel(f"gap [{unit.name}]")
    below.set_ylim(bottom=0.0)
    below.legend(loc="upper center")
    approach = with_unit(float(np.max(found.body_before - found.body)), "m", 3)
    return style.picture(
        drawn,
        "Surfaces of roller and body before and under load, and the gap between them; the "
        f"body's surface gives way by {approach}.",
        f"Surfaces before and under load ({LABELS[name]}), heights stretched, and the gap "
        f"that is left. The body's surface sinks by up to {approach} against the ends of the "
        "stretch that is drawn; the roller is set on it.",
    )


def draw_surfaces(axes: "Axes", outcome: Run, across: tuple[float, float], unit: Scale) -> None:
    """Every model's surfaces under load over `across` [m], x in `unit`; filled as the last's."""
    drawn: dict[str, tuple[np.ndarray, ...]] = {}
    for name, level in reversed(outcome.levels(outcome.deciding_friction).items()):
        found = surfaces_of(outcome.problem, level)
        shown = style.near(found.x, across, level.grid.pitch)
        x, body, roller = found.x[shown], found.body[shown], found.roller[shown]
        if drawn:
            # displacements are known but for a constant: laid on each other at their mean
            place, level, _ = next(iter(drawn.values()))
            shift = np.mean(np.interp(x, place, level) - body)
            body, roller = body + shift, roller + shift
        drawn[name] = x, body, roller
    x, body, roller = next(iter(drawn.values()))
    low, high = body.min(), roller.max()
    middle, high = 0.5 * (low + high), high + 0.25 * (high - low or 1.0)
    low -= 0.35 * (high - low)
    up = scale_of([high - low], "m")

    def scaled(height: np.ndarray) -> np.ndarray:
        return height / up.factor - middle / up.factor

    few = slice(None, None, 1 + len(x) // int(POINTS_PER_INCH * axes.figure.get_figwidth()))
    x = x[few] / unit.factor
    style.fill_bodies(axes, x, scaled(body[few]), scaled(roller[few]), scaled(low), scaled(high))
    for name, (place, *heights) in reversed(drawn.items()):
        look = style.LINES[name] if len(drawn) > 1 else style.OUTLINE
        for height in reversed(heights):
            line = {**look, "linewidth": 0.7 * look["linewidth"]}
            axes.plot(place / unit.factor, scaled(height), **line)
    # names where something is drawn: a light load may touch a rough body beside the middle only
    first, last = np.clip(x[[0, -1]], *(end / unit.factor for end in across))
    names = {"transform": axes.get_xaxis_transform(), "clip_on": True}
    axes.text(0.5 * (first + last), 0.95, "roller", ha="center", va="top", **names)
    axes.text(first + 0.01 * (last - first), 0.05, "body", va="bottom", **names)
    axes.set_ylabel(f"height [{up.name}]")
