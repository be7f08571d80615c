"""The analytic surface that is nearest to a scene's bodies: half-planes, layers and coatings.

It predicts where finite elements will touch, and is the model of their outer iteration, whose
answer is checked on the finite elements themselves."""

import numpy as np

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.grid import HatGrid
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface, TangentialLayer
from analytic.material import Material, combined_modulus, dundurs_constants
from analytic.operators.half_plane import HalfPlane, ModelOperator, SumOfConvolutions
from analytic.operators.periodic import PeriodicHalfPlane
from analytic.operators.tangential import CoupledHalfPlane, CoupledPair
from comparisons.scenes.scene import Scene


def is_layered(scene: Scene) -> bool:
    """Whether the body is more than a half-plane of one material."""
    return scene.body.thickness is not None or scene.coating is not None


def layered_body(scene: Scene) -> LayeredBody | None:
    """The layer or the coated body of a scene."""
    if scene.coating is not None:
        return LayeredBody(scene.coating.material, scene.coating.thickness, scene.body.material)
    if scene.body.thickness is not None:
        return LayeredBody(scene.body.material, scene.body.thickness, scene.body.base or "bonded")
    return None


def nearest_operator(scene: Scene, grid: HatGrid, friction: float = 0.0) -> ModelOperator:
    """Mutual compliance of roller and body on a grid of hats.

    friction  coefficient of the sliding traction that moves the surfaces; 0 leaves it out"""
    count, pitch = grid.count, grid.pitch
    if grid.periodic:  # of layers the half-plane, too: long waves alone see what is below
        return PeriodicHalfPlane(
            count, pitch, combined_modulus(scene.roller.material, surface_material(scene))
        )
    body = layered_body(scene)
    if body is None:
        modulus = combined_modulus(scene.roller.material, scene.body.material)
        if not friction:
            return HalfPlane(count, pitch, modulus)
        beta = dundurs_constants(scene.body.material, scene.roller.material)[1]
        return CoupledHalfPlane(count, pitch, modulus, friction * beta)
    normal = LayeredSurface(count, pitch, body)
    if not scene.roller.rigid:
        roller = HalfPlane(count, pitch, scene.roller.material.plane_strain_modulus)
        normal = SumOfConvolutions(normal, roller)
    if not friction:
        return normal
    # what the roller's own traction adds is left to the outer iteration
    return CoupledPair(normal, TangentialLayer(count, pitch, body), friction)


def surface_material(scene: Scene) -> Material:
    """The coating's, or the body's without one."""
    return scene.body.material if scene.coating is None else scene.coating.material


def solve_on(
    operator: ModelOperator,
    gap: np.ndarray,
    weights: np.ndarray,
    constraints: Constraints,
    start: np.ndarray | None = None,
) -> ContactSolution:
    """As `analytic.contact.problem.solve_contact`, also for operators that traction couples."""
    solve = solve_coupled if hasattr(operator, "skew") else solve_contact
    return solve(operator, gap, weights, constraints, start)
