"""Stresses of a solved body at its nodes and at any point."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from analytic.stress_state import StressState
from fem.body.elasticity import ElasticBody
from fem.body.surface import Direction, straight_down
from fem.body.triangle import shapes
from fem.stress.kinks import Kinks
from fem.stress.recovery import MaterialStress, StressNodes, recovered_stress, stress_nodes
from fem.stress.surface_load import SurfaceLoad, from_surface, tangent_on, to_surface

Beside = Callable[[np.ndarray, np.ndarray], StressState]


@dataclass(frozen=True)
class FurtherStress:
    """Stresses `of` x and depth [m] [Pa], along and across a `surface` z(x) [m], which the body's
    displacement does not have."""

    surface: CubicSpline
    of: Beside

    def at(self, place: np.ndarray) -> np.ndarray:
        """sx, sz, txz (…, 3) [Pa] at places (…, 2) [m]."""
        flat = place.reshape(-1, 2)
        x = flat[:, 0]
        own = self.of(x, np.maximum(flat[:, 1] - self.surface(x), 0.0))
        found = from_surface(tangent_on(self.surface, x), own.sx, own.sz, -own.txz)
        return found.reshape(*place.shape[:-1], 3)


@dataclass(frozen=True)
class NodalStress:
    """Stresses at the nodes of a body, and what interpolates them."""

    stress: MaterialStress  # (k,) at the nodes [Pa], with Poisson's ratio there
    nodes: StressNodes  # their mesh points, and the nodes of each triangle
    kinks: Kinks | None = None  # of the pressure; None: stresses are quadratic in every element
    further: FurtherStress | None = None  # that the nodes have already

    @cached_property
    def values(self) -> np.ndarray:
        """sx, sz, txz (k, 3) [Pa]."""
        return np.column_stack([self.stress.sx, self.stress.sz, self.stress.txz])


def nodal_stress(
    body: ElasticBody,
    displacement: np.ndarray,
    hats: np.ndarray,
    pressure: np.ndarray,
    friction: float = 0.0,
    direction: Direction = straight_down,
    beside: Beside | None = None,
) -> NodalStress:
    """Stresses under the displacement (n, 2) [m] due to a pressure and its sliding traction.

    `pressure` (count,) [Pa], `hats`, `friction` and `direction` as in `fem.compliance.operator`.
    They give the stresses across the surface: on a flat one sz = -p and txz = -friction p exactly.
    The stress along the surface and all stresses below it are recovered from the displacement
    (`fem.stress.recovery`). `beside` gives what the hats leave out of the stresses [Pa] of the
    pressure that they stand for, at x [m] and depths [m] below the surface.
    """
    nodes = stress_nodes(body)
    load = SurfaceLoad(body, hats, pressure, friction, direction)
    values = recovered_stress(body, displacement, load)
    top, x = nodes.at_surface(body.top.point), body.top.x
    t = load.tangent(x)
    s_tt, _, _ = to_surface(t, values[top])
    values[top] = from_surface(t, s_tt, *load.across(x))
    further = None if beside is None else FurtherStress(load.surface, beside)
    if further is not None:
        values += further.at(body.points[nodes.point])
    return _nodal(body, StressState(*values.T), load.kinks, further)


def at_mesh_points(body: ElasticBody, stress: StressState) -> NodalStress:
    """Stresses of a plain body from those at the mesh's points (n,), quadratic between them."""
    if body.coated.any():
        raise ValueError("a coated body has two stresses at the points of its interface")
    return _nodal(body, stress)


def evaluate(body: ElasticBody, nodal: NodalStress, x: np.ndarray, z: np.ndarray) -> StressState:
    """Stresses [Pa] at points x, z [m] of any shape, broadcast together; NaN outside."""
    x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
    element, at = body.locator(np.column_stack([x.ravel(), z.ravel()]))
    inside = element >= 0
    found = np.full((3, x.size), np.nan)
    found[:, inside] = within(body, nodal, element[inside], at[inside, None])[:, 0].T
    return StressState(*found.reshape(3, *x.shape))


def within(
    body: ElasticBody, nodal: NodalStress, element: np.ndarray, at: np.ndarray
) -> np.ndarray:
    """sx, sz, txz (r, q, 3) [Pa] in elements (r,) at reference points `at` (q, 2) or (r, q, 2).

    Quadratic between the nodes, plus the difference between the stress of the kinks near the
    element, and of what is further, and its quadratic interpolation.
    """
    share = np.broadcast_to(shapes(at), (len(element), at.shape[-2], 6))
    held, which = np.unique(element, return_inverse=True)
    value = nodal.values[nodal.nodes.triangles[held]]
    if nodal.kinks is None:
        return share @ value[which]
    triangles = body.mesh.triangles[held]
    corner = body.points[triangles[:, :3]]
    centre = corner.mean(axis=1)
    radius = np.sqrt(((corner - centre[:, None]) ** 2).sum(axis=2).mean(axis=1))
    seen = body.coated[held] == body.coated.any()
    weights = nodal.kinks.weights(centre, radius, seen)
    every = np.arange(len(held))
    value = value - nodal.kinks.stress(weights, every, body.points, triangles)
    if nodal.further is not None:
        value -= nodal.further.at(body.points[triangles])
    place = np.einsum("rac,rqa->rqc", body.points[triangles[which]], share, optimize=True)
    number = np.arange(place.shape[0] * place.shape[1]).reshape(place.shape[:2])
    found = share @ value[which]
    found += nodal.kinks.stress(weights, which, place.reshape(-1, 2), number)
    return found if nodal.further is None else found + nodal.further.at(place)


def _nodal(
    body: ElasticBody,
    stress: StressState,
    kinks: Kinks | None = None,
    further: FurtherStress | None = None,
) -> NodalStress:
    """Stresses with Poisson's ratio of the material at each node."""
    nodes = stress_nodes(body)
    nu = np.empty(len(nodes.point))
    nu[nodes.triangles] = body.poissons_ratio[:, None]
    return NodalStress(MaterialStress(stress.sx, stress.sz, stress.txz, nu), nodes, kinks, further)
