"""A body pressed from a guessed pressure alone, at finite strains or by the linear theory; and what
neo-Hookean energy it stores."""

import numpy as np

from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.material import Material
from analytic.material.hardening import Hardening
from fem.body.elasticity import ElasticBody, Support, elastic_body
from fem.body.triangle import collapsed_gauss, gradients, jacobians
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import ContactState, solve_nonlinear_contact
from fem.contact.rigid_roller import Roller, circle
from fem.contact.terms import LinearContact, LinearResponse
from fem.nonlinear.finite_deformation import FiniteContact, FiniteDeformation
from fem.nonlinear.plasticity import ElasticPlastic
from fem.nonlinear.press_plastic import LoadHistory

STEEL = Material(200.0, 0.3)  # over the yield stress


class MetalScene:
    """A roller that an elastic body would meet on half-width 1 under the peak pressure `ratio` Y.

    It is rigid, or `elastic` and of the body's material. A coating of the body does not flow.
    """

    def __init__(
        self, mesh, ratio, edges, reach=1.6, hardening=0.0, unit=1.0, elastic=False, **how
    ):
        material = Material(STEEL.youngs_modulus * unit, STEEL.poissons_ratio)
        modulus = material.plane_strain_modulus / (1 + elastic)
        self.elastic = elastic
        self.metal = ElasticPlastic(material, Hardening(unit, hardening * unit))
        self.hertz = hertz_from_peak_pressure(ratio * unit, 0.5 * modulus / (ratio * unit), modulus)
        body = elastic_body(mesh, material, **{"support": Support("bonded", "fixed")} | how)
        pitch = 1.0 / edges
        hats = pitch * np.arange(-round(reach * edges) - 1, round(reach * edges) + 2)
        self.x, self.pressed = hats[1:-1], FiniteElementCompliance(body, hats)
        self.weights = np.full(len(self.x), pitch)
        self.gap = pitch * (self.x**2 + pitch**2 / 6.0) / (2.0 * self.hertz.radius)

    def press(self, loads, friction=0.0, travel=1.0):
        """The body at the end, and the contacts."""
        way, history = self.led(LoadHistory, loads, friction, travel)
        return way.body, history

    def led(self, kind, loads, friction, travel=np.inf):
        """The history of loads, of a kind, and its contacts."""
        guess, roller = self.hertz.pressure(self.x), self.pressed if self.elastic else None
        problem = self.pressed, self.metal, self.gap, self.weights, guess
        way = kind(*problem, friction, roller, travel)
        return way, way.through([part * self.hertz.load_per_length for part in loads])


def neo_hookean_energy(body: ElasticBody, displacement: np.ndarray, points: int = 4) -> float:
    """Strain energy [J/m] of a body without a coating under a displacement (n, 2) [m], by a
    quadrature of its own: W = mu/2 (tr F'F - 2 - 2 ln J) + lambda/2 (ln J)^2."""
    at, share = collapsed_gauss(points)
    corner, mu = body.points[body.mesh.triangles], body.material.shear_modulus
    f = np.eye(2) + gradients(corner, displacement[body.elements], at)
    log = np.log(np.linalg.det(f))
    density = 0.5 * mu * ((f**2).sum(axis=(2, 3)) - 2.0 - 2.0 * log)
    density += 0.5 * body.lame[0] * log**2
    return float((density * np.linalg.det(jacobians(corner, at)) * share).sum())


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
    hardness   H [Pa], largest `pressure`

    Others as of `FiniteContact`; Newton's method starts from the linear solution under `start`.
    Raises FemError if it does not converge, ValueError for a load that the hats cannot bear.
    """
    contact = FiniteContact(FiniteElementCompliance(body, hats), roller, start, friction)
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


def under_a_circle(
    body: ElasticBody, hats: np.ndarray, curvature: float, load: float, /, **wanted: float | None
) -> tuple[ContactState, FiniteDeformation]:
    """A body under a rigid roller on half-width 1 by Hertz: a parabola by the linear theory, and
    the circle by `press_finitely`; `wanted` in place of the load."""
    x, pitch = hats[1:-1], hats[1] - hats[0]
    gap = 0.5 * pitch * curvature * (x**2 + pitch**2 / 6.0)
    hertz = 2.0 / np.pi * load * np.sqrt(np.maximum(1.0 - x**2, 0.0))
    linear = press_linearly(body, hats, gap, hertz, load)
    wanted = {"load": load} | wanted
    return linear, press_finitely(body, hats, circle(1.0 / curvature), linear.pressure, **wanted)


def dense_contact(matrix: np.ndarray, gap: np.ndarray, weights: np.ndarray, load: float):
    """Pressure and approach of matrix p + gap - d weights >= 0, p >= 0, complementary, w'p = load.

    Plain active set on a dense matrix, written apart from every solver of the project.
    """
    inside = gap < 0.5 * gap.max()
    for _ in range(100):
        w = weights[inside]
        system = np.block([[matrix[np.ix_(inside, inside)], -w[:, None]], [w, np.zeros((1, 1))]])
        *pressure, approach = np.linalg.solve(system, np.append(-gap[inside], load))
        whole = np.zeros(len(gap))
        whole[inside] = pressure
        opening = matrix @ whole + gap - approach * weights
        wanted = np.where(inside, whole > 0.0, opening < 0.0)
        if np.array_equal(wanted, inside):
            return whole, approach
        inside = wanted
    raise AssertionError("the active set did not settle")
