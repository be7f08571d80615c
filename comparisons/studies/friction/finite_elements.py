"""Partial slip on finite elements: their compliance along the surface, and their stresses."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.partial_slip import SurfacePair
from analytic.grid import HatGrid
from analytic.stress_state import StressState
from comparisons.models.finite_element.contact import MutualCompliance, compliance_again
from comparisons.models.level import Level
from comparisons.models.operators import is_layered, operator_of
from comparisons.models.problem import Problem
from comparisons.studies.friction.half_planes import (
    SlippedLevel,
    bulk_stress,
    ends_stress,
    slipped_level,
    with_surface,
)
from fem.stress.maximum import maximum
from fem.stress.stress import NodalStress, evaluate, nodal_stresses
from fem.stress.surface_load import SurfaceLoad

# Of the largest pressure: what the last turn of normal and tangential problem moves on finite
# elements, each application of which takes a back-substitution
SETTLED = 1e-6


def finite_element_slip(
    problem: Problem, level: Level, increments: int, half_block: bool = False
) -> SlippedLevel:
    """Slip in the finite elements of a level, made again; a `half_block` ends an unbounded body at
    half of its size."""
    grid, operator = level.grid, compliance_again(problem, level, half_block)
    slipped = slipped_level(problem, grid, finite_element_pair(problem, operator, grid), increments)
    if problem.scene.body.thickness is not None:
        last = slipped.states[-1]
        lowered = operator.rough.moved(last.normal.pressure, last.traction)[0] / grid.weights
        slipped = replace(slipped, lowering=float(np.interp(0.0, grid.x, lowered)))
    return _with_mesh_stress(problem, operator, slipped) if problem.window else slipped


def finite_element_pair(problem: Problem, operator: MutualCompliance, grid: HatGrid) -> SurfacePair:
    """Both surfaces by their finite elements, solved with the nearest analytic operator for a
    model of either compliance."""
    model, unlike = operator_of(problem, grid), operator.unlike

    def solve(apply: Callable, *posed: object) -> object:
        whole, start = SimpleNamespace(apply=apply), posed[-1]
        return solve_with_model(whole, model, *posed, nearer=start is not None)

    def normal(pressure: np.ndarray) -> np.ndarray:
        return operator.moved(pressure=pressure)[0]

    def tangential(traction: np.ndarray) -> np.ndarray:
        return operator.moved(traction=traction)[1]

    return SurfacePair(
        weighted_gap=grid.hat_integrals(problem.finite_element_gap, problem.knots),
        weights=grid.weights,
        x=grid.x,
        friction=problem.largest_friction,
        hardness=problem.constraints().hardness,
        tangential=tangential,
        solve_normal=partial(solve, normal),
        solve_tangential=partial(solve, tangential),
        raised=(lambda traction: operator.moved(traction=traction)[0]) if unlike else None,
        dragged=(lambda pressure: operator.moved(pressure=pressure)[1]) if unlike else None,
        settled=SETTLED,
    )


def _with_mesh_stress(
    problem: Problem, operator: MutualCompliance, slipped: SlippedLevel
) -> SlippedLevel:
    """Add the largest stresses of the rough body, recovered from displacements under the tractions,
    and the bulk stress, in a coating that of the strain below."""
    rough, body, scene = operator.rough, operator.rough.body, problem.scene
    layer = scene.coating and scene.coating.material.plane_strain_modulus
    base = scene.body.material.plane_strain_modulus
    stiffness = np.where(body.coated, layer or 0.0, base) / base

    def stressed(number: int) -> tuple[NodalStress, SurfaceLoad]:
        state = slipped.states[number]
        pressure, traction = state.normal.pressure, state.traction
        load = SurfaceLoad(body, rough.hats, pressure, np.zeros(1), traction=traction)
        moved = rough.displacement_of(pressure, traction)
        beside = ends_stress(problem, slipped.grid, state)
        [nodal] = nodal_stresses(moved[:, None], load, lambda x, z: [beside(x, z)])
        bulk = bulk_stress(problem, number) * nodal.nodes.of_triangles(stiffness)
        return nodal.plus(bulk[:, None] * np.array([1.0, 0.0, 0.0])), load

    def surface(number: int, x: np.ndarray) -> StressState:
        whole, load = last if number == -1 else stressed(number)
        return evaluate(body, whole, x, load.surface(x))

    last, bounds = stressed(-1), (*problem.window.ends, problem.window.z[-1])
    tau1 = maximum(body, last[0], lambda stress: stress.tau1, bounds)
    return with_surface(problem, slipped, tau1, surface, cusps=not is_layered(scene))
