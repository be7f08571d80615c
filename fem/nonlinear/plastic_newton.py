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
"""

from collections.abc import Sequence

import numpy as np
from scipy.sparse import csr_matrix

from fem.contact.newton import ContactState
from fem.contact.nonlinear import solve_nonlinear_contact
from fem.contact.terms import Contact, Response
from fem.solver.mumps import FemError

# Forces out of balance over the contact's forces.
RESIDUAL = 1e-9
MOST_ITERATIONS = 40
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
    while len(history) < MOST_ITERATIONS:
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
    raise FemError(f"residual {history[-1]:.1e} after {MOST_ITERATIONS} linear contacts")


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
