"""Triangles of degree 1, 2 or 3: shape functions, their slopes, quadrature, location of points.

Node order is gmsh's: vertices (0, 0), (1, 0), (0, 1), then the inner nodes of edges 01, 12, 20,
each in that direction and evenly spaced, then the inside. A shape function is the polynomial that
is 1 at its node and 0 at all others. (r, s) are reference coordinates, J = d(x, z)/d(r, s) the
Jacobian.
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
    return monomials(at, degree) @ _coefficients(degree)


def slopes(at: np.ndarray, degree: int = 2) -> np.ndarray:
    """d shape / d(r, s) (..., k, 2) at reference points (..., 2)."""
    r, s = at[..., 0], at[..., 1]
    along_r = [i * r ** max(i - 1, 0) * s**j for i, j in _powers(degree)]
    along_s = [j * r**i * s ** max(j - 1, 0) for i, j in _powers(degree)]
    slope = (np.stack(along, axis=-1) @ _coefficients(degree) for along in (along_r, along_s))
    return np.stack(list(slope), axis=-1)


def edge_shapes(t: np.ndarray, degree: int = 2) -> np.ndarray:
    """Shape functions (..., degree + 1) of an edge's nodes in turn, at t (...) from 0 to 1."""
    return np.stack([t**i for i in range(degree + 1)], axis=-1) @ _edge_coefficients(degree)


def edge_slopes(at: np.ndarray, degree: int = 2) -> np.ndarray:
    """d shape / dt (q, degree + 1) of an edge's nodes in turn, at t (q,) from 0 to 1."""
    slope = np.stack([i * at ** max(i - 1, 0) for i in range(degree + 1)], axis=-1)
    return slope @ _edge_coefficients(degree)


def monomials(at: np.ndarray, degree: int) -> np.ndarray:
    """Terms x^i z^j (..., k) of a polynomial at points (..., 2), the lowest first."""
    x, z = at[..., 0], at[..., 1]
    return np.stack([x**i * z**j for i, j in _powers(degree)], axis=-1)


def _powers(degree: int) -> list[tuple[int, int]]:
    return [(d - j, j) for d in range(degree + 1) for j in range(d + 1)]


@cache
def _coefficients(degree: int) -> np.ndarray:
    """Of each monomial in each shape function (k, k): whole, or of degree 3 halves."""
    return np.linalg.inv(monomials(reference_nodes(degree), degree)).round(6)


@cache
def _edge_coefficients(degree: int) -> np.ndarray:
    """Of each power in each shape function of an edge (degree + 1, degree + 1)."""
    power = np.arange(degree + 1)
    return np.linalg.inv((power[:, None] / degree) ** power).round(6)


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
        far = lost = np.flatnonzero(_outside(at) > ROUNDING)
        for _ in range(WALK_STEPS):
            behind = np.argmin(_barycentric(at[lost]), axis=1)
            element_next = self._neighbours[element[lost], behind]
            lost, element_next = lost[element_next >= 0], element_next[element_next >= 0]
            if len(lost) == 0:
                break
            element[lost] = element_next
            at[lost] = self._reference(element_next, where[lost])
            lost = lost[_outside(at[lost]) > ROUNDING]
        element[far[_outside(at[far]) > ROUNDING]] = -1
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
