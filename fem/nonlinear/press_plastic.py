"""Newton's method for the contact of a body that flows, each step a whole linear contact.

    F(u_k) + K_t (u - u_k) - T p = 0   with   g >= 0, p >= 0, complementary, w'p = P

is solved to its end by `fem.contact.nonlinear`, hats that touch and that open included; then part
of the way there is gone. Hats and flow in one go, one exchange to one Newton step, lead astray:
tension on hats that should have opened makes a body flow that would not have.

Without friction the states of equilibrium are those of least energy, over displacements that leave
no overlap, and the energy of a step is convex. Along the way to the linear contact its slope

    s(t) = F(u_k + t du)'du - P dd,   du = u - u_k,   dd the change of the approach,

rises from a negative value. Where it is far above zero at the end, its zero is looked for. With
friction, which is no gradient, the slope counts the tractions' work too.

Nomenclature: u displacement [m], p hat pressures [Pa], F internal nodal forces [N/m], K_t tangent
[Pa], T nodal forces of unit hats [m], g weighted gap [m^2], w weights [m], P load [N/m],
d approach [m].

A roller pressed on an elastic-plastic body, let go, and pressed again.

Each load is reached in increments on the body's own history. The body meets the hats where it was
undeformed, as in the linear theory; the roller is rigid or stays elastic. Under a load of zero the
roller is gone and the body left with its residual stresses.

Stress and plastic strain of a pressed metal at the mesh's points.

Known is either at three points of each element, which make a linear field there; a mesh point has
the mean of what the elements around it say, by area. Patches of higher degree, as for elastic
stresses (`fem.stress.recovery`), would overshoot at the edge of the plastic zone, where both have
kinks.
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

# Forces out of balance over the contact's forces.
RESIDUAL = 1e-9
MOST_LINEAR_CONTACTS = 40
# A step is short enough where the energy's slope at its end is below this part of the first one.
SLACK = 0.5
MOST_TRIALS = 12


class _Tangent:
    """A body's response as it is near a displacement: affine, without history."""

    def __init__(self, body: Response, displacement: np.ndarray) -> None:
        self.held, self.symmetric = body.held, body.symmetric
        self.force, self.matrix = body.linearised(displacement)
        self._there = displacement

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        move = (displacement - self._there).ravel()
        return self.force + (self.matrix @ move).reshape(-1, 2), self.matrix

    def accept(self, displacement: np.ndarray) -> None:
        """Nothing: it has no history."""


def newton_by_contacts(
    bodies: Sequence[tuple[Response, Contact]],
    gap: np.ndarray,
    weights: np.ndarray,
    start: ContactState,
    load: float | None = None,
    approach: float | None = None,
) -> tuple[ContactState, list[float]]:
    """State of equilibrium, and the residuals (see RESIDUAL) on the way.

    Under a `load` P [N/m] > 0, or at an `approach` d [m], which still leads on where a load is
    next to what the body can bear. The bodies' histories are left as they are: `accept` is the
    caller's. Other arguments as of `solve_nonlinear_contact`. Raises FemError if it does not
    converge.
    """
    state, history = start, []
    free = [~body.held for body, _ in bodies]
    while len(history) < MOST_LINEAR_CONTACTS:
        tangents = [
            _Tangent(body, u) for (body, _), u in zip(bodies, state.displacements, strict=True)
        ]
        linear = [(near, contact) for near, (_, contact) in zip(tangents, bodies, strict=True)]
        goal = solve_nonlinear_contact(linear, gap, weights, state, load, approach).state
        applied = [
            (contact.at(u, goal.pressure).force @ goal.pressure).reshape(-1, 2)
            for (_, contact), u in zip(bodies, goal.displacements, strict=True)
        ]
        moves = [u - v for u, v in zip(goal.displacements, state.displacements, strict=True)]
        part, forces = _length(bodies, state, moves, applied, tangents)
        state = ContactState(
            tuple(u + part * du for u, du in zip(state.displacements, moves, strict=True)),
            state.pressure + part * (goal.pressure - state.pressure),
            state.approach + part * (goal.approach - state.approach),
            goal.load,
        )
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
    tangents: Sequence[_Tangent],
) -> tuple[float, list[np.ndarray]]:
    """Part of the step that is to be gone, and the bodies' forces at its end."""

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
        part = np.clip(
            low - at_low * (high - low) / (at_high - at_low),
            0.1 * high + 0.9 * low,
            0.9 * high + 0.1 * low,
        )
        forces = forces_at(part)
        here = slope(forces)
        if abs(here) <= SLACK * abs(first):
            break
        if here < 0.0:
            low, at_low = part, here
        else:
            high, at_high = part, here
    return part, forces


# Equal parts of the way from one load to the next. A smooth roller pressed to five times the load
# of first flow: peak pressure 1.6 % high with 8, 0.8 % with 16, 0.4 % with 32; approach 0.1 % with
# 16.
INCREMENTS = 16

# Part of the largest load at which the roller is let go: contact is followed down to there, and
# taken up again from there. Below it rounding of the residual stresses would show.
LAST_TOUCH = 0.01

