"""Pressures in equilibrium with given sides: which nodes are free, at zero, at the hardness.

With the sides fixed the contact conditions are linear, g = 0 on the free nodes and w'p = P. A few
free nodes are solved for directly. More of them take conjugate gradients, projected on the load
constraint (Gould, Hribar and Nocedal 2001, algorithm 2) and preconditioned by the approximate
inverse over the whole grid of displacements continued from the free nodes
(`analytic.extension`). Symbols as in `analytic.contact`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from analytic.extension import Extension

ROUNDING = 4.0 * np.finfo(float).eps
SET_TOLERANCE = 1e-10  # sign conditions, relative to the largest pressure and displacement
TIGHT = 1e-11  # residual of an accurate equilibrium, over the displacements it balances
STALLED = 40  # steps of conjugate gradients without a new least residual: rounding is reached
PLASTIC = 10  # nodes at the hardness to each free one, from which these alone do not lead on
BISECTIONS = 100  # to a shift of pressures right to rounding

_Inverse = Callable[[np.ndarray], np.ndarray]


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
        return int(np.count_nonzero(self.tensile | self.excessive | self.joining | self.softening))


@dataclass(frozen=True)
class Sides:
    """Which nodes are held at p = 0 (`lower`) and at p = H (`upper`); the others are free."""

    lower: np.ndarray
    upper: np.ndarray

    @classmethod
    def of(cls, pressure: np.ndarray, hardness: float) -> "Sides":
        return cls(pressure <= 0.0, pressure >= hardness)

    @cached_property
    def free(self) -> np.ndarray:
        return ~(self.lower | self.upper)

    def edges(self) -> int:
        """Places where the free nodes begin or end."""
        return int(np.count_nonzero(self.free[1:] != self.free[:-1]))

    def mostly_upper(self) -> bool:
        """Whether PLASTIC times as many nodes are at the hardness as are free."""
        return bool(np.count_nonzero(self.upper) > PLASTIC * np.count_nonzero(self.free))

    def exchanged(self, broken: Broken) -> "Sides":
        return Sides(
            (self.lower & ~broken.joining) | broken.tensile,
            (self.upper & ~broken.softening) | broken.excessive,
        )


@dataclass(frozen=True)
class Equilibrium:
    """Pressures (n,) [Pa] and weighted gap g (n,) [m^2] with given sides, the load carried.

    overlap   (n,) [m^2] that counts as none: SET_TOLERANCE of the displacements' range, rounding
    accurate  whether g vanishes on the free nodes to TIGHT, or as far as rounding lets it
    """

    pressure: np.ndarray
    gap: np.ndarray
    overlap: np.ndarray
    accurate: bool


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
        self._rounding = ROUNDING * np.abs(gap)
        self._own_compliance: float | None = None

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        self.spent["applications"] += 1
        return self.operator.apply(pressure)

    def can_carry(self, sides: Sides) -> bool:
        """Whether some pressures of the free nodes within the box make up a prescribed load."""
        if not self.by_load:
            return True
        rest = self.constraints.load - self._load_of(sides.upper)
        return bool(0.0 < rest <= self._load_of(sides.free))

    def _load_of(self, nodes: np.ndarray) -> float:
        """What these nodes carry at the hardness [N/m]."""
        return self.constraints.hardness * self.weights[nodes].sum() if nodes.any() else 0.0

    def feasible(self, pressure: np.ndarray, free: np.ndarray) -> np.ndarray:
        """Nearest pressures in the box that carry the load: one shift of the free nodes."""
        hardness = self.constraints.hardness
        feasible = np.clip(pressure, 0.0, hardness)
        if not self.by_load:
            return feasible
        inside, weights = pressure[free], self.weights[free]
        wanted = self.constraints.load - self.weights[~free] @ feasible[~free]
        mean = wanted / weights.sum()
        low, high = -np.max(inside), min(hardness, mean) - np.min(inside)
        for _ in range(BISECTIONS):
            shift = 0.5 * (low + high)
            carried = weights @ np.clip(inside + shift, 0.0, hardness)
            low, high = (shift, high) if carried < wanted else (low, shift)
        feasible[free] = np.clip(inside + high, 0.0, hardness)
        return feasible

    def with_a_free_node(self, sides: Sides) -> Sides:
        """The sides, but for one node freed where a prescribed load would find none to balance it.

        The sides' own load then lacks something, and the node is the one that is reached first, or
        it is too much, and the node is the one that is reached last.
        """
        if not self.by_load or sides.free.any():
            return sides
        reach = self.gap / self.weights
        if self._load_of(sides.upper) < self.constraints.load:
            node = np.argmin(np.where(sides.lower, reach, np.inf))
        else:
            node = np.argmax(np.where(sides.upper, reach, -np.inf))
        lower, upper = sides.lower.copy(), sides.upper.copy()
        lower[node] = upper[node] = False
        return Sides(lower, upper)

    def balanced(self, rest: Equilibrium) -> Sides:
        """Sides that carry the prescribed load while each node sinks for itself.

        Where nearly all that touches is at the hardness, few free nodes bear what is missing of
        the load, and exchanges by their signs move the approach from node to node.
        """
        if self._own_compliance is None:
            one = np.zeros_like(self.gap)
            one[len(one) // 2] = 1.0
            self._own_compliance = self.apply(one)[len(one) // 2]
        free = np.full(len(self.gap), True)
        pressure = self.feasible(rest.pressure - rest.gap / self._own_compliance, free)
        return Sides.of(pressure, self.constraints.hardness)

    def broken_signs(self, rest: Equilibrium, sides: Sides) -> Broken:
        """Sign conditions of the module's head, pressures to SET_TOLERANCE of the largest."""
        hardness, pressure = self.constraints.hardness, rest.pressure
        slack = SET_TOLERANCE * max(pressure.max(), -pressure.min())
        tensile, joining = (
            sides.free & (pressure < -slack),
            sides.lower & (rest.gap < -rest.overlap),
        )
        if not np.isfinite(hardness):
            return Broken(tensile, sides.upper, joining, sides.upper)  # none is at the hardness
        return Broken(
            tensile=tensile,
            excessive=sides.free & (pressure > hardness + slack),
            joining=joining,
            softening=sides.upper & (rest.gap > rest.overlap),
        )

    def equilibrium(self, start: np.ndarray, sides: Sides, reduction: float) -> Equilibrium:
        """Equilibrium on the free nodes, H and 0 on the others, from `start` (n,) [Pa].

        The residual falls to `reduction` of what it is at the start, or to TIGHT.
        """
        self.spent["exchanges"] += 1
        nodes = np.flatnonzero(sides.free)
        pressure = np.zeros_like(start)
        pressure[sides.upper] = self.constraints.hardness
        found = self._solve(nodes, pressure)
        pressure[nodes] = start[nodes] if found is None else found
        accurate = found is not None or self._iterate(nodes, pressure, reduction)
        return self.at_rest(pressure, self.apply(pressure), accurate)

    def at_rest(
        self, pressure: np.ndarray, displacement: np.ndarray, accurate: bool
    ) -> Equilibrium:
        """The equilibrium of pressures (n,) [Pa] with their Cp (n,) [m^2] at the approach found."""
        low, high = displacement.min(), displacement.max()
        overlap = self._rounding + (SET_TOLERANCE * (high - low) + ROUNDING * max(high, -low))
        gap = self.gap + displacement - self.approach * self.weights
        return Equilibrium(pressure, gap, overlap, accurate)

    def _solve(self, nodes: np.ndarray, pressure: np.ndarray) -> np.ndarray | None:
        """Pressures (m,) of the free nodes beside `pressure` on the others; None of too many."""
        if len(nodes) == 0:
            return np.empty(0)
        weights = self.weights[nodes]
        gap = self.gap[nodes]
        if pressure.any():
            gap = gap + self.apply(pressure)[nodes]
        found = self.operator.solve(nodes, np.array([gap, weights]).T)
        if found is None:
            return None
        from_gap, from_weights = found.T
        if self.by_load:
            load = self.constraints.load - self.weights @ pressure
            self.approach = float((load + weights @ from_gap) / (weights @ from_weights))
        return self.approach * from_weights - from_gap

    def _iterate(self, nodes: np.ndarray, pressure: np.ndarray, reduction: float) -> bool:
        """Bring the free nodes of `pressure` (n,) to rest by conjugate gradients.

        With the load prescribed the search stays in w'p = P and the approach is the multiplier.
        """
        weights, load = self.weights[nodes], self.constraints.load
        inverse = self._inverse(nodes)
        if self.by_load:
            lift = inverse(weights)
            lift /= weights @ lift  # the pressures that carry a unit load
            pressure[nodes] += (load - self.weights @ pressure) * lift
        displacement = self.apply(pressure)
        # what rounding leaves of the sum of gap and displacement cannot be lowered
        largest = np.sqrt(len(nodes)) * np.abs(displacement).max()
        floor = np.linalg.norm(self._rounding[nodes]) + ROUNDING * largest
        displacement = displacement[nodes]
        residual = self.gap[nodes] + displacement
        if self.by_load:
            displacement = displacement - displacement.mean()
        tight = max(TIGHT * np.linalg.norm(displacement), floor)
        goal, slope_before = None, 1.0
        found, direction = pressure[nodes], np.zeros_like(residual)
        line = np.zeros_like(pressure)
        least, since_least = np.inf, 0
        while since_least < STALLED:
            if self.by_load:
                self.approach = float(lift @ residual)
            open_gap = residual - self.approach * weights
            size = np.linalg.norm(open_gap)
            goal = max(reduction * size, tight) if goal is None else goal
            if size <= goal:
                break
            least, since_least = (size, 0) if size < least else (least, since_least + 1)
            step = inverse(open_gap)
            if self.by_load:
                step -= lift * (weights @ step)
            slope = open_gap @ step
            direction *= slope / slope_before
            direction += step
            slope_before = slope
            line[nodes] = direction
            image = self.apply(line)[nodes]
            curvature = direction @ image
            if not (slope > 0.0 and curvature > 0.0):
                since_least = STALLED
                break
            found -= (slope / curvature) * direction
            residual -= (slope / curvature) * image
        pressure[nodes] = found
        return bool(size <= tight or since_least == STALLED)

    def _inverse(self, nodes: np.ndarray) -> _Inverse:
        """Approximate inverse of the compliance of the free nodes."""
        extension = Extension(nodes, self.operator.ring or len(self.gap), bool(self.operator.ring))
        return lambda values: extension.gather(self.operator.precondition(extension.extend(values)))
