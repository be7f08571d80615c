"""Contact of bodies with a nonlinear response: Newton's method with an active set.

    F_b(u_b) - T_b(u_b) p             = 0    for each body b
    g = G - w d + C p + sum_b g_b(u_b) >= 0,   0 <= p <= H,   complementary
    P - w'p                           = 0    or the approach d prescribed

A hat is open (p = 0), in contact (g = 0) or at the hardness (p = H). Each iteration is a Newton
step with these states fixed; then hats that violate their inequality change their state. Once the
states stay, the method converges quadratically (Hintermueller, Ito and Kunisch 2002, SIAM J. Optim.
13, 865-888). An increment of the load in which it fails is bisected.

Nomenclature
    u      displacement [m]                   F      internal nodal forces [N/m]
    p, H   hat pressures, hardness [Pa]       T      nodal forces of unit hats [m]
    d      approach [m]                       g, G   weighted gap [m^2], its constant part
    P      load [N/m]                         w      weights [m], integrals of the hats
    C      compliance [m^2/Pa] of linear bodies whose displacements are not wanted
    k      mean stiffness [Pa], which makes all unknowns lengths"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import csr_matrix

from fem.compliance.condensed import Condensed
from fem.contact.system import ContactSystem, ReusedFactor
from fem.contact.terms import Contact, ContactTerms, Response
from fem.solver.mumps import FemError, solve_once

# Largest of three residuals: forces over the contact's forces, where the rounding of a stiff body
# counts as little as what it moves; complementarity over the pressure; load over the load. Rounding
# leaves 1e-11 on large graded blocks.
RESIDUAL = 1e-9
MOST_ITERATIONS = 30
# Without a smaller residual, which a hardness that has moved raises at first: those that converge
# take four at most, others go on to the end.
MOST_IDLE = 6
# A step is bisected if it multiplies the residual by more or inverts an element.
GROWTH = 10.0
# A hardness that has moved changes many hats' states at once: up to this residual, all may.
CAPPED_RESIDUAL = 0.1
MOST_BISECTIONS = 6
LEAST_INCREMENT = 1e-3  # as a part of the way from the start to the load
LONGER = 2.0  # factor on the next increment after a successful one

OPEN, CONTACT, CAPPED = -1, 0, 1  # states of a hat
PATIENCE = 3  # exchanges without fewer violations before fewer hats change at a time


class HatStates:
    """The states (count,) of the hats: OPEN, CONTACT or CAPPED (at the hardness).

    All hats that violate their inequality change at once, which may cycle with a hardness. Whenever
    the number of violations has not fallen for PATIENCE exchanges, the part of them that change,
    the worst ones, is halved.

    pressure   guessed (count,) [Pa]: hats are open where it is zero, else in contact or capped
    hardness   [Pa] of all hats, or (count,) of each
    load       P [N/m]; None if the approach is prescribed"""

    def __init__(
        self,
        pressure: np.ndarray,
        hardness: float | np.ndarray,
        load: float | None,
        weights: np.ndarray,
    ) -> None:
        self.states = np.where(pressure > 0.0, CONTACT, OPEN)
        self.states[pressure >= hardness] = CAPPED
        self.hardness, self.load, self.weights = hardness, load, weights
        self._fewest, self._patience, self._share = len(pressure) + 1, PATIENCE, 1.0

    def exchange(self, pressure: np.ndarray, gap: np.ndarray, stiff: float) -> None:
        """Change the states after a step to a pressure (count,) [Pa] and a mean gap [m]. `stiff`
        [Pa/m] makes violations by gaps comparable with those by pressures."""
        joins = (self.states == OPEN) & (gap < 0.0)
        leaves = (self.states == CAPPED) & (gap > 0.0)
        lifts = (self.states == CONTACT) & (pressure < 0.0)
        yields = (self.states == CONTACT) & (pressure > self.hardness)
        violated = joins | leaves | lifts | yields
        count = np.count_nonzero(violated)
        if count < self._fewest:
            self._fewest, self._patience = count, PATIENCE
        else:
            self._patience -= 1
            if self._patience == 0:
                self._share, self._patience = 0.5 * self._share, PATIENCE
        if self._share < 1.0 and count:
            off = np.where(joins | leaves, stiff * np.abs(gap), 0.0)
            off[lifts] = -pressure[lifts]
            off[yields] = (pressure - self.hardness)[yields]
            some = max(1, int(self._share * count))
            violated &= off >= np.sort(off)[-some]
        self.states[violated & (joins | leaves)] = CONTACT
        self.states[violated & lifts] = OPEN
        self.states[violated & yields] = CAPPED

    def are_settled(self, pressure: np.ndarray, gap: np.ndarray) -> bool:
        """Whether no open hat overlaps and none in contact pulls, at a pressure (count,) [Pa] and
        a mean gap [m]."""
        overlaps = (self.states == OPEN) & (gap < 0.0)
        return not (overlaps | ((self.states == CONTACT) & (pressure < 0.0))).any()

    def keep_one_in_contact(self, gap: np.ndarray) -> None:
        """Bring hats into contact if none is under a prescribed load, which fixes the approach."""
        if self.load is None or (self.states == CONTACT).any():
            return
        full = self.states == CAPPED
        if not full.any():
            self.states[np.argmin(gap)] = CONTACT
        elif np.sum((self.hardness * self.weights)[full]) >= self.load:
            self.states[full] = CONTACT
        else:
            self.states[~full] = CONTACT


@dataclass(frozen=True)
class ContactState:
    """Start or end of a solution: `displacements` (n_b, 2) [m] of the bodies, `pressure` (count,)
    [Pa], `approach` [m], and the `load` [N/m] of their last equilibrium, 0 for bodies at rest."""

    displacements: tuple[np.ndarray, ...]
    pressure: np.ndarray
    approach: float
    load: float = 0.0

    def moved(self, part: float, change: "ContactState") -> "ContactState":
        """The state after a `part` of a `change` of displacements, pressure and approach."""
        pairs = zip(self.displacements, change.displacements, strict=True)
        return ContactState(
            tuple(u + part * du for u, du in pairs),
            self.pressure + part * change.pressure,
            self.approach + part * change.approach,
            self.load,
        )


@dataclass(frozen=True)
class ContactPoint:
    """A state with the force, tangent and contact terms of each body there, and the gap."""

    state: ContactState
    bodies: list[tuple[np.ndarray, csr_matrix, ContactTerms]]
    gap: np.ndarray  # g (count,) [m^2]


@dataclass(frozen=True)
class ContactProblem:
    bodies: Sequence[tuple[Response, Contact]]
    constant: np.ndarray
    weights: np.ndarray
    hardness: float | np.ndarray  # of all hats, or (count,) of each
    flexible: np.ndarray | Condensed | None = None  # C (count, count); None: zero
    factor: ReusedFactor | None = None  # solves its systems; None: each has its own

    @cached_property
    def free(self) -> list[np.ndarray]:
        """Components of each body that its support does not hold."""
        return [np.flatnonzero(~body.held.ravel()) for body, _ in self.bodies]

    @cached_property
    def symmetric(self) -> bool:
        return all(body.symmetric and contact.frictionless for body, contact in self.bodies)

    @cached_property
    def stiffness(self) -> float:
        """k of the bodies in series, each with the mean diagonal of its tangent at rest."""
        soft = 0.0
        for (body, _), free in zip(self.bodies, self.free, strict=True):
            diagonal = body.linearised(np.zeros(body.held.shape))[1].diagonal()
            soft += 1.0 / (body.softness * diagonal)[free].mean()
        return 1.0 / soft

    @cached_property
    def stiff(self) -> float:
        """Pressure over gap of one hat [Pa/m]."""
        return self.stiffness / self.weights.mean()

    def at(self, state: ContactState) -> ContactPoint:
        """Raises FemError if a body cannot deform so."""
        bodies: list[tuple[np.ndarray, csr_matrix, ContactTerms]] = []
        for (body, contact), u in zip(self.bodies, state.displacements, strict=True):
            force, tangent = body.linearised(u)
            if not np.isfinite(force).all():
                raise FemError("the internal forces are not finite")
            bodies.append((force.ravel(), tangent, contact.at(u, state.pressure)))
        gap = self.constant + sum(terms.gap for _, _, terms in bodies)
        if self.flexible is not None:
            gap = gap + self.flexible @ state.pressure
        return ContactPoint(state, bodies, gap - state.approach * self.weights)

    def solve(self, system: ContactSystem, right: np.ndarray) -> np.ndarray:
        """Newton's step (size,) of a right side; what a reused factor leaves comes next."""
        if self.factor is None:
            return solve_once(system.matrix(), right, system.symmetric)
        return self.factor.solve(system, right)

    def residual(self, point: ContactPoint, load: float | None) -> float:
        """The largest of the three parts (see RESIDUAL)."""
        pressure = point.state.pressure
        worst = 0.0
        parts = zip(self.bodies, point.bodies, self.free, strict=True)
        for (body, _), (force, _, terms), free in parts:
            applied = terms.force @ pressure
            left = body.softness * (force - applied)
            worst = max(worst, _ratio(left[free], (body.softness * applied)[free]))
        wanted = pressure - self.stiff * point.gap / self.weights
        clipped = np.clip(wanted, 0.0, self.hardness)
        worst = max(worst, _ratio(pressure - clipped, pressure))
        if load is not None:
            worst = max(worst, abs(self.weights @ pressure / load - 1.0))
        return worst


