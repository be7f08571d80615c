"""How much of each figure is owed to the sampling of the trace: an effect that no model has.

The trace is solved again from every other sample, the even or the odd ones, and the larger change
estimates what samples between them would change. The half-plane is enough, for both models press
one curve. A measured trace with few samples on the contact says nothing of the roughness there, and
how little they change no more: then the effect has no bound."""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

from comparisons.common.numbers import significant, with_unit
from comparisons.common.progress import Stages
from comparisons.common.tasks import LAST, Here, Tasks
from comparisons.figures.figure import SHARED
from comparisons.judging.comparison import relative_differences
from comparisons.judging.effects.estimates import Sizes
from comparisons.judging.model_error.quantities_of_interest import quantities_of
from comparisons.models.half_plane import expected_of, half_plane_level
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.window import Window

EFFECT = SHARED
FEWEST = 20  # samples of a measured trace on the contact
SAMPLED = 3  # level on which the sampling counts: as fine as the scene's resolution asks


def sampling_estimate(
    problem: Problem, window: Window | None, levels: Sequence[Level], tasks: Tasks
) -> tuple[Sizes, str]:
    """By quantity, what the sampling may change, and what is said of the surface between samples.

    levels  as of `sampling_changes`"""
    sizes, info = sampling_changes(problem, window, levels, tasks), problem.surface.info
    samples, spacing = levels[-1].contact_length / info.spacing, with_unit(info.spacing, "m", 3)
    if info.path is not None and samples < FEWEST:
        count = f"{significant(samples, 2)} samples, {spacing} apart"
        few = f"the contact has {count}, and shows its roughness from {FEWEST} on"
        return dict.fromkeys(sizes, inf), few
    return sizes, f"by what every other sample changes; they are {spacing} apart"


def sampling_changes(
    problem: Problem, window: Window | None, levels: Sequence[Level], tasks: Tasks
) -> Sizes:
    """By quantity, the largest relative change from half the samples.

    levels  of the half-plane, coarse to fine; the third, or the last before it, is compared"""
    level, sizes = levels[:SAMPLED][-1], {}
    for first, key in enumerate(announce_sampling(problem, window, levels, tasks)):
        thinned, other = _thinned(problem, first), tasks.result(key)
        for friction in problem.scene.load.friction:
            whole = quantities_of(level, problem, friction).largest()
            half = quantities_of(other, thinned, friction).largest()
            for name, size in relative_differences(half, whole, problem).items():
                sizes[name] = max(sizes.get(name, 0.0), abs(size))
    return sizes


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
