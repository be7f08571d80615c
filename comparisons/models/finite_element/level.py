"""The finite-element model of a scene on one level of refinement.

The rough body is a block: of the scene's own thickness and width where they are given, else so
large that it stands for a half-plane. An elastic roller is a second body under the same pressures:
a flat block, or a sector of its exact circle. The contact is solved on the sum of both surface
compliances; analytic operators only predict it."""

from dataclasses import replace

import numpy as np

from analytic.contact.patches import contact_patches
from analytic.contact.problem import KKT_TOLERANCE
from comparisons.common.errors import SceneError
from comparisons.common.mpi import from_first
from comparisons.common.progress import ProgressCallback, Stages, peak_memory
from comparisons.models.finite_element.bodies import BodyCache, bodies_of
from comparisons.models.finite_element.compliance_check import no_check, operator_check
from comparisons.models.finite_element.contact import mutual_compliance, solve_mutual
from comparisons.models.finite_element.cost import expected, refuse_too_large
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.finite_element.nonlinear import pressed_finitely, pressed_plastically
from comparisons.models.finite_element.stress import pressed_linearly, stresses_of
from comparisons.models.level import Level
from comparisons.models.nearest_operator import nearest_operator, solve_on
from comparisons.models.plan import Plan, make_plan
from comparisons.models.problem import Levels, Problem, problem_of
from comparisons.models.window import Window
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface, surface_of
from fem.solver.compilation import load_dolfinx
from meshes.build import start_worker
from meshes.refined_ranges import merge, unrefined_contact

START_TOLERANCE = 1e-5  # of the linear contact that finite deformation starts from
LAST_LOAD_CHANGE = 1e-3  # relative change of the load that no longer moves the mesh
MOST_ROUNDS = 12  # of loads for a prescribed approach
MOST_MESHES = 5  # of one level, while contact spreads beyond the refined ranges


