"""A roller pressed on an elastic-plastic body, let go, and pressed again.

Each load is reached in increments on the body's own history. The body meets the hats where it was
undeformed, as in the linear theory; the roller is rigid or stays elastic. Under a load of zero the
roller is gone and the body left with its residual stresses.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import state_at_rest
from fem.contact.terms import Contact, LinearContact, LinearResponse, Response
from fem.nonlinear.plastic_newton import newton_by_contacts
from fem.nonlinear.plasticity import PlasticBody
from fem.nonlinear.return_mapping import ElasticPlastic, PlasticState
from fem.solver.direct_solve import solve_once
from fem.solver.mumps import FemError

# Equal parts of the way from one load to the next. A smooth roller pressed to five times the load
# of first flow: peak pressure 1.6 % high with 8, 0.8 % with 16, 0.4 % with 32; approach 0.1 % with
# 16.
INCREMENTS = 16

# Part of the largest load at which the roller is let go: contact is followed down to there, and
# taken up again from there. Below it rounding of the residual stresses would show.
LAST_TOUCH = 0.01

# Forces out of balance in the released body, of the largest force that its stresses exert anywhere.
BALANCE = 1e-10
MOST_ITERATIONS = 30


@dataclass(frozen=True)
class PlasticContact:
    """One load of the history, in equilibrium to `fem.nonlinear.plastic_newton.RESIDUAL`.

    load           P [N/m]; 0: the roller is gone
    pressure       (count,) [Pa]
    approach       d [m]; where the roller is gone that of the last touch
    displacement   (n, 2) [m] of the body's nodes
    state          of the metal at the body's 3m points
    iterations     linear contacts that were solved on the way from the load before
    """

    load: float
    pressure: np.ndarray
    approach: float
    displacement: np.ndarray
    state: PlasticState
    iterations: int


def press_plastically(
    pressed: FiniteElementCompliance,
    metal: ElasticPlastic,
    gap: np.ndarray,
    weights: np.ndarray,
    loads: Sequence[float],
    guess: np.ndarray,
    friction: float = 0.0,
    roller: FiniteElementCompliance | None = None,
    increments: int = INCREMENTS,
) -> tuple[PlasticBody, tuple[PlasticContact, ...]]:
    """The body at the end, and the contact under each of the loads, one after another.

    pressed     the body on the hats, its material the metal's elastic one
    gap         G (count,) [m^2], integral of hat times initial gap
    weights     w (count,) [m], integrals of the hats
    loads       P [N/m] in turn, the first positive; 0 lets the roller go
    guess       pressure (count,) [Pa] whose support is near that under the first load: the elastic
                body's own
    friction    of the traction friction * pressure, towards +x on the body
    roller      the elastic roller's body on the same hats; None: rigid. May be `pressed` itself

    Raises ValueError for loads that cannot be borne, FemError where a load cannot be reached.
    """
    if not loads or not loads[0] > 0.0 or min(loads) < 0.0:
        raise ValueError("the first load must be positive, and none negative")
    body = PlasticBody(pressed.body, metal)
    bodies: list[tuple[Response, Contact]] = [(body, _contact(pressed, friction))]
    if roller is not None:
        # its own z points away from the body, and on it the traction acts towards -x
        bodies.append((LinearResponse(roller.body), _contact(roller, -friction)))

    state, history = state_at_rest(bodies, guess), []
    for load in loads:
        target = load or min(LAST_TOUCH * max(loads), state.load)
        iterations = 0
        for stage in np.linspace(state.load, target, increments + 1)[1:]:
            try:
                state, residuals = newton_by_contacts(bodies, gap, weights, state, float(stage))
            except FemError as error:
                raise FemError(f"the load of {stage:g} N/m was not reached: {error}") from error
            body.accept(state.displacements[0])
            iterations += len(residuals)
        pressure = state.pressure
        if load == 0.0:
            pressure = np.zeros_like(pressure)
            free = _let_go(body, state.displacements[0])
            state = replace(state, displacements=(free, *state.displacements[1:]))
        displacement = state.displacements[0]
        history.append(
            PlasticContact(load, pressure, state.approach, displacement, body.state, iterations)
        )
    return body, tuple(history)


def _contact(compliance: FiniteElementCompliance, friction: float) -> LinearContact:
    body = compliance.body
    tangential = compliance.tangential if friction else None
    return LinearContact(len(body.nodes), body.surface, compliance.normal, friction, tangential)


def _let_go(body: PlasticBody, displacement: np.ndarray) -> np.ndarray:
    """Displacement with no force on the body, which takes it into its history."""
    free = np.flatnonzero(~body.held.ravel())
    scale = np.abs(body.force_of(body.stress(displacement, body.state)[0])).max()
    for _ in range(MOST_ITERATIONS):
        force, tangent = body.linearised(displacement)
        rest = force.ravel()[free]
        if np.abs(rest).max() <= BALANCE * scale:
            body.accept(displacement)
            return displacement
        move = np.zeros(displacement.size)
        move[free] = solve_once(tangent[free][:, free].tocsr(), -rest, symmetric=True)
        displacement = displacement + move.reshape(-1, 2)
    raise FemError("the body without its roller did not come to rest")
