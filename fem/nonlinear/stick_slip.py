"""Partial slip at finite strains: a roller that friction holds, load by load.

    F(u) - T p - S q                   = 0
    g(u) - w d >= 0,  p >= 0,            complementary
    s = Y_0 - Y(u) = 0 where |q| < mu p; q = mu p where s > 0, q = -mu p where s < 0
    V(p, q) = P,    w'q = Q = share mu w'p

Y is the place on the undeformed roller that is opposite a point of the body: what sticks keeps it
from load to load, whatever strains and turns there, and Y_0 is where a step began (the objective
form of Coulomb's law of one step; of first order in its length, as at small strains). Each step is
Newton's method on its own tangents with the states of all hats fixed: open, sticking, slipping
either way; then hats that violate their state change it (Alart and Curnier 1991, Comput. Methods
Appl. Mech. Eng. 92, 353-375, as an active set).

The roller's way along x is an unknown of its own: moved over the body by v, it is where it was and
the body moved back by v, which changes no strain.

    u      displacement [m] of the body, moved back by v, and of an elastic roller in its own frame
    p, q   hat pressures and tractions towards +x on the body [Pa], along the common normal and
           tangent, per undeformed length of x       mu  friction
    T, S   nodal forces of unit hats of both [m]      F   internal nodal forces [N/m]
    g, s   gap and slip of the roller over the body, weighted by each hat [m^2]
    d, v   approach and way along x of the roller [m]   w   weights [m]
    P, V   load and vertical force of p and q [N/m]     Q   sum of the tractions [N/m]"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import bmat, csr_matrix, hstack

from fem.contact.nonlinear import (
    GROWTH,
    MOST_BISECTIONS,
    OPEN,
    ContactState,
    HatStates,
    NonlinearSolution,
)
from fem.contact.system import ContactSystem, ReusedFactor
from fem.contact.terms import ContactTerms
from fem.nonlinear.finite_deformation import FiniteContact
from fem.solver.mumps import FemError

RESIDUAL = 1e-8  # largest of five, each over what it balances
MOST_ITERATIONS = 40
ACCURACY = 1e-3  # of a step: what is left of its right side
MOST_CUTS = 6  # bisections of a step that fails


@dataclass(frozen=True)
class HeldState:
    """The contact at the end of a step. Nodal values (count,)."""

    displacement: np.ndarray  # (n, 2) [m] of all nodes; the body's are moved back by `way`
    pressure: np.ndarray  # [Pa]
    traction: np.ndarray  # [Pa]
    approach: float  # [m]
    way: float  # v [m] since the bodies did not touch
    load: float  # P [N/m]
    share: float  # Q over that of sliding
    gap: np.ndarray  # [m]
    place: np.ndarray  # [m] mean Y under each hat
    lever: np.ndarray  # slip of the surfaces along their tangent over the change of Y
    slip: np.ndarray  # [m] of the roller over the body in the step, along x of the roller
    work: float  # of friction in the step [J/m]
    residual: float = 0.0
    iterations: int = 0

    @property
    def solution(self) -> NonlinearSolution:
        """As of pressures alone."""
        state = ContactState((self.displacement,), self.pressure, self.approach, self.load)
        return NonlinearSolution(state, self.gap, (), 0)


@dataclass(frozen=True)
class _Point:
    """A state with what Newton's method needs there."""

    state: HeldState
    force: np.ndarray  # F (2n,)
    tangent: csr_matrix
    terms: ContactTerms
    pulled: float  # V over w'p


