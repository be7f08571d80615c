"""Backward errors as ratios to rounding, and condition numbers estimated from a factor.

As LAPACK tests its solvers (Anderson et al. 1999, LAPACK working note 41, test ratios of xGET02):

    ratio = ||b - A x||_1 / (||A||_1 ||x||_1 eps),   passed below THRESHOLD, whatever cond(A) is:

x then solves a problem whose matrix is known as well as doubles hold it.
"""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import LinearOperator, onenormest
from scipy.sparse.linalg import norm as sparse_norm

THRESHOLD = 30.0  # LAPACK's own for its test ratios
EPS = float(np.finfo(float).eps)


def backward_ratio(
    matrix: np.ndarray | csr_matrix, solution: np.ndarray, right: np.ndarray, eps: float = EPS
) -> float:
    """The ratio of this module for vectors (n,) or columns (n, k), the largest of the columns."""
    residual = np.abs(right - matrix @ solution).sum(axis=0)
    size = np.abs(solution).sum(axis=0)
    return float(np.max(residual / (one_norm(matrix) * size * eps)))


def product_ratio(
    matrix_norm: float, vector: np.ndarray, product: np.ndarray, exact: np.ndarray, eps: float = EPS
) -> float:
    """Error of a product A x over ||A|| ||x|| eps, in the maximum norm."""
    return float(np.abs(product - exact).max() / (matrix_norm * np.abs(vector).max() * eps))


def one_norm(matrix: np.ndarray | csr_matrix) -> float:
    """Largest sum of a column's amounts."""
    return float(
        np.linalg.norm(matrix, 1) if isinstance(matrix, np.ndarray) else sparse_norm(matrix, 1)
    )


def condition_estimate(matrix: csr_matrix, solve: Callable[[np.ndarray], np.ndarray]) -> float:
    """cond_1 of a symmetric matrix (n, n), with its inverse by `solve` of (n,) (Higham 2002)."""

    def columns(right: np.ndarray) -> np.ndarray:
        return np.column_stack([solve(column) for column in right.T])

    inverse = LinearOperator(
        matrix.shape, matvec=solve, rmatvec=solve, matmat=columns, rmatmat=columns, dtype=float
    )
    return one_norm(matrix) * float(onenormest(inverse, t=2))
