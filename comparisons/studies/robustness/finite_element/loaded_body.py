"""Small finite-element bodies, shared by the cases, and contacts on them."""

from functools import lru_cache

import numpy as np

from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from comparisons.studies.checks import BoundedFigure, Findings
from comparisons.studies.robustness.loaded_contact import iterations, residual_figures
from fem.body.elasticity import ElasticBody
from fem.body.support import Support
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block
from meshes.real_shape import roughen

MOST_STEPS = 20  # of the outer iteration; the ordinary contact takes ORDINARY_STEPS
MOST_COUPLED_STEPS = 40
ORDINARY_STEPS = 4
MESHES = 4  # in the cache
BONDED = Support("bonded", "fixed")
GRID = HatGrid(0.1, -14, 14)


@lru_cache(MESHES)
def flat_mesh(
    half_width: float,
    depth: float,
    reach: float,
    edge: float,
    growth: float = 0.3,
    interface: float | None = None,
) -> BlockMesh:
    """A block [m] refined on |x| <= reach."""
    intervals = np.array([[-reach, reach]])
    return build_block(BlockSpec(half_width, depth, intervals, edge, growth, interface=interface))


def rough_mesh(slope: float) -> BlockMesh:
    """A block whose top is a sinusoid of this rms slope, which fades beyond the refined range."""

    def height(x: np.ndarray) -> np.ndarray:
        fading = np.exp(-((x / 2.0) ** 8))
        return fading * slope * np.sqrt(2.0) / np.pi * np.cos(np.pi * x)

    return roughen(flat_mesh(8.0, 8.0, 3.0, 0.05), height)


def compliance_of(body: ElasticBody, grid: HatGrid = GRID) -> FiniteElementCompliance:
    return FiniteElementCompliance(body, grid.pitch * np.arange(grid.first - 1, grid.last + 2))


def finite_element_findings(
    solution: ContactSolution,
    *figures: BoundedFigure,
    condition: float | None = None,
    most: int = MOST_STEPS,
    ordinary: int = ORDINARY_STEPS,
) -> Findings:
    """The figures, the contact conditions, and steps of the outer iteration, `most` at most."""
    steps = float(solution.iterations["steps"])
    limit = BoundedFigure("steps", steps, float(most), "the most of an outer iteration")
    cost = iterations(solution, steps / ordinary)
    return Findings((*figures, *residual_figures(solution), limit), condition, cost)
