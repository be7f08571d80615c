"""A roller pressed on an elastic-plastic body, released, and pressed again.

Each load is reached in increments from the body's last state; those up to the last one at which
nothing flows are taken at once. The contact is on the undeformed surface, as in the linear theory;
the roller is rigid or elastic. Each increment starts from the contact in which the plastic strain
has gone on as over the last one, and is solved by Newton's method for the body,

    F(u_k) + K_t (u - u_k) - T p = 0   with   g >= 0, p >= 0, complementary, w'p = P,

where `fem.contact.nonlinear` solves the whole linear contact, with its active set. (With one change
of the active set for each Newton step, tension on hats that should open makes the body flow.) Then
a line search: without friction the equilibrium minimises a convex energy, whose slope on the way to
the linear contact,

    s(t) = F(u_k + t du)'du - P dd,   du = u - u_k,   dd the change of the approach,

rises from a negative value. If it is far above zero at the end, the step goes to its zero. With
friction the slope includes the work of the tractions.

Nomenclature as of `fem.contact.nonlinear`, K_t tangent of the body [Pa]."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import csr_matrix

from analytic.stress_state import StressState, von_mises
from fem.body.sums import nodal_sums
from fem.body.triangle import GAUSS, reference_nodes
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import ContactState, solve_nonlinear_contact
from fem.contact.terms import Contact, LinearContact, LinearResponse, Response
from fem.nonlinear.condensed import MOST_HATS, CondensedRoller, ElasticContact
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody, PlasticState
from fem.solver.mumps import FemError, solve_once

# Forces over the contact's forces, at a load and on the way there; the latter moves pressures under
# the load by 1e-8 of the largest, the plastic strain at single points by 1e-5.
RESIDUAL, ON_THE_WAY = 1e-9, 1e-4
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
        self.start, self._matrix = body.linearised(displacement)
        self._there = displacement

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        move = (displacement - self._there).ravel()
        return self.start + (self._matrix @ move).reshape(-1, 2), self._matrix


def newton_by_contacts(
    bodies: Sequence[tuple[Response, Contact]],
    gap: np.ndarray,
    weights: np.ndarray,
    start: ContactState,
    load: float | None = None,
    approach: float | None = None,
    residual: float = RESIDUAL,
) -> tuple[ContactState, list[float]]:
    """Equilibrium under a `load` P [N/m] > 0 or at an `approach` d [m], and the residuals, the last
    one at most the given `residual`. The approach works near the limit load too. The caller accepts
    the displacements into the bodies' histories. Other arguments as of `solve_nonlinear_contact`.
    Raises FemError if it does not converge."""
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
        if part == 1.0 and history[-1] <= residual:
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
        return [body.force(u + part * du) for (body, _), u, du in pairs]

    first = slope([near.start for near in tangents])
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
    """Equilibrium under one load of the history."""

    load: float  # P [N/m]; 0: the roller is removed
    pressure: np.ndarray  # (count,) [Pa]
    approach: float  # d [m]; without the roller that of the last contact
    displacement: np.ndarray  # (n, 2) [m] of the body's nodes
    state: PlasticState  # of the metal at the body's 3m points
    iterations: int  # linear contacts solved since the load before


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

    Raises ValueError for negative loads, FemError if a load cannot be reached."""
    if not loads or not loads[0] > 0.0 or min(loads) < 0.0:
        raise ValueError("the first load must be positive, and none negative")
    way = _LoadHistory(compliance, metal, gap, weights, guess, friction, roller)
    body, history = way.body, []
    for load in loads:
        target = load or min(LAST_TOUCH * max(loads), way.state.load)
        iterations = way.through(np.linspace(way.state.load, target, increments + 1)[1:])
        if load == 0.0:
            way.release()
        pressure = way.state.pressure if load else np.zeros_like(way.state.pressure)
        reached = (way.state.approach, way.state.displacements[0], body.state, iterations)
        history.append(PlasticContact(load, pressure, *reached))
    return body, tuple(history)


