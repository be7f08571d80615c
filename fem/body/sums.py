"""Sums of what elements give to their nodes: sparse matrices and nodal values."""

from math import prod

import numpy as np
from scipy.sparse import csr_matrix


def matrix_of(
    value: np.ndarray, row: np.ndarray, column: np.ndarray, shape: tuple[int, int]
) -> csr_matrix:
    """Matrix of values added at their rows and columns; the arrays are broadcast together."""
    value, row, column = (array.ravel() for array in np.broadcast_arrays(value, row, column))
    return csr_matrix((value, (row, column)), shape=shape)


def nodal_sums(node: np.ndarray, value: np.ndarray, count: int) -> np.ndarray:
    """Sums (count, c) or (count,) at nodes of the values (…, c) or (…) given to `node` (…)."""
    shape = value.shape[node.ndim :]
    columns = value.reshape(node.size, prod(shape)).T
    sums = [np.bincount(node.ravel(), column, count) for column in columns]
    return np.stack(sums, axis=-1).reshape(count, *shape)
