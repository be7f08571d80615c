"""Stresses at the nodes from displacements by superconvergent patch recovery.

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
more; on waves of slope 0.1, ten elements long, it is twice that in the third layer."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, wraps
from typing import TypeVar
from weakref import WeakKeyDictionary

import numpy as np
from scipy.sparse import csr_matrix, diags

from analytic.stress_state import StressState
from fem.body.elasticity import MeshedBody
from fem.body.sums import matrix_of
from fem.body.triangle import (
    GAUSS,
    edge_shapes,
    edge_slopes,
    gradients,
    monomials,
    reference_nodes,
    shapes,
)
from fem.stress.kinks import Kinks, Weights, runs
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

PIECE = 2**15  # nodes, neighbours along x, whose stresses are recovered at once: memory
ELEMENTS = 2**14  # whose stresses are averaged at once
VERTICES = reference_nodes(1)


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

    @cached_property
    def touch(self) -> csr_matrix:
        """Which triangle touches which node that is a vertex (k, m)."""
        count = len(self.triangles)
        triangle = np.arange(count)[:, None]
        return matrix_of(np.ones(1), self.triangles[:, :3], triangle, (len(self.point), count))

    def of_triangles(self, value: np.ndarray) -> np.ndarray:
        """(k,) of values (m,) of the triangles, which those around a node share."""
        values = np.empty(len(self.point))
        values[self.triangles] = value[:, None]
        return values

    def around(self, inner: np.ndarray) -> np.ndarray:
        """Triangles that touch some inner ones, these included."""
        return np.unique(self.touch[np.unique(self.triangles[inner, :3])].indices)


@dataclass(frozen=True)
class MaterialStress(StressState):
    """Stresses [Pa] with Poisson's ratio of the material at each point."""

    poissons_ratio: np.ndarray


Found = TypeVar("Found")


def _once(make: Callable[[MeshedBody], Found]) -> Callable[[MeshedBody], Found]:
    """`make`, but once for a body: loads, friction coefficients and gaps share what it returns."""
    known: WeakKeyDictionary[MeshedBody, Found] = WeakKeyDictionary()

    @wraps(make)
    def kept(body: MeshedBody) -> Found:
        if body not in known:
            known[body] = make(body)
        return known[body]

    return kept


@_once
def stress_nodes(body: MeshedBody) -> StressNodes:
    """The mesh's points in their order; with a coating the body's first, then the coating's."""
    if not body.coated.any():
        return StressNodes(np.arange(len(body.points)), body.mesh.triangles)
    count = len(body.points)
    key, node = np.unique(body.mesh.triangles + count * body.coated[:, None], return_inverse=True)
    return StressNodes(key % count, node.reshape(body.mesh.triangles.shape))


@dataclass(frozen=True)
class Patches:
    """The elements around each vertex, and the edges between vertices. An end of an edge on a side
    of the block, with half a patch, has no share in the middle if the other end has a whole one."""

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

    def of(self, wanted: np.ndarray) -> "Patches":
        """Patches that give the stresses at the `wanted` (k,) of all stress nodes."""
        edge = wanted[self.middle]
        chosen = wanted[self.vertex]
        chosen[self.ends[edge]] = True
        number, beside = np.cumsum(chosen) - 1, self.beside[chosen[self.beside[:, 0]]]
        count = np.diff(self.start)[chosen]
        row, place = runs(count)
        return replace(
            self,
            vertex=self.vertex[chosen],
            coated=self.coated[chosen],
            start=np.concatenate([[0], np.cumsum(count)]),
            element=self.element[self.start[:-1][chosen][row] + place],
            beside=np.column_stack([number[beside[:, 0]], beside[:, 1]]),
            ends=number[self.ends[edge]],
            middle=self.middle[edge],
            shares=self.shares[edge],
        )


