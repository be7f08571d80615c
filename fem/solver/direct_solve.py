"""One system, one right-hand side, by MUMPS: for matrices that change with every Newton step."""

import numpy as np
from scipy.sparse import csr_matrix

from fem.solver.mumps import FemError, factorised, let_go


def solve_once(matrix: csr_matrix, right: np.ndarray, symmetric: bool) -> np.ndarray:
    """x (n,) of matrix x = right, on one process.

    `symmetric` matrices, definite or not, are factored as LDL^T, which holds half of what LU
    does. Raises FemError if MUMPS cannot factor it or the solution is not finite.
    """
    from petsc4py import PETSc

    matrix.sort_indices()
    system = PETSc.Mat().createAIJ(
        matrix.shape, csr=(matrix.indptr, matrix.indices, matrix.data), comm=PETSc.COMM_SELF
    )
    if symmetric:
        system.setOption(PETSc.Mat.Option.SYMMETRIC, True)
    load, found = system.createVecs()
    load.setArray(right)
    try:
        ksp, factor = factorised(system, symmetric)
        try:
            ksp.solve(load, found)
        finally:
            let_go(factor, ksp)
        solution = found.getArray().copy()
    finally:
        for used in (load, found, system):
            used.destroy()
    if not np.isfinite(solution).all():
        raise FemError(f"the system of {matrix.shape[0]} unknowns is singular")
    return solution
