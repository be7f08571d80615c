"""The methods whose cost is measured.

In: a scene's problem. Out: which methods apply to it, at which settings, and one contact by one of
them. A setting is a pitch of pressure elements [m]: the scene's, coarser and finer by powers of
two."""

from dataclasses import dataclass, replace

import numpy as np

from analytic.contact.problem import ContactSolution, solve_contact
from analytic.grid import HatGrid
from analytic.numerics import runs_of
from analytic.operators.half_plane import HalfPlane
from analytic.stress.field import friction_field
from analytic.stress.maxima import stress_maxima
from analytic.stress_state import StressState
from comparisons.common.progress import Stages
from comparisons.figures.quantity import MODELS
from comparisons.models.half_plane import half_plane_level
from comparisons.models.level import Level, StressResult, stress_result
from comparisons.models.plan import make_plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window, search_window
from comparisons.studies.contact import values_of
from comparisons.studies.ladder.operators import (
    OperatorModel,
    carried_deformed,
    carried_linear,
    problem_carrying,
)
from comparisons.studies.model_error.catalogue import COUPLED, EFFECTS, contained, kinematic
from comparisons.studies.model_error.selection import select_effects

HALF_PLANE_PITCHES = (2.0, 1.0, 0.5, 0.25, 0.125, 0.0625)  # of the scene's coarsest
FINITE_ELEMENT_PITCHES = (2.0, 1.0, 0.5, 0.25)

OPERATOR, DEFORMED, LINEAR = "operator", "deformed", "linear"  # elements of the ladder's models

Values = tuple[dict[str, float], ...]  # [SI] of the compared quantities, one a friction coefficient


@dataclass(frozen=True)
class SolutionMethod:
    """One way to solve a contact."""

    name: str  # in table and diagram
    model: str  # half_plane | finite_element
    # hat | strip of pressure; or P1 | P2 | P3; or of a model of the ladder operator | deformed |
    # linear
    element: str

    def settings(self, problem: Problem) -> tuple[float, ...]:
        factors = HALF_PLANE_PITCHES if self.model == "half_plane" else FINITE_ELEMENT_PITCHES
        return tuple(factor * problem.pitches[0] for factor in factors)


FINEST = SolutionMethod("hats, FFT", "half_plane", "hat")  # the others' reference, where it may be
METHODS = (
    SolutionMethod("strips, FFT", "half_plane", "strip"),
    FINEST,
    *(SolutionMethod(degree, "finite_element", degree) for degree in ("P1", "P2", "P3")),
)

# Models of the ladder between the half-plane and the scene's own finite elements.
LADDER = (
    SolutionMethod("hats, layered", "half_plane", OPERATOR),
    SolutionMethod("hats, deformed", "half_plane", DEFORMED),
    SolutionMethod("P2, linear", "finite_element", LINEAR),
)


def methods_of(problem: Problem) -> tuple[SolutionMethod, ...]:
    """Those of METHODS, and of LADDER what differs from them in a scene, the cheaper first."""
    effects, settings = contained(problem.scene), problem.scene.finite_element
    possible = {
        OPERATOR: carried_linear(problem.scene, effects),
        DEFORMED: carried_deformed(problem, effects),
        LINEAR: settings.deformation == "finite" or settings.plastic,
    }
    if len(problem.scene.load.friction) > 1 and settings.coupled:
        possible = {LINEAR: possible[LINEAR]}  # each coefficient has a contact of its own
    between = [method for method in LADDER if possible.get(method.element)]
    return tuple(sorted((*METHODS, *between), key=lambda method: MODELS.index(method.model)))


def why_not(method: SolutionMethod, problem: Problem) -> str | None:
    """Why a method does not apply to a scene at all, None where it does."""
    settings = problem.scene.finite_element
    if method.model == "half_plane":
        if problem.coupling and method != FINEST:
            return "friction moves the surfaces: only hats by FFT have that"
        return None
    nonlinear = settings.plastic or settings.deformation == "finite"
    if method.element == LINEAR:
        return None
    if method.element != "P2" and nonlinear:
        return "bodies that yield or deform finitely take P2"
    return None


