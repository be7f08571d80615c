"""One contact by one of the methods whose cost is measured, at one setting."""

from dataclasses import dataclass, replace

import numpy as np

from analytic.contact.problem import ContactSolution, solve_contact
from analytic.grid import HatGrid
from analytic.numerics import runs_of
from analytic.operators.half_plane import HalfPlane
from analytic.stress.field import friction_field
from analytic.stress.maxima import stress_maxima
from analytic.stress_state import StressState
from comparisons.campaigns.cost.methods import SolutionMethod
from comparisons.common.progress import Stages
from comparisons.models.half_plane import half_plane_level
from comparisons.models.level import Level, StressResult
from comparisons.models.plan import make_plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window, search_window
from comparisons.studies.contact import values_of


@dataclass(frozen=True)
class SolvedContact:
    """The compared quantities of a solution."""

    # one table a friction coefficient: peak_pressure, contact_length, …, SI
    figures: tuple[dict[str, float], ...]
    # x, pressure: (n,) [m], [Pa] nodes of the pressure, linear between them, zero at both ends
    x: np.ndarray
    pressure: np.ndarray
    # one a friction coefficient on the scene's window, empty without
    stresses: tuple[StressResult, ...]
    elements: int  # of pressure
    unknowns: int
    converged: bool
    level: Level | None  # the solution as a level of a run, without its mesh; None of strips


def solved(
    method: SolutionMethod,
    problem: Problem,
    setting: float,
    window: Window | None,
    stages: Stages,
    half_block: bool = False,
) -> SolvedContact:
    """Solve; `half_block` holds an unbounded body at half the distance."""
    if method.model == "half_plane":
        if method.element == "hat":
            plan = make_plan(problem, ("half_plane",))
            return _of_level(half_plane_level(problem, setting, window, stages), problem)
        return _of_level(_by_strips(problem, setting, window, stages), problem)
    scene = problem.scene.unchecked({"finite_element.element": method.element})
    problem = replace(problem, scene=scene)
    from comparisons.models.finite_element.level import LevelOptions, finite_element_level
    from comparisons.models.finite_element.mesh import Refinement

    plan = make_plan(problem, ("finite_element",))
    given = problem, plan, Refinement(setting, half_block), window, stages
    level = finite_element_level(*given, options=LevelOptions(fields=False))
    return _of_level(replace(level, mesh=None), problem)


def _of_level(level: Level, problem: Problem) -> SolvedContact:
    pressure = level.solution.pressure
    return SolvedContact(
        figures=tuple(
            values_of(level, problem, friction) for friction in problem.scene.load.friction
        ),
        x=level.grid.pitch * np.arange(level.grid.first - 1, level.grid.last + 2),
        pressure=np.concatenate([[0.0], pressure, [0.0]]),
        stresses=level.stresses,
        elements=level.grid.count,
        unknowns=level.unknowns,
        converged=level.solution.converged,
        level=level,
    )


def _by_strips(problem: Problem, pitch: float, window: Window | None, stages: Stages) -> Level:
    grid = problem.grid(pitch)
    with stages.stage("contact"):
        operator = HalfPlane(grid.count, pitch, problem.modulus, element="strip")
        weighted_gap = pitch * problem.gap(grid.x)
        solution = solve_contact(operator, weighted_gap, grid.weights, problem.constraints())
        patches, zero = touching_strips(grid, solution), np.zeros(grid.count)
        level = Level(grid, solution, zero, patches, stages.seconds, unknowns=grid.count)
    if window is None:
        return level
    with stages.stage("stresses"):
        return replace(level, stresses=_stresses(problem, level, window))


def touching_strips(grid: HatGrid, solution: ContactSolution) -> np.ndarray:
    """Patches (k, 2) [m]: adjoining strips under pressure, from edge to edge."""
    start = (grid.first - 0.5) * grid.pitch
    return start + grid.pitch * np.column_stack(runs_of(solution.pressure > 0.0))


def _stresses(problem: Problem, level: Level, window: Window) -> tuple[StressResult, ...]:
    """As in `comparisons.models.half_plane`, but for strips, under which sx has no bound at the
    surface: theirs begin below it."""
    x, pressure, pitch = level.grid.x, level.solution.pressure, level.grid.pitch
    shown, searched = (
        friction_field(
            x,
            pressure,
            (points.x[0], points.x[-1]),
            points.z[1:],
            subdivisions=points.subdivisions(pitch),
            stride=points.stride(pitch),
            element="strip",
        )
        for points in (window, search_window(problem, window))
    )
    nu, results = problem.scene.body.poissons_ratio, []
    for friction in problem.scene.load.friction:
        found = stress_maxima(x, pressure, friction, searched.at(friction), nu, "strip")
        extremes = {"tau1": found.tau1, "txz": found.txz_abs, "von_mises": found.von_mises}
        field = shown.at(friction).stress
        parts = (field.sx, field.sz, field.txz)
        unknown = np.full_like(field.sx[:1], np.nan)  # at the surface
        field = StressState(*(np.vstack([unknown, part]) for part in parts))
        results.append(StressResult(friction, extremes, field))
    return tuple(results)