def finite_element_level(
    problem: Problem,
    plan: Plan,
    refinement: Refinement,
    window: Window | None,
    stages: Stages,
    approach: float | None = None,
    body_cache: BodyCache | None = None,
    check: bool = False,
    fields: bool = True,
) -> Level:
    """Solve one level: mesh, factorise, press, and where asked for compute the stresses.

    The ranges to refine are predicted by the nearest analytic operator on the same pressure
    elements. Where contact spreads beyond them they are widened and the level is solved again.
    approach   [m] from first touch, prescribed in place of the load
    body_cache shared by levels whose meshes and factors may be the same
    check      compare the bodies' compliance with the analytic one first
    fields     give the stresses at all points of the mesh, too
    Raises SceneError where the level would exceed the budget of memory or the machine's, MeshError
    or FemError where a mesh or a factorisation fails."""
    scene, grid = problem.scene, problem.grid(refinement.pitch)
    body_cache = body_cache or BodyCache()
    friction = scene.load.friction[0] if scene.finite_element.coupled else 0.0
    model = nearest_operator(scene, grid, friction)
    weighted_gap = grid.hat_integrals(problem.finite_element_gap, problem.knots)
    constraints = problem.constraints()
    if scene.finite_element.plastic:  # the body's own flow limits the pressure
        constraints = replace(constraints, hardness=np.inf)
    with stages.stage("assembly", "finite elements: loading"):
        from_first(start_worker)
        load_dolfinx()
    with stages.stage("contact", "finite elements: predicting the contact"):
        guess = solve_on(model, weighted_gap, grid.weights, problem.widest)
    ranges, start = contact_patches(grid.x, guess.pressure, guess.gap), guess.pressure
    cost = expected(problem, plan, refinement, ranges)
    refuse_too_large(problem, cost, grid.pitch)
    if approach is not None:
        constraints = replace(constraints, load=None, approach=approach + problem.first_touch)
    # what finite deformation starts from need not be closer than it changes
    finite = scene.finite_element.deformation == "finite"
    tolerance = START_TOLERANCE if finite else KKT_TOLERANCE
    checked = None
    for _ in range(MOST_MESHES):
        bodies = bodies_of(problem, plan, refinement, ranges, stages, body_cache)
        refined = bodies.rough.mesh.spec.intervals
        with stages.stage("contact", "finite elements: contact"):
            operator = mutual_compliance(problem, bodies, grid)
        if check and no_check(scene) is None:
            with stages.stage("check", "finite elements: compliance before contact"):
                checked = operator_check(problem, operator, model, grid, refined)
        with stages.stage("contact", "finite elements: contact"):
            given = operator, model, weighted_gap, grid.weights, constraints, start
            solution = solve_mutual(*given, tolerance)
        touching = grid.x[solution.pressure > 0.0]
        missed = unrefined_contact(refined, touching, reach=grid.pitch)
        if len(missed) == 0:
            break
        ranges, start = merge(np.vstack([ranges, missed])), solution.pressure
    else:
        solution = replace(solution, converged=False)  # it touches an unrefined range
    if finite:
        with stages.stage("finite deformation", "finite elements: finite deformation"):
            pressed = pressed_finitely(problem, operator, grid, solution, constraints, model)
    elif scene.finite_element.plastic:
        with stages.stage("plastic flow", "finite elements: plastic flow"):
            pressed = pressed_plastically(
                problem, operator, grid, solution, weighted_gap, constraints, refinement.travel
            )
    else:
        with stages.stage("contact", "finite elements: contact"):
            pressed = pressed_linearly(problem, operator, grid, solution, weighted_gap)
    solution = pressed.solution
    level = Level(
        grid=grid,
        solution=solution,
        displacement=pressed.displacement / grid.weights,
        patches=pressed.patches,
        seconds=stages.seconds,
        unknowns=sum(each.unknowns for each in bodies.all),
        factor_memory=bodies.factor_memory,
        expected_seconds=cost.seconds,
        expected_memory=cost.memory,
        mesh=bodies.rough.mesh,
        operator=checked,
        material=pressed.material,
    )
    if window is None:
        return replace(level, peak_memory=peak_memory())
    with stages.stage("stresses", "finite elements: stresses"):
        frictions, asperities = scene.load.friction, problem.asperities
        stresses, mesh_field = stresses_of(pressed, frictions, window, asperities, fields)
    return replace(level, peak_memory=peak_memory(), stresses=stresses, mesh_field=mesh_field)


def problem_of_approach(
    scene: Scene,
    callback: ProgressCallback,
    surface: SceneSurface | None = None,
    levels: Levels | None = None,
) -> Problem:
    """The scene's problem under the load [N/m] of its prescribed approach, to LAST_LOAD_CHANGE or
    better.

    Only a body with a datum has an approach: a layer on its base under a rigid roller. Each round
    meshes for the load of the one before and prescribes the approach there. Raises SceneError if
    the rounds do not settle."""
    wanted = scene.load.value
    # a rigid body of the roller's shape would cut the surface over twice this half-width
    half_width = np.sqrt(scene.roller.radius * wanted)
    modulus = scene.body.material.plane_strain_modulus
    load = np.pi * modulus * half_width**2 / (4.0 * scene.roller.radius)
    body_cache, surface = BodyCache(), surface or surface_of(scene)
    for _ in range(MOST_ROUNDS):
        problem = problem_of(scene, surface, load, levels)
        plan = make_plan(problem, ("finite_element",))
        pitch = problem.pitches[-1]
        callback("finite elements: load of the prescribed approach")
        level = finite_element_level(
            problem, plan, Refinement(pitch), None, Stages(), approach=wanted, body_cache=body_cache
        )
        before, load = load, level.solution.load
        low, high = problem.extent
        if level.patches[0, 0] < low + pitch or level.patches[-1, 1] > high - pitch:
            load = 2.0 * before  # the contact fills the grid: it carries more than that
        elif abs(load - before) <= LAST_LOAD_CHANGE * load:
            return problem_of(scene, surface, load, levels)
    raise SceneError(
        f"{scene.source}: load.approach: no load was found that gives {wanted:g} m; allowed is a "
        "load (per_length) instead"
    )
