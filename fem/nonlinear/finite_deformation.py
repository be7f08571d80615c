"""A body pressed by a rigid roller without linearisation: finite strains, current normals.

Response and kinematics can be exchanged, to separate the effects that the linear theory neglects: a
linear body (`fem.contact.terms.LinearResponse`) or one at finite strains
(`fem.nonlinear.hyperelastic.NeoHookeanBody`), contact on the undeformed surface
(`fem.contact.terms.LinearContact`) or on the deformed one
(`fem.contact.rigid_roller.CurrentContact`). Elastic rollers are not modelled.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fem.body.elasticity import ElasticBody
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import ContactState, NonlinearSolution, solve_nonlinear_contact
from fem.contact.rigid_roller import CurrentContact, Roller
from fem.contact.terms import Contact, Response
from fem.nonlinear.hyperelastic import (
    NeoHookeanBody,
    along_surface,
    nodal_cauchy_stress,
    nodal_stress_across,
)
from fem.stress.stress import NodalStress
from fem.stress.surface_load import SurfaceLoad


@dataclass
class FiniteDeformation:
    """A body in contact with a rigid roller, in its deformed state.

    pressure       (count,) [Pa] vertical force per undeformed length of x, as in the linear theory
    displacement   (n, 2) [m] at the body's nodes
    approach       depth [m] of the roller's lowest point below z = 0 of the undeformed body
    gap            (count,) [m] mean opening under each hat, along z
    """

    body: ElasticBody
    hats: np.ndarray
    roller: Roller
    friction: float
    solution: NonlinearSolution

    def __post_init__(self) -> None:
        state = self.solution.state
        self.pressure, self.approach, self.gap = state.pressure, state.approach, self.solution.gap
        (self.displacement,) = state.displacements

    @cached_property
    def place(self) -> np.ndarray:
        """Deformed x (count,) [m] of the hats' nodes."""
        at = self.hats[1:-1]
        return at + np.interp(at, self.body.top.x, self._moved[:, 0])

    @cached_property
    def cauchy_pressure(self) -> np.ndarray:
        """(count,) [Pa] force per deformed area, at `place`."""
        return self._on_deformed(self.hats[1:-1], self.pressure)

    @cached_property
    def stress(self) -> NodalStress:
        """Cauchy's stresses at the deformed mesh points. The stress across the plane is
        `stress_across`, nu (sx + sz) for small strains only."""

        def direction(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            return self.roller(x)[1], np.ones_like(x)

        load = SurfaceLoad(self.body, self.hats, self.pressure, self.friction, direction)
        nodal = np.concatenate([[0.0], self.pressure, [0.0]])
        x = self.body.top.x
        pressure = self._on_deformed(x, np.interp(x, self.hats, nodal))
        return nodal_cauchy_stress(self.body, self.displacement, load, pressure)

    @cached_property
    def stress_across(self) -> np.ndarray:
        """Cauchy's stress across the plane (k,) [Pa] at the mesh points."""
        return nodal_stress_across(self.body, self.displacement)

    @cached_property
    def _moved(self) -> np.ndarray:
        return self.body.at_points(self.displacement)[self.body.top.point]

    def _on_deformed(self, x: np.ndarray, pressure: np.ndarray) -> np.ndarray:
        """Pressure per deformed length of x at undeformed places x."""
        top = self.body.top.x
        return pressure / np.interp(x, top, 1.0 + along_surface(top, self._moved)[:, 0])


def press_finitely(
    body: ElasticBody,
    hats: np.ndarray,
    roller: Roller,
    start: np.ndarray,
    load: float | None = None,
    approach: float | None = None,
    friction: float = 0.0,
    hardness: float = np.inf,
) -> FiniteDeformation:
    """Press a body of neo-Hookean material by a rigid roller whose lowest point is at x = 0.

    hats       (count + 2,) [m] nodes of the pressure on the undeformed surface, with outer feet
    roller     its shape, `fem.contact.rigid_roller.circle(radius)`
    start      (count,) [Pa] linear pressure under the same load, from which Newton's method starts
    load       P [N/m], the vertical force; or `approach` d [m] of the roller's lowest point from
               z = 0, positive into the body
    friction   q = friction p along the roller's tangent, towards +x
    hardness   H [Pa], cap on `pressure`

    Raises FemError if it does not converge, and on more than one process; ValueError for a load
    that the hats cannot bear.
    """
    bodies = [(NeoHookeanBody(body), CurrentContact(body, hats, roller, friction))]
    solution = press(bodies, body, hats, start, load, approach, friction, hardness)
    return FiniteDeformation(body, hats, roller, friction, solution)


def press(
    bodies: list[tuple[Response, Contact]],
    body: ElasticBody,
    hats: np.ndarray,
    start: np.ndarray,
    load: float | None = None,
    approach: float | None = None,
    friction: float = 0.0,
    hardness: float = np.inf,
    gap: np.ndarray | None = None,
) -> NonlinearSolution:
    """The contact of `body` with a chosen response and kinematics, started as `press_finitely`.
    `gap` (count,) [m^2] is the initial gap, for contact on the undeformed surface only."""
    weights = 0.5 * (hats[2:] - hats[:-2])
    moved = FiniteElementCompliance(body, hats).displacement(start, friction)
    state = ContactState((np.where(body.held, 0.0, moved),), start, approach=0.0)
    gap = np.zeros_like(weights) if gap is None else gap
    return solve_nonlinear_contact(bodies, gap, weights, state, load, approach, hardness)
