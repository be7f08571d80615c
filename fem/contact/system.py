"""The linear systems of Newton steps on a contact, one after the other by one factor.

From step to step a body's tangent changes only where it flows, and few hats join or leave. A system
is therefore solved by the factor of a former one, which generalised conjugate residuals improve
(Eisenstat, Elman and Schultz 1983, SIAM J. Numer. Anal. 20, 345). That factor is symmetric:
friction, too, is left to them. C is dense: in the factor a coarser body stands for what it is of,
with its own displacements, and residual steps bring C itself.

    [ K_t   -T          ] [ u ]   K_t   tangents of the bodies [Pa]
    [ -B'   -C     w    ] [ p ]   T, B  forces and gradients of the hats [m]
    [        w'         ] [ d ]   C     compliance of what is condensed [m^2/Pa]

Unknowns are the lengths u, p w_mean / k and d; equations are divided by k or w_mean, with a
stiffness k [Pa]. Where the approach is prescribed the last row and column are missing."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import bmat, csr_matrix

from fem.compliance.condensed import Condensed, ShiftInvariant
from fem.contact.terms import ContactTerms
from fem.solver.mumps import Factor, FemError

# Steps of the residuals that a factorisation costs, of 17 000 to 56 000 unknowns.
FACTOR_WORTH = 12
MOST_STEPS = 30  # before a system gets its own factor
MOST_FRESH = 10  # of them by its own symmetric factor: beyond, the friction is in the factor, too
BORDER_WORTH = 0.4  # steps that the border of a hat costs which has joined or left


# Tangent (2n, 2n) [Pa] of a body, its contact terms and free components.
BodyTerms = tuple[csr_matrix, ContactTerms, np.ndarray]


@dataclass(frozen=True)
class ContactSystem:
    """A Newton step on `hats` (k,) in contact, of all `count` hats.

    flexible   C (count, count) on the hats in contact at least; None: zero
    weights    w (count,) [m]
    stiff      k [Pa]
    loaded     whether the load is prescribed
    symmetric  whether the system is"""

    bodies: Sequence[BodyTerms]
    flexible: np.ndarray | Condensed | ShiftInvariant | None
    weights: np.ndarray
    hats: np.ndarray
    stiff: float
    loaded: bool
    symmetric: bool

    @cached_property
    def width(self) -> float:
        return float(self.weights.mean())

    @cached_property
    def moving(self) -> int:
        """Free displacement components."""
        return sum(len(free) for _, _, free in self.bodies)

    @cached_property
    def size(self) -> int:
        return self.moving + len(self.hats) + self.loaded

    @cached_property
    def compliance(self) -> float:
        """Factor on C."""
        return -self.stiff / self.width**2

    def matrix(self) -> csr_matrix:
        hats, width, size = self.hats, self.width, len(self.bodies) + 2
        rows: list[list[csr_matrix | None]] = [[None] * size for _ in range(size)]
        for place, (tangent, terms, free) in enumerate(self.bodies):
            rows[place][place] = tangent[free][:, free] / self.stiff
            rows[place][-2] = -terms.force[free][:, hats] / width
            rows[-2][place] = -terms.gradient[free][:, hats].T / width
        rows[-2][-2] = csr_matrix((len(hats), len(hats)))
        if self.flexible is not None:
            rows[-2][-2] = csr_matrix(self.flexible[np.ix_(hats, hats)] * self.compliance)
        if self.loaded:
            share = csr_matrix(self.weights[hats, None] / width)
            rows[-2][-1], rows[-1][-2], rows[-1][-1] = share, share.T, csr_matrix((1, 1))
        else:
            rows = [row[:-1] for row in rows[:-1]]
        return bmat(rows, format="csr")

    def __matmul__(self, x: np.ndarray) -> np.ndarray:
        pressure, start = np.zeros(len(self.weights)), 0
        pressure[self.hats] = x[self.moving : self.moving + len(self.hats)]
        gap = self.weights * (float(x[-1]) / self.width if self.loaded else 0.0)
        if self.flexible is not None:
            gap += self.flexible @ (pressure * self.compliance)
        result = np.zeros(self.size)
        for tangent, terms, free in self.bodies:
            whole, part = np.zeros(tangent.shape[0]), slice(start, start + len(free))
            whole[free] = x[part]
            force = tangent @ whole / self.stiff - terms.force @ (pressure / self.width)
            result[part] = force[free]
            gap -= terms.gradient.T @ (whole / self.width)
            start = part.stop
        result[self.moving : self.moving + len(self.hats)] = gap[self.hats]
        if self.loaded:
            result[-1] = self.weights @ pressure / self.width
        return result

    def of_pressures(self, hats: np.ndarray) -> np.ndarray:
        """Columns (size, m) of the pressures of any hats (m,)."""
        columns = np.zeros((self.size, len(hats)))
        forces = [terms.force[free][:, hats].toarray() for _, terms, free in self.bodies]
        columns[: self.moving] = np.vstack(forces) / -self.width
        if self.loaded:
            columns[-1] = self.weights[hats] / self.width
        return columns

    def of_gaps(self, hats: np.ndarray) -> csr_matrix:
        """Rows (m, size) of the gaps under any hats (m,)."""
        rows = [terms.gradient[free][:, hats].T / -self.width for _, terms, free in self.bodies]
        rows.append(csr_matrix((len(hats), len(self.hats))))
        if self.loaded:
            rows.append(csr_matrix(self.weights[hats, None] / self.width))
        return bmat([rows], format="csr")


class _Bordered:
    """The factor of a system, which also solves it on other hats: by borders for those that have
    joined, and for those that have left, whose pressures are zero."""

    def __init__(
        self, system: ContactSystem, opposite: Sequence[BodyTerms], is_symmetric: bool
    ) -> None:
        self._moving = system.moving
        system = replace(system, bodies=[*system.bodies, *opposite], flexible=None)
        matrix = system.matrix()
        if is_symmetric and not system.symmetric:
            matrix = 0.5 * (matrix + matrix.T)
        self._factor, self.loaded = Factor(matrix.tocsr(), is_symmetric), system.loaded
        self._system = system
        self._columns: dict[int, np.ndarray] = {}  # M^-1 of the border of each changed hat

    def missing(self, hats: np.ndarray) -> int:
        """Number of borders still to be found, of hats that joined or left to give hats (k,)."""
        changed = np.setxor1d(hats, self._system.hats)
        return sum(hat not in self._columns for hat in changed)

    def inverse(self, hats: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
        """Solves the system on other hats (k,)."""
        base, moving, outer = self._system, self._system.moving, self._moving
        join, leave = np.setdiff1d(hats, base.hats), np.setdiff1d(base.hats, hats)
        _, here, there = np.intersect1d(hats, base.hats, return_indices=True)
        here, there = outer + here, moving + there
        new, left = outer + np.searchsorted(hats, join), moving + np.searchsorted(base.hats, leave)
        tail = slice(-1, None) if base.loaded else slice(0, 0)
        size = outer + len(hats) + base.loaded
        if len(join) + len(leave):
            columns, gaps = self._borders(join, leave), base.of_gaps(join)
            border = -np.vstack([gaps @ columns, columns[left]])

        def solved(right: np.ndarray) -> np.ndarray:
            known = np.zeros(base.size)
            known[:outer], known[there], known[tail] = right[:outer], right[here], right[tail]
            z = self._factor.solve(known)
            result = np.empty(size)
            if len(join) + len(leave):
                share = np.linalg.solve(border, np.append(right[new] - gaps @ z, -z[left]))
                z -= columns @ share
                result[new] = share[: len(join)]
            result[:outer], result[here], result[tail] = z[:outer], z[there], z[tail]
            return result

        return solved

    def _borders(self, join: np.ndarray, leave: np.ndarray) -> np.ndarray:
        """M^-1 (size, m) of the borders of hats that have joined, then of those that have left."""
        base = self._system
        joined = np.array([hat for hat in join if hat not in self._columns], dtype=int)
        left = np.array([hat for hat in leave if hat not in self._columns], dtype=int)
        if len(joined) + len(left):
            ones = np.zeros((base.size, len(left)))
            ones[base.moving + np.searchsorted(base.hats, left), np.arange(len(left))] = 1.0
            borders = np.hstack([base.of_pressures(joined), ones])
            columns = self._factor.solve(borders).T
            self._columns.update(zip((*joined, *left), columns, strict=True))
        return np.column_stack([self._columns[hat] for hat in (*join, *leave)])


class ReusedFactor:
    """Solves one system after the other, and factors one where that is cheaper in the long run.

    accuracy  of a solution: what it leaves of the right side
    opposite  bodies in the factors in place of the compliance C"""

    def __init__(self, accuracy: float, opposite: Sequence[BodyTerms] = ()) -> None:
        self._accuracy, self._opposite = accuracy, opposite
        self._factor: _Bordered | None = None
        self._symmetric = True  # factors, whether or not the systems are
        self._solutions = self._steps = self._last = 0  # since the factorisation

    def solve(self, system: ContactSystem, right: np.ndarray) -> np.ndarray:
        """x (size,) of system x = right. Raises FemError where that is singular."""
        if self._factor is not None and not self._is_worn(system):
            solution = self._by_factor(system, right)
            if solution is not None:
                return solution
        self._renew(system)
        solution = self._by_factor(system, right)
        if self._symmetric and not system.symmetric and self._last > MOST_FRESH:
            self._symmetric = False
            self._renew(system)
            solution = self._by_factor(system, right)
        if solution is None:
            raise FemError(f"the system of {system.size} unknowns is singular")
        return solution

    def _renew(self, system: ContactSystem) -> None:
        self._factor = None  # before the next one is made: half the memory
        self._factor = _Bordered(system, self._opposite, self._symmetric or system.symmetric)
        self._solutions = self._steps = 0

    def _by_factor(self, system: ContactSystem, right: np.ndarray) -> np.ndarray | None:
        """x, or None where the residuals do not fall."""
        borders = BORDER_WORTH * self._factor.missing(system.hats)
        inverse = self._factor.inverse(system.hats)
        solution, steps = conjugate_residuals(system, right, inverse, self._accuracy)
        self._last = steps + borders
        self._solutions, self._steps = self._solutions + 1, self._steps + self._last
        return solution

    def _is_worn(self, system: ContactSystem) -> bool:
        """Whether the last solution cost more than the mean of all since the factorisation, which
        is a part of it. The cost of a solution rises with time, so that then the mean is least.
        Also where the borders of the next one cost more."""
        if system.loaded != self._factor.loaded:
            return True
        borders = BORDER_WORTH * self._factor.missing(system.hats)
        worst = max(self._last, borders)
        return worst * max(1, self._solutions) > FACTOR_WORTH + self._steps


def conjugate_residuals(
    matrix: ContactSystem,
    right: np.ndarray,
    inverse: Callable[[np.ndarray], np.ndarray],
    accuracy: float,
    most: int = MOST_STEPS,
) -> tuple[np.ndarray | None, int]:
    """x (n,) of matrix x = right, preconditioned by an approximate inverse, and the steps. None if
    more than `accuracy` of the right side is left after the `most` of them, or the inverse is
    singular."""
    enough = accuracy * float(np.linalg.norm(right))
    x, left = np.zeros_like(right), right.copy()
    moves: list[tuple[np.ndarray, np.ndarray]] = []  # and what they do, orthogonal and of size one
    for step in range(most + 1):
        if np.linalg.norm(left) <= enough:
            return x, step
        try:
            move = inverse(left)
        except np.linalg.LinAlgError:  # the hats that have joined depend on one another
            break
        image = matrix @ move
        for before, known in moves:
            part = known @ image
            image -= part * known
            move -= part * before
        length = np.linalg.norm(image)
        if not 0.0 < length < np.inf:
            break
        moves.append((move / length, image / length))
        part = moves[-1][1] @ left
        x += part * moves[-1][0]
        left -= part * moves[-1][1]
    return None, most
