"""Pressures in equilibrium on a fixed active set, by conjugate gradients.

With the active set fixed the contact conditions are linear, g = 0 on the free nodes and w'p = P. A
few free nodes are solved for directly; more take conjugate gradients, projected on the load
constraint (Gould, Hribar and Nocedal 2001, algorithm 2), with the search directions of
`analytic.contact.preconditioner`. Symbols as in `analytic.contact.problem`."""

from dataclasses import dataclass, replace

import numpy as np

from analytic.contact.active_set import ActiveSet, Violations
from analytic.contact.preconditioner import SearchDirections
from analytic.operators.half_plane import ModelOperator

ROUNDING = 4.0 * np.finfo(float).eps
SET_TOLERANCE = 1e-10  # sign conditions, relative to the largest pressure and displacement
# Residual of an accurate equilibrium over the displacements that it balances: leaves pressures
# right to 1e-10 of their peak.
TIGHT = 1e-12
# steps of conjugate gradients without PROGRESS in the residual, after which rounding is reached:
PATIENT, PROGRESS = 15, 0.7
IMPATIENT, ROUNDED = 2, 1e3  # once that residual is within 1000 of `tight`
PLASTIC = 10  # nodes at the hardness to each free one, from which block exchanges do not get on
BISECTIONS = 100  # to a shift of pressures right to rounding


@dataclass(frozen=True)
class Constraints:
    """Exactly one of `load` P [N/m] and `approach` d [m]; `hardness` H [Pa] caps the pressure, of
    the nodes (n,) each by its own where it is an array, in which 0 holds a node at no pressure."""

    load: float | None = None
    approach: float | None = None
    hardness: float | np.ndarray = np.inf

    def __post_init__(self) -> None:
        if (self.load is None) == (self.approach is None):
            raise ValueError("prescribe either the load or the approach")
        if self.load is not None and not (np.isfinite(self.load) and self.load > 0.0):
            raise ValueError(f"the load per length must be positive, not {self.load:g} N/m")
        if not np.max(self.hardness) > 0.0:
            raise ValueError(f"the hardness must be positive, not {np.max(self.hardness):g} Pa")

    def coarsened(self) -> "Constraints":
        """Constraints on elements twice as wide, centred on nodes 1, 3, 5, …"""
        if np.ndim(self.hardness) == 0:
            return self
        return replace(self, hardness=self.hardness[1::2])

    def carried(self, nodes: np.ndarray, weights: np.ndarray) -> float:
        """Load that the marked ones of the nodes (n,) carry at the hardness [N/m]."""
        caps = np.broadcast_to(self.hardness, weights.shape)
        return float(caps[nodes] @ weights[nodes]) if nodes.any() else 0.0


@dataclass(frozen=True)
class Equilibrium:
    """Pressures (n,) [Pa] and weighted gap g (n,) [m^2] on a fixed active set, the load carried."""

    pressure: np.ndarray
    weighted_gap: np.ndarray
    # (n,) [m^2] that counts as none: SET_TOLERANCE of the displacements' range, rounding
    overlap: np.ndarray
    accurate: bool  # whether g vanishes on the free nodes to TIGHT, or as far as rounding lets it


