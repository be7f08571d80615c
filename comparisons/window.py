"""The points on which the stress fields of both models and of all levels are compared."""

import numpy as np

from analytic.stress_field import graded_depths
from comparisons.level import Window
from comparisons.problem import Problem

FIRST_DEPTH = 0.25  # of the third level's pitch: the layer next to the surface


def window_of(problem: Problem) -> Window:
    """Every pressure element of the coarsest level, or an even division of it, by graded depths.

    The spacing in x is the pitch of the coarsest level times or over a power of two, next to the
    one asked for, so that the grid belongs to every level's own and no field is interpolated.
    """
    wanted = problem.scene.stress
    half_width = problem.hertz.half_width
    half_range = wanted.half_range.metres(half_width)
    depth = wanted.depth.metres(half_width)
    if problem.scene.width is not None:
        half_range = min(half_range, 0.5 * problem.scene.width)
    if problem.scene.thickness is not None:
        depth = min(depth, problem.scene.thickness)
    columns, rows = wanted.points
    coarsest = problem.pitches[0]
    power = round(np.log2(2.0 * half_range / (columns - 1) / coarsest))
    spacing = coarsest * 2.0**power
    last = int(np.floor(half_range / spacing * (1.0 + 1e-12)))
    x = np.arange(-last, last + 1) * spacing
    return Window(x, graded_depths(depth, rows, FIRST_DEPTH * problem.pitches[-1]))
