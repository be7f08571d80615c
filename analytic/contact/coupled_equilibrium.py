"""Pressures in equilibrium with given sides where the compliance is not symmetric.

As `analytic.contact.equilibrium`, but by GMRES (Saad 2003, algorithm 9.4, left preconditioning):
conjugate gradients need symmetry. The residual is the gap
turned into pressures by the approximate inverse, and so measures the error of the pressures
themselves, where the gap would hide that of a node at an edge. With the load prescribed the
search stays in w'p = P: steps are put back there along the pressures that the inverse makes of an
even displacement, which leaves of the gap what the approach cannot take up.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from analytic.contact.equilibrium import Equilibrium, EquilibriumProblem
from analytic.contact.sides import Sides

TIGHT = 1e-10  # error of accurate pressures, in the 2-norm
SPAN = 60  # directions at most; rough contacts were seen to take up to 25

_Vectors = Callable[[np.ndarray], np.ndarray]


class CoupledEquilibrium(EquilibriumProblem):
    """Contact on one grid as a family of linear problems; nothing is asked of the operator but
    that its symmetric part is positive definite."""

    def equilibrium(self, start: np.ndarray, sides: Sides, reduction: float) -> Equilibrium:
        """Equilibrium on the free nodes, H and 0 on the others, from `start` (n,) [Pa].

        The error of the pressures falls to `reduction` of what it is at the start, or to TIGHT.
        """
        rest = super().equilibrium(start, sides, reduction)
        if not self.by_load:
            return rest
        # GMRES has not applied C to its result: the approach is what that leaves on the average
        weights = self.weights[sides.free]
        left = float((weights @ rest.gap[sides.free]) / (weights @ weights))
        self.approach += left
        return replace(rest, gap=rest.gap - left * self.weights)

    def _iterate(
        self, nodes: np.ndarray, pressure: np.ndarray, reduction: float
    ) -> tuple[np.ndarray, bool]:
        """Bring the free nodes of `pressure` (n,) to rest by GMRES; Cp, and whether accurately."""
        weights, search = self.weights[nodes], self.search(nodes)
        if self.by_load:
            pressure[nodes] += (self.constraints.load - self.weights @ pressure) * search.lift
        gap = self.gap[nodes] + self.displacement(pressure)[nodes]
        if self.by_load:
            self.approach = float((weights @ gap) / (weights @ weights))

        def moved(values: np.ndarray) -> np.ndarray:
            line = np.zeros_like(pressure)
            line[nodes] = values
            return search.step(self.apply(line)[nodes])

        error = search.step(gap - self.approach * weights)
        tight = TIGHT * np.linalg.norm(pressure[nodes])
        goal = max(reduction * np.linalg.norm(error), tight)
        step, left = krylov_step(moved, error, goal)
        pressure[nodes] -= step
        return self.apply(pressure), left <= tight


def krylov_step(apply: _Vectors, target: np.ndarray, goal: float) -> tuple[np.ndarray, float]:
    """y (m,) with the least |target - A y| in the Krylov space of A, until that is `goal`; and
    what it is.

    One call of `apply` a direction, SPAN directions at most.
    """
    size = float(np.linalg.norm(target))
    if size <= goal:
        return np.zeros(len(target)), size
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
    return found, abs(float(right[-1]))