class EquilibriumProblem:
    """Contact on one grid as a family of linear problems, one for each active set.

    spent     counters that it adds to: exchanges, applications
    approach  d [m] of the last equilibrium, or as prescribed"""

    def __init__(
        self,
        operator: ModelOperator,
        weighted_gap: np.ndarray,
        weights: np.ndarray,
        constraints: Constraints,
        spent: dict[str, int],
    ) -> None:
        self.operator, self.weighted_gap, self.weights = operator, weighted_gap, weights
        self.constraints, self.spent = constraints, spent
        self.by_load = constraints.load is not None
        self.approach = 0.0 if self.by_load else constraints.approach
        self._rounding = ROUNDING * np.abs(weighted_gap)
        self._own_compliance: float | None = None
        self._last: tuple[np.ndarray, np.ndarray] | None = None  # pressures, Cp
        self._search: SearchDirections | None = None

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        self.spent["applications"] += 1
        return self.operator.apply(pressure)

    def can_carry(self, active: ActiveSet) -> bool:
        """Whether some pressures of the free nodes within the box make up a prescribed load."""
        if not self.by_load:
            return True
        rest = self.constraints.load - self._load_of(active.upper)
        return bool(0.0 < rest <= self._load_of(active.free))

    def short_of_free_nodes(self, active: ActiveSet) -> bool:
        """Whether too few nodes are free to balance a prescribed load."""
        upper, free = np.count_nonzero(active.upper), np.count_nonzero(active.free)
        return self.by_load and bool(upper > PLASTIC * free or not self.can_carry(active))

    def _load_of(self, nodes: np.ndarray) -> float:
        """Load that these nodes carry at the hardness [N/m]."""
        return self.constraints.carried(nodes, self.weights)

    def feasible(self, pressure: np.ndarray, free: np.ndarray) -> np.ndarray:
        """Nearest pressures in the box that carry the load: one shift of the free nodes."""
        hardness = self.constraints.hardness
        feasible = np.clip(pressure, 0.0, hardness)
        if not self.by_load:
            return feasible
        inside, weights = pressure[free], self.weights[free]
        wanted = self.constraints.load - self.weights[~free] @ feasible[~free]
        caps = hardness if np.ndim(hardness) == 0 else hardness[free]
        most = np.max(caps) if np.ndim(caps) else min(caps, wanted / weights.sum())
        low, high = -np.max(inside), most - np.min(inside)
        for _ in range(BISECTIONS):
            shift = 0.5 * (low + high)
            carried = weights @ np.minimum(np.maximum(inside + shift, 0.0), caps)
            low, high = (shift, high) if carried < wanted else (low, shift)
        feasible[free] = np.clip(inside + high, 0.0, caps)
        return feasible

    def with_a_free_node(self, active: ActiveSet) -> ActiveSet:
        """The set itself, or with one node freed where none would balance a prescribed load. Of a
        load too small, that is the node that is reached first, of one too large the last."""
        if not self.by_load or active.free.any():
            return active
        reach, movable = self.weighted_gap / self.weights, self.constraints.hardness > 0.0
        if self._load_of(active.upper) < self.constraints.load:
            node = np.argmin(np.where(active.lower & movable, reach, np.inf))
        else:
            node = np.argmax(np.where(active.upper & movable, reach, -np.inf))
        lower, upper = active.lower.copy(), active.upper.copy()
        lower[node] = upper[node] = False
        return ActiveSet(lower, upper)

    def balanced(self, state: Equilibrium) -> ActiveSet:
        """The active set of the same load on independent springs. Where nearly all that touches is
        at the hardness, exchanges by signs would only move the approach between few free nodes."""
        if self._own_compliance is None:
            one = np.zeros_like(self.weighted_gap)
            one[len(one) // 2] = 1.0
            self._own_compliance = self.apply(one)[len(one) // 2]
        free = np.full(len(self.weighted_gap), True)
        pressure = self.feasible(state.pressure - state.weighted_gap / self._own_compliance, free)
        return ActiveSet.of(pressure, self.constraints.hardness)

    def violations(self, state: Equilibrium, active: ActiveSet) -> Violations:
        """Violations of sign conditions, pressures by more than SET_TOLERANCE of the largest."""
        hardness, pressure = self.constraints.hardness, state.pressure
        slack = SET_TOLERANCE * max(pressure.max(), -pressure.min())
        tensile = active.free & (pressure < -slack)
        joining = active.lower & (state.weighted_gap < -state.overlap)
        if not np.all(np.isfinite(hardness)):  # no node is at it
            return Violations(tensile, active.upper, joining, active.upper)
        movable = hardness > 0.0
        return Violations(
            tensile=tensile,
            excessive=active.free & (pressure > hardness + slack),
            joining=joining & movable,
            softening=active.upper & movable & (state.weighted_gap > state.overlap),
        )

    def equilibrium(self, start: np.ndarray, active: ActiveSet, reduction: float) -> Equilibrium:
        """Equilibrium on the free nodes, H and 0 on the others, from `start` (n,) [Pa]. The
        residual falls to `reduction` of what it is at the start, or to TIGHT."""
        self.spent["exchanges"] += 1
        nodes = np.flatnonzero(active.free)
        pressure = np.zeros_like(start)
        np.copyto(pressure, self.constraints.hardness, where=active.upper)
        solved = self._solve(nodes, pressure)
        if solved is not None:
            pressure[nodes] = solved
            return self.as_equilibrium(pressure, self.apply(pressure), True)
        pressure[nodes] = start[nodes]
        weighted_displacement, accurate = self._iterate(nodes, pressure, reduction)
        return self.as_equilibrium(pressure, weighted_displacement, accurate)

    def as_equilibrium(
        self, pressure: np.ndarray, weighted_displacement: np.ndarray, accurate: bool
    ) -> Equilibrium:
        """The equilibrium of pressures (n,) [Pa] with their Cp (n,) [m^2] at the approach found."""
        self._last = pressure, weighted_displacement
        low, high = weighted_displacement.min(), weighted_displacement.max()
        overlap = self._rounding + (SET_TOLERANCE * (high - low) + ROUNDING * max(high, -low))
        weighted_gap = self.weighted_gap + weighted_displacement - self.approach * self.weights
        return Equilibrium(pressure, weighted_gap, overlap, accurate)

    def _solve(self, nodes: np.ndarray, pressure: np.ndarray) -> np.ndarray | None:
        """Pressures (m,) of the free nodes beside `pressure` on the others; None of too many."""
        if len(nodes) == 0:
            return np.empty(0)
        weights = self.weights[nodes]
        weighted_gap = self.weighted_gap[nodes]
        if pressure.any():
            weighted_gap = weighted_gap + self.apply(pressure)[nodes]
        solutions = self.operator.solve(nodes, np.array([weighted_gap, weights]).T)
        if solutions is None:
            return None
        from_gap, from_weights = solutions.T
        if self.by_load:
            load = self.constraints.load - self.weights @ pressure
            self.approach = float((load + weights @ from_gap) / (weights @ from_weights))
        solutions = self.approach * from_weights - from_gap
        if self.by_load:  # which a large approach has cost digits
            solutions += (load - weights @ solutions) / (weights @ from_weights) * from_weights
        return solutions

    def _iterate(
        self, nodes: np.ndarray, pressure: np.ndarray, reduction: float
    ) -> tuple[np.ndarray, bool]:
        """Balance the free nodes of `pressure` (n,); Cp (n,) [m^2], and whether accurately.
        By conjugate gradients; under a load within w'p = P, the approach as the multiplier."""
        search, weights = self.search(nodes), self.weights[nodes]
        if self.by_load:
            missing = self.constraints.load - self.weights @ pressure
            # a load that is right to rounding needs no correction, and no application
            if abs(missing) > ROUNDING * self.constraints.load:
                pressure[nodes] += missing * search.lift
        weighted_displacement = self.weighted_displacement(pressure)
        # what rounding leaves of the sum of gap and displacement cannot be lowered
        largest = np.sqrt(len(nodes)) * np.abs(weighted_displacement).max()
        floor = np.linalg.norm(self._rounding[nodes]) + ROUNDING * largest
        balanced = weighted_displacement[nodes]
        if self.by_load:
            balanced = balanced - balanced.mean()
        tight = max(TIGHT * np.linalg.norm(balanced), floor)
        total = (self.weighted_gap + weighted_displacement)[search.stretch]
        line, places = np.zeros_like(total), nodes - search.stretch.start
        iterate, direction = pressure[nodes], np.zeros(len(nodes))
        goal, slope_before, least, since_least = None, 1.0, np.inf, 0
        while since_least < (PATIENT if least > ROUNDED * tight else IMPATIENT):
            residual = total[places]
            if self.by_load:
                self.approach = float(search.lift @ residual)
            residual -= self.approach * weights
            size = np.linalg.norm(residual)
            goal = max(reduction * size, tight) if goal is None else goal
            if size <= goal:
                pressure[nodes] = iterate
                moved = self.apply(pressure) if search.cropped else total - self.weighted_gap
                return moved, bool(size <= tight)
            since_least = 0 if size < PROGRESS * least else since_least + 1
            if size < least:
                best, least = iterate.copy(), size
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
            iterate -= (slope / curvature) * direction
            image *= slope / curvature
            total -= image
        # rounding is reached; what followed the least residual drifts off
        pressure[nodes] = best
        weighted_displacement = self.apply(pressure)
        if self.by_load:
            self.approach = float(search.lift @ (self.weighted_gap + weighted_displacement)[nodes])
        return weighted_displacement, True

    def weighted_displacement(self, pressure: np.ndarray) -> np.ndarray:
        """Cp (n,) [m^2]; of the last pressures it is known."""
        if self._last is not None and np.array_equal(pressure, self._last[0]):
            return self._last[1]
        return self.apply(pressure)

    def search(self, nodes: np.ndarray) -> SearchDirections:
        """The search directions on these nodes; cached until others are asked for."""
        if self._search is None or not np.array_equal(nodes, self._search.nodes):
            weights = self.weights[nodes] if self.by_load else None
            self._search = SearchDirections(self.operator, nodes, weights)
        return self._search
