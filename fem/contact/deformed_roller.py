"""Contact of two deformed bodies: the rough body's hats against the roller's current surface.

    g_i = integral phi_i (z + r(x)) dX,   (x, z) = (X + u_x, Z + u_z)
    T p = integral p dg/du dX    on both bodies

r(x) is the height of the roller's deformed surface in the roller's own frame (x as the rough
body's, z into the roller), at the x where the point of the rough body is now. On an edge of
the roller (x, r) = sum M_a(t) (x_a, r_a), and

    dg = dz + sum M_a dr_a + s (dx - sum M_a dx_a),   s = dr/dx.

Forces at a point act on both bodies at the same point and against each other: p (s, 1) per
undeformed length of the rough body, with friction towards +x along the common tangent (1, -s) on
it. p is the pressure's vertical force per undeformed length of x of the rough body.

The slope of quadratic edges jumps at their ends by the order of their length squared. Forces follow
instead the line through the slopes in the middle of neighbouring edges, of the same order and
without jumps; Newton's method would not settle where a point under a hat crosses such an end. The
gap itself and the points of forces are the edges' own: constant pressures between conforming
bodies stay exact. The tangent leaves the jumps out too and is symmetric without friction. The
integrals are cut where edges of either body end: across the ends of the roller's the pressure
would oscillate by 0.15 % of its peak, whatever the size of the elements.

Nomenclature: X, Z point of the undeformed rough body [m], u displacement [m], p hat pressures [Pa],
phi_i hats, N and M_a shape functions of the rough body's surface and of the roller's."""

import numpy as np
from scipy.sparse import block_diag, csr_matrix, diags

from fem.body.elasticity import ElasticBody
from fem.body.sums import matrix_of
from fem.body.surface import along_edges, hat_points, place_on
from fem.body.triangle import edge_shapes, edge_slopes
from fem.contact.rigid_roller import HatsOnSurface
from fem.contact.terms import ContactTerms, Response
from fem.solver.mumps import FemError


class TwoBodies:
    """The responses of the rough body and the roller as one: displacements (n, 2) of the rough
    body's nodes, then those of the roller's, each in its own frame. `moduli` are Young's [Pa]."""

    def __init__(self, rough: Response, roller: Response, moduli: tuple[float, float]) -> None:
        self.parts = (rough, roller)
        self.held = np.vstack([rough.held, roller.held])
        self.symmetric = rough.symmetric and roller.symmetric
        soft = [
            np.full(2 * len(part.held), 1.0 / e) for part, e in zip(self.parts, moduli, strict=True)
        ]
        self.softness = min(moduli) * np.concatenate(soft)

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        """See `fem.contact.terms.Response`."""
        pieces = zip(self.parts, self._split(displacement), strict=True)
        forces, tangents = zip(*(part.linearised(u) for part, u in pieces), strict=True)
        return np.vstack(forces), block_diag(tangents, format="csr")

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """Internal forces (n, 2) [N/m] alone."""
        pieces = zip(self.parts, self._split(displacement), strict=True)
        return np.vstack([part.force(u) for part, u in pieces])

    def accept(self, displacement: np.ndarray) -> None:
        """Both bodies accept their own."""
        for part, u in zip(self.parts, self._split(displacement), strict=True):
            part.accept(u)

    def _split(self, displacement: np.ndarray) -> list[np.ndarray]:
        return np.split(displacement, [len(self.parts[0].held)])


