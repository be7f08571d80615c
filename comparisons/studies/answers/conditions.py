"""Residuals of an answer's pressures in the scene's problem, whoever computed them.

They are put on the models' own pressure elements, and the contact conditions are evaluated with the
models' operators: the half-plane's always, the finite elements' where they are linear bodies under
vertical pressures, on the coarsest level. With the approach the gap vanishes on average, weighted
by pressure. Interpolation between points at a spacing s leaves a residual of order (s/a)^1.5.
"""

from collections.abc import Mapping
from dataclasses import asdict

from analytic.contact.problem import assessed
from analytic.grid import HatGrid
from analytic.operators.half_plane import ComplianceOperator
from comparisons.models.level import Solution
from comparisons.models.operators import operator_of
from comparisons.models.problem import Problem
from comparisons.studies.answers.answer import Answer


def operators_of(
    problem: Problem, runs: Mapping[str, Solution]
) -> dict[str, tuple[HatGrid, ComplianceOperator]]:
    """Pressure elements and compliance by model."""
    grid = list(runs.values())[-1].finest.grid
    half_plane = operator_of(problem, grid, problem.half_plane_effects)
    operators: dict[str, tuple[HatGrid, ComplianceOperator]] = {"half_plane": (grid, half_plane)}
    if "finite_element" in runs and not problem.scene.finite_element.nonlinear:
        from comparisons.models.finite_element.contact import compliance_again

        level = runs["finite_element"].levels[0]
        operators["finite_element"] = level.grid, compliance_again(problem, level)
    return operators


def conditions(
    answer: Answer, problem: Problem, operators: Mapping[str, tuple[HatGrid, ComplianceOperator]]
) -> dict[str, dict]:
    """`Residuals` by model, but for the load; relative and zero when exact."""
    residuals = {}
    for name, (grid, operator) in operators.items():
        pressure = answer.on(grid.x)
        gap = grid.hat_integrals(problem.finite_element_gap, problem.knots)
        moved, load = operator.apply(pressure), float(grid.weights @ pressure)
        approach = float(pressure @ (gap + moved)) / load if load > 0.0 else 0.0
        solved = moved, pressure, gap, grid.weights, approach, problem.constraints()
        residuals[name] = asdict(assessed(*solved, iterations={}).residuals)
        del residuals[name]["load_balance"]  # the answer's own points have it
    return residuals
