"""Frictionless contact on hat pressures: a box-constrained quadratic program with one load.

    minimise  1/2 p'Cp + (G - d w)'p   over  0 <= p <= H,   with  w'p = P  (or d given)

    p   nodal pressures [Pa]                G   weighted initial gap, integral phi_i g0 dx [m^2]
    C   compliance [m^2/Pa]                 w   weights, integral phi_i dx [m]
    d   approach [m]                        P   load per length [N/m]
    H   hardness [Pa]                       g   weighted gap G + Cp - dw [m^2]

Its solution satisfies g >= 0 where p = 0, g = 0 where 0 < p < H, g <= 0 where p = H (the overlap
that plastic flow would remove).

Method: an active set (`analytic.contact.exchange`) on nested grids, each started from the next
coarser one (`nested_start`); on a fixed set conjugate gradients (`equilibrium`)."""

from dataclasses import astuple, dataclass, replace

import numpy as np

from analytic.contact.equilibrium import SET_TOLERANCE, Constraints, EquilibriumProblem
from analytic.contact.exchange import exchange
from analytic.contact.nested_start import coarse_start
from analytic.operators.half_plane import ModelOperator

EVEN = 1e-5  # of the displacement: rounding, 1e-14 of it, must not count as a residual
KKT_TOLERANCE = 1e-8  # all residuals of a solution that counts as converged


class ContactError(ArithmeticError):
    """The contact problem has no solution, or none was found."""


@dataclass(frozen=True)
class Residuals:
    """Residuals of the contact conditions; all dimensionless, zero when exact. The displacement
    scale is the range of Cp/w over all nodes, or EVEN of its largest amount where the surface moves
    as a whole; with the approach prescribed it is the largest amount."""

    load_balance: float  # |w'p - P| / P (zero when the approach is prescribed)
    # p'|g| over the nodes below the hardness and p'g over those at it that are open / (P times the
    # displacement scale)
    complementarity: float
    penetration: float  # largest overlap where p < H / the displacement scale
    negative_pressure: float  # largest tension / the largest pressure
    excess_pressure: float  # largest pressure above H / H

    @property
    def worst(self) -> float:
        """The largest of them; not a number if one is none."""
        return float(np.max(astuple(self)))


@dataclass(frozen=True)
class ContactSolution:
    """Solution of the contact problem on one grid."""

    pressure: np.ndarray  # (n,) [Pa]
    gap: np.ndarray  # (n,) weighted gap over weight, g_i / w_i [m]; negative at capped nodes
    approach: float  # d [m], relative to the operator's datum
    load: float  # w'p [N/m]
    residuals: Residuals  # the contact conditions, evaluated once more with the operator itself
    iterations: dict  # set exchanges and operator applications, on all grids together
    converged: bool  # all residuals below KKT_TOLERANCE


def assessed(
    weighted_displacement: np.ndarray,
    pressure: np.ndarray,
    weighted_gap: np.ndarray,
    weights: np.ndarray,
    approach: float,
    constraints: Constraints,
    iterations: dict[str, int],
    tolerance: float = KKT_TOLERANCE,
) -> ContactSolution:
    """Pressures (n,) [Pa] with their Cp (n,) [m^2] as a solution, `converged` to `tolerance`."""
    hardness = np.broadcast_to(constraints.hardness, weights.shape)
    gap = (weighted_gap + weighted_displacement) / weights - approach
    lowered = weighted_displacement / weights
    largest = np.max(np.abs(lowered))
    scale = largest if constraints.load is None else max(np.ptp(lowered), EVEN * largest)
    scale = scale or max(0.0, -np.min(gap)) or 1.0  # overlapping without pressure
    load = weights @ pressure
    highest = np.max(pressure)
    free = pressure < hardness * (1.0 - SET_TOLERANCE)
    capped = hardness > 0.0
    error = 0.0 if constraints.load is None else abs(load - constraints.load) / constraints.load
    apart = np.where(free, np.abs(gap), np.maximum(gap, 0.0))
    work = np.sum(weights * np.abs(pressure) * apart)
    residuals = Residuals(
        load_balance=error,
        complementarity=work / load / scale if load > 0.0 else 0.0,
        penetration=max(0.0, -np.min(gap[free], initial=0.0)) / scale,
        negative_pressure=max(0.0, -np.min(pressure)) / highest if highest > 0.0 else 0.0,
        excess_pressure=max(0.0, np.max(pressure[capped] / hardness[capped]) - 1.0),
    )
    return ContactSolution(
        pressure=pressure,
        gap=gap,
        approach=float(approach),
        load=float(load),
        residuals=residuals,
        iterations=dict(iterations),
        converged=bool(residuals.worst <= tolerance),
    )


def solve_contact(
    operator: ModelOperator,
    weighted_gap: np.ndarray,
    weights: np.ndarray,
    constraints: Constraints,
    start: np.ndarray | None = None,
) -> ContactSolution:
    """Solve the contact problem of this module.

    weighted_gap  G (n,) [m^2]      weights  w (n,) [m]
    start         pressures (n,) [Pa] of a nearby problem; without them a coarser grid supplies them

    Raises ContactError if the load exceeds what the hardness can carry. A solution that misses
    KKT_TOLERANCE is returned with `converged` False."""
    problem, common = posed(EquilibriumProblem, operator, weighted_gap, weights, constraints)
    if start is None:
        start = coarse_start(problem)
    return solution_of(problem, exchange(problem, start), common)


def posed(
    kind: type[EquilibriumProblem],
    operator: ModelOperator,
    weighted_gap: np.ndarray,
    weights: np.ndarray,
    constraints: Constraints,
) -> tuple[EquilibriumProblem, float]:
    """The problem without its `common_gap`, and that [m]. Raises ContactError if a prescribed load
    exceeds what the hardness can carry."""
    most = constraints.carried(np.ones(len(weights), dtype=bool), weights)
    if constraints.load is not None and constraints.load >= most:
        raise ContactError(
            f"the load {constraints.load:g} N/m exceeds what the surface can carry at the "
            f"hardness: {most:g} N/m"
        )
    common, constraints = common_gap(weighted_gap, weights, constraints)
    spent = {"exchanges": 0, "applications": 0}
    return kind(operator, weighted_gap - common * weights, weights, constraints, spent), common


def solution_of(
    problem: EquilibriumProblem, pressure: np.ndarray, common: float
) -> ContactSolution:
    """Pressures (n,) [Pa], within the box, as a solution of a `posed` problem."""
    limits = problem.constraints
    pressure = np.clip(pressure, 0.0, limits.hardness)
    moved, gap_and_weights = problem.apply(pressure), (problem.weighted_gap, problem.weights)
    solution = assessed(moved, pressure, *gap_and_weights, problem.approach, limits, problem.spent)
    return replace(solution, approach=solution.approach + common)


def common_gap(
    weighted_gap: np.ndarray, weights: np.ndarray, constraints: Constraints
) -> tuple[float, Constraints]:
    """The part of the gap [m] that the approach absorbs, and the constraints without it. Far larger
    than what a light load closes, it would drown that in rounding."""
    if constraints.approach is None:
        return float(np.min(weighted_gap / weights)), constraints
    return constraints.approach, replace(constraints, approach=0.0)
