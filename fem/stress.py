"""Stresses of a solved body at its nodes and at any point.

Nomenclature at the surface
    t, n          unit tangent towards +x and unit normal out of the body
    s_nn, s_nt    normal and shear stress on the surface, known from the tractions
    s_tt          stress along the surface, E' e_tt + nu / (1 - nu) s_nn
"""

from collections.abc import Callable

import numpy as np

from analytic.plane_stress import PlaneStress
from fem.elasticity import ElasticBody
from fem.recovery import recovered_stress
from fem.surface import Direction, straight_down, tangent_of
from fem.triangle import shapes


def nodal_stress(
    body: ElasticBody,
    displacement: np.ndarray,
    pressure_at: Callable[[np.ndarray], np.ndarray],
    friction: float = 0.0,
    direction: Direction = straight_down,
) -> PlaneStress:
    """Stresses at all mesh points under a displacement (n, 2) [m].

    `pressure_at`(x [m]) gives the pressure [Pa] that causes it, `friction` times that the sliding
    traction towards +x; both act along `direction` as in `fem.compliance`. They make the stresses
    at the surface: on a flat one sz = -p and txz = -friction p exactly, and on a rough one the
    same holds on its inclined faces. What is left there is the stress along the surface, from the
    surface's stretch. Inside by patch recovery (`fem.recovery`).
    """
    stress = recovered_stress(body, displacement)
    point = body.surface.point
    stress[point] = _surface_stress(body, displacement[point], pressure_at, friction, direction)
    return PlaneStress(*stress.T)


def evaluate(body: ElasticBody, nodal: PlaneStress, x: np.ndarray, z: np.ndarray) -> PlaneStress:
    """Stresses [Pa] at points x, z [m] of any shape, broadcast together; NaN outside."""
    x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
    element, at = body.locator(np.column_stack([x.ravel(), z.ravel()]))
    inside = element >= 0
    node, share = body.mesh.triangles[element[inside]], shapes(at[inside])
    found = np.full((3, x.size), np.nan)
    for row, stress in zip(found, (nodal.sx, nodal.sz, nodal.txz), strict=True):
        row[inside] = (stress[node] * share).sum(axis=1)
    return PlaneStress(*found.reshape(3, *x.shape))


def _surface_stress(
    body: ElasticBody,
    displacement: np.ndarray,
    pressure_at: Callable[[np.ndarray], np.ndarray],
    friction: float,
    direction: Direction,
) -> np.ndarray:
    """sx, sz, txz (k, 3) at the surface's nodes, from the tractions and the stretch there."""
    x = body.surface.x
    rise = along_surface(x, body.points[body.surface.point, 1])
    longer = np.hypot(1.0, rise)
    t = np.column_stack([np.ones_like(rise), rise]) / longer[:, None]
    n = np.column_stack([rise, -np.ones_like(rise)]) / longer[:, None]

    down = np.stack(direction(x), axis=-1)
    along = np.stack(tangent_of(direction)(x), axis=-1)
    traction = (pressure_at(x) / longer)[:, None] * (down + friction * along)
    s_nn, s_nt = (traction * n).sum(-1), (traction * t).sum(-1)
    e_tt = (along_surface(x, displacement) * t).sum(-1) / longer
    nu, modulus = body.material.poissons_ratio, body.material.plane_strain_modulus
    s_tt = modulus * e_tt + nu / (1.0 - nu) * s_nn

    def component(i: int, j: int) -> np.ndarray:
        mixed = t[:, i] * n[:, j] + n[:, i] * t[:, j]
        return s_tt * t[:, i] * t[:, j] + s_nn * n[:, i] * n[:, j] + s_nt * mixed

    return np.column_stack([component(0, 0), component(1, 1), component(0, 1)])


def along_surface(x: np.ndarray, value: np.ndarray) -> np.ndarray:
    """d value / dx of `value` (k,) or (k, 2) at the nodes of quadratic edges, a vertex first.

    At midpoints the chord's slope, more accurate than the quadratic's own at its ends; at
    vertices the line through the slopes of the two nearest midpoints.
    """
    columns = value.reshape(len(x), -1)
    vertex, middle = x[::2], x[1::2]
    chord = np.diff(columns[::2], axis=0) / np.diff(vertex)[:, None]
    after = np.clip(np.arange(len(vertex)), 1, len(middle) - 1)
    before = after - 1
    share = ((vertex - middle[before]) / (middle[after] - middle[before]))[:, None]
    slope = np.empty_like(columns)
    slope[1::2] = chord
    slope[::2] = (1.0 - share) * chord[before] + share * chord[after]
    return slope.reshape(value.shape)
