"""The finite-element model of a scene on one level of refinement.

The rough body is a block: of the scene's own thickness and width where they are given, else so
large that it stands for a half-plane. An elastic roller is a second body under the same pressures:
a flat block, or a sector of its exact circle. The contact is solved on the sum of both surface
compliances; analytic operators only predict it."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import KKT_TOLERANCE, ContactSolution
from analytic.grid import HatGrid
from analytic.operators.half_plane import ModelOperator
from comparisons.common.errors import SceneError
from comparisons.common.progress import ProgressCallback, Stages, peak_memory
from comparisons.models.crest import unresolved_crest
from comparisons.models.finite_element.bodies import BodyCache, BodyPair, bodies_of
from comparisons.models.finite_element.contact import (
    MutualCompliance,
    mutual_compliance,
    solve_mutual,
)
from comparisons.models.finite_element.cost import expected
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.finite_element.nonlinear import (
    pressed_finitely,
    pressed_plastically,
    pressed_plastically_finitely,
)
from comparisons.models.finite_element.stress import LoadedBody, pressed_linearly, stresses_of
from comparisons.models.level import Level, by_friction, flowing_contact, refuse_too_large
from comparisons.models.operators import LAYERS, operator_of, solve_on
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
    fields: bool = True,
) -> dict[float, Level]:
    """Solve one level at each friction coefficient: mesh, factorise, press, and where asked for
    compute the stresses.

    The ranges to refine are predicted by the nearest analytic operator on the same pressure
    elements. Where contact spreads beyond them they are widened and the level is solved again.
    body_cache  shared by levels whose meshes and factors may be the same
    approach    [m] from first touch, prescribed in place of the load
    fields      give all stresses on the window and the mesh, not the largest alone
    Raises SceneError where the level would exceed the budget of memory or the machine's, MeshError
    or FemError where a mesh or a factorisation fails."""
    body_cache = body_cache or BodyCache()

    def solve(problem: Problem) -> dict[float, Level]:
        """Under friction coefficients that share a contact."""
        frictions = problem.scene.load.friction
        solving = _LevelSolution(problem, refinement, stages, approach)
        with stages.stage("assembly", "finite elements: loading"):
            start_worker()
            load_dolfinx()
        grid = solving.grid
        with stages.stage("contact", "finite elements: predicting the contact"):
            guess = solve_on(solving.model, solving.weighted_gap, grid.weights, problem.widest)
        ranges = contact_patches(grid.x, guess.pressure, guess.gap)
        flows = problem.scene.finite_element.plastic
        patches = flowing_contact(problem) if flows else ranges
        cost = expected(problem, refinement, patches)
        refuse_too_large(problem, cost, "finite elements", refinement.pitch)
        meshed = solving.meshed_contact(ranges, guess.pressure, body_cache)
        pressed = solving.pressed(meshed)
        level = Level(
            grid=grid,
            solution=pressed.solution,
            displacement=pressed.displacement / grid.weights,
            patches=pressed.patches,
            seconds=stages.seconds,
            unknowns=sum(body.unknowns for body in meshed.bodies.all),
            unresolved_crest=solving.unresolved_crest(pressed.solution),
            expected_seconds=cost.seconds,
            expected_memory=cost.memory,
            mesh=meshed.bodies.rough.mesh,
            material=pressed.material,
        )
        if problem.window is None:
            return dict.fromkeys(frictions, replace(level, peak_memory=peak_memory()))
        with stages.stage("stresses", "finite elements: stresses"):
            how = frictions, problem.window, problem.asperities, fields
            stresses, mesh_field = stresses_of(pressed, *how)
        level = replace(level, peak_memory=peak_memory(), mesh_field=mesh_field)
        return {stress.friction: replace(level, stress=stress) for stress in stresses}

    return by_friction(problem, problem.scene.finite_element.coupled, solve)


@dataclass(frozen=True)
class _MeshedContact:
    """Both bodies, and their contact at small strains."""

    bodies: BodyPair
    operator: MutualCompliance
    solution: ContactSolution


@dataclass(frozen=True)
class _LevelSolution:
    """The steps of one level."""

    problem: Problem
    refinement: Refinement
    stages: Stages
    approach: float | None  # [m] from first touch, in place of the load

    @cached_property
    def grid(self) -> HatGrid:
        return self.problem.grid(self.refinement.pitch)

    @cached_property
    def model(self) -> ModelOperator:
        """The nearest analytic operator."""
        moved = {COUPLED} if self.problem.scene.finite_element.coupled else set()
        return operator_of(self.problem, self.grid, LAYERS | moved, roller_moves=False)

    @cached_property
    def weighted_gap(self) -> np.ndarray:
        """(n,) [m^2] integrals of the initial gap with the hats."""
        return self.grid.hat_integrals(self.problem.finite_element_gap, self.problem.knots)

    @cached_property
    def constraints(self) -> Constraints:
        constraints = self.problem.constraints()
        if self.problem.scene.finite_element.plastic:  # the body's own flow limits the pressure
            constraints = replace(constraints, hardness=np.inf)
        if self.approach is not None:
            from_touch = self.approach + self.problem.first_touch
            constraints = replace(constraints, load=None, approach=from_touch)
        return constraints

    @property
    def is_finite(self) -> bool:
        return self.problem.scene.finite_element.deformation == "finite"

    def unresolved_crest(self, solution: ContactSolution) -> float:
        """As of `comparisons.models.crest`; none where flow decides what a crest bears."""
        flows = self.problem.scene.finite_element.plastic
        return 0.0 if flows else unresolved_crest(self.problem, self.grid, solution)

    def meshed_contact(
        self, ranges: np.ndarray, start: np.ndarray, body_cache: BodyCache
    ) -> _MeshedContact:
        """Bodies whose meshes are refined wherever they touch; not converged where contact still
        spreads beyond these ranges (k, 2) [m] on the last of them."""
        problem, grid = self.problem, self.grid
        # what finite deformation starts from need not be closer than it changes
        tolerance = START_TOLERANCE if self.is_finite else KKT_TOLERANCE
        for _ in range(MOST_MESHES):
            bodies = bodies_of(problem, self.refinement, ranges, self.stages, body_cache)
            refined = bodies.rough.mesh.spec.intervals
            with self.stages.stage("contact", "finite elements: contact"):
                operator = mutual_compliance(problem, bodies, grid)
                solution = solve_mutual(
                    operator,
                    self.model,
                    self.weighted_gap,
                    grid.weights,
                    self.constraints,
                    start,
                    tolerance,
                )
            if grid.periodic:  # all of the surface is refined
                return _MeshedContact(bodies, operator, solution)
            touching = grid.x[solution.pressure > 0.0]
            missed = unrefined_contact(refined, touching, reach=grid.pitch)
            if len(missed) == 0:
                return _MeshedContact(bodies, operator, solution)
            ranges, start = merge(np.vstack([ranges, missed])), solution.pressure
        return _MeshedContact(bodies, operator, replace(solution, converged=False))

    def pressed(self, contact: _MeshedContact) -> LoadedBody:
        """Contact and bodies by the scene's laws, from that at small strains."""
        problem, grid = self.problem, self.grid
        operator, solution = contact.operator, contact.solution
        flows = problem.scene.finite_element.plastic
        if flows:
            words = "flow at finite deformation" if self.is_finite else "plastic flow"
            words = f"finite elements: {words}"

            def reached(share: float) -> None:
                self.stages.callback(f"{words}, {100.0 * share:.0f} % of the load")

            with self.stages.stage("plastic flow", words):
                contact = problem, operator, grid, solution
                how = self.constraints, self.refinement.travel, reached
                if self.is_finite:
                    return pressed_plastically_finitely(*contact, *how)
                return pressed_plastically(*contact, self.weighted_gap, *how)
        if self.is_finite:
            with self.stages.stage("finite deformation", "finite elements: finite deformation"):
                return pressed_finitely(
                    problem, operator, grid, solution, self.constraints, self.model
                )
        with self.stages.stage("contact", "finite elements: contact"):
            return pressed_linearly(problem, operator, grid, solution, self.weighted_gap)


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
            "which takes another load for load.approach; allowed is one, or per_length"
        )
    body_cache, approach = BodyCache(), scene.load.value

    def pressed(problem: Problem) -> tuple[float, np.ndarray]:
        callback("finite elements: load of the prescribed approach")
        how = Refinement(problem.pitches[-1]), Stages(), body_cache, approach
        bare = replace(problem, window=None)
        level, *_ = finite_element_level(bare, *how).values()
        return level.solution.load, level.patches

    return settled(scene, surface or surface_of(scene), pressed, levels=levels)
