"""A body pressed from a guessed pressure alone, at finite strains or by the linear theory."""

import numpy as np

from fem.body.elasticity import ElasticBody
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import ContactState, solve_nonlinear_contact
from fem.contact.rigid_roller import Roller
from fem.contact.terms import LinearContact, LinearResponse
from fem.nonlinear.finite_deformation import FiniteContact, FiniteDeformation


def press_finitely(
    body: ElasticBody,
    hats: np.ndarray,
    roller: Roller | FiniteElementCompliance,
    start: np.ndarray,
    load: float | None = None,
    approach: float | None = None,
    friction: float = 0.0,
    hardness: float = np.inf,
) -> FiniteDeformation:
    """Press a body by a roller whose lowest point is at x = 0, by Newton's method.

    load       P [N/m], the vertical force; or `approach` d [m] of the roller's lowest point from
               z = 0, positive into the body
    hardness   H [Pa], cap on `pressure`

    Others as of `FiniteContact`; Newton's method starts from the linear solution under `start`.
    Raises FemError if it does not converge, ValueError for a load that the hats cannot bear.
    """
    contact = FiniteContact(body, hats, roller, start, friction)
    return contact.by_newton(load, approach, hardness)


def press_linearly(
    body: ElasticBody,
    hats: np.ndarray,
    gap: np.ndarray,
    start: np.ndarray,
    load: float,
    friction: float = 0.0,
) -> ContactState:
    """The linear body's contact on its undeformed surface, started as `press_finitely`.

    gap   (count,) [m^2] initial gap, weighted by each hat"""
    compliance = FiniteElementCompliance(body, hats)
    bodies = [(LinearResponse(body), LinearContact(compliance, friction))]
    moved = np.where(body.held, 0.0, compliance.displacement(start, friction))
    state = ContactState((moved,), start, approach=0.0)
    weights = 0.5 * (hats[2:] - hats[:-2])
    return solve_nonlinear_contact(bodies, gap, weights, state, load).state
