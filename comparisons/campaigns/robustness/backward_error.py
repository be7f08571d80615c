"""Backward errors as ratios to rounding, and condition numbers estimated from a factor.

As LAPACK tests its solvers (Anderson et al. 1999, LAPACK working note 41, test ratios of xGET02):

    ratio = ||b - A x||_1 / (||A||_1 ||x||_1 eps),   passed below THRESHOLD, whatever cond(A) is

Then x is exact for a matrix that differs from A by rounding."""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import LinearOperator, onenormest
from scipy.sparse.linalg import norm as sparse_norm

THRESHOLD = 30.0  # LAPACK's own for its test ratios
EPS = float(np.finfo(float).eps)


def backward_ratio(
    matrix: np.ndarray | csr_matrix, solution: np.ndarray, right: np.ndarray
) -> float:
    """The ratio of this module for vectors (n,), or the largest of columns (n, k)."""
    residual = np.abs(right - matrix @ solution).sum(axis=0)
    size = np.abs(solution).sum(axis=0)
    return float(np.max(residual / (one_norm(matrix) * size * EPS)))


def one_norm(matrix: np.ndarray | csr_matrix) -> float:
    return float(
        np.linalg.norm(matrix, 1) if isinstance(matrix, np.ndarray) else sparse_norm(matrix, 1)
    )


def condition_estimate(matrix: csr_matrix, solve: Callable[[np.ndarray], np.ndarray]) -> float:
    """cond_1 of a symmetric matrix (n, n); `solve` applies its inverse to (n,) (Higham 2002)."""

    def columns(right: np.ndarray) -> np.ndarray:
        return np.column_stack([solve(column) for column in right.T])

    inverse = LinearOperator(
        matrix.shape, matvec=solve, rmatvec=solve, matmat=columns, rmatmat=columns, dtype=float
    )
    return one_norm(matrix) * float(onenormest(inverse, t=2))
