"""Displacements known on the free nodes, continued over the rest of the grid as if at rest.

To go from displacements of a contact set to pressures, an inverse of the whole grid's compliance
needs displacements on the whole grid. Zero beyond the set makes them jump at every edge, and
conjugate gradients pay for each: their number then grows with the patches. Of all continuations
the one of least energy would give the exact inverse of the set's own compliance. Between two
half-lines held at u0 and u1 it is, over a gap -1 < s < 1,

    u = u0 + (u1 - u0) (1/2 + asin(s)/pi),

the displacement beside two contacts (Johnson 1985, section 2.7). This bridges every gap here; the
preconditioner E' B E, with B the inverse over the grid and E the continuation, needs a number of
iterations nearly independent of the number of patches.
"""

import numpy as np
from scipy.sparse import csr_array


class Extension:
    """E for one set of free nodes.

    nodes   (m,) ascending indices of the free nodes, m >= 1
    count   nodes of the line
    closed  whether node `count` is node 0; else the outermost displacement holds up to the ends
    """

    def __init__(self, nodes: np.ndarray, count: int, closed: bool) -> None:
        free = len(nodes)
        marks = np.zeros(count, dtype=np.int32)
        marks[nodes] = 1
        before = np.cumsum(marks, dtype=np.int32) - 1  # -1 is the last node, from a turn before
        after = before + 1
        after[nodes[-1] :] = 0
        widths = np.diff(nodes, append=nodes[0] + count)  # from each free node to the next
        steps = np.arange(count) - nodes[before]
        steps[: nodes[0]] += count
        share = _share_of_next(steps, widths[before])
        before[: nodes[0]] = free - 1
        if not closed:
            share[: nodes[0]] = 1.0
            share[nodes[-1] :] = 0.0
        columns = np.empty(2 * count, dtype=np.int32)
        columns[0::2], columns[1::2] = before, after
        values = np.empty(2 * count)
        values[0::2], values[1::2] = 1.0 - share, share
        rows = np.arange(0, 2 * count + 1, 2, dtype=np.int32)
        self._matrix = csr_array((values, columns, rows), shape=(count, free))
        self._transpose = self._matrix.T

    def extend(self, values: np.ndarray) -> np.ndarray:
        """E v: displacements (count,) from those (m,) of the free nodes."""
        return self._matrix @ values

    def gather(self, values: np.ndarray) -> np.ndarray:
        """E' v: the grid's (count,) forces as forces (m,) on the free nodes."""
        return self._transpose @ values


def _share_of_next(steps: np.ndarray, widths: np.ndarray) -> np.ndarray:
    """Share of the next free node, `steps` nodes from the last one in a gap `widths` nodes wide."""
    return 0.5 + np.arcsin(2.0 * steps / widths - 1.0) / np.pi
