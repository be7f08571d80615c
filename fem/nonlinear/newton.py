"""Newton's method by whole linear contacts, for bodies that flow.

The bodies, and the contact on deformed surfaces, are linearised at u_k,

    F(u_k) + K_t (u - u_k) - T p = 0   with   g >= 0, p >= 0, complementary, w'p = P,

and `fem.contact.nonlinear` solves that linear contact to its end, with its active set. (With one
change of the active set for each Newton step, tension on hats that should open makes the body
flow.) Then a line search: without friction the equilibrium minimises an energy, at small strains a
convex one, whose slope on the way to the linear contact,

    s(t) = F(u_k + t du)'du - P dd,   du = u - u_k,   dd the change of the approach,

rises from a negative value. If it is far above zero at the end, the step goes to its zero. With
friction the slope includes the work of the tractions.

Nomenclature as of `fem.contact.nonlinear`, K_t tangent of the body less that of the contact's
forces T p [Pa]."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_matrix

from fem.compliance.condensed import Condensed
from fem.contact.nonlinear import ContactProblem, ContactState, newton
from fem.contact.system import ReusedFactor
from fem.contact.terms import Contact, ContactTerms, LinearContact, LinearResponse, Response
from fem.solver.mumps import FemError

# Forces over the contact's forces, and of a contact on deformed surfaces complementarity over the
# pressure.
RESIDUAL = 1e-9
# Where a residual below the first does not fall by the second any more, rounding leaves it: on
# deformed surfaces 3e-9 of 680 000 unknowns.
ROUNDING, STANDS = 1e-7, 0.5
MOST_LINEAR_CONTACTS = 40
# What is left of a linear system over its right side, and of a linear contact over the residual
# before it. More takes more linear contacts for as much work: Newton's order is not used up.
ACCURACY, ENOUGH = 1e-2, 0.05
# The line search ends where the energy's slope is below this part of the first one.
SLACK = 0.5
MOST_TRIALS = 12
LEAST_PART = 0.01  # of a step, where elements are inverted


class _Linearised(LinearResponse):
    """A body's response linearised at a displacement, without history, less the turning of the
    contact's forces."""

    def __init__(self, body: Response, displacement: np.ndarray, terms: ContactTerms) -> None:
        self.held, self.symmetric, self.softness = body.held, body.symmetric, body.softness
        self.start, self._matrix = body.linearised(displacement)
        if terms.stiffness is not None:
            self._matrix = self._matrix - terms.stiffness
        self._there = displacement

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        move = (displacement - self._there).ravel()
        return self.start + (self._matrix @ move).reshape(-1, 2), self._matrix


@dataclass(frozen=True)
class _LinearisedContact:
    """A contact linearised at a displacement `there`; the turning of its forces is the body's."""

    terms: ContactTerms
    there: np.ndarray
    frictionless: bool

    def at(self, displacement: np.ndarray, pressure: np.ndarray) -> ContactTerms:
        moved = (displacement - self.there).ravel()
        gap = self.terms.gap + self.terms.gradient.T @ moved
        return replace(self.terms, gap=gap, stiffness=None)


def _linearised(
    bodies: Sequence[tuple[Response, Contact]], state: ContactState
) -> list[tuple[_Linearised, Contact]]:
    """The bodies and their contact near a state."""
    near = []
    for (body, contact), u in zip(bodies, state.displacements, strict=True):
        terms = contact.at(u, state.pressure)
        if not isinstance(contact, LinearContact):
            contact = _LinearisedContact(terms, u, contact.frictionless)
        near.append((_Linearised(body, u, terms), contact))
    return near


