"""A roller pressed on an elastic-plastic body, and released.

Each load is reached in increments from the body's last state; as far as nothing flows it is reached
at once. The contact is on the undeformed surface, as in the linear theory; the roller is rigid or
elastic. Each increment starts from the contact in which the plastic strain has gone on as over the
last one, and is solved by `fem.nonlinear.newton`.

The increments follow the contact's edges. Where an edge jumps over several hats in one increment,
the metal below has flowed to the pressure that ended there, and keeps its mark: a peak of pressure
stays where the edge was before. The next load is therefore the one at which, in the contact that
the increment starts from, the edges of patches travel as far as allowed, one hat by default. Of
many edges that is the mean: those that run ahead close gaps of small slope, and their marks are
small.

Within one hat an edge cannot be seen. Its last hat carries what lies beyond it until the next one
touches, the metal flows to that, too, and a sawtooth of one hat's width stays in the pressures,
however short the increments are. The mean over neighbouring hats, `averaged_pressure`, converges.

Nomenclature as of `fem.contact.nonlinear`."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from analytic.stress_state import StressState, von_mises
from fem.body.sums import nodal_sums
from fem.body.triangle import GAUSS, reference_nodes
from fem.compliance.condensed import Condensed, ShiftInvariant
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import ContactState
from fem.contact.system import ReusedFactor
from fem.contact.terms import LinearContact
from fem.nonlinear.elastic_contact import ElasticContact, on_vertices
from fem.nonlinear.newton import ACCURACY, RESIDUAL, newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody, PlasticState
from fem.solver.mumps import FemError, solve_once
from fem.stress.recovery import stress_nodes

# Residual on the way to a load: it moves pressures under the load by 1e-8 of the largest, the
# plastic strain at single points by 1e-5. With 1e-3 it takes a seventh of the linear contacts less;
# with 3e-3 predicted edges are so inaccurate that a finer rough trace takes 88 increments in place
# of 53.
ON_THE_WAY = 1e-4

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
SHORTER = 0.25, 0.9  # factors on an increment in which edges would travel too far
MOST_FAILURES = 3  # increments on the way to a load that are halved as Newton's method fails;
# then those of the approach are, so many times one after the other, of so many
MOST_HALVINGS, MOST_SINKING = 6, 200
ELASTIC_WITHIN = 0.9  # of the load at which flow begins: reached at once
DOUBT = 2.0  # factor on the load at which flow is expected to begin: beyond it there is none

# Part of the load before from which the roller is removed: less would show the rounding of the
# residual stresses.
LAST_TOUCH = 0.01

BALANCE = 1e-10  # residual forces of the released body over the largest of its stresses
MOST_RELEASE_STEPS = 30

# Values at the six nodes from those at the three points, linear.
EXTRAPOLATION = np.column_stack([np.ones(6), reference_nodes(2)]) @ np.linalg.inv(
    np.column_stack([np.ones(3), GAUSS])
)


@dataclass(frozen=True)
class PlasticContact:
    """Equilibrium under one load of the history."""

    load: float  # P [N/m]; 0: the roller is removed
    pressure: np.ndarray  # (count,) [Pa]
    approach: float  # d [m]; without the roller that of the last contact
    displacement: np.ndarray  # (n, 2) [m] of the body's nodes
    state: PlasticState  # of the metal at the body's 3m points
    iterations: int  # linear contacts solved since the load before


class LoadHistory:
    """A roller that presses a body which flows, from load to load, with what stays elastic
    condensed.

    compliance  the body on the hats; its material is the metal's elastic one
    gap         G (count,) [m^2], integral of hat times initial gap
    weights     w (count,) [m], integrals of the hats
    guess       pressure (count,) [Pa] of the elastic body under the first load
    friction    of the traction friction * pressure, towards +x on the body
    roller      the elastic roller's body on the same hats, may be `compliance`; None: rigid
    travel      hats that an edge of the contact may travel in one increment
    body        with its accepted plastic state
    state       of the last contact"""

    kind = PlasticBody

    def __init__(
        self,
        compliance: FiniteElementCompliance,
        metal: ElasticPlastic,
        gap: np.ndarray,
        weights: np.ndarray,
        guess: np.ndarray,
        friction: float = 0.0,
        roller: FiniteElementCompliance | None = None,
        travel: float = TRAVEL,
    ) -> None:
        self._compliance, self._gap, self._weights = compliance, gap, weights
        self._friction, self._travel = friction, travel
        self.body = self.kind(compliance.body, metal)
        alone = Condensed(partial(compliance.columns, friction=friction), len(weights))
        self._flexible, both = None, [alone]
        if roller is not None:
            # its z points away from the body; on it the traction acts towards -x
            self._flexible = alone
            alike = roller.body is compliance.body and (roller.normal != compliance.normal).nnz == 0
            if friction or not alike:
                columns = partial(roller.columns, friction=-friction)
                self._flexible = Condensed(columns, len(weights))
            both = [alone, self._flexible]
        touching = np.flatnonzero(guess > 0.0)
        near = ShiftInvariant(lambda hats: sum(one.of(hats) for one in both), len(gap), touching)
        self._nearly = ElasticContact(near, weights)
        self._offset = np.zeros_like(gap)  # of its gap, which makes it right in the last contact
        self._bodies = [(self.body, LinearContact(compliance, friction))]
        self.state = ContactState((np.zeros(self.body.held.shape),), guess, approach=0.0)
        self._factor = ReusedFactor(ACCURACY)
        if roller is not None:
            self._factor = ReusedFactor(ACCURACY, [on_vertices(roller)])
        # load, plastic state and contact before the last increment
        self._former, self._last = (0.0, self.body.state), self.state

    def through(
        self, loads: Sequence[float], reached: Callable[[float], None] = lambda share: None
    ) -> tuple[PlasticContact, ...]:
        """The contact under each of the loads P [N/m] in turn, the first positive; 0 removes the
        roller. `reached` is called after each increment with its load over the largest. Raises
        ValueError for negative loads, FemError if a load cannot be reached."""
        self._reached = lambda load: reached(load / max(loads))
        if not loads or not loads[0] > 0.0 or min(loads) < 0.0:
            raise ValueError("the first load must be positive, and none negative")
        history = []
        for load in loads:
            iterations = self.to(load or LAST_TOUCH * self.state.load)
            if load == 0.0:
                self.release()
            history.append(self.contact(load, iterations))
        return tuple(history)

    def contact(self, load: float, iterations: int) -> PlasticContact:
        """Contact that linear contacts reached, under a load or without the roller."""
        pressure = self.state.pressure if load else np.zeros_like(self.state.pressure)
        displacement, state = self.state.displacements[0], self.body.state
        return PlasticContact(load, pressure, self.state.approach, displacement, state, iterations)

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
                residual = RESIDUAL if load == target else ON_THE_WAY
                end, count = self._solved(start, load, None, residual)
            except FemError as failure:
                failures += 1
                if step <= least or failures > MOST_FAILURES:
                    try:
                        return contacts + self._sink(target, failure)
                    except FemError as error:
                        why = f"the load of {target:g} N/m was not reached: {error}"
                        raise FemError(why) from error
                step = max(least, 0.5 * step)
                continue
            self._accept(end)
            self._reached(end.load)
            contacts += count
            moved = edge_travel(before.pressure, self.state.pressure)
            step *= min(LONGER, self._travel / moved) if moved else LONGER
            step = float(np.clip(step, least, most))
        return contacts

    def _sink(self, target: float, failure: FemError) -> int:
        """Linear contacts that lead to a load [N/m] by increments of the approach, where those of
        the load end with a failure. Where a metal is nearly rigid the load hardly rises until
        further hats touch, and tells nothing of how far the roller sinks; the approach does. The
        last increment ends on the load."""
        sign, contacts, failures = np.sign(target - self.state.load), 0, 0
        way = sign * abs(self.state.approach - self._last.approach)
        if not way:
            raise failure
        for _ in range(MOST_SINKING):
            here, goal = self.state, self.state.approach + way
            try:
                end, count = self._solved(self._onward(way), None, goal, ON_THE_WAY)
                contacts += count
                if sign * (end.load - here.load) <= 0.0:
                    raise FemError(f"it ends at {here.load:g} N/m, where the roller sinks on")
                if sign * (end.load - target) >= 0.0:
                    part = (target - here.load) / (end.load - here.load)
                    end, count = self._solved(self._onward(part * way), target, None, RESIDUAL)
                    contacts += count
            except FemError:
                failures, way = failures + 1, 0.5 * way
                if failures > MOST_HALVINGS:
                    raise
                continue
            self._accept(end)
            self._reached(end.load)
            if end.load == target:
                return contacts
            failures, moved = 0, edge_travel(here.pressure, end.pressure)
            way *= min(LONGER, self._travel / moved) if moved else LONGER
        raise FemError(f"it was {self.state.load:g} N/m after {MOST_SINKING} increments")

    def _onward(self, way: float) -> ContactState:
        """The state after a further approach [m], displaced as it was over the last increment."""
        part = way / (self.state.approach - self._last.approach)
        pairs = zip(self.state.displacements, self._last.displacements, strict=True)
        return replace(self.state, displacements=tuple(u + part * (u - v) for u, v in pairs))

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
            step = max(least, step * float(np.clip(self._travel / moved, *SHORTER)))

    def release(self) -> None:
        """Without the roller."""
        _, *others = self.state.displacements
        free = _released(self.body, self.state.displacements[0])
        self.state = replace(self.state, displacements=(free, *others))

    def _elastically(self, target: float) -> int:
        """Elastic contacts that lead towards a load [N/m] as far as nothing flows: the way there
        does not matter. Loads at which stresses, which grow with the root of the first load or
        faster, surely flow are not tried."""
        contacts, first, reached, flows, part = 0, self.state.load, 0.0, 1.0, 1.0
        surely = np.inf
        while flows > LEAST_INCREMENT and reached < ELASTIC_WITHIN * flows:
            excess = np.inf
            if part < surely:
                contacts += 1
                excess = self._to_elastic(
                    target if part == 1.0 else first + part * (target - first)
                )
                if not first and 1.0 < excess < np.inf:
                    surely = min(surely, DOUBT * part / excess**2)
            if excess < 1.0:
                reached = part
            else:
                flows = part
            # a body that has flowed mostly flows again at once
            at_once = first > 0.0 and not reached and flows == 1.0
            part = LEAST_INCREMENT if at_once else 0.5 * (reached + flows)
        return contacts

    def _to_elastic(self, load: float) -> float:
        """Go to a load [N/m] if nothing flows up to there, and then 0; else how many times the flow
        stress is exceeded there, infinite where that is not known."""
        start = self._near(load, self.body.state)
        if start is None:
            return np.inf
        if (excess := self._excess(start)) > 1.0:
            return excess
        try:
            end, _ = self._solved(start, load, None, RESIDUAL)
        except FemError:
            return np.inf
        if (excess := self._excess(end)) > 1.0:
            return excess
        self._accept(end)
        return 0.0

    def _excess(self, state: ContactState) -> float:
        """The largest equivalent stress, if nothing flowed, over the flow stress; at least 1."""
        metal, before = self.body.metal, self.body.state
        step = self.body.step(state.displacements[0][: len(self.body.held)])
        if not step.yields.any():
            return 1.0
        before, after = before.equivalent[step.yields], step.state.equivalent[step.yields]
        stiffness = 3.0 * metal.elastic.shear_modulus + metal.hardening.kinematic
        beyond = stiffness * (after - before) + metal.hardening.stress(after)
        return float((beyond / metal.hardening.stress(before)).max())

    def _solved(
        self, start: ContactState, load: float | None, approach: float | None, residual: float
    ) -> tuple[ContactState, int]:
        """The contact under a load [N/m] or at an approach [m], and the linear contacts to it."""
        end, residuals = newton_by_contacts(
            *(self._bodies, self._gap, self._weights, start, load, approach),
            residual=residual,
            flexible=self._flexible,
            factor=self._factor,
        )
        return end, len(residuals)

    def _ahead(self, load: float) -> ContactState:
        """Start for a load [N/m]: plastic strain goes on as over the last increment."""
        (before, former), now, last = self._former, self.body.state, self.state.load
        part = max(0.0, (load - last) / (last - before)) if last != before else 0.0
        strain = now.strain + part * (now.strain - former.strain)
        return self._near(load, replace(now, strain=strain)) or self.state

    def _near(self, load: float, plastic: PlasticState) -> ContactState | None:
        """Near the contact of the bodies in a plastic state that does not change: right in the last
        contact, from there on by the nearly right compliance. None: not found."""
        flowed = self.body.plastic_force(plastic)
        change = self.body.body.solve(flowed - self.body.plastic_force(self.body.state))
        gap = self._gap + self._offset + self._compliance.weighted(change)
        try:
            pressure, approach = self._nearly(gap, load, self.state.pressure)
        except FemError:
            return None
        moved = self.body.body.solve(self._compliance.load(pressure, self._friction) + flowed)
        return ContactState((moved,), pressure, approach, load)

    def _accept(self, state: ContactState) -> None:
        self._former, self._last = (self.state.load, self.body.state), self.state
        self.body.accept(state.displacements[0])
        self.state = state
        self._offset = self._compliance.weighted(state.displacements[0])
        self._offset -= self._nearly.flexible @ state.pressure
        if self._flexible is not None:
            self._offset += self._flexible @ state.pressure


def edge_travel(before: np.ndarray, after: np.ndarray) -> float:
    """Hats by which the edges of patches advance from a pressure (count,) to another, in the mean:
    the hats that join beside patches, over the patches' edges. A patch that appears has no edge
    before, and edges that recede count as none."""
    edges = np.count_nonzero(np.diff(np.pad(before > 0.0, 1).astype(int)))
    joins = (after > 0.0) & ~(before > 0.0)
    stays = np.pad((after > 0.0) & (before > 0.0), 1)
    start, stop = np.flatnonzero(np.diff(np.pad(joins, 1).astype(int))).reshape(-1, 2).T
    beside = stays[start] | stays[stop + 1]
    return float((stop - start)[beside].sum() / max(1, edges))


def averaged_pressure(pressure: np.ndarray) -> np.ndarray:
    """Mean of the pressure (count,) over neighbouring hats in contact, 1 : 2 : 1, of the same load:
    without the sawtooth that flow leaves between the hats. Curvature lowers a peak by a quarter of
    its second difference, of order two in the hats' width."""
    touching = pressure > 0.0
    flux = np.diff(pressure) * (touching[1:] & touching[:-1])
    return pressure + 0.25 * np.diff(flux, prepend=0.0, append=0.0)


