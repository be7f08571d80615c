"""Which nodes carry pressure: exchanges of sides until every sign condition holds.

Primal-dual active set (block principal pivoting): every node that breaks its sign condition
changes sides at once, and with it those that will at the same edge
(`analytic.contact.edge_extrapolation`); where too few are free to bear the load, sides are balanced
instead. Block exchanges may cycle; when the number of broken conditions has not fallen for
`PATIENCE` exchanges, the primal active-set method takes over from a feasible point. Its energy
falls strictly from one equilibrium to the next, so that no set returns and it ends after finitely
many. Symbols as in `analytic.contact.problem`.
"""

import numpy as np

from analytic.contact.edge_extrapolation import foreseen
from analytic.contact.equilibrium import EquilibriumProblem
from analytic.contact.sides import Sides

PATIENCE = 8  # block exchanges without progress before the primal method
REDUCTION = 3e-3  # of the residual by each exchange while the set moves; 0.1 may go on for long
SHARPER = 0.1  # times that, after each exchange without progress
NEARLY = 0.02  # of the edges still move: the next equilibrium is worth making accurate
MAX_EXCHANGES = 200
WORTHWHILE = 0.1  # of the energy that the equilibrium would release, taken by one step towards it


def exchange_blocks(
    problem: EquilibriumProblem, start: np.ndarray, settled: float = 0.0
) -> np.ndarray:
    """Primal-dual active set: every node that breaks its sign condition changes sides at once.

    It ends when no more than `settled` of the edges' number break theirs, and with settled = 0
    when none does in an accurate equilibrium. With settled > 0 it gives up instead of starting
    the primal method.
    """
    pressure, reduction = start, REDUCTION
    sides = Sides.of(start, problem.constraints.hardness)
    fewest, patience = len(start) + 1, PATIENCE
    for _ in range(MAX_EXCHANGES):
        sides = problem.with_a_free_node(sides)
        rest = problem.equilibrium(pressure, sides, reduction)
        pressure = rest.pressure
        broken = problem.broken_signs(rest, sides)
        count = broken.count()
        if count == 0 and rest.accurate:
            return pressure
        if settled and count <= settled * sides.edges():
            return pressure
        if count < fewest:
            fewest, patience = count, PATIENCE
        else:
            patience -= 1
            reduction *= SHARPER
        if patience == 0:
            if settled:
                return pressure
            break
        if count == 0 or (not settled and count <= max(2, NEARLY * sides.edges())):
            reduction = 0.0
        if count > 0 and problem.short_of_free_nodes(sides):
            sides = problem.balanced(rest)
        else:
            moving = count > 2 and patience == PATIENCE
            sides = sides.exchanged(foreseen(broken, sides) if moving else broken)
    return exchange_feasibly(problem, pressure, sides)


def exchange_feasibly(problem: EquilibriumProblem, start: np.ndarray, sides: Sides) -> np.ndarray:
    """Primal active set: pressures stay in the box and carry the load, and the energy falls.

    On the way to the equilibrium of the free nodes those that leave the box stay at its sides:
    all of them where that lowers the energy by WORTHWHILE, else the first that are met. At the
    equilibrium every node whose gap calls for it is freed; those that would leave the box at
    once go back before anything has moved.
    """
    hardness = problem.constraints.hardness
    if problem.can_carry(sides):
        pressure = problem.feasible(start, sides.free)
    else:
        pressure = problem.feasible(start, np.full(len(start), True))
        sides = Sides.of(pressure, hardness)
    gap = problem.gap + problem.apply(pressure)
    for _ in range(20 * len(start)):
        sides = problem.with_a_free_node(sides)
        rest = problem.equilibrium(pressure, sides, 0.0)
        rest_gap = rest.gap + problem.approach * problem.weights
        if np.all((rest.pressure >= 0.0) & (rest.pressure <= hardness)):
            pressure, gap = rest.pressure, rest_gap
            broken = problem.broken_signs(rest, sides)
            if not (broken.joining.any() or broken.softening.any()):
                return pressure
            sides = Sides(sides.lower & ~broken.joining, sides.upper & ~broken.softening)
            continue
        step = rest.pressure - pressure
        trial = problem.feasible(rest.pressure, sides.free)
        trial_gap = problem.gap + problem.apply(trial)
        gain = _energy_lost(pressure, gap, trial, trial_gap)
        if gain < WORTHWHILE * _energy_lost(pressure, gap, rest.pressure, rest_gap):
            trial = _first_met(pressure, step, hardness, sides.free)
            trial_gap = problem.gap + problem.apply(trial)
        down, up = sides.free & (step < 0.0), sides.free & (step > 0.0)
        sides = Sides(
            sides.lower | (down & (trial <= 0.0)), sides.upper | (up & (trial >= hardness))
        )
        pressure, gap = trial, trial_gap
    return pressure


def _energy_lost(
    before: np.ndarray, gap_before: np.ndarray, after: np.ndarray, gap_after: np.ndarray
) -> float:
    """Energy 1/2 p'Cp + G'p at the pressures before less that after, from both G + Cp."""
    return float(0.5 * (before - after) @ (gap_before + gap_after))


def _first_met(
    pressure: np.ndarray, step: np.ndarray, hardness: float, free: np.ndarray
) -> np.ndarray:
    """Pressures where, along the step, the first free node meets a side of the box."""
    with np.errstate(divide="ignore", invalid="ignore"):
        room = np.where(step < 0.0, -pressure / step, (hardness - pressure) / step)
    room[~(free & (step != 0.0))] = np.inf
    first = np.min(room)
    moved = np.clip(pressure + first * step, 0.0, hardness)
    met = room <= first
    moved[met] = np.where(step[met] < 0.0, 0.0, hardness)
    return moved
