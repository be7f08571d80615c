"""The points of the stress fields: where models and levels are compared, and searched."""

import numpy as np

from analytic.stress.field import graded_depths
from comparisons.common.errors import SceneError
from comparisons.models.problem import Problem, Window
from comparisons.scenes.fields import Extent

HALF_RANGE = Extent(1.5, in_half_widths=True)  # of a field, to either side
FIRST_DEPTH = 0.25  # of the third level's pitch: the layer next to the surface
FINEST_SPACING = 1.0 / 16.0  # of the third level's pitch; finer points would show nothing new
MOST_COLUMNS = 2**18  # of the coarsest pitch across a window: where extremes are searched
SEARCH_RATIO = 1.2  # of a depth to the one above it, where extremes are searched


def field_ends(problem: Problem) -> tuple[float, float]:
    """Ends [m] of the field along x: as far as the scene asks to either side of the roller's
    middle. Where it does not ask, and contact may reach beyond, and where it asks for what has no
    contact, the field lies about the middle of the contact, and is as wide."""
    half_width, wanted = problem.hertz.half_width, problem.scene.stress.half_range
    reach = (wanted or HALF_RANGE).metres(half_width)
    # without the last digits of a computed surface, which would move the mesh
    start, stop = (round(end / half_width, 6) * half_width for end in problem.extent)
    first, last = start + problem.margin, stop - problem.margin
    is_seen = max(-first, last) <= reach if wanted is None else -last <= reach >= first
    middle, most = 0.0, 0.5 * (problem.width or np.inf)
    if not is_seen:
        middle, reach = 0.5 * (start + stop), max(reach, 0.5 * (stop - start))
    return max(middle - reach, -most), min(middle + reach, most)


def window_of(problem: Problem) -> Window:
    """The points of the scene's [stress], graded towards the surface.
    The spacing in x is the coarsest level's pitch times a power of two, of either sign, next to the
    one asked for: the points are some of every level's own, and no field is interpolated.
    Raises SceneError for a window that reaches beyond the body's mesh or shows nothing."""
    scene, wanted = problem.scene, problem.scene.stress
    half_width = problem.hertz.half_width
    low, high = field_ends(problem)
    half_range, depth = 0.5 * (high - low), wanted.depth.metres(half_width)
    width, block = problem.unbounded
    for name, size, body, unbounded in (
        ("half_range", max(-low, high), problem.width, 0.25 * width),
        ("depth", depth, scene.body.thickness, 0.5 * block),
    ):
        if body is None and size > unbounded:
            raise SceneError(
                f"{scene.source}: stress.{name}: is {size:.3g} m; allowed is at most half of what "
                f"the unbounded body is meshed to (finite_element.block), {unbounded:.3g} m"
            )
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
    first = min(FIRST_DEPTH * finest, depth / (rows - 1))
    x = _steps(low, high, spacing)
    ends = _steps(low, high, min(coarsest, spacing))[[0, -1]]
    return Window(x, graded_depths(depth, rows, first), tuple(ends.tolist()))


def _steps(low: float, high: float, step: float) -> np.ndarray:
    """Whole steps [m] between two ends."""
    first, last = np.array([low, high]) / step * (1.0 + 1e-12)
    return np.arange(np.ceil(first), np.floor(last) + 1.0) * step


def search_window(problem: Problem) -> Window:
    """Points from which the search for extremes inside the window starts, whatever its
    density: along x the coarsest level's pressures, a tenth of the shortest wave; depths by a
    fixed ratio."""
    window, pitch = problem.window, problem.pitches[0]
    (low, high), depth = window.ends, window.z[-1]
    spacing = min(pitch, 0.5 * (high - low))
    first = min(FIRST_DEPTH * pitch, 0.5 * depth)
    growth = np.log1p(depth / first * (SEARCH_RATIO - 1.0)) / np.log(SEARCH_RATIO)
    rows = max(3, int(np.ceil(growth)) + 1)
    x = np.arange(round(low / spacing), round(high / spacing) + 1) * spacing
    return Window(x, graded_depths(depth, rows, min(first, depth / rows)), window.ends)
