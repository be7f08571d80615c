"""A roller pressed on an elastic-plastic body, released, and pressed again.

Each load is reached in increments from the body's last state; as far as nothing flows it is reached
at once. The contact is on the undeformed surface, as in the linear theory; the roller is rigid or
elastic. Each increment starts from the contact in which the plastic strain has gone on as over the
last one, and is solved by Newton's method for the body,

    F(u_k) + K_t (u - u_k) - T p = 0   with   g >= 0, p >= 0, complementary, w'p = P,

where `fem.contact.nonlinear` solves the whole linear contact, with its active set. (With one change
of the active set for each Newton step, tension on hats that should open makes the body flow.) Then
a line search: without friction the equilibrium minimises a convex energy, whose slope on the way to
the linear contact,

    s(t) = F(u_k + t du)'du - P dd,   du = u - u_k,   dd the change of the approach,

rises from a negative value. If it is far above zero at the end, the step goes to its zero. With
friction the slope includes the work of the tractions.

The increments follow the contact's edges. Where an edge jumps over several hats in one increment,
the metal below has flowed to the pressure that ended there, and keeps its mark: a peak of pressure
stays at the edge's former place. The next load is therefore the one at which, in the contact that
the increment starts from, no edge of a patch travels further than allowed, one hat by default.

Within one hat an edge cannot be seen. Its last hat carries what lies beyond it until the next one
touches, the metal flows to that, too, and a sawtooth of one hat's width stays in the pressures,
however short the increments are. The mean over neighbouring hats, `averaged_pressure`, converges.

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
from fem.nonlinear.condensed import MOST_HATS, ElasticContact
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody, PlasticState
from fem.solver.mumps import FemError, solve_once

# Forces over the contact's forces, at a load and on the way there; the latter moves pressures under
# the load by 1e-8 of the largest, the plastic strain at single points by 1e-5.
RESIDUAL, ON_THE_WAY = 1e-9, 1e-4
MOST_LINEAR_CONTACTS = 40
# The line search ends where the energy's slope is below this part of the first one.
SLACK = 0.5
MOST_TRIALS = 12

# Hats that an edge of the contact may travel in one increment. Peak pressures of a smooth roller at
# 15 times the load of first yield, of a turned surface, and of a roller just beyond first yield are
# 5, 4 and 0.4 % high with 4 hats, 1, 2 and 0.3 % with 2, and 0.3, 0.4 and 0.1 % with 1.
TRAVEL = 1.0
# An increment is at most this part of the way to the next load for each hat of travel: contact that
# recedes leaves no marks, but what it leaves may flow back.
PART_OF_WAY = 0.25
LEAST_INCREMENT = 1e-3  # of the larger of the loads between which it lies; the first one of a rough
# body, which flows at once, and no increment is shortened further
ROUNDING = 1e-9
LONGER = 2.0  # factor on the next increment, at most
MOST_FAILURES = 3  # increments on the way to a load that are halved as Newton's method fails
ELASTIC_WITHIN = 0.9  # of the load at which flow begins: reached at once

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
    flexible: np.ndarray | None = None,
) -> tuple[ContactState, list[float]]:
    """Equilibrium under a `load` P [N/m] > 0 or at an `approach` d [m], and the residuals, the last
    one at most the given `residual`. `flexible` is the compliance of what stays elastic. The
    approach works near the limit load too. The caller accepts the displacements into the bodies'
    histories. Other arguments as of `solve_nonlinear_contact`. Raises FemError if it does not
    converge."""
    state, history = start, []
    free = [~body.held for body, _ in bodies]
    while len(history) < MOST_LINEAR_CONTACTS:
        starts = zip(bodies, state.displacements, strict=True)
        tangents = [_Linearised(body, u) for (body, _), u in starts]
        linear = [(near, contact) for near, (_, contact) in zip(tangents, bodies, strict=True)]
        goal = solve_nonlinear_contact(
            linear, gap, weights, state, load, approach, flexible=flexible
        ).state
        applied = [
            (contact.at(u, goal.pressure).force @ goal.pressure).reshape(-1, 2)
            for (_, contact), u in zip(bodies, goal.displacements, strict=True)
        ]
        moves = [u - v for u, v in zip(goal.displacements, state.displacements, strict=True)]
        rise = goal.pressure - state.pressure
        elastic_work = 0.0 if flexible is None else float(rise @ flexible @ rise)
        part, forces = _length(bodies, state, moves, applied, tangents, elastic_work)
        change = ContactState(tuple(moves), rise, goal.approach - state.approach)
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
    elastic_work: float,
) -> tuple[float, list[np.ndarray]]:
    """Line search: part of the step to take, and the bodies' forces at its end. `elastic_work` [N]
    is that of the whole change of the pressure on what it moves of the condensed body."""

    def slope(forces: Sequence[np.ndarray], part: float) -> float:
        pairs = zip(forces, applied, moves, strict=True)
        return float(sum(np.sum((f - a) * du) for f, a, du in pairs)) - (1.0 - part) * elastic_work

    def forces_at(part: float) -> list[np.ndarray]:
        pairs = zip(bodies, state.displacements, moves, strict=True)
        return [body.force(u + part * du) for (body, _), u, du in pairs]

    first = slope([near.start for near in tangents], 0.0)
    low, high, at_low, part = 0.0, 1.0, first, 1.0
    forces = forces_at(part)
    at_high = slope(forces, part)
    if at_high <= SLACK * abs(first):
        return part, forces
    for _ in range(MOST_TRIALS):
        zero = low - at_low * (high - low) / (at_high - at_low)
        part = np.clip(zero, 0.1 * high + 0.9 * low, 0.9 * high + 0.1 * low)
        forces = forces_at(part)
        here = slope(forces, part)
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
    travel: float = TRAVEL,
) -> tuple[PlasticBody, tuple[PlasticContact, ...]]:
    """The body at the end, and the contact under each of the loads in turn.

    compliance  the body on the hats; its material is the metal's elastic one
    gap         G (count,) [m^2], integral of hat times initial gap
    weights     w (count,) [m], integrals of the hats
    loads       P [N/m], the first positive; 0 removes the roller
    guess       pressure (count,) [Pa] of the elastic body under the first load
    friction    of the traction friction * pressure, towards +x on the body
    roller      the elastic roller's body on the same hats, may be `compliance`; None: rigid
    travel      hats that an edge of the contact may travel in one increment

    Raises ValueError for negative loads, FemError if a load cannot be reached."""
    if not loads or not loads[0] > 0.0 or min(loads) < 0.0:
        raise ValueError("the first load must be positive, and none negative")
    way = _LoadHistory(compliance, metal, gap, weights, guess, friction, roller, travel)
    body, history = way.body, []
    for load in loads:
        target = load or min(LAST_TOUCH * max(loads), way.state.load)
        iterations = way.to(target)
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
        travel: float,
    ) -> None:
        self._compliance, self._gap, self._weights = compliance, gap, weights
        self._friction, self._travel = friction, travel
        self.body = PlasticBody(compliance.body, metal)
        others: list[tuple[Response, Contact]] = []
        self._elastic = self._flexible = None
        if compliance.count <= MOST_HATS:
            flexible = compliance.matrix(friction)
            if roller is not None:
                own = flexible
                if friction or not _alike(roller, compliance):
                    own = roller.matrix(-friction)
                self._flexible, flexible = own, flexible + own
            self._elastic = ElasticContact(flexible, weights)
        elif roller is not None:
            # its z points away from the body; on it the traction acts towards -x
            others = [(LinearResponse(roller.body), LinearContact(roller, -friction))]
        self._bodies = [(self.body, LinearContact(compliance, friction)), *others]
        moved = tuple(np.zeros(response.held.shape) for response, _ in self._bodies)
        self.state = ContactState(moved, guess, approach=0.0)
        self._former = 0.0, self.body.state  # load and plastic state before the last increment

    def to(self, target: float) -> int:
        """Linear contacts that lead to a load [N/m]."""
        contacts = self._elastically(target)
        way = abs(target - self.state.load)
        least = LEAST_INCREMENT * max(self.state.load, target)
        most = max(least, min(1.0, PART_OF_WAY * self._travel) * way)
        step, failures = most if self.state.load else least, 0
        while self.state.load != target:
            before = self.state
            load, start = self._next(target, step, least)
            step = abs(load - before.load)
            try:
                contacts += self._to_plastic(
                    load, start, RESIDUAL if load == target else ON_THE_WAY
                )
            except FemError as error:
                failures += 1
                if step <= least or failures > MOST_FAILURES:
                    raise FemError(f"the load of {load:g} N/m was not reached: {error}") from error
                step = max(least, 0.5 * step)
                continue
            moved = edge_travel(before.pressure, self.state.pressure)
            step *= min(LONGER, self._travel / moved) if moved else LONGER
            step = float(np.clip(step, least, most))
        return contacts

    def _next(self, target: float, step: float, least: float) -> tuple[float, ContactState]:
        """The next load [N/m], at most a `step` from here and at least the `least` one, and where
        to start for it: as far as no edge travels further than it may."""
        here = self.state.load
        while True:
            # of one length to the target: rounding must not leave a last one of none
            equal = np.ceil((1.0 - ROUNDING) * abs(target - here) / step)
            load = target if equal <= 1.0 else here + (target - here) / equal
            start = self._ahead(load)
            moved = edge_travel(self.state.pressure, start.pressure) if here else 0.0
            if step <= least or moved <= max(1.0, self._travel):
                return load, start
            step = max(least, 0.5 * step)

    def release(self) -> None:
        """Without the roller."""
        _, *others = self.state.displacements
        free = _released(self.body, self.state.displacements[0])
        self.state = replace(self.state, displacements=(free, *others))

    def _elastically(self, target: float) -> int:
        """Elastic contacts that lead towards a load [N/m] as far as nothing flows: the way there
        does not matter."""
        if self._elastic is None:
            return 0
        contacts, first, reached, flows, part = 0, self.state.load, 0.0, 1.0, 1.0
        while flows > LEAST_INCREMENT and reached < ELASTIC_WITHIN * flows:
            contacts += 1
            if self._to_elastic(target if part == 1.0 else first + part * (target - first)):
                reached = part
            else:
                flows = part
            part = 0.5 * (reached + flows)
        return contacts

    def _to_elastic(self, load: float) -> bool:
        """Whether nothing flows up to a load [N/m], and then that load."""
        elastic = self._frozen(load, self.body.state)
        if elastic is None or self.body.step(elastic.displacements[0]).yields.any():
            return False
        self._accept(elastic)
        return True

    def _to_plastic(self, load: float, start: ContactState, residual: float) -> int:
        """Linear contacts that lead to a load [N/m] in one increment. Raises FemError."""
        end, residuals = newton_by_contacts(
            *(self._bodies, self._gap, self._weights, start, load),
            residual=residual,
            flexible=self._flexible,
        )
        self._accept(end)
        return len(residuals)

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
        return ContactState((moved,), pressure, approach, load)

    def _accept(self, found: ContactState) -> None:
        self._former = self.state.load, self.body.state
        self.body.accept(found.displacements[0])
        self.state = found


def edge_travel(before: np.ndarray, after: np.ndarray) -> float:
    """Hats by which the edges of patches advance from a pressure (count,) to another: the longest
    run of hats that join beside a patch, shared by the two patches that it unites. A patch that
    appears has no edge before."""
    joins = (after > 0.0) & ~(before > 0.0)
    stays = np.pad((after > 0.0) & (before > 0.0), 1)
    start, stop = np.flatnonzero(np.diff(np.pad(joins, 1).astype(int))).reshape(-1, 2).T
    sides = stays[start].astype(int) + stays[stop + 1]
    beside = sides > 0
    return float(((stop - start)[beside] / sides[beside]).max(initial=0.0))


def averaged_pressure(pressure: np.ndarray) -> np.ndarray:
    """Mean of the pressure (count,) over neighbouring hats in contact, 1 : 2 : 1, of the same load:
    without the sawtooth that flow leaves between the hats. Curvature lowers a peak by a quarter of
    its second difference, of order two in the hats' width."""
    touching = pressure > 0.0
    flux = np.diff(pressure) * (touching[1:] & touching[:-1])
    return pressure + 0.25 * np.diff(flux, prepend=0.0, append=0.0)


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
