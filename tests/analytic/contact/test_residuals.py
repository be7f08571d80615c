"""Residuals of a contact: each kind of error is seen."""

import numpy as np
import pytest

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import Residuals, assessed, solve_contact
from analytic.grid import HatGrid, roller_gap
from analytic.operators.half_plane import HalfPlane


def test_residuals_see_each_kind_of_error(roller):
    reach = 1.5 * roller.hertz.half_width
    grid = HatGrid.within(-reach, reach, 0.01 * reach)
    solution = roller.pressed(grid, roller.smooth())
    operator = HalfPlane(grid.count, grid.pitch, roller.modulus)
    weighted_gap = grid.hat_integrals(roller.smooth())

    def residuals(pressure, approach=solution.approach, hardness=np.inf):
        limits = Constraints(load=roller.load, hardness=hardness)
        moved = operator.apply(pressure)
        found = assessed(moved, pressure, weighted_gap, grid.weights, approach, limits, {})
        return found.residuals

    assert residuals(solution.pressure).worst < 1e-10
    assert residuals(1.01 * solution.pressure).load_balance == pytest.approx(0.01)
    assert residuals(solution.pressure, 1.01 * solution.approach).penetration > 1e-4
    assert residuals(solution.pressure, 0.99 * solution.approach).complementarity > 1e-4
    assert residuals(solution.pressure - 1e8).negative_pressure > 0.01
    assert residuals(solution.pressure, hardness=1e9).excess_pressure > 1.0


def test_residuals_see_pressure_at_the_hardness_over_an_open_gap(roller):
    """At the hardness bodies overlap or touch; the outermost nodes may carry nothing there."""
    grid, hardness = HatGrid(1e-6, -32, 32), 1e9
    operator = HalfPlane(grid.count, grid.pitch, roller.modulus)
    weighted_gap = grid.hat_integrals(roller_gap(1e-3))
    pressure = np.where(np.abs(grid.x) > 27.5e-6, hardness, 0.0)
    displacement = operator.apply(pressure)
    inner = pressure == 0.0
    approach = np.min(((weighted_gap + displacement) / grid.weights)[inner])
    constraints = Constraints(load=grid.weights @ pressure, hardness=hardness)
    found = assessed(displacement, pressure, weighted_gap, grid.weights, approach, constraints, {})
    assert found.gap[~inner].max() > 1e-8
    assert found.residuals.complementarity > 0.01


def test_a_residual_that_is_no_number_does_not_count_as_met():
    none = Residuals(0.0, np.nan, 0.0, 0.0, 0.0)
    assert not none.worst <= 1.0
    light = solve_contact(
        HalfPlane(8, 1.0, 1.0), np.arange(8.0), np.ones(8), Constraints(load=1e-200)
    )
    assert np.isfinite(light.residuals.worst)
