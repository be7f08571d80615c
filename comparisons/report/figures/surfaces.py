"""Both bodies' surfaces before and under load, on one datum, and the gap between them."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import Scale, scale_of, with_unit
from comparisons.common.quantities import LABELS
from comparisons.models.level import Level, deformed_height
from comparisons.models.problem import Problem
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
from comparisons.results.outcome import Outcome

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Surfaces:
    """Heights [m] on a level's pressure elements, averaged over each; all (n,).

    x                [m]
    body, roller     under load; they coincide in the contact
    ground           the body's before loading
    parabola         the roller's before loading, at first touch
    """

    x: np.ndarray
    body: np.ndarray
    roller: np.ndarray
    ground: np.ndarray
    parabola: np.ndarray


def surfaces_of(problem: Problem, level: Level) -> Surfaces:
    """Surfaces of a solved level; the body's displacement vanishes at the mean of both ends."""
    grid, scene = level.grid, problem.scene
    ground = np.zeros(grid.count)
    if scene.profile is not None:
        ground = grid.hat_integrals(scene.profile.spline(), problem.knots) / grid.weights
    parabola = grid.x**2 / (2.0 * scene.roller_radius)
    body = deformed_height(problem, level)
    return Surfaces(
        x=grid.x,
        body=body,
        roller=body + level.solution.gap,
        ground=ground,
        parabola=parabola + np.max(ground - parabola),
    )


def draw_surfaces(axes: "Axes", outcome: Outcome, across: tuple[float, float], unit: Scale) -> None:
    """Every model's surfaces under load, filled as those of the last model, over `across` [m]."""
    drawn: dict[str, tuple[np.ndarray, ...]] = {}
    for name, run in reversed(outcome.runs.items()):
        found = surfaces_of(outcome.problem, run.finest)
        pitch = run.finest.grid.pitch
        near = (found.x >= across[0] - pitch) & (found.x <= across[1] + pitch)
        x, body, roller = found.x[near], found.body[near], found.roller[near]
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
    base = middle / up.factor
    few = slice(None, None, 1 + len(x) // int(90 * axes.figure.get_figwidth()))
    x, body, roller = (
        x[few] / unit.factor,
        body[few] / up.factor - base,
        roller[few] / up.factor - base,
    )
    low, high = low / up.factor - base, high / up.factor - base
    axes.fill_between(x, low, body, **BODY)
    axes.fill_between(x, roller, high, **ROLLER)
    for name, (place, lower, upper) in reversed(drawn.items()):
        style = LINES[name] if len(drawn) > 1 else OUTLINE
        style = {**style, "linewidth": 0.7 * style["linewidth"]}
        axes.plot(place / unit.factor, upper / up.factor - base, **style)
        axes.plot(place / unit.factor, lower / up.factor - base, **style)
    # where something is drawn: a light load may touch a rough body beside the middle alone
    first, last = np.clip(x[[0, -1]], *(end / unit.factor for end in across))
    names = {"transform": axes.get_xaxis_transform(), "clip_on": True}
    axes.text(0.5 * (first + last), 0.95, "roller", ha="center", va="top", **names)
    axes.text(first + 0.01 * (last - first), 0.05, "body", va="bottom", **names)
    axes.set_ylim(low, high)
    axes.set_ylabel(f"height [{up.name}]")
    axes.grid(False)


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
