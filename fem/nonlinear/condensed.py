"""What stays elastic in a contact with flow, condensed onto the hats: exact, and dense.

Nomenclature: C compliance [m^2/Pa] of hat pressures p [Pa], w integrals of the hats [m]."""

from collections.abc import Callable

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.sparse import csr_matrix, eye, kron

from fem.body.triangle import reference_nodes, shapes
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import CONTACT, HatStates
from fem.contact.system import BodyTerms, ContactSystem, conjugate_residuals
from fem.contact.terms import ContactTerms, LinearContact
from fem.solver.mumps import FemError

MOST_EXCHANGES = 100  # of hats that touch and hats that do not
ROOM = 64  # columns by which the space for them grows
SAMPLES = 12  # columns that the shifted one is the mean of
# What an equilibrium may leave of the displacements. Where exchanges follow less accurate ones,
# to 3e-3 of what the last one has left, those of 5700 hats do not end.
SOLVED = 1e-12
MOST_RESIDUALS = 200  # before an equilibrium is solved for directly
LEAST_SYMBOL = 1e-9  # of the largest one: a compliance may be singular


class Condensed:
    """C (count, count) [m^2/Pa] of which only the columns of hats under pressure are formed, when
    they are first asked for: a back-substitution each, of less than half of a rough trace's hats.

    columns  gives those (count, k) of hats (k,)"""

    def __init__(self, columns: Callable[[np.ndarray], np.ndarray], count: int) -> None:
        self._form, self._known = columns, np.zeros((count, 0), order="F")
        self._place, self._hats = np.full(count, -1), np.zeros(0, dtype=int)

    def of(self, hats: np.ndarray) -> np.ndarray:
        """Columns (count, k) of hats (k,)."""
        self._have(hats)
        return self._known[:, self._place[hats]]

    def _have(self, hats: np.ndarray) -> None:
        new = hats[self._place[hats] < 0]
        if len(new) == 0:
            return
        start, stop = len(self._hats), len(self._hats) + len(new)
        if stop > self._known.shape[1]:
            more = np.empty((len(self._place), stop + ROOM), order="F")
            more[:, :start] = self._known[:, :start]
            self._known = more
        self._known[:, start:stop] = self._form(new)
        self._place[new] = np.arange(start, stop)
        self._hats = np.append(self._hats, new)

    def __matmul__(self, pressure: np.ndarray) -> np.ndarray:
        """C p (count,) [m^2]."""
        self._have(np.flatnonzero(pressure))
        return self._known[:, : len(self._hats)] @ pressure[self._hats]

    def __getitem__(self, block: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        """The block of `numpy.ix_` of rows and columns."""
        rows, hats = block
        self._have(hats.ravel())
        return self._known[rows, self._place[hats]]


class ShiftInvariant:
    """C [m^2/Pa] near that of `Condensed`: a column is that of any other hat, shifted, the mean of
    a few. It costs no back-substitution a hat, and no memory. Between hats on elements of one size
    it is right within a per cent.

    columns  as of `Condensed`
    hats     (k,) some on the refined surface"""

    def __init__(
        self, columns: Callable[[np.ndarray], np.ndarray], count: int, hats: np.ndarray
    ) -> None:
        some = np.unique(np.linspace(0, len(hats) - 1, SAMPLES).round().astype(int))
        self._count, self._kernel = count, np.zeros(2 * count - 1)  # by the distance in hats
        missing = np.ones(2 * count - 1, dtype=bool)
        for sampled in hats[some], np.array([0, count - 1]):  # from the ends what is farther off
            total, times = np.zeros(2 * count - 1), np.zeros(2 * count - 1)
            for hat, column in zip(sampled, columns(sampled).T, strict=True):
                there = slice(count - 1 - hat, 2 * count - 1 - hat)
                total[there] += column
                times[there] += 1.0
            new = missing & (times > 0.0)
            self._kernel[new], missing = total[new] / times[new], missing & ~new
        self._size = next_fast_len(2 * count - 1, real=True)
        wrapped = np.zeros(self._size)
        wrapped[np.arange(1 - count, count)] = self._kernel
        self._symbol = rfft(wrapped)
        # the kernel's even part, continued on the ring: a jump would show at every wave number
        away = np.arange(self._size)
        away = np.minimum(np.minimum(away, self._size - away), count - 1)
        ring = self._kernel[count - 1 + away] + self._kernel[count - 1 - away]
        symbol = np.abs(rfft(0.5 * ring))
        self._inverse = 1.0 / np.maximum(symbol, LEAST_SYMBOL * symbol.max())

    def __matmul__(self, pressure: np.ndarray) -> np.ndarray:
        """C p (count,) [m^2]."""
        return irfft(self._symbol * rfft(pressure, self._size), self._size)[: self._count]

    def inverse(self, moved: np.ndarray, hats: np.ndarray) -> np.ndarray:
        """Pressures (k,) under which hats (k,) are moved by about (k,) [m^2], and others little."""
        line = np.zeros(self._count)
        line[hats] = moved
        return irfft(self._inverse * rfft(line, self._size), self._size)[hats]

    def __getitem__(self, block: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        """The block of `numpy.ix_` of rows and columns."""
        rows, hats = block
        return self._kernel[rows - hats + self._count - 1]


def on_vertices(compliance: FiniteElementCompliance) -> BodyTerms:
    """An elastic body in frictionless contact whose displacements are linear in each element."""
    body = compliance.body
    _, first = np.unique(body.elements, return_index=True)
    element, place = np.divmod(first, body.elements.shape[1])
    corner, vertex = np.unique(body.elements[:, :3], return_inverse=True)
    vertex = vertex.reshape(-1, 3)[element]
    share = shapes(reference_nodes(body.degree), 1)[place]
    start = np.arange(0, vertex.size + 1, 3)
    linear = csr_matrix((share.ravel(), vertex.ravel(), start), (len(vertex), len(corner)))
    linear = kron(linear, eye(2), format="csr")
    stiffness = (linear.T @ body.stiffness() @ linear).tocsr()
    at_rest = np.zeros(body.held.shape), np.zeros(compliance.count)
    force = (linear.T @ LinearContact(compliance, 0.0).at(*at_rest).force).tocsr()
    terms = ContactTerms(np.zeros(compliance.count), force, force)
    return stiffness, terms, np.flatnonzero(~body.held[corner].ravel())


class ElasticContact:
    """Contact on a compliance C (count, count) [m^2/Pa] of both surfaces together. Equilibria of
    hats in contact are found by generalised conjugate residuals (`fem.contact.system`),
    preconditioned by its inverse on all hats."""

    def __init__(self, flexible: ShiftInvariant, weights: np.ndarray) -> None:
        self.flexible, self._weights = flexible, weights

    def __call__(self, gap: np.ndarray, load: float, start: np.ndarray) -> tuple[np.ndarray, float]:
        """Pressure (count,) [Pa] and approach [m] under a load [N/m] > 0, for a weighted gap
        (count,) [m^2], from a guessed pressure. Raises FemError where the active set cycles."""
        weights, flexible, width = self._weights, self.flexible, self._weights.mean()
        hats = HatStates(start, np.inf, load, weights)
        hats.keep_one_in_contact(gap / weights)
        one = np.flatnonzero(hats.states == CONTACT)[:1]
        stiff = width**2 / float(flexible[np.ix_(one, one)][0, 0])
        pressure, approach = np.array(start, dtype=float), 0.0
        for _ in range(MOST_EXCHANGES):
            before, on = hats.states.copy(), np.flatnonzero(hats.states == CONTACT)
            system = ContactSystem([], flexible, weights, on, stiff, loaded=True, symmetric=False)
            right = np.append(gap[on] / width, load / stiff)
            guess = np.append(pressure[on] * width / stiff, approach)
            solution = self._equilibrium(system, right, guess)
            pressure, approach = np.zeros_like(gap), float(solution[-1])
            pressure[on] = solution[:-1] * stiff / width
            opening = (gap + flexible @ pressure) / weights - approach
            opening[on] = 0.0
            hats.exchange(pressure, opening, stiff / width)
            hats.keep_one_in_contact(opening)
            if np.array_equal(before, hats.states):
                return pressure, approach
        raise FemError(f"the contact did not settle in {MOST_EXCHANGES} exchanges")

    def _equilibrium(
        self, system: ContactSystem, right: np.ndarray, guess: np.ndarray
    ) -> np.ndarray:
        """x (size,) of system x = right. Every step carries the load."""
        inverse = self._inverse(system)
        x = guess + inverse(right - system @ guess)
        image = system @ x
        left = right - image
        moved = image[:-1] - x[-1] * self._weights[system.hats] / system.width
        if not (size := float(np.linalg.norm(left))):
            return x
        accuracy = SOLVED * float(np.linalg.norm(moved)) / size
        change, _ = conjugate_residuals(system, left, inverse, accuracy, MOST_RESIDUALS)
        if change is not None:
            return x + change
        return np.linalg.solve(system.matrix().toarray(), right)

    def _inverse(self, system: ContactSystem) -> Callable[[np.ndarray], np.ndarray]:
        """Nearly solves a system."""
        hats, share = system.hats, self._weights[system.hats] / system.width
        sunk = self.flexible.inverse(share, hats)

        def solved(right: np.ndarray) -> np.ndarray:
            moved = self.flexible.inverse(right[:-1], hats)
            approach = (share @ moved - right[-1] * system.compliance) / (share @ sunk)
            return np.append((moved - approach * sunk) / system.compliance, approach)

        return solved
