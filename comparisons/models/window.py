"""The points of the stress fields: where models and levels are compared, and searched."""

from dataclasses import dataclass

import numpy as np

from analytic.stress.field import graded_depths
from comparisons.common.errors import SceneError
from comparisons.models.problem import Problem

FIRST_DEPTH = 0.25  # of the third level's pitch: the layer next to the surface
FINEST_SPACING = 1.0 / 16.0  # of the third level's pitch; finer points would show nothing new
MOST_COLUMNS = 2**18  # of the coarsest pitch across a window: where extremes are searched
SEARCH_RATIO = 1.2  # of a depth to the one above it, where extremes are searched


@dataclass(frozen=True)
class Window:
    """Points of a field: every x (k,) [m] at every depth z (m,) [m], z from 0 on. The spacing in x
    is the pitch of every level's pressure elements times or over a power of two."""

    x: np.ndarray
    z: np.ndarray
    extent: float  # [m] extremes are searched at |x| <= extent, whatever the density of x

    def stride(self, pitch: float) -> int:
        """Pressure elements of a pitch [m] from one x to the next, 1 where x is finer."""
        return 2 ** max(0, self._octaves(pitch))

    def subdivisions(self, pitch: float) -> int:
        """Parts into which x divides a pitch [m], 1 where x is coarser."""
        return 2 ** max(0, -self._octaves(pitch))

    def _octaves(self, pitch: float) -> int:
        return round(np.log2((self.x[-1] - self.x[0]) / (len(self.x) - 1) / pitch))


def window_of(problem: Problem) -> Window:
    """The points of the scene's [stress], graded towards the surface.
    The spacing in x is the coarsest level's pitch times a power of two, of either sign, next to the
    one asked for: the points are some of every level's own, and no field is interpolated.
    Raises SceneError for a window that reaches beyond the body's mesh or shows nothing."""
    scene, wanted = problem.scene, problem.scene.stress
    half_width = problem.hertz.half_width
    half_range, depth = (e.metres(half_width) for e in (wanted.half_range, wanted.depth))
    width, block = problem.unbounded
    for name, size, body, unbounded in (
        ("half_range", half_range, problem.width and 0.5 * problem.width, 0.25 * width),
        ("depth", depth, scene.body.thickness, 0.5 * block),
    ):
        if body is None and size > unbounded:
            raise SceneError(
                f"{scene.source}: stress.{name}: is {size:.3g} m; allowed is at most half of what "
                f"the unbounded body is meshed to (finite_element.block), {unbounded:.3g} m"
            )
    half_range = min(half_range, 0.5 * (problem.width or np.inf))
    depth = min(depth, scene.body.thickness or np.inf)
    columns, rows = wanted.points
    coarsest, finest = problem.pitches[0], problem.reference_pitch
    spacing = max(2.0 * half_range / (columns - 1), FINEST_SPACING * finest)
    spacing = coarsest * 2.0 ** min(
        round(np.log2(spacing / coarsest)), int(np.floor(np.log2(half_range / coarsest)))
    )
    if spacing < 0.5 * FINEST_SPACING * finest:
        least = f"{FINEST_SPACING * finest:.3g} m, a part of a pressure element"
        problem = f"stress.half_range: is {half_range:.3g} m"
        raise SceneError(f"{scene.source}: {problem}; allowed is at least {least}")
    if 2.0 * half_range > MOST_COLUMNS * coarsest:
        most = f"{0.5 * MOST_COLUMNS * coarsest:.3g} m at pressure elements of {coarsest:.3g} m"
        raise SceneError(
            f"{scene.source}: stress.half_range: is {half_range:.3g} m; allowed is at most {most}, "
            "as the surface asks for: check x_unit and z_unit, or leave [stress] out"
        )
    last = int(np.floor(half_range / spacing * (1.0 + 1e-12)))
    x = np.arange(-last, last + 1) * spacing
    first = min(FIRST_DEPTH * finest, depth / (rows - 1))
    step = min(coarsest, spacing)
    extent = step * np.floor(half_range / step * (1.0 + 1e-12))
    return Window(x, graded_depths(depth, rows, first), extent)


def search_window(problem: Problem, window: Window) -> Window:
    """Points from which the search for extremes inside a window starts, whatever its density: along
    x the coarsest level's pressures, a tenth of the shortest wave; depths by a fixed ratio."""
    spacing = min(problem.pitches[0], window.extent)
    last = round(window.extent / spacing)
    depth = window.z[-1]
    first = min(FIRST_DEPTH * problem.pitches[0], 0.5 * depth)
    growth = np.log1p(depth / first * (SEARCH_RATIO - 1.0)) / np.log(SEARCH_RATIO)
    rows = max(3, int(np.ceil(growth)) + 1)
    x = np.arange(-last, last + 1) * spacing
    return Window(x, graded_depths(depth, rows, min(first, depth / rows)), window.extent)
