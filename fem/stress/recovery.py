"""Stresses at the nodes from displacements by superconvergent patch recovery, and their error.

The stresses of quadratic displacements are most accurate at the three inner Gauss points of an
element. A quadratic polynomial is fitted to those of the elements around each vertex; its value is
the vertex's stress, and the mean of two vertices' polynomials the stress at the midpoint of their
edge (Zienkiewicz and Zhu 1992, Int. J. Numer. Methods Eng. 33, 1331-1364). For displacements of
degree 1 or 3 the polynomial has that degree. Patches hold elements of one material.

Polynomials do not follow the kinks of a pressure: the displacement due to the kinks near a patch,
interpolated on the same elements, is subtracted before the fit, and their exact stress added after
it (`fem.stress.kinks`). Patches at the surface have samples on its edges too: the load gives the
stress across the surface, its stretch the stress along it. With hat pressures on a flat surface the
error in the first layer of elements is 1.2 to 1.8 times that in the third (edges as long as the
pitch, 10 to 80 to a half-width, friction 0 to 0.3), without treatment of kinks three to six times
more; on waves of slope 0.1, ten elements long, it is twice that in the third layer.

The difference between recovered and element stresses estimates the error of the latter (same
source), in the energy norm E^2 = integral (s* - s) : strain of (s* - s).
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix, diags

from analytic.stress_state import StressState
from fem.body.elasticity import ElasticBody
from fem.body.triangle import GAUSS, collapsed_gauss, edge_shapes, gradients, jacobians, shapes
from fem.stress.kinks import Kinks, Weights
from fem.stress.surface_load import SurfaceLoad, from_surface, to_surface
from meshes.block import EDGES

# Fewest elements of a patch; smaller patches take in the elements around their vertices.
LEAST_ELEMENTS = 5

# Points of an element at which stresses are sampled, by the degree of the displacement: Gauss
# points of degree 1, 2 and 4 (Dunavant 1985, Int. J. Numer. Methods Eng. 21, 1129-1148).
NEAR_EDGE, NEAR_VERTEX = 0.445948490915965, 0.091576213509771
SAMPLED = {
    1: np.array([[1.0, 1.0]]) / 3.0,
    2: GAUSS,
    3: np.concatenate(
        [[[a, a], [1.0 - 2.0 * a, a], [a, 1.0 - 2.0 * a]] for a in (NEAR_EDGE, NEAR_VERTEX)]
    ),
}

# Weight of a sample on the surface's edges against one in an element. The error in the first layer
# where the surface bends within a few elements, and where it is flat and the pressure kinked,
# changes by -30 and +25 % with 16, by +40 and -5 % with 1.
SURFACE_WEIGHT = 4.0

# Weight of a small curvature against the fit: decides only where samples leave it open.
RIDGE = 1e-9

# Points a line of the error's quadrature: exact for the square of a quadratic on straight elements.
LINE_POINTS = 3


@dataclass(frozen=True)
class StressNodes:
    """Nodes of the stresses: mesh points, on the interface of a coating one for each material.
    point (k,) is the mesh point of each node; triangles (m, 6) are the nodes of each triangle."""

    point: np.ndarray
    triangles: np.ndarray

    def at_surface(self, point: np.ndarray) -> np.ndarray:
        """Nodes at mesh points (q,) of the surface."""
        node = np.empty(self.point.max() + 1, dtype=np.int64)
        node[self.point] = np.arange(len(self.point))
        return node[point]


@dataclass(frozen=True)
class MaterialStress(StressState):
    """Stresses [Pa] with Poisson's ratio of the material at each point."""

    poissons_ratio: np.ndarray


def stress_nodes(body: ElasticBody) -> StressNodes:
    """The mesh's points in their order; with a coating the body's first, then the coating's."""
    if not body.coated.any():
        return StressNodes(np.arange(len(body.points)), body.mesh.triangles)
    count = len(body.points)
    key, node = np.unique(body.mesh.triangles + count * body.coated[:, None], return_inverse=True)
    return StressNodes(key % count, node.reshape(body.mesh.triangles.shape))


@dataclass(frozen=True)
class Patches:
    """The elements around each vertex, and the edges between vertices.

    An end of an edge on a side of the block, with half a patch, has no share of the stress in the
    middle if the other end has a whole one.
    """

    vertex: np.ndarray  # (v,) the stress node in the middle of each patch
    coated: np.ndarray  # (v,) whether it belongs to the coating
    start: np.ndarray  # (v + 1,) where the elements of each patch begin in `element`
    element: np.ndarray  # (p,) elements of all patches in turn
    beside: np.ndarray  # (s, 2) pairs of a patch and an edge of the surface that touch
    ends: np.ndarray  # (e, 2) patches at the ends of each edge
    middle: np.ndarray  # (e,) the stress node in the middle of each edge
    shares: np.ndarray  # (e, 2) weights of the two ends at the middle

    @property
    def patch(self) -> np.ndarray:
        return np.repeat(np.arange(len(self.vertex)), np.diff(self.start))


