"""The rough body under load, linear, at finite deformation, or flowing: its surface, its stresses
on the window and at the mesh's points.

What is not linear starts from the linear solution."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution, assessed
from analytic.stress_state import Extremum, von_mises
from comparisons.models.finite_element.contact import SmallStrainContact
from comparisons.models.finite_element.roller import is_disc, roller_of
from comparisons.models.level import STRAIN, MeshField, RecoverableField, StressResult
from comparisons.models.operators import patches_of
from comparisons.models.problem import mean_height
from comparisons.models.readings import ends_of
from comparisons.models.window import Window
from fem.body.elasticity import ElasticBody
from fem.body.triangle import shapes
from fem.nonlinear.finite_deformation import FiniteCompliance, FiniteContact, FiniteDeformation
from fem.nonlinear.plasticity import ElasticPlastic
from fem.nonlinear.press_finite import FiniteLoadHistory
from fem.nonlinear.press_plastic import LoadHistory, averaged_pressure, plastic_fields
from fem.solver.mumps import FemError
from fem.stress.maximum import Search, highest_node, maxima
from fem.stress.stress import NodalStress, at_nodes, evaluate_all

# What is left of the contact conditions after the last increment of flow.
FLOW_TOLERANCE = 1e-6
# Residuals of a contact at finite deformation, over the displacements; 1e-6 moves figures by 1e-4.
FINITE_TOLERANCE = 1e-7
ENDS = 3.0  # pitches from the pressures' outermost nodes to the end of the trace that bounds them


@dataclass(frozen=True)
class LoadedBody:
    """The rough body in contact."""

    body: ElasticBody
    solution: ContactSolution
    displacement: np.ndarray  # (count,) [m^2] of its surface into the body, weighted by each hat
    patches: np.ndarray  # (k, 2) [m] contact patches
    # what stresses of a linear body are recovered from under some friction coefficients; of any
    # other body `stress` and `moved` are known
    linear: Callable[[tuple[float, ...]], RecoverableField] | None = None
    stress: NodalStress | None = None
    moved: np.ndarray | None = None  # (n, 2) [m] at the nodes of the displacement
    # stress across the plane (n,) [Pa] at the mesh's points; a linear body's is nu (sx + sz)
    across: np.ndarray | None = None
    others: dict[str, np.ndarray] = field(default_factory=dict)  # further fields there, by name
    # (n,) [Pa] largest principal shear that a metal bears there; None: any
    bearable: np.ndarray | None = None
    # (count,) [m] where what now stands at the grid's nodes stood without load; None: there
    material: np.ndarray | None = None


def pressed_linearly(contact: SmallStrainContact) -> LoadedBody:
    """The linear elastic body under the pressures of a contact."""
    problem, grid, solution = contact.problem, contact.grid, contact.solution
    rough, pressure, parts = contact.operator.rough, solution.pressure, contact.operator.parts

    def linear(frictions: tuple[float, ...]) -> RecoverableField:
        moved = np.stack([rough.displacement(pressure, friction) for friction in frictions], axis=1)
        body, ends = rough.body, ends_of(problem, grid, solution)
        placed = body.mesh, body.material, body.coating, body.degree, moved
        return RecoverableField(*placed, rough.hats, pressure, frictions, ends)

    scene = problem.scene
    dragged = scene.load.friction[0] if scene.finite_element.coupled else 0.0
    if len(parts) == 1 and not dragged:  # its share of what closed the gap
        both = (solution.gap + solution.approach) * grid.weights - contact.gap
        displacement = both / parts[0].factor
    else:
        displacement = rough.apply(pressure, dragged)
    return LoadedBody(rough.body, solution, displacement, patches_of(grid, solution), linear)


def pressed_finitely(contact: SmallStrainContact) -> LoadedBody:
    """The body at finite strains, in contact on its deformed surface with a rigid roller or with
    an elastic one at finite strains.

    Pressures are Cauchy's, those on the deformed surface, at its displaced x; a contact length is
    that along x of the deformed configuration. Raises FemError where there is
    no solution, and where contact reaches the grid's ends only at finite deformation."""
    finite = finite_contact(contact)
    refuse_cut_off(contact, finite.pressure, "at finite deformation")
    counts = {
        "increments": len(finite.solution.residuals),
        "newton_steps": finite.solution.iterations,
        "corrections": finite.solution.corrections,
    } | _of_linear(contact)
    known = {"stress": finite.cauchy.nodal, "across": finite.cauchy.across}
    return _deformed(contact, finite, counts, FINITE_TOLERANCE, finite.cauchy_pressure, known)