@_once
def patches_of(body: MeshedBody) -> Patches:
    """Patches of a body."""
    nodes = stress_nodes(body)
    vertex = np.unique(nodes.triangles[:, :3])
    position = np.zeros(len(nodes.point), dtype=np.int64)
    position[vertex] = np.arange(len(vertex))
    corner = position[nodes.triangles[:, :3]]
    coated = np.zeros(len(vertex), dtype=bool)
    coated[corner] = body.coated[:, None]
    top = position[nodes.at_surface(body.top.point[::2])]
    edge = np.arange(len(top) - 1)
    beside = np.column_stack([np.concatenate([top[:-1], top[1:]]), np.tile(edge, 2)])
    start, element = _around(nodes.touch[vertex])
    sides, outer = body.sides, np.zeros(len(body.points), dtype=bool)
    outer[np.concatenate([sides.top, sides.bottom, sides.left, sides.right])] = True

    middle, first = np.unique(nodes.triangles[:, 3:].ravel(), return_index=True)
    ends = corner[:, EDGES].reshape(-1, 2)[first]
    inner = ~outer[nodes.point[vertex]][ends]
    equal = inner[:, :1] == inner[:, 1:]
    shares = np.where(equal, 0.5, inner.astype(float))
    return Patches(vertex, coated, start, element, beside, ends, middle, shares)


def _around(touch: csr_matrix) -> tuple[np.ndarray, np.ndarray]:
    """Elements around each vertex as compressed rows, starts (count + 1,) and elements."""
    count = touch.shape[0]
    few = np.diff(touch.indptr) < LEAST_ELEMENTS
    around = touch[few] @ touch.T @ touch
    place = (np.flatnonzero(few), np.arange(few.sum()))
    spread = csr_matrix((np.ones(few.sum()), place), (count, few.sum()))
    patch = (diags((~few).astype(float)) @ touch + spread @ around).tocsr()
    patch.eliminate_zeros()
    patch.sort_indices()
    return patch.indptr, patch.indices


def averaged_stress(body: MeshedBody, displacement: np.ndarray) -> np.ndarray:
    """sx, sz, txz (k, …, 3) [Pa] at the `stress_nodes` of a displacement (n, …, 2) [m]: the mean of
    the elements around them, in which stresses are taken for linear."""
    nodes, shape = stress_nodes(body), displacement.shape[1:-1]
    triangles, size = nodes.triangles, int(np.prod(shape)) * 3
    total = np.zeros((len(nodes.point), size))
    for start in range(0, len(triangles), ELEMENTS):
        element = np.arange(start, min(start + ELEMENTS, len(triangles)))
        corner = _stress(body, element, displacement[body.elements[element]], VERTICES)
        stress = np.concatenate(
            [corner, 0.5 * (corner[:, EDGES[:, 0]] + corner[:, EDGES[:, 1]])], 1
        )
        node = triangles[element].ravel()
        low, high = node.min(), node.max() + 1
        for column, value in enumerate(stress.reshape(len(node), size).T):
            total[low:high, column] += np.bincount(node - low, value, high - low)
    total /= np.bincount(triangles.ravel(), minlength=len(total))[:, None]
    return total.reshape(len(total), *shape, 3)


def recovered_stress(
    body: MeshedBody, displacement: np.ndarray, load: SurfaceLoad | None = None
) -> np.ndarray:
    """sx, sz, txz (k, 3) [Pa] at the body's `stress_nodes` of a displacement (n, 2) [m]. `load`
    gives the tractions on the surface; None: no samples there."""
    recovery = Recovery(body, displacement, load)
    return recovery.at(np.arange(len(recovery.known)))


