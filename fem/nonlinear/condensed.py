"""What stays elastic in a contact with flow, condensed onto the hats: exact, and dense.

Nomenclature: C compliance [m^2/Pa] of hat pressures p [Pa], w integrals of the hats [m]."""

import numpy as np
from scipy.sparse import csr_matrix, diags, eye, kron

from fem.contact.nonlinear import CONTACT, HatStates
from fem.contact.terms import ContactTerms
from fem.solver.mumps import FemError

MOST_HATS = 800  # for which the compliance is formed: a back-substitution each
LEAST = 1e-8  # of the largest: smaller parts of a compliance are rounding
MOST_EXCHANGES = 100  # of hats that touch and hats that do not


class CondensedRoller:
    """An elastic roller as response and contact at once: its nodes are the hats, moved by the mean
    displacement under each, v = C p / w, into the roller.

    flexible   C (count, count) [m^2/Pa]; its friction makes it unsymmetric
    symmetric  as that"""

    frictionless, softness = True, np.ones(1)

    def __init__(self, flexible: np.ndarray, weights: np.ndarray, symmetric: bool) -> None:
        self._flexible, self._weights, self.symmetric = flexible, weights, symmetric
        if symmetric:
            size, right = np.linalg.eigh(flexible)
            left = right
        else:
            left, size, right = np.linalg.svd(flexible)
            right = right.T
        # where contact is not expected, hats stand closer than the mesh's nodes: C is singular
        size = np.maximum(size, LEAST * size.max())
        stiff = weights[:, None] * ((right / size) @ left.T) * weights
        self.held = np.broadcast_to([False, True], (len(weights), 2))
        held = kron(np.abs(stiff).max() * eye(len(weights)), np.diag([0.0, 1.0]))
        self._stiffness = (kron(stiff, np.diag([1.0, 0.0])) + held).tocsr()
        self._gradient = kron(diags(weights), [[1.0], [0.0]], format="csr")

    def moved(self, pressure: np.ndarray) -> np.ndarray:
        """v and zeros (count, 2) [m] under a pressure (count,) [Pa]."""
        v = self._flexible @ pressure / self._weights
        return np.column_stack([v, np.zeros_like(v)])

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        """As of `fem.contact.terms.Response`."""
        return self.force(displacement), self._stiffness

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """The forces (count, 2) [N/m] alone."""
        return (self._stiffness @ displacement.ravel()).reshape(-1, 2)

    def accept(self, displacement: np.ndarray) -> None:
        """No history."""

    def at(self, displacement: np.ndarray, pressure: np.ndarray) -> ContactTerms:
        """As of `fem.contact.terms.Contact`."""
        gap = self._gradient.T @ displacement.ravel()
        return ContactTerms(gap, self._gradient, self._gradient)


class ElasticContact:
    """Contact on a compliance C (count, count) [m^2/Pa] of both surfaces together."""

    def __init__(self, flexible: np.ndarray, weights: np.ndarray) -> None:
        self._flexible, self._weights = flexible, weights

    def __call__(self, gap: np.ndarray, load: float, start: np.ndarray) -> tuple[np.ndarray, float]:
        """Pressure (count,) [Pa] and approach [m] under a load [N/m] > 0, for a weighted gap
        (count,) [m^2], from a guessed pressure. Raises FemError where the active set cycles."""
        weights, flexible = self._weights, self._flexible
        stiff = weights.mean() / flexible.diagonal().mean()
        hats = HatStates(start, np.inf, load, weights)
        hats.keep_one_in_contact(gap / weights)
        for _ in range(MOST_EXCHANGES):
            before, on = hats.states.copy(), np.flatnonzero(hats.states == CONTACT)
            system = np.zeros((len(on) + 1, len(on) + 1))
            system[:-1, :-1] = flexible[np.ix_(on, on)] * stiff
            system[:-1, -1], system[-1, :-1] = -weights[on], weights[on]
            found = np.linalg.solve(system, np.append(-stiff * gap[on], load))
            pressure, approach = np.zeros_like(gap), float(found[-1]) / stiff
            pressure[on] = found[:-1]
            opening = (gap + flexible @ pressure) / weights - approach
            opening[on] = 0.0
            hats.exchange(pressure, opening, stiff)
            hats.keep_one_in_contact(opening)
            if np.array_equal(before, hats.states):
                return pressure, approach
        raise FemError(f"the contact did not settle in {MOST_EXCHANGES} exchanges")
