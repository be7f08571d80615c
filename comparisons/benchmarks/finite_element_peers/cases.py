"""The contact problems on which finite-element codes are compared, and this project's solution.

A rigid parabola, smooth or with waves on it, on a block in plane strain whose bottom and sides are
fixed. It is so flat that all linear formulations of gap and traction agree to first order in its
slope. Without waves the load gives Hertz's half-width a and peak pressure p0.

    g0(x) = x^2 / (2 R) + sum_k A_k (1 - cos(2 pi x / lambda_k + phi_k))    initial gap [m]
    u_z >= d - g0,   p >= 0,   p (u_z + g0 - d) = 0                 where contact is possible

u_z is the displacement of the flat top into the body. The approach d is prescribed, which every
code offers. It belongs to the load in the reference, this project's solution by cubic elements on
a mesh finer than all others. That the peers' errors fall with their meshes as far as this
project's shows that the reference is valid for them, too.

    a   half-width, 1 m     R   radius [m]     E, nu   1 Pa and 0.3
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import HertzContact, hertz_from_peak_pressure
from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane
from comparisons.benchmarks.finite_element_peers.task import (
    BLOCK,
    MATERIAL,
    RADIUS,
    SLOPE,
    BlockAnswer,
    BlockCode,
    BlockTask,
    FailedError,
    gap,
)
from fem.body.elasticity import elastic_body
from fem.body.support import Support
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block

GROWTH = 0.4  # of the elements; with 0.2 all codes need more time for the same error
MARGIN = 1.25  # of the predicted contact: where contact is possible
LARGEST = 3.0  # half-width of the region in which the half-plane predicts contact, in a
# The reference: edges to a, growth of the elements, degree, hats to an edge.
FINEST, FINEST_GROWTH, FINEST_DEGREE, FINEST_HATS = 640, 0.15, 3, 2
SAMPLES = 40_001  # places at which pressures are compared


@dataclass(frozen=True)
class BlockCase:
    """One contact problem on a series of meshes.

    edges      element edges to a of each mesh, coarse to fine
    reach      half of the width on which contact is possible [m]
    approach   d [m]
    reference  pressures
    """

    title: str
    waves: np.ndarray
    edges: tuple[int, ...]
    reach: float
    approach: float
    reference: BlockAnswer

    def task(self, edges: int, growth: float = GROWTH) -> BlockTask:
        """The problem on a mesh with so many edges to a."""
        return BlockTask(_mesh(self.reach, edges, growth), self.waves, self.approach)

    def errors(self, answer: BlockAnswer) -> dict[str, float]:
        """Relative errors: `peak`, of the largest pressure, and `pressure`, in the L2 norm."""
        x = np.linspace(-self.reach, self.reach, SAMPLES)
        wanted, found = self.reference.at(x), answer.at(x)
        return {
            "peak": abs(answer.pressure.max() / self.reference.pressure.max() - 1.0),
            "pressure": float(np.linalg.norm(found - wanted) / np.linalg.norm(wanted)),
        }


def hertz() -> HertzContact:
    """Of the smooth parabola on a half-plane."""
    modulus = MATERIAL.plane_strain_modulus
    return hertz_from_peak_pressure(0.5 * SLOPE * modulus, RADIUS, modulus)


def cylinder() -> BlockCase:
    """Hertz's contact."""
    return case_of("cylinder", np.zeros((0, 3)), (5, 10, 20, 40, 80, 160))


def waves() -> BlockCase:
    """A sinusoid on the parabola: five asperities touch, each over a part of it."""
    length = 0.5
    amplitude = 2.0 * SLOPE * length / (2.0 * np.pi)
    return case_of("waves", np.array([[amplitude, length, 0.0]]), (10, 20, 40, 80, 160))


def rough() -> BlockCase:
    """Self-affine roughness on the parabola, Hurst exponent 0.8, waves from 4 a down to a / 10."""
    number = np.arange(1, 41)
    length = 4.0 / number
    amplitude = number ** (-0.5 - 0.8)
    slope = np.sqrt(0.5 * np.sum((2.0 * np.pi * amplitude / length) ** 2))
    phase = np.random.default_rng(1).uniform(0.0, 2.0 * np.pi, len(number))
    rows = np.column_stack([2.0 * SLOPE / slope * amplitude, length, phase])
    return case_of("rough", rows, (10, 20, 40, 80, 160))


def case_of(
    title: str, waves: np.ndarray, edges: tuple[int, ...], finest: int = FINEST
) -> BlockCase:
    """The case of these waves, its reference solved on `finest` edges to a."""
    load = Constraints(load=hertz().load_per_length)
    grid = HatGrid.within(-LARGEST, LARGEST, 1.0 / finest)
    predicted = solve_contact(
        HalfPlane(grid.count, grid.pitch, MATERIAL.plane_strain_modulus),
        grid.hat_integrals(lambda x: gap(x, waves)),
        grid.weights,
        load,
    )
    reach = MARGIN * float(np.abs(grid.x[predicted.pressure > 0.0]).max())
    task = BlockTask(_mesh(reach, finest, FINEST_GROWTH), waves, 0.0)
    answer, approach = _contact(task, FINEST_DEGREE, FINEST_HATS, load)
    return BlockCase(title, waves, edges, task.ends[1], approach, answer)


def _mesh(reach: float, edges: int, growth: float) -> BlockMesh:
    size = 1.0 / edges
    end = size * np.ceil(reach / size - 1e-9)
    return build_block(BlockSpec(BLOCK, BLOCK, np.array([[-end, end]]), size, growth))


def crosscheck() -> list[BlockCode]:
    """This project's finite elements, with the half-plane as the model of the outer iteration."""
    return [
        BlockCode("crosscheck", "P2, a hat an edge", partial(solved, 2, 1)),
        BlockCode("crosscheck", "P2, two hats an edge", partial(solved, 2, 2)),
        BlockCode("crosscheck", "P3, two hats an edge", partial(solved, 3, 2)),
    ]


def solved(degree: int, hats: int, task: BlockTask) -> BlockAnswer:
    return _contact(task, degree, hats, Constraints(approach=task.approach))[0]


def _contact(
    task: BlockTask, degree: int, hats: int, constraints: Constraints
) -> tuple[BlockAnswer, float]:
    """Pressures at the nodes of the hats and at their outer feet, and the approach [m]."""
    body = elastic_body(task.mesh, MATERIAL, Support("bonded", "fixed"), degree=degree)
    grid = HatGrid.within(*task.ends, task.mesh.spec.surface_size / hats)
    feet = np.arange(grid.first - 1, grid.last + 2) * grid.pitch
    solution = solve_with_model(
        FiniteElementCompliance(body, feet),
        HalfPlane(grid.count, grid.pitch, MATERIAL.plane_strain_modulus),
        grid.hat_integrals(task.gap),
        grid.weights,
        constraints,
    )
    if not solution.converged:
        raise FailedError(f"not converged: {solution.residuals}")
    pressure, steps = np.pad(solution.pressure, 1), solution.iterations["steps"]
    return BlockAnswer(feet, pressure, body.unknowns, steps), solution.approach
