"""The finite-element model of a scene on one level of refinement.

The rough body is a block: of the scene's own thickness and width where they are given, else so
large that it stands for a half-plane. An elastic roller is a body of its own under the same
pressures: a flat block, or a sector of its true circle. The contact is solved on the sum of both
surface compliances; analytic operators only predict it.
"""

from dataclasses import replace

import numpy as np

from analytic.contact.coupled import solve_coupled
from analytic.contact.patches import contact_patches
from analytic.contact.problem import solve_contact
from comparisons.common.progress import Stages, peak_memory
from comparisons.models.finite_element.bodies import BodyStore, bodies_of
from comparisons.models.finite_element.compliance_difference import no_check, operator_check
from comparisons.models.finite_element.contact import mutual_compliance, solve_mutual
from comparisons.models.finite_element.cost import expected, refuse_too_large
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.finite_element.nonlinear import pressed_finitely, pressed_plastically
from comparisons.models.finite_element.stress import pressed_linearly, stresses_of
from comparisons.models.level import Level, Window
from comparisons.models.nearest_operator import nearest_operator
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from meshes.refined_ranges import merge, unrefined_contact

MOST_MESHES = 5  # of one level, while contact keeps reaching unrefined ground


def finite_element_level(
    problem: Problem,
    plan: Plan,
    refinement: Refinement,
    window: Window | None,
    stages: Stages,
    approach: float | None = None,
    store: BodyStore | None = None,
    check: bool = False,
) -> Level:
    """Solve one level: mesh, factorise, press, and where asked for compute the stresses.

    Ground to refine is predicted by the nearest analytic operator on the same pressure elements.
    If contact reaches ground that was not refined it is refined too and the level solved again.
    With `approach` [m], from first touch, it and not the load is prescribed. Levels that are given
    the same `store` share what meshes and factors they have in common. With `check` the bodies'
    compliance is compared with the analytic one first.
    Raises SceneError where the level would exceed the budget of memory or the machine's, MeshError
    or FemError where a mesh or a factorisation fails.
    """
    scene, grid = problem.scene, problem.grid(refinement.pitch)
    store = store or BodyStore()
    friction = scene.friction[0] if scene.finite_element.coupled else 0.0
    model = nearest_operator(scene, grid, friction)
    weighted_gap = grid.hat_integrals(problem.finite_element_gap, problem.knots)
    constraints = problem.constraints()
    if scene.finite_element.plastic:  # the body's own flow limits the pressure
        constraints = replace(constraints, hardness=np.inf)
    with stages.stage("contact", "finite elements: predicting the contact"):
        solve = solve_coupled if friction else solve_contact
        guess = solve(model, weighted_gap, grid.weights, constraints)
    ground, start = contact_patches(grid.x, guess.pressure, guess.gap), guess.pressure
    cost = expected(problem, plan, refinement, ground)
    refuse_too_large(problem, cost, grid.pitch)
    if approach is not None:
        constraints = replace(constraints, load=None, approach=approach + problem.first_touch)
    checked = None
    for _ in range(MOST_MESHES):
        bodies = bodies_of(problem, plan, refinement, ground, stages, store)
        refined = bodies.rough.mesh.spec.intervals
        with stages.stage("contact", "finite elements: contact"):
            operator = mutual_compliance(problem, bodies, grid)
        if check and no_check(scene) is None:
            with stages.stage("check", "finite elements: compliance before contact"):
                checked = operator_check(problem, operator, model, grid, refined)
        with stages.stage("contact", "finite elements: contact"):
            solution = solve_mutual(operator, model, weighted_gap, grid.weights, constraints, start)
        touching = grid.x[solution.pressure > 0.0]
        missed = unrefined_contact(refined, touching, reach=grid.pitch)
        if len(missed) == 0:
            break
        ground, start = merge(np.vstack([ground, missed])), solution.pressure
    else:
        solution = replace(solution, converged=False)  # it touches ground that was not refined
    if scene.finite_element.deformation == "finite":
        with stages.stage("finite deformation", "finite elements: finite deformation"):
            pressed = pressed_finitely(problem, operator, grid, solution, constraints)
    elif scene.finite_element.plastic:
        with stages.stage("plastic flow", "finite elements: plastic flow"):
            pressed = pressed_plastically(
                problem, operator, grid, solution, weighted_gap, constraints
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
    )
    if window is None:
        return replace(level, peak_memory=peak_memory())
    with stages.stage("stresses", "finite elements: stresses"):
        stresses, mesh_field = stresses_of(pressed, scene.friction, window)
    return replace(level, peak_memory=peak_memory(), stresses=stresses, mesh_field=mesh_field)
