"""Sides of a block that move as one: a body that repeats along its surface.

The nodes of the right side follow those of the left at the same depth. With T the matrix that gives
all displacements from those that lead, the system T'KT u = T'f is as large as before: what follows
has no row in it but the identity's. So numbering and the factorisation stay as they are."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from fem.body.surface import SAME_POINT, BoundaryPoints
from fem.solver.mumps import FemError

if TYPE_CHECKING:
    from petsc4py.PETSc import Mat


@dataclass(frozen=True)
class Ties:
    """Nodes `right` (k,) that follow the nodes `left` (k,)."""

    left: np.ndarray
    right: np.ndarray

    def summed(self, load: np.ndarray) -> np.ndarray:
        """T'f (…, n, 2) of nodal forces f."""
        moved = load.copy()
        moved[..., self.left, :] += load[..., self.right, :]
        moved[..., self.right, :] = 0.0
        return moved

    def followed(self, displacement: np.ndarray) -> np.ndarray:
        """T u (…, n, 2)."""
        moved = displacement.copy()
        moved[..., self.right, :] = displacement[..., self.left, :]
        return moved

    def applied(self, matrix: "Mat", nodes: np.ndarray) -> "Mat":
        """T'KT, with the identity in the rows of what follows, of PETSc's K, which is freed.

        nodes  (n,) in the order of their rows, two each"""
        from petsc4py import PETSc

        row_of = np.argsort(nodes)  # of each node, over two
        leader = np.arange(len(nodes))
        leader[self.right] = self.left
        follows = np.zeros(len(nodes), dtype=bool)
        follows[self.right] = True

        def one_a_row(columns: np.ndarray, values: np.ndarray) -> "Mat":
            """Rows of one entry each."""
            csr = np.arange(len(columns) + 1, dtype=PETSc.IntType), columns, values
            return PETSc.Mat().createAIJ(matrix.getSizes(), csr=csr, comm=PETSc.COMM_SELF)

        columns = (2 * row_of[leader[nodes], None] + np.arange(2)).ravel().astype(PETSc.IntType)
        give = one_a_row(columns, np.ones(len(columns)))
        diagonal = np.arange(len(columns), dtype=PETSc.IntType)
        identity = one_a_row(diagonal, np.repeat(follows[nodes].astype(float), 2))
        tied = matrix.PtAP(give)
        tied.axpy(1.0, identity)
        for used in (matrix, give, identity):
            used.destroy()
        return tied


def tied_sides(flat: np.ndarray, sides: BoundaryPoints) -> Ties:
    """Ties of nodes at `flat` (n, 2) in the flat block. FemError where the sides do not match."""
    left, right = (side[np.argsort(flat[side, 1])] for side in (sides.left, sides.right))
    slack = SAME_POINT * np.ptp(flat[:, 1])
    if len(left) != len(right) or np.abs(flat[left, 1] - flat[right, 1]).max() > slack:
        raise FemError("the nodes of the two sides do not stand at the same depths")
    return Ties(left, right)
