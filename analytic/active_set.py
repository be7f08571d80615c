"""Which nodes carry pressure: exchanges of sides until every sign condition holds.

Primal-dual active set (block principal pivoting): every node that breaks its sign condition
changes sides at once. Block exchanges may cycle; when the number of broken conditions has not
fallen for `PATIENCE` exchanges, the primal active-set method takes over with single exchanges
from a feasible point. Its energy falls strictly at every step, so that no set returns and it
ends after finitely many. Symbols as in `analytic.contact`.
"""

import numpy as np

from analytic.equilibrium import EquilibriumProblem, Sides

PATIENCE = 8  # block exchanges without progress before single ones
LOOSE, TIGHT = 1e-2, 1e-11  # inner relative residual while the set moves, and at the end
MAX_EXCHANGES = 200


def exchange_blocks(problem: EquilibriumProblem, start: np.ndarray) -> np.ndarray:
    """Primal-dual active set: every node that breaks its sign condition changes sides at once."""
    pressure, tolerance = start, LOOSE
    sides = Sides.of(start, problem.constraints.hardness)
    fewest, patience = len(start) + 1, PATIENCE
    for _ in range(MAX_EXCHANGES):
        pressure, gap = problem.equilibrium(pressure, sides, tolerance)
        broken = problem.broken_signs(pressure, gap, sides)
        count = broken.count()
        if count == 0 and tolerance == TIGHT:
            return pressure
        if count == 0:
            tolerance = TIGHT
            continue
        if count < fewest:
            fewest, patience = count, PATIENCE
        else:
            patience -= 1
        if patience == 0:
            break
        sides = sides.exchanged(broken)
    return exchange_singly(problem, pressure)


def exchange_singly(problem: EquilibriumProblem, start: np.ndarray) -> np.ndarray:
    """Primal active set from a feasible point: one node is freed at a time, the energy falls."""
    hardness = problem.constraints.hardness
    pressure = problem.feasible(start)
    sides = Sides.of(pressure, hardness)
    for _ in range(20 * len(start)):
        target, gap = problem.equilibrium(pressure, sides, TIGHT)
        step = target - pressure
        with np.errstate(divide="ignore", invalid="ignore"):
            room = np.where(step < 0.0, -pressure / step, (hardness - pressure) / step)
        room[~(sides.free & (step != 0.0))] = np.inf
        if np.min(room) < 1.0:
            blocking = room <= np.min(room)
            pressure = np.clip(pressure + np.min(room) * step, 0.0, hardness)
            pressure[blocking] = np.where(step[blocking] < 0.0, 0.0, hardness)
            sides = Sides(
                sides.lower | (blocking & (step < 0.0)), sides.upper | (blocking & (step > 0.0))
            )
            continue
        pressure = target
        broken = problem.broken_signs(pressure, gap, sides)
        wrong = broken.joining | broken.softening
        if not wrong.any():
            return pressure
        worst = np.zeros_like(wrong)
        worst[np.argmax(np.where(wrong, np.abs(gap), -1.0))] = True
        sides = Sides(sides.lower & ~worst, sides.upper & ~worst)
    return pressure
