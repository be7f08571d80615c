"""Contact where sliding traction moves the surfaces: a complementarity problem without an energy.

    g = G - d w + C p >= 0,   p >= 0,   p g = 0,   w'p = P  (or d given)   and optionally p <= H

with a compliance C that is positive definite but not symmetric (`analytic.operators.tangential`);
symbols as in `analytic.contact.problem`.

Method: the primal-dual active set of `analytic.contact.active_set` on nested grids, each started
from the next coarser one; on a fixed set GMRES, preconditioned by the operator's approximate
inverse (`analytic.contact.coupled_equilibrium`). Block exchanges have no proof of convergence.
Where a set comes back, or too many have been tried, a contraction takes over:

    p_k+1 = argmin 1/2 q'Nq + (t (G + C p_k) - N p_k)'q   over the constraints,   N = (C + C')/2,

the projection, in the norm of N, of p_k - t N^-1 (G + C p_k). Projections do not stretch, so two
iterates approach each other by sqrt((1-t)^2 + t^2 k^2), k the size of the skew part in that norm
(mu beta for two half-planes under a given load): below one for t < 2/(1+k^2), whatever k is. t is
halved whenever a step has hardly shortened. Each step is a contact problem of N, `solve_contact`.
"""

from dataclasses import replace

import numpy as np

from analytic.contact.active_set import REDUCTION
from analytic.contact.coupled_equilibrium import CoupledEquilibrium
from analytic.contact.equilibrium import Constraints
from analytic.contact.nested_start import SETTLED, coarse_start
from analytic.contact.problem import (
    ContactSolution,
    assessed,
    check_load,
    common_gap,
    solve_contact,
)
from analytic.contact.sides import Sides
from analytic.operators.tangential import CoupledOperator

MAX_EXCHANGES = 100  # on one grid; nested starts were seen to take up to 20
COARSEST = 128  # nodes; below this a coarser start saves nothing
MAX_CONTRACTIONS = 400
SHORTEST = 1e-10  # a contraction step this small, relative in the norm of N, is the last


def solve_coupled(
    operator: CoupledOperator,
    gap: np.ndarray,
    weights: np.ndarray,
    constraints: Constraints,
    start: np.ndarray | None = None,
) -> ContactSolution:
    """Solve the contact problem of this module; residuals are those of the coupled operator.

    gap      G (n,) [m^2]         weights  w (n,) [m]
    start    pressures (n,) [Pa] of a nearby problem; without them a coarser grid supplies them,
             which costs less than the way from the uncoupled solution

    An operator without a skew part is left to `solve_contact`. `iterations` counts set exchanges,
    applications of C and contraction steps, on all grids together.
    Raises ContactError if the load exceeds what the hardness can carry. A solution that misses
    KKT_TOLERANCE is returned with `converged` False.
    """
    if not operator.skew:
        return solve_contact(operator.normal, gap, weights, constraints, start)
    check_load(constraints, weights)
    spent = {"exchanges": 0, "applications": 0, "contractions": 0}
    common, constraints = common_gap(gap, weights, constraints)
    gap = gap - common * weights
    problem = CoupledEquilibrium(operator, gap, weights, constraints, spent)
    settled = False
    if start is not None:
        pressure, settled = _exchange(problem, start)
    if not settled:
        start = coarse_start(problem, _settled, COARSEST)
        pressure, settled = _exchange(problem, start)
    solution = _solution(problem, pressure)
    if not (settled or solution.converged):
        solution = _contract(problem, solution.pressure)
    return replace(solution, approach=solution.approach + common)


def _solution(problem: CoupledEquilibrium, pressure: np.ndarray) -> ContactSolution:
    pressure = np.clip(pressure, 0.0, problem.constraints.hardness)
    return assessed(
        problem.apply(pressure),
        pressure,
        problem.gap,
        problem.weights,
        problem.approach,
        problem.constraints,
        problem.spent,
    )


def _exchange(
    problem: CoupledEquilibrium, start: np.ndarray, settled: float = 0.0
) -> tuple[np.ndarray, bool]:
    """Block exchanges until no more than `settled` of the edges' number break their sign
    conditions, with 0 until none does in an accurate equilibrium; and whether that was reached."""
    pressure, reduction = start, REDUCTION
    sides = Sides.of(start, problem.constraints.hardness)
    seen: set[tuple[bytes, bytes]] = set()
    for _ in range(MAX_EXCHANGES):
        sides = problem.with_a_free_node(sides)
        rest = problem.equilibrium(pressure, sides, reduction)
        pressure = rest.pressure
        broken = problem.broken_signs(rest, sides)
        count = broken.count()
        if count == 0 and rest.accurate:
            return pressure, True
        if settled and count <= settled * sides.edges():
            return pressure, True
        if count == 0:
            reduction = 0.0
            continue
        short = problem.short_of_free_nodes(sides)
        sides = problem.balanced(rest) if short else sides.exchanged(broken)
        key = np.packbits(sides.lower).tobytes(), np.packbits(sides.upper).tobytes()
        if key in seen:
            if reduction == 0.0:
                break
            reduction, seen = 0.0, set()  # the cycle may be that of loose equilibria
        seen.add(key)
    return pressure, False


def _settled(problem: CoupledEquilibrium, start: np.ndarray) -> np.ndarray:
    return _exchange(problem, start, SETTLED)[0]


def _contract(problem: CoupledEquilibrium, pressure: np.ndarray) -> ContactSolution:
    """The contraction at the head of the module, from any pressures to convergence."""
    operator, weights, constraints = problem.operator, problem.weights, problem.constraints
    normal = operator.normal
    share, before = 1.0, np.inf
    displacement, even = problem.apply(pressure), normal.apply(pressure)
    for _ in range(MAX_CONTRACTIONS):
        scaled = constraints
        if not problem.by_load:
            scaled = replace(constraints, approach=share * constraints.approach)
        linear = share * (problem.gap + displacement) - even
        trial = solve_contact(normal, linear, weights, scaled, start=pressure)
        problem.approach = trial.approach / share
        problem.spent["contractions"] += 1
        problem.spent["applications"] += trial.iterations["applications"] + 1
        moved = normal.apply(trial.pressure)
        length = (trial.pressure - pressure) @ (moved - even)  # squared, in the norm of N
        shortened = length < (1.0 - 0.5 * share) * before  # as it must for share < 1.5/(1+k^2)
        share, before = (share, length) if shortened else (0.5 * share, np.inf)
        pressure, even = trial.pressure, moved
        displacement = problem.apply(pressure)
        if length <= SHORTEST**2 * (pressure @ even):
            break
    return _solution(problem, pressure)
