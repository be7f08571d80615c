"""How far uncertain inputs move the figures, and which of them does (u_input of ASME V&V 20)."""

from comparisons.figures.quantity import QUANTITIES
from comparisons.studies.scatter import show
from comparisons.studies.scatter.study import NAME, PressureBand, begin, solve
from comparisons.studies.study import Solved, Study


def _applies(solved: Solved) -> bool:
    return solved.problem.scene.scatter is not None and "half_plane" in solved.plan.models


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=_applies,
    begin=begin,
    data=PressureBand,
    blocks=show.blocks,
    lines=show.lines,
)
