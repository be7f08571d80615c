"""How well an answer's pressures solve the scene's problem, whoever computed them.

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
from analytic.operators.tangential import CoupledHalfPlane
from comparisons.common.progress import Stages
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.studies.answers.answer import Answer


def operators_of(
    problem: Problem, plan: Plan, runs: Mapping[str, ModelRun]
) -> dict[str, tuple[HatGrid, ComplianceOperator]]:
    """Pressure elements and compliance by model."""
    grid = list(runs.values())[-1].finest.grid
    half_plane = CoupledHalfPlane(grid.count, grid.pitch, problem.modulus, problem.coupling)
    operators: dict[str, tuple[HatGrid, ComplianceOperator]] = {"half_plane": (grid, half_plane)}
    settings = problem.scene.finite_element
    linear = settings.deformation == "linear" and not settings.plastic
    if "finite_element" in runs and linear:
        level = runs["finite_element"].levels[0]
        operators["finite_element"] = level.grid, _finite_elements(problem, plan, level)
    return operators


def conditions(
    answer: Answer, problem: Problem, operators: Mapping[str, tuple[HatGrid, ComplianceOperator]]
) -> dict[str, dict]:
    """`Residuals` by model, but for the load; relative and zero when exact."""
    return {
        name: _residuals(answer, problem, grid, operator)
        for name, (grid, operator) in operators.items()
    }


def _residuals(
    answer: Answer, problem: Problem, grid: HatGrid, operator: ComplianceOperator
) -> dict[str, float]:
    pressure = answer.on(grid.x)
    gap = grid.hat_integrals(problem.finite_element_gap, problem.knots)
    moved, load = operator.apply(pressure), float(grid.weights @ pressure)
    approach = float(pressure @ (gap + moved)) / load if load > 0.0 else 0.0
    solved = moved, pressure, gap, grid.weights, approach, problem.constraints()
    residuals = asdict(assessed(*solved, iterations={}).residuals)
    del residuals["load_balance"]  # the answer's own points have it
    return residuals


def _finite_elements(problem: Problem, plan: Plan, level: Level) -> ComplianceOperator:
    """The compliance of the scene's finite elements on a level, made again."""
    from comparisons.models.finite_element.bodies import BodyCache, bodies_of
    from comparisons.models.finite_element.contact import mutual_compliance
    from comparisons.models.finite_element.mesh import Refinement

    refinement = Refinement(level.grid.pitch)
    bodies = bodies_of(problem, plan, refinement, level.patches, Stages(), BodyCache())
    return mutual_compliance(problem, bodies, level.grid)
