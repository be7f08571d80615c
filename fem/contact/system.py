"""The linear systems of Newton steps on a contact, one after the other by one factor.

From step to step a body's tangent changes only where it flows, and few hats join or leave. A system
is therefore solved by the factor of a former one, which generalised conjugate residuals improve
(Eisenstat, Elman and Schultz 1983, SIAM J. Numer. Anal. 20, 345). That factor is symmetric:
friction, too, is left to them.

    [ K_t   -T          ] [ u ]   K_t   tangents of the bodies [Pa]
    [ -B'   -C     w    ] [ p ]   T, B  forces and gradients of the hats [m]
    [        w'         ] [ d ]   C     compliance of what is condensed [m^2/Pa]

Unknowns are the lengths u, p w_mean / k and d; equations are divided by k or w_mean, with a
stiffness k [Pa]. Where the approach is prescribed the last row and column are missing."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import bmat, csr_matrix

from fem.contact.terms import ContactTerms
from fem.solver.mumps import Factor, FemError

if TYPE_CHECKING:
    from fem.nonlinear.condensed import Condensed

# Steps of the residuals that a factorisation costs, of 17 000 to 56 000 unknowns.
FACTOR_WORTH = 12
MOST_STEPS = 30  # before a system gets its own factor
MOST_FRESH = 10  # of them by its own symmetric factor: beyond, the friction is in the factor, too
MOST_CHANGED = 60  # hats that may have joined or left since the factor was made


@dataclass(frozen=True)
class ContactSystem:
    """A Newton step on `hats` (k,) in contact, of all `count` hats.

    bodies     tangent (2n, 2n) [Pa], contact terms and free components of each
    flexible   C (count, count) on the hats in contact at least; None: zero
    weights    w (count,) [m]
    stiff      k [Pa]
    loaded     whether the load is prescribed
    symmetric  whether the system is"""

    bodies: Sequence[tuple[csr_matrix, ContactTerms, np.ndarray]]
    flexible: "np.ndarray | Condensed | None"
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
        columns[self.moving : self.moving + len(self.hats)] = self.between(self.hats, hats)
        if self.loaded:
            columns[-1] = self.weights[hats] / self.width
        return columns

    def of_gaps(self, hats: np.ndarray) -> csr_matrix:
        """Rows (m, size) of the gaps under any hats (m,)."""
        rows = [terms.gradient[free][:, hats].T / -self.width for _, terms, free in self.bodies]
        rows.append(csr_matrix(self.between(hats, self.hats)))
        if self.loaded:
            rows.append(csr_matrix(self.weights[hats, None] / self.width))
        return bmat([rows], format="csr")

    def between(self, hats: np.ndarray, others: np.ndarray) -> np.ndarray:
        """Of gaps under hats (m,) by pressures of others (k,)."""
        if self.flexible is None:
            return np.zeros((len(hats), len(others)))
        return self.flexible[np.ix_(hats, others)] * self.compliance


class _Bordered:
    """The factor of a system, which also solves it on other hats: by borders for those that have
    joined, and for those that have left, whose pressures are zero."""

    def __init__(self, system: ContactSystem, is_symmetric: bool) -> None:
        matrix = system.matrix()
        if is_symmetric and not system.symmetric:
            matrix = 0.5 * (matrix + matrix.T)
        self._factor, self.loaded = Factor(matrix.tocsr(), is_symmetric), system.loaded
        self._system = system
        self._columns: dict[int, np.ndarray] = {}  # M^-1 of the border of each changed hat

    def changed(self, hats: np.ndarray) -> int:
        """How many hats have joined or left to give hats (k,)."""
        return len(np.setxor1d(hats, self._system.hats))

    def inverse(self, hats: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
        """Solves the system on other hats (k,)."""
        base, moving = self._system, self._system.moving
        join, leave = np.setdiff1d(hats, base.hats), np.setdiff1d(base.hats, hats)
        _, here, there = np.intersect1d(hats, base.hats, return_indices=True)
        here, there = moving + here, moving + there
        new, left = moving + np.searchsorted(hats, join), moving + np.searchsorted(base.hats, leave)
        tail = slice(-1, None) if base.loaded else slice(0, 0)
        size = moving + len(hats) + base.loaded
        if len(join) + len(leave):
            columns, gaps = self._borders(join, leave), base.of_gaps(join)
            border = -np.vstack([gaps @ columns, columns[left]])
            border[: len(join), : len(join)] += base.between(join, join)

        def solved(right: np.ndarray) -> np.ndarray:
            known = np.zeros(base.size)
            known[:moving], known[there], known[tail] = right[:moving], right[here], right[tail]
            z = self._factor.solve(known)
            result = np.empty(size)
            if len(join) + len(leave):
                share = np.linalg.solve(border, np.append(right[new] - gaps @ z, -z[left]))
                z -= columns @ share
                result[new] = share[: len(join)]
            result[:moving], result[here], result[tail] = z[:moving], z[there], z[tail]
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

    accuracy  of a solution: what it leaves of the right side"""

    def __init__(self, accuracy: float) -> None:
        self._accuracy = accuracy
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
        self._factor = _Bordered(system, self._symmetric or system.symmetric)
        self._solutions = self._steps = 0

    def _by_factor(self, system: ContactSystem, right: np.ndarray) -> np.ndarray | None:
        """x, or None where the residuals do not fall."""
        inverse = self._factor.inverse(system.hats)
        solution, self._last = conjugate_residuals(system, right, inverse, self._accuracy)
        self._solutions, self._steps = self._solutions + 1, self._steps + self._last
        return solution

    def _is_worn(self, system: ContactSystem) -> bool:
        """Whether the last solution cost more than the mean of all since the factorisation, which
        is a part of it. The cost of a solution rises with time, so that then the mean is least."""
        if system.loaded != self._factor.loaded:
            return True
        is_slow = self._last * self._solutions > FACTOR_WORTH + self._steps
        return is_slow or self._factor.changed(system.hats) > MOST_CHANGED


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
