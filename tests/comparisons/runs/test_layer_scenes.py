"""Finite elements on layers against the exact contact of a parabola on a layer.

analytic/exact/layer_contact.json: ten digits, two independent derivations.
"""

import json

import pytest
from scenes import finite_elements, problem

from analytic.exact.layers import TABLE
from comparisons.models.problem import Problem

CASES = json.loads(TABLE.read_text())["cases"]
RADIUS, THICKNESS, YOUNGS_MODULUS = 0.1, 1e-3, 200e9


def ratios_of_poisson(case: dict) -> list[float]:
    """On a frictionless base figures over E' are the same at any Poisson's ratio."""
    return [0.3, 0.4999] if case["nu"] == "any" else [float(case["nu"])]


ALL = [(case, nu) for case in CASES for nu in ratios_of_poisson(case)]


def problem_under(case: dict, nu: float) -> tuple[Problem, float]:
    """The scene under the case's load, and the exact peak pressure [Pa]."""
    modulus = YOUNGS_MODULUS / (1.0 - nu**2)
    load = float(case["P_R_over_Eprime_t2"]) * modulus * THICKNESS**2 / RADIUS
    tables = {
        "roller": {"radius": RADIUS, "rigid": True},
        "body": {
            "youngs_modulus": YOUNGS_MODULUS,
            "poissons_ratio": nu,
            "thickness": THICKNESS,
            "base": case["base"],
        },
        "load": {"per_length": load},
    }
    return problem(tables), float(case["p0_R_over_Eprime_t"]) * modulus * THICKNESS / RADIUS


@pytest.mark.parametrize(
    ("case", "nu"), ALL, ids=[f"{c['base']}-{c['a_over_t']}-{nu}" for c, nu in ALL]
)
def test_second_level_meets_the_exact_layer(case, nu):
    posed, peak = problem_under(case, nu)
    level = finite_elements(posed, posed.pitches[1])
    assert level.solution.converged
    assert level.solution.iterations["applications"] <= 6
    half_width = float(case["a_over_t"]) * THICKNESS
    assert half_width / level.grid.pitch == pytest.approx(38.65, rel=0.005)
    assert level.solution.pressure.max() == pytest.approx(peak, rel=1e-3)
    assert 0.5 * level.contact_length == pytest.approx(half_width, rel=2.5e-3)