class DeformedSurface:
    """The current surface of a body whose displacements are quadratic. Raises FemError where x no
    longer ascends along it, and for x beyond its ends."""

    def __init__(self, body: ElasticBody, displacement: np.ndarray) -> None:
        self.x, self.z = (body.nodes + displacement)[body.surface.point].T
        if body.surface.degree != 2 or not np.all(np.diff(self.x) > 0.0):
            raise FemError("a surface folds")
        self.edges = np.column_stack([self.x[:-1:2], self.x[1::2], self.x[2::2]])
        self.middle = self.x[1::2]
        self.chord = np.diff(self.z[::2]) / np.diff(self.x[::2])

    def edge(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Numbers (k,) of the edges below points x (k,) [m], and where on them, 0 to 1."""
        if np.any((x < self.x[0]) | (x > self.x[-1])):
            raise FemError("the contact reaches beyond the end of a body's surface")
        edge = np.searchsorted(self.x[2:-1:2], x)
        return edge, place_on(self.edges[edge], x)

    def on_edges(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The edges' nodes (3, k) among the surface's and their shape functions at x (k,) [m]."""
        edge, t = self.edge(x)
        return 2 * edge + np.arange(3)[:, None], edge_shapes(t).T

    def __call__(
        self, x: np.ndarray, on: tuple[np.ndarray, np.ndarray] | None = None
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """r [m], its slope without jumps, and that one's [1/m], at x (k,) [m] `on` the edges."""
        node, shape = on or self.on_edges(x)
        rise = np.einsum("ak,ak->k", shape, self.z[node])
        before = np.clip(np.searchsorted(self.middle, x) - 1, 0, len(self.middle) - 2)
        bend = np.diff(self.chord)[before] / np.diff(self.middle)[before]
        return rise, self.chord[before] + bend * (x - self.middle[before]), bend


class PairContact:
    """Contact of a rough body with an elastic roller, on the hats (count + 2,) [m] of the
    undeformed rough body; displacements as of `TwoBodies`. ValueError: a hat leaves the surface."""

    def __init__(
        self, body: ElasticBody, hats: np.ndarray, roller: ElasticBody, friction: float = 0.0
    ) -> None:
        self.frictionless, self._friction, self._roller = not friction, friction, roller
        self._first, self._count = len(body.nodes), len(body.nodes) + len(roller.nodes)
        self._body, self._hats = body, hats
        self._undeformed = np.vstack([body.nodes, roller.nodes])

    def loaded(
        self, displacement: np.ndarray, pressure: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """The gap (count,) [m^2] and the nodal forces (2n,) [N/m] of `at` alone: cheaper."""
        under, (_, z), (node, part), (rise, slope, _), deformed, surface = self._met(displacement)
        column, hat = under.column + 1, under.hat * under.weight  # with the feet, which bear none
        load = np.einsum("he,heg->eg", np.pad(pressure, 1)[column], hat)
        opening = np.einsum("heg,eg->he", hat, z + rise)
        gap = np.bincount(column.ravel(), opening.ravel(), len(self._hats))
        force = np.zeros((self._count, 2))
        along, down = load * (slope + self._friction), load * (1.0 - self._friction * slope)
        for axis, value, back in ((0, along, -along), (1, down, down)):
            on_body = np.einsum("aeg,eg->ae", under.shape, value)
            force[self._body.surface.point, axis] = np.bincount(
                under.node.ravel(), on_body.ravel(), len(deformed.x)
            )
            force[self._first + self._roller.surface.point, axis] = np.bincount(
                node.ravel(), (part * back.ravel()).ravel(), len(surface.x)
            )
        return gap[1:-1], force.ravel()

    def on_body(self, displacement: np.ndarray, pressure: np.ndarray) -> ContactTerms:
        """Rows and columns of `at` for the rough body: as if the roller stayed as it is."""
        under, (_, z), _, (rise, slope, bend), _, _ = self._met(displacement)
        count, size, one = len(self._hats), 2 * self._first, np.ones_like(slope)
        column, hat = under.column + 1, under.hat * under.weight
        gap = np.bincount(column.ravel(), (hat * (z + rise)).sum(-1).ravel(), count)[1:-1]
        node = self._body.surface.point[under.node]
        row = 2 * node[:, None, None] + np.arange(2)[:, None, None]

        def forces(*along: np.ndarray) -> csr_matrix:
            value = np.einsum("aeg,ceg,heg->ache", under.shape, np.stack(along), hat)
            return matrix_of(value, row, column, (size, count))[:, 1:-1]

        gradient = force = forces(slope, one)
        if not self.frictionless:
            force = forces(slope + self._friction, one - self._friction * slope)
        load = (np.pad(pressure, 1)[column][..., None] * hat).sum(0) * bend
        turning = np.einsum("aeg,eg,beg->abe", under.shape, load, under.shape)[:, None]
        turning = turning * np.array([1.0, -self._friction])[:, None, None]
        stiffness = matrix_of(turning, row, 2 * node, (size, size))
        return ContactTerms(gap, gradient, force, stiffness)

    def at(self, displacement: np.ndarray, pressure: np.ndarray) -> ContactTerms:
        """Terms as of `fem.contact.terms.Contact`, on both deformed surfaces."""
        surface, cuts, _ = self._surfaces(displacement)
        on = HatsOnSurface(self._body, self._hats, self._count, cuts)
        place = (self._undeformed + displacement).ravel()
        x = on.x @ place
        rise, slope, bend = surface(x)
        gap = on.hats.T @ (on.weight * (on.z @ place + rise))

        edge, t = surface.edge(x)
        node, weighted = 2 * edge[:, None] + np.arange(3), on.weighted
        at_x, at_z = self._of_roller(node, edge_shapes(t))
        along, down = on.x - at_x, on.z + at_z
        force = gradient = (along.T @ diags(slope) @ weighted + down.T @ weighted).tocsr()
        value = edge_slopes(t)
        turn = value / (value * surface.x[node]).sum(axis=1)[:, None]  # dM/dx
        turn_x, turn_z = self._of_roller(node, turn)
        load = diags(on.weight * (on.hats @ pressure))
        turning = turn_z - diags(slope) @ turn_x
        mixed = turning.T @ load @ along
        stiffness = along.T @ (load @ diags(bend)) @ along + mixed + mixed.T
        if not self.frictionless:
            sliding = along.T @ weighted - down.T @ diags(slope) @ weighted
            force = gradient + self._friction * sliding
            slides = turn_x.T @ load @ along + turn_z.T @ (load @ diags(slope)) @ along
            slides = slides + down.T @ load @ (turning + diags(bend) @ along)
            stiffness = stiffness - self._friction * slides
        return ContactTerms(gap, gradient, force.tocsr(), stiffness.tocsr())

    def _met(self, displacement: np.ndarray) -> tuple:
        """Points under hats, their x and z [m], nodes and shape functions of the roller's edges,
        its height, slope and bend there; the surfaces of both."""
        surface, cuts, deformed = self._surfaces(displacement)
        under = hat_points(self._body.surface, self._hats, cuts)
        place = deformed.x[under.node], deformed.z[under.node]
        x, z = (np.einsum("aeg,ae->eg", under.shape, at) for at in place)
        on = surface.on_edges(x.ravel())
        opposite = [array.reshape(x.shape) for array in surface(x.ravel(), on)]
        return under, (x, z), on, opposite, deformed, surface

    def _surfaces(
        self, displacement: np.ndarray
    ) -> tuple[DeformedSurface, np.ndarray, DeformedSurface]:
        """The roller's, where its edges end on the undeformed rough body's, x [m], and that one."""
        surface = DeformedSurface(self._roller, displacement[self._first :])
        deformed = DeformedSurface(self._body, displacement[: self._first])
        below = surface.x[::2][(surface.x[::2] > deformed.x[0]) & (surface.x[::2] < deformed.x[-1])]
        return surface, along_edges(self._body.surface.edges, *deformed.edge(below)), deformed

    def _of_roller(self, node: np.ndarray, value: np.ndarray) -> list[csr_matrix]:
        """Rows (q, 2n): x, z at points under hats from surface nodes (q, 3) by factors (q, 3)."""
        number = self._first + self._roller.surface.point[node]
        row, shape = np.arange(len(node))[:, None], (len(node), 2 * self._count)
        return [matrix_of(value, row, 2 * number + axis, shape) for axis in (0, 1)]
