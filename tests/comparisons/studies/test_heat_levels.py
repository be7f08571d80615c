"""The uncertainty of flash temperatures by levels of finite elements, against Jaeger's band."""

import numpy as np
import pytest
from moving_band import band_maximum, band_mean

from analytic.material import ThermalMaterial
from comparisons.figures.convergence import grid_convergence
from fem.heat.body import thermal_body
from fem.heat.conduction import Conduction, Surroundings
from fem.heat.surface_heat import flux_load
from meshes.build import build_block
from meshes.thermal_layer import thermal_spec

UNIT = ThermalMaterial(1.0, 1.0, 1.0)
FAR = 3e-5  # relative, by the open boundary of a block of ten half-widths


def level(peclet, number):
    """k T / (q l) of the band: the largest, and the mean."""
    law = {"length": -0.5 / peclet, "layers": 0.5 * 2**number, "growth": 0.4 / np.sqrt(2.0**number)}
    spec = thermal_spec([[-1.0, 1.0]], 0.2 / 2**number, half_width=10.0, depth=10.0, **law)
    body = thermal_body(build_block(spec), UNIT)
    load = flux_load(body, np.linspace(-1.0, 1.0, 3), np.ones(3))
    found = Conduction(body, -2.0 * peclet, Surroundings("open", "open")).steady(load)
    return found.max(), 0.5 * load @ found


@pytest.mark.parametrize("peclet", [0.1, 1.0, 2.0, 10.0, 100.0])
def test_three_levels_cover_the_error(peclet):
    levels = np.array([level(peclet, number) for number in range(3)])
    exact = band_maximum(peclet)[0], band_mean(peclet)
    for values, true in zip(levels.T, exact, strict=True):
        found = grid_convergence(values, 2.0, FAR * true)
        assert abs(found.value - true) <= found.uncertainty < 2e-3 * true
