"""Contact where sliding traction moves the surfaces: a complementarity problem without an energy.

    g = G - d w + C p >= 0,   p >= 0,   p g = 0,   w'p = P  (or d given)   and optionally p <= H

with a compliance C that is positive definite but not symmetric (`analytic.operators.tangential`);
symbols as in `analytic.contact.problem`.

Method: block exchanges of the active set on nested grids; on a fixed set GMRES (Saad 2003,
algorithm 9.4, left preconditioning), whose residual, turned into pressures by the approximate
inverse, measures the error of the pressures themselves. Where exchanges make no progress, a
contraction takes over, which unlike them is proved to converge:

    p_k+1 = argmin 1/2 q'Nq + (t (G + C p_k) - N p_k)'q   over the constraints,   N = (C + C')/2,

the projection, in the norm of N, of p_k - t N^-1 (G + C p_k). Two iterates approach each other by
sqrt((1-t)^2 + t^2 k^2), k the size of the skew part in that norm (mu beta for two half-planes under
a given load): below one for t < 2/(1+k^2). t is halved whenever a step has hardly shortened. Each
step is a contact problem of N, `solve_contact`."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from analytic.contact.active_set import ActiveSet
from analytic.contact.equilibrium import Constraints, Equilibrium, EquilibriumProblem
from analytic.contact.exchange import exchange_blocks
from analytic.contact.nested_start import coarse_start
from analytic.contact.problem import ContactSolution, posed, solution_of, solve_contact
from analytic.operators.half_plane import ModelOperator

TIGHT = 1e-10  # error of accurate pressures, in the 2-norm
SPAN = 60  # directions at most; rough contacts were seen to take up to 25

_Vectors = Callable[[np.ndarray], np.ndarray]


class CoupledEquilibrium(EquilibriumProblem):
    """Contact on one grid as a family of linear problems; nothing is asked of the operator but
    that its symmetric part is positive definite."""

    def equilibrium(self, start: np.ndarray, active: ActiveSet, reduction: float) -> Equilibrium:
        """Equilibrium on the free nodes, H and 0 on the others, from `start` (n,) [Pa]. The error
        of the pressures falls to `reduction` of what it is at the start, or to TIGHT."""
        state = super().equilibrium(start, active, reduction)
        if not self.by_load:
            return state
        # GMRES has not applied C to its result: the approach is what that leaves on the average
        weights = self.weights[active.free]
        left = float((weights @ state.weighted_gap[active.free]) / (weights @ weights))
        self.approach += left
        return replace(state, weighted_gap=state.weighted_gap - left * self.weights)

    def _iterate(
        self, nodes: np.ndarray, pressure: np.ndarray, reduction: float
    ) -> tuple[np.ndarray, bool]:
        """Balance the free nodes of `pressure` (n,) by GMRES; Cp, and whether accurately."""
        weights, search = self.weights[nodes], self.search(nodes)
        if self.by_load:
            pressure[nodes] += (self.constraints.load - self.weights @ pressure) * search.lift
        weighted_gap = self.weighted_gap[nodes] + self.weighted_displacement(pressure)[nodes]
        if self.by_load:
            self.approach = float((weights @ weighted_gap) / (weights @ weights))

        def moved(values: np.ndarray) -> np.ndarray:
            line = np.zeros_like(pressure)
            line[nodes] = values
            return search.step(self.apply(line)[nodes])

        error = search.step(weighted_gap - self.approach * weights)
        tight = TIGHT * np.linalg.norm(pressure[nodes])
        goal = max(reduction * np.linalg.norm(error), tight)
        step, left = krylov_step(moved, error, goal)
        pressure[nodes] -= step
        return self.apply(pressure), left <= tight


def krylov_step(apply: _Vectors, target: np.ndarray, goal: float) -> tuple[np.ndarray, float]:
    """y (m,) with the least |target - A y| in the Krylov space of A, until that is `goal`; and what
    it is. One call of `apply` a direction, SPAN directions at most."""
    size = float(np.linalg.norm(target))
    if size <= goal:
        return np.zeros(len(target)), size
    basis, columns = [target / size], []
    rotations: list[tuple[float, float]] = []
    right = [size]
    for step in range(SPAN):
        image = apply(basis[step])
        column = np.empty(step + 2)
        for k, vector in enumerate(basis):
            column[k] = vector @ image
            image = image - column[k] * vector
        column[-1] = left = np.linalg.norm(image)
        for k, (cosine, sine) in enumerate(rotations):
            one, other = column[k], column[k + 1]
            column[k], column[k + 1] = cosine * one + sine * other, cosine * other - sine * one
        radius = np.hypot(column[-2], column[-1])
        if radius == 0.0:
            break  # nothing left but round-off
        cosine, sine = column[-2] / radius, column[-1] / radius
        rotations.append((cosine, sine))
        columns.append(np.append(column[:-2], radius))
        right[-1:] = [cosine * right[-1], -sine * right[-1]]
        if abs(right[-1]) <= goal or left == 0.0:
            break
        basis.append(image / left)
    solution = np.zeros(len(target))
    shares = np.zeros(len(columns))
    for k in reversed(range(len(columns))):
        later = sum(columns[j][k] * shares[j] for j in range(k + 1, len(columns)))
        shares[k] = (right[k] - later) / columns[k][k]
        solution += shares[k] * basis[k]
    return solution, abs(float(right[-1]))


COARSEST = 128  # nodes; below this a coarser start saves nothing
MAX_CONTRACTIONS = 400
SHORTEST = 1e-10  # a contraction step this small, relative in the norm of N, is the last


def solve_coupled(
    operator: ModelOperator,
    weighted_gap: np.ndarray,
    weights: np.ndarray,
    constraints: Constraints,
    start: np.ndarray | None = None,
) -> ContactSolution:
    """Solve the contact problem of this module; residuals are those of the operator itself.

    weighted_gap  G (n,) [m^2]      weights  w (n,) [m]
    start    pressures (n,) [Pa] of a nearby problem; without them a coarser grid supplies them,
             which costs less than the way from the uncoupled solution

    An operator that is not `skew` is left to `solve_contact`. `iterations` counts set exchanges,
    applications of C and contraction steps, on all grids together.
    Raises ContactError if the load exceeds what the hardness can carry. A solution that misses
    KKT_TOLERANCE is returned with `converged` False."""
    if not operator.skew:
        return solve_contact(operator, weighted_gap, weights, constraints, start)
    problem, common = posed(CoupledEquilibrium, operator, weighted_gap, weights, constraints)
    problem.spent["contractions"] = 0
    settled = False
    if start is not None:
        pressure, _, settled = exchange_blocks(problem, start)
    if not settled:
        start = coarse_start(problem, COARSEST)
        pressure, _, settled = exchange_blocks(problem, start)
    solution = solution_of(problem, pressure, common)
    if not (settled or solution.converged):
        solution = solution_of(problem, _contract(problem, solution.pressure), common)
    return solution


def _contract(problem: CoupledEquilibrium, pressure: np.ndarray) -> np.ndarray:
    """Pressures (n,) [Pa] by the contraction at the head of the module, from any."""
    operator, weights, constraints = problem.operator, problem.weights, problem.constraints
    normal = operator.normal
    share, before = 1.0, np.inf
    weighted_displacement, even = problem.apply(pressure), normal.apply(pressure)
    for _ in range(MAX_CONTRACTIONS):
        scaled = constraints
        if not problem.by_load:
            scaled = replace(constraints, approach=share * constraints.approach)
        linear = share * (problem.weighted_gap + weighted_displacement) - even
        trial = solve_contact(normal, linear, weights, scaled, start=pressure)
        problem.approach = trial.approach / share
        problem.spent["contractions"] += 1
        problem.spent["applications"] += trial.iterations["applications"] + 1
        moved = normal.apply(trial.pressure)
        length = (trial.pressure - pressure) @ (moved - even)  # squared, in the norm of N
        shortened = length < (1.0 - 0.5 * share) * before  # as it must for share < 1.5/(1+k^2)
        share, before = (share, length) if shortened else (0.5 * share, np.inf)
        pressure, even = trial.pressure, moved
        weighted_displacement = problem.apply(pressure)
        if length <= SHORTEST**2 * (pressure @ even):
            break
    return pressure
