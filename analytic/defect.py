"""Contact on an expensive compliance operator, by way of a cheap model of it.

The operator C (finite elements: one back-substitution an application) is close to a model D
(the Galerkin half-plane of the same hats). Each step solves the contact problem of the model
with the defect of the last iterate carried to the linear term,

    q = argmin 1/2 p'Dp + (G + (C - D) p_k - d w)'p   over the constraints of the problem,
    p_k+1 = p_k + t (q - p_k),   t the minimiser of the energy 1/2 p'Cp + G'p on the segment,

so that one application of C is spent a step and the energy of the true problem never rises.
Symbols as in `analytic.contact`.
"""

from dataclasses import replace

import numpy as np

from analytic.contact import (
    KKT_TOLERANCE,
    ContactSolution,
    assessed,
    common_gap,
    solve_contact,
)
from analytic.equilibrium import SET_TOLERANCE, Constraints
from analytic.operators import ComplianceOperator, ModelOperator

MAX_STEPS = 40


def solve_with_model(
    operator: ComplianceOperator,
    model: ModelOperator,
    gap: np.ndarray,
    weights: np.ndarray,
    constraints: Constraints,
    start: np.ndarray | None = None,
    tolerance: float = KKT_TOLERANCE,
) -> ContactSolution:
    """Solve the contact problem of `operator`; residuals are those of `operator` itself.

    gap G (n,) [m^2], weights w (n,) [m], start: pressures (n,) [Pa] of a nearby problem.
    A model of the wrong stiffness costs steps, not accuracy: what misses `tolerance` after
    MAX_STEPS, or stops improving, is returned with `converged` False.
    `iterations` counts the steps and the applications of C and of D.
    """
    common, constraints = common_gap(gap, weights, constraints)
    gap = gap - common * weights
    trial = solve_contact(model, gap, weights, constraints, start)
    pressure, displacement = trial.pressure, operator.apply(trial.pressure)
    model_applications = trial.iterations["applications"]
    best = None
    for step in range(1, MAX_STEPS + 1):
        approach = _approach(displacement, pressure, gap, weights, constraints)
        counts = {"steps": step, "applications": step, "model_applications": model_applications}
        solution = assessed(
            displacement, pressure, gap, weights, approach, constraints, counts, tolerance
        )
        if best is None or solution.residuals.worst < best.residuals.worst:
            best, since_best = solution, 0
        else:
            since_best += 1
        if solution.converged or since_best == 4:
            break
        defect = displacement - model.apply(pressure)
        trial = solve_contact(model, gap + defect, weights, constraints, start=pressure)
        model_applications += 1 + trial.iterations["applications"]
        direction = trial.pressure - pressure
        image = operator.apply(trial.pressure) - displacement
        # w'(q - p) is zero where the load is prescribed; taking the approach off anyway keeps
        # its round-off, times a large constant, out of the slope
        slope = direction @ (gap + displacement - approach * weights)
        curvature = direction @ image
        length = np.clip(-slope / curvature, 0.0, 1.0) if curvature > 0.0 else 1.0
        pressure = pressure + length * direction
        displacement = displacement + length * image
    return replace(best, approach=best.approach + common, iterations=counts)


def _approach(
    displacement: np.ndarray,
    pressure: np.ndarray,
    gap: np.ndarray,
    weights: np.ndarray,
    constraints: Constraints,
) -> float:
    """The approach as prescribed, or the one that closes the mean gap of the free nodes [m]."""
    if constraints.approach is not None:
        return constraints.approach
    free = (pressure > 0.0) & (pressure < constraints.hardness * (1.0 - SET_TOLERANCE))
    carriers = np.where(free, pressure, 0.0) if free.any() else pressure
    return float(carriers @ (gap + displacement) / (carriers @ weights))
