"""The stress around kinks in a traction, which no polynomial follows.

Pressures that are joined linearly have a kink at every node. In the elements around it the stress
goes like w ln w, whose second derivative has no bound, in every body with a smooth boundary and
whatever its shape farther away. The fields here have such a kink and no other load nearby:
what is left of a displacement without them is smooth, and has smooth stresses to recover
(`fem.recovery`); with them again an element's stresses follow the kinks inside it
(`fem.stress`). Only the elements around a kink see it: weights fade out with the distance.

Nomenclature
    w            place relative to the kink, along the surface + i times into the body [m]
    f            jump of the slope of s_nn - i s_nt [Pa/m] along the surface
    L, I         w ln w and its integral w^2 (ln w - 1/2) / 2; both vanish at the kink
    s_tt, s_nn, s_nt   stresses along the surface, across it, shear
    G, nu        shear modulus [Pa], Poisson's ratio

Traction on the boundary s_nn - i s_nt = f max(0, -w); with potentials Phi = i f L / (2 pi) and
Psi = -Phi - w Phi' + i conj(f) L / (2 pi) in Muskhelishvili's equations (Some Basic Problems of
the Mathematical Theory of Elasticity, 1953, section 32)

    s_tt + s_nn = -2/pi Im(f L)
    s_nn - s_tt + 2 i s_nt = 2/pi (Im(w) f (ln w + 1) + Im(f) L)
    2 G u = (i f ((3 - 4 nu) I + conj(I)) - 2 Im(w) conj(f L)) / (2 pi)
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from analytic.material import Material

# Reach of the weights in root mean square radii of a patch or an element. At 5 the errors in the
# first layers of elements are within a fifth of those with every kink subtracted everywhere.
REACH = 5.0


@dataclass(frozen=True)
class Kinks:
    """Places in ascending x (k,) as x + i z [m], unit tangents towards +x, jumps f (k,) [Pa/m]."""

    place: np.ndarray
    tangent: np.ndarray
    jump: np.ndarray

    def weights(self, centre: np.ndarray, radius: np.ndarray, seen: np.ndarray) -> csr_matrix:
        """Weights (n, kinks) for patches around `centre` (n, 2) [m] of a `radius` (n,) [m].

        `seen` (n,) tells which patches the kinks reach: those of the material at the surface.
        """
        centre, reach = centre[:, 0] + 1j * centre[:, 1], REACH * radius * seen
        below = np.maximum(0.0, centre.imag - self.place.imag.max(initial=-np.inf))
        across = np.sqrt(np.maximum(0.0, reach**2 - below**2))
        first = np.searchsorted(self.place.real, centre.real - across)
        count = np.searchsorted(self.place.real, centre.real + across) - first
        start = np.concatenate([[0], np.cumsum(count)])
        row = np.repeat(np.arange(len(centre)), count)
        kink = np.arange(start[-1]) - start[row] + first[row]
        distance = np.abs(centre[row] - self.place[kink]) / reach[row]
        weight = np.maximum(0.0, 1.0 - distance**4) ** 2
        return csr_matrix((weight, kink, start), (len(centre), len(self.place)))

    def _stress(self, kink: np.ndarray, where: np.ndarray) -> list[np.ndarray]:
        """sx + sz and sz - sx + 2 i txz [Pa] of each of the kinks (r,) at places (r,) [m]."""
        w, log, jump = self._around(kink, where)
        turned = 2.0 / np.pi * (w.imag * jump * (log + 1.0) + jump.imag * w * log)
        return [-2.0 / np.pi * (jump * w * log).imag, turned / self.tangent[kink] ** 2]

    def _displacement(self, kink: np.ndarray, where: np.ndarray, nu: float) -> list[np.ndarray]:
        """G (u_x + i u_z) [N/m] of each of the kinks (r,) at places (r,) [m]."""
        w, log, jump = self._around(kink, where)
        integral = 0.5 * w**2 * (log - 0.5)
        both = (3.0 - 4.0 * nu) * integral + integral.conj()
        moved = 1j * jump * both - 2.0 * w.imag * (jump * w * log).conj()
        return [moved * self.tangent[kink] / (4.0 * np.pi)]

    def _around(self, kink: np.ndarray, where: np.ndarray) -> tuple[np.ndarray, ...]:
        """w, ln w (0 at the kink) and f; the logarithm's cut points out of the body."""
        w = (where - self.place[kink]) / self.tangent[kink]
        log = np.log(np.where(w == 0.0, 1.0, w / 1j)) + np.where(w == 0.0, 0.0, 0.5j * np.pi)
        return w, log, self.jump[kink]

    def stress(
        self, weights: csr_matrix, patch: np.ndarray, place: np.ndarray, point: np.ndarray
    ) -> np.ndarray:
        """sx, sz, txz (r, q, 3) [Pa] of the kinks, weighted as for each `patch`.

        patch (r,) rows of the weights, place (n, 2) [m], point (r, q) numbers of places.
        """
        total, turned = _weighted(self._stress, weights, patch, place, point)
        total, turned = 0.5 * total.real, 0.5 * turned
        return np.stack([total - turned.real, total + turned.real, turned.imag], axis=-1)

    def displacement(
        self,
        weights: csr_matrix,
        patch: np.ndarray,
        place: np.ndarray,
        point: np.ndarray,
        material: Material,
    ) -> np.ndarray:
        """u_x, u_z (r, q, 2) [m] of the kinks, weighted as for each `patch`, as in `stress`."""

        def field(kink: np.ndarray, where: np.ndarray) -> list[np.ndarray]:
            return self._displacement(kink, where, material.poissons_ratio)

        (moved,) = _weighted(field, weights, patch, place, point)
        return np.stack([moved.real, moved.imag], axis=-1) / material.shear_modulus


def _weighted(
    field: Callable[[np.ndarray, np.ndarray], list[np.ndarray]],
    weights: csr_matrix,
    patch: np.ndarray,
    place: np.ndarray,
    point: np.ndarray,
) -> list[np.ndarray]:
    """Sums (r, q) over the kinks of what a field gives at `place`[point], weighted by patch.

    The field is computed once for each pair of a place and a kink, for all patches that share it.
    """
    near = np.diff(weights.indptr)[patch] > 0
    shares = weights[np.repeat(patch[near], point.shape[1])]
    row = point[near].ravel()
    member = csr_matrix(
        (np.ones(len(row)), (row, np.repeat(patch[near], point.shape[1]))),
        (len(place), weights.shape[0]),
    )
    table = (member @ weights).tocsr()
    table.sort_indices()
    at = np.repeat(place[:, 0] + 1j * place[:, 1], np.diff(table.indptr))
    sums = []
    for value in field(table.indices, at):
        each = csr_matrix((value, table.indices, table.indptr), table.shape)[row]
        total = np.zeros(point.shape, dtype=complex)
        total[near] = np.reshape(shares.multiply(each).sum(axis=1), (-1, point.shape[1]))
        sums.append(total)
    return sums
