"""Theories of rough contact beside the solved one, and how its asperities are penetrated."""

from comparisons.judging.study import Study
from comparisons.studies.statistics import show
from comparisons.studies.statistics.study import NAME, begin, solve

STUDY = Study(
    name=NAME,
    quantities={},
    solve=solve,
    applies=lambda solved: (
        solved.problem.scene.statistics is not None and "half_plane" in solved.plan.models
    ),
    begin=begin,
    blocks=show.blocks,
    pictures={"statistics": show.statistics_pictures},
    lines=show.lines,
)
