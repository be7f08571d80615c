"""The rough body where it is not linear: at finite deformation, or flowing.

Both start from the linear solution."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from analytic.contact.coupled import solve_coupled
from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution, assessed, solve_contact
from analytic.grid import HatGrid
from analytic.operators.half_plane import ModelOperator
from comparisons.models.finite_element.contact import MutualCompliance
from comparisons.models.finite_element.roller import is_disc, roller_of
from comparisons.models.finite_element.stress import LoadedBody
from comparisons.models.level import STRAIN
from comparisons.models.problem import Problem, mean_height
from fem.body.elasticity import ElasticBody
from fem.nonlinear.finite_deformation import FiniteCompliance, FiniteContact, FiniteDeformation
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody
from fem.nonlinear.press_finite import FiniteLoadHistory
from fem.nonlinear.press_plastic import (
    LoadHistory,
    PlasticContact,
    averaged_pressure,
    plastic_fields,
)
from fem.solver.mumps import FemError
from fem.stress.stress import NodalStress, at_nodes

# What is left of the contact conditions after the last increment of flow.
FLOW_TOLERANCE = 1e-6
# Residuals of a contact at finite deformation, over the displacements; 1e-6 moves figures by 1e-4.
FINITE_TOLERANCE = 1e-7
ENDS = 3.0  # pitches from the pressures' outermost nodes to the end of the trace that bounds them


def pressed_finitely(
    problem: Problem,
    operator: MutualCompliance,
    grid: HatGrid,
    linear: ContactSolution,
    constraints: Constraints,
    model: ModelOperator,
) -> LoadedBody:
    """The body at finite strains, in contact on its deformed surface with a rigid roller or with
    an elastic one at finite strains.

    Pressures are Cauchy's, those on the deformed surface, at its displaced x; a contact length is
    that along x of the deformed configuration. Raises FemError where there is
    no solution, and where contact reaches the grid's ends only at finite deformation."""
    finite = finite_contact(problem, operator, linear, constraints, model)
    refuse_cut_off(problem, grid, finite.pressure, linear.pressure, "at finite deformation")
    counts = {
        "increments": len(finite.solution.residuals),
        "newton_steps": finite.solution.iterations,
        "corrections": finite.solution.corrections,
    } | _of_linear(linear)
    body, cauchy = operator.rough.body, finite.cauchy
    loaded = _deformed(body, grid, finite, constraints, counts, FINITE_TOLERANCE, cauchy.nodal)
    loaded = replace(loaded, across=cauchy.across)
    return _on_undeformed_grid(problem, grid, finite.place, loaded)


def _deformed(
    body: ElasticBody,
    grid: HatGrid,
    finite: FiniteDeformation,
    constraints: Constraints,
    counts: dict[str, int],
    tolerance: float,
    stress: NodalStress,
) -> LoadedBody:
    """A contact on deformed surfaces, at the displaced nodes of the grid."""
    weights, x, pressure = grid.weights, grid.x, finite.pressure
    initial = finite.initial_gap * weights
    if constraints.load is not None:  # of which friction on tilted tangents bears a part
        share = float(weights @ pressure) / finite.load
        constraints = replace(constraints, load=constraints.load * share)
    if np.isfinite(constraints.hardness):  # which caps the pressure by deformed area
        pressure, weights = finite.cauchy_pressure, weights * finite.stretch
    moved = (finite.gap + finite.approach) * weights - initial
    contact_state = moved, pressure, initial, weights, finite.approach, constraints, counts
    solution = assessed(*contact_state, tolerance)
    patches = contact_patches(x, solution.pressure, solution.gap)
    solution = replace(solution, pressure=finite.cauchy_pressure, load=finite.load)
    down = body.at_points(finite.displacement)[body.top.point, 1]
    depth = np.interp(x, body.top.x, down)
    return LoadedBody(
        body,
        solution,
        depth * grid.weights,
        lambda frictions: (stress,) * len(frictions),
        patches,
        moved=finite.displacement,
    )