def pressed_plastically(
    contact: SmallStrainContact, travel: float, reached: Callable[[float], None]
) -> LoadedBody:
    """The body flowing where it must, under its load and when the roller is gone again. At finite
    strains its elastic part follows Hencky's law, and pressures are as of `pressed_finitely`. Where
    it flows, pressures are means over neighbouring hats.

    travel  hats that an edge of the contact may move in one increment of the load
    reached called after each increment with its load over the full one

    Raises FemError where a load is not reached, and where contact spreads to the grid's ends."""
    scene, grid, operator = contact.problem.scene, contact.grid, contact.operator
    rough, gap, start = operator.rough, contact.gap, contact.solution.pressure
    friction, is_finite = scene.load.friction[0], scene.finite_element.deformation == "finite"
    roller = operator.parts[1].compliance if len(operator.parts) > 1 else None
    metal = ElasticPlastic(scene.body.material, scene.body.flow_stress())
    if is_finite:
        way = FiniteLoadHistory(_unpressed_contact(contact), metal, travel)
    else:
        way = LoadHistory(rough, metal, gap, grid.weights, start, friction, roller, travel)
    loaded, released = way.through((contact.constraints.load, 0.0), reached)
    refuse_cut_off(contact, loaded.pressure, "of the flowing body")
    counts = {"linear_contacts": loaded.iterations} | _of_linear(contact)
    fields, left = (plastic_fields(way.body, state) for state in (loaded, released))
    residual = {name: getattr(left.stress, name) for name in ("sx", "sz")}
    residual |= {"sy": left.sy, "txz": left.stress.txz, "von_mises": left.von_mises}
    residual = {f"residual_{name}": values for name, values in residual.items()}
    known = {
        "stress": at_nodes(rough.body, fields.stress),
        "across": fields.sy,
        "bearable": fields.most / 3**0.5,
        "others": {STRAIN: fields.equivalent_strain} | residual,
    }
    pressure = loaded.deformed.cauchy_pressure if is_finite else loaded.pressure
    if loaded.state.equivalent.any():
        pressure = averaged_pressure(pressure)
    if is_finite:
        return _deformed(contact, loaded.deformed, counts, FLOW_TOLERANCE, pressure, known)
    moved = rough.weighted(loaded.displacement)
    both = moved if roller is None else moved + roller.apply(loaded.pressure, -friction)
    state = both, loaded.pressure, gap, grid.weights, loaded.approach
    solution = assessed(*state, contact.constraints, counts, FLOW_TOLERANCE)
    patches = contact_patches(grid.x, solution.pressure, solution.gap)
    solution = replace(solution, pressure=pressure)
    return LoadedBody(rough.body, solution, moved, patches, moved=loaded.displacement, **known)


def _deformed(
    contact: SmallStrainContact,
    finite: FiniteDeformation,
    counts: dict[str, int],
    tolerance: float,
    pressure: np.ndarray,
    known: dict[str, Any],
) -> LoadedBody:
    """A contact on deformed surfaces, with what of a `LoadedBody` is `known`. What stands at nodes
    that have come to another x, Cauchy's `pressure` (count,) [Pa] among it, is interpolated to the
    grid's x. The residuals are those of the equations that were solved, over the undeformed
    surface."""
    grid, body, constraints = contact.grid, finite.body, contact.constraints
    x, weights, borne = grid.x, grid.weights, finite.pressure
    initial = finite.initial_gap * weights
    if constraints.load is not None:  # of which friction on tilted tangents bears a part
        share = float(weights @ borne) / finite.load
        constraints = replace(constraints, load=constraints.load * share)
    if np.isfinite(constraints.hardness):  # which caps the pressure by deformed area
        borne, weights = finite.cauchy_pressure, weights * finite.stretch
    moved = (finite.gap + finite.approach) * weights - initial
    state = moved, borne, initial, weights, finite.approach
    solution = assessed(*state, constraints, counts, tolerance)
    patches = contact_patches(x, solution.pressure, solution.gap)
    height = mean_height(contact.problem, grid)
    sunk = height - np.interp(x, body.top.x, body.at_points(finite.displacement)[body.top.point, 1])
    pressure, gap, now = (
        np.interp(x, finite.place, values) for values in (pressure, solution.gap, sunk)
    )
    return LoadedBody(
        body,
        replace(solution, pressure=pressure, gap=gap, load=finite.load),
        (height - now) * grid.weights,
        np.interp(patches, x, finite.place),
        moved=finite.displacement,
        material=np.interp(x, finite.place, x),
        **known,
    )


def refuse_cut_off(contact: SmallStrainContact, pressure: np.ndarray, how: str) -> None:
    """Raise FemError where pressures (count,) [Pa] reach the grid's ends, and the linear ones end
    an element or more before them: on few elements these may."""
    grid, profile = contact.grid, contact.problem.surface.profile
    x, ends = grid.x, [0, -1]
    nearest = contact.solution.pressure[[0, 1, -2, -1]].reshape(2, 2)
    if np.any(pressure[ends] * (nearest == 0.0).all(axis=1)):
        ended = profile is not None and (
            x[0] - profile.x[0] < ENDS * grid.pitch or profile.x[-1] - x[-1] < ENDS * grid.pitch
        )
        beyond = "the trace: take a longer one" if ended else "the pressure elements"
        raise FemError(f"the contact {how} reaches beyond {beyond}")


