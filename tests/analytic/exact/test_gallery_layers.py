"""Every layer of the gallery, met by the numerical layered surface as far as its limit holds."""

import numpy as np
import pytest

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import solve_contact
from analytic.exact.gallery import LayerContact, layer_contacts
from analytic.grid import HatGrid, roller_gap
from analytic.layers.operator import LayeredSurface

CASES = {case.name: case for case in layer_contacts()}
ELEMENTS = 800
ROUNDED = 2e-5  # what elements leave of peak pressure and approach

every_case = pytest.mark.parametrize("case", CASES.values(), ids=CASES)


def test_gallery_covers_each_limit():
    assert len(CASES) == len(layer_contacts())
    assert {case.limit.exponent for case in CASES.values()} == {0.5, 1.0, 2.0}
    assert {case.body.base for case in CASES.values()} == {"bonded", "frictionless"}


@every_case
def test_limit_belongs_to_its_problem(case: LayerContact):
    thick = case.limit.exponent == 0.5
    assert (case.limit.half_width < case.body.thickness) == thick
    assert 0.0 < case.left_out < 0.2
    x = case.limit.half_width * np.linspace(-1.0, 1.0, 20_001)
    load = (x[1] - x[0]) * case.limit.pressure(x).sum()
    assert load == pytest.approx(case.limit.load_per_length, rel=1e-5)


@every_case
def test_numerical_layer_meets_the_limit(case: LayerContact):
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
    off = case.left_out / (2.0 * limit.exponent + 1.0)
    if limit.exponent == 0.5:
        assert abs(wider) < off + edge
    else:
        assert wider == pytest.approx(-off, abs=0.1 * off + edge)
    peak = solution.pressure.max() / limit.peak_pressure - 1.0
    assert abs(peak) < 0.6 * case.left_out + ROUNDED
    assert abs(solution.approach / limit.approach - 1.0) < 0.15 * case.left_out + ROUNDED
