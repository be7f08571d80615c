"""Which hats touch, which are open, which are at the hardness: how that changes between steps.

A hat that breaks its sign condition changes sides: an open one that overlaps and a crushed one
that opens are freed, a free one goes to the bound that its pressure is beyond. All at once is
quickest and may cycle with a hardness. When the number of broken conditions has not fallen for
PATIENCE exchanges, only the worst of them go, half as many each time that this happens again.

Newton's method for a contact with nonlinear bodies at one load (`fem.contact.nonlinear`).

Nomenclature: u displacement [m], p hat pressures [Pa], d approach [m], F internal nodal forces
[N/m], T nodal forces of unit hats [m], g weighted gap [m^2], w weights [m], P load [N/m],
H hardness [Pa], k a mean stiffness [Pa] that makes all unknowns lengths.

Contact of bodies with a nonlinear response: Newton's method with an active set.

    F_b(u_b) - T_b(u_b) p             = 0    for each body b
    g = G - w d + sum_b g_b(u_b)     >= 0,   0 <= p <= H,   complementary
    P - w'p                           = 0    or the approach d prescribed

A hat touches (g = 0), is open (p = 0) or is at the hardness (p = H). With these sides fixed each
iteration is a Newton step, after which hats change sides (`fem.contact.nonlinear`); once they stay
as they are it converges quadratically (Hintermueller, Ito and Kunisch 2002, SIAM J. Optim. 13,
865-888).

The load grows in increments. One in which Newton's method fails is halved and tried again.

Nomenclature: u displacement [m], p hat pressures [Pa], d approach [m], F internal nodal forces
[N/m], T nodal forces of unit hats [m], g weighted gap [m^2], G its constant part, w weights [m],
P load [N/m], H hardness [Pa].
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import bmat, csr_matrix

from fem.contact.terms import Contact, ContactTerms, Response
from fem.solver.mumps import FemError, solve_once

OPEN, FREE, FULL = -1, 0, 1
PATIENCE = 3


class Exchanges:
    """The sides (count,) of the hats, each OPEN, FREE or FULL, and how exchanges went so far.

    pressure   guessed (count,) [Pa]: hats are open where it is zero, else free
    hardness   H [Pa]
    load       P [N/m] if it is prescribed: some hat must be free then
    weights    w (count,) [m]
    """

    def __init__(
        self, pressure: np.ndarray, hardness: float, load: float | None, weights: np.ndarray
    ) -> None:
        self.sides = np.where(pressure > 0.0, FREE, OPEN)
        self.hardness, self.load, self.weights = hardness, load, weights
        self._fewest, self._patience, self._share = len(pressure) + 1, PATIENCE, 1.0

    def exchange(self, pressure: np.ndarray, gap: np.ndarray, stiff: float) -> None:
        """Change the sides after a step that led to a pressure (count,) [Pa] and a mean gap [m].

        `stiff` [Pa/m] makes pressures and gaps comparable where the worst are looked for.
        """
        joins = (self.sides == OPEN) & (gap < 0.0)
        leaves = (self.sides == FULL) & (gap > 0.0)
        lifts = (self.sides == FREE) & (pressure < 0.0)
        yields = (self.sides == FREE) & (pressure > self.hardness)
        broken = joins | leaves | lifts | yields
        count = np.count_nonzero(broken)
        if count < self._fewest:
            self._fewest, self._patience = count, PATIENCE
        else:
            self._patience -= 1
            if self._patience == 0:
                self._share, self._patience = 0.5 * self._share, PATIENCE
        if self._share < 1.0 and count:
            off = np.where(joins | leaves, stiff * np.abs(gap), 0.0)
            off[lifts] = -pressure[lifts]
            off[yields] = pressure[yields] - self.hardness
            some = max(1, int(self._share * count))
            broken &= off >= np.sort(off)[-some]
        self.sides = self.sides.copy()
        self.sides[broken & (joins | leaves)] = FREE
        self.sides[broken & lifts] = OPEN
        self.sides[broken & yields] = FULL

    def free_some(self, gap: np.ndarray) -> None:
        """Free hats where none is and a load is prescribed: the approach would be open."""
        if self.load is None or (self.sides == FREE).any():
            return
        full = self.sides == FULL
        self.sides = self.sides.copy()
        if not full.any():
            self.sides[np.argmin(gap)] = FREE
        elif self.hardness * self.weights[full].sum() >= self.load:
            self.sides[full] = FREE
        else:
            self.sides[~full] = FREE


# Largest of: forces out of balance over the contact's forces, what is left of complementarity over
# the pressure, load out of balance over the load. Round-off leaves 1e-11 on large graded blocks.
RESIDUAL = 1e-9
MOST_ITERATIONS = 30
# A step that multiplies the residual by more is halved, and so is one that turns an element over.
GROWTH = 10.0
MOST_HALVINGS = 6


@dataclass(frozen=True)
class ContactState:
    """Where a solution starts or ended: `displacements` (n_b, 2) [m] of the bodies, `pressure`
    (count,) [Pa], `approach` [m], and the `load` [N/m] at which the bodies' histories stand
    in equilibrium: 0 for bodies at rest, whatever is guessed for the rest of the state."""

    displacements: tuple[np.ndarray, ...]
    pressure: np.ndarray
    approach: float
    load: float = 0.0


@dataclass(frozen=True)
class ContactPoint:
    """A state with all that one Newton step from it needs."""

    state: ContactState
    forces: tuple[np.ndarray, ...]
    tangents: tuple[csr_matrix, ...]
    terms: tuple[ContactTerms, ...]


@dataclass(frozen=True)
class ContactProblem:
    bodies: Sequence[tuple[Response, Contact]]
    constant: np.ndarray
    weights: np.ndarray
    hardness: float

    @cached_property
    def free(self) -> list[np.ndarray]:
        """Components of each body that its support leaves free."""
        return [np.flatnonzero(~body.held.ravel()) for body, _ in self.bodies]

    @cached_property
    def symmetric(self) -> bool:
        return all(body.symmetric and contact.frictionless for body, contact in self.bodies)

    @cached_property
    def stiffness(self) -> float:
        """k: bodies in series, each by the mean diagonal of its tangent at rest."""
        diagonals = [
            body.linearised(np.zeros(body.held.shape))[1].diagonal()[free].mean()
            for (body, _), free in zip(self.bodies, self.free, strict=True)
        ]
        return 1.0 / sum(1.0 / diagonal for diagonal in diagonals)

    @cached_property
    def stiff(self) -> float:
        """c [Pa/m]: pressure that goes with a gap under one hat."""
        return self.stiffness / self.weights.mean()

    def at(self, state: ContactState) -> ContactPoint:
        """Raises FemError where a body cannot follow."""
        forces, tangents, terms = [], [], []
        for (body, contact), u in zip(self.bodies, state.displacements, strict=True):
            force, tangent = body.linearised(u)
            if not np.isfinite(force).all():
                raise FemError("the internal forces are not finite")
            forces.append(force.ravel())
            tangents.append(tangent)
            terms.append(contact.at(u, state.pressure))
        return ContactPoint(state, tuple(forces), tuple(tangents), tuple(terms))

    def gap(self, point: ContactPoint) -> np.ndarray:
        """g (count,) [m^2]."""
        return self._gap(point.terms, point.state.approach)

    def opening(self, state: ContactState) -> np.ndarray:
        """Mean opening (count,) [m] under each hat, without asking the bodies for their forces."""
        terms = [
            contact.at(u, state.pressure)
            for (_, contact), u in zip(self.bodies, state.displacements, strict=True)
        ]
        return self._gap(terms, state.approach) / self.weights

    def _gap(self, terms: Sequence[ContactTerms], approach: float) -> np.ndarray:
        return self.constant + sum(each.gap for each in terms) - approach * self.weights

    def residual(self, point: ContactPoint, load: float | None) -> float:
        """The largest of the three parts (see RESIDUAL)."""
        pressure = point.state.pressure
        worst = 0.0
        for force, terms, free in zip(point.forces, point.terms, self.free, strict=True):
            applied = (terms.force @ pressure)[free]
            worst = max(worst, _ratio(force[free] - applied, applied))
        wanted = pressure - self.stiff * self.gap(point) / self.weights
        clipped = np.clip(wanted, 0.0, self.hardness)
        worst = max(worst, _ratio(pressure - clipped, pressure))
        if load is not None:
            worst = max(worst, abs(self.weights @ pressure / load - 1.0))
        return worst


def _ratio(left: np.ndarray, whole: np.ndarray) -> float:
    """Norm of `left` in units of that of `whole`; of one where the latter is zero."""
    size = float(np.linalg.norm(whole))
    return float(np.linalg.norm(left)) / (size if size > 0.0 else 1.0)


def newton(
    problem: ContactProblem, guess: ContactState, load: float | None
) -> tuple[ContactState, list[float]]:
    """State in equilibrium at the load, or at the guess's approach, and the residuals on the way.

    Raises FemError if it does not converge.
    """
    point = problem.at(guess)
    sides = Exchanges(guess.pressure, problem.hardness, load, problem.weights)
    history = [problem.residual(point, load)]
    while history[-1] > RESIDUAL:
        if len(history) > MOST_ITERATIONS:
            raise FemError(f"residual {history[-1]:.1e} after {MOST_ITERATIONS} iterations")
        gap = problem.gap(point) / problem.weights
        if len(history) > 1:
            sides.exchange(point.state.pressure, gap, problem.stiff)
        sides.free_some(gap)
        move = _step(problem, point, sides.sides, load)
        point, residual = _moved(problem, point, move, load, history[-1])
        history.append(residual)
    final = np.clip(point.state.pressure, 0.0, problem.hardness)
    total = load if load is not None else float(problem.weights @ final)
    return replace(point.state, pressure=final, load=total), history


def _moved(
    problem: ContactProblem,
    point: ContactPoint,
    move: ContactState,
    load: float | None,
    before: float,
) -> tuple[ContactPoint, float]:
    """The first of the whole step, its half, its quarter, ... that can be taken."""
    state, why = point.state, "the residual grows"
    for halving in range(MOST_HALVINGS + 1):
        part = 0.5**halving
        there = ContactState(
            tuple(
                u + part * du for u, du in zip(state.displacements, move.displacements, strict=True)
            ),
            state.pressure + part * move.pressure,
            state.approach + part * move.approach,
            state.load,
        )
        try:
            reached = problem.at(there)
        except FemError as error:
            why = str(error)
            continue
        residual = problem.residual(reached, load)
        if residual <= GROWTH * max(before, RESIDUAL):
            return reached, residual
    raise FemError(f"no step leads on: {why}")


def _step(
    problem: ContactProblem, point: ContactPoint, sides: np.ndarray, load: float | None
) -> ContactState:
    """Newton's change of the state with the hats on given sides (count,).

    All unknowns are made lengths, u, p w / k and d, and all equations are divided by k or w.
    """
    weights, stiff, width = problem.weights, problem.stiffness, problem.weights.mean()
    gap = problem.gap(point)
    pressure = point.state.pressure
    hats = np.flatnonzero(sides == FREE)
    fixed = np.where(sides == FULL, problem.hardness, 0.0)
    fixed[hats] = pressure[hats]

    size = len(problem.bodies) + 2
    rows: list[list[csr_matrix | None]] = [[None] * size for _ in range(size)]
    right = []
    for place, (force, tangent, terms, free) in enumerate(
        zip(point.forces, point.tangents, point.terms, problem.free, strict=True)
    ):
        matrix = tangent if terms.stiffness is None else tangent - terms.stiffness
        rows[place][place] = matrix[free][:, free] / stiff
        rows[place][-2] = -terms.force[free][:, hats] / width
        rows[-2][place] = -terms.gradient[free][:, hats].T / width
        right.append((terms.force @ fixed - force)[free] / stiff)
    rows[-2][-2] = csr_matrix((len(hats), len(hats)))
    right.append(gap[hats] / width)
    if load is not None:
        share = csr_matrix(weights[hats, None] / width)
        rows[-2][-1], rows[-1][-2], rows[-1][-1] = share, share.T, csr_matrix((1, 1))
        right.append(np.array([(load - weights @ fixed) / stiff]))
    else:
        rows = [row[:-1] for row in rows[:-1]]
    solution = solve_once(bmat(rows, format="csr"), np.concatenate(right), problem.symmetric)

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


# Smallest increment, as a part of the way from the start to the load.
LEAST_INCREMENT = 1e-3
# After an increment without trouble the next may be longer by this factor.
LONGER = 2.0


@dataclass(frozen=True)
class NonlinearSolution:
    """A converged contact.

    state       displacements, pressure, approach and load
    gap         (count,) [m] mean opening under each hat
    residuals   for each increment that was accepted the dimensionless residuals of its iterations
    parts       (increments,) of the way at which the increments ended; the last is 1
    cuts        increments that failed and were halved
    """

    state: ContactState
    gap: np.ndarray
    residuals: tuple[tuple[float, ...], ...]
    parts: tuple[float, ...]
    cuts: int

    @property
    def iterations(self) -> int:
        """Newton steps of the accepted increments."""
        return sum(len(history) - 1 for history in self.residuals)


def state_at_rest(
    bodies: Sequence[tuple[Response, Contact]], pressure: np.ndarray, approach: float = 0.0
) -> ContactState:
    """Undeformed bodies with a guessed pressure (count,): its support is the first active set."""
    displacements = tuple(np.zeros(body.held.shape) for body, _ in bodies)
    return ContactState(displacements, pressure, approach)


def solve_nonlinear_contact(
    bodies: Sequence[tuple[Response, Contact]],
    gap: np.ndarray,
    weights: np.ndarray,
    start: ContactState,
    load: float | None = None,
    approach: float | None = None,
    hardness: float = np.inf,
    increments: int = 1,
) -> NonlinearSolution:
    """Contact under a `load` P [N/m], or at an `approach` d [m], from a given state.

    bodies      each with its kinematics on the common grid of hats
    gap         G (count,) [m^2], what the bodies' own parts of the gap leave out
    weights     w (count,) [m], integrals of the hats
    start       equilibrium that was reached before, or a guess of the solution for bodies at rest
                (load 0). Only the support of a guessed pressure matters for linear bodies; a
                nonlinear one converges from the linear solution
    hardness    H [Pa], cap on the pressure
    increments  equal parts of the way from the start that are tried first

    The load is what the pressures bear; with friction the tractions' own vertical part, of the
    order of friction times slope, is left out as in the linear theory. On one process. Raises
    ValueError for a load that cannot be borne, FemError where no increment, however small, leads
    on, naming the part of the way that was reached.
    """
    if (load is None) == (approach is None):
        raise ValueError("give either the load or the approach")
    if load is not None and not 0.0 < load < hardness * weights.sum():
        raise ValueError(f"a load of {load:g} N/m is not between zero and what the hats can bear")
    problem = ContactProblem(bodies, gap, weights, hardness)
    first, goal = (start.load, load) if approach is None else (start.approach, approach)
    at_rest = start.load == 0.0
    state, done, parts, histories, cuts = start, 0.0, [], [], 0
    longest = step = 1.0 / increments
    while done < 1.0:
        # the last increment ends on the goal itself, not on a sum of parts
        part = 1.0 if done + step > 1.0 - LEAST_INCREMENT else done + step
        target = goal if part == 1.0 else first + part * (goal - first)
        guess = _scaled(start, part) if at_rest and not parts else state
        try:
            found, history = newton(
                problem,
                replace(guess, approach=target) if load is None else guess,
                target if load is not None else None,
            )
        except FemError as error:
            cuts += 1
            step *= 0.5
            if step < LEAST_INCREMENT:
                raise FemError(
                    f"the contact did not converge beyond {100.0 * done:.3g} % of the load: {error}"
                ) from error
            continue
        for (body, _), displacement in zip(bodies, found.displacements, strict=True):
            body.accept(displacement)
        parts.append(part)
        histories.append(tuple(history))
        state, done = found, part
        step = min(longest, LONGER * step)
    return NonlinearSolution(state, problem.opening(state), tuple(histories), tuple(parts), cuts)


def _scaled(start: ContactState, part: float) -> ContactState:
    """A guessed state at a part of the load, or of the approach, for which it was guessed."""
    moved = tuple(part * displacement for displacement in start.displacements)
    return replace(start, displacements=moved, pressure=part * start.pressure)
