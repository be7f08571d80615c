"""Triangles of degree 1, 2 or 3: shape functions, their slopes, quadrature, location of points.

Node order is gmsh's: vertices (0, 0), (1, 0), (0, 1), then the inner nodes of edges 01, 12, 20,
each in that direction and evenly spaced, then the inside. A shape function is a product of one
factor for each of the three barycentric coordinates (Zienkiewicz and Taylor, The Finite Element
Method, 5th ed., section 8.8). (r, s) are reference coordinates, J = d(x, z)/d(r, s) the Jacobian.
"""

from functools import cache, cached_property
from typing import ClassVar

import numpy as np
from scipy.spatial import cKDTree

# A point this far outside an element, in reference coordinates, still belongs to it.
ROUNDING = 1e-9
NEWTON_STEPS, WALK_STEPS = 4, 40
SETTLED = 1e-6  # a step of Newton's, whose square is left

# Degree of a triangle by its number of nodes.
DEGREE = {3: 1, 6: 2, 10: 3}

# Edge middles' rule in the interior: degree 2, and where stresses of quadratic displacements
# are most accurate (Zienkiewicz and Taylor, The Finite Element Method, 5th ed., fig. 14.4).
GAUSS = np.array([[1, 1], [4, 1], [1, 4]]) / 6.0


@cache
def lattice(degree: int, sides: tuple = ((0, 1), (1, 2), (2, 0))) -> np.ndarray:
    """Whole numbers (k, 3), of sum `degree`: the nodes' barycentric coordinates times it. Vertices,
    then the inner nodes of the `sides`, each from one vertex to another, then the inside."""
    corner = np.eye(3, dtype=int)
    edges = [(degree - i) * corner[a] + i * corner[b] for a, b in sides for i in range(1, degree)]
    return np.array([*(degree * corner), *edges, *([[1, 1, 1]] if degree == 3 else [])])


def reference_nodes(degree: int) -> np.ndarray:
    """Reference coordinates (k, 2) of the nodes."""
    return lattice(degree)[:, 1:] / degree


def shapes(at: np.ndarray, degree: int = 2) -> np.ndarray:
    """Shape functions (..., k) at reference points (..., 2)."""
    factor, _ = _factors(_barycentric(at), degree)
    i, j, k = lattice(degree).T
    return factor[..., 0, i] * factor[..., 1, j] * factor[..., 2, k]


def slopes(at: np.ndarray, degree: int = 2) -> np.ndarray:
    """d shape / d(r, s) (..., k, 2) at reference points (..., 2)."""
    factor, slope = _factors(_barycentric(at), degree)
    i, j, k = lattice(degree).T
    first, second, third = factor[..., 0, i], factor[..., 1, j], factor[..., 2, k]
    along_t = slope[..., 0, i] * second * third
    along_r = first * slope[..., 1, j] * third
    along_s = first * second * slope[..., 2, k]
    return np.stack([along_r - along_t, along_s - along_t], axis=-1)


def edge_shapes(t: np.ndarray, degree: int = 2) -> np.ndarray:
    """Shape functions (..., degree + 1) of an edge's nodes in turn, at t (...) from 0 to 1."""
    factor, _ = _factors(np.stack([1.0 - t, t], axis=-1), degree)
    i = np.arange(degree + 1)
    return factor[..., 0, degree - i] * factor[..., 1, i]


def edge_slopes(at: np.ndarray, degree: int = 2) -> np.ndarray:
    """d shape / dt (q, degree + 1) of an edge's nodes in turn, at t (q,) from 0 to 1."""
    power = np.arange(degree + 1)
    slope = power * at[:, None] ** np.maximum(power - 1, 0)
    return slope @ np.linalg.inv((power[:, None] / degree) ** power)


def jacobians(nodes: np.ndarray, at: np.ndarray) -> np.ndarray:
    """J (m, q, 2, 2) of elements with node coordinates (m, k, 2) at reference points (q, 2)."""
    return np.einsum("mac,qad->mqcd", nodes, slopes(at, DEGREE[nodes.shape[1]]), optimize=True)


def gradients(
    nodes: np.ndarray, values: np.ndarray, at: np.ndarray, straight: bool = False
) -> np.ndarray:
    """d values / d(x, z) (m, q, c, 2) of nodal values (m, k, c) at reference points (q, 2). `nodes`
    (m, 6, 2) are the coordinates of the element's nodes; `values` may have another degree. On
    `straight` elements the Jacobian is everywhere the same."""
    slope = slopes(at, DEGREE[values.shape[1]])
    reference = np.einsum("mak,qad->mqkd", values, slope, optimize=True)
    return reference @ inverse(jacobians(nodes, at[:1] if straight else at))