class Recovery:
    """Recovered stresses at those stress nodes that are asked for, each computed once.

    displacement  (n, …, 2) [m], load as for `recovered_stress`; one, or (n, c, 2) and a load of c
                  friction coefficients: what depends on the mesh and on points is shared
    known         (k,) at which nodes the stresses are known
    """

    def __init__(
        self, body: MeshedBody, displacement: np.ndarray, load: SurfaceLoad | None = None
    ) -> None:
        self.body, self.displacement, self.load = body, displacement, load
        self.nodes = stress_nodes(body)
        self.known = np.zeros(len(self.nodes.point), dtype=bool)
        self._stress = np.empty((len(self.known), *displacement.shape[1:-1], 3))

    def at(self, node: np.ndarray) -> np.ndarray:
        """sx, sz, txz (q, …, 3) [Pa] at stress nodes (q,), of any shape."""
        new = np.unique(node[~self.known[node]])
        if len(new) > PIECE:
            new = new[np.argsort(self.body.points[self.nodes.point[new], 0])]
        for piece in range(0, len(new), PIECE):
            wanted = np.zeros(len(self.known), dtype=bool)
            wanted[new[piece : piece + PIECE]] = True
            self._recover(patches_of(self.body).of(wanted))
        return self._stress.take(node, axis=0)  # of rows a tenth of the time of an index

    def _recover(self, patches: Patches) -> None:
        body, load, displacement = self.body, self.load, self.displacement
        points, shape = body.points.take(self.nodes.point, axis=0), self._stress.shape[1:]
        sampled = SAMPLED[body.degree]
        held, which = np.unique(patches.element, return_inverse=True)
        corner = body.points.take(body.mesh.triangles.take(held, axis=0), axis=0)
        place = np.einsum("mac,qa->mqc", corner, shapes(sampled), optimize=True)
        centre, patch = points.take(patches.vertex, axis=0), patches.patch
        first = patches.start[:-1]
        offset = place.take(which, axis=0) - centre.take(patch, axis=0)[:, None]
        count = np.diff(patches.start) * len(sampled)
        radius = np.sqrt(np.add.reduceat((offset**2).sum(axis=(1, 2)), first) / count)
        moved = displacement.take(body.elements.take(held, axis=0), axis=0)
        stress = _stress(body, held, moved, sampled).take(which, axis=0)
        if load is not None:
            seen = patches.coated == body.coated.any()
            weights = load.kinks.weights(centre, radius, seen)
            near = _NearKinks(body, load.kinks, weights, patches, points)
            near.subtract_from(stress, sampled)

        def sums(patch: np.ndarray, offset: np.ndarray, stress: np.ndarray) -> np.ndarray:
            """Over each patch, of products of a polynomial's terms with these and with stresses."""
            terms = monomials(offset / radius[patch][:, None, None], body.degree)
            both = np.concatenate([terms, stress.reshape(*terms.shape[:2], -1)], axis=-1)
            product = terms.transpose(0, 2, 1) @ both
            onto = matrix_of(np.ones(1), patch, np.arange(len(patch)), (len(centre), len(patch)))
            return (onto @ product.reshape(len(patch), -1)).reshape(-1, *product.shape[1:])

        fitted = sums(patch, offset, stress)
        if load is not None and len(patches.beside):
            patch, place, stress = near.surface_samples(load, displacement)
            fitted += SURFACE_WEIGHT * sums(patch, place - centre[patch][:, None], stress)
        moments, fitted = np.split(fitted, [fitted.shape[1]], axis=-1)
        curved = np.arange(3, moments.shape[-1])
        moments[:, curved, curved] += RIDGE * count[:, None]
        fit = np.linalg.solve(moments, fitted)

        middle = points.take(patches.middle, axis=0)[:, None]
        offset = middle - centre.take(patches.ends, axis=0)
        terms = monomials(offset / radius[patches.ends][..., None], body.degree)
        at_vertex = fit[:, 0].reshape(-1, *shape)
        ends = fit.take(patches.ends, axis=0)
        at_middle = (terms[:, :, None] @ ends)[:, :, 0].reshape(-1, 2, *shape)
        if load is not None:
            at_vertex = at_vertex + near.at(np.arange(len(centre)), patches.vertex)
            ends, middle = patches.ends.ravel(), np.repeat(patches.middle, 2)
            at_middle = at_middle + near.at(ends, middle).reshape(at_middle.shape)
        self._stress[patches.vertex] = at_vertex
        self._stress[patches.middle] = np.einsum("ek,ek...->e...", patches.shares, at_middle)
        self.known[patches.vertex] = self.known[patches.middle] = True


