"""What stays elastic in a contact with flow, condensed onto the hats: exact, and dense.

Nomenclature: C compliance [m^2/Pa] of hat pressures p [Pa], w integrals of the hats [m]."""

from collections.abc import Callable

import numpy as np

from fem.contact.nonlinear import CONTACT, HatStates
from fem.solver.mumps import FemError

MOST_EXCHANGES = 100  # of hats that touch and hats that do not
ROOM = 64  # columns by which the space for them grows


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


class ElasticContact:
    """Contact on a compliance C (count, count) [m^2/Pa] of both surfaces together."""

    def __init__(self, flexible: np.ndarray | Condensed, weights: np.ndarray) -> None:
        self.flexible, self._weights = flexible, weights

    def __call__(self, gap: np.ndarray, load: float, start: np.ndarray) -> tuple[np.ndarray, float]:
        """Pressure (count,) [Pa] and approach [m] under a load [N/m] > 0, for a weighted gap
        (count,) [m^2], from a guessed pressure. Raises FemError where the active set cycles."""
        weights, flexible = self._weights, self.flexible
        hats = HatStates(start, np.inf, load, weights)
        hats.keep_one_in_contact(gap / weights)
        one = np.flatnonzero(hats.states == CONTACT)[:1]
        stiff = weights.mean() / float(flexible[np.ix_(one, one)][0, 0])
        for _ in range(MOST_EXCHANGES):
            before, on = hats.states.copy(), np.flatnonzero(hats.states == CONTACT)
            system = np.zeros((len(on) + 1, len(on) + 1))
            system[:-1, :-1] = flexible[np.ix_(on, on)] * stiff
            system[:-1, -1], system[-1, :-1] = -weights[on], weights[on]
            solution = np.linalg.solve(system, np.append(-stiff * gap[on], load))
            pressure, approach = np.zeros_like(gap), float(solution[-1]) / stiff
            pressure[on] = solution[:-1]
            opening = (gap + flexible @ pressure) / weights - approach
            opening[on] = 0.0
            hats.exchange(pressure, opening, stiff)
            hats.keep_one_in_contact(opening)
            if np.array_equal(before, hats.states):
                return pressure, approach
        raise FemError(f"the contact did not settle in {MOST_EXCHANGES} exchanges")
