"""Surface compliance of a finite-element body as an operator on hat pressures.

C = B^T K^-1 B: one load vector, one back-substitution, one weighted mean of the surface
displacement with the same hats; symmetric and positive definite by construction.
Nomenclature: p hat pressures [Pa], K stiffness, B nodal forces of unit hats (`fem.surface`).
"""

import numpy as np
from scipy.sparse import csr_matrix

from fem.elasticity import ElasticBody
from fem.surface import Direction, hat_forces, straight_down, tangent_of

# Right-hand sides that are solved at once for the dense matrix; more only costs memory.
BATCH = 32


class FiniteElementCompliance:
    """Pressures on `count` hats to weighted displacements of `body`.

    hats        (count + 2,) [m] the hats' nodes, ascending, with the feet of the outer two
    direction   None: pressure along +z. Else a function of x [m] that gives the two components
                (d_x, d_z) of the force per length of x that a unit pressure exerts: for a
                contact on a rough boundary (slope, 1) of the smooth roller, since the traction
                acts along the roller's normal
    normal      B of the pressure, (2k, count)
    tangential  B of a sliding traction towards +x, (2k, count)
    applications   back-substitutions so far

    Raises ValueError if the hats' nodes do not ascend or a hat sticks out of the body's surface.
    """

    def __init__(
        self,
        body: ElasticBody,
        hats: np.ndarray,
        direction: Direction | None = None,
    ) -> None:
        direction = straight_down if direction is None else direction
        self.body, self.hats, self.count = body, hats, len(hats) - 2
        self.normal = hat_forces(body.surface, hats, direction)
        self.tangential = hat_forces(body.surface, hats, tangent_of(direction))
        self.applications = 0

    def apply(self, pressure: np.ndarray, friction: float = 0.0) -> np.ndarray:
        """integral(phi_i u dx) (count,) [m^2], u along the direction of pressure, into the body.

        With `friction` the sliding traction friction * pressure acts too; the operator is then
        no longer symmetric.
        """
        return self.weighted(self.displacement(pressure, friction))

    def displacement(self, pressure: np.ndarray, friction: float = 0.0) -> np.ndarray:
        """Displacement (n, 2) [m] of the body's nodes under a pressure (count,) [Pa]."""
        self.applications += 1
        return self.body.solve(self.load(pressure, friction))

    def load(self, pressure: np.ndarray, friction: float = 0.0) -> np.ndarray:
        """Nodal forces (n, 2) [N/m] of a pressure (count,) [Pa] and its sliding traction."""
        force = self.normal @ pressure
        if friction:
            force = force + friction * (self.tangential @ pressure)
        load = np.zeros(self.body.nodes.shape)
        load[self.body.surface.point] = force.reshape(-1, 2)
        return load

    def weighted(self, displacement: np.ndarray) -> np.ndarray:
        """B^T u (count,) [m^2] of a displacement (n, 2) [m]."""
        return self.normal.T @ displacement[self.body.surface.point].ravel()

    def matrix(self) -> np.ndarray:
        """C dense (count, count) [m^2/Pa]: one back-substitution a hat."""
        return np.vstack(
            [
                self._columns(self.normal[:, first : first + BATCH])
                for first in range(0, self.count, BATCH)
            ]
        ).T

    def _columns(self, forces: csr_matrix) -> np.ndarray:
        """Columns of C, as rows, for a batch of load columns."""
        count = forces.shape[1]
        load = np.zeros((count, *self.body.nodes.shape))
        load[:, self.body.surface.point] = forces.T.toarray().reshape(count, -1, 2)
        self.applications += count
        moved = self.body.solve(load)[:, self.body.surface.point]
        return (self.normal.T @ moved.reshape(count, -1).T).T
