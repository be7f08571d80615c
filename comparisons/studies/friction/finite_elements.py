"""Partial slip on finite elements: their compliance along the surface, and their stresses."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.partial_slip import Loads, SlipState, SurfacePair, stick_zones
from analytic.contact.problem import assessed
from analytic.grid import HatGrid
from analytic.stress_state import StressState
from comparisons.common.progress import Stages
from comparisons.models.finite_element.bodies import BodyCache, bodies_of
from comparisons.models.finite_element.contact import (
    MutualCompliance,
    mutual_compliance,
    roller_normal,
)
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.finite_element.nonlinear import (
    FINITE_TOLERANCE,
    refuse_cut_off,
    unpressed_contact,
)
from comparisons.models.level import Level
from comparisons.models.nearest_operator import nearest_operator
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.friction.half_planes import (
    SlippedLevel,
    Way,
    bulk_stress,
    ends_stress,
    friction_of,
    slipped_level,
    steps_of,
    surface_places,
    with_surface,
)
from fem.body.elasticity import ElasticBody
from fem.body.surface import straight_down
from fem.nonlinear.finite_deformation import FiniteDeformation
from fem.nonlinear.stick_slip import HeldContact, HeldState
from fem.stress.maximum import maximum
from fem.stress.stress import FurtherStress, NodalStress, evaluate, nodal_stresses
from fem.stress.surface_load import SurfaceLoad

# Of the largest pressure: what the last turn of normal and tangential problem moves on finite
# elements, each application of which takes a back-substitution
SETTLED = 1e-6
# Stresses at nodes and what makes them, after a load of the path
Stressed = Callable[[int], tuple[NodalStress, SurfaceLoad]]


def finite_element_slip(
    problem: Problem,
    plan: Plan,
    window: Window | None,
    level: Level,
    increments: int,
    half_block: bool = False,
) -> SlippedLevel:
    """Of the finite elements of a level, made again; a `half_block` ends an unbounded body at half
    of its size. Raises FemError where finite deformation has no solution."""
    grid = problem.grid(level.grid.pitch)
    refinement = Refinement(grid.pitch, half_block=half_block)
    bodies = bodies_of(problem, plan, refinement, level.patches, Stages(), BodyCache())
    operator = mutual_compliance(problem, bodies, grid)
    if problem.scene.finite_element.deformation == "finite":
        slipped, ends = finite_deformation_slip(problem, operator, grid, level, increments)
        stressed = _finite_stress(problem, slipped, ends)
    else:
        pair = finite_element_pair(problem, operator, grid)
        slipped = slipped_level(problem, grid, pair, increments)
        stressed = _linear_stress(problem, operator, slipped)
        if problem.scene.body.thickness is not None:
            last = slipped.states[-1]
            lowered = operator.rough.moved(last.normal.pressure, last.traction)[0] / grid.weights
            slipped = replace(slipped, lowering=float(np.interp(0.0, grid.x, lowered)))
    if window is None:
        return slipped
    return _with_mesh_stress(problem, bodies.rough, slipped, window, stressed)


@dataclass(frozen=True)
class Applied:
    """A compliance by what applies it."""

    apply: Callable[[np.ndarray], np.ndarray]


def finite_element_pair(problem: Problem, operator: MutualCompliance, grid: HatGrid) -> SurfacePair:
    """Both surfaces by their finite elements, solved with the nearest analytic operator for a
    model of either compliance."""
    model, unlike = nearest_operator(problem.scene, grid, 0.0), operator.unlike

    def solve(apply: Callable, *problem_of_contact: object) -> object:
        start = problem_of_contact[-1]
        return solve_with_model(
            Applied(apply), model, *problem_of_contact, nearer=start is not None
        )

    def normal(pressure: np.ndarray) -> np.ndarray:
        return operator.moved(pressure=pressure)[0]

    def tangential(traction: np.ndarray) -> np.ndarray:
        return operator.moved(traction=traction)[1]

    return SurfacePair(
        weighted_gap=grid.hat_integrals(problem.finite_element_gap, problem.knots),
        weights=grid.weights,
        x=grid.x,
        friction=friction_of(problem),
        hardness=problem.constraints().hardness,
        tangential=tangential,
        solve_normal=partial(solve, normal),
        solve_tangential=partial(solve, tangential),
        raised=(lambda traction: operator.moved(traction=traction)[0]) if unlike else None,
        dragged=(lambda pressure: operator.moved(pressure=pressure)[1]) if unlike else None,
        settled=SETTLED,
    )


def finite_deformation_slip(
    problem: Problem, operator: MutualCompliance, grid: HatGrid, level: Level, increments: int
) -> tuple[SlippedLevel, list[FiniteDeformation]]:
    """And both bodies after each load. On deformed surfaces, whose pressures and tractions are
    Cauchy's: `place` says where the grid's nodes are on these, from the roller's lowest point."""
    start = level.solution.pressure * (problem.hertz.load_per_length / level.solution.load)
    contact = unpressed_contact(problem, operator, start, 0.0)
    held, slipped, work = HeldContact(contact, friction_of(problem)), np.zeros(grid.count), 0.0
    reached, deformed, states, slips, energies, moved = held.apart, [], [], [], [], []
    ends = problem.grid(problem.pitches[0]).x[[0, -1]]
    for steps in steps_of(problem, True, increments):
        way = Way()
        for loads in steps:
            share = loads.tangential / (held.friction * loads.normal)
            reached = held.stepped(reached, loads.normal, share)
            refuse_cut_off(problem, grid, reached.pressure, start, "at finite deformation")
            slip = reached.lever * reached.slip
            slipped, work = slipped + slip, work + reached.work
            way.go(loads, slip)
        after = contact.deformed(reached.solution)
        deformed.append(replace(after, traction=reached.traction))
        states.append(_state_of(grid, reached, after, loads, way.slip))
        slips.append(slipped)
        energies.append(work)
        # what the roller has gone past the ends
        moved.append(float(np.interp(ends, grid.x, grid.x - reached.place).mean()))
    zones = [
        np.interp(stick_zones(grid.x, state, held.friction), grid.x, after.place)
        for state, after in zip(states, deformed, strict=True)
    ]
    lowering, top = None, contact.body.top
    if problem.scene.body.thickness is not None:
        down = contact.body.at_points(deformed[-1].displacement)[top.point, 1]
        lowering = float(np.interp(0.0, top.x, down))
    slipped = SlippedLevel(
        grid=grid,
        states=tuple(states),
        zones=tuple(zones),
        energies=np.array(energies),
        displacements=np.array(moved),
        is_stepped=True,
        material=(problem.scene.coating or problem.scene.body).material,
        slips=np.array(slips),
        place=deformed[-1].place,
        lowering=lowering,
    )
    return slipped, deformed