def inverse(matrix: np.ndarray) -> np.ndarray:
    """Invert 2 by 2 matrices (..., 2, 2): ten times as fast as numpy's for any size."""
    (a, b), (c, d) = np.moveaxis(matrix, (-2, -1), (0, 1))
    result = np.empty_like(matrix)
    result[..., 0, 0], result[..., 0, 1], result[..., 1, 0], result[..., 1, 1] = d, -b, -c, a
    result /= (a * d - b * c)[..., None, None]
    return result


def collapsed_gauss(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Reference points (q, 2) and weights (q,) of a rule on the triangle, q = count^2. Gauss's rule
    on the square, collapsed: exact for degree 2 count - 2."""
    line, weight = np.polynomial.legendre.leggauss(count)
    line, weight = 0.5 * (1.0 + line), 0.5 * weight
    r, s = (value.ravel() for value in np.meshgrid(line, line))
    return np.column_stack([r, s * (1.0 - r)]), (weight[:, None] * weight).ravel() * (1.0 - r)


def _barycentric(at: np.ndarray) -> np.ndarray:
    """Barycentric coordinates (..., 3) at reference points (..., 2)."""
    return np.concatenate([1.0 - at.sum(axis=-1, keepdims=True), at], axis=-1)


def _factors(part: np.ndarray, degree: int) -> tuple[np.ndarray, np.ndarray]:
    """Factors (..., degree + 1) of a coordinate L (...), and their derivatives. The m-th is 1 at L
    = m / degree and 0 at smaller multiples of 1 / degree."""
    value, slope = [np.ones_like(part)], [np.zeros_like(part)]
    for m in range(degree):
        rest = degree * part - m
        slope.append((slope[m] * rest + value[m] * degree) / (m + 1))
        value.append(value[m] * rest / (m + 1))
    return np.stack(value, axis=-1), np.stack(slope, axis=-1)


class Locator:
    """Finds the elements that hold points, on a mesh of `points` (n, 2) and `triangles` (m, 6).
    From the element with the nearest centre it walks across the edge behind which the point lies,
    rarely more than twice on a graded mesh. Newton's method inverts the map of `curved` ones."""

    # mesh, points, and where these are, of the latest call: other bodies and loads repeat it
    _last: ClassVar[tuple[tuple, tuple[np.ndarray, np.ndarray]] | None] = None

    def __init__(self, points: np.ndarray, triangles: np.ndarray, curved: bool) -> None:
        self.points, self.triangles, self.curved = points, triangles, curved

    @cached_property
    def _centres(self) -> cKDTree:
        return cKDTree(self.points.take(self.triangles[:, :3], axis=0).mean(axis=1))

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
        """Element (k,), -1 outside the body, and reference coordinates (k, 2) of points (k, 2).
        The last ones are known."""
        asked, last = (self.points, self.triangles, self.curved, where), Locator._last
        if last is None or not all(map(np.array_equal, asked, last[0])):
            Locator._last = last = asked, self._located(where)
        return last[1]

    def _located(self, where: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
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
        nodes = self.points.take(self.triangles.take(element, axis=0), axis=0)
        sides = np.stack([nodes[:, 1] - nodes[:, 0], nodes[:, 2] - nodes[:, 0]], axis=-1)
        at = np.einsum("kcd,kd->kc", inverse(sides), where - nodes[:, 0])
        left = np.arange(len(at) if self.curved else 0)
        for _ in range(NEWTON_STEPS):
            # Far outside an element its quadratic map may fold.
            at[left] = np.clip(at[left], -1.0, 2.0)
            still, now = nodes.take(left, axis=0), at.take(left, axis=0)
            miss = where.take(left, axis=0) - np.einsum("kac,ka->kc", still, shapes(now))
            jacobian = np.einsum("kac,kad->kcd", still, slopes(now))
            step = np.einsum("kcd,kd->kc", inverse(jacobian), miss)
            at[left] += step
            left = left[np.abs(step).max(axis=1) > SETTLED]
        return at


def _outside(at: np.ndarray) -> np.ndarray:
    """Distance (k,) of points from the reference triangle, in barycentric coordinates."""
    return -np.minimum(_barycentric(at).min(axis=1), 0.0)
