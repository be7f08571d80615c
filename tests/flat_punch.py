"""A flat rigid punch that sinks into a metal, whose mean pressure ends at Prandtl's limit."""

from collections.abc import Callable, Sequence

import numpy as np

from analytic.material import Material
from analytic.material.hardening import Hardening
from fem.body.elasticity import ElasticBody, Support, elastic_body
from fem.contact.nonlinear import state_at_rest
from fem.contact.terms import Contact
from fem.nonlinear.newton import newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody
from meshes.block import BlockSpec
from meshes.build import build_block

LIMIT = (2.0 + np.pi) / np.sqrt(3.0)  # over the yield stress


def punch_pressures(
    edges: int,
    approaches: Sequence[float],
    elastic: Material,
    flowing: Callable[[ElasticBody, ElasticPlastic], PlasticBody],
    contact_of: Callable[[ElasticBody, np.ndarray], Contact],
) -> list[float]:
    """Mean pressure under a half-width of 1 by the yield stress at each approach, with `edges` of
    elements to the half-width; of a `flowing` body and its contact on hats."""
    spec = BlockSpec(8.0, 8.0, np.array([[-1.0, 1.0]]), 1.0 / edges, 0.2, (-4, 4, 2.5, 2.4 / edges))
    body = elastic_body(build_block(spec), elastic, Support("bonded", "fixed"))
    hats = np.linspace(-1.0, 1.0, 2 * edges + 1)
    weights = np.full(len(hats) - 2, 1.0 / edges)
    plastic = flowing(body, ElasticPlastic(elastic, Hardening(1.0)))
    bodies = [(plastic, contact_of(body, hats))]
    state, pressures = state_at_rest(bodies, np.ones(len(weights))), []
    for approach in approaches:
        problem = bodies, np.zeros(len(weights)), weights, state
        state, _ = newton_by_contacts(*problem, approach=approach)
        plastic.accept(state.displacements[0])
        pressures.append(state.load / weights.sum())
    return pressures


def past_the_limit(*problem: object) -> float:
    """Pressure at the last approach over that at the one before, on the finer of two meshes, which
    end at LIMIT from above and to first order; `problem` is that of `punch_pressures`."""
    coarse, fine = (punch_pressures(edges, *problem) for edges in (4, 8))
    errors = np.array([coarse[-1], fine[-1]]) / LIMIT - 1.0
    assert 0.0 < errors[1] < 0.035
    assert 0.7 < np.log2(errors[0] / errors[1]) < 1.3
    return fine[-1] / fine[-2]
