"""Which nodes carry pressure: exchanges of sides until every sign condition holds.

Primal-dual active set (block principal pivoting): every node that breaks its sign condition
changes sides at once. Block exchanges may cycle; when the number of broken conditions has not
fallen for `PATIENCE` exchanges, the primal active-set method takes over from a feasible point.
Its energy falls strictly from one equilibrium to the next, so that no set returns and it ends
after finitely many. Symbols as in `analytic.contact`.
"""

import numpy as np

from analytic.equilibrium import EquilibriumProblem, Sides

PATIENCE = 8  # block exchanges without progress before the primal method
REDUCTION = 1e-2  # of the residual by each exchange while the set moves; 0.1 may go on for long
SHARPER = 0.1  # times that, after each exchange without progress
MAX_EXCHANGES = 200


def exchange_blocks(
    problem: EquilibriumProblem, start: np.ndarray, settled: float = 0.0
) -> np.ndarray:
    """Primal-dual active set: every node that breaks its sign condition changes sides at once.

    It ends when no more than `settled` of the free nodes' number break theirs, and with
    settled = 0 when none does in an accurate equilibrium.
    """
    pressure, reduction = start, REDUCTION
    sides = Sides.of(start, problem.constraints.hardness)
    fewest, patience = len(start) + 1, PATIENCE
    for _ in range(MAX_EXCHANGES):
        rest = problem.equilibrium(pressure, sides, reduction)
        pressure = rest.pressure
        broken = problem.broken_signs(pressure, rest.gap, sides)
        count = broken.count()
        if count == 0 and rest.accurate:
            return pressure
        if settled and count <= settled * np.count_nonzero(sides.free):
            return pressure
        if count < fewest:
            fewest, patience = count, PATIENCE
        else:
            patience -= 1
            reduction *= SHARPER
        if patience == 0:
            break
        if count == 0:
            reduction = 0.0
        sides = sides.exchanged(broken)
    return exchange_feasibly(problem, pressure)


def exchange_feasibly(problem: EquilibriumProblem, start: np.ndarray) -> np.ndarray:
    """Primal active set: pressures stay in the box and carry the load, and the energy falls.

    On the way to the equilibrium of the free nodes the first that reach a side stay there. At
    the equilibrium every node whose gap calls for it is freed; those that would leave the box
    at once go back before anything has moved.
    """
    hardness = problem.constraints.hardness
    pressure = problem.feasible(start)
    sides = Sides.of(pressure, hardness)
    for _ in range(20 * len(start)):
        rest = problem.equilibrium(pressure, sides, 0.0)
        step = rest.pressure - pressure
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
        pressure = rest.pressure
        broken = problem.broken_signs(pressure, rest.gap, sides)
        if not (broken.joining.any() or broken.softening.any()):
            return pressure
        sides = Sides(sides.lower & ~broken.joining, sides.upper & ~broken.softening)
    return pressure
