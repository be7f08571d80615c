"""Surface compliance of a finite-element body as an operator on hat pressures.

C = B^T K^-1 B is symmetric and positive definite; each application takes one back-substitution.
Nomenclature: p hat pressures [Pa], K stiffness [Pa], B nodal forces of unit hats [m]
(`fem.body.surface`)."""

from functools import cached_property

import numpy as np
from scipy.sparse import csr_matrix

from fem.body.elasticity import ElasticBody
from fem.body.surface import hat_forces, straight_down, tangent_of

# Right-hand sides that are solved at once for the dense matrix; more only cost memory.
BATCH = 32


class FiniteElementCompliance:
    """Maps pressures on `count` hats to weighted displacements of `body`.

    hats        (count + 2,) [m] the hats' nodes, ascending, with the outer feet; on a body with
                tied sides (count + 1,) from one side to the other, the last the first
    normal      B of the pressure, (2k, count)
    tangential  B of a sliding traction towards +x, (2k, count)

    Raises ValueError if the hats' nodes do not ascend or a hat sticks out of the body's surface."""

    def __init__(self, body: ElasticBody, hats: np.ndarray) -> None:
        self._periodic = body.ties is not None
        self.body, self.hats = body, hats
        self.count = len(hats) - (1 if self._periodic else 2)
        self.normal = hat_forces(body.surface, hats, periodic=self._periodic)
        self._means = self.normal.T.tocsr()  # faster than a transposed view at each product
        self._latest: tuple[tuple, np.ndarray] | None = None  # asked for, and the displacement

    @cached_property
    def tangential(self) -> csr_matrix:
        along = tangent_of(straight_down)
        return hat_forces(self.body.surface, self.hats, along, self._periodic)

    def apply(self, pressure: np.ndarray, friction: float = 0.0) -> np.ndarray:
        """integral(phi_i u dx) (count,) [m^2], u into the body.
        With `friction` the traction friction * pressure acts too, and C is not symmetric."""
        return self.weighted(self.displacement(pressure, friction))

    def moved(self, pressure: np.ndarray, traction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Weighted displacements (count,) [m^2] along the pressure, into the body, and along the
        traction, under a pressure and any traction (count,) [Pa] towards +x."""
        moved = self.displacement_of(pressure, traction)[self.body.surface.point].ravel()
        return self._means @ moved, self.tangential.T @ moved

    def displacement_of(self, pressure: np.ndarray, traction: np.ndarray) -> np.ndarray:
        """`displacement` under a pressure and any traction (count,) [Pa] towards +x."""
        return self.body.solve(self._load(self.normal @ pressure + self.tangential @ traction))

    def displacement(self, pressure: np.ndarray, friction: float = 0.0) -> np.ndarray:
        """Displacement (n, 2) [m] of the body's nodes under a pressure (count,) [Pa]. The latest is
        known: what follows a contact begins with its own."""
        asked, latest = (pressure, friction), self._latest
        if latest is None or not all(map(np.array_equal, asked, latest[0])):
            self._latest = latest = asked, self.body.solve(self.load(pressure, friction))
        return latest[1]

    def load(self, pressure: np.ndarray, friction: float = 0.0) -> np.ndarray:
        """Nodal forces (n, 2) [N/m] of a pressure (count,) [Pa] and its sliding traction."""
        force = self.normal @ pressure
        return self._load(force + friction * (self.tangential @ pressure) if friction else force)

    def weighted(self, displacement: np.ndarray) -> np.ndarray:
        """B^T u (count,) [m^2] of a displacement (n, 2) [m]."""
        return self._means @ displacement[self.body.surface.point].ravel()

    def matrix(self, friction: float = 0.0) -> np.ndarray:
        """C dense (count, count) [m^2/Pa]: one back-substitution a hat."""
        return self.columns(np.arange(self.count), friction)

    def columns(self, hats: np.ndarray, friction: float = 0.0) -> np.ndarray:
        """Columns (count, k) [m^2/Pa] of C, of hats (k,)."""
        forces = self.normal + friction * self.tangential if friction else self.normal
        rows = []
        for start in range(0, len(hats), BATCH):
            force = forces[:, hats[start : start + BATCH]].toarray()
            count = force.shape[1]
            load = np.zeros((count, *self.body.nodes.shape))
            load[:, self.body.surface.point] = force.T.reshape(count, -1, 2)
            moved = self.body.solve(load)[:, self.body.surface.point].reshape(count, -1).T
            rows.append((self._means @ moved).T)
        return np.vstack(rows).T

    def _load(self, force: np.ndarray) -> np.ndarray:
        """Forces (n, 2) on all nodes from those (2k,) on the surface's."""
        load = np.zeros(self.body.nodes.shape)
        load[self.body.surface.point] = force.reshape(-1, 2)
        return load
