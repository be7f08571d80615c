"""A block that reproduces the half-plane: its outer boundary gets the half-plane's displacement.

Far from tractions on a short range of a half-plane's surface the displacement is a series in their
moments. Prescribed on the sides and the bottom of a block, it leaves the discretisation as the only
error. With K0 the stiffness of the block held all round

    u = K0^-1 (b - K_g g) + g,   g = sum over the moments m_k of b of their displacements.

The series, by Muskhelishvili's complex potentials (Some Basic Problems of the Mathematical Theory
of Elasticity, 1953, eq. 32.1; under given tractions they are Cauchy integrals, section 93) with
1/(t - s) expanded in t/s, for a body in Im s > 0:

    2 G (u_x + i u_z) = 1/(2 pi i) [ m_0 (kappa ln s + ln s') - sum_k m_k/k (kappa s^-k + s'^-k)
                                     + (s - s') sum_k conj(m_k) s'^-(k+1) ].

At the surface, under a pressure's resultant P alone, that is u_z = -2 P / (pi E') ln(|x| / L).

    s = (x - centre + i z) / reach, s' its conjugate    G, kappa = 3 - 4 nu, E'   of the body
    m_k   integral of ((t - centre) / reach)^k (p - i q) dt [N/m], p pressure, q traction in +x
    b     nodal forces of the tractions [N/m]           g   displacement of the held nodes [m]
    L     datum [m]: the half-plane leaves u_z undefined up to a constant"""

from functools import cached_property

import numpy as np
from scipy.sparse import csr_matrix

from fem.body.elasticity import ElasticBody
from fem.body.sums import matrix_of
from fem.body.triangle import collapsed_gauss, jacobians, slopes

# First neglected power of reach over distance of the boundary. The compliance's error is 3e-8 for
# blocks of 4 to 40 half-widths, with 4 to 9 moments each of pressure and traction.
TRUNCATION = 1e-5
# Largest reach of the tractions over the distance of the boundary, with 17 moments of each.
MOST_REACH = 0.5


class FarField:
    """The half-plane around a block, for tractions between `start` and `stop` [m].

    body      of one material, held all round by Support("bonded", "fixed")
    centre    of the moments [m]              reach   half of the range of the tractions [m]
    terms     moments of each traction, by TRUNCATION
    datum     L [m]: stop - start, as of `analytic.operators.half_plane.HalfPlane` on the same hats
    moments   (2 terms, 2k) of unit forces at the surface's nodes; of x forces first
    lifted    (2k, 2 terms) [m^2/N] surface displacement due to unit moments at the boundary: one
              back-substitution each

    The displacement `lifted @ moments` that the boundary adds is symmetric up to the discretisation
    error; a contact solver that minimises an energy needs `symmetric`. Raises ValueError if the
    body is held otherwise or coated, or if its boundary is nearer than reach / MOST_REACH."""

    def __init__(self, body: ElasticBody, start: float, stop: float) -> None:
        if (body.support.base, body.support.sides) != ("bonded", "fixed"):
            raise ValueError("a far field takes a body whose base is bonded and sides are fixed")
        if body.coating is not None:
            raise ValueError("a far field takes a body of one material, not a coated one")
        outer = body.held.all(axis=1)
        self.body, self._outer = body, np.flatnonzero(outer)
        self.centre, self.reach = 0.5 * (start + stop), 0.5 * (stop - start)
        self.datum = stop - start
        offset = body.nodes[outer] - (self.centre, 0.0)
        ratio = self.reach / np.hypot(*offset.T).min()
        if not ratio <= MOST_REACH:
            raise ValueError(
                f"tractions reach over {ratio:.3g} of the distance of the boundary: "
                f"a far field takes at most {MOST_REACH:g}"
            )
        self.terms = int(np.ceil(np.log(TRUNCATION) / np.log(ratio)))
        place = (offset[:, 0] + 1j * offset[:, 1]) / self.reach
        unit = multipoles(place, self.terms, self.datum / self.reach, body.material.poissons_ratio)
        self._boundary = unit / (2.0 * body.material.shear_modulus)
        self._pull = coupling(body, outer)

        power = ((body.surface.x - self.centre) / self.reach) ** np.arange(self.terms)[:, None]
        self.moments = np.zeros((2 * self.terms, 2 * len(body.surface.x)))
        self.moments[: self.terms, 0::2] = self.moments[self.terms :, 1::2] = power

    @cached_property
    def lifted(self) -> np.ndarray:
        """Of moments of the traction first, then of the pressure."""
        return np.hstack([self._lifted(self._boundary[: self.terms]), self._lifted_by_pressure])

    def displacement(self, load: np.ndarray) -> np.ndarray:
        """Displacement (n, 2) [m] of the body's nodes under forces (n, 2) [N/m] on its surface."""
        moments = self.moments @ load[self.body.surface.point].ravel()
        boundary = np.tensordot(moments, self._boundary, axes=1)
        moved = self.body.solve(load + self._forces(boundary))
        moved[self._outer] = boundary
        return moved

    def symmetric(self, force: np.ndarray) -> np.ndarray:
        """Surface displacement (2k, …) [m] that the boundary adds under forces (2k, …) [N/m]. Valid
        in the range of the tractions only, and along x only under forces along x, whose moments
        take half of the back-substitutions."""
        if np.any(force[0::2]):
            moments, lifted = self.moments, self.lifted
        else:
            moments, lifted = self.moments[self.terms :], self._lifted_by_pressure
        return 0.5 * (lifted @ (moments @ force) + moments.T @ (lifted.T @ force))

    @cached_property
    def _lifted_by_pressure(self) -> np.ndarray:
        return self._lifted(self._boundary[self.terms :])

    def _lifted(self, boundary: np.ndarray) -> np.ndarray:
        """Surface displacement (2k, m) due to displacements (m, h, 2) of the boundary."""
        moved = self.body.solve(self._forces(boundary))
        moved[:, self._outer] = boundary
        return moved[:, self.body.surface.point].reshape(len(boundary), -1).T

    def _forces(self, boundary: np.ndarray) -> np.ndarray:
        """Nodal forces (…, n, 2) equivalent to displacements (…, h, 2) of the held nodes."""
        flat = boundary.reshape(*boundary.shape[:-2], -1)
        return -(self._pull @ flat.T).T.reshape(*boundary.shape[:-2], -1, 2)


