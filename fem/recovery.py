"""Stresses at the nodes from displacements: superconvergent patch recovery.

The stresses of quadratic displacements are most accurate at the three inner Gauss points of an
element. Around each vertex a quadratic polynomial is fitted to those of the elements that meet
there; its value is the vertex's stress, and the mean of the two vertices' polynomials the stress
of an edge's midpoint (Zienkiewicz and Zhu 1992, Int. J. Numer. Methods Eng. 33, 1331-1364).
Vertices on the boundary have half a patch: their polynomial is extrapolated, so that a midpoint
between one of them and an inner vertex takes the inner one's.

Against the exact stresses of the same hat pressures (Hertz and random, 20 to 400 edges to a
contact) the error below the first layer of elements is a third to a fifth of that of nodal
averages or of a global projection; in the first layer it is two thirds of it.
"""

import numpy as np
from scipy.sparse import csr_matrix, diags

from fem.elasticity import ElasticBody
from fem.triangle import GAUSS, gradients, shapes

# Fewest elements whose three Gauss points determine the six coefficients with room to spare;
# smaller patches take in the elements around their vertices.
LEAST_ELEMENTS = 5

# Weight of the curvature's smallness against the fit: decides only where samples leave it open.
RIDGE = 1e-9


def element_stress(body: ElasticBody, displacement: np.ndarray, at: np.ndarray) -> np.ndarray:
    """sx, sz, txz (m, q, 3) [Pa] of a displacement (n, 2) at reference points (q, 2)."""
    triangles = body.mesh.triangles
    slope = gradients(body.points[triangles], displacement[triangles], at)
    exx, ezz = slope[..., 0, 0], slope[..., 1, 1]
    shear, nu = body.material.shear_modulus, body.material.poissons_ratio
    pressure = 2.0 * shear * nu / (1.0 - 2.0 * nu) * (exx + ezz)
    twist = shear * (slope[..., 0, 1] + slope[..., 1, 0])
    return np.stack([pressure + 2.0 * shear * exx, pressure + 2.0 * shear * ezz, twist], axis=-1)


def recovered_stress(body: ElasticBody, displacement: np.ndarray) -> np.ndarray:
    """sx, sz, txz (n, 3) [Pa] at all mesh points of a displacement (n, 2) [m]."""
    points, triangles = body.points, body.mesh.triangles
    vertices = np.unique(triangles[:, :3])
    position = np.zeros(len(points), dtype=np.int64)
    position[vertices] = np.arange(len(vertices))
    corner = position[triangles[:, :3]]
    place = np.einsum("mac,qa->mqc", points[triangles], shapes(GAUSS), optimize=True)

    start, element = _patches(corner, len(vertices))
    vertex = np.repeat(np.arange(len(vertices)), np.diff(start))
    offset = place[element] - points[vertices][vertex, None]
    size = np.sqrt(np.add.reduceat((offset**2).sum(axis=(1, 2)), start[:-1]) / np.diff(start))
    terms = _quadratic(offset / size[vertex, None, None])
    stress = element_stress(body, displacement, GAUSS)[element]
    moments = np.add.reduceat(terms.transpose(0, 2, 1) @ terms, start[:-1], axis=0)
    sums = np.add.reduceat(terms.transpose(0, 2, 1) @ stress, start[:-1], axis=0)
    moments[:, [3, 4, 5], [3, 4, 5]] += RIDGE * np.diff(start)[:, None]
    fit = np.linalg.solve(moments, sums)

    result = np.empty((len(points), 3))
    result[vertices] = fit[:, 0]
    edge, at = _edges(corner, triangles)
    offset = points[at][:, None] - points[vertices][edge]
    value = np.einsum("eki,ekic->ekc", _quadratic(offset / size[edge][..., None]), fit[edge])
    result[at] = np.einsum("ek,ekc->ec", _shares(body, vertices, edge), value)
    return result


def _quadratic(offset: np.ndarray) -> np.ndarray:
    """Terms (..., 6) 1, x, z, x^2, xz, z^2 of offsets (..., 2)."""
    x, z = offset[..., 0], offset[..., 1]
    return np.stack([np.ones_like(x), x, z, x * x, x * z, z * z], axis=-1)


def _patches(corner: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
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


def _edges(corner: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (e, 2) of each edge once, and its midpoint (e,)."""
    at, first = np.unique(triangles[:, 3:].ravel(), return_index=True)
    return corner[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)[first], at


def _shares(body: ElasticBody, vertices: np.ndarray, edge: np.ndarray) -> np.ndarray:
    """Weights (e, 2) of an edge's two vertices at its midpoint."""
    outer = np.zeros(len(body.points), dtype=bool)
    sides = body.sides
    outer[np.concatenate([sides.top, sides.bottom, sides.left, sides.right])] = True
    inner = ~outer[vertices][edge]
    alike = inner[:, :1] == inner[:, 1:]
    return np.where(alike, 0.5, inner.astype(float))