def _ratio(left: np.ndarray, whole: np.ndarray) -> float:
    """Norm of `left` over that of `whole`, or over one if the latter is zero."""
    return float(np.linalg.norm(left)) / (float(np.linalg.norm(whole)) or 1.0)


def newton(
    problem: ContactProblem, guess: ContactState, load: float | None, enough: float = 0.0
) -> tuple[ContactState, np.ndarray, list[float]]:
    """Equilibrium at the load, or at the guess's approach, its mean gaps (count,) [m], and the
    residuals of the iterations, which may end at a part `enough` of the first one or of 1, with
    settled hats. Raises FemError if it does not converge."""
    point = problem.at(guess)
    states = HatStates(guess.pressure, problem.hardness, load, problem.weights)
    history = [problem.residual(point, load)]
    while history[-1] > RESIDUAL:
        iterations = len(history) - 1
        idle = 0 if np.isfinite(problem.hardness).any() else iterations - np.argmin(history)
        if iterations == MOST_ITERATIONS or idle > MOST_IDLE:
            raise FemError(f"residual {history[-1]:.1e} after {iterations} iterations")
        gap = point.gap / problem.weights
        is_enough = history[-1] <= enough * min(1.0, history[0])
        if is_enough and states.are_settled(point.state.pressure, gap):
            break
        if len(history) > 1:
            states.exchange(point.state.pressure, gap, problem.stiff)
        states.keep_one_in_contact(gap)
        move = _step(problem, point, states.states, load)
        point, residual = _moved(problem, point, move, load, history[-1])
        history.append(residual)
    final = np.clip(point.state.pressure, 0.0, problem.hardness)
    total = load if load is not None else float(problem.weights @ final)
    opening = point.gap / problem.weights
    return replace(point.state, pressure=final, load=total), opening, history