def _on_undeformed_grid(
    problem: Problem, grid: HatGrid, place: np.ndarray, loaded: LoadedBody
) -> LoadedBody:
    """What was found at nodes that have come to a `place` (count,) [m] along x, interpolated to the
    grid's x. The residuals stay those of the equations that were solved, over the undeformed
    surface."""
    x, height, solution = grid.x, mean_height(problem, grid), loaded.solution
    sunk = height - loaded.displacement / grid.weights
    pressure, gap, now = (
        np.interp(x, place, value) for value in (solution.pressure, solution.gap, sunk)
    )
    return replace(
        loaded,
        solution=replace(solution, pressure=pressure, gap=gap),
        displacement=(height - now) * grid.weights,
        patches=np.interp(loaded.patches, x, place),
        material=np.interp(x, place, x),
    )


def refuse_cut_off(
    problem: Problem, grid: HatGrid, pressure: np.ndarray, linear: np.ndarray, how: str
) -> None:
    """Raise FemError where pressures (count,) [Pa] reach the grid's ends, and the linear ones end
    an element or more before them: on few elements these may."""
    x, profile = grid.x, problem.surface.profile
    ends, nearest = [0, -1], linear[[0, 1, -2, -1]].reshape(2, 2)
    if np.any(pressure[ends] * (nearest == 0.0).all(axis=1)):
        ended = profile is not None and (
            x[0] - profile.x[0] < ENDS * grid.pitch or profile.x[-1] - x[-1] < ENDS * grid.pitch
        )
        beyond = "the trace: take a longer one" if ended else "the pressure elements"
        raise FemError(f"the contact {how} reaches beyond {beyond}")


def _unpressed_contact(
    problem: Problem, operator: MutualCompliance, start: np.ndarray
) -> FiniteContact:
    """Both bodies at finite strains; `start` (count,) [Pa] is the linear pressure of the load."""
    rough, is_rigid = operator.rough, problem.scene.roller.rigid
    roller = roller_of(problem) if is_rigid else operator.parts[1].compliance
    friction = problem.scene.load.friction[0]
    return FiniteContact(rough.body, rough.hats, roller, start, friction, is_disc(problem))


def finite_contact(
    problem: Problem,
    operator: MutualCompliance,
    linear: ContactSolution,
    constraints: Constraints,
    model: ModelOperator,
) -> FiniteDeformation:
    """The contact by the linear model and the linear bodies' own factors; where the strains are too
    large for that, by Newton's method. Raises FemError where that finds none either."""
    start = linear.pressure
    contact = _unpressed_contact(problem, operator, start)
    if np.isfinite(constraints.hardness):  # these factors know one cap for all pressures
        return contact.by_newton(constraints.load, constraints.approach, constraints.hardness)
    bodies, load = FiniteCompliance(contact), constraints.load

    def bearing(pressure: np.ndarray) -> float:
        return load * float(contact.weights @ pressure) / bodies.borne

    settings = bodies, model, contact.gap, contact.weights, constraints, start, FINITE_TOLERANCE
    solver = solve_coupled if operator.coupled else solve_contact
    try:
        solution = solve_with_model(*settings, solver, nearer=True, bearing=load and bearing)
        if solution.converged:
            return contact.deformed(bodies.solution(solution.pressure, solution.approach))
    except FemError:
        pass  # no equilibrium from there by the linear factors
    return contact.by_newton(constraints.load, constraints.approach, constraints.hardness)


