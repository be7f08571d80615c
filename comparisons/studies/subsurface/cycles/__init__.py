"""A roller that comes again and again over a body that flows: does it shake down, what is left."""

from comparisons.studies.study import Study
from comparisons.studies.subsurface.cycles import show
from comparisons.studies.subsurface.cycles.study import (
    NAME,
    QUANTITIES,
    CycleStudy,
    begin,
    needs,
    planned,
    solve,
)

CYCLES = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: solved.problem.scene.cycles is not None,
    needs=needs,
    planned=planned,
    begin=begin,
    data=CycleStudy,
    blocks=show.blocks,
    pictures=show.PICTURES,
    files=show.files,
    lines=show.lines,
)
