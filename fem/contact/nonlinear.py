"""Contact of bodies with a nonlinear response: Newton's method with an active set.

    F_b(u_b) - T_b(u_b) p             = 0    for each body b
    g = G - w d + sum_b g_b(u_b)     >= 0,   0 <= p <= H,   complementary
    P - w'p                           = 0    or the approach d prescribed

A hat touches (g = 0), is open (p = 0) or is at the hardness (p = H). With these sides fixed each
iteration is a Newton step, after which hats change sides (`fem.contact.sides`); once they stay as
they are it converges quadratically (Hintermueller, Ito and Kunisch 2002, SIAM J. Optim. 13,
865-888).

The load grows in increments. One in which Newton's method fails is halved and tried again.

Nomenclature: u displacement [m], p hat pressures [Pa], d approach [m], F internal nodal forces
[N/m], T nodal forces of unit hats [m], g weighted gap [m^2], G its constant part, w weights [m],
P load [N/m], H hardness [Pa].
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fem.contact.newton import ContactProblem, ContactState, newton
from fem.contact.terms import Contact, Response
from fem.solver.mumps import FemError

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