def _released(body: PlasticBody, displacement: np.ndarray) -> np.ndarray:
    """Displacement (n, 2) of the body without load, accepted into its history."""
    elastic = body.body.solve(body.plastic_force(body.state))
    if not body.step(elastic).yields.any():
        return elastic
    scale = np.abs(body.force_of(body.stress(displacement, body.state)[0])).max()
    return unloaded(body, displacement, scale)


def unloaded(body: PlasticBody, displacement: np.ndarray, scale: float) -> np.ndarray:
    """Displacement (n, 2) [m] of the body without load, accepted into its history, from a guess.
    Forces that are left are compared with a `scale` [N/m]. Raises FemError without convergence."""
    free = np.flatnonzero(~body.held.ravel())
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
    """Fields at n nodes under one load: the mesh's points, on a coating's interface one for each
    material (`fem.stress.recovery.stress_nodes`)."""

    stress: StressState  # (n,) [Pa] in the plane
    sy: np.ndarray  # (n,) [Pa] across the plane, nu (sx + sz) only without plastic strain
    equivalent_strain: np.ndarray  # equivalent plastic strain (n,)
    # (n,) [Pa] the largest equivalent stress that the metal bears there, infinite in a coating
    most: np.ndarray

    @cached_property
    def von_mises(self) -> np.ndarray:
        """Equivalent stress (n,) [Pa]."""
        return von_mises(self.stress, self.sy)


