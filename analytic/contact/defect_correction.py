"""Contact on an expensive compliance operator, by way of a cheap model of it.

The operator C (finite elements: one back-substitution an application) is close to a model D (the
Galerkin half-plane of the same hats, the surfaces moved by friction included). Each step solves

    p = solution of the model's problem with G + r for G,     r wanted such that r = (C - D) p.

The misfit f(r) = (C - D) p - r is the gap by which p misses the contact conditions on C. Secants
through the last steps (Anderson 1965; Walker and Ni 2011), F and R the differences of f and of r,

    y = argmin |f - F y| over the nodes in contact,    r <- r - R y + s (f - F y),    s = 1,

make a model of the wrong stiffness, or a layer thinner than the contact, harmless. Mixing r instead
of p keeps every p within the constraints. There is no energy to descend on where friction makes C
unsymmetric: when PATIENCE steps have not improved on the best one, the iteration goes back to it,
forgets the secants and halves s.

A half-plane's displacements are defined up to a constant. Under a prescribed load the approach
takes that up; under a prescribed approach the model first gets the datum with which (C - D) p does
no work on some p. Symbols as in `analytic.contact.problem`."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import SET_TOLERANCE, Constraints
from analytic.contact.problem import (
    KKT_TOLERANCE,
    ContactSolution,
    assessed,
    common_gap,
)
from analytic.operators.half_plane import ComplianceOperator, HalfPlane, ModelOperator

MAX_STEPS = 40
SECANTS = 2  # with one, half as many steps again over 144 cases; with three, no fewer
PATIENCE = 3  # four lose time on what does not lead on, two lose secants that do
SECANT_RANK = 1e-10  # of the larger difference: below, the two point the same way


def solve_with_model(
    operator: ComplianceOperator,
    model: ModelOperator,
    weighted_gap: np.ndarray,
    weights: np.ndarray,
    constraints: Constraints,
    start: np.ndarray | None = None,
    tolerance: float = KKT_TOLERANCE,
    nearer: bool = False,
    bearing: Callable[[np.ndarray], float] | None = None,
) -> ContactSolution:
    """Solve the contact problem of `operator`; residuals are those of `operator` itself.

    operator      C: its symmetric part must be positive definite, nothing else
    weighted_gap  G (n,) [m^2]      weights  w (n,) [m]
    start         pressures (n,) [Pa] of a nearby problem
    nearer        whether `start` is nearer to the solution than what the model alone predicts: r
                  begins with (C - D) start
    bearing       load [N/m] that pressures (n,) [Pa] are to have once `operator` was applied to
                  them; None: that of the constraints

    A poor model costs steps, not accuracy: what misses `tolerance` after MAX_STEPS is returned,
    the best of all steps, with `converged` False.
    `iterations` counts the steps and the applications of C and of D; C is applied once
    more than there are steps at a given approach on a half-plane, and if `start` is `nearer`."""
    common, constraints = common_gap(weighted_gap, weights, constraints)
    weighted_gap = weighted_gap - common * weights
    pressure, carried, share = start, np.zeros_like(weighted_gap), 1.0
    path: list[tuple[np.ndarray, np.ndarray]] = []  # r and f of the last steps
    best, model_applications, probes = None, 0, 0
    if constraints.approach is not None and isinstance(model, HalfPlane):
        # at the datum of the operator, as seen under the start or an even pressure
        seen = start if start is not None and start.any() else np.ones_like(weights)
        work = seen @ (operator.apply(seen) - model.apply(seen))
        model = model.on_base(work / (weights @ seen) ** 2)
        model_applications, probes = 1, 1
    if nearer:
        carried = operator.apply(start) - model.apply(start)
        model_applications, probes = model_applications + 1, probes + 1
        if bearing is not None:
            constraints = replace(constraints, load=bearing(start))
    for step in range(1, MAX_STEPS + 1):
        trial = solve_coupled(model, weighted_gap + carried, weights, constraints, pressure)
        model_applications += 1 + trial.iterations["applications"]
        pressure = trial.pressure
        weighted_displacement = operator.apply(pressure)
        counts = {"steps": step, "applications": step + probes}
        counts["model_applications"] = model_applications
        free = _free(pressure, constraints)
        if bearing is not None:
            constraints = replace(constraints, load=bearing(pressure))
        approach = constraints.approach
        if approach is None:  # the one that closes the mean gap of the free nodes
            carriers = np.where(free, pressure, 0.0)
            left = weighted_gap + weighted_displacement
            approach = float(carriers @ left / (carriers @ weights))
        contact = weighted_displacement, pressure, weighted_gap, weights
        solution = assessed(*contact, approach, constraints, counts, tolerance)
        misfit = weighted_displacement - model.apply(pressure) - carried
        if constraints.approach is None:  # the approach takes up what is common to all nodes
            misfit -= (weights @ misfit) / (weights @ weights) * weights
        if best is None or solution.residuals.worst < best.residuals.worst:
            best, since = solution, 0
            back = carried, misfit
        else:
            since += 1
        if solution.converged:
            break
        if since == PATIENCE:
            pressure, (carried, misfit) = best.pressure, back
            free, path = _free(pressure, constraints), []
            share, since = 0.5 * share, 0
        path = [*path[-SECANTS:], (carried, misfit)]
        carried = _onward(path, free, share)
    return replace(best, approach=best.approach + common, iterations=counts)


def _onward(
    path: list[tuple[np.ndarray, np.ndarray]], nodes: np.ndarray, share: float
) -> np.ndarray:
    """The next r (n,) [m^2] from the pairs (r, f) of the last steps, the newest last."""
    carried, misfit = path[-1]
    if len(path) > 1:
        steps = np.stack([carried - former for former, _ in path[:-1]], axis=1)
        changes = np.stack([misfit - former for _, former in path[:-1]], axis=1)
        amounts = np.linalg.lstsq(changes[nodes], misfit[nodes], rcond=SECANT_RANK)[0]
        carried, misfit = carried - steps @ amounts, misfit - changes @ amounts
    return carried + share * misfit


def _free(pressure: np.ndarray, constraints: Constraints) -> np.ndarray:
    """Nodes (n,) that touch and are below the hardness; where there are none, all that touch."""
    touching = pressure > 0.0
    free = touching & (pressure < constraints.hardness * (1.0 - SET_TOLERANCE))
    return free if free.any() else touching
