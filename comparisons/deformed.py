"""The rough body's surface under load."""

import numpy as np

from comparisons.level import Level
from comparisons.problem import Problem


def deformed_height(problem: Problem, level: Level) -> np.ndarray:
    """Heights (n,) [m] of the rough body's surface under load, averaged over each hat.

    Zero displacement at the mean of the grid's two ends: a datum that both models have.
    """
    height = np.zeros(level.grid.count)
    if problem.scene.profile is not None:
        height = level.grid.average(problem.scene.profile.spline(), problem.knots)
        height = height / level.grid.weights
    ends = level.displacement[[0, -1]].mean()
    return height - (level.displacement - ends)
