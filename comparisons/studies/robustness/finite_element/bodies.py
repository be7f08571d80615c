"""Finite-element bodies for the stiff and extreme cases: small, shared, and a contact on them."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from analytic.contact.defect_correction import solve_with_coupled_model, solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.operators.half_plane import ComplianceOperator, ModelOperator
from comparisons.studies.robustness.pressing import residual_figures
from comparisons.studies.robustness.row import Figure, Findings
from fem.body.elasticity import ElasticBody
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block

MOST_STEPS = 20  # of the outer iteration; the ordinary contact takes 4
MOST_COUPLED_STEPS = 40
KEPT = 4  # meshes


@lru_cache(KEPT)
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


def compliance_of(body: ElasticBody, grid: HatGrid) -> FiniteElementCompliance:
    """Of the hats of a grid."""
    return FiniteElementCompliance(body, grid.pitch * np.arange(grid.first - 1, grid.last + 2))


@dataclass(frozen=True)
class FinitePressed:
    """A contact on finite elements."""

    grid: HatGrid
    solution: ContactSolution

    @property
    def pressure(self) -> np.ndarray:
        return self.solution.pressure

    @property
    def contact_length(self) -> float:
        """Sum of the patches [m]."""
        patches = contact_patches(self.grid.x, self.solution.pressure, self.solution.gap)
        return float(np.ptp(patches, axis=1).sum())


def press_finite(
    operator: ComplianceOperator,
    model: ModelOperator,
    grid: HatGrid,
    gap: np.ndarray,
    constraints: Constraints,
) -> FinitePressed:
    """Press a weighted gap (n,) [m^2] on an operator by way of its model."""
    coupled = hasattr(model, "skew")
    solve = solve_with_coupled_model if coupled else solve_with_model
    return FinitePressed(grid, solve(operator, model, gap, grid.weights, constraints))


def held_finite(
    pressed: FinitePressed,
    *figures: Figure,
    condition: float | None = None,
    most: int = MOST_STEPS,
    usual: int = 4,
) -> Findings:
    """Findings with the contact conditions and the steps of the outer iteration.

    usual  steps of the ordinary contact
    """
    kept, checks = residual_figures(pressed.solution)
    steps = float(pressed.solution.iterations["steps"])
    cost = {
        **{name: float(number) for name, number in pressed.solution.iterations.items()},
        "times_the_ordinary": steps / usual,
    }
    limit = Figure("steps", steps, float(most), "the most an outer iteration may take")
    return Findings((*figures, *kept, limit), checks, condition, cost)
