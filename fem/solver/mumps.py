"""Factorisations by MUMPS: symmetric for many right-hand sides, general for one, and their cost."""

import weakref
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_matrix

from fem import compat

if TYPE_CHECKING:
    from petsc4py.PETSc import KSP, Mat, Object

# Extra room for fill that pivoting and unsymmetric trees need, per cent (MUMPS ICNTL(14), default
# 20, too little for graded meshes of high contrast); each failure doubles it.
SPARE_ROOM = 60
MOST_SPARE_ROOM = 1000

# Approximate minimum fill (MUMPS ICNTL(7)): on graded triangles the fill of PORD, the default
# without METIS and SCOTCH, in a sixth of the time.
ORDERING = 2

# Only options reach ICNTL(7) in all PETSc releases; the prefix keeps them apart from others'.
PREFIX = "crosscheck_"

# MUMPS INFOG(1) that more room cures (MUMPS users' guide, section "Error diagnostics").
TOO_LITTLE_ROOM = (-8, -9, -14, -17, -20)
REASONS = {
    -5: "the analysis ran out of memory",
    -7: "the analysis ran out of memory",
    -10: "the matrix is singular",
    -13: "the machine ran out of memory",
    -19: "the memory limit is too small",
}


# Time of a factorisation on one core (MUMPS 5.5 on the reference BLAS, 10 000 to 500 000 unknowns).
# Elements that grow from a refined surface cost 3 to 4 us an unknown, many equal ones, as in a
# stress window, more: 4.8 us at 34 000 unknowns, 15 us at 350 000. The law follows the latter.
SECONDS_LINEAR = 2.4e-6  # an unknown: reading, ordering, small fronts
SECONDS_FRONTS = 2.1e-8  # an unknown to the power 1.5: large fronts in two dimensions


class FemError(RuntimeError):
    """The finite-element system could not be built or solved."""


def release_with(owner: object, *objects: "Object") -> None:
    """Free PETSc's objects when Python frees their owner: from 3.18 on PETSc keeps them."""
    for item in objects:
        weakref.finalize(owner, item.destroy).atexit = False


class SymmetricFactor:
    """LDL^T of an assembled symmetric positive definite PETSc matrix, both triangles stored. It
    does not need the matrix again.

    Raises FemError if MUMPS cannot factor it."""

    def __init__(self, matrix: object) -> None:
        from petsc4py import PETSc

        matrix.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        matrix.setOption(PETSc.Mat.Option.SPD, True)
        self._right, self._left = matrix.createVecs()
        ksp, self._factor = factorised(matrix)
        for used in (ksp.getPC(), ksp):  # they hold the matrix
            used.destroy()
        release_with(self, self._factor, self._right, self._left)

    def solve(self, load: np.ndarray) -> np.ndarray:
        """The solution for a load (n,), or those for m loads (n, m)."""
        if load.ndim == 1:
            self._right.setArray(load)
            self._factor.solve(self._right, self._left)
            return self._left.getArray().copy()
        return _solutions(self._factor, load)


def _solutions(factor: "Mat", right: np.ndarray) -> np.ndarray:
    """Solutions (n, m) of m right sides at once, which read the factor less often than one after
    the other."""
    from petsc4py import PETSc

    comm = PETSc.COMM_SELF
    rights = PETSc.Mat().createDense(right.shape, array=np.asfortranarray(right), comm=comm)
    rights.assemble()
    left = PETSc.Mat().createDense(right.shape, comm=comm)
    left.setUp()
    left.assemble()
    factor.matSolve(rights, left)
    solution = left.getDenseArray().copy()
    rights.destroy()
    left.destroy()
    return solution


def factorised(matrix: "Mat", symmetric: bool = True) -> "tuple[KSP, Mat]":
    """KSP that owns MUMPS' factor of a PETSc matrix, and the factor: LDL^T, or LU without symmetry.
    Raises FemError if MUMPS cannot factor it."""
    spare = SPARE_ROOM
    while True:
        ksp, factor, info = _attempt(matrix, symmetric, spare)
        if info >= 0:
            return ksp, factor
        destroy(factor, ksp)
        if info not in TOO_LITTLE_ROOM or spare > MOST_SPARE_ROOM:
            reason = REASONS.get(info, "see the MUMPS users' guide")
            raise FemError(
                f"MUMPS could not factor {matrix.size[0]} unknowns: {reason} (INFOG(1) = {info})"
            )
        spare *= 2


def destroy(factor: "Mat", ksp: "KSP") -> None:
    """Free a factor: from 3.18 on PETSc does not with Python's last reference."""
    for used in (factor, ksp.getPC(), ksp):
        used.destroy()


def _attempt(matrix: "Mat", symmetric: bool, spare: int) -> "tuple[KSP, Mat, int]":
    """KSP, factor, and MUMPS' INFOG(1), negative where it failed."""
    from petsc4py import PETSc

    options = PETSc.Options(PREFIX)
    options["mat_mumps_icntl_7"] = ORDERING
    options["mat_mumps_icntl_14"] = spare
    ksp = PETSc.KSP().create(matrix.comm)
    ksp.setOperators(matrix)
    ksp.setType(PETSc.KSP.Type.PREONLY)
    pc = ksp.getPC()
    pc.setType(PETSc.PC.Type.CHOLESKY if symmetric else PETSc.PC.Type.LU)
    pc.setFactorSolverType(PETSc.Mat.SolverType.MUMPS)
    pc.setFactorSetUpSolverType()
    factor = pc.getFactorMatrix()
    factor.setOptionsPrefix(PREFIX)
    try:
        ksp.setUp()
    except PETSc.Error as error:
        if factor.getMumpsInfog(1) >= 0:
            raise FemError("PETSc could not set up the factorisation") from error
    return ksp, factor, factor.getMumpsInfog(1)


class Factor:
    """LU of a scipy matrix; of a `symmetric` one, definite or not, LDL^T. Raises FemError if MUMPS
    cannot factor it."""

    def __init__(self, matrix: csr_matrix, symmetric: bool = False) -> None:
        PETSc = compat.petsc()
        matrix.sort_indices()
        csr = (matrix.indptr, matrix.indices, matrix.data)
        system = PETSc.Mat().createAIJ(matrix.shape, csr=csr, comm=PETSc.COMM_SELF)
        if symmetric:
            system.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        self._right, self._left = system.createVecs()
        self._ksp, self._factor = factorised(system, symmetric)
        used = self._factor, self._ksp.getPC(), self._ksp, self._right, self._left, system
        release_with(self, *used)

    def solve(self, right: np.ndarray) -> np.ndarray:
        """x (n,) or (n, m) of matrix x = right. Raises FemError if it is not finite."""
        if right.ndim == 1:
            self._right.setArray(right)
            self._ksp.solve(self._right, self._left)
            solution = self._left.getArray().copy()
        else:
            solution = _solutions(self._factor, right)
        if not np.isfinite(solution).all():
            raise FemError(f"the system of {len(right)} unknowns is singular")
        return solution


def solve_once(matrix: csr_matrix, right: np.ndarray, symmetric: bool) -> np.ndarray:
    """x (n,) of matrix x = right by `Factor`, with its errors."""
    return Factor(matrix, symmetric).solve(right)


def factorisation_seconds(unknowns: int) -> float:
    """Time [s] that `SymmetricFactor` needs at most for a number of displacements."""
    return float(unknowns * (SECONDS_LINEAR + SECONDS_FRONTS * np.sqrt(unknowns)))