def _state_of(
    grid: HatGrid,
    held: HeldState,
    deformed: FiniteDeformation,
    loads: Loads,
    slip: np.ndarray,
) -> SlipState:
    """The state as others have it, per deformed area and length."""
    weights, initial = grid.weights, deformed.initial_gap * grid.weights
    moved = (held.gap + held.approach) * weights - initial
    pressing = Constraints(load=float(weights @ held.pressure))
    counts = {"newton_steps": held.iterations}
    normal = assessed(
        *(moved, held.pressure, initial, weights, held.approach, pressing, counts),
        FINITE_TOLERANCE,
    )
    return SlipState(
        loads=loads,
        normal=replace(normal, pressure=deformed.cauchy_pressure, load=loads.normal),
        traction=held.traction / deformed.stretch,
        slip=slip,
        displacement=held.way,
        work=held.work,
        residual=max(held.residual, normal.residuals.worst),
        converged=normal.converged,
    )


def _linear_stress(problem: Problem, operator: MutualCompliance, slipped: SlippedLevel) -> Stressed:
    """Recovered from displacements under the tractions, and the bulk stress."""
    rough, scene = operator.rough, problem.scene
    body, displaced = rough.body, scene.finite_element.gap == "displaced"
    direction = roller_normal(problem) if displaced else straight_down
    layer = scene.coating and scene.coating.material.plane_strain_modulus
    stiffness = np.where(body.coated, layer or 0.0, scene.body.material.plane_strain_modulus)

    def stressed(number: int) -> tuple[NodalStress, SurfaceLoad]:
        state = slipped.states[number]
        pressure, traction = state.normal.pressure, state.traction
        load = SurfaceLoad(body, rough.hats, pressure, np.zeros(1), direction, traction=traction)
        moved = rough.displacement_of(pressure, traction)
        beside = [ends_stress(problem, slipped.grid, state)]
        [nodal] = nodal_stresses(moved[:, None], load, beside)
        strain = bulk_stress(problem, number) / scene.body.material.plane_strain_modulus
        bulk = np.zeros((len(nodal.nodes.point), 3))
        bulk[:, 0] = strain * nodal.nodes.of_triangles(stiffness)
        whole = replace(
            nodal,
            at=lambda node: nodal.at(node) + bulk[node],
            estimate=lambda: nodal.estimate() + bulk,
            together=None,
        )
        return whole, load

    return stressed


def _finite_stress(
    problem: Problem, slipped: SlippedLevel, ends: Sequence[FiniteDeformation]
) -> Stressed:
    """Cauchy's, with what hats leave out next to the ends of contact as at small strains."""

    def stressed(number: int) -> tuple[NodalStress, SurfaceLoad]:
        deformed = ends[number]
        load, nodal = deformed.cauchy.load, deformed.cauchy.nodal
        beside = ends_stress(problem, slipped.grid, slipped.states[number])
        further = FurtherStress(load.surface, (beside,))
        added = further.at(deformed.body.points[nodal.nodes.point])[:, 0]
        whole = replace(nodal, at=lambda node: nodal.at(node) + added[node], further=further)
        return whole, load

    return stressed


def _with_mesh_stress(
    problem: Problem,
    body: ElasticBody,
    slipped: SlippedLevel,
    window: Window,
    stressed: Stressed,
) -> SlippedLevel:
    """With the largest stresses of the rough body at the end of the path."""

    def surface(number: int) -> StressState:
        whole, load = last if number == -1 else stressed(number)
        return evaluate(body, whole, x, load.surface(x))

    last, x = stressed(-1), surface_places(problem, slipped, window)
    bounds = -window.extent, window.extent, window.z[-1]
    tau1 = maximum(body, last[0], lambda stress: stress.tau1, bounds)
    return with_surface(problem, replace(slipped, tau1=tau1, x=x), surface)
