"""Answers from outside: any code's pressures and stresses, or measured ones, beside the models'."""

from comparisons.judging.study import Study
from comparisons.studies.answers import show
from comparisons.studies.answers.study import NAME, QUANTITIES, begin, solve

STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: bool(solved.problem.scene.answers),
    begin=begin,
    blocks=show.blocks,
    pictures={"answers": show.answer_pictures},
    verdicts=show.verdicts,
)
