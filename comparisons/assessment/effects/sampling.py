"""What a figure owes to the sampling of the trace: solved again from every other sample.

The half-plane is enough, both models press the same curve. Taking every other sample can be done
in two ways, that of even and that of odd ones; the larger change counts, and stands for what the
samples themselves leave unknown as if that fell by half with the distance between them.
"""

from collections.abc import Sequence
from dataclasses import replace

from analytic.grid import roller_gap
from analytic.profile import Profile, surface
from comparisons.assessment.effects.quantities_of_interest import answer_of, sizes
from comparisons.common.progress import Stages
from comparisons.models.half_plane import half_plane_level
from comparisons.models.level import Level, Window
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem

REFERENCE = 3  # levels: where edges are as fine as the scene's own resolution asks


def sampling_changes(
    problem: Problem, plan: Plan, window: Window | None, levels: Sequence[Level]
) -> dict[float, dict[str, float]]:
    """By friction coefficient and quantity, the relative change from half the samples.

    levels  of the half-plane, coarse to fine; the third, or the last before it, is compared
    """
    profile, frictions = problem.scene.profile, problem.scene.friction
    level = levels[:REFERENCE][-1]
    found: dict[float, dict[str, float]] = {friction: {} for friction in frictions}
    for first in (0, 1):
        thinned = _pressed(problem, _every_other(profile, first))
        other = half_plane_level(thinned, plan, level.grid.pitch, window, Stages())
        for friction in frictions:
            whole = answer_of(level, problem, friction)
            change = answer_of(other, thinned, friction) - whole
            for name, size in sizes(change, whole, problem, window).items():
                found[friction][name] = max(found[friction].get(name, 0.0), abs(size))
    return found


def _every_other(profile: Profile, first: int) -> Profile:
    """Every other sample from the given one on, and both ends, so that nothing is cut off."""
    last = len(profile.x) - 1
    kept = sorted({0, *range(first, last + 1, 2), last})
    return Profile(profile.x[kept], profile.height[kept])


def _pressed(problem: Problem, profile: Profile) -> Problem:
    """The problem with another profile, on the same grids."""
    return replace(
        problem,
        scene=replace(problem.scene, profile=profile),
        gap=roller_gap(problem.scene.roller_radius, surface(profile)),
        knots=profile.x,
    )
