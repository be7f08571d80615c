"""The rough body's surface under load."""

import numpy as np

from analytic.grid import HatGrid
from comparisons.models.level import Level
from comparisons.models.problem import Problem


def mean_height(problem: Problem, grid: HatGrid) -> np.ndarray:
    """Heights (n,) [m] of the rough body's surface without load, averaged over each hat."""
    if problem.scene.profile is None:
        return np.zeros(grid.count)
    return grid.hat_integrals(problem.scene.profile.spline(), problem.knots) / grid.weights


def deformed_height(problem: Problem, level: Level) -> np.ndarray:
    """Heights (n,) [m] of the rough body's surface under load, averaged over each hat.

    Zero displacement at the mean of the grid's two ends: a datum that both models have.
    """
    height = mean_height(problem, level.grid)
    ends = level.displacement[[0, -1]].mean()
    return height - (level.displacement - ends)
