"""Stresses of a solved body at its nodes and at any point."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.sparse import csr_matrix

from analytic.stress_state import StressState
from fem.body.elasticity import MeshedBody
from fem.body.triangle import shapes
from fem.stress.kinks import Kinks
from fem.stress.recovery import (
    MaterialStress,
    Patches,
    Recovery,
    StressNodes,
    averaged_stress,
    stress_nodes,
)
from fem.stress.surface_load import SurfaceLoad, from_surface, tangent_on, to_surface

Beside = Callable[[np.ndarray, np.ndarray], Sequence[StressState]]


@dataclass(frozen=True)
class FurtherStress:
    """c stresses `of` x and depth [m] [Pa], along a `surface` z(x) [m], not in the displacement."""

    surface: CubicSpline
    of: Beside

    def at(self, place: np.ndarray) -> np.ndarray:
        """sx, sz, txz (…, c, 3) [Pa] at points (…, 2) [m]."""
        x, z = place.reshape(-1, 2).T
        states = self.of(x, np.maximum(z - self.surface(x), 0.0))
        along = np.array([[state.sx, state.sz, -state.txz] for state in states]).T  # (n, 3, c)
        near, turned = np.flatnonzero(along.any(axis=(1, 2))), np.zeros((len(x), len(states), 3))
        t = tangent_on(self.surface, x[near])[:, None]
        turned[near] = from_surface(t, *np.moveaxis(along[near], 1, 0))
        return turned.reshape(*place.shape[:-1], *turned.shape[1:])


@dataclass(frozen=True)
class NodalStress:
    """Stresses at the nodes of a body, and what interpolates them; c of them on a further axis."""

    nodes: StressNodes  # their mesh points, and the nodes of each triangle
    poissons_ratio: np.ndarray  # (k,) at the nodes
    # sx, sz, txz (…, 3) [Pa] at nodes (…); computed where they are first asked for
    at: Callable[[np.ndarray], np.ndarray]
    # sx, sz, txz (k, 3) [Pa] at all nodes, cheap and rough: where to ask
    estimate: Callable[[], np.ndarray]
    kinks: Kinks | None = None  # of the pressure; None: stresses are quadratic in every element
    further: FurtherStress | None = None  # that the nodes have already
    # with those of other friction coefficients, and which of them this is
    together: tuple["NodalStress", int] | None = None
    # (n, c, 2) [m] that they are recovered from, where they are known together
    displacement: np.ndarray | None = None

    @cached_property
    def values(self) -> np.ndarray:
        """sx, sz, txz (k, 3) [Pa]."""
        return self.at(np.arange(len(self.nodes.point)))

    @property
    def stress(self) -> MaterialStress:
        """(k,) [Pa], with Poisson's ratio."""
        return MaterialStress(*self.values.T, self.poissons_ratio)

    def plus(self, values: np.ndarray) -> "NodalStress":
        """Add further sx, sz, txz (k, 3) [Pa], quadratic between the nodes."""
        return replace(
            self,
            at=lambda node: self.at(node) + values[node],
            estimate=lambda: self.estimate() + values,
            together=None,
        )


def nodal_stresses(
    displacement: np.ndarray, load: SurfaceLoad, beside: Beside | None = None
) -> tuple[NodalStress, ...]:
    """Stresses under the displacements (n, c, 2) [m] due to a load's pressure and its sliding
    traction, one for each of c friction coefficients: together they cost little more than one.

    The load gives the stresses across the surface: on a flat one sz = -p and txz = -friction p
    exactly. The stress along the surface and all stresses below it are recovered from the
    displacement (`fem.stress.recovery`). `beside` gives what the hats leave out of the c stresses
    [Pa] of the pressure that they stand for, at x [m] and depths [m] below the surface."""
    further = beside and FurtherStress(load.surface, beside)
    recovery = _LoadedRecovery(displacement, load, further)
    shape = recovery.nodes, recovery.nodes.of_triangles(load.body.poissons_ratio)
    every = NodalStress(
        *shape,
        recovery.at,
        lambda: recovery.estimate,
        load.kinks,
        further,
        displacement=displacement,
    )

    def of(column: int) -> NodalStress:
        one = slice(column, column + 1)
        return NodalStress(
            *shape,
            lambda node: recovery.at(node)[..., column, :],
            lambda: recovery.estimate[:, column],
            replace(load.kinks, jump=load.kinks.jump[:, column]),
            beside and FurtherStress(load.surface, lambda x, z: beside(x, z)[one]),
            (every, column),
        )

    return tuple(map(of, range(displacement.shape[1])))


