"""The contact problem on which finite-element codes are compared, and this project's solution.

A rigid parabola on a block in plane strain whose bottom and sides are fixed. It is so flat that all
linear formulations of gap and traction agree to first order in its slope. The load gives Hertz's
half-width a and peak pressure p0.

    g0(x) = x^2 / (2 R)                                             initial gap [m]
    u_z >= d - g0,   p >= 0,   p (u_z + g0 - d) = 0                 where contact is possible

u_z is the displacement of the flat top into the body. The approach d is prescribed, which every
code offers. It belongs to the load in the reference, this project's solution by cubic elements on
a mesh finer than all others. That the peers' errors fall with their meshes as far as this
project's shows that the reference is valid for them, too.

    a   half-width, 1 m     R   radius [m]     E, nu   1 Pa and 0.3
"""

from typing import NamedTuple

import numpy as np

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution
from analytic.exact.hertz import HertzContact, hertz_from_peak_pressure
from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane
from fem.body.elasticity import elastic_body
from fem.body.support import Support
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block
from tests.finite_element_peers.task import (
    BLOCK,
    MATERIAL,
    RADIUS,
    SLOPE,
    BlockAnswer,
    BlockTask,
    FailedError,
    gap,
)

REACH = 1.25  # half of the width on which contact is possible, in a
# The reference: edges to a, growth of the elements, degree, hats to an edge.
FINEST, FINEST_GROWTH, FINEST_DEGREE, FINEST_HATS = 640, 0.15, 3, 2


class BlockCase(NamedTuple):
    """The problem's approach d [m] and the reference's largest pressure [Pa]."""

    approach: float
    peak: float

    def task(self, edges: int, growth: float) -> BlockTask:
        """Task on a mesh with so many edges to a, whose elements grow by `growth`."""
        return BlockTask(_mesh(edges, growth), self.approach)


def hertz() -> HertzContact:
    """Hertz's contact of the parabola on a half-plane."""
    modulus = MATERIAL.plane_strain_modulus
    return hertz_from_peak_pressure(0.5 * SLOPE * modulus, RADIUS, modulus)


def cylinder(finest: int = FINEST) -> BlockCase:
    """Hertz's contact, its reference solved on `finest` edges to a."""
    task = BlockTask(_mesh(finest, FINEST_GROWTH), 0.0)
    load = Constraints(load=hertz().load_per_length)
    solution, _ = _contact(task, FINEST_DEGREE, FINEST_HATS, load)
    return BlockCase(solution.approach, float(solution.pressure.max()))


def _mesh(edges: int, growth: float) -> BlockMesh:
    end = np.ceil(REACH * edges - 1e-9) / edges
    return build_block(BlockSpec(BLOCK, BLOCK, np.array([[-end, end]]), 1.0 / edges, growth))


def solved(degree: int, hats: int, task: BlockTask) -> BlockAnswer:
    """Solve by this project's elements of a degree, with so many hats to an edge."""
    solution, unknowns = _contact(task, degree, hats, Constraints(approach=task.approach))
    return BlockAnswer(float(solution.pressure.max()), unknowns)


def _contact(
    task: BlockTask, degree: int, hats: int, constraints: Constraints
) -> tuple[ContactSolution, int]:
    """The half-plane is the model of the outer iteration; with the number of unknowns."""
    body = elastic_body(task.mesh, MATERIAL, Support("bonded", "fixed"), degree=degree)
    grid = HatGrid.within(*task.ends, task.mesh.spec.surface_size / hats)
    feet = np.arange(grid.first - 1, grid.last + 2) * grid.pitch
    solution = solve_with_model(
        FiniteElementCompliance(body, feet),
        HalfPlane(grid.count, grid.pitch, MATERIAL.plane_strain_modulus),
        grid.hat_integrals(gap),
        grid.weights,
        constraints,
    )
    if not solution.converged:
        raise FailedError(f"not converged: {solution.residuals}")
    return solution, body.unknowns
