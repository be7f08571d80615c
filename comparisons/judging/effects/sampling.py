"""Share of each figure that is owed to the trace's sampling: an effect that no model has.

The trace is solved again from every other sample, the even or the odd ones, and the larger change
estimates what samples between them would change. The half-plane is enough, for both models press
one curve. A measured trace with few samples on the contact says nothing of the roughness there, and
how little they change no more: then the effect has no bound."""

from dataclasses import replace
from math import inf

from comparisons.common.numbers import significant, with_unit
from comparisons.common.tasks import LAST, Tasks
from comparisons.judging.effects.estimates import Sizes
from comparisons.judging.rule import relative_differences, values_of
from comparisons.judging.study import Solved
from comparisons.models.model import scene_model
from comparisons.models.problem import Problem

FEWEST = 20  # samples of a measured trace on the contact
SAMPLED = 3  # level on which the sampling counts: as fine as the scene's resolution asks


def sampling_estimate(solved: Solved, tasks: Tasks) -> tuple[Sizes, str]:
    """Largest change by the sampling, by quantity, and words on the surface between samples."""
    sizes, info = sampling_changes(solved, tasks), solved.problem.surface.info
    levels = solved.runs["half_plane"].levels
    samples, spacing = levels[-1].contact_length / info.spacing, with_unit(info.spacing, "m", 3)
    if info.path is not None and samples < FEWEST:
        count = f"{significant(samples, 2)} samples, {spacing} apart"
        few = f"the contact has {count}, and shows its roughness from {FEWEST} on"
        return dict.fromkeys(sizes, inf), few
    return sizes, f"by what every other sample changes; they are {spacing} apart"


def sampling_changes(solved: Solved, tasks: Tasks) -> Sizes:
    """Largest relative change, by quantity, from half the samples, of the half-plane's third
    level, or the last before it."""
    sizes: Sizes = {}
    for first, key in enumerate(announce_sampling(solved, tasks)):
        others = tasks.result(key)
        for case in solved.cases:
            level, problem = case.runs["half_plane"].levels[:SAMPLED][-1], case.problem
            whole = values_of(level, problem)
            half = values_of(others[case.friction], _thinned(problem, first))
            for name, size in relative_differences(half, whole, problem).items():
                sizes[name] = max(sizes.get(name, 0.0), abs(size))
    return sizes


def announce_sampling(solved: Solved, tasks: Tasks) -> list[str]:
    """The keys of the tasks that solve from the even and from the odd samples."""
    problem, number = solved.problem, min(SAMPLED, len(solved.runs["half_plane"].levels))
    keys, own = [], scene_model("half_plane", problem)
    for first in (0, 1) if problem.scene.profile is not None else ():
        model = replace(own, name=f"sampling-{first}", label="sampling of the trace")
        thinned = _thinned(problem, first)
        keys.append(model.announce(tasks, thinned, number, urgency=LAST))
    return keys


def _thinned(problem: Problem, first: int) -> Problem:
    """The problem with every other sample of its profile from the given one on, and both ends, so
    that nothing is cut off; on the same grids."""
    surface = problem.surface
    profile = surface.profile
    last = len(profile.x) - 1
    samples = sorted({0, *range(first, last + 1, 2), last})
    profile = replace(profile, x=profile.x[samples], height=profile.height[samples])
    return replace(problem, surface=replace(surface, profile=profile))
