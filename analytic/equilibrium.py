"""Pressures in equilibrium with given sides: which nodes are free, at zero, at the hardness.

With the sides fixed the contact conditions are linear, g = 0 on the free nodes and w'p = P.
Conjugate gradients solve them, projected on the load constraint (Gould, Hribar and Nocedal 2001,
algorithm 2) and preconditioned by the operator's approximate inverse. Symbols as in
`analytic.contact`.
"""

from dataclasses import dataclass

import numpy as np

ROUNDING = 4.0 * np.finfo(float).eps
SET_TOLERANCE = 1e-10  # sign conditions, relative to the largest pressure and displacement


@dataclass(frozen=True)
class Constraints:
    """Exactly one of `load` P [N/m] and `approach` d [m]; `hardness` H [Pa] caps the pressure."""

    load: float | None = None
    approach: float | None = None
    hardness: float = np.inf

    def __post_init__(self) -> None:
        if (self.load is None) == (self.approach is None):
            raise ValueError("prescribe either the load or the approach")
        if self.load is not None and not (np.isfinite(self.load) and self.load > 0.0):
            raise ValueError(f"the load per length must be positive, not {self.load:g} N/m")
        if not self.hardness > 0.0:
            raise ValueError(f"the hardness must be positive, not {self.hardness:g} Pa")


@dataclass(frozen=True)
class Broken:
    """Nodes whose sign condition fails: tension, pressure beyond H, overlap, a gap under p = H."""

    tensile: np.ndarray
    excessive: np.ndarray
    joining: np.ndarray
    softening: np.ndarray

    def count(self) -> int:
        return sum(
            int(np.count_nonzero(nodes))
            for nodes in (self.tensile, self.excessive, self.joining, self.softening)
        )


@dataclass(frozen=True)
class Sides:
    """Which nodes are held at p = 0 (`lower`) and at p = H (`upper`); the others are free."""

    lower: np.ndarray
    upper: np.ndarray

    @classmethod
    def of(cls, pressure: np.ndarray, hardness: float) -> "Sides":
        return cls(pressure <= 0.0, pressure >= hardness)

    @property
    def free(self) -> np.ndarray:
        return ~(self.lower | self.upper)

    def exchanged(self, broken: Broken) -> "Sides":
        return Sides(
            (self.lower & ~broken.joining) | broken.tensile,
            (self.upper & ~broken.softening) | broken.excessive,
        )


class EquilibriumProblem:
    """Contact on one grid as a family of linear problems, one for each choice of sides.

    spent     counters that it adds to: exchanges, applications
    approach  d [m] of the last equilibrium, or as prescribed
    """

    def __init__(self, operator, gap, weights, constraints, spent) -> None:
        self.operator, self.gap, self.weights = operator, gap, weights
        self.constraints, self.spent = constraints, spent
        self.by_load = constraints.load is not None
        self.approach = 0.0 if self.by_load else constraints.approach

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        self.spent["applications"] += 1
        return self.operator.apply(pressure)

    def feasible(self, pressure: np.ndarray) -> np.ndarray:
        """Nearest pressures in the box that carry the load: one shift, found by bisection."""
        hardness = self.constraints.hardness
        pressure = np.clip(pressure, 0.0, hardness)
        if not self.by_load:
            return pressure
        mean = self.constraints.load / self.weights.sum()
        low, high = -np.max(pressure), mean + min(hardness, np.max(pressure) + mean)
        for _ in range(200):
            shift = 0.5 * (low + high)
            carried = self.weights @ np.clip(pressure + shift, 0.0, hardness)
            low, high = (shift, high) if carried < self.constraints.load else (low, shift)
        return np.clip(pressure + high, 0.0, hardness)

    def broken_signs(self, pressure: np.ndarray, gap: np.ndarray, sides: Sides) -> Broken:
        """Sign conditions of the module's head, to SET_TOLERANCE of the largest figures."""
        hardness = self.constraints.hardness
        slack = SET_TOLERANCE * np.max(np.abs(pressure))
        overlap = SET_TOLERANCE * np.ptp(gap)
        free = sides.free
        return Broken(
            tensile=free & (pressure < -slack),
            excessive=free & (pressure > hardness + slack),
            joining=sides.lower & (gap < -overlap),
            softening=sides.upper & (gap > overlap),
        )

    def equilibrium(
        self, start: np.ndarray, sides: Sides, tolerance: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """Pressures with g = 0 on the free nodes, H and 0 on the others, and the load; also g (n,).

        Conjugate gradients on the free nodes. With the load prescribed the search stays in
        w'p = P and the approach is the multiplier.
        """
        self.spent["exchanges"] += 1
        weights, free = self.weights, sides.free
        pressure = np.where(free, start, 0.0)
        pressure[sides.upper] = self.constraints.hardness
        if self.by_load and not free.any():
            free = np.zeros_like(free)
            free[np.argmin(np.where(sides.lower, self.gap / weights, np.inf))] = True
        residual = self.gap + self.apply(pressure)
        if not free.any():
            return pressure, residual - self.approach * weights

        def approximate_inverse(values: np.ndarray) -> np.ndarray:
            return np.where(free, self.operator.precondition(np.where(free, values, 0.0)), 0.0)

        if self.by_load:
            lift = approximate_inverse(weights)
            lift /= weights @ lift  # the pressures that carry a unit load
            correction = (self.constraints.load - weights @ pressure) * lift
            pressure += correction
            residual += self.apply(correction)
        # what rounding leaves of the sum of gap and displacement cannot be lowered
        floor = ROUNDING * (np.linalg.norm(self.gap[free]) + np.linalg.norm(residual[free]))
        goal = max(tolerance * self._displacement_norm(residual, free), floor)
        direction, slope_before = np.zeros_like(weights), 1.0
        for _ in range(10 * len(weights) + 10):
            if self.by_load:
                self.approach = lift @ residual
            masked = np.where(free, residual - self.approach * weights, 0.0)
            if np.linalg.norm(masked) <= goal:
                break
            step = approximate_inverse(masked)
            if self.by_load:
                step -= lift * (weights @ step)
            slope = masked @ step
            direction = step + (slope / slope_before) * direction
            slope_before = slope
            image = self.apply(direction)
            curvature = direction @ image
            if not (slope > 0.0 and curvature > 0.0):
                break  # nothing left but round-off
            pressure -= (slope / curvature) * direction
            residual -= (slope / curvature) * image
        return pressure, residual - self.approach * weights

    def _displacement_norm(self, residual: np.ndarray, free: np.ndarray) -> float:
        """Size of the displacements that the free nodes have to balance [m^2]."""
        balanced = (residual - self.gap)[free]
        if self.by_load:
            balanced = balanced - balanced.mean()
        return max(np.linalg.norm(balanced), np.finfo(float).tiny)
