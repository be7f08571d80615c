"""A body in `fem.contact.nonlinear`: its response, and its contact with the hats.

Nomenclature: u displacement [m] of a body's n nodes, K stiffness [Pa], p hat pressures [Pa], g the
body's part of the weighted gap [m^2], phi_i hat functions, B nodal forces of unit hats [m]
(`fem.body.surface`)."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.sparse import csr_matrix

from fem.body.elasticity import ElasticBody
from fem.compliance.operator import FiniteElementCompliance


class Response(Protocol):
    """A body's forces against displacements of its n nodes; it may depend on its history.

    held        (n, 2) whether the support holds a component
    symmetric   whether the tangent is symmetric
    softness    weights of the 2n forces that are left: of bodies that are one response, the
                smallest modulus over their own; else 1"""

    held: np.ndarray
    symmetric: bool
    softness: np.ndarray

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        """Internal nodal forces (n, 2) [N/m] and tangent (2n, 2n) [Pa] from the accepted state.
        Rows of held components are not used. Raises FemError if the body cannot deform so, for
        example if an element is inverted; the solver then tries a shorter step."""

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """The forces of `linearised` alone."""

    def accept(self, displacement: np.ndarray) -> None:
        """Add the displacement (n, 2) [m] at the end of an increment to the history."""


class LinearResponse:
    """An elastic body's linear response, K u."""

    symmetric, softness = True, np.ones(1)

    def __init__(self, body: ElasticBody) -> None:
        self.held, self._matrix = body.held, body.stiffness()

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        """K u (n, 2) [N/m] and K [Pa]."""
        return self.force(displacement), self._matrix

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """K u (n, 2) [N/m]."""
        return (self._matrix @ displacement.ravel()).reshape(-1, 2)

    def accept(self, displacement: np.ndarray) -> None:
        """No history."""


@dataclass(frozen=True)
class ContactTerms:
    """One body's part of the contact at a displacement and a pressure."""

    gap: np.ndarray  # (count,) [m^2] integral phi_i (opening) dx of this body, without the approach
    gradient: csr_matrix  # (2n, count) [m] its derivative with respect to u
    force: csr_matrix  # (2n, count) [m] nodal forces of unit hats; `gradient` without friction
    stiffness: csr_matrix | None = None  # (2n, 2n) [Pa] derivative of force @ pressure; None: zero


class Contact(Protocol):
    """A body's contact with the grid of hats. `frictionless`: force and gradient are the same."""

    frictionless: bool

    def at(self, displacement: np.ndarray, pressure: np.ndarray) -> ContactTerms:
        """Terms at a displacement (n, 2) [m] and a pressure (count,) [Pa]."""

    def loaded(
        self, displacement: np.ndarray, pressure: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """The gap (count,) [m^2] and the nodal forces (2n,) [N/m] of `at` alone."""


class LinearContact:
    """Contact on the undeformed surface: gap B'u, forces B p + friction T p. B and T are the
    `normal` and `tangential` forces of the compliance's hats."""

    def __init__(self, compliance: FiniteElementCompliance, friction: float = 0.0) -> None:
        self.frictionless = not friction
        self._gradient = self._force = on_all_nodes(compliance.body, compliance.normal)
        if friction:
            tangential = on_all_nodes(compliance.body, compliance.tangential)
            self._force = self._gradient + friction * tangential

    def at(self, displacement: np.ndarray, pressure: np.ndarray) -> ContactTerms:
        """Terms as of `Contact`; only the gap depends on the displacement."""
        gap = self._gradient.T @ displacement.ravel()
        return ContactTerms(gap, self._gradient, self._force)

    def loaded(
        self, displacement: np.ndarray, pressure: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """See `Contact`."""
        return self._gradient.T @ displacement.ravel(), self._force @ pressure


def on_all_nodes(body: ElasticBody, forces: csr_matrix) -> csr_matrix:
    """Rows of all 2n components from those (2k, m) of the surface's nodes."""
    component = (2 * body.surface.point[:, None] + np.arange(2)).ravel()
    place = (component, np.arange(component.size))
    return csr_matrix((np.ones(component.size), place), (body.unknowns, component.size)) @ forces