def pressed_plastically(
    problem: Problem,
    operator: MutualCompliance,
    grid: HatGrid,
    linear: ContactSolution,
    gap: np.ndarray,
    constraints: Constraints,
    travel: float,
    reached: Callable[[float], None],
) -> LoadedBody:
    """The body flowing where it must, under its load and when the roller is gone again. Where it
    flows, pressures are means over neighbouring hats.

    gap     (count,) [m^2] initial, weighted by each hat
    travel  hats that an edge of the contact may move in one increment of the load
    reached called after each increment with its load over the whole

    Raises FemError where a load is not reached, and where contact spreads to the grid's ends."""
    scene, rough, weights = problem.scene, operator.rough, grid.weights
    friction = scene.load.friction[0]
    roller = operator.parts[1].compliance if len(operator.parts) > 1 else None
    metal = ElasticPlastic(scene.body.material, scene.body.flow_stress())
    way = LoadHistory(rough, metal, gap, weights, linear.pressure, friction, roller, travel)
    loaded, released = way.through((constraints.load, 0.0), reached)
    refuse_cut_off(problem, grid, loaded.pressure, linear.pressure, "of the flowing body")
    moved = rough.weighted(loaded.displacement)
    both = moved if roller is None else moved + roller.apply(loaded.pressure, -friction)
    counts = {"linear_contacts": loaded.iterations} | _of_linear(linear)
    solution = assessed(
        both, loaded.pressure, gap, weights, loaded.approach, constraints, counts, FLOW_TOLERANCE
    )
    fields, others = plastic_fields(way.body, loaded), _of_flow(way.body, loaded, released)
    stress = at_nodes(rough.body, fields.stress)
    patches = contact_patches(grid.x, solution.pressure, solution.gap)
    if loaded.state.equivalent.any():
        solution = replace(solution, pressure=averaged_pressure(solution.pressure))
    return LoadedBody(
        rough.body,
        solution,
        moved,
        lambda frictions: (stress,) * len(frictions),
        patches,
        fields.sy,
        others,
        moved=loaded.displacement,
        bearable=fields.most / 3**0.5,
    )


def pressed_plastically_finitely(
    problem: Problem,
    operator: MutualCompliance,
    grid: HatGrid,
    linear: ContactSolution,
    constraints: Constraints,
    travel: float,
    reached: Callable[[float], None],
) -> LoadedBody:
    """The body flowing at finite strains, under its load and when the roller is gone again; its
    elastic part follows Hencky's law. Pressures are as of `pressed_finitely`, where it flows as of
    `pressed_plastically`. Raises FemError as both."""
    scene, rough = problem.scene, operator.rough
    contact = _unpressed_contact(problem, operator, linear.pressure)
    metal = ElasticPlastic(scene.body.material, scene.body.flow_stress())
    way = FiniteLoadHistory(contact, metal, travel)
    pressed, released = way.through((constraints.load, 0.0), reached)
    finite = pressed.deformed
    refuse_cut_off(problem, grid, finite.pressure, linear.pressure, "of the flowing body")
    counts = {"linear_contacts": pressed.iterations} | _of_linear(linear)
    fields = plastic_fields(way.body, pressed)
    stress = at_nodes(rough.body, fields.stress)
    loaded = _deformed(rough.body, grid, finite, constraints, counts, FLOW_TOLERANCE, stress)
    if pressed.state.equivalent.any():
        averaged = averaged_pressure(loaded.solution.pressure)
        loaded = replace(loaded, solution=replace(loaded.solution, pressure=averaged))
    known = {"across": fields.sy, "bearable": fields.most / 3**0.5}
    loaded = replace(loaded, **known, others=_of_flow(way.body, pressed, released))
    return _on_undeformed_grid(problem, grid, finite.place, loaded)


def _of_linear(linear: ContactSolution) -> dict[str, int]:
    """What the linear contact took that was begun with."""
    return {f"linear_{name}": count for name, count in linear.iterations.items()}


def _of_flow(
    body: PlasticBody, loaded: PlasticContact, released: PlasticContact
) -> dict[str, np.ndarray]:
    """Plastic strain under the load and stresses [Pa] without it, (n,) at the mesh's points."""
    left = plastic_fields(body, released)
    residual = {name: getattr(left.stress, name) for name in ("sx", "sz", "txz")}
    residual |= {"sy": left.sy, "von_mises": left.von_mises}
    strain = plastic_fields(body, loaded).equivalent_strain
    names = ("sx", "sz", "sy", "txz", "von_mises")
    return {STRAIN: strain} | {f"residual_{name}": residual[name] for name in names}