def _moved(
    problem: ContactProblem,
    point: ContactPoint,
    move: ContactState,
    load: float | None,
    before: float,
) -> tuple[ContactPoint, float]:
    """The point after the step, bisected until it is acceptable, and the residual there."""
    why = "the residual grows"
    for bisection in range(MOST_BISECTIONS + 1):
        try:
            reached = problem.at(point.state.moved(0.5**bisection, move))
        except FemError as error:
            why = str(error)
            continue
        residual = problem.residual(reached, load)
        least = CAPPED_RESIDUAL if np.isfinite(problem.hardness).any() else RESIDUAL
        if residual <= GROWTH * max(before, least):
            return reached, residual
    raise FemError(f"no step is acceptable: {why}")


def _step(
    problem: ContactProblem, point: ContactPoint, states: np.ndarray, load: float | None
) -> ContactState:
    """Newton's change of the state with given states (count,) of the hats. The unknowns are the
    lengths u, p w / k and d; the equations are divided by k or w."""
    weights, stiff, width = problem.weights, problem.stiffness, problem.weights.mean()
    gap, pressure = point.gap, point.state.pressure
    hats = np.flatnonzero(states == CONTACT)
    fixed = np.where(states == CAPPED, problem.hardness, 0.0)
    fixed[hats] = pressure[hats]

    bodies, right = [], []
    for (force, tangent, terms), free in zip(point.bodies, problem.free, strict=True):
        matrix = tangent if terms.stiffness is None else tangent - terms.stiffness
        bodies.append((matrix, terms, free))
        right.append((terms.force @ fixed - force)[free] / stiff)
    # what hats that open lose in pressure closes the gap of the others no longer
    closed = 0.0
    if problem.flexible is not None and not np.array_equal(fixed, pressure):
        closed = (problem.flexible @ (fixed - pressure))[hats]
    right.append((gap[hats] + closed) / width)
    if load is not None:
        right.append(np.array([(load - weights @ fixed) / stiff]))
    kind = stiff, load is not None, problem.symmetric
    system = ContactSystem(bodies, problem.flexible, weights, hats, *kind)
    solution = problem.solve(system, np.concatenate(right))

    pieces = np.split(solution, np.cumsum([len(part) for part in right])[:-1])
    displacements = []
    for (body, _), free, piece in zip(problem.bodies, problem.free, pieces, strict=False):
        move = np.zeros(body.held.size)
        move[free] = piece
        displacements.append(move.reshape(-1, 2))
    change = fixed - pressure
    change[hats] += pieces[len(problem.bodies)] * stiff / width
    sink = float(pieces[-1][0]) if load is not None else 0.0
    return ContactState(tuple(displacements), change, sink)


