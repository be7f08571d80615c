"""Pressures in equilibrium with given sides: which nodes are free, at zero, at the hardness.

With the sides fixed the contact conditions are linear, g = 0 on the free nodes and w'p = P. A few
free nodes are solved for directly. More of them take conjugate gradients, projected on the load
constraint (Gould, Hribar and Nocedal 2001, algorithm 2) and preconditioned by the approximate
inverse over the whole grid of displacements continued from the free nodes
(`analytic.contact.extension`). Symbols as in `analytic.contact.problem`.
"""

from dataclasses import dataclass

import numpy as np

from analytic.contact.search_directions import FreeSearch
from analytic.contact.sides import Broken, Sides
from analytic.operators.half_plane import ModelOperator

ROUNDING = 4.0 * np.finfo(float).eps
SET_TOLERANCE = 1e-10  # sign conditions, relative to the largest pressure and displacement
TIGHT = 1e-12  # leaves pressures right to 1e-10 of their peak
# steps of conjugate gradients without PROGRESS in the residual, after which rounding is reached:
PATIENT, PROGRESS = 15, 0.7
IMPATIENT, ROUNDED = 2, 1e3  # once that residual is within 1000 of `tight`
BISECTIONS = 100  # to a shift of pressures right to rounding


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
class Equilibrium:
    """Pressures (n,) [Pa] and weighted gap g (n,) [m^2] with given sides, the load carried.

    overlap   (n,) [m^2] that counts as none: SET_TOLERANCE of the displacements' range, rounding
    accurate  whether g vanishes on the free nodes to `tight`, or as far as rounding lets it
    """

    pressure: np.ndarray
    gap: np.ndarray
    overlap: np.ndarray
    accurate: bool


