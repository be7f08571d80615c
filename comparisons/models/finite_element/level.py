"""The finite-element model of a scene on one level of refinement.

The rough body is a block: of the scene's own thickness and width where they are given, else so
large that it stands for a half-plane. An elastic roller is a second body under the same pressures:
a flat block, or a sector of its exact circle. The contact is solved on the sum of both surface
compliances; analytic operators only predict it."""

from dataclasses import replace

import numpy as np

from analytic.contact.coupled import solve_coupled
from analytic.contact.patches import contact_patches
from analytic.contact.problem import KKT_TOLERANCE
from comparisons.common.errors import SceneError
from comparisons.common.progress import ProgressCallback, Stages, peak_memory
from comparisons.models.crest import unresolved_crest
from comparisons.models.finite_element.bodies import BodyCache, bodies_of
from comparisons.models.finite_element.contact import SmallStrainContact
from comparisons.models.finite_element.loaded import (
    LoadedBody,
    pressed_finitely,
    pressed_linearly,
    pressed_plastically,
    stresses_of,
)
from comparisons.models.finite_element.mesh import Refinement, expected
from comparisons.models.level import Level, flowing_contact, refuse_too_large
from comparisons.models.operators import LAYERS, operator_of
from comparisons.models.posing import settled
from comparisons.models.problem import COUPLED, Levels, Problem
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface, surface_of
from fem.solver.compilation import load_dolfinx
from meshes.build import start_worker
from meshes.refined_ranges import merge, unrefined_contact

START_TOLERANCE = 1e-3  # of the linear contact that finite deformation starts from
MOST_MESHES = 5  # of one level, while contact spreads beyond the refined ranges


def finite_element_level(
    problem: Problem,
    refinement: Refinement,
    stages: Stages,
    body_cache: BodyCache | None = None,
    approach: float | None = None,
    fields: int = 1,
) -> dict[float, Level]:
    """Solve one level at friction coefficients that share a contact: mesh, factorise, press, and
    where asked for compute the stresses.

    The ranges to refine are predicted by the nearest analytic operator on the same pressure
    elements. Where contact spreads beyond them they are widened and the level is solved again.
    body_cache  shared by levels whose meshes and factors may be the same
    approach    [m] from first touch, prescribed in place of the load
    fields      as those of a `Model`
    Raises SceneError where the level would exceed the budget of memory or the machine's, MeshError
    or FemError where a mesh or a factorisation fails."""
    frictions, flows = problem.scene.load.friction, problem.scene.finite_element.plastic
    with stages.stage("assembly", "finite elements: loading"):
        start_worker()
        load_dolfinx()
    with stages.stage("contact", "finite elements: predicting the contact"):
        predicted = _predicted(problem, refinement.pitch, approach)
    grid, guess = predicted.grid, predicted.solution
    ranges = contact_patches(grid.x, guess.pressure, guess.gap)
    patches = flowing_contact(problem) if flows else ranges
    cost = expected(problem, refinement, patches)
    refuse_too_large(problem, cost, "finite elements", refinement.pitch)
    contact = _meshed(predicted, ranges, refinement, stages, body_cache or BodyCache())
    pressed = _pressed(contact, refinement, stages)
    solution = pressed.solution
    level = Level(
        grid=grid,
        solution=solution,
        displacement=pressed.displacement / grid.weights,
        patches=pressed.patches,
        seconds=stages.seconds,
        unknowns=sum(body.unknowns for body in contact.bodies.all),
        # none where flow decides what a crest bears
        unresolved_crest=0.0 if flows else unresolved_crest(problem, grid, solution),
        expected_seconds=cost.seconds,
        expected_memory=cost.memory,
        mesh=contact.bodies.rough.mesh,
        material=pressed.material,
    )
    if problem.window is None:
        return dict.fromkeys(frictions, replace(level, peak_memory=peak_memory()))
    with stages.stage("stresses", "finite elements: stresses"):
        how = frictions, problem.window, problem.asperities, fields
        stresses, mesh_field = stresses_of(pressed, *how)
    level = replace(level, peak_memory=peak_memory(), mesh_field=mesh_field)
    return {stress.friction: replace(level, stress=stress) for stress in stresses}


