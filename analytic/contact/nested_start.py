"""A start for the contact problem from the same problem on hats twice as wide.

Coarse hats are sums of fine ones, node j of the coarse grid is node 2j + 1 of the fine one: gaps
and weights are restricted by the hats' own sums, pressures interpolated. Near an edge pressures
fall as the root of the distance, so that their squares tell on which side of the middle between
two coarse nodes the edge lies."""

import numpy as np

from analytic.contact.equilibrium import EquilibriumProblem
from analytic.contact.exchange import exchange
from analytic.grid import restricted

COARSEST = 512  # nodes; below this a coarser start saves nothing
FOUNDATION = 0.3  # takes the fewest exchanges from there on, for smooth and rough contacts
EDGES_OFF = 0.25  # of the edges of a coarse contact may still be off by a node


def coarse_start(problem: EquilibriumProblem, coarsest: int = COARSEST) -> np.ndarray:
    """Pressures (n,) [Pa] to start from: nested grids, each solved until its edges settle.

    coarsest  nodes below which no coarser grid is made"""
    count, periodic = len(problem.weighted_gap), problem.operator.periodic
    operator = problem.operator.coarser if count >= coarsest else None
    if operator is None:
        return foundation_start(problem)
    coarse = type(problem)(
        operator,
        restricted(problem.weighted_gap, periodic),
        restricted(problem.weights, periodic),
        problem.constraints.coarsened(),
        problem.spent,
    )
    pressure = exchange(coarse, coarse_start(coarse, coarsest), settled=EDGES_OFF)
    return prolonged(np.clip(pressure, 0.0, coarse.constraints.hardness), count, periodic)


def foundation_start(problem: EquilibriumProblem) -> np.ndarray:
    """Pressures (n,) [Pa] on independent springs in place of the body. Under a prescribed load the
    springs sink, on the average over the grid, by FOUNDATION times what the body does under an even
    pressure of that load."""
    weights, constraints = problem.weights, problem.constraints
    height, count = problem.weighted_gap / weights, len(weights)
    softness = FOUNDATION * np.mean(np.abs(problem.apply(np.ones(count)) / weights))
    if constraints.load is None:
        level = constraints.approach
    else:
        sinking = softness * constraints.load / weights.sum()
        reached = np.sort(height)
        # the lowest k share the sinking of all; k is the first that leaves the next one open
        shared = (sinking * count + np.cumsum(reached)) / np.arange(1, count + 1)
        level = shared[np.argmax(np.append(shared[:-1] <= reached[1:], True))]
    pressure = np.maximum(level - height, 0.0) / softness
    return np.minimum(pressure, constraints.hardness)


def prolonged(pressure: np.ndarray, count: int, periodic: bool) -> np.ndarray:
    """Pressures on the fine grid (count,) from those on the coarse one, >= 0; edges between nodes.
    A fine node between a touching and an open coarse node is open where the pressures' squares,
    continued straight, vanish before they reach it."""
    outer = pressure[[-1, 0]] if periodic else np.zeros(2)
    padded = np.concatenate((outer[:1], pressure, outer[1:]))
    between = 0.5 * (padded[:-1] + padded[1:])
    between[1:][_ends_short(padded)] = 0.0
    between[:-1][_ends_short(padded[::-1])[::-1]] = 0.0
    if periodic:  # the first and the last are the same point
        between[0] = min(between[0], between[-1])
    fine = np.empty(count)
    fine[1::2] = pressure[: len(fine[1::2])]
    fine[0::2] = between[: len(fine[0::2])]
    return fine


def _ends_short(padded: np.ndarray) -> np.ndarray:
    """Whether the contact of each inner node ends before the middle to the next node, open."""
    square = padded**2
    return (padded[1:-1] > 0.0) & (padded[2:] == 0.0) & (square[:-2] > 3.0 * square[1:-1])
