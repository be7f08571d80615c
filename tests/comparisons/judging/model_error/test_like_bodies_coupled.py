"""Sliding traction on bodies of like constants: half-planes move alike, layers and coats do not."""

import numpy as np
import pytest
from scenes import STEEL, finite_elements, problem

from comparisons.judging.effects.estimates import Shown
from comparisons.judging.effects.selection import select_effects
from comparisons.judging.rule import relative_l2
from comparisons.models.level import Level
from comparisons.models.problem import Problem

HALF_WIDTH = 216e-6  # of the smooth contact
BODIES = {
    "thin layer": {"body": STEEL | {"thickness": 0.3 * HALF_WIDTH}},
    "thick layer": {"body": STEEL | {"thickness": 4.0 * HALF_WIDTH}},
    "hard coating": {
        "coating": {"thickness": 20e-6, "youngs_modulus": 400e9, "poissons_ratio": 0.22}
    },
    "soft coating": {"coating": {"thickness": 20e-6, "youngs_modulus": 5e9, "poissons_ratio": 0.4}},
}


def solved(tables: dict, **finite_element: object) -> tuple[Problem, Level]:
    """Like bodies under friction, on one level."""
    made = {
        "roller": {"radius": 8.2e-3, **STEEL},
        "body": STEEL,
        "load": {"hertz_peak_pressure": 1.5e9, "friction": 0.3},
        "finite_element": finite_element,
        "resolution": {"pitch": HALF_WIDTH / 20.0},
    } | tables
    posed = problem(made)
    return posed, finite_elements(posed)


def test_half_planes_are_moved_alike():
    _, still = solved({})
    _, moved = solved({}, coupled=True)
    apart = np.abs(moved.solution.pressure - still.solution.pressure).max()
    assert moved.solution.converged and apart < 1e-9 * still.solution.pressure.max()


@pytest.mark.parametrize("name", BODIES)
def test_what_layers_and_coats_are_moved_otherwise_is_not_passed_over(name):
    posed, still = solved(BODIES[name])
    _, moved = solved(BODIES[name], coupled=True)
    assert relative_l2(moved.solution.pressure, still.solution.pressure) > 0.003
    selection = select_effects(posed, Shown(*2 * [posed.hertz.peak_pressure]))
    assert "normal_tangential_coupling" in selection.added
