"""Pressures in equilibrium with given sides where the compliance is not symmetric.

As `analytic.equilibrium`, but by elimination and by GMRES (Saad 2003, algorithm 9.4, left
preconditioning): Cholesky's factor and conjugate gradients need symmetry. The residual is the gap
turned into pressures by the approximate inverse, and so measures the error of the pressures
themselves, where the gap would hide that of a node at an edge. With the load prescribed the
search stays in w'p = P: steps are put back there along the pressures that the inverse makes of an
even displacement, which leaves of the gap what the approach cannot take up.
"""

from collections.abc import Callable

import numpy as np
import scipy.linalg

from analytic.equilibrium import DIRECT, Equilibrium, EquilibriumProblem, Sides

TIGHT = 1e-10  # error of accurate pressures, in the 2-norm
SPAN = 60  # directions kept before GMRES starts anew; rough contacts were seen to take up to 25
ROUNDED = 0.5  # of the error before a cycle: where more is left, it is rounding

_Vectors = Callable[[np.ndarray], np.ndarray]


class CoupledEquilibrium(EquilibriumProblem):
    """Contact on one grid as a family of linear problems; nothing is asked of the operator but
    that its symmetric part is positive definite."""

    def equilibrium(self, start: np.ndarray, sides: Sides, reduction: float) -> Equilibrium:
        """Equilibrium on the free nodes, H and 0 on the others, from `start` (n,) [Pa].

        The error of the pressures falls to `reduction` of what it is at the start, or to TIGHT.
        """
        self.spent["exchanges"] += 1
        nodes = np.flatnonzero(sides.free)
        pressure = np.zeros_like(start)
        pressure[sides.upper] = self.constraints.hardness
        if len(nodes) > DIRECT:
            pressure[nodes] = start[nodes]
            return self._iterated(nodes, pressure, reduction)
        if len(nodes) > 0:
            self._eliminate(nodes, pressure)
        gap = self.gap + self.apply(pressure) - self.approach * self.weights
        return Equilibrium(pressure, gap, True)

    def _eliminate(self, nodes: np.ndarray, pressure: np.ndarray) -> None:
        """Put the pressures of the free nodes beside those on the others; also the approach."""
        weights, gap = self.weights[nodes], self.gap[nodes]
        if pressure.any():
            gap = gap + self.apply(pressure)[nodes]
        sides = np.stack([gap, weights], axis=1)
        block = self.operator.block(nodes)
        from_gap, from_weights = scipy.linalg.solve(block, sides, check_finite=False).T
        if self.by_load:
            load = self.constraints.load - self.weights @ pressure
            self.approach = float((load + weights @ from_gap) / (weights @ from_weights))
        pressure[nodes] = self.approach * from_weights - from_gap

    def _iterated(self, nodes: np.ndarray, pressure: np.ndarray, reduction: float) -> Equilibrium:
        """Bring the free nodes of `pressure` (n,) to rest by GMRES."""
        weights, inverse = self.weights[nodes], self._inverse(nodes)
        if self.by_load:
            lift = inverse(weights)
            lift /= weights @ lift  # the pressures that carry a unit load
            pressure[nodes] += (self.constraints.load - self.weights @ pressure) * lift

        def corrected(values: np.ndarray) -> np.ndarray:
            step = inverse(values)
            return step - lift * (weights @ step) if self.by_load else step

        def moved(values: np.ndarray) -> np.ndarray:
            line = np.zeros_like(pressure)
            line[nodes] = values
            return corrected(self.apply(line)[nodes])

        goal, before = None, np.inf
        while True:
            gap = self.gap + self.apply(pressure)
            if self.by_load:
                self.approach = float((weights @ gap[nodes]) / (weights @ weights))
            gap -= self.approach * self.weights
            error = corrected(gap[nodes])
            size, tight = np.linalg.norm(error), TIGHT * np.linalg.norm(pressure[nodes])
            goal = max(reduction * size, tight) if goal is None else goal
            stalled = not size < ROUNDED * before
            if stalled or size <= 2.0 * goal:
                return Equilibrium(pressure, gap, bool(stalled or size <= 2.0 * tight))
            before = size
            pressure[nodes] -= krylov_step(moved, error, goal)


def krylov_step(apply: _Vectors, target: np.ndarray, goal: float) -> np.ndarray:
    """y (m,) with the least |target - A y| in the Krylov space of A, until that is `goal`.

    One call of `apply` a direction, SPAN directions at most.
    """
    size = np.linalg.norm(target)
    basis, columns = [target / size], []
    rotations: list[tuple[float, float]] = []
    right = [size]
    for step in range(SPAN):
        image = apply(basis[step])
        column = np.empty(step + 2)
        for k, vector in enumerate(basis):
            column[k] = vector @ image
            image = image - column[k] * vector
        column[-1] = left = np.linalg.norm(image)
        for k, (cosine, sine) in enumerate(rotations):
            one, other = column[k], column[k + 1]
            column[k], column[k + 1] = cosine * one + sine * other, cosine * other - sine * one
        radius = np.hypot(column[-2], column[-1])
        if radius == 0.0:
            break  # nothing left but round-off
        cosine, sine = column[-2] / radius, column[-1] / radius
        rotations.append((cosine, sine))
        columns.append(np.append(column[:-2], radius))
        right[-1:] = [cosine * right[-1], -sine * right[-1]]
        if abs(right[-1]) <= goal or left == 0.0:
            break
        basis.append(image / left)
    found = np.zeros(len(target))
    shares = np.zeros(len(columns))
    for k in reversed(range(len(columns))):
        later = sum(columns[j][k] * shares[j] for j in range(k + 1, len(columns)))
        shares[k] = (right[k] - later) / columns[k][k]
        found += shares[k] * basis[k]
    return found