def multipoles(s: np.ndarray, terms: int, datum: float, poissons_ratio: float) -> np.ndarray:
    """2 G u (2 terms, n, 2) at places s (n,) under unit moments: of q in turn, then of p. `datum`
    in units of the reach, as s. On this branch of the logarithm a pressure moves what is below it
    straight down."""
    kappa = 3.0 - 4.0 * poissons_ratio
    mirrored, log = s.conj(), np.log(s / (1j * datum))
    k = np.arange(1, terms)[:, None]
    even = np.vstack([kappa * log + log.conj(), -(kappa * s**-k + mirrored**-k) / k])
    odd = (s - mirrored) * mirrored ** -np.arange(1.0, terms + 1.0)[:, None]
    moved = np.vstack([m * even + np.conj(m) * odd for m in (-1j, 1.0)]) / (2j * np.pi)
    return np.stack([moved.real, moved.imag], axis=-1)


def coupling(body: ElasticBody, held: np.ndarray) -> csr_matrix:
    """Stiffness (2n, 2h) [Pa] between all nodes and the h of them that are `held` (n,). Summed over
    elements with both held and free nodes: rows of held nodes are incomplete."""
    touching = held[body.elements]
    fringe = touching.any(axis=1) & ~touching.all(axis=1)
    element = body.elements[fringe]
    at, weight = collapsed_gauss(body.degree)
    jacobian = jacobians(body.points[body.mesh.triangles[fringe]], at)
    slope = slopes(at, body.degree) @ np.linalg.inv(jacobian)
    area = np.abs(np.linalg.det(jacobian)) * weight
    # [m, a, i, b, j]: integral of (dN_a / dx_i) (dN_b / dx_j)
    product = np.einsum("mq,mqai,mqbj->maibj", area, slope, slope, optimize=True)
    same_component = np.einsum("maibi->mab", product)[:, :, None, :, None] * np.eye(2)[:, None, :]
    shear, lame = body.material.shear_modulus, body.lame[0]
    stiffness = lame * product + shear * (product.swapaxes(2, 4) + same_component)

    component, count = 2 * element[..., None] + np.arange(2), 2 * len(held)
    place = component[..., None, None], component[:, None, None]
    return matrix_of(stiffness, *place, (count, count))[:, np.repeat(held, 2)]