@dataclass(frozen=True)
class _NearKinks:
    """The kinks near each patch: stresses to subtract from its samples and to add to its fit."""

    body: MeshedBody
    kinks: Kinks
    weights: Weights
    patches: Patches
    points: np.ndarray

    def subtract_from(self, stress: np.ndarray, sampled: np.ndarray) -> None:
        """Take the stress of the kinks' interpolated displacement off sx, sz, txz (p, q, …, 3)."""
        near = np.flatnonzero(self.weights.count[self.patches.patch])
        element = self.patches.element[near]
        node = self.body.elements.take(element, axis=0)
        moved = self._displacement(self.patches.patch[near], node)
        stress[near] -= _stress(self.body, element, moved, sampled)

    def surface_samples(
        self, load: SurfaceLoad, displacement: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Patch (s,), point (s, q, 2), stress without kinks (s, q, …, 3) on the surface's edges."""
        body, (patch, edge) = self.body, self.patches.beside.T
        point = body.top.point[2 * edge[:, None] + np.arange(3)]
        node = body.surface.point[body.degree * edge[:, None] + np.arange(body.degree + 1)]
        at, _ = np.polynomial.legendre.leggauss(body.degree)
        at = 0.5 * (1.0 + at)
        place = edge_shapes(at, 2) @ body.points[point]
        longer = edge_slopes(at, 2) @ body.points[point]
        moved = displacement[node] - self._displacement(patch, node)
        stretch = np.einsum("qk,sk...->sq...", edge_slopes(at, body.degree), moved)
        number = np.arange(place[..., 0].size).reshape(place.shape[:2])
        stress = self.kinks.stress(self.weights, patch, place.reshape(-1, 2), number)

        x = place[..., 0].ravel()
        single = *number.shape, *(1,) * (stress.ndim - 3), 2
        t, longer = load.tangent(x).reshape(single), longer.reshape(single)
        s_nn, s_nt = (s.reshape(stress.shape[:-1]) for s in load.across(x))
        _, kinks_nn, kinks_nt = to_surface(t, stress)
        s_nn, s_nt = s_nn - kinks_nn, s_nt - kinks_nt
        material = body.surface_material
        nu = material.poissons_ratio
        e_tt = (stretch * longer).sum(-1) / (longer**2).sum(-1)
        s_tt = material.plane_strain_modulus * e_tt + nu / (1.0 - nu) * s_nn
        return patch, place, from_surface(t, s_tt, s_nn, s_nt)

    def at(self, patch: np.ndarray, node: np.ndarray) -> np.ndarray:
        """sx, sz, txz (r, …, 3) at stress nodes (r,), of the kinks near the patches (r,)."""
        return self.kinks.stress(self.weights, patch, self.points, node[:, None])[:, 0]

    def _displacement(self, patch: np.ndarray, node: np.ndarray) -> np.ndarray:
        """u_x, u_z (r, k, …, 2) of the kinks near each patch (r,) at nodes (r, k) of the body."""
        body, count = self.body, len(self.body.nodes)
        pair, which = np.unique(patch[:, None] * count + node, return_inverse=True)
        patch, point = np.divmod(pair, count)
        nu, shear = body.surface_material.poissons_ratio, body.surface_material.shear_modulus
        moved = self.kinks.displacement(self.weights, patch, body.nodes, point[:, None], nu)
        return moved[:, 0].take(which.reshape(node.shape), axis=0) / shear


def _stress(body: MeshedBody, element: np.ndarray, moved: np.ndarray, at: np.ndarray) -> np.ndarray:
    """sx, sz, txz (r, q, …, 3) [Pa] in elements (r,) from nodal displacements (r, k, …, 2)."""
    corner = body.points.take(body.mesh.triangles.take(element, axis=0), axis=0)
    flat = moved.reshape(*moved.shape[:2], int(np.prod(moved.shape[2:])))
    slope = gradients(corner, flat, at, straight=not body.curved)
    slope = slope.reshape(len(moved), len(at), *moved.shape[2:], 2)
    shear, lame = (
        value[element].reshape(-1, *(1,) * (slope.ndim - 3))
        for value in (body.shear_modulus, body.lame)
    )
    return linear_stress(slope, shear, lame)


def linear_stress(slope: np.ndarray, shear: np.ndarray, lame: np.ndarray) -> np.ndarray:
    """sx, sz, txz (..., 3) [Pa] of displacement gradients (..., 2, 2), by Lame's constants [Pa]."""
    exx, ezz = slope[..., 0, 0], slope[..., 1, 1]
    pressure = lame * (exx + ezz)
    twist = shear * (slope[..., 0, 1] + slope[..., 1, 0])
    return np.stack([pressure + 2.0 * shear * exx, pressure + 2.0 * shear * ezz, twist], axis=-1)
