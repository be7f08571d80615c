"""Sides of a block that move as one: a body that repeats along its surface.

The nodes of the right side follow those of the left at the same depth. With T the matrix that gives
all displacements from those that lead, the system T'KT u = T'f is as large as before: what follows
has no row in it but the identity's. So numbering, ranks and the factorisation stay as they are."""

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

    def applied(self, matrix: "Mat", owned: np.ndarray, count: int) -> "Mat":
        """T'KT, with the identity in the rows of what follows, of PETSc's K, which is freed.

        owned  this process's nodes, in the order of their rows, two each, of `count` in all"""
        from petsc4py import PETSc

        start = matrix.getOwnershipRange()[0]
        rank_nodes = matrix.comm.tompi4py().allgather(owned)
        row_of = np.empty(count, dtype=PETSc.IntType)  # of each node, over two
        row_of[np.concatenate(rank_nodes)] = np.arange(count)
        leader = np.arange(count)
        leader[self.right] = self.left
        follows = np.zeros(count, dtype=bool)
        follows[self.right] = True

        def one_a_row(columns: np.ndarray, values: np.ndarray) -> "Mat":
            """This process's rows, one entry each."""
            rows = np.arange(len(columns) + 1, dtype=PETSc.IntType)
            return PETSc.Mat().createAIJ(matrix.getSizes(), csr=(rows, columns, values), comm=comm)

        comm = matrix.comm
        columns = (2 * row_of[leader[owned], None] + np.arange(2)).ravel().astype(PETSc.IntType)
        give = one_a_row(columns, np.ones(len(columns)))
        numbers = np.arange(start, start + len(columns), dtype=PETSc.IntType)
        identity = one_a_row(numbers, np.repeat(follows[owned].astype(float), 2))
        tied = matrix.PtAP(give)
        tied.axpy(1.0, identity)
        for used in (matrix, give, identity):
            used.destroy()
        return tied


def tied_sides(flat: np.ndarray, sides: BoundaryPoints) -> Ties:
    """Ties of nodes at `flat` (n, 2) in the flat block. FemError where the sides do not match."""
    left, right = (side[np.argsort(flat[side, 1])] for side in (sides.left, sides.right))
    depth = np.ptp(flat[:, 1])
    apart = np.inf
    if len(left) == len(right):
        apart = np.abs(flat[left, 1] - flat[right, 1]).max()
    if apart > SAME_POINT * depth:
        raise FemError("the nodes of the two sides do not stand at the same depths")
    return Ties(left, right)
