"""Frictionless contact on hat pressures: a box-constrained quadratic program with one load.

    minimise  1/2 p'Cp + (G - d w)'p   over  0 <= p <= H,   with  w'p = P  (or d given)

    p   nodal pressures [Pa]                G   weighted initial gap, integral phi_i g0 dx [m^2]
    C   compliance [m^2/Pa]                 w   weights, integral phi_i dx [m]
    d   approach [m]                        P   load per length [N/m]
    H   hardness [Pa]                       g   weighted gap G + Cp - dw [m^2]

Its solution satisfies g >= 0 where p = 0, g = 0 where 0 < p < H, g <= 0 where p = H (the overlap
that plastic flow would remove).

Method: primal-dual active set (block principal pivoting) on a hierarchy of grids, each solved
from the solution of the next coarser one. On a fixed set the pressures follow from conjugate
gradients projected on the load constraint (Gould, Hribar and Nocedal 2001, algorithm 2) and
preconditioned by the operator's approximate inverse. Block exchanges may cycle; when the number
of nodes that break a sign condition has not fallen for `PATIENCE` exchanges, the solver changes
to the primal active-set method with single exchanges from a feasible point, whose energy falls
strictly at every step, so that no set returns and it ends after finitely many.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from analytic.operators import ComplianceOperator

COARSEST = 64  # nodes; below this a coarser start saves nothing
PATIENCE = 8  # block exchanges without progress before single ones (Júdice and Pires use 10)
LOOSE, TIGHT = 1e-2, 1e-11  # inner relative residual while the set moves, and at the end
SET_TOLERANCE = 1e-10  # sign conditions, relative to the largest pressure and displacement
KKT_TOLERANCE = 1e-8  # all residuals of a solution that counts as converged
MAX_EXCHANGES = 200


class ContactError(ArithmeticError):
    """The contact problem has no solution, or none was found."""


class ModelOperator(ComplianceOperator, Protocol):
    """A compliance that also offers an approximate inverse and a coarser version of itself."""

    count: int

    def precondition(self, displacement: np.ndarray) -> np.ndarray: ...

    def coarsened(self) -> "ModelOperator": ...


@dataclass(frozen=True)
class Constraints:
    """Exactly one of `load` P [N/m] and `approach` d [m]; `hardness` H [Pa] caps the pressure."""

    load: float | None = None
    approach: float | None = None
    hardness: float = np.inf

    def __post_init__(self) -> None:
        if (self.load is None) == (self.approach is None):
            raise ValueError("prescribe either the load or the approach")
        if self.load is not None and not (np.isfinite(self.load) and self.load > 0.0):
            raise ValueError(f"the load per length must be positive, not {self.load:g} N/m")
        if not self.hardness > 0.0:
            raise ValueError(f"the hardness must be positive, not {self.hardness:g} Pa")


@dataclass(frozen=True)
class Residuals:
    """How well the contact conditions hold; all dimensionless, zero when exact.

    load_balance       |w'p - P| / P (zero when the approach is prescribed)
    complementarity    p'|g| over the free nodes / (P times the displacement scale)
    penetration        largest overlap where p < H / the displacement scale
    negative_pressure  largest tension / the largest pressure
    excess_pressure    largest pressure above H / H

    The displacement scale is the range of Cp/w over all nodes.
    """

    load_balance: float
    complementarity: float
    penetration: float
    negative_pressure: float
    excess_pressure: float

    @property
    def worst(self) -> float:
        return max(
            self.load_balance,
            self.complementarity,
            self.penetration,
            self.negative_pressure,
            self.excess_pressure,
        )


@dataclass(frozen=True)
class ContactSolution:
    """Solution of the contact problem on one grid.

    pressure    (n,) [Pa]
    gap         (n,) weighted gap over weight, g_i / w_i [m]; negative at capped nodes
    approach    d [m], relative to the operator's datum
    load        w'p [N/m]
    residuals   the contact conditions, evaluated once more with the operator itself
    iterations  set exchanges and operator applications, on all grids together
    converged   all residuals below KKT_TOLERANCE
    """

    pressure: np.ndarray
    gap: np.ndarray
    approach: float
    load: float
    residuals: Residuals
    iterations: dict
    converged: bool


def contact_residuals(
    displacement: np.ndarray,
    pressure: np.ndarray,
    gap: np.ndarray,
    weights: np.ndarray,
    approach: float,
    constraints: Constraints,
) -> tuple[np.ndarray, Residuals]:
    """Gap (n,) [m] and residuals, from Cp (n,) [m^2], weighted initial gap (n,) and approach."""
    hardness = constraints.hardness
    actual = (gap + displacement) / weights - approach
    lowered = displacement / weights
    scale = np.ptp(lowered) or np.max(np.abs(lowered)) or 1.0
    load = weights @ pressure
    highest = np.max(pressure)
    free = pressure < hardness * (1.0 - SET_TOLERANCE)
    error = 0.0 if constraints.load is None else abs(load - constraints.load) / constraints.load
    work = np.sum(weights[free] * np.abs(pressure[free] * actual[free]))
    residuals = Residuals(
        load_balance=error,
        complementarity=work / (load * scale) if load > 0.0 else 0.0,
        penetration=max(0.0, -np.min(actual[free], initial=0.0)) / scale,
        negative_pressure=max(0.0, -np.min(pressure)) / highest if highest > 0.0 else 0.0,
        excess_pressure=max(0.0, highest / hardness - 1.0),
    )
    return actual, residuals


def solve_contact(
    operator: ModelOperator,
    gap: np.ndarray,
    weights: np.ndarray,
    constraints: Constraints,
    start: np.ndarray | None = None,
) -> ContactSolution:
    """Solve the contact problem of this module.

    gap      G (n,) [m^2]         weights  w (n,) [m]
    start    pressures (n,) [Pa] of a nearby problem; without them a coarser grid supplies them

    Raises ContactError if the load exceeds what the hardness can carry. A solution that misses
    KKT_TOLERANCE is returned with `converged` False.
    """
    if constraints.load is not None and constraints.load >= constraints.hardness * weights.sum():
        raise ContactError(
            f"the load {constraints.load:g} N/m exceeds what the surface can carry at the "
            f"hardness: {constraints.hardness * weights.sum():g} N/m"
        )
    spent = {"exchanges": 0, "applications": 0}
    if start is None:
        start = _coarse_start(operator, gap, weights, constraints, spent)
    problem = _Problem(operator, gap, weights, constraints, spent)
    pressure = _exchange_blocks(problem, start, constraints.hardness)
    return problem.solution(pressure)


def _coarse_start(operator, gap, weights, constraints, spent) -> np.ndarray:
    """Pressures interpolated from the grid of twice the pitch (its node j is node 2j + 1 here)."""
    count = len(gap)
    if count < 2 * COARSEST:
        return np.full(count, min(1.0, 0.5 * constraints.hardness))
    inner = 2 * np.arange(count // 2) + 1

    def restrict(values: np.ndarray) -> np.ndarray:
        padded = np.append(values, values[-1])  # an even count: the last hat leans on a copy
        return 0.5 * padded[inner - 1] + padded[inner] + 0.5 * padded[inner + 1]

    coarse = solve_contact(operator.coarsened(), restrict(gap), restrict(weights), constraints)
    for key, value in coarse.iterations.items():
        spent[key] += value
    padded = np.concatenate(([0.0], coarse.pressure, [0.0]))
    start = np.empty(count)
    start[1::2] = coarse.pressure[: len(start[1::2])]
    between = 0.5 * (padded[:-1] + padded[1:])
    start[0::2] = between[: len(start[0::2])]
    return start


def _exchange_blocks(problem: "_Problem", start: np.ndarray, hardness: float) -> np.ndarray:
    """Primal-dual active set: every node that breaks its sign condition changes sides at once."""
    pressure, tolerance = start, LOOSE
    sides = _Sides.of(start, hardness)
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
    return _exchange_singly(problem, pressure, hardness)


def _exchange_singly(problem: "_Problem", start: np.ndarray, hardness: float) -> np.ndarray:
    """Primal active set from a feasible point: one node is freed at a time, the energy falls."""
    pressure = problem.feasible(start)
    sides = _Sides.of(pressure, hardness)
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
            sides = _Sides(
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
        sides = _Sides(sides.lower & ~worst, sides.upper & ~worst)
    return pressure


@dataclass(frozen=True)
class _Broken:
    """Nodes whose sign condition fails: tension, pressure beyond H, overlap, a gap under p = H."""

    tensile: np.ndarray
    excessive: np.ndarray
    joining: np.ndarray
    softening: np.ndarray

    def count(self) -> int:
        return sum(
            int(np.count_nonzero(nodes))
            for nodes in (self.tensile, self.excessive, self.joining, self.softening)
        )


@dataclass(frozen=True)
class _Sides:
    """Which nodes are held at p = 0 (`lower`) and at p = H (`upper`); the others are free."""

    lower: np.ndarray
    upper: np.ndarray

    @classmethod
    def of(cls, pressure: np.ndarray, hardness: float) -> "_Sides":
        return cls(pressure <= 0.0, pressure >= hardness)

    @property
    def free(self) -> np.ndarray:
        return ~(self.lower | self.upper)

    def exchanged(self, broken: _Broken) -> "_Sides":
        return _Sides(
            (self.lower & ~broken.joining) | broken.tensile,
            (self.upper & ~broken.softening) | broken.excessive,
        )


class _Problem:
    """The data of one grid, with the counters and the last approach found."""

    def __init__(self, operator, gap, weights, constraints, spent) -> None:
        self.operator, self.gap, self.weights = operator, gap, weights
        self.constraints, self.spent = constraints, spent
        self.by_load = constraints.load is not None
        self.approach = 0.0 if self.by_load else constraints.approach

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        self.spent["applications"] += 1
        return self.operator.apply(pressure)

    def feasible(self, pressure: np.ndarray) -> np.ndarray:
        """Nearest pressures in the box that carry the load: one shift, found by bisection."""
        hardness = self.constraints.hardness
        pressure = np.clip(pressure, 0.0, hardness)
        if not self.by_load:
            return pressure
        mean = self.constraints.load / self.weights.sum()
        low, high = -np.max(pressure), mean + min(hardness, np.max(pressure) + mean)
        for _ in range(200):
            shift = 0.5 * (low + high)
            carried = self.weights @ np.clip(pressure + shift, 0.0, hardness)
            low, high = (shift, high) if carried < self.constraints.load else (low, shift)
        return np.clip(pressure + high, 0.0, hardness)

    def broken_signs(self, pressure: np.ndarray, gap: np.ndarray, sides: _Sides) -> _Broken:
        """Sign conditions of the module's head, to SET_TOLERANCE of the largest figures."""
        hardness = self.constraints.hardness
        slack = SET_TOLERANCE * np.max(np.abs(pressure))
        overlap = SET_TOLERANCE * np.ptp(gap)
        free = sides.free
        return _Broken(
            tensile=free & (pressure < -slack),
            excessive=free & (pressure > hardness + slack),
            joining=sides.lower & (gap < -overlap),
            softening=sides.upper & (gap > overlap),
        )

    def equilibrium(
        self, start: np.ndarray, sides: _Sides, tolerance: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """Pressures with g = 0 on the free nodes, H and 0 on the others, and the load; also g (n,).

        Conjugate gradients on the free nodes. With the load prescribed the search stays in
        w'p = P and the approach is the multiplier.
        """
        self.spent["exchanges"] += 1
        weights, free = self.weights, sides.free
        pressure = np.where(free, start, 0.0)
        pressure[sides.upper] = self.constraints.hardness
        if self.by_load and not free.any():
            free = np.zeros_like(free)
            free[np.argmin(np.where(sides.lower, self.gap / weights, np.inf))] = True
        residual = self.gap + self.apply(pressure)
        if not free.any():
            return pressure, residual - self.approach * weights

        def approximate_inverse(values: np.ndarray) -> np.ndarray:
            return np.where(free, self.operator.precondition(np.where(free, values, 0.0)), 0.0)

        if self.by_load:
            lift = approximate_inverse(weights)
            lift /= weights @ lift  # the pressures that carry a unit load
            correction = (self.constraints.load - weights @ pressure) * lift
            pressure += correction
            residual += self.apply(correction)
        goal = tolerance * self._displacement_norm(residual, free)
        direction, slope_before = np.zeros_like(weights), 1.0
        for _ in range(10 * len(weights) + 10):
            if self.by_load:
                self.approach = lift @ residual
            masked = np.where(free, residual - self.approach * weights, 0.0)
            if np.linalg.norm(masked) <= goal:
                break
            step = approximate_inverse(masked)
            if self.by_load:
                step -= lift * (weights @ step)
            slope = masked @ step
            direction = step + (slope / slope_before) * direction
            slope_before = slope
            image = self.apply(direction)
            curvature = direction @ image
            if not (slope > 0.0 and curvature > 0.0):
                break  # nothing left but round-off
            pressure -= (slope / curvature) * direction
            residual -= (slope / curvature) * image
        return pressure, residual - self.approach * weights

    def _displacement_norm(self, residual: np.ndarray, free: np.ndarray) -> float:
        """Size of the displacements that the free nodes have to balance [m^2]."""
        balanced = (residual - self.gap)[free]
        if self.by_load:
            balanced = balanced - balanced.mean()
        return max(np.linalg.norm(balanced), np.finfo(float).tiny)

    def solution(self, pressure: np.ndarray) -> ContactSolution:
        pressure = np.clip(pressure, 0.0, self.constraints.hardness)
        actual, residuals = contact_residuals(
            self.apply(pressure),
            pressure,
            self.gap,
            self.weights,
            self.approach,
            self.constraints,
        )
        return ContactSolution(
            pressure=pressure,
            gap=actual,
            approach=float(self.approach),
            load=float(self.weights @ pressure),
            residuals=residuals,
            iterations=dict(self.spent),
            converged=bool(residuals.worst <= KKT_TOLERANCE),
        )