class HeldContact:
    """Bodies at finite strains whose contact friction may hold.

    contact   body and roller, undeformed, without friction; its `start` pressure is the linear one
              under the largest load
    friction  mu"""

    def __init__(self, contact: FiniteContact, friction: float) -> None:
        self._contact, self.friction = contact, friction
        self.weights = contact.weights
        self._first = len(contact.body.nodes)
        self._held = contact.response.held
        self._free = np.append(np.flatnonzero(~self._held.ravel()), self._held.size)
        self._back = np.zeros(self._held.shape)  # how v moves the nodes
        self._back[: self._first, 0] = -1.0
        start = contact.start
        self._most = float(self.weights @ start)
        self._linear = [
            _linear(contact, pressure, traction)
            for pressure, traction in ((start, 0.0 * start), (0.0 * start, start))
        ]
        diagonal = contact.response.linearised(0.0 * self._held)[1].diagonal()
        self._stiffness = float((contact.response.softness * diagonal)[self._free[:-1]].mean())
        self._factor = ReusedFactor(ACCURACY)

    @property
    def apart(self) -> HeldState:
        """The bodies before they touch."""
        zero = np.zeros_like(self.weights)
        rest = np.zeros(self._held.shape)
        drag = self._contact.contact.at(rest, zero, zero).drag
        place, lever = drag.place / self.weights, drag.lever / self.weights
        return HeldState(rest, zero, zero, 0.0, 0.0, 0.0, 0.0, zero, place, lever, zero, 0.0)

    def history(self, steps: Iterable[tuple[float, float]]) -> Iterator[HeldState]:
        """The states after each step to a load P [N/m] and a share of sliding, from bodies apart.
        Raises FemError where a step, however short, has no solution."""
        state = self.apart
        for load, share in steps:
            state = self.stepped(state, load, share)
            yield state

    def stepped(self, before: HeldState, load: float, share: float, cuts: int = 0) -> HeldState:
        """The state under a load and a share that follows on another; a step that fails is cut in
        two."""
        try:
            return self._ended(before, self._newton(before, load, share))
        except FemError:
            if cuts == MOST_CUTS:
                raise
        # pressed in, contact grows like the root of its load
        middle = 0.25 * (before.load**0.5 + load**0.5) ** 2, 0.5 * (before.share + share)
        first = self.stepped(before, *middle, cuts + 1)
        second = self.stepped(first, load, share, cuts + 1)
        return replace(
            second,
            slip=first.slip + second.slip,
            work=first.work + second.work,
            residual=max(first.residual, second.residual),
            iterations=first.iterations + second.iterations,
        )

    def _guess(self, before: HeldState, load: float, share: float) -> HeldState:
        """The state before and what linear bodies change, which held components keep."""
        pressed = (load - before.load) / self._most
        pulled = self.friction * (share * load - before.share * before.load) / self._most
        moved = pressed * self._linear[0] + pulled * self._linear[1]
        pressure, moved = before.pressure, before.displacement + moved
        if not before.load:  # where linear bodies touch under so little
            begun = self._contact.begun(self._most, None, np.inf)(pressed)
            pressure = begun.pressure
            moved = np.where(self._held, moved, begun.displacements[0])
        return replace(before, displacement=moved, pressure=pressure, load=load, share=share)

    def _at(self, state: HeldState) -> _Point:
        moved, response = state.displacement, self._contact.response
        force, tangent = response.linearised(moved)
        if not np.isfinite(force).all():
            raise FemError("the internal forces are not finite")
        terms = self._contact.contact.at(moved, state.pressure, state.traction)
        applied = terms.gradient @ state.pressure + terms.drag.force @ state.traction
        down = float(applied[1 : 2 * self._first : 2].sum())
        pressing = float(self.weights @ state.pressure)
        pulled = down / pressing if pressing > 0.0 else 1.0
        return _Point(state, force.ravel(), tangent, terms, pulled)

    def _newton(self, before: HeldState, load: float, share: float) -> tuple[_Point, float, int]:
        point = self._at(self._guess(before, load, share))
        states = _SlipStates(point.state.pressure, before.traction, self.weights, load)
        residual, stiff = np.inf, self._stiffness / self.weights.mean()
        for iteration in range(MOST_ITERATIONS):
            gap, slip = self._openings(point, before)
            if iteration:
                residual = self._residual(point, gap, slip)
                if residual <= RESIDUAL:
                    return point, residual, iteration
                states.exchange(point.state.pressure, gap, stiff)
            states.keep_one_in_contact(gap)
            states.turn(point.state, slip, self.friction)
            move = self._step(point, states, gap, slip)
            point = self._moved(point, move, before, residual)
        raise FemError(f"residual {residual:.1e} after {MOST_ITERATIONS} iterations")

    def _openings(self, point: _Point, before: HeldState) -> tuple[np.ndarray, np.ndarray]:
        """Mean gap and slip (count,) [m]."""
        gap = point.terms.gap / self.weights - point.state.approach
        return gap, before.place - point.terms.drag.place / self.weights

    def _residual(self, point: _Point, gap: np.ndarray, slip: np.ndarray) -> float:
        state, terms = point.state, point.terms
        applied = terms.gradient @ state.pressure + terms.drag.force @ state.traction
        soft = np.broadcast_to(self._contact.response.softness, applied.shape)[self._free[:-1]]
        whole = soft * applied[self._free[:-1]]
        left = soft * point.force[self._free[:-1]] - whole
        stiff = self._stiffness / self.weights.mean()
        wanted = np.maximum(state.pressure - stiff * gap, 0.0)
        limit = self.friction * np.maximum(state.pressure, 0.0)
        held = np.clip(state.traction + stiff * slip, -limit, limit)
        size = np.linalg.norm(state.pressure)
        pressing = float(self.weights @ state.pressure)
        pull = float(self.weights @ state.traction) / (self.friction * pressing)
        return max(
            np.linalg.norm(left) / np.linalg.norm(whole),
            np.linalg.norm(state.pressure - wanted) / size,
            np.linalg.norm(state.traction - held) / (self.friction * size),
            abs(point.pulled * pressing / state.load - 1.0),
            abs(pull - state.share),
        )

    def _step(
        self, point: _Point, states: "_SlipStates", gap: np.ndarray, slip: np.ndarray
    ) -> HeldState:
        """Newton's change. Unknowns beside displacements are v, pressures in contact, tractions
        that stick, d; a slipping hat's traction follows its pressure."""
        state, weights, count = point.state, self.weights, len(self.weights)
        touching = states.states != OPEN
        slipping = touching * states.slips * self.friction
        sticking = touching & (states.slips == 0)
        pressure = np.where(touching, state.pressure, 0.0)
        traction = np.where(sticking, state.traction, slipping * pressure)
        asked = state.load / point.pulled
        force, gradient, tangent = self._bordered(point, slipping)
        fixed = np.concatenate([pressure, np.where(sticking, traction, 0.0)])
        internal = np.append(point.force, -state.share * self.friction * asked)
        hats = np.concatenate([np.flatnonzero(touching), count + np.flatnonzero(sticking)])
        both = np.concatenate([weights, np.zeros(count)])
        width, stiff = both.mean(), self._stiffness
        # a hat's place on the roller comes back by what has slipped where it sticks
        openings = np.concatenate([gap * weights, -slip * weights])
        right = [
            (force @ fixed - internal)[self._free] / stiff,
            openings[hats] / width,
            [(asked - weights @ pressure) / stiff],
        ]
        system = ContactSystem(
            bodies=[(tangent, ContactTerms(openings, gradient, force), self._free)],
            flexible=None,
            weights=both,
            hats=hats,
            stiff=stiff,
            loaded=True,
            symmetric=False,
        )
        solution = self._factor.solve(system, np.concatenate(right))
        moving = len(self._free)
        part = np.zeros(self._held.size + 1)
        part[self._free] = solution[:moving]
        fixed[hats] += solution[moving:-1] * stiff / width
        pressed = fixed[:count]
        pulled = np.where(sticking, fixed[count:], slipping * pressed)
        return replace(
            state,
            displacement=part[:-1].reshape(-1, 2) + part[-1] * self._back,
            pressure=pressed - state.pressure,
            traction=pulled - state.traction,
            approach=float(solution[-1]),
            way=float(part[-1]),
        )

    def _bordered(
        self, point: _Point, slipping: np.ndarray
    ) -> tuple[csr_matrix, csr_matrix, csr_matrix]:
        """Forces and gradients (2n + 1, 2 count) of pressures, then of tractions, and the tangent;
        the last row and column are those of v, over w'q."""
        terms, back, drag = point.terms, self._back.ravel(), point.terms.drag
        weights = self.weights
        pulls = bmat([[drag.force], [csr_matrix(-weights[None])]], format="csr")
        presses = bmat([[terms.gradient], [csr_matrix((1, len(weights)))]], format="csr")
        follows = pulls.multiply(slipping[None]).tocsr()
        force = hstack([presses + follows, pulls], format="csr")
        rates = hstack([terms.gradient, drag.travel], format="csr")
        gradient = bmat([[rates], [csr_matrix((rates.T @ back)[None])]], format="csr")
        tangent = point.tangent - terms.stiffness
        # a body that is moved has no other forces but those of contact
        moved = -(terms.stiffness @ back)
        return (
            force,
            gradient,
            bmat([[tangent, csr_matrix(moved[:, None])], [None, [[0.0]]]], "csr"),
        )

    def _moved(self, point: _Point, move: HeldState, before: HeldState, residual: float) -> _Point:
        """The point after a step, bisected until it is acceptable."""
        why, state = "the residual grows", point.state
        for bisection in range(MOST_BISECTIONS + 1):
            part = 0.5**bisection
            names = "displacement", "pressure", "traction", "approach", "way"
            to = {name: getattr(state, name) + part * getattr(move, name) for name in names}
            try:
                reached = self._at(replace(state, **to))
            except FemError as error:
                why = str(error)
                continue
            if np.isinf(residual):
                return reached
            grown = self._residual(reached, *self._openings(reached, before))
            if grown <= GROWTH * max(residual, 1e-3):
                return reached
        raise FemError(f"no step is acceptable: {why}")

    def _ended(self, before: HeldState, reached: tuple[_Point, float, int]) -> HeldState:
        point, residual, iterations = reached
        gap, slip = self._openings(point, before)
        self._contact.response.accept(point.state.displacement)
        lever = point.terms.drag.lever / self.weights
        pressure = np.maximum(point.state.pressure, 0.0)
        # what touched before: the others have moved while they were apart
        rubbing = np.where(before.pressure > 0.0, 0.5 * (pressure + before.pressure), 0.0)
        along = 0.5 * (lever + before.lever) * np.abs(slip) * self.weights
        return replace(
            point.state,
            pressure=pressure,
            gap=gap,
            place=point.terms.drag.place / self.weights,
            lever=lever,
            slip=slip,
            work=float(self.friction * rubbing @ np.where(pressure > 0.0, along, 0.0)),
            residual=residual,
            iterations=iterations,
        )


