"""A roller pressed on an elastic-plastic body, released, and pressed again.

Each load is reached in increments from the body's last state. The contact is on the undeformed
surface, as in the linear theory; the roller is rigid or elastic. Each increment is solved by
Newton's method for the body,

    F(u_k) + K_t (u - u_k) - T p = 0   with   g >= 0, p >= 0, complementary, w'p = P,

where `fem.contact.nonlinear` solves the whole linear contact, with its active set. (With one change
of the active set for each Newton step, tension on hats that should open makes the body flow.) Then
a line search: without friction the equilibrium minimises a convex energy, whose slope on the way to
the linear contact,

    s(t) = F(u_k + t du)'du - P dd,   du = u - u_k,   dd the change of the approach,

rises from a negative value. If it is far above zero at the end, the step goes to its zero. With
friction the slope includes the work of the tractions.

Nomenclature as of `fem.contact.nonlinear`, K_t tangent of the body [Pa].
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import csr_matrix

from analytic.stress_state import StressState, von_mises
from fem.body.triangle import GAUSS, reference_nodes
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import ContactState, solve_nonlinear_contact, state_at_rest
from fem.contact.terms import Contact, LinearContact, LinearResponse, Response
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody, PlasticState
from fem.solver.mumps import FemError, solve_once

RESIDUAL = 1e-9  # forces over the contact's forces
MOST_LINEAR_CONTACTS = 40
# The line search ends where the energy's slope is below this part of the first one.
SLACK = 0.5
MOST_TRIALS = 12

# Equal increments from one load to the next. A smooth roller at five times the load of first yield:
# peak pressure 1.6, 0.8, 0.4 % high with 8, 16, 32; approach 0.1 % with 16.
INCREMENTS = 16

# Part of the largest load from which the roller is removed, and at which it touches again: less
# would show the rounding of the residual stresses.
LAST_TOUCH = 0.01

BALANCE = 1e-10  # residual forces of the released body over the largest of its stresses
MOST_RELEASE_STEPS = 30

# Values at the six nodes from those at the three points, linear.
EXTRAPOLATION = np.column_stack([np.ones(6), reference_nodes(2)]) @ np.linalg.inv(
    np.column_stack([np.ones(3), GAUSS])
)


class _Linearised(LinearResponse):
    """A body's response linearised at a displacement, without history."""

    def __init__(self, body: Response, displacement: np.ndarray) -> None:
        self.held, self.symmetric = body.held, body.symmetric
        self.force, self._matrix = body.linearised(displacement)
        self._there = displacement

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        move = (displacement - self._there).ravel()
        return self.force + (self._matrix @ move).reshape(-1, 2), self._matrix


def newton_by_contacts(
    bodies: Sequence[tuple[Response, Contact]],
    gap: np.ndarray,
    weights: np.ndarray,
    start: ContactState,
    load: float | None = None,
    approach: float | None = None,
) -> tuple[ContactState, list[float]]:
    """Equilibrium under a `load` P [N/m] > 0 or at an `approach` d [m], and the residuals.

    The approach works near the limit load too. The caller accepts the displacements into the
    bodies' histories. Other arguments as of `solve_nonlinear_contact`. Raises FemError if it does
    not converge.
    """
    state, history = start, []
    free = [~body.held for body, _ in bodies]
    while len(history) < MOST_LINEAR_CONTACTS:
        starts = zip(bodies, state.displacements, strict=True)
        tangents = [_Linearised(body, u) for (body, _), u in starts]
        linear = [(near, contact) for near, (_, contact) in zip(tangents, bodies, strict=True)]
        goal = solve_nonlinear_contact(linear, gap, weights, state, load, approach).state
        applied = [
            (contact.at(u, goal.pressure).force @ goal.pressure).reshape(-1, 2)
            for (_, contact), u in zip(bodies, goal.displacements, strict=True)
        ]
        moves = [u - v for u, v in zip(goal.displacements, state.displacements, strict=True)]
        part, forces = _length(bodies, state, moves, applied, tangents)
        change = ContactState(
            tuple(moves), goal.pressure - state.pressure, goal.approach - state.approach
        )
        state = replace(state.moved(part, change), load=goal.load)
        rest = [np.linalg.norm((f - a)[ok]) for f, a, ok in zip(forces, applied, free, strict=True)]
        size = [np.linalg.norm(a[ok]) for a, ok in zip(applied, free, strict=True)]
        history.append(max(r / s for r, s in zip(rest, size, strict=True)))
        if part == 1.0 and history[-1] <= RESIDUAL:
            return goal, history
    raise FemError(f"residual {history[-1]:.1e} after {MOST_LINEAR_CONTACTS} linear contacts")


def _length(
    bodies: Sequence[tuple[Response, Contact]],
    state: ContactState,
    moves: Sequence[np.ndarray],
    applied: Sequence[np.ndarray],
    tangents: Sequence[_Linearised],
) -> tuple[float, list[np.ndarray]]:
    """Line search: part of the step to take, and the bodies' forces at its end."""

    def slope(forces: Sequence[np.ndarray]) -> float:
        pairs = zip(forces, applied, moves, strict=True)
        return float(sum(np.sum((f - a) * du) for f, a, du in pairs))

    def forces_at(part: float) -> list[np.ndarray]:
        pairs = zip(bodies, state.displacements, moves, strict=True)
        return [body.linearised(u + part * du)[0] for (body, _), u, du in pairs]

    first = slope([near.force for near in tangents])
    low, high, at_low, part = 0.0, 1.0, first, 1.0
    forces = forces_at(part)
    at_high = slope(forces)
    if at_high <= SLACK * abs(first):
        return part, forces
    for _ in range(MOST_TRIALS):
        zero = low - at_low * (high - low) / (at_high - at_low)
        part = np.clip(zero, 0.1 * high + 0.9 * low, 0.9 * high + 0.1 * low)
        forces = forces_at(part)
        here = slope(forces)
        if abs(here) <= SLACK * abs(first):
            break
        if here < 0.0:
            low, at_low = part, here
        else:
            high, at_high = part, here
    return part, forces