def is_half_plane_problem(problem: Problem) -> bool:
    """Whether both models solve the same problem, so that their limits are the same."""
    scene, settings = problem.scene, problem.scene.finite_element
    unbounded = scene.body.thickness is None and scene.body.width is None and scene.coating is None
    flat = settings.geometry == "flat" or scene.profile is None
    linear = settings.deformation == "linear" and not settings.plastic
    moves = bool(any(scene.load.friction) and problem.dundurs_beta)
    same_traction = settings.coupled == scene.load.coupled or not moves
    shapes = (settings.gap, settings.roller_shape, settings.roller_body)
    same_shapes = shapes == ("reference", "parabola", "half-plane")
    return unbounded and flat and linear and same_shapes and same_traction


def solved(
    method: SolutionMethod,
    problem: Problem,
    setting: float,
    window: Window | None,
    stages: Stages,
    half_block: bool = False,
) -> tuple[Level, Values]:
    """The contact at a setting, without its mesh, and its values; `half_block` holds an unbounded
    body at half the distance."""
    if method.element == "hat":
        level = half_plane_level(problem, setting, window, stages)
    elif method.element == "strip":
        level = _by_strips(problem, setting, window, stages)
    elif method.element in (OPERATOR, DEFORMED):
        level = _by_operator(problem, setting, window, stages, method.element == DEFORMED)
    else:
        from comparisons.models.finite_element.level import LevelOptions, finite_element_level
        from comparisons.models.finite_element.mesh import Refinement

        sets = {"finite_element.element": method.element}
        if method.element == LINEAR:
            sets = {"finite_element.element": "P2", "finite_element.deformation": "linear"}
            sets |= {"finite_element.plastic": False}
        scene = problem.scene.unchecked(sets)
        problem, refinement = replace(problem, scene=scene), Refinement(setting, half_block)
        plan = make_plan(problem, ("finite_element",))
        level = finite_element_level(
            problem, plan, refinement, window, stages, options=LevelOptions(fields=False)
        )
    frictions = problem.scene.load.friction
    values = tuple(values_of(level, problem, friction) for friction in frictions)
    return replace(level, mesh=None), values


def _by_operator(
    problem: Problem, pitch: float, window: Window | None, stages: Stages, deformed: bool
) -> Level:
    """With what an operator carries of the scene's finite elements, or on the deformed surface."""
    frictions, effects = problem.scene.load.friction, contained(problem.scene)
    held = carried_linear(problem.scene, effects)
    if deformed:
        held = carried_deformed(problem, effects)
    coupling = frictions[0] if COUPLED in held else 0.0
    model = OperatorModel(problem_carrying(problem, held), frictions, coupling, deformed)
    level = model.level(pitch, window)
    stages.seconds.update(level.seconds)
    return level


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
        maxima = stress_maxima(x, pressure, friction, searched.at(friction), nu, "strip")
        extremes = {"tau1": maxima.tau1, "txz": maxima.txz_abs, "von_mises": maxima.von_mises}
        field = shown.at(friction).stress
        parts = (field.sx, field.sz, field.txz)
        unknown = np.full_like(field.sx[:1], np.nan)  # at the surface
        field = StressState(*(np.vstack([unknown, part]) for part in parts))
        results.append(stress_result(friction, extremes, field, {}, window))
    return tuple(results)


def with_every_effect(problem: Problem) -> Problem:
    """The problem whose finite elements have all effects of the whole model."""
    level = half_plane_level(problem, problem.pitches[0], None, Stages())
    scene, peak = problem.scene, float(level.solution.pressure.max())
    added = select_effects(problem, peak, ()).added
    if "finite_strain" in added:
        added = added | kinematic(scene)
    for name in added:
        scene = EFFECTS[name].give(scene, scene)
    return replace(problem, scene=scene)
