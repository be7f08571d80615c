"""Newton's method for a contact with nonlinear bodies at one load (`fem.contact.nonlinear`).

Nomenclature: u displacement [m], p hat pressures [Pa], d approach [m], F internal nodal forces
[N/m], T nodal forces of unit hats [m], g weighted gap [m^2], w weights [m], P load [N/m],
H hardness [Pa], k a mean stiffness [Pa] that makes all unknowns lengths.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import bmat, csr_matrix

from fem.contact.sides import FREE, FULL, Exchanges
from fem.contact.terms import Contact, ContactTerms, Response
from fem.solver.direct_solve import solve_once
from fem.solver.mumps import FemError

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
