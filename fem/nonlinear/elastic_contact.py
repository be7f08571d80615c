"""Elastic parts of a contact with flow: a body on its vertices, and a contact on compliances.

Nomenclature: C compliance [m^2/Pa] of hat pressures p [Pa], w integrals of the hats [m]."""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_matrix, eye, kron

from fem.body.triangle import reference_nodes, shapes
from fem.compliance.condensed import ShiftInvariant
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import CONTACT, HatStates
from fem.contact.system import BodyTerms, ContactSystem, conjugate_residuals
from fem.contact.terms import ContactTerms, LinearContact
from fem.solver.mumps import FemError

MOST_EXCHANGES = 100  # of hats that touch and hats that do not
# What an equilibrium may leave of the displacements. Where exchanges follow less accurate ones,
# to 3e-3 of what the last one has left, those of 5700 hats do not end.
SOLVED = 1e-12
MOST_RESIDUALS = 200  # before an equilibrium is solved for directly


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
