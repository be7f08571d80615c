"""Contact on finite elements: the mutual compliance of the bodies, and the solution on it."""

from dataclasses import dataclass, replace

import numpy as np

from analytic.contact.coupled import solve_coupled
from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.operators.half_plane import DenseCompliance, ModelOperator
from comparisons.common.progress import Stages
from comparisons.models.finite_element.bodies import BodyCache, BodyPair, bodies_of
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from fem.compliance.operator import FiniteElementCompliance

MOST_DENSE = 1500  # pressure elements for which the whole compliance matrix may be formed


@dataclass(frozen=True)
class BodyShare:
    """One body's share of the mutual displacement."""

    compliance: FiniteElementCompliance
    factor: float  # of the body's compliance, where it serves for a body of another modulus too
    friction: float  # sliding traction over pressure, towards +x
    # what a traction and a pressure on it move across each other, over what they move on the rough
    # body: -1 of a roller, which is turned over and takes the opposite traction
    turn: float = 1.0


@dataclass(frozen=True)
class MutualCompliance:
    """Weighted displacements of both surfaces (n,) [m^2] under pressures (n,) [Pa], and under the
    sliding traction that they drag along where friction is `coupled`."""

    parts: tuple[BodyShare, ...]

    @property
    def rough(self) -> FiniteElementCompliance:
        return self.parts[0].compliance

    @property
    def coupled(self) -> bool:
        """Whether friction makes it unsymmetric."""
        return any(part.friction for part in self.parts)

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        return sum(p.factor * p.compliance.apply(pressure, p.friction) for p in self.parts)

    def moved(
        self, pressure: np.ndarray | None = None, traction: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Weighted displacements (n,) [m^2] of both surfaces towards each other, and of the rough
        one over the other along x, under a pressure or a traction on it (n,) [Pa]."""
        normal = tangential = 0.0
        for part in self.parts:
            zero = np.zeros(part.compliance.count)
            if traction is None:
                pressed, along = part.compliance.moved(pressure, zero)
                along = part.turn * along
            else:
                pressed, along = part.compliance.moved(zero, traction)
                pressed = part.turn * pressed
            normal, tangential = normal + part.factor * pressed, tangential + part.factor * along
        return normal, tangential

    @property
    def unlike(self) -> bool:
        """Whether pressures move the surfaces over each other."""
        return any(part.turn for part in self.parts)

    def matrix(self) -> np.ndarray:
        """Operator as a matrix (n, n) [m^2/Pa]: one back-substitution a column."""
        return sum(p.factor * p.compliance.matrix(p.friction) for p in self.parts)


def mutual_compliance(problem: Problem, bodies: BodyPair, grid: HatGrid) -> MutualCompliance:
    """Both bodies under the same hats."""
    scene, hats = problem.scene, grid.hats
    friction = scene.load.friction[0] if scene.finite_element.coupled else 0.0
    rough, share = FiniteElementCompliance(bodies.rough, hats), bodies.roller_share
    if bodies.roller is not None:
        roller = FiniteElementCompliance(bodies.roller, hats)
        return MutualCompliance(
            (BodyShare(rough, 1.0, friction), BodyShare(roller, 1.0, -friction, -1.0))
        )
    # the roller's traction is the opposite one
    turn = (1.0 - share) / (1.0 + share)
    return MutualCompliance((BodyShare(rough, 1.0 + share, friction * turn, turn),))


def compliance_again(problem: Problem, level: Level, half_block: bool = False) -> MutualCompliance:
    """The compliance of a level of linear bodies, made again; a `half_block` ends an unbounded body
    at half of its size."""
    refinement = Refinement(level.grid.pitch, half_block=half_block)
    bodies = bodies_of(problem, refinement, level.patches, Stages(), BodyCache())
    return mutual_compliance(problem, bodies, level.grid)


@dataclass(frozen=True)
class SmallStrainContact:
    """The contact of linear bodies at small strains, which any other contact of a level starts
    from. Without bodies it is that of the nearest analytic operator, which predicts theirs."""

    problem: Problem
    grid: HatGrid
    gap: np.ndarray  # (count,) [m^2] initial, weighted by each hat
    constraints: Constraints
    model: ModelOperator  # the nearest analytic operator
    solution: ContactSolution
    bodies: BodyPair | None = None
    operator: MutualCompliance | None = None

    def on(self, bodies: BodyPair, tolerance: float) -> "SmallStrainContact":
        """The contact of bodies, from this one; by their whole matrix if iteration fails to
        settle."""
        operator = mutual_compliance(self.problem, bodies, self.grid)
        weights, constraints = self.grid.weights, self.constraints
        posed = operator, self.model, self.gap, weights, constraints, self.solution.pressure
        solution = solve_with_model(*posed, tolerance)
        if not solution.converged and len(weights) <= MOST_DENSE:
            whole = DenseCompliance(operator.matrix(), operator.coupled)
            solution = solve_coupled(whole, self.gap, weights, constraints, solution.pressure)
        return replace(self, solution=solution, bodies=bodies, operator=operator)
