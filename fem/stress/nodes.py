"""Where stresses are held: at the mesh's points, twice where two materials meet.

Across the interface of a coating the stress along it jumps: its points have one stress on each
side. A body of one material has one at each mesh point, in the mesh's own order.
"""

from dataclasses import dataclass

import numpy as np

from analytic.stress_state import StressState
from fem.body.elasticity import ElasticBody


@dataclass(frozen=True)
class StressNodes:
    """point (k,) the mesh point of each node, triangles (m, 6) nodes of each triangle."""

    point: np.ndarray
    triangles: np.ndarray

    def at_surface(self, point: np.ndarray) -> np.ndarray:
        """Nodes at mesh points (q,) of the surface, which belong to one material only."""
        node = np.empty(self.point.max() + 1, dtype=np.int64)
        node[self.point] = np.arange(len(self.point))
        return node[point]


@dataclass(frozen=True)
class MaterialStress(StressState):
    """Stresses [Pa] with Poisson's ratio of the material at each point."""

    poissons_ratio: np.ndarray


def stress_nodes(body: ElasticBody) -> StressNodes:
    """The body's points first, then the coating's; those of a plain body are the mesh's points."""
    if not body.coated.any():
        return StressNodes(np.arange(len(body.points)), body.mesh.triangles)
    count = len(body.points)
    key, node = np.unique(body.mesh.triangles + count * body.coated[:, None], return_inverse=True)
    return StressNodes(key % count, node.reshape(body.mesh.triangles.shape))
