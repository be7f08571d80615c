"""Heat through the surface: nodal loads of fluxes, and temperatures at places of the surface.

A flux [W/m^2] is counted per length of x, positive into the body.
"""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_matrix

from fem.body.sums import matrix_of, nodal_sums
from fem.body.surface import Surface, hat_points, place_on
from fem.body.triangle import edge_shapes
from fem.heat.body import ThermalBody


def flux_load(
    body: ThermalBody, x: np.ndarray, flux: np.ndarray | Callable[[np.ndarray], np.ndarray]
) -> np.ndarray:
    """Nodal heat (n,) [W/m] of a flux (m,) at ascending x (m,) [m], m >= 3, linear between and zero
    beyond; or of a function of x, smooth between these break points (five Gauss points on each
    piece of an edge). Raises ValueError if x does not ascend or leaves the surface."""
    points = hat_points(body.surface, x)
    value = flux(points.x) if callable(flux) else np.interp(points.x, x, flux)
    heat = (points.shape * (points.weight * value)).sum(axis=-1)
    return nodal_sums(body.surface.point[points.node], heat, len(body.nodes))


def values_at(surface: Surface, x: np.ndarray) -> csr_matrix:
    """Matrix (m, k) that gives values at x (m,) [m] from those at the surface's nodes (k,)."""
    edge = np.searchsorted(surface.edges[1:, 0], x)
    shape = edge_shapes(place_on(surface.edges[edge], x), surface.degree)
    column = surface.degree * edge[:, None] + np.arange(surface.degree + 1)
    return matrix_of(shape, np.arange(len(x))[:, None], column, (len(x), len(surface.x)))