class _LoadHistory:
    """The contact from load to load, with what stays elastic condensed.

    body   with its accepted plastic state
    state  of the last contact"""

    def __init__(
        self,
        compliance: FiniteElementCompliance,
        metal: ElasticPlastic,
        gap: np.ndarray,
        weights: np.ndarray,
        guess: np.ndarray,
        friction: float,
        roller: FiniteElementCompliance | None,
    ) -> None:
        self._compliance, self._gap, self._weights = compliance, gap, weights
        self._friction = friction
        self.body = PlasticBody(compliance.body, metal)
        others: list[tuple[Response, Contact]] = []
        self._elastic = None
        if compliance.count <= MOST_HATS:
            flexible = compliance.matrix(friction)
            if roller is not None:
                own = flexible
                if friction or not _alike(roller, compliance):
                    own = roller.matrix(-friction)
                condensed = CondensedRoller(own, weights, not friction)
                others, flexible = [(condensed, condensed)], flexible + own
            self._elastic = ElasticContact(flexible, weights)
        elif roller is not None:
            # its z points away from the body; on it the traction acts towards -x
            others = [(LinearResponse(roller.body), LinearContact(roller, -friction))]
        self._bodies = [(self.body, LinearContact(compliance, friction)), *others]
        moved = tuple(np.zeros(response.held.shape) for response, _ in self._bodies)
        self.state = ContactState(moved, guess, approach=0.0)
        self._former = 0.0, self.body.state  # load and plastic state before the last increment

    def through(self, loads: np.ndarray) -> int:
        """Linear contacts that lead through the loads [N/m] in turn. Those below the last one at
        which nothing has flowed are elastic, too: the way there does not matter."""
        contacts = elastic = 0
        if self._elastic is not None:
            rest = probe = len(loads)
            while elastic < rest:
                contacts += 1
                if self._to_elastic(float(loads[probe - 1])):
                    elastic = probe
                else:
                    rest = probe - 1
                probe = (elastic + rest + 1) // 2
        for load in map(float, loads[elastic:]):
            given = self._bodies, self._gap, self._weights, self._ahead(load), load, None
            left = RESIDUAL if load == loads[-1] else ON_THE_WAY
            try:
                found, residuals = newton_by_contacts(*given, left)
            except FemError as error:
                raise FemError(f"the load of {load:g} N/m was not reached: {error}") from error
            self._accept(found)
            contacts += len(residuals)
        return contacts

    def release(self) -> None:
        """Without the roller."""
        _, *others = self.state.displacements
        free = _released(self.body, self.state.displacements[0])
        self.state = replace(self.state, displacements=(free, *others))

    def _to_elastic(self, load: float) -> bool:
        """Whether nothing flows up to a load [N/m], and then that load."""
        found = self._frozen(load, self.body.state)
        if found is None or self.body.step(found.displacements[0]).yields.any():
            return False
        self._accept(found)
        return True

    def _ahead(self, load: float) -> ContactState:
        """Where to start for a load [N/m]: plastic strain goes on as over the last increment."""
        if self._elastic is None:
            return self.state
        (before, former), now, last = self._former, self.body.state, self.state.load
        part = max(0.0, (load - last) / (last - before)) if last != before else 0.0
        strain = now.strain + part * (now.strain - former.strain)
        return self._frozen(load, replace(now, strain=strain)) or self.state

    def _frozen(self, load: float, plastic: PlasticState) -> ContactState | None:
        """The contact of the bodies in a plastic state that does not change; None: not found."""
        compliance, flowed = self._compliance, self.body.plastic_force(plastic)
        left = compliance.weighted(self.body.body.solve(flowed))
        try:
            pressure, approach = self._elastic(self._gap + left, load, self.state.pressure)
        except FemError:
            return None
        moved = self.body.body.solve(compliance.load(pressure, self._friction) + flowed)
        others = [roller.moved(pressure) for roller, _ in self._bodies[1:]]
        return ContactState((moved, *others), pressure, approach, load)

    def _accept(self, found: ContactState) -> None:
        self._former = self.state.load, self.body.state
        self.body.accept(found.displacements[0])
        self.state = found


def _alike(one: FiniteElementCompliance, other: FiniteElementCompliance) -> bool:
    return one.body is other.body and (one.normal != other.normal).nnz == 0


def _released(body: PlasticBody, displacement: np.ndarray) -> np.ndarray:
    """Displacement (n, 2) of the body without load, accepted into its history."""
    elastic = body.body.solve(body.plastic_force(body.state))
    if not body.step(elastic).yields.any():
        return elastic
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
    """Stresses and plastic strain of a body under a contact of its history. Area-weighted means of
    the linear fields through the three points of each element around a mesh point. Patches of
    higher degree (`fem.stress.recovery`) would overshoot at the plastic zone's kinks."""
    inside, across = body.stress(contact.displacement, contact.state)
    sampled = np.column_stack([inside, across, contact.state.equivalent])
    elements, count = body.body.elements, len(body.body.nodes)
    areas = np.repeat(body.areas.sum(axis=1), 6).reshape(elements.shape)
    values = EXTRAPOLATION @ sampled.reshape(len(elements), 3, -1) * areas[..., None]
    total = nodal_sums(elements, areas, count)
    sx, sz, txz, sy, strain = nodal_sums(elements, values, count).T / total
    return PlasticFields(StressState(sx, sz, txz), sy, np.maximum(strain, 0.0))
