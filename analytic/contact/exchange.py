"""The active set's exchange: nodes change their state until none violates its sign condition.

Primal-dual active set (block principal pivoting): every node that violates its sign condition
changes its state at once; where too few nodes are free to carry the load, the set is balanced
instead. Block exchanges may cycle: when the number of violations has not fallen for PATIENCE
exchanges, the primal method takes over from a feasible point. Its energy falls strictly from one
equilibrium to the next, so that it ends. Symbols as in `analytic.contact.problem`."""

import numpy as np

from analytic.contact.active_set import ActiveSet, extrapolated
from analytic.contact.equilibrium import EquilibriumProblem

PATIENCE = 8  # block exchanges without progress before the primal method
REDUCTION = 3e-3  # of the residual by each exchange while the set moves; 0.1 may go on for long
SHARPER = 0.1  # times that, after each exchange without progress
NEARLY = 0.02  # of the edges still move: the next equilibrium is worth making accurate
MAX_EXCHANGES = 200
STALLED = 3  # equilibria without less energy than one before, which rounding alone leaves
WORTHWHILE = 0.1  # of the energy that the equilibrium would release, taken by one step towards it


def exchange(problem: EquilibriumProblem, start: np.ndarray, settled: float = 0.0) -> np.ndarray:
    """Pressures (n,) [Pa] by block exchanges from `start`, and where these get stuck by the primal
    method; with settled > 0 as `exchange_blocks` leaves them."""
    pressure, active, ended = exchange_blocks(problem, start, settled)
    return pressure if ended or settled else exchange_feasibly(problem, pressure, active)


def exchange_blocks(
    problem: EquilibriumProblem, start: np.ndarray, settled: float = 0.0
) -> tuple[np.ndarray, ActiveSet, bool]:
    """Pressures (n,) [Pa] by block exchanges from `start`, their set, and whether they have ended:
    when no more than `settled` of the edges' number break their sign conditions, and with
    settled = 0 when none does in an accurate equilibrium."""
    pressure, reduction = start, REDUCTION
    active = ActiveSet.of(start, problem.constraints.hardness)
    fewest, patience = len(start) + 1, PATIENCE
    for _ in range(MAX_EXCHANGES):
        active = problem.with_a_free_node(active)
        state = problem.equilibrium(pressure, active, reduction)
        pressure = state.pressure
        violated = problem.violations(state, active)
        count = violated.count()
        if count == 0 and state.accurate:
            return pressure, active, True
        if settled and count <= settled * active.edges():
            return pressure, active, True
        if count < fewest:
            fewest, patience = count, PATIENCE
        else:
            patience -= 1
            reduction *= SHARPER
        if patience == 0:
            break
        if count == 0 or (not settled and count <= max(2, NEARLY * active.edges())):
            reduction = 0.0
        if count > 0 and problem.short_of_free_nodes(active):
            active = problem.balanced(state)
        else:
            moving = count > 2 and patience == PATIENCE
            active = active.exchanged(extrapolated(violated, active) if moving else violated)
    return pressure, active, False


def exchange_feasibly(
    problem: EquilibriumProblem, start: np.ndarray, active: ActiveSet
) -> np.ndarray:
    """Primal active set: pressures stay in the box and carry the load, and the energy falls.

    On the way to the equilibrium of the free nodes those that leave the box stay on its sides:
    all of them where that lowers the energy by WORTHWHILE, else the first that are met. At the
    equilibrium every node whose gap calls for it is freed; those that would leave the box at
    once go back before anything has moved. An operator whose waves differ by more than rounding
    resolves has equilibria that do not lower the energy: after STALLED of them the best is left."""
    hardness = problem.constraints.hardness
    best, least, since_least = start, np.inf, 0
    if problem.can_carry(active):
        pressure = problem.feasible(start, active.free)
    else:
        pressure = problem.feasible(start, np.full(len(start), True))
        active = ActiveSet.of(pressure, hardness)
    weighted_gap = problem.weighted_gap + problem.apply(pressure)
    for _ in range(20 * len(start)):
        active = problem.with_a_free_node(active)
        state = problem.equilibrium(pressure, active, 0.0)
        equilibrium_gap = state.weighted_gap + problem.approach * problem.weights
        if np.all((state.pressure >= 0.0) & (state.pressure <= hardness)):
            pressure, weighted_gap = state.pressure, equilibrium_gap
            energy = 0.5 * float(pressure @ (problem.weighted_gap + weighted_gap))
            since_least = 0 if energy < least else since_least + 1
            if energy < least:
                best, least = pressure, energy
            elif since_least == STALLED:
                return best
            violated = problem.violations(state, active)
            if not (violated.joining.any() or violated.softening.any()):
                return pressure
            active = ActiveSet(active.lower & ~violated.joining, active.upper & ~violated.softening)
            continue
        step = state.pressure - pressure
        trial = problem.feasible(state.pressure, active.free)
        trial_gap = problem.weighted_gap + problem.apply(trial)
        gain = _energy_lost(pressure, weighted_gap, trial, trial_gap)
        most = _energy_lost(pressure, weighted_gap, state.pressure, equilibrium_gap)
        if gain < WORTHWHILE * most:
            trial = _first_met(pressure, step, hardness, active.free)
            trial_gap = problem.weighted_gap + problem.apply(trial)
        down, up = active.free & (step < 0.0), active.free & (step > 0.0)
        active = ActiveSet(
            active.lower | (down & (trial <= 0.0)), active.upper | (up & (trial >= hardness))
        )
        pressure, weighted_gap = trial, trial_gap
    return pressure


def _energy_lost(
    before: np.ndarray, gap_before: np.ndarray, after: np.ndarray, gap_after: np.ndarray
) -> float:
    """Energy 1/2 p'Cp + G'p at the pressures before less that after, from both G + Cp."""
    return float(0.5 * (before - after) @ (gap_before + gap_after))


def _first_met(
    pressure: np.ndarray, step: np.ndarray, hardness: float | np.ndarray, free: np.ndarray
) -> np.ndarray:
    """Pressures where, along the step, the first free node meets a side of the box."""
    with np.errstate(divide="ignore", invalid="ignore"):
        room = np.where(step < 0.0, -pressure / step, (hardness - pressure) / step)
    room[~(free & (step != 0.0))] = np.inf
    first = np.min(room)
    moved = np.clip(pressure + first * step, 0.0, hardness)
    met = room <= first
    moved[met] = np.where(step < 0.0, 0.0, hardness)[met]
    return moved