def plastic_fields(body: PlasticBody, contact: PlasticContact) -> PlasticFields:
    """Stresses and plastic strain of a body under a contact of its history. Area-weighted means of
    the linear fields through the three points of each element around a node. Patches of
    higher degree (`fem.stress.recovery`) would overshoot at the plastic zone's kinks. Means that
    do are returned along the radius, to what the metal bears at the plastic strain there."""
    inside, across = body.stress(contact.displacement, contact.state)
    sampled = np.column_stack([inside, across, contact.state.equivalent])
    nodes = stress_nodes(body.body)
    elements, count = nodes.triangles, len(nodes.point)
    areas = np.repeat(body.areas.sum(axis=1), 6).reshape(elements.shape)
    values = EXTRAPOLATION @ sampled.reshape(len(elements), 3, -1) * areas[..., None]
    total = nodal_sums(elements, areas, count)
    sx, sz, txz, sy, strain = nodal_sums(elements, values, count).T / total
    strain, mean = np.maximum(strain, 0.0), (sx + sz + sy) / 3.0
    most = np.where(nodes.of_triangles(body.body.coated), np.inf, body.bearable(strain, mean))
    found = von_mises(StressState(sx, sz, txz), sy)
    share = np.divide(most, found, out=np.ones_like(found), where=found > most)
    sx, sz, sy = (mean + share * (part - mean) for part in (sx, sz, sy))
    return PlasticFields(StressState(sx, sz, share * txz), sy, strain, most)
