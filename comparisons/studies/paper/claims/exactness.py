"""Errors of computed normal stresses against exact ones, in p0: the numbers that judge figure 5."""

from collections.abc import Callable

import numpy as np

from analytic.exact.hertz import hertz_stress
from analytic.stress.points import stress_at
from analytic.stress.potential import Element
from analytic.stress_state import StressState
from comparisons.studies.paper.claims.readings import SLIDING
from comparisons.studies.paper.claims.views import Reading, View

ACROSS = np.array([0.0, 0.25, 0.48, 0.5, 0.52, 0.75])  # elements: both sides of their edges, too
SHALLOWEST = 0.02  # sampling intervals: depth from which the sum of elements is looked at
EDGE = 0.9  # a: farther out the elements' own edge of the contact shows


def root_mean_square(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def axis_error(view: View) -> float:
    """Largest error of sx and sz on the axis, anywhere down to the window's end [p0]."""
    return _axis_error(view, np.inf)


def error_below_sampling(view: View) -> float:
    """Largest error of sx and sz on the axis, at depths less than one pressure element [p0].

    The half-plane's by uniform strips, which the paper sums.
    """
    if view.model == "half_plane":
        z, hertz = _below(view.level.grid.pitch), view.problem.hertz
        strips = stress_at(view.level.grid.x, view.level.solution.pressure, 0.0, 0.0, z, "strip")
        return float(np.max(_normal_errors(view, strips, hertz_stress(hertz, 0.0, z))))
    return _axis_error(view, view.level.grid.pitch / view.problem.hertz.half_width)


def error_on_rough_ground(
    element: Element, size: Callable[[np.ndarray], float] = root_mean_square
) -> Reading:
    """Error of sx and sz at depths less than a sampling interval of the trace, sliding [p0].

    Of the sum over elements one sampling interval wide, all across them, against the level's own,
    finer pressures joined linearly.
    size  of the errors (2, m, k), as one number
    """

    def reading(view: View) -> float:
        grid, pressure, scene = view.level.grid, view.level.solution.pressure, view.problem.scene
        coarser = max(1, round(scene.profile_info.spacing / grid.pitch))
        nodes = slice(grid.count // 2 % coarser, None, coarser)
        pitch, reach = coarser * grid.pitch, EDGE * view.problem.hertz.half_width
        x = grid.x[nodes]
        places = (x[:, None] + pitch * ACROSS).ravel()
        places = places[np.abs(places) <= reach]
        z = _below(pitch)
        found = stress_at(x, pressure[nodes], SLIDING, places, z, element)
        reference = stress_at(grid.x, pressure, SLIDING, places, z)
        return float(size(_normal_errors(view, found, reference)))

    return reading


def _below(pitch: float) -> np.ndarray:
    """Depths (8, 1) [m] less than a pitch [m]."""
    return np.geomspace(SHALLOWEST, 1.0, 8)[:, None] * pitch


def _normal_errors(view: View, found: StressState, reference: StressState) -> np.ndarray:
    """Amounts (2, ...) [p0] by which sx and sz of two stresses [Pa] differ."""
    errors = np.abs([found.sx - reference.sx, found.sz - reference.sz])
    return errors / view.problem.hertz.peak_pressure


def _axis_error(view: View, depth: float) -> float:
    found, exact = view.stress(0.0), view.smooth(0.0)
    middle, rows = np.argmin(np.abs(view.x)), view.z <= depth
    return float(
        max(
            np.max(np.abs(found.sx - exact.sx)[rows, middle]),
            np.max(np.abs(found.sz - exact.sz)[rows, middle]),
        )
    )
