"""Which element holds a point, and where in it: many points at once.

From the element whose centre is nearest, a walk across the edge behind which the point lies;
three steps are rare on a graded mesh. Curved elements are inverted by Newton's method. Neither
a rough surface's valleys (slopes to 1.4) nor points on the boundary stop the walk too early.
"""

from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from fem.body.triangle import shapes, slopes

# A point this far outside an element, in reference coordinates, still belongs to it.
ROUNDING = 1e-9
NEWTON_STEPS = 4
WALK_STEPS = 40


class Locator:
    """Finds the elements of points: `points` (n, 2), `triangles` (m, 6), `curved` or straight."""

    def __init__(self, points: np.ndarray, triangles: np.ndarray, curved: bool) -> None:
        self.points, self.triangles, self.curved = points, triangles, curved

    @cached_property
    def _centres(self) -> cKDTree:
        return cKDTree(self.points[self.triangles[:, :3]].mean(axis=1))

    @cached_property
    def _neighbours(self) -> np.ndarray:
        """Element (m, 3) across the edge opposite to each vertex; -1 outside."""
        count = len(self.triangles)
        middle = self.triangles[:, [4, 5, 3]].ravel()
        order = np.argsort(middle, kind="stable")
        twin = np.flatnonzero(np.diff(middle[order]) == 0)
        across = np.full(3 * count, -1)
        across[order[twin]] = order[twin + 1] // 3
        across[order[twin + 1]] = order[twin] // 3
        return across.reshape(count, 3)

    def __call__(self, where: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Element (k,), -1 outside the body, and reference coordinates (k, 2) of points (k, 2)."""
        _, element = self._centres.query(where)
        at = self._reference(element, where)
        lost = np.flatnonzero(_outside(at) > ROUNDING)
        for _ in range(WALK_STEPS):
            behind = np.argmin(_barycentric(at[lost]), axis=1)
            element_next = self._neighbours[element[lost], behind]
            lost, element_next = lost[element_next >= 0], element_next[element_next >= 0]
            if len(lost) == 0:
                break
            element[lost] = element_next
            at[lost] = self._reference(element_next, where[lost])
            lost = lost[_outside(at[lost]) > ROUNDING]
        element[_outside(at) > ROUNDING] = -1
        return element, at

    def _reference(self, element: np.ndarray, where: np.ndarray) -> np.ndarray:
        """Reference coordinates (k, 2) of points (k, 2) in given elements (k,)."""
        nodes = self.points[self.triangles[element]]
        sides = np.stack([nodes[:, 1] - nodes[:, 0], nodes[:, 2] - nodes[:, 0]], axis=-1)
        at = np.linalg.solve(sides, (where - nodes[:, 0])[..., None])[..., 0]
        if not self.curved:
            return at
        for _ in range(NEWTON_STEPS):
            # Far outside an element its quadratic map may fold: keep to its neighbourhood.
            at = np.clip(at, -1.0, 2.0)
            miss = where - np.einsum("kac,ka->kc", nodes, shapes(at))
            jacobian = np.einsum("kac,kad->kcd", nodes, slopes(at))
            at = at + np.linalg.solve(jacobian, miss[..., None])[..., 0]
        return at


def _barycentric(at: np.ndarray) -> np.ndarray:
    return np.column_stack([1.0 - at[:, 0] - at[:, 1], at[:, 0], at[:, 1]])


def _outside(at: np.ndarray) -> np.ndarray:
    """How far points are outside the reference triangle, in its own coordinates."""
    return -np.minimum(_barycentric(at).min(axis=1), 0.0)
