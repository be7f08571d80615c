"""Patches of elements around the vertices of a body, each of one material."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix, diags

from fem.body.elasticity import ElasticBody
from fem.stress.nodes import StressNodes

# Fewest elements whose samples determine a polynomial with room to spare; smaller patches take in
# the elements around their vertices.
LEAST_ELEMENTS = 5


@dataclass(frozen=True)
class Patches:
    """The elements around each vertex, and the edges between vertices.

    vertex    (v,) the stress node at the middle of each patch
    coated    (v,) whether it belongs to the coating
    start     (v + 1,) where the elements of each patch begin in `element`
    element   (p,) elements of all patches in turn
    patch     (p,) the patch that each of these belongs to
    beside    (s, 2) patch and edge of the surface, numbered along it, wherever they touch
    ends      (e, 2) patches at the ends of each edge
    middle    (e,) the stress node in the middle of each edge
    shares    (e, 2) weights of the two at the middle: an end on a side has half a patch only,
              and leaves the middle to the other end if that has a whole one
    """

    vertex: np.ndarray
    coated: np.ndarray
    start: np.ndarray
    element: np.ndarray
    beside: np.ndarray
    ends: np.ndarray
    middle: np.ndarray
    shares: np.ndarray

    @property
    def patch(self) -> np.ndarray:
        return np.repeat(np.arange(len(self.vertex)), np.diff(self.start))


def patches_of(body: ElasticBody, nodes: StressNodes) -> Patches:
    """Patches of a body whose stresses stand at `nodes`."""
    vertex = np.unique(nodes.triangles[:, :3])
    position = np.zeros(len(nodes.point), dtype=np.int64)
    position[vertex] = np.arange(len(vertex))
    corner = position[nodes.triangles[:, :3]]
    coated = np.zeros(len(vertex), dtype=bool)
    coated[corner] = body.coated[:, None]
    top = position[nodes.at_surface(body.top.point[::2])]
    edge = np.arange(len(top) - 1)
    beside = np.column_stack([np.concatenate([top[:-1], top[1:]]), np.tile(edge, 2)])
    start, element = _around(corner, len(vertex))

    middle, first = np.unique(nodes.triangles[:, 3:].ravel(), return_index=True)
    ends = corner[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)[first]
    inner = ~_outer(body, nodes)[vertex][ends]
    alike = inner[:, :1] == inner[:, 1:]
    shares = np.where(alike, 0.5, inner.astype(float))
    return Patches(vertex, coated, start, element, beside, ends, middle, shares)


def _around(corner: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Elements around each vertex, as compressed rows: starts (count + 1,) and elements."""
    element = np.repeat(np.arange(len(corner)), 3)
    touch = csr_matrix((np.ones(corner.size), (corner.ravel(), element)), (count, len(corner)))
    few = np.diff(touch.indptr) < LEAST_ELEMENTS
    around = touch[few] @ touch.T @ touch
    spread = csr_matrix(
        (np.ones(few.sum()), (np.flatnonzero(few), np.arange(few.sum()))), (count, few.sum())
    )
    patch = diags((~few).astype(float)) @ touch + spread @ around
    patch = patch.tocsr()
    patch.eliminate_zeros()
    patch.sort_indices()
    return patch.indptr, patch.indices


def _outer(body: ElasticBody, nodes: StressNodes) -> np.ndarray:
    """(k,) whether a stress node is on a side of the block."""
    sides = body.sides
    outer = np.zeros(len(body.points), dtype=bool)
    outer[np.concatenate([sides.top, sides.bottom, sides.left, sides.right])] = True
    return outer[nodes.point]
