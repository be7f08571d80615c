"""Both bodies' surfaces under load, on one datum, for the pictures."""

from dataclasses import dataclass

import numpy as np

from comparisons.level import Level
from comparisons.problem import Problem
from comparisons.write import deformed_height


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
        ground = grid.average(scene.profile.spline(), problem.knots) / grid.weights
    parabola = grid.x**2 / (2.0 * scene.roller_radius)
    body = deformed_height(problem, level)
    return Surfaces(
        x=grid.x,
        body=body,
        roller=body + level.solution.gap,
        ground=ground,
        parabola=parabola + np.max(ground - parabola),
    )
