"""Both bodies' surfaces under load, on one datum, for the pictures."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import Scale, scale_of
from comparisons.models.deformed import deformed_height
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.report.figures.style import BODY, LINES, OUTLINE, ROLLER
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
