"""How much of each figure is owed to the sampling of the trace.

It is solved again from every other sample, the even or the odd ones: the larger change counts. The
half-plane is enough, for both models press one curve."""

from collections.abc import Sequence
from dataclasses import replace

from comparisons.common.progress import Stages
from comparisons.common.tasks import LAST, Here, Tasks
from comparisons.models.half_plane import expected_of, half_plane_level
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.comparison import relative_differences
from comparisons.studies.model_error.quantities_of_interest import quantities_of

SAMPLED = 3  # level on which the sampling counts: as fine as the scene's resolution asks


def sampling_changes(
    problem: Problem, window: Window | None, levels: Sequence[Level], tasks: Tasks
) -> dict[float, dict[str, float]]:
    """By friction coefficient and quantity, the relative change from half the samples.

    levels  of the half-plane, coarse to fine; the third, or the last before it, is compared"""
    level, changes = levels[:SAMPLED][-1], {}
    for first, key in enumerate(announce_sampling(problem, window, levels, tasks)):
        thinned, other = _thinned(problem, first), tasks.result(key)
        for friction in problem.scene.load.friction:
            sizes = changes.setdefault(friction, {})
            whole = quantities_of(level, problem, friction).largest()
            half = quantities_of(other, thinned, friction).largest()
            for name, size in relative_differences(half, whole, problem).items():
                sizes[name] = max(sizes.get(name, 0.0), abs(size))
    return changes


def announce_sampling(
    problem: Problem, window: Window | None, levels: Sequence[Level], tasks: Tasks
) -> list[str]:
    """The keys of the tasks that solve from the even and from the odd samples."""
    if problem.scene.profile is None:
        return []
    number = min(SAMPLED, len(levels))
    keys, grid = [f"sampling-{first}-{number}" for first in (0, 1)], levels[number - 1].grid
    cost = expected_of(grid.count)
    size = {"seconds": cost.seconds, "memory": cost.memory}
    for first, key in enumerate(keys):
        tasks.add(key, _sampled, problem, first, grid.pitch, window, **size, urgency=LAST)
    return keys


def _sampled(
    here: Here, problem: Problem, first: int, pitch: float, window: Window | None
) -> Level:
    here.callback("error budget: sampling of the trace")
    thinned = _thinned(problem, first)
    return half_plane_level(thinned, pitch, window, Stages(), fields=False)


def _thinned(problem: Problem, first: int) -> Problem:
    """The problem with every other sample of its profile from the given one on, and both ends, so
    that nothing is cut off; on the same grids."""
    surface = problem.surface
    profile = surface.profile
    last = len(profile.x) - 1
    samples = sorted({0, *range(first, last + 1, 2), last})
    profile = replace(profile, x=profile.x[samples], height=profile.height[samples])
    return replace(problem, surface=replace(surface, profile=profile))