@dataclass(frozen=True)
class PlasticContact:
    """Equilibrium under one load of the history.

    load           P [N/m]; 0: the roller is removed
    pressure       (count,) [Pa]
    approach       d [m]; without the roller that of the last contact
    displacement   (n, 2) [m] of the body's nodes
    state          of the metal at the body's 3m points
    iterations     linear contacts solved since the load before
    """

    load: float
    pressure: np.ndarray
    approach: float
    displacement: np.ndarray
    state: PlasticState
    iterations: int


def press_plastically(
    compliance: FiniteElementCompliance,
    metal: ElasticPlastic,
    gap: np.ndarray,
    weights: np.ndarray,
    loads: Sequence[float],
    guess: np.ndarray,
    friction: float = 0.0,
    roller: FiniteElementCompliance | None = None,
    increments: int = INCREMENTS,
) -> tuple[PlasticBody, tuple[PlasticContact, ...]]:
    """The body at the end, and the contact under each of the loads in turn.

    compliance  the body on the hats; its material is the metal's elastic one
    gap         G (count,) [m^2], integral of hat times initial gap
    weights     w (count,) [m], integrals of the hats
    loads       P [N/m], the first positive; 0 removes the roller
    guess       pressure (count,) [Pa] of the elastic body under the first load
    friction    of the traction friction * pressure, towards +x on the body
    roller      the elastic roller's body on the same hats, may be `compliance`; None: rigid

    Raises ValueError for negative loads, FemError if a load cannot be reached.
    """
    if not loads or not loads[0] > 0.0 or min(loads) < 0.0:
        raise ValueError("the first load must be positive, and none negative")
    body = PlasticBody(compliance.body, metal)
    bodies: list[tuple[Response, Contact]] = [(body, LinearContact(compliance, friction))]
    if roller is not None:
        # its z points away from the body; on it the traction acts towards -x
        bodies.append((LinearResponse(roller.body), LinearContact(roller, -friction)))

    state, history = state_at_rest(bodies, guess), []
    for load in loads:
        target = load or min(LAST_TOUCH * max(loads), state.load)
        iterations = 0
        for stage in np.linspace(state.load, target, increments + 1)[1:]:
            try:
                state, residuals = newton_by_contacts(bodies, gap, weights, state, float(stage))
            except FemError as error:
                raise FemError(f"the load of {stage:g} N/m was not reached: {error}") from error
            body.accept(state.displacements[0])
            iterations += len(residuals)
        if load == 0.0:
            free = _released(body, state.displacements[0])
            state = replace(state, displacements=(free, *state.displacements[1:]))
        pressure = state.pressure if load else np.zeros_like(state.pressure)
        reached = (state.approach, state.displacements[0], body.state, iterations)
        history.append(PlasticContact(load, pressure, *reached))
    return body, tuple(history)


def _released(body: PlasticBody, displacement: np.ndarray) -> np.ndarray:
    """Displacement (n, 2) of the body without load, accepted into its history."""
    free = np.flatnonzero(~body.held.ravel())
    scale = np.abs(body.force_of(body.stress(displacement, body.state)[0])).max()
    for _ in range(MOST_RELEASE_STEPS):
        force, tangent = body.linearised(displacement)
        rest = force.ravel()[free]
        if np.abs(rest).max() <= BALANCE * scale:
            body.accept(displacement)
            return displacement
        move = np.zeros(displacement.size)
        move[free] = solve_once(tangent[free][:, free].tocsr(), -rest, symmetric=True)
        displacement = displacement + move.reshape(-1, 2)
    raise FemError("the equilibrium of the released body did not converge")


@dataclass(frozen=True)
class PlasticFields:
    """Fields at the mesh's n points under one load."""

    stress: StressState  # (n,) [Pa] in the plane
    sy: np.ndarray  # (n,) [Pa] across the plane, nu (sx + sz) only without plastic strain
    equivalent_strain: np.ndarray  # equivalent plastic strain (n,)

    @cached_property
    def von_mises(self) -> np.ndarray:
        """Equivalent stress (n,) [Pa]."""
        return von_mises(self.stress, self.sy)


def plastic_fields(body: PlasticBody, contact: PlasticContact) -> PlasticFields:
    """Stresses and plastic strain of a body under a contact of its history.

    Area-weighted means of the linear fields through the three points of each element around a mesh
    point. Patches of higher degree (`fem.stress.recovery`) would overshoot at the kinks on the
    boundary of the plastic zone.
    """
    inside, across = body.stress(contact.displacement, contact.state)
    sampled = np.column_stack([inside, across, contact.state.equivalent])
    elements, areas = body.body.elements, body.areas.sum(axis=1)
    values = EXTRAPOLATION @ sampled.reshape(len(elements), 3, -1) * areas[:, None, None]

    def summed(weights: np.ndarray) -> np.ndarray:
        return np.bincount(elements.ravel(), weights, minlength=len(body.body.nodes))

    total = summed(np.repeat(areas, 6))
    sx, sz, txz, sy, strain = (summed(v.ravel()) / total for v in values.T.swapaxes(1, 2))
    return PlasticFields(StressState(sx, sz, txz), sy, np.maximum(strain, 0.0))
