"""A body pressed by a roller without linearisation: finite strains, current places and normals.

Response and kinematics can be exchanged, to separate the effects that the linear theory neglects: a
linear body (`fem.contact.terms.LinearResponse`) or one at finite strains
(`fem.nonlinear.hyperelastic.HyperelasticBody`), contact on the undeformed surface
(`fem.contact.terms.LinearContact`) or on the deformed one, of a rigid roller
(`fem.contact.rigid_roller.CurrentContact`) or an elastic one, itself at finite strains
(`fem.contact.deformed_roller.PairContact`).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fem.body.elasticity import ElasticBody
from fem.compliance.far_field import FarField
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.deformed_roller import DeformedSurface, PairContact, TwoBodies
from fem.contact.nonlinear import ContactState, NonlinearSolution, solve_nonlinear_contact
from fem.contact.rigid_roller import CurrentContact, Roller
from fem.contact.terms import Contact, Response
from fem.nonlinear.hyperelastic import (
    HyperelasticBody,
    along_surface,
    nodal_cauchy_stress,
    nodal_stress_across,
)
from fem.stress.stress import NodalStress
from fem.stress.surface_load import SurfaceLoad


@dataclass
class FiniteDeformation:
    """A body in contact with a roller, in its deformed state.

    roller         as pressed by; of an elastic one its deformed surface
    pressure       (count,) [Pa] vertical force per undeformed length of x, as in the linear theory
    displacement   (n, 2) [m] at the body's nodes
    roller_displacement  (m, 2) [m] at those of an elastic roller, in its own frame; else empty
    approach       depth [m] of the roller's lowest point, before it deforms, below z = 0 of the
                   undeformed body
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
        both = np.split(state.displacements[0], [len(self.body.nodes)])
        self.displacement, self.roller_displacement = both

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
            now = x + np.interp(x, self.body.top.x, self._moved[:, 0])
            return self.roller(now)[1], np.ones_like(x)

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
    roller: Roller | FiniteElementCompliance,
    start: np.ndarray,
    load: float | None = None,
    approach: float | None = None,
    friction: float = 0.0,
    hardness: float = np.inf,
    far: FarField | None = None,
) -> FiniteDeformation:
    """Press a body by a roller whose lowest point is at x = 0, each by its own law of elasticity.

    hats       (count + 2,) [m] nodes of the pressure on the undeformed surface, with outer feet
    roller     a rigid one's shape, `fem.contact.rigid_roller.circle(radius)`; or an elastic one on
               the same hats, its body in its own frame, z into it, with its shape as the boundary
    start      (count,) [Pa] linear pressure under the same load, from which Newton's method starts
    load       P [N/m], the vertical force; or `approach` d [m] of the roller's lowest point from
               z = 0, positive into the body
    friction   q = friction p along the common tangent, towards +x on the body
    hardness   H [Pa], cap on `pressure`
    far        gives the body's outer boundary the half-plane's displacement under `start`; None:
               the support holds it. An elastic roller has its own

    Raises FemError if it does not converge, and on more than one process; ValueError for a load
    that the hats cannot bear.
    """
    own = FiniteElementCompliance(body, hats, far=far)
    if isinstance(roller, FiniteElementCompliance):
        other = roller.body
        moduli = body.material.youngs_modulus, other.material.youngs_modulus
        bodies = TwoBodies(HyperelasticBody(body), HyperelasticBody(other), moduli)
        contact = PairContact(body, hats, other, friction)
        moved = np.vstack([_started(own, start, friction), _started(roller, start, -friction)])
    else:
        bodies, contact = HyperelasticBody(body), CurrentContact(body, hats, roller, friction)
        moved = _started(own, start, friction)
    wanted = load, approach, hardness
    solution = _solved([(bodies, contact)], moved, hats, start, *wanted)
    if isinstance(roller, FiniteElementCompliance):
        reached = solution.state.displacements[0][len(body.nodes) :]
        roller = DeformedSurface(other, reached)
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
    moved = _started(FiniteElementCompliance(body, hats), start, friction)
    return _solved(bodies, moved, hats, start, load, approach, hardness, gap)


def _started(
    compliance: FiniteElementCompliance, pressure: np.ndarray, friction: float
) -> np.ndarray:
    """The linear displacement (n, 2) [m], at held nodes that of a far field or none."""
    moved = compliance.displacement(pressure, friction)
    return moved if compliance.far else np.where(compliance.body.held, 0.0, moved)


def _solved(
    bodies: list[tuple[Response, Contact]],
    moved: np.ndarray,
    hats: np.ndarray,
    start: np.ndarray,
    load: float | None,
    approach: float | None,
    hardness: float,
    gap: np.ndarray | None = None,
) -> NonlinearSolution:
    weights = 0.5 * (hats[2:] - hats[:-2])
    gap = np.zeros_like(weights) if gap is None else gap
    state = ContactState((moved,), start, approach=0.0)
    return solve_nonlinear_contact(bodies, gap, weights, state, load, approach, hardness)