# Forces out of balance in the released body, of the largest force that its stresses exert anywhere.
BALANCE = 1e-10
MOST_RELEASE_STEPS = 30


@dataclass(frozen=True)
class PlasticContact:
    """One load of the history, in equilibrium to `fem.nonlinear.press_plastic.RESIDUAL`.

    load           P [N/m]; 0: the roller is gone
    pressure       (count,) [Pa]
    approach       d [m]; where the roller is gone that of the last touch
    displacement   (n, 2) [m] of the body's nodes
    state          of the metal at the body's 3m points
    iterations     linear contacts that were solved on the way from the load before
    """

    load: float
    pressure: np.ndarray
    approach: float
    displacement: np.ndarray
    state: PlasticState
    iterations: int


def press_plastically(
    pressed: FiniteElementCompliance,
    metal: ElasticPlastic,
    gap: np.ndarray,
    weights: np.ndarray,
    loads: Sequence[float],
    guess: np.ndarray,
    friction: float = 0.0,
    roller: FiniteElementCompliance | None = None,
    increments: int = INCREMENTS,
) -> tuple[PlasticBody, tuple[PlasticContact, ...]]:
    """The body at the end, and the contact under each of the loads, one after another.

    pressed     the body on the hats, its material the metal's elastic one
    gap         G (count,) [m^2], integral of hat times initial gap
    weights     w (count,) [m], integrals of the hats
    loads       P [N/m] in turn, the first positive; 0 lets the roller go
    guess       pressure (count,) [Pa] whose support is near that under the first load: the elastic
                body's own
    friction    of the traction friction * pressure, towards +x on the body
    roller      the elastic roller's body on the same hats; None: rigid. May be `pressed` itself

    Raises ValueError for loads that cannot be borne, FemError where a load cannot be reached.
    """
    if not loads or not loads[0] > 0.0 or min(loads) < 0.0:
        raise ValueError("the first load must be positive, and none negative")
    body = PlasticBody(pressed.body, metal)
    bodies: list[tuple[Response, Contact]] = [(body, _contact(pressed, friction))]
    if roller is not None:
        # its own z points away from the body, and on it the traction acts towards -x
        bodies.append((LinearResponse(roller.body), _contact(roller, -friction)))

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
        pressure = state.pressure
        if load == 0.0:
            pressure = np.zeros_like(pressure)
            free = _let_go(body, state.displacements[0])
            state = replace(state, displacements=(free, *state.displacements[1:]))
        displacement = state.displacements[0]
        history.append(
            PlasticContact(load, pressure, state.approach, displacement, body.state, iterations)
        )
    return body, tuple(history)


def _contact(compliance: FiniteElementCompliance, friction: float) -> LinearContact:
    body = compliance.body
    tangential = compliance.tangential if friction else None
    return LinearContact(len(body.nodes), body.surface, compliance.normal, friction, tangential)


def _let_go(body: PlasticBody, displacement: np.ndarray) -> np.ndarray:
    """Displacement with no force on the body, which takes it into its history."""
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
    raise FemError("the body without its roller did not come to rest")


# Values at the six nodes of those at the three points, joined linearly.
_EXTENDED = np.column_stack([np.ones(6), reference_nodes(2)]) @ np.linalg.inv(
    np.column_stack([np.ones(3), GAUSS])
)


@dataclass(frozen=True)
class PlasticFields:
    """Under one load, or of what is left without one, at the mesh's n points.

    stress               in the plane (n,) [Pa]
    sy                   across the plane (n,) [Pa]; not nu (sx + sz) where the metal has flowed
    equivalent_strain    equivalent plastic strain (n,), zero where the metal has not flowed
    """

    stress: StressState
    sy: np.ndarray
    equivalent_strain: np.ndarray

    @cached_property
    def von_mises(self) -> np.ndarray:
        """Equivalent stress (n,) [Pa]."""
        return von_mises(self.stress, self.sy)


def plastic_fields(body: PlasticBody, contact: PlasticContact) -> PlasticFields:
    """Stresses and plastic strain of a body under a contact of its history."""
    inside, across = body.stress(contact.displacement, contact.state)
    sampled = np.column_stack([inside, across, contact.state.equivalent])
    sx, sz, txz, sy, strain = _at_points(body, sampled).T
    return PlasticFields(StressState(sx, sz, txz), sy, np.maximum(strain, 0.0))


def _at_points(body: PlasticBody, sampled: np.ndarray) -> np.ndarray:
    """Means (n, k) at the mesh points of values (3m, k) at the elements' three points."""
    elements, areas = body.body.elements, body.areas.sum(axis=1)
    values = _EXTENDED @ sampled.reshape(len(elements), 3, -1) * areas[:, None, None]
    count = len(body.body.nodes)
    total = np.bincount(elements.ravel(), np.repeat(areas, 6), minlength=count)
    columns = [
        np.bincount(elements.ravel(), v.ravel(), minlength=count) for v in values.T.swapaxes(1, 2)
    ]
    return np.column_stack(columns) / total[:, None]
