"""Nodal loads of heat fluxes that are given."""

from collections.abc import Callable

import numpy as np

from fem.body.sums import nodal_sums
from fem.body.surface import hat_points
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
