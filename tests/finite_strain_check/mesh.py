"""Graded triangles of second order by newest-vertex bisection, mapped onto a body's true shape.

A mesh lives on a flat strip (s along the surface, d below it, d >= 0); `places` maps it to the
undeformed body. Finer meshes are bisections of coarser ones, so that displacements are carried over
exactly. Mitchell, ACM Trans. Math. Softw. 15 (1989) 326.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

Sizes = Callable[[np.ndarray], np.ndarray]
EDGES = np.array([[1, 2], [2, 0], [0, 1]])  # opposite each corner


@dataclass(frozen=True)
class Triangles:
    """Corners (n, 2) of the flat strip, in any unit; triangles (m, 3), bisected opposite their
    first corner; `parent` (m,) is the triangle of the coarser mesh that each lies in."""

    corners: np.ndarray
    triangles: np.ndarray
    parent: np.ndarray

    @cached_property
    def edges(self) -> tuple[np.ndarray, np.ndarray]:
        """Corner pairs (k, 2), and each triangle's edges (m, 3) opposite its corners."""
        pairs = np.sort(self.triangles[:, EDGES].reshape(-1, 2), axis=1)
        key, edge = np.unique(pairs[:, 0] * len(self.corners) + pairs[:, 1], return_inverse=True)
        return np.stack(np.divmod(key, len(self.corners)), axis=1), edge.reshape(-1, 3)

    @cached_property
    def nodes(self) -> np.ndarray:
        """(n + k, 2): corners, then the middles of edges."""
        return np.concatenate([self.corners, self.corners[self.edges[0]].mean(axis=1)])

    @cached_property
    def elements(self) -> np.ndarray:
        """(m, 6): corners, then the middles opposite them."""
        return np.concatenate([self.triangles, self.edges[1] + len(self.corners)], axis=1)

    @cached_property
    def surface(self) -> np.ndarray:
        """Edges on d = 0, (e, 3) nodes: left, middle, right, in the order of s."""
        pairs = self.edges[0]
        on = np.flatnonzero((self.corners[pairs, 1] == 0.0).all(axis=1))
        left_right = np.take_along_axis(
            pairs[on], np.argsort(self.corners[pairs[on], 0], axis=1), axis=1
        )
        edges = np.stack([left_right[:, 0], on + len(self.corners), left_right[:, 1]], axis=1)
        return edges[np.argsort(self.corners[edges[:, 0], 0])]


def strip(square: float, across: int, down: int) -> Triangles:
    """Squares of a side, `across` (even) by `down`, each cut into two."""
    i, j = np.meshgrid(np.arange(across + 1), np.arange(down + 1), indexing="ij")
    corners = square * np.stack([i.ravel() - across // 2, j.ravel()], axis=1).astype(float)
    at = (np.arange(across)[:, None] * (down + 1) + np.arange(down)).ravel()
    right, below = down + 1, 1
    first = np.stack([at, at + right, at + below], axis=1)
    second = np.stack([at + right + below, at + below, at + right], axis=1)
    triangles = np.concatenate([first, second])
    return Triangles(corners, triangles, np.arange(len(triangles)))


def refined(mesh: Triangles, size: Sizes) -> Triangles:
    """Bisected until the root of twice each area is at most `size` at the triangle's centre."""
    corners, triangles = mesh.corners, mesh.triangles
    parent = np.arange(len(triangles))
    while True:
        a, b, c = np.moveaxis(corners[triangles], 1, 0)
        doubled = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
        marked = np.sqrt(doubled) > 1.001 * size((a + b + c) / 3.0)
        if not marked.any():
            return Triangles(corners, triangles, parent)
        pairs, edge = Triangles(corners, triangles, parent).edges
        cut = np.zeros(len(pairs), dtype=bool)
        while marked.any():
            cut[edge[marked, 0]] = True
            marked = cut[edge].any(axis=1) & ~cut[edge[:, 0]]
        middle = np.full(len(pairs), -1)
        middle[cut] = len(corners) + np.arange(np.count_nonzero(cut))
        corners = np.concatenate([corners, corners[pairs[cut]].mean(axis=1)])
        for _ in range(2):
            new = middle[edge[:, 0]]
            split, keep = new >= 0, new < 0
            (p, q, r), m, (_, eq, er) = triangles[split].T, new[split], edge[split].T
            none = np.full(len(m), len(middle) - 1)
            halves = np.stack([m, p, q], axis=1), np.stack([m, r, p], axis=1)
            triangles = np.concatenate([triangles[keep], *halves])
            # the halves' other edges are not cut in this round: -1 looks up the appended entry
            bases = [np.stack([e, none, none], axis=1) for e in (er, eq)]
            edge = np.concatenate([edge[keep], *bases])
            parent = np.concatenate([parent[keep], parent[split], parent[split]])


def interpolated(coarse: Triangles, fine: Triangles, values: np.ndarray) -> np.ndarray:
    """Nodal values (n, k) of a mesh at the nodes of its refinement, exactly."""
    result = np.empty((len(fine.nodes), values.shape[1]))
    corners = coarse.corners[coarse.triangles[fine.parent]]
    origin = corners[:, :1]
    matrix = (corners[:, 1:] - origin).transpose(0, 2, 1)
    local = np.linalg.solve(matrix, (fine.nodes[fine.elements] - origin).transpose(0, 2, 1))
    shape = quadratic(local[:, 0], local[:, 1])
    result[fine.elements] = np.einsum("ena,eak->enk", shape, values[coarse.elements[fine.parent]])
    return result


def quadratic(r: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Shape functions (..., 6) at local points, in the order of `Triangles.elements`."""
    o = 1.0 - r - t
    parts = [o * (2 * o - 1), r * (2 * r - 1), t * (2 * t - 1), 4 * r * t, 4 * o * t, 4 * o * r]
    return np.stack(parts, axis=-1)


def quadratic_gradients(r: float, t: float) -> np.ndarray:
    """Their derivatives (6, 2) by r and t."""
    o = 1.0 - r - t
    by_r = [1 - 4 * o, 4 * r - 1, 0.0, 4 * t, -4 * t, 4 * (o - r)]
    by_t = [1 - 4 * o, 0.0, 4 * t - 1, 4 * r, 4 * (o - t), -4 * r]
    return np.array([by_r, by_t]).T
