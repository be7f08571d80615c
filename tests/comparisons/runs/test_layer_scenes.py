"""Finite elements on layers against the exact contact of a parabola on a layer.

analytic/exact/layer_contact.json: ten digits, two independent derivations.
"""

import json

import pytest
from scenes import exact_layer, finite_elements, problem

from analytic.exact.layers import TABLE

# On a frictionless base figures over E' are the same at any Poisson's ratio.
ALL = [
    (case, nu)
    for case in json.loads(TABLE.read_text())["cases"]
    for nu in ([0.3, 0.4999] if case["nu"] == "any" else [float(case["nu"])])
]


@pytest.mark.parametrize(
    ("case", "nu"), ALL, ids=[f"{c['base']}-{c['a_over_t']}-{nu}" for c, nu in ALL]
)
def test_second_level_meets_the_exact_layer(case, nu):
    tables, exact = exact_layer(case, nu)
    posed, half_width = problem(tables), 0.5 * exact["contact_length"]
    level = finite_elements(posed, posed.pitches[1])
    assert level.solution.converged
    assert level.solution.iterations["applications"] <= 6
    assert half_width / level.grid.pitch == pytest.approx(38.65, rel=0.005)
    assert level.solution.pressure.max() == pytest.approx(exact["peak_pressure"], rel=1e-3)
    assert 0.5 * level.contact_length == pytest.approx(half_width, rel=2.5e-3)
