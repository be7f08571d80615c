"""Search directions of conjugate gradients on the free nodes.

The preconditioner is E' B E: B, the approximate inverse, needs displacements on the whole grid, and
E extends those of the free nodes. Over a gap -1 < s < 1 between half-lines held at u0 and u1

    u = u0 + (u1 - u0) (1/2 + asin(s)/pi)          (Johnson 1985, section 2.7)

has the least energy. With E bridging every gap in this way the number of iterations hardly depends
on that of the patches, as it would with zeros, which jump at every edge."""

import numpy as np

from analytic.operators.half_plane import ModelOperator


class Extension:
    """E for one set of free nodes.

    nodes   (m,) ascending indices of the free nodes, m >= 1
    count   nodes of the line
    closed  whether node `count` is node 0; else the outermost displacement holds up to the ends"""

    def __init__(self, nodes: np.ndarray, count: int, closed: bool) -> None:
        marks = np.zeros(count, dtype=np.intp)
        marks[nodes] = 1
        before = np.cumsum(marks) - 1  # the last free node, here -1 before the first of them
        widths = np.diff(nodes, append=nodes[0] + count)  # from each free node to the next
        steps = np.arange(count) - nodes[before]
        steps[: nodes[0]] += count
        share = _share_of_next(steps, widths[before])
        if not closed:
            share[: nodes[0]] = 1.0
            share[nodes[-1] :] = 0.0
        self._before, self._share = before, share
        # the line before the first free node belongs to the gap behind the last
        self._split = bool(nodes[0] > 0)
        self._gaps = np.concatenate(([0], nodes)) if self._split else nodes

    def extend(self, values: np.ndarray) -> np.ndarray:
        """E v: displacements (count,) from those (m,) of the free nodes."""
        rise = np.concatenate((values[1:], values[:1])) - values  # over each gap
        extended = rise[self._before]
        extended *= self._share
        extended += values[self._before]
        return extended

    def gather(self, values: np.ndarray) -> np.ndarray:
        """E' v: the grid's (count,) forces as forces (m,) on the free nodes."""
        whole = np.add.reduceat(values, self._gaps)
        of_next = np.add.reduceat(values * self._share, self._gaps)
        if self._split:
            whole[-1] += whole[0]
            of_next[-1] += of_next[0]
            whole, of_next = whole[1:], of_next[1:]
        whole -= of_next
        whole[1:] += of_next[:-1]
        whole[0] += of_next[-1]
        return whole


class RowExtension:
    """`Extension` of free nodes in a row, which leave one gap: quicker; methods as there."""

    def __init__(self, nodes: np.ndarray, count: int, closed: bool) -> None:
        first, last = int(nodes[0]), int(nodes[-1])
        self._row, self._count = slice(first, last + 1), count
        self._gap = np.concatenate((np.arange(last + 1, count), np.arange(first)))
        behind = count - 1 - last
        steps = np.arange(1, len(self._gap) + 1)
        self._share = _share_of_next(steps, np.array(first + count - last))
        if not closed:
            self._share[:behind], self._share[behind:] = 0.0, 1.0

    def extend(self, values: np.ndarray) -> np.ndarray:
        extended = np.empty(self._count)
        extended[self._row] = values
        extended[self._gap] = values[-1] + self._share * (values[0] - values[-1])
        return extended

    def gather(self, values: np.ndarray) -> np.ndarray:
        gathered, outside = values[self._row].copy(), values[self._gap]
        of_first = self._share @ outside
        gathered[0] += of_first
        gathered[-1] += outside.sum() - of_first
        return gathered


def extension_from(nodes: np.ndarray, count: int, closed: bool) -> Extension | RowExtension:
    """E for one set of free nodes; arguments as of `Extension`."""
    in_a_row = nodes[-1] - nodes[0] == len(nodes) - 1
    return (RowExtension if in_a_row else Extension)(nodes, count, closed)


def _share_of_next(steps: np.ndarray, widths: np.ndarray) -> np.ndarray:
    """Share of the next free node, `steps` nodes from the last one in a gap `widths` nodes wide."""
    return 0.5 + np.arcsin(2.0 * steps / widths - 1.0) / np.pi


class SearchDirections:
    """The preconditioner on some nodes (m,), projected on w'p = const where `weights` are given.

    operator  of a stretch of the line that holds the nodes
    stretch   its slice of the line: all of it where `cropped` is False
    lift      (m,) pressures that carry a unit load"""

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

    def inverse(self, weighted_displacement: np.ndarray) -> np.ndarray:
        """Pressures (m,) under which the nodes sink by about `displacement` (m,)."""
        extended = self._extension.extend(weighted_displacement)
        return self._extension.gather(self.operator.precondition(extended))

    def step(self, residual: np.ndarray) -> np.ndarray:
        """`inverse` less the load that it carries."""
        step = self.inverse(residual)
        if self._weights is not None:
            step -= self.lift * (self._weights @ step)
        return step
