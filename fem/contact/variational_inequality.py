"""The contact problem as one system, solved by PETSc's variational-inequality solver.

An independent solver: it shares the mesh, the stiffness and the nodal forces of the hats with
`fem.compliance.operator`, but no operator and no contact solver of the project.

    K_b u_b - B_b p           = 0    for each body b
    G - w d + sum_b B_b' u_b >= 0,  0 <= p <= H,  complementary
    P - w' p                  = 0

Nomenclature: u displacement [m], p hat pressures [Pa], d approach [m], K stiffness [Pa],
B nodal forces of unit hats [m], G weighted initial gap [m^2], w weights [m], P load [N/m],
H hardness [Pa]. PETSc wants the function >= 0 at a lower bound and <= 0 at an upper one."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import bmat, csr_matrix, diags

from fem.body.elasticity import ElasticBody
from fem.contact.terms import on_all_nodes
from fem.solver.mumps import ORDERING, SPARE_ROOM, FemError

PREFIX = "crosscheck_inequality_"

# Norm of the residual, in units of mean pressure times pitch and of the corresponding displacement.
# The method ends in a finite number of steps: above 1e-3 before the last one, 1e-10 after it.
RESIDUAL = 1e-8
MOST_ITERATIONS = 200


@dataclass(frozen=True)
class VariationalSolution:
    """`pressure` (n,) [Pa], `approach` [m], Newton `iterations`."""

    pressure: np.ndarray
    approach: float
    iterations: int


def solve_variational_inequality(
    bodies: Sequence[tuple[ElasticBody, csr_matrix]],
    gap: np.ndarray,
    weights: np.ndarray,
    load: float,
    hardness: float = np.inf,
) -> VariationalSolution:
    """Frictionless contact of bodies, each with its `hat_forces` B (2k, n), on one grid of hats.

    gap       G (n,) [m^2], integral of hat times initial gap
    weights   w (n,) [m], integrals of the hats
    load      P [N/m] > 0, and below what all hats bear at the `hardness` H [Pa]

    Reduced-space Newton (PETSc vinewtonrsls) with MUMPS' LU of the monolithic matrix; on one
    process. Raises ValueError for a load that cannot be borne, FemError if it does not converge."""
    from petsc4py import PETSc

    if not 0.0 < load < np.inf:
        raise ValueError(f"the load must be positive, not {load:g} N/m")
    if load >= hardness * weights.sum():
        raise ValueError(f"a load of {load:g} N/m exceeds the hardness times the pressed length")
    count, pitch = len(gap), weights.mean()
    pressure_unit = load / weights.sum()
    compliances = np.array([1.0 / body.material.youngs_modulus for body, _ in bodies])
    length_unit = pressure_unit * pitch * compliances.sum()
    system = _scaled_system(bodies, compliances / compliances.sum(), weights, pitch)
    constant = np.zeros(system.shape[0])
    pressures = slice(-1 - count, -1)
    constant[pressures] = gap / (pitch * length_unit)
    constant[-1] = load / (pitch * pressure_unit)

    csr = (system.indptr, system.indices, system.data)
    matrix = PETSc.Mat().createAIJ(system.shape, csr=csr, comm=PETSc.COMM_SELF)
    x = matrix.createVecRight()
    lower, upper = x.duplicate(), x.duplicate()
    lower.set(PETSc.NINFINITY)
    upper.set(PETSc.INFINITY)
    lower.array[pressures] = 0.0
    if np.isfinite(hardness):
        upper.array[pressures] = hardness / pressure_unit
    # Contact everywhere: without any the approach would be undetermined.
    x.array[pressures] = 1.0

    def residual(snes: object, at: object, result: object) -> None:
        matrix.mult(at, result)
        result.array += constant

    snes = PETSc.SNES().create(PETSc.COMM_SELF)
    snes.setType("vinewtonrsls")
    snes.setFunction(residual, x.duplicate())
    snes.setJacobian(lambda snes, at, jacobian, preconditioner: None, matrix, matrix)
    snes.setVariableBounds(lower, upper)
    snes.setTolerances(rtol=0.0, atol=RESIDUAL, stol=0.0, max_it=MOST_ITERATIONS)
    options = PETSc.Options(PREFIX)
    options["snes_linesearch_type"] = "basic"
    options["mat_mumps_icntl_7"], options["mat_mumps_icntl_14"] = ORDERING, SPARE_ROOM
    snes.setOptionsPrefix(PREFIX)
    snes.setFromOptions()
    ksp = snes.getKSP()
    ksp.setType(PETSc.KSP.Type.PREONLY)
    ksp.getPC().setType(PETSc.PC.Type.LU)
    ksp.getPC().setFactorSolverType(PETSc.Mat.SolverType.MUMPS)
    snes.solve(None, x)
    reason = snes.getConvergedReason()
    if reason < 0:
        raise FemError(f"PETSc's variational inequality did not converge: reason {reason}")
    pressure, approach = x.array[pressures] * pressure_unit, float(x.array[-1]) * length_unit
    return VariationalSolution(pressure, approach, snes.getIterationNumber())


def _scaled_system(
    bodies: Sequence, softness: np.ndarray, weights: np.ndarray, pitch: float
) -> csr_matrix:
    """Matrix of the whole system in (u_1, ..., p, d), all of them of order one. `softness`
    (bodies,) is each body's part of the compliance, in which its displacement is scaled. B'(K u - B
    p), zero at the solution, is subtracted from the gap: where a Newton step set a negative
    pressure to zero, the gap would otherwise be rounding of either sign; so it is positive and the
    hat leaves the contact."""
    size = len(bodies) + 2
    rows = [[None] * size for _ in range(size)]
    rows[-2][-2] = csr_matrix((len(weights), len(weights)))
    for place, ((body, forces), soft) in enumerate(zip(bodies, softness, strict=True)):
        k = body.stiffness() / body.material.youngs_modulus
        free = diags((~body.held).ravel().astype(float))  # held components bear no forces
        b = free @ on_all_nodes(body, forces) / pitch
        rows[place][place], rows[place][-2] = k, -b
        rows[-2][place] = soft * (b.T - b.T @ k)
        rows[-2][-2] = rows[-2][-2] + soft * (b.T @ b)
    share = csr_matrix(weights[:, None] / pitch)
    rows[-2][-1], rows[-1][-2] = -share, -share.T
    rows[-1][-1] = csr_matrix((1, 1))
    return bmat(rows, format="csr")
