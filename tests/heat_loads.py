"""Nodal loads of heat fluxes that are given, and temperatures under them."""

from collections.abc import Callable

import numpy as np

from analytic.material import ThermalMaterial
from fem.body.sums import nodal_sums
from fem.body.surface import hat_points
from fem.heat.body import ThermalBody, thermal_body
from fem.heat.conduction import Conduction, Surroundings
from fem.solver.mumps import solve_once
from meshes.build import build_block
from meshes.thermal_layer import thermal_spec

UNIT = ThermalMaterial(1.0, 1.0, 1.0)
BAND = np.linspace(-1.0, 1.0, 3)
OPEN = Surroundings("open", "open")


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


def under_band(peclet: float, edge: float, **law) -> tuple[ThermalBody, np.ndarray, np.ndarray]:
    """A half-plane of unit constants under a unit flux on |x| < 1 that moves towards +x: the body,
    the nodal heat [W/m] and the temperature [K]; edges there, and `law` as `thermal_spec`'s."""
    how = {"half_width": 10.0, "depth": 10.0, "length": -0.5 / peclet} | law
    body = thermal_body(build_block(thermal_spec([[-1.0, 1.0]], edge, **how)), UNIT)
    load = flux_load(body, BAND, np.ones(3))
    return body, load, steady(Conduction(body, -2.0 * peclet, OPEN), load)


def reach_of_half_plane(reach: float, radius: float) -> float:
    """How far a half-plane reaches [m] that is as warm in the contact as the part of a disc within
    `reach` of it, the arc held: 1/z maps the disc to a half-plane and the arc to a circle about the
    image of infinity; with its mirror image that is a lens, whose logarithmic capacity is known
    (pi h / beta: h half its height, beta its outer angle), and which is 1 over what is sought."""
    outer, height = np.pi - np.arccos(0.5 * reach / radius), np.sqrt(reach**-2 - 0.25 * radius**-2)
    return 2.0 * outer / (np.pi * height)


def steady(conduction: Conduction, load: np.ndarray, held: float | np.ndarray = 0.0) -> np.ndarray:
    """Temperature (n,) [K] under nodal heat (n,) [W/m]; `held` (n,) [K] are the given ones."""
    free = ~conduction.held
    temperature = np.where(free, 0.0, held)
    matrix, right = conduction.matrix[free], load - conduction.matrix @ temperature
    temperature[free] = solve_once(matrix[:, free], right[free], symmetric=False)
    return temperature