def _unpressed_contact(linear: SmallStrainContact) -> FiniteContact:
    """Both bodies at finite strains, with the linear pressure of the load."""
    problem, rough, start = linear.problem, linear.operator.rough, linear.solution.pressure
    is_rigid, friction = problem.scene.roller.rigid, problem.scene.load.friction[0]
    roller = roller_of(problem) if is_rigid else linear.operator.parts[1].compliance
    return FiniteContact(rough, roller, start, friction, is_disc(problem))


def finite_contact(linear: SmallStrainContact) -> FiniteDeformation:
    """The contact by the linear model and the linear bodies' own factors; where the strains are too
    large for that, by Newton's method. Raises FemError where that finds none either."""
    start, constraints = linear.solution.pressure, linear.constraints
    contact = _unpressed_contact(linear)
    if np.isfinite(constraints.hardness):  # these factors know one hardness for all hats
        return contact.by_newton(constraints.load, constraints.approach, constraints.hardness)
    bodies, load = FiniteCompliance(contact), constraints.load

    def bearing(pressure: np.ndarray) -> float:
        return load * float(contact.weights @ pressure) / bodies.borne

    posed = bodies, linear.model, contact.gap, contact.weights, constraints, start
    try:
        solution = solve_with_model(*posed, FINITE_TOLERANCE, nearer=True, bearing=load and bearing)
        if solution.converged:
            return contact.deformed(bodies.solution(solution.pressure, solution.approach))
    except FemError:
        pass  # no equilibrium from there by the linear factors
    return contact.by_newton(constraints.load, constraints.approach, constraints.hardness)


def _of_linear(contact: SmallStrainContact) -> dict[str, int]:
    """Counts of the linear contact that was begun with."""
    return {f"linear_{name}": count for name, count in contact.solution.iterations.items()}


def _borne(pressed: LoadedBody, nodal: NodalStress, largest: np.ndarray) -> np.ndarray:
    """Largest shears with x and z (3, k) [Pa], [m], no larger than what a metal bears there:
    between nodes on the yield surface a recovered field may be beyond it."""
    if pressed.bearable is None:
        return largest
    known = np.flatnonzero(~np.isnan(largest[1]))
    element, at = pressed.body.locator(largest[1:, known].T)
    around = pressed.bearable[nodal.nodes.triangles[element]]
    flows = np.isfinite(around).all(axis=1)  # a coating does not
    known, limit = known[flows], (shapes(at[flows]) * around[flows]).sum(axis=1)
    largest[0, known] = np.minimum(largest[0, known], limit)
    return largest


def stresses_of(
    pressed: LoadedBody,
    frictions: tuple[float, ...],
    window: Window,
    asperities: tuple[float, ...] = (),
    fields: int = 1,
) -> tuple[tuple[StressResult, ...], MeshField | RecoverableField | None]:
    """Extremes and fields on the window, one set a friction coefficient, and all on the mesh.

    asperities  (k,) [m] where one ends and the next begins: each has its own largest stresses
    fields      wanted on every so many-th x; 0: stresses are computed only where they may be the
                largest
    """
    body, results = pressed.body, []
    field = linear = pressed.linear and pressed.linear(frictions)
    nodal = linear.on(body) if linear else (pressed.stress,) * len(frictions)
    if fields and not linear:  # first: all nodes are recovered at once
        mises = von_mises(nodal[0].stress, pressed.across)
        others = {"sy": pressed.across, "von_mises": mises, **pressed.others}
        moved = np.stack([pressed.moved] * len(frictions), axis=1)
        field = MeshField.of(body, frictions, nodal, moved, others)
    bounds = (*window.ends, window.z[-1])
    wanted = {
        "tau1": (lambda stress: stress.tau1, asperities),
        "txz": (lambda stress: np.abs(stress.txz), asperities),
    }
    if linear:
        wanted["von_mises"] = (lambda stress: stress.von_mises(stress.poissons_ratio),)
    shown = [None] * len(frictions)
    if fields:
        shown = evaluate_all(body, nodal, *np.meshgrid(window.every(fields).x, window.z))
    searches = [Search(stresses, *how) for stresses in nodal for how in wanted.values()]
    found = iter(maxima(body, searches, bounds))
    for friction, stresses, on_window in zip(frictions, nodal, shown, strict=True):
        places = {name: _borne(pressed, stresses, next(found)) for name in wanted}
        extremes = {name: Extremum.highest(most) for name, most in places.items()}
        if places.pop("von_mises", None) is None:
            extremes["von_mises"] = highest_node(body, stresses, pressed.across, bounds)
        results.append(StressResult(friction, extremes, places, on_window))
    return tuple(results), field if fields else None
