"""Nodal loads of heat fluxes that are given, and temperatures under them."""

from collections.abc import Callable

import numpy as np

from fem.body.sums import nodal_sums
from fem.body.surface import hat_points
from fem.heat.body import ThermalBody
from fem.heat.conduction import Conduction
from fem.solver.mumps import solve_once


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


def steady(conduction: Conduction, load: np.ndarray, held: float | np.ndarray = 0.0) -> np.ndarray:
    """Temperature (n,) [K] under nodal heat (n,) [W/m]; `held` (n,) [K] are the given ones."""
    free = ~conduction.held
    temperature = np.where(free, 0.0, held)
    matrix, right = conduction.matrix[free], load - conduction.matrix @ temperature
    temperature[free] = solve_once(matrix[:, free], right[free], symmetric=False)
    return temperature
