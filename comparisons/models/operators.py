"""The compliance of a scene's surfaces without a mesh: half-planes, a layer, a coating.

It is what analytic models solve with. It predicts where finite elements will touch, and is the
model of their outer iteration, whose result is checked on the finite elements themselves."""

from collections.abc import Callable

import numpy as np

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface, TangentialLayer
from analytic.material import Material, combined_modulus
from analytic.operators.convolution import Convolution
from analytic.operators.half_plane import HalfPlane, ModelOperator, SumOfConvolutions
from analytic.operators.periodic import PeriodicHalfPlane
from analytic.operators.tangential import (
    CoupledPair,
    TangentialHalfPlane,
    coupled_half_planes,
    tangential_compliance,
)
from comparisons.models.problem import COUPLED, Problem
from comparisons.scenes.scene import Scene

LAYERS = frozenset({"finite_size", "coating"})  # effects that an operator has in place of a mesh


def is_layered(scene: Scene) -> bool:
    """Whether the body is more than a half-plane of one material."""
    return layered_body(scene) is not None


def layered_body(scene: Scene, effects: frozenset[str] = LAYERS) -> LayeredBody | None:
    """The layer or the coated body of a scene, where it has one and the effects hold it."""
    if scene.coating is not None and "coating" in effects:
        return LayeredBody(scene.coating.material, scene.coating.thickness, scene.body.material)
    if scene.body.thickness is not None and "finite_size" in effects:
        return LayeredBody(scene.body.material, scene.body.thickness, scene.body.base or "bonded")
    return None


def surface_material(scene: Scene, effects: frozenset[str] = LAYERS) -> Material:
    """The coating's, or the body's without one."""
    coated = scene.coating is not None and "coating" in effects
    return scene.coating.material if coated else scene.body.material


def body_operator(problem: Problem, grid: HatGrid, effects: frozenset[str] = LAYERS) -> Convolution:
    """Compliance of the rough body alone, with the LAYERS of `effects`. Of a periodic surface a
    half-plane's, of layers, too: long waves alone see what is below."""
    scene, size = problem.scene, (grid.count, grid.pitch)
    if not grid.periodic and (body := layered_body(scene, effects)) is not None:
        return LayeredSurface(*size, body)
    kind = PeriodicHalfPlane if grid.periodic else HalfPlane
    return kind(*size, surface_material(scene, effects).plane_strain_modulus)


def operator_of(
    problem: Problem,
    grid: HatGrid,
    effects: frozenset[str] = LAYERS,
    roller_moves: bool = True,
) -> ModelOperator:
    """Mutual compliance of roller and body on a grid of hats.

    effects       LAYERS that it has where the scene has them, and COUPLED: the sliding traction
                  under the scene's largest friction coefficient then moves both surfaces
    roller_moves  without it that of the roller on layers, which an outer iteration may do without
    """
    scene, size = problem.scene, (grid.count, grid.pitch)
    friction = problem.largest_friction if COUPLED in effects else 0.0
    body = None if grid.periodic else layered_body(scene, effects)
    if body is None:
        return half_planes(problem, grid, effects, friction)
    normal, roller = body_operator(problem, grid, effects), scene.roller.material
    if roller is not None:
        normal = SumOfConvolutions(normal, HalfPlane(*size, roller.plane_strain_modulus))
    if not friction:
        return normal
    moved = TangentialLayer(*size, body)
    if roller is not None and roller_moves:  # which takes the traction's other side
        drawn = TangentialHalfPlane(*size, -tangential_compliance(roller))
        moved = SumOfConvolutions(moved, drawn)
    return CoupledPair(normal, moved, friction)


def half_planes(
    problem: Problem, grid: HatGrid, effects: frozenset[str], friction: float = 0.0
) -> ModelOperator:
    """Mutual compliance of half-planes of the materials at the surface; coupled under friction but
    on a periodic surface, whose operator has no coupling."""
    scene, size = problem.scene, (grid.count, grid.pitch)
    modulus = combined_modulus(scene.roller.material, surface_material(scene, effects))
    if grid.periodic:
        return PeriodicHalfPlane(*size, modulus)
    if not friction:
        return HalfPlane(*size, modulus)
    return coupled_half_planes(*size, modulus, friction * problem.dundurs_beta)


def pressed_on(
    problem: Problem,
    grid: HatGrid,
    operator: ModelOperator,
    constraints: Constraints | None = None,
    gap: Callable[[np.ndarray], np.ndarray] | None = None,
) -> ContactSolution:
    """The contact of a problem on an analytic operator; by default under its own constraints and
    gap."""
    weighted_gap = grid.hat_integrals(gap or problem.gap, problem.knots)
    limits = constraints or problem.constraints()
    return solve_coupled(operator, weighted_gap, grid.weights, limits)


def patches_of(grid: HatGrid, solution: ContactSolution) -> np.ndarray:
    """Contact patches (k, 2) [m], ascending. Of a periodic surface those that start in the grid's
    period, which the last may end beyond; or the whole period."""
    pressure, gap = solution.pressure, solution.gap
    if not grid.periodic:
        return contact_patches(grid.x, pressure, gap)
    start, stop = grid.x[0], grid.x[0] + grid.period
    if np.all(pressure > 0.0):
        return np.array([[start, stop]])
    every = contact_patches(grid.unfolded_x, grid.unfolded(pressure), grid.unfolded(gap))
    return every[(every[:, 0] >= start) & (every[:, 0] < stop)]
