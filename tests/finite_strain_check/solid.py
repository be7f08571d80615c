"""A plane-strain body of quadratic triangles: forces, tangent and stresses, all in numpy.

    linear          sigma = lambda tr(e) I + 2 mu e
    neo-hookean     W = mu/2 (tr(F'F) - 2) - mu ln J + lambda/2 (ln J)^2
    st-venant       W = lambda/2 tr(E)^2 + mu E:E,  E = (F'F - I) / 2
    (l, m) over mu  Murnaghan's: (l - m)/3 tr(E)^3 + m tr(E) E:E beside the last

F = I + grad u, J = det F, P = dW/dF nominal and sigma = P F' / J Cauchy's stress. Total Lagrangian,
three integration points an element. Bonet and Wood, Nonlinear Continuum Mechanics, ch. 6.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_matrix

from tests.finite_strain_check.mesh import Triangles, quadratic_gradients

POINTS = np.array([[1 / 6, 1 / 6], [2 / 3, 1 / 6], [1 / 6, 2 / 3]])  # weights 1/6
CHUNK = 20_000  # elements at a time
# Linear through the three points, evaluated at the six nodes.
_LINEAR = np.linalg.inv(np.column_stack([np.ones(3), POINTS]))
_NODES = np.array([[0, 0], [1, 0], [0, 1], [0.5, 0.5], [0, 0.5], [0.5, 0]])
TO_NODES = np.column_stack([np.ones(6), _NODES]) @ _LINEAR
I2 = np.eye(2)


class InvertedError(Exception):
    """An element is turned inside out."""


@dataclass(frozen=True)
class Solid:
    """A meshed body.

    mesh     its flat strip
    places   (n, 2) undeformed nodes, [um] where moduli are in GPa
    held     (n,) nodes that do not move
    modulus  Young's modulus, ratio Poisson's: of all elements, or (m,) of each
    law      see above
    """

    mesh: Triangles
    places: np.ndarray
    held: np.ndarray
    modulus: float | np.ndarray
    ratio: float | np.ndarray
    law: str | tuple[float, float]

    @cached_property
    def lame(self) -> np.ndarray:
        """lambda and mu (2, m) of each element."""
        count = len(self.mesh.elements)
        e, v = (np.broadcast_to(constant, count) for constant in (self.modulus, self.ratio))
        return np.stack([e * v / ((1 + v) * (1 - 2 * v)), e / (2 * (1 + v))])

    @cached_property
    def gradients(self) -> tuple[np.ndarray, np.ndarray]:
        """Gradients of shape functions (m, 3, 6, 2) at integration points, and weights (m, 3)."""
        local = np.array([quadratic_gradients(*point) for point in POINTS])
        jacobian = np.einsum("eai,gaj->egij", self.places[self.mesh.elements], local)
        det = np.linalg.det(jacobian)
        if (det * np.sign(det[0, 0]) <= 0.0).any():
            raise InvertedError("the mesh is turned inside out")
        return np.einsum("gaj,egji->egai", local, np.linalg.inv(jacobian)), np.abs(det) / 6.0

    def deformation(self, u: np.ndarray, part: slice = slice(None)) -> np.ndarray:
        """F (m, 3, 2, 2) for displacements (n, 2)."""
        return I2 + np.einsum(
            "eai,egaj->egij", u[self.mesh.elements[part]], self.gradients[0][part]
        )

    def nominal(self, f: np.ndarray, part: slice = slice(None)) -> tuple[np.ndarray, np.ndarray]:
        """P (m, 3, 2, 2) and dP/dF (m, 3, 2, 2, 2, 2) of F in a part of the elements."""
        lam, mu = (constant[part, None, None, None] for constant in self.lame)
        lam4, mu4 = (constant[..., None, None] for constant in (lam, mu))
        if self.law == "neo-hookean":
            det = f[..., 0, 0] * f[..., 1, 1] - f[..., 0, 1] * f[..., 1, 0]
            if (det <= 0.0).any():
                raise InvertedError
            inv = np.empty_like(f)
            inv[..., 0, 0], inv[..., 1, 1] = f[..., 1, 1] / det, f[..., 0, 0] / det
            inv[..., 0, 1], inv[..., 1, 0] = -f[..., 0, 1] / det, -f[..., 1, 0] / det
            log = lam * np.log(det)[..., None, None]
            log4 = log[..., None, None]
            stress = mu * f + (log - mu) * np.swapaxes(inv, -1, -2)
            tangent = lam4 * np.einsum("...ji,...lk->...ijkl", inv, inv)
            tangent += (mu4 - log4) * np.einsum("...jk,...li->...ijkl", inv, inv)
            return stress, tangent + mu4 * np.einsum("ik,jl->ijkl", I2, I2)
        if self.law == "linear":
            moduli = lam4 * np.einsum("ij,kl->ijkl", I2, I2)
            moduli = moduli + mu4 * (
                np.einsum("ik,jl->ijkl", I2, I2) + np.einsum("il,jk->ijkl", I2, I2)
            )
            stress = np.einsum("...ijkl,...kl->...ij", moduli, f - I2)
            return stress, np.broadcast_to(moduli, (*f.shape, 2, 2))
        green = 0.5 * (np.einsum("...ki,...kj->...ij", f, f) - I2)
        trace = np.trace(green, axis1=-2, axis2=-1)[..., None, None]
        ell, m = (part * mu for part in (self.law if isinstance(self.law, tuple) else (0.0, 0.0)))
        square = np.einsum("...ij,...ij->...", green, green)[..., None, None]
        second = lam * trace + (ell - m) * trace**2 + m * square
        lam4 = (lam + 2 * (ell - m) * trace)[..., None, None]
        mu4 = (mu + m * trace)[..., None, None]
        second = second * I2 + mu4[..., 0, 0] * 2 * green
        tangent = np.einsum("ik,...jl->...ijkl", I2, second)
        tangent = tangent + lam4 * np.einsum("...ij,...kl->...ijkl", f, f)
        left = np.einsum("...im,...km->...ik", f, f)
        tangent += mu4 * np.einsum("...ik,jl->...ijkl", left, I2)
        tangent += mu4 * np.einsum("...il,...kj->...ijkl", f, f)
        strained = np.einsum("...ij,...kl->...ijkl", f, f @ green)
        both = strained + np.einsum("...ijkl->...klij", strained)
        return f @ second, tangent + 2 * m[..., None, None] * both

    @cached_property
    def numbers(self) -> np.ndarray:
        """(n, 2) unknown of each node and direction, -1 where held."""
        numbers = np.full((len(self.places), 2), -1)
        free = np.flatnonzero(~self.held)
        numbers[free] = np.arange(2 * len(free)).reshape(-1, 2)
        return numbers

    @property
    def count(self) -> int:
        """Count of unknowns."""
        return 2 * int(np.count_nonzero(~self.held))

    @cached_property
    def _pattern(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Entries of element matrices that stay, their indices in the matrix, and its structure."""
        n = self.numbers[self.mesh.elements].reshape(-1, 12)
        row, column = (a.ravel() for a in np.broadcast_arrays(n[:, :, None], n[:, None, :]))
        stays = np.flatnonzero((row >= 0) & (column >= 0))
        key, at = np.unique(row[stays] * self.count + column[stays], return_inverse=True)
        row, column = np.divmod(key, self.count)
        start = np.searchsorted(row, np.arange(self.count + 1)).astype(np.int32)
        return stays, at, start, column.astype(np.int32)

    @cached_property
    def _stiffness(self) -> csr_matrix:
        """The tangent of the linear law."""
        return self._linearised(np.zeros_like(self.places))[1]

    def linearised(self, u: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        """Internal forces of the free unknowns and their tangent, at displacements (n, 2) that the
        held nodes do not have."""
        if self.law == "linear":
            return self._stiffness @ u[~self.held].ravel(), self._stiffness
        return self._linearised(u)

    def _linearised(self, u: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        gradient, weight = self.gradients
        elements = self.mesh.elements
        force = np.zeros((len(elements), 6, 2))
        matrix = np.empty((len(elements), 6, 2, 6, 2))
        for start in range(0, len(elements), CHUNK):
            part = slice(start, start + CHUNK)
            stress, tangent = self.nominal(self.deformation(u, part), part)
            d, w = gradient[part], weight[part]
            force[part] = np.einsum("egij,egaj,eg->eai", stress, d, w, optimize=True)
            flat = d.transpose(0, 2, 1, 3).reshape(len(d), 6, 6)
            for i, k in ((0, 0), (0, 1), (1, 1)):
                moduli = tangent[..., i, :, k, :] * w[..., None, None]
                right = moduli @ d.swapaxes(-1, -2)
                block = flat @ right.reshape(len(d), 6, 6)
                matrix[part, :, i, :, k] = block
                if i != k:
                    matrix[part, :, k, :, i] = block.swapaxes(1, 2)
        stays, at, start, column = self._pattern
        data = np.bincount(at, weights=matrix.ravel()[stays], minlength=len(column))
        numbers = self.numbers[elements].ravel()
        free = numbers >= 0
        total = np.bincount(numbers[free], weights=force.ravel()[free], minlength=self.count)
        return total, csr_matrix((data, column, start), shape=(self.count, self.count))

    def cauchy(self, u: np.ndarray) -> np.ndarray:
        """Cauchy's sx, sz, txz (3, n) at the nodes: lines through the integration points of each
        element, averaged over the elements at a node, weighted by area."""
        f = self.deformation(u)
        stress = self.nominal(f)[0]
        if self.law != "linear":
            stress = stress @ f.swapaxes(-1, -2) / np.linalg.det(f)[..., None, None]
        parts = np.stack([stress[..., 0, 0], stress[..., 1, 1], stress[..., 0, 1]], axis=-1)
        nodal = np.einsum("ng,egc->enc", TO_NODES, parts)
        area = self.gradients[1].sum(axis=1)
        at, weight = self.mesh.elements.ravel(), np.repeat(area, 6)
        total = np.bincount(at, weights=weight)
        values = nodal.reshape(-1, 3) * weight[:, None]
        return np.stack([np.bincount(at, weights=values[:, c]) / total for c in range(3)])
