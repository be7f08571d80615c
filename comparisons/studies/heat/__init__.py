"""The heat of friction: flash temperatures by both models, and the verdict on their difference."""

from comparisons.judging.study import Study
from comparisons.studies.heat import show
from comparisons.studies.heat.study import NAME, QUANTITIES, begin, solve

STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: solved.problem.scene.heat is not None,
    begin=begin,
    title="Frictional heat",
    note=show.note,
    sources=show.RULES,
    facts=show.heat_facts,
    pictures=show.PICTURES,
    files=show.files,
)