class _SlipStates(HatStates):
    """States of the hats, and which way (count,) those in contact slip: 1, -1, or stick, 0."""

    def __init__(
        self, pressure: np.ndarray, traction: np.ndarray, weights: np.ndarray, load: float
    ) -> None:
        super().__init__(pressure, np.inf, load, weights)
        self.slips = np.zeros(len(pressure), dtype=int)

    def turn(self, state: HeldState, slip: np.ndarray, friction: float) -> None:
        """Which way each hat slips after a step, by its traction and slip (count,) [m]: one that
        slips against its traction sticks first."""
        over = np.abs(state.traction) > friction * np.maximum(state.pressure, 0.0)
        ahead = np.where(self.slips == 0, over * np.sign(state.traction), self.slips)
        turned = np.where(self.slips * slip < 0.0, 0, ahead).astype(int)
        touching = self.states != OPEN
        if not np.any(touching & (turned == 0)):  # something holds the roller
            pulled = np.sign(np.sum(turned[touching & (self.slips == 0)]))
            others = touching & (turned == -pulled) if pulled else touching
            others = others if others.any() else touching
            turned[np.argmin(np.where(others, np.abs(slip), np.inf))] = 0
        self.slips = turned


def _linear(contact: FiniteContact, pressure: np.ndarray, traction: np.ndarray) -> np.ndarray:
    """Displacement (n, 2) [m] of linear bodies, at held nodes that of a far field or none."""
    parts = [(contact.compliance, traction)]
    if len(contact.elastic) > 1:
        parts.append((contact.roller, -traction))
    moved = []
    for compliance, pull in parts:
        one = compliance.displacement_of(pressure, pull)
        moved.append(one if compliance.far else np.where(compliance.body.held, 0.0, one))
    return np.vstack(moved)