def newton_by_contacts(
    bodies: Sequence[tuple[Response, Contact]],
    gap: np.ndarray,
    weights: np.ndarray,
    start: ContactState,
    load: float | None = None,
    approach: float | None = None,
    residual: float = RESIDUAL,
    flexible: np.ndarray | Condensed | None = None,
    factor: ReusedFactor | None = None,
) -> tuple[ContactState, list[float]]:
    """Equilibrium under a `load` P [N/m] > 0 or at an `approach` d [m], and the residuals, the last
    one at most the given `residual` or what rounding leaves. `flexible` is the compliance of what
    stays elastic. With a `factor`, of the same bodies in contacts before, systems and linear
    contacts are solved no further than a step may use; without it exactly. The approach works near
    the limit load too. The caller accepts the displacements into the bodies' histories. Held
    components keep their displacements. Other arguments as of `solve_nonlinear_contact`. Raises
    FemError if it does not converge."""
    state, history, enough = start, [], ENOUGH if factor else 0.0
    while len(history) < MOST_LINEAR_CONTACTS:
        near = _linearised(bodies, state)
        problem = ContactProblem(near, gap, weights, np.inf, flexible, factor)
        guess = state if approach is None else replace(state, approach=approach)
        goal, _, left = newton(problem, guess, load, enough)
        moves = [u - v for u, v in zip(goal.displacements, state.displacements, strict=True)]
        rise = goal.pressure - state.pressure
        elastic_work = 0.0 if flexible is None else float(rise @ (flexible @ rise))
        starts = [tangent.start for tangent, _ in near]
        part, forces, applied = _length(bodies, state, moves, goal, starts, elastic_work)
        change = ContactState(tuple(moves), rise, goal.approach - state.approach)
        state = replace(state.moved(part, change), load=goal.load)
        worst = left[-1]
        for (body, _), f, a in zip(bodies, forces, applied, strict=True):
            ok, soft = ~body.held.ravel(), body.softness
            rest, size = (soft * (f - a).ravel())[ok], (soft * a.ravel())[ok]
            worst = max(worst, float(np.linalg.norm(rest) / np.linalg.norm(size)))
        if not all(isinstance(contact, LinearContact) for _, contact in bodies):
            worst = max(worst, _off_contact(problem, bodies, state))
        rounded = bool(history) and STANDS * history[-1] < worst <= ROUNDING
        history.append(worst)
        if part == 1.0 and (worst <= residual or rounded):
            return replace(goal, displacements=state.displacements), history
    raise FemError(f"residual {history[-1]:.1e} after {MOST_LINEAR_CONTACTS} linear contacts")


def _off_contact(
    problem: ContactProblem, bodies: Sequence[tuple[Response, Contact]], state: ContactState
) -> float:
    """Residual of g >= 0, p >= 0, complementary, over the pressure, on deformed surfaces."""
    pressure, weights = state.pressure, problem.weights
    opening = problem.constant - state.approach * weights
    for (_, contact), u in zip(bodies, state.displacements, strict=True):
        opening = opening + contact.loaded(u, pressure)[0]
    if problem.flexible is not None:
        opening = opening + problem.flexible @ pressure
    left = pressure - np.maximum(pressure - problem.stiff * opening / weights, 0.0)
    return float(np.linalg.norm(left) / np.linalg.norm(pressure))


def _length(
    bodies: Sequence[tuple[Response, Contact]],
    state: ContactState,
    moves: Sequence[np.ndarray],
    goal: ContactState,
    starts: Sequence[np.ndarray],
    elastic_work: float,
) -> tuple[float, list[np.ndarray], list[np.ndarray]]:
    """Line search: part of the step to take, and there the bodies' forces, `starts` at its
    beginning, and those of the pressures. `elastic_work` [N] is that of the whole change of the
    pressure on what it moves of the condensed body."""

    def applied_at(part: float) -> list[np.ndarray]:
        pairs = zip(bodies, state.displacements, moves, strict=True)
        return [
            contact.loaded(u + part * du, goal.pressure)[1].reshape(-1, 2)
            for (_, contact), u, du in pairs
        ]

    def forces_at(part: float) -> list[np.ndarray]:
        pairs = zip(bodies, state.displacements, moves, strict=True)
        return [body.force(u + part * du) for (body, _), u, du in pairs]

    def slope(forces: Sequence[np.ndarray], applied: Sequence[np.ndarray], part: float) -> float:
        pairs = zip(forces, applied, moves, strict=True)
        return float(sum(np.sum((f - a) * du) for f, a, du in pairs)) - (1.0 - part) * elastic_work

    first, part = slope(starts, applied_at(0.0), 0.0), 1.0
    while True:
        try:
            forces, applied = forces_at(part), applied_at(part)
            break
        except FemError:  # an element is inverted or a surface folds
            part *= 0.5
            if part < LEAST_PART:
                raise
    here = slope(forces, applied, part)
    low, high, at_low, at_high = 0.0, part, first, here
    for _ in range(MOST_TRIALS):
        if here <= SLACK * abs(first) and (part == high or here >= -SLACK * abs(first)):
            break
        zero = low - at_low * (high - low) / (at_high - at_low)
        part = np.clip(zero, 0.1 * high + 0.9 * low, 0.9 * high + 0.1 * low)
        forces, applied = forces_at(part), applied_at(part)
        here = slope(forces, applied, part)
        if here < 0.0:
            low, at_low = part, here
        else:
            high, at_high = part, here
    return float(part), forces, applied
