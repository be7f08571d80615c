"""Friction by itself: surfaces that it moves, and contacts that it holds."""

from comparisons.judging.study import Study
from comparisons.studies.friction import show
from comparisons.studies.friction.partial_slip import NAME, QUANTITIES, solve

PARTIAL_SLIP = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: solved.problem.scene.partial_slip is not None,
    title="Partial slip",
    note=show.NOTE,
    facts=show.slip_facts,
    advice=show.next_step,
    pictures=show.PICTURES,
    files=show.files,
)
