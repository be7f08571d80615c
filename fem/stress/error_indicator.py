"""Where the error of a solution is: recovered against raw stress, element by element.

The estimate of Zienkiewicz and Zhu (1992, Int. J. Numer. Methods Eng. 33, 1331-1364): recovered
stresses are so much more accurate than those of the elements that the difference is the error of
the latter. In the norm of energy, E^2 = integral (s* - s) : strain of (s* - s).
"""

import numpy as np

from fem.body.elasticity import ElasticBody
from fem.body.triangle import collapsed_gauss, jacobians, shapes
from fem.stress.nodes import stress_nodes
from fem.stress.recovery import element_stress, recovered_stress

LINE_POINTS = 3  # exact for the square of a difference that is quadratic, on straight elements


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