def patches_of(body: ElasticBody, nodes: StressNodes) -> Patches:
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
    sides, outer = body.sides, np.zeros(len(body.points), dtype=bool)
    outer[np.concatenate([sides.top, sides.bottom, sides.left, sides.right])] = True

    middle, first = np.unique(nodes.triangles[:, 3:].ravel(), return_index=True)
    ends = corner[:, EDGES].reshape(-1, 2)[first]
    inner = ~outer[nodes.point[vertex]][ends]
    equal = inner[:, :1] == inner[:, 1:]
    shares = np.where(equal, 0.5, inner.astype(float))
    return Patches(vertex, coated, start, element, beside, ends, middle, shares)


def _around(corner: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Elements around each vertex, as compressed rows: starts (count + 1,) and elements."""
    element = np.repeat(np.arange(len(corner)), 3)
    touch = csr_matrix((np.ones(corner.size), (corner.ravel(), element)), (count, len(corner)))
    few = np.diff(touch.indptr) < LEAST_ELEMENTS
    around = touch[few] @ touch.T @ touch
    place = (np.flatnonzero(few), np.arange(few.sum()))
    spread = csr_matrix((np.ones(few.sum()), place), (count, few.sum()))
    patch = (diags((~few).astype(float)) @ touch + spread @ around).tocsr()
    patch.eliminate_zeros()
    patch.sort_indices()
    return patch.indptr, patch.indices


def element_stress(body: ElasticBody, displacement: np.ndarray, at: np.ndarray) -> np.ndarray:
    """sx, sz, txz (m, q, 3) [Pa] of a displacement (n, 2) at reference points (q, 2)."""
    return _stress(body, np.arange(len(body.elements)), displacement[body.elements], at)


def recovered_stress(
    body: ElasticBody, displacement: np.ndarray, load: SurfaceLoad | None = None
) -> np.ndarray:
    """sx, sz, txz (k, 3) [Pa] at the body's `stress_nodes` of a displacement (n, 2) [m]. `load`
    gives the tractions on the surface; None: no samples there."""
    nodes = stress_nodes(body)
    points, patches = body.points[nodes.point], patches_of(body, nodes)
    sampled = SAMPLED[body.degree]
    corner = body.points[body.mesh.triangles]
    place = np.einsum("mac,qa->mqc", corner, shapes(sampled), optimize=True)
    centre, patch, first = points[patches.vertex], patches.patch, patches.start[:-1]
    offset = place[patches.element] - centre[patch][:, None]
    count = np.diff(patches.start) * len(sampled)
    radius = np.sqrt(np.add.reduceat((offset**2).sum(axis=(1, 2)), first) / count)
    stress = element_stress(body, displacement, sampled)[patches.element]
    if load is not None:
        seen = patches.coated == body.coated.any()
        weights = load.kinks.weights(centre, radius, seen)
        near = _NearKinks(body, load.kinks, weights, patches, points)
        stress -= near.samples(sampled)

    terms = _terms(offset / radius[patch][:, None, None], body.degree)
    moments = np.add.reduceat(terms.transpose(0, 2, 1) @ terms, first, axis=0)
    sums = np.add.reduceat(terms.transpose(0, 2, 1) @ stress, first, axis=0)
    if load is not None:
        patch, place, stress = near.surface_samples(load, displacement)
        terms = _terms((place - centre[patch][:, None]) / radius[patch][:, None, None], body.degree)
        weighted = SURFACE_WEIGHT * terms.transpose(0, 2, 1)
        np.add.at(moments, patch, weighted @ terms)
        np.add.at(sums, patch, weighted @ stress)
    curved = np.arange(3, terms.shape[-1])
    moments[:, curved, curved] += RIDGE * count[:, None]
    fit = np.linalg.solve(moments, sums)

    offset = points[patches.middle][:, None] - centre[patches.ends]
    terms = _terms(offset / radius[patches.ends][..., None], body.degree)
    at_vertex, at_middle = fit[:, 0], np.einsum("eki,ekic->ekc", terms, fit[patches.ends])
    if load is not None:
        at_vertex = at_vertex + near.at(np.arange(len(centre)), patches.vertex)
        ends, middle = patches.ends.ravel(), np.repeat(patches.middle, 2)
        at_middle = at_middle + near.at(ends, middle).reshape(-1, 2, 3)
    result = np.empty((len(points), 3))
    result[patches.vertex] = at_vertex
    result[patches.middle] = np.einsum("ek,ekc->ec", patches.shares, at_middle)
    return result


@dataclass(frozen=True)
class _NearKinks:
    """The kinks near each patch: stresses to subtract from its samples and to add to its fit."""

    body: ElasticBody
    kinks: Kinks
    weights: Weights
    patches: Patches
    points: np.ndarray

    def samples(self, sampled: np.ndarray) -> np.ndarray:
        """sx, sz, txz (p, q, 3) of the kinks' displacement interpolated on the elements."""
        near = self.weights.count[self.patches.patch] > 0
        element = self.patches.element[near]
        moved = self._displacement(self.patches.patch[near], self.body.elements[element])
        samples = np.zeros((len(near), len(sampled), 3))
        samples[near] = _stress(self.body, element, moved, sampled)
        return samples

    def surface_samples(
        self, load: SurfaceLoad, displacement: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Patch (s,), place (s, q, 2) and stress (s, q, 3) without kinks on the surface's edges."""
        body, (patch, edge) = self.body, self.patches.beside.T
        point = body.top.point[2 * edge[:, None] + np.arange(3)]
        node = body.surface.point[body.degree * edge[:, None] + np.arange(body.degree + 1)]
        at, _ = np.polynomial.legendre.leggauss(body.degree)
        at = 0.5 * (1.0 + at)
        place = edge_shapes(at, 2) @ body.points[point]
        longer = _edge_slopes(at, 2) @ body.points[point]
        moved = displacement[node] - self._displacement(patch, node)
        stretch = _edge_slopes(at, body.degree) @ moved
        number = np.arange(place[..., 0].size).reshape(place.shape[:2])
        own = self.kinks.stress(self.weights, patch, place.reshape(-1, 2), number)

        x = place[..., 0].ravel()
        t = load.tangent(x).reshape(place.shape)
        s_nn, s_nt = (s.reshape(number.shape) for s in load.across(x))
        _, kinks_nn, kinks_nt = to_surface(t, own)
        s_nn, s_nt = s_nn - kinks_nn, s_nt - kinks_nt
        material = body.surface_material
        nu = material.poissons_ratio
        e_tt = (stretch * longer).sum(-1) / (longer**2).sum(-1)
        s_tt = material.plane_strain_modulus * e_tt + nu / (1.0 - nu) * s_nn
        return patch, place, from_surface(t, s_tt, s_nn, s_nt)

    def at(self, patch: np.ndarray, node: np.ndarray) -> np.ndarray:
        """sx, sz, txz (r, 3) at stress nodes (r,), of the kinks near the patches (r,)."""
        return self.kinks.stress(self.weights, patch, self.points, node[:, None])[:, 0]

    def _displacement(self, patch: np.ndarray, node: np.ndarray) -> np.ndarray:
        """u_x, u_z (r, k, 2) of the kinks near each patch (r,) at nodes (r, k) of the body."""
        body, count = self.body, len(self.body.nodes)
        pair, which = np.unique(patch[:, None] * count + node, return_inverse=True)
        patch, point = np.divmod(pair, count)
        nu, shear = body.surface_material.poissons_ratio, body.surface_material.shear_modulus
        moved = self.kinks.displacement(self.weights, patch, body.nodes, point[:, None], nu)
        return moved[which.reshape(node.shape), 0] / shear


def _edge_slopes(at: np.ndarray, degree: int) -> np.ndarray:
    """d shape / dt (q, degree + 1) of an edge's nodes in turn, at places t (q,) from 0 to 1."""
    power = np.arange(degree + 1)
    slope = power * at[:, None] ** np.maximum(power - 1, 0)
    return slope @ np.linalg.inv((power[:, None] / degree) ** power)


def _stress(
    body: ElasticBody, element: np.ndarray, moved: np.ndarray, at: np.ndarray
) -> np.ndarray:
    """sx, sz, txz (r, q, 3) [Pa] in elements (r,) from displacements (r, k, 2) of their nodes."""
    slope = gradients(body.points[body.mesh.triangles[element]], moved, at)
    exx, ezz = slope[..., 0, 0], slope[..., 1, 1]
    shear = body.shear_modulus[element, None]
    pressure = body.lame[element, None] * (exx + ezz)
    twist = shear * (slope[..., 0, 1] + slope[..., 1, 0])
    return np.stack([pressure + 2.0 * shear * exx, pressure + 2.0 * shear * ezz, twist], axis=-1)


def _terms(offset: np.ndarray, degree: int) -> np.ndarray:
    """Terms (..., k) x^i z^j of a polynomial at offsets (..., 2), the lowest first."""
    x, z = offset[..., 0], offset[..., 1]
    powers = [(d - j, j) for d in range(degree + 1) for j in range(d + 1)]
    return np.stack([x**i * z**j for i, j in powers], axis=-1)


def energy_errors(body: ElasticBody, displacement: np.ndarray) -> np.ndarray:
    """E (m,) [(J/m)^(1/2)] of each element, for a displacement (n, 2) [m]."""
    at, weight = collapsed_gauss(LINE_POINTS)
    smooth = recovered_stress(body, displacement)[stress_nodes(body).triangles]
    error = np.einsum("mac,qa->mqc", smooth, shapes(at)) - element_stress(body, displacement, at)
    sx, sz, txz = np.moveaxis(error, -1, 0)
    shear, nu = body.shear_modulus[:, None], body.poissons_ratio[:, None]
    density = ((1.0 - nu) * (sx**2 + sz**2) - 2.0 * nu * sx * sz) / (2.0 * shear) + txz**2 / shear
    area = np.abs(np.linalg.det(jacobians(body.points[body.mesh.triangles], at)))
    return np.sqrt((density * area) @ weight)
