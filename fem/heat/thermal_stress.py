"""Thermal stresses in plane strain, from temperatures on the mesh of an elastic body.

    stress = C : strain(u) - beta T I,   beta = E alpha / (1 - 2 nu)
    f_a = integral beta T grad N_a,      sy = nu (sx + sz) - (1 - 2 nu) beta T

(Boley and Weiner, Theory of Thermal Stresses, 1960, sections 3.3 and 4.3.) T is the rise above the
temperature without stresses [K], f the nodal forces under which u is the displacement, sy the
stress across the plane. Stresses are recovered from u like those of a pressure
(`fem.stress.recovery`); the surface bears none across it.
"""

import numpy as np
from scipy.interpolate import CubicSpline

from fem.body.elasticity import ElasticBody, MeshedBody
from fem.body.sums import nodal_sums
from fem.body.triangle import collapsed_gauss, jacobians, shapes, slopes
from fem.stress.recovery import recovered_stress, stress_nodes
from fem.stress.stress import NodalStress
from fem.stress.surface_load import from_surface, tangent_on, to_surface


def thermal_stress(
    body: ElasticBody, expansion: float | np.ndarray, temperature: np.ndarray
) -> tuple[NodalStress, np.ndarray]:
    """Stresses at the body's `stress_nodes` (k,), and sy (k,) [Pa] there, of a temperature (n,) [K]
    at the mesh's points, without other loads; `expansion` alpha [1/K] of the body, or (m,) of each
    triangle. Raises FemError if the body cannot be factored."""
    moved = body.solve(thermal_load(body, expansion, temperature))
    nodes, values = stress_nodes(body), recovered_stress(body, moved)
    nu = nodes.of_triangles(body.poissons_ratio)
    hydrostatic = nodes.of_triangles(_beta(body, expansion)) * temperature[nodes.point]
    values[:, :2] -= hydrostatic[:, None]
    top = nodes.at_surface(body.top.point)
    t = tangent_on(CubicSpline(body.top.x, body.points[body.top.point, 1]), body.top.x)
    along, _, _ = to_surface(t, values[top])
    values[top] = from_surface(t, along, 0.0 * along, 0.0 * along)
    across = nu * values[:, :2].sum(axis=1) - (1.0 - 2.0 * nu) * hydrostatic
    return NodalStress(nodes, nu, values.__getitem__, lambda: values), across


def thermal_load(
    body: MeshedBody, expansion: float | np.ndarray, temperature: np.ndarray
) -> np.ndarray:
    """Nodal forces (n, 2) [N/m] of a temperature [K] at the mesh's points; alpha as above."""
    at, weight = collapsed_gauss(body.degree + 2)
    jacobian = jacobians(body.points[body.mesh.triangles], at)
    area = np.abs(np.linalg.det(jacobian)) * weight
    slope = slopes(at, body.degree) @ np.linalg.inv(jacobian)
    pressure = _beta(body, expansion)[:, None] * (temperature[body.mesh.triangles] @ shapes(at).T)
    force = np.einsum("mq,mqac->mac", area * pressure, slope, optimize=True)
    return nodal_sums(body.elements, force, len(body.nodes))


def _beta(body: MeshedBody, expansion: float | np.ndarray) -> np.ndarray:
    """(m,) [Pa/K] of each triangle: alpha (3 lambda + 2 mu)."""
    return expansion * (3.0 * body.lame + 2.0 * body.shear_modulus)