def _predicted(problem: Problem, pitch: float, approach: float | None) -> SmallStrainContact:
    """The contact by the nearest analytic operator, wherever flow may spread it."""
    grid, settings = problem.grid(pitch), problem.scene.finite_element
    moved = {COUPLED} if settings.coupled else set()
    model = operator_of(problem, grid, LAYERS | moved, roller_moves=False)
    gap = grid.hat_integrals(problem.finite_element_gap, problem.knots)
    constraints = problem.constraints()
    if settings.plastic:  # the body's own flow limits the pressure
        constraints = replace(constraints, hardness=np.inf)
    if approach is not None:
        constraints = replace(constraints, load=None, approach=approach + problem.first_touch)
    solution = solve_coupled(model, gap, grid.weights, problem.widest)
    return SmallStrainContact(problem, grid, gap, constraints, model, solution)


def _meshed(
    contact: SmallStrainContact,
    ranges: np.ndarray,
    refinement: Refinement,
    stages: Stages,
    body_cache: BodyCache,
) -> SmallStrainContact:
    """The contact of bodies whose meshes are refined wherever they touch; not converged where it
    still spreads beyond these ranges (k, 2) [m] on the last of them."""
    problem, grid = contact.problem, contact.grid
    # what finite deformation starts from need not be closer than it changes
    is_finite = problem.scene.finite_element.deformation == "finite"
    tolerance = START_TOLERANCE if is_finite else KKT_TOLERANCE
    for _ in range(MOST_MESHES):
        bodies = bodies_of(problem, refinement, ranges, stages, body_cache)
        with stages.stage("contact", "finite elements: contact"):
            contact = contact.on(bodies, tolerance)
        if grid.periodic:  # all of the surface is refined
            return contact
        refined, touching = bodies.rough.mesh.spec.intervals, contact.solution.pressure > 0.0
        missed = unrefined_contact(refined, grid.x[touching], reach=grid.pitch)
        if len(missed) == 0:
            return contact
        ranges = merge(np.vstack([ranges, missed]))
    return replace(contact, solution=replace(contact.solution, converged=False))


def _pressed(contact: SmallStrainContact, refinement: Refinement, stages: Stages) -> LoadedBody:
    """Contact and bodies by the scene's laws, from that at small strains."""
    settings = contact.problem.scene.finite_element
    is_finite = settings.deformation == "finite"
    if settings.plastic:
        words = "flow at finite deformation" if is_finite else "plastic flow"
        words = f"finite elements: {words}"

        def reached(share: float) -> None:
            stages.callback(f"{words}, {100.0 * share:.0f} % of the load")

        with stages.stage("plastic flow", words):
            return pressed_plastically(contact, refinement.travel, reached)
    if is_finite:
        with stages.stage("finite deformation", "finite elements: finite deformation"):
            return pressed_finitely(contact)
    with stages.stage("contact", "finite elements: contact"):
        return pressed_linearly(contact)


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
    if scene.finite_element.coupled and len(scene.load.friction) > 1:
        raise SceneError(
            f"{scene.source}: load.friction: has {len(scene.load.friction)} coefficients, each of "
            "which needs another load for load.approach; allowed is one, or per_length"
        )
    body_cache, approach = BodyCache(), scene.load.value

    def pressed(problem: Problem) -> tuple[float, np.ndarray]:
        callback("finite elements: load of the prescribed approach")
        how = Refinement(problem.pitches[-1]), Stages(), body_cache, approach
        bare = replace(problem, window=None)
        level, *_ = finite_element_level(bare, *how).values()
        return level.solution.load, level.patches

    return settled(scene, surface or surface_of(scene), pressed, levels=levels)
