"""Search directions for the pressures of some nodes: what conjugate gradients need of an operator.

The approximate inverse over the whole grid is given displacements continued from the nodes
(`analytic.contact.extension`), and a unit load is taken off what would change the load.
"""

import numpy as np

from analytic.contact.extension import extension_from
from analytic.operators.half_plane import ModelOperator


class FreeSearch:
    """The approximate inverse of the compliance of some nodes (m,), and pressures without load.

    operator  of a stretch of the line that holds the nodes
    stretch   where on the line that is; the whole of it where `cropped` is False
    lift      (m,) the pressures that carry a unit load, with `weights` (m,) given; then `step`
              stays in w'p = const
    """

    def __init__(
        self, operator: ModelOperator, nodes: np.ndarray, weights: np.ndarray | None
    ) -> None:
        shorter = operator.cropped(int(nodes[-1] - nodes[0]) + 1)
        self.nodes, self._weights = nodes, weights
        self.cropped = shorter is not None
        self.operator = shorter or operator
        count = self.operator.count
        first = min(int(nodes[0]), operator.count - count)
        self.stretch = slice(first, first + count)
        ring = self.operator.ring
        self._extension = extension_from(nodes - first, ring or count, closed=ring is not None)
        if weights is not None:
            lift = self.inverse(weights)
            self.lift = lift / (weights @ lift)

    def inverse(self, displacement: np.ndarray) -> np.ndarray:
        """Pressures (m,) under which the nodes sink by about `displacement` (m,)."""
        extended = self._extension.extend(displacement)
        return self._extension.gather(self.operator.precondition(extended))

    def step(self, residual: np.ndarray) -> np.ndarray:
        """The same less the load that they carry."""
        step = self.inverse(residual)
        if self._weights is not None:
            step -= self.lift * (self._weights @ step)
        return step
