"""One system, one right-hand side, by MUMPS: for matrices that change with every Newton step."""

import numpy as np
from scipy.sparse import csr_matrix

from fem.mumps import MOST_SPARE_ROOM, ORDERING, REASONS, SPARE_ROOM, TOO_LITTLE_ROOM, FemError

PREFIX = "crosscheck_newton_"


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
    spare = SPARE_ROOM
    while True:
        info = _attempt(system, load, found, symmetric, spare)
        if info not in TOO_LITTLE_ROOM or spare > MOST_SPARE_ROOM:
            break
        spare *= 2
    solution = found.getArray().copy()
    for used in (load, found, system):
        used.destroy()
    if info < 0:
        reason = REASONS.get(info, "see the MUMPS users' guide")
        raise FemError(
            f"MUMPS could not factor {matrix.shape[0]} unknowns: {reason} (INFOG(1) = {info})"
        )
    if not np.isfinite(solution).all():
        raise FemError(f"the system of {matrix.shape[0]} unknowns is singular")
    return solution


def _attempt(system, load, found, symmetric: bool, spare: int) -> int:
    """Factor and solve into `found`; MUMPS' INFOG(1), negative where it failed."""
    from petsc4py import PETSc

    options = PETSc.Options(PREFIX)
    options["mat_mumps_icntl_7"], options["mat_mumps_icntl_14"] = ORDERING, spare
    ksp = PETSc.KSP().create(PETSc.COMM_SELF)
    ksp.setOperators(system)
    ksp.setType(PETSc.KSP.Type.PREONLY)
    pc = ksp.getPC()
    pc.setType(PETSc.PC.Type.CHOLESKY if symmetric else PETSc.PC.Type.LU)
    pc.setFactorSolverType(PETSc.Mat.SolverType.MUMPS)
    pc.setFactorSetUpSolverType()
    factor = pc.getFactorMatrix()
    factor.setOptionsPrefix(PREFIX)
    try:
        ksp.setUp()
        info = factor.getMumpsInfog(1)
        if info >= 0:
            ksp.solve(load, found)
    except PETSc.Error as error:
        info = factor.getMumpsInfog(1)
        if info >= 0:
            raise FemError("PETSc could not set up the factorisation") from error
    finally:  # PETSc keeps what Python lets go of, from 3.18 on, until it is told
        for used in (factor, pc, ksp):
            used.destroy()
    return info