class _LoadedRecovery(Recovery):
    """Recovered stresses with the load's own across the surface, and what is further."""

    def __init__(
        self, displacement: np.ndarray, load: SurfaceLoad, further: FurtherStress | None
    ) -> None:
        super().__init__(load.body, displacement, load)
        self.further = further
        top = load.body.top
        self._x = np.full(len(self.known), np.nan)  # of the nodes on the surface
        self._x[self.nodes.at_surface(top.point)] = top.x

    @cached_property
    def estimate(self) -> np.ndarray:
        """Means (k, c, 3) [Pa] at the nodes of the stresses in the elements around them."""
        return averaged_stress(self.body, self.displacement)

    def _recover(self, patches: Patches) -> None:
        super()._recover(patches)
        node = np.concatenate([patches.vertex, patches.middle])
        top = node[~np.isnan(self._x[node])]
        t = self.load.tangent(self._x[top])[:, None]
        s_tt, _, _ = to_surface(t, self._stress[top])
        self._stress[top] = from_surface(t, s_tt, *self.load.across(self._x[top]))
        if self.further is not None:
            self._stress[node] += self.further.at(self.body.points[self.nodes.point[node]])


def at_nodes(body: MeshedBody, stress: StressState) -> NodalStress:
    """Stresses from those at the `stress_nodes` (k,), quadratic between them."""
    values = np.column_stack([stress.sx, stress.sz, stress.txz])
    nodes = stress_nodes(body)
    nu = nodes.of_triangles(body.poissons_ratio)
    return NodalStress(nodes, nu, values.__getitem__, lambda: values)


def evaluate(body: MeshedBody, nodal: NodalStress, x: np.ndarray, z: np.ndarray) -> StressState:
    """Stresses [Pa] at points x, z [m] of any shape, broadcast together; NaN outside."""
    return evaluate_all(body, (nodal,), x, z)[0]


def evaluate_all(
    body: MeshedBody, nodal: Sequence[NodalStress], x: np.ndarray, z: np.ndarray
) -> list[StressState]:
    """Several stresses at the same points, evaluated at once where they are known together."""
    x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
    element, at = body.locator(np.column_stack([x.ravel(), z.ravel()]))
    inside, fields, known = element >= 0, [], {}
    for recovered in nodal:
        every, column = recovered.together or (recovered, ...)
        if id(every) not in known:
            known[id(every)] = within(body, every, element[inside], at[inside, None])[:, 0]
        values = np.full((3, x.size), np.nan)
        values[:, inside] = known[id(every)][:, column].T
        fields.append(StressState(*values.reshape(3, *x.shape)))
    return fields


def within(body: MeshedBody, nodal: NodalStress, element: np.ndarray, at: np.ndarray) -> np.ndarray:
    """sx, sz, txz (r, q, …, 3) [Pa] in elements (r,) at reference points `at` (q, 2) or (r, q, 2).
    Quadratic between the nodes, plus the difference between the stress of the kinks near the
    element, and of what is further, and its quadratic interpolation."""
    share = np.broadcast_to(shapes(at), (len(element), at.shape[-2], 6))
    held, which = np.unique(element, return_inverse=True)
    value = nodal.at(nodal.nodes.triangles.take(held, axis=0))
    number = np.arange(share.size // 6).reshape(share.shape[:2])
    node = np.broadcast_to(6 * which[:, None, None] + np.arange(6), share.shape)
    rows = share.ravel(), node.ravel(), 6 * np.arange(number.size + 1)
    interpolation = csr_matrix(rows, (number.size, 6 * len(held)))

    def between(at_nodes: np.ndarray) -> np.ndarray:
        """(r, q, …) of values (h, 6, …) in the elements that are held."""
        found = interpolation @ at_nodes.reshape(6 * len(held), -1)
        return found.reshape(*number.shape, *at_nodes.shape[2:])

    if nodal.kinks is None:
        return between(value)
    triangles = body.mesh.triangles.take(held, axis=0)
    nodes = body.points.take(triangles, axis=0)
    centre = nodes[:, :3].mean(axis=1)
    radius = np.sqrt(((nodes[:, :3] - centre[:, None]) ** 2).sum(axis=2).mean(axis=1))
    seen = body.coated[held] == body.coated.any()
    weights, place = nodal.kinks.weights(centre, radius, seen), between(nodes)
    value = value - nodal.kinks.stress(weights, np.arange(len(held)), body.points, triangles)
    if nodal.further is not None:
        value -= nodal.further.at(nodes).reshape(value.shape)
    values = between(value) + nodal.kinks.stress(weights, which, place.reshape(-1, 2), number)
    if nodal.further is not None:
        values += nodal.further.at(place).reshape(values.shape)
    return values
