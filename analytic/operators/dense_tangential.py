"""A compliance that is not symmetric, given as its whole matrix.

For a body that no model comes close to: the matrix of a finite-element body with the traction
that its pressures drag along, one back-substitution a column. Solving costs Gauss' elimination on
the nodes in contact, a tenth of a second for 1500 of them.
"""

import warnings
from functools import cached_property

import numpy as np
from scipy.linalg import LinAlgError, LinAlgWarning

from analytic.contact.nested_start import restricted
from analytic.operators.convolution import made_once
from analytic.operators.half_plane import DenseCompliance
from analytic.operators.tangential import eliminated


class DenseCoupledCompliance:
    """A compliance as a matrix (n, n) [m^2/Pa] whose symmetric part is positive definite.

    skew    whether there is anything beside the symmetric part
    """

    periodic = False
    ring = None

    def __init__(self, matrix: np.ndarray) -> None:
        self.matrix = matrix
        self.count = len(matrix)
        self.skew = not np.array_equal(matrix, matrix.T)

    @cached_property
    def normal(self) -> DenseCompliance:
        """The symmetric part; where every set of nodes can be eliminated nothing asks for it."""
        return DenseCompliance(self.matrix)

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        """Weighted displacements (n,) [m^2] of nodal pressures (n,) [Pa]."""
        return self.matrix @ pressure

    def precondition(self, displacement: np.ndarray) -> np.ndarray:
        """Approximate inverse, positive definite."""
        return self.normal.precondition(displacement)

    def solve(self, nodes: np.ndarray, right: np.ndarray) -> np.ndarray | None:
        """Pressures (m, k) of these nodes alone under which they sink by `right` (m, k).

        None where hats finer than a body's elements leave a matrix of lower rank.
        """
        with warnings.catch_warnings():
            warnings.simplefilter("error", LinAlgWarning)
            try:
                return eliminated(self.block(nodes), right)
            except (LinAlgError, LinAlgWarning):
                return None

    def block(self, nodes: np.ndarray) -> np.ndarray:
        """The matrix's rows and columns of these nodes (m,), as an array (m, m) [m^2/Pa]."""
        return self.matrix[np.ix_(nodes, nodes)]

    def cropped(self, span: int) -> None:
        """No part of a body has a compliance that depends on distances alone."""

    @made_once
    def coarsened(self) -> "DenseCoupledCompliance":
        """The same body on hats twice as wide, centred on nodes 1, 3, 5, …"""
        rows = restricted(self.matrix, self.periodic)
        return DenseCoupledCompliance(restricted(rows.T, self.periodic).T)