@dataclass(frozen=True)
class NonlinearSolution:
    """A converged contact."""

    state: ContactState
    gap: np.ndarray  # (count,) [m] mean opening under each hat
    residuals: tuple[tuple[float, ...], ...]  # of the iterations of each accepted increment
    corrections: int = 0  # by the linear bodies' own factors, in place of Newton steps

    @property
    def iterations(self) -> int:
        """Newton steps of the accepted increments."""
        return sum(len(history) - 1 for history in self.residuals)


def state_at_rest(bodies: Sequence[tuple[Response, Contact]], pressure: np.ndarray) -> ContactState:
    """Undeformed bodies with a guessed pressure (count,), whose support is the first active set."""
    displacements = tuple(np.zeros(body.held.shape) for body, _ in bodies)
    return ContactState(displacements, pressure, approach=0.0)


def solve_nonlinear_contact(
    bodies: Sequence[tuple[Response, Contact]],
    gap: np.ndarray,
    weights: np.ndarray,
    start: ContactState,
    load: float | None = None,
    approach: float | None = None,
    hardness: float | np.ndarray = np.inf,
    begin: Callable[[float], ContactState] | None = None,
) -> NonlinearSolution:
    """Contact under a `load` P [N/m], or at an `approach` d [m], from a given state.

    bodies     each with its kinematics on the common grid of hats
    gap        G (count,) [m^2], the part of the gap that does not depend on displacements
    weights    w (count,) [m], integrals of the hats
    start      an equilibrium, or for bodies at rest (load 0) a guess of the solution: for linear
               bodies only the support of its pressure matters, others need the linear solution.
               Held components keep its displacements, in proportion to the load
    hardness   H [Pa], largest pressure, of all hats or (count,) of each
    begin      guess of the solution under a part of the load, for bodies at rest that `start` in
               proportion does not lead on

    The load is the sum of the pressures; the vertical part of the friction's tractions, of the
    order of friction times slope, is neglected as in the linear theory. Raises ValueError for
    a load that the hats cannot bear, FemError if even the smallest increment fails.
    """
    if (load is None) == (approach is None):
        raise ValueError("give either the load or the approach")
    if load is not None and not 0.0 < load < np.sum(hardness * weights):
        raise ValueError(f"a load of {load:g} N/m is not between zero and what the hats can bear")
    problem = ContactProblem(bodies, gap, weights, hardness)
    first, goal = (start.load, load) if approach is None else (start.approach, approach)
    at_rest = start.load == 0.0
    state, done, step, histories, cuts = start, 0.0, 1.0, [], 0
    while done < 1.0:
        # the last increment ends exactly on the goal
        part = 1.0 if done + step > 1.0 - LEAST_INCREMENT else done + step
        target = goal if part == 1.0 else first + part * (goal - first)
        guess = state
        if at_rest:  # what the supports are moved by grows with the load
            moved = tuple(part * u for u in start.displacements)
            if histories:
                pairs = zip(bodies, moved, state.displacements, strict=True)
                moved = tuple(np.where(body.held, u, now) for (body, _), u, now in pairs)
                guess = replace(state, displacements=moved)
            elif cuts and begin is not None:
                guess = begin(part)
            else:
                guess = replace(start, displacements=moved, pressure=part * start.pressure)
        if load is None:
            guess = replace(guess, approach=target)
        try:
            solution, opening, history = newton(problem, guess, None if load is None else target)
        except FemError as error:
            cuts += 1
            step *= 0.5
            if step < LEAST_INCREMENT:
                raise FemError(
                    f"the contact did not converge beyond {100.0 * done:.3g} % of the load: {error}"
                ) from error
            continue
        for (body, _), displacement in zip(bodies, solution.displacements, strict=True):
            body.accept(displacement)
        histories.append(tuple(history))
        state, done = solution, part
        step = min(1.0, LONGER * step)
    return NonlinearSolution(state, opening, tuple(histories))
