"""Layers near their limits, met by the numerical layered surface as far as the limits hold."""

from dataclasses import dataclass

import numpy as np
import pytest

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import solve_contact
from analytic.exact.layers import (
    LayerLimit,
    thick_layer,
    thin_compressible_layer,
    thin_incompressible_layer,
)
from analytic.grid import HatGrid, roller_gap
from analytic.layers.layered import Base, LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material

NYLON = Material(3e9, 0.3)
ELASTOMER = Material(5e6, 0.5 - 1e-9)  # a bonded layer of nu = 1/2 but for rounding
ELEMENTS = 800
ROUNDED = 2e-5  # what elements leave of peak pressure and approach


@dataclass(frozen=True)
class Case:
    """A rigid cylinder of `radius` [m] on a layer; what its limit leaves out of the load."""

    radius: float
    body: LayeredBody
    limit: LayerLimit
    remainder: float


def thick(material: Material, base: Base, a_over_t: float) -> Case:
    radius, thickness = 0.05, 2e-3
    limit = thick_layer(a_over_t * thickness, radius, thickness, material, base)
    return Case(radius, LayeredBody(material, thickness, base), limit, 0.23 * a_over_t**4)


def thin(material: Material, base: Base, a_over_t: float) -> Case:
    radius, thickness = 0.5, 0.1e-3
    half_width, body = a_over_t * thickness, LayeredBody(material, thickness, base)
    if material is ELASTOMER:
        limit = thin_incompressible_layer(half_width, radius, thickness, material.youngs_modulus)
        return Case(radius, body, limit, 8.0 / a_over_t)
    limit = thin_compressible_layer(half_width, radius, thickness, material, base)
    return Case(radius, body, limit, (0.53 if base == "frictionless" else 0.37) / a_over_t)


CASES = {
    "thick, bonded, a = t/4": thick(NYLON, "bonded", 0.25),
    "thick, bonded, a = t/20": thick(NYLON, "bonded", 0.05),
    "thick, frictionless base, a = t/4": thick(NYLON, "frictionless", 0.25),
    "thick, bonded, incompressible, a = t/4": thick(ELASTOMER, "bonded", 0.25),
    "thin, frictionless base, a = 32 t": thin(NYLON, "frictionless", 32.0),
    "thin, frictionless base, a = 128 t": thin(NYLON, "frictionless", 128.0),
    "thin, bonded, a = 64 t": thin(NYLON, "bonded", 64.0),
    "thin, bonded, incompressible, a = 64 t": thin(ELASTOMER, "bonded", 64.0),
    "thin, bonded, incompressible, a = 128 t": thin(ELASTOMER, "bonded", 128.0),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_numerical_layer_meets_the_limit(case: Case):
    """Under the same load. A limit that leaves out a share e of the load for a half-width, which
    goes as its power n, makes the half-width e/n too large: so it is, in thin layers."""
    limit = case.limit
    pitch = 2.6 * limit.half_width / ELEMENTS
    grid = HatGrid.within(-1.3 * limit.half_width, 1.3 * limit.half_width, pitch)
    solution = solve_contact(
        LayeredSurface(grid.count, pitch, case.body),
        grid.hat_integrals(roller_gap(case.radius)),
        grid.weights,
        Constraints(load=limit.load_per_length),
    )
    assert solution.converged
    [edges] = contact_patches(grid.x, solution.pressure, solution.gap)
    wider = 0.5 * np.ptp(edges) / limit.half_width - 1.0
    edge = 0.15 * pitch / limit.half_width
    off = case.remainder / (2.0 * limit.exponent + 1.0)
    if limit.exponent == 0.5:
        assert abs(wider) < off + edge
    else:
        assert wider == pytest.approx(-off, abs=0.1 * off + edge)
    peak = solution.pressure.max() / limit.peak_pressure - 1.0
    assert abs(peak) < 0.6 * case.remainder + ROUNDED
    assert abs(solution.approach / limit.approach - 1.0) < 0.15 * case.remainder + ROUNDED