class EquilibriumProblem:
    """Contact on one grid as a family of linear problems, one for each choice of sides.

    spent     counters that it adds to: exchanges, applications
    tight     residual of an accurate equilibrium, over the displacements that it balances
    approach  d [m] of the last equilibrium, or as prescribed
    """

    def __init__(
        self,
        operator: ModelOperator,
        gap: np.ndarray,
        weights: np.ndarray,
        constraints: Constraints,
        spent: dict[str, int],
        tight: float = TIGHT,
    ) -> None:
        self.operator, self.gap, self.weights = operator, gap, weights
        self.constraints, self.spent, self.tight = constraints, spent, tight
        self.by_load = constraints.load is not None
        self.approach = 0.0 if self.by_load else constraints.approach
        self._rounding = ROUNDING * np.abs(gap)
        self._own_compliance: float | None = None
        self._applied: tuple[np.ndarray, np.ndarray] | None = None  # pressures, Cp
        self._last: tuple[np.ndarray, np.ndarray] | None = None  # pressures, Cp
        self._search: FreeSearch | None = None

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        self.spent["applications"] += 1
        return self.operator.apply(pressure)

    def applied(self, pressure: np.ndarray) -> np.ndarray:
        """Cp (n,) [m^2] by the operator itself, which a direct solution has just asked for it."""
        if self._applied is not None and np.array_equal(pressure, self._applied[0]):
            return self._applied[1]
        return self.apply(pressure)

    def can_carry(self, sides: Sides) -> bool:
        """Whether some pressures of the free nodes within the box make up a prescribed load."""
        if not self.by_load:
            return True
        rest = self.constraints.load - self._load_of(sides.upper)
        return bool(0.0 < rest <= self._load_of(sides.free))

    def short_of_free_nodes(self, sides: Sides) -> bool:
        """Whether so few nodes are free that they cannot balance a prescribed load, or hardly."""
        return self.by_load and (sides.mostly_upper() or not self.can_carry(sides))

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

        The residual falls to `reduction` of what it is at the start, or to `tight`.
        """
        self.spent["exchanges"] += 1
        nodes = np.flatnonzero(sides.free)
        pressure = np.zeros_like(start)
        pressure[sides.upper] = self.constraints.hardness
        found = self._solve(nodes, pressure)
        if found is not None:
            pressure[nodes] = found
            self._applied = pressure, self.apply(pressure)
            return self.at_rest(*self._applied, True)
        pressure[nodes] = start[nodes]
        displacement, accurate = self._iterate(nodes, pressure, reduction)
        return self.at_rest(pressure, displacement, accurate)

    def at_rest(
        self, pressure: np.ndarray, displacement: np.ndarray, accurate: bool
    ) -> Equilibrium:
        """The equilibrium of pressures (n,) [Pa] with their Cp (n,) [m^2] at the approach found."""
        self._last = pressure, displacement
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
        found = self.approach * from_weights - from_gap
        if self.by_load:  # which a large approach has cost digits
            found += (load - weights @ found) / (weights @ from_weights) * from_weights
        return found

    def _iterate(
        self, nodes: np.ndarray, pressure: np.ndarray, reduction: float
    ) -> tuple[np.ndarray, bool]:
        """Bring the free nodes of `pressure` (n,) to rest; Cp (n,) [m^2], and whether accurately.

        By conjugate gradients. With the load prescribed the search stays in w'p = P and the
        approach is the multiplier.
        """
        search, weights = self.search(nodes), self.weights[nodes]
        if self.by_load:
            missing = self.constraints.load - self.weights @ pressure
            # rounding of a load that is carried needs no correction, and no application
            if abs(missing) > ROUNDING * self.constraints.load:
                pressure[nodes] += missing * search.lift
        displacement = self.displacement(pressure)
        # what rounding leaves of the sum of gap and displacement cannot be lowered
        largest = np.sqrt(len(nodes)) * np.abs(displacement).max()
        floor = np.linalg.norm(self._rounding[nodes]) + ROUNDING * largest
        balanced = displacement[nodes]
        if self.by_load:
            balanced = balanced - balanced.mean()
        tight = max(self.tight * np.linalg.norm(balanced), floor)
        total = (self.gap + displacement)[search.stretch]
        line, places = np.zeros_like(total), nodes - search.stretch.start
        found, direction = pressure[nodes], np.zeros(len(nodes))
        goal, slope_before, least, since_least = None, 1.0, np.inf, 0
        while since_least < (PATIENT if least > ROUNDED * tight else IMPATIENT):
            residual = total[places]
            if self.by_load:
                self.approach = float(search.lift @ residual)
            residual -= self.approach * weights
            size = np.linalg.norm(residual)
            goal = max(reduction * size, tight) if goal is None else goal
            if size <= goal:
                pressure[nodes] = found
                moved = self.apply(pressure) if search.cropped else total - self.gap
                return moved, bool(size <= tight)
            since_least = 0 if size < PROGRESS * least else since_least + 1
            if size < least:
                best, least = found.copy(), size
            step = search.step(residual)
            slope = residual @ step
            direction *= slope / slope_before
            direction += step
            slope_before = slope
            line[places] = direction
            image = search.operator.apply(line)
            self.spent["applications"] += 1
            curvature = direction @ image[places]
            if not (slope > 0.0 and curvature > 0.0):
                break
            found -= (slope / curvature) * direction
            image *= slope / curvature
            total -= image
        # rounding is reached; what followed the least residual drifts off
        pressure[nodes] = best
        displacement = self.apply(pressure)
        if self.by_load:
            self.approach = float(search.lift @ (self.gap + displacement)[nodes])
        return displacement, True

    def displacement(self, pressure: np.ndarray) -> np.ndarray:
        """Cp (n,) [m^2]; of the last pressures it is known."""
        if self._last is not None and np.array_equal(pressure, self._last[0]):
            return self._last[1]
        return self.apply(pressure)

    def search(self, nodes: np.ndarray) -> FreeSearch:
        """Where to look for the pressures of these nodes; kept until others are asked for."""
        if self._search is None or not np.array_equal(nodes, self._search.nodes):
            weights = self.weights[nodes] if self.by_load else None
            self._search = FreeSearch(self.operator, nodes, weights)
        return self._search
