"""The variational inequality against the project's solver, on tilted pressures and held points."""

import numpy as np
import pytest

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.operators.half_plane import HalfPlane
from fem.body.elasticity import Support
from fem.body.surface import hat_forces
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.variational_inequality import solve_variational_inequality


@pytest.fixture(scope="module")
def solve(grid):
    def solved(bodies, gap, *load_and_hardness):
        pressed = [(body, hat_forces(body.surface, grid.hats)) for body in bodies]
        return solve_variational_inequality(pressed, gap, grid.weights, *load_and_hardness)

    return solved


def test_both_solvers_agree(grid, block, solve):
    """The project's own operator and solver, on the same mesh."""
    model = HalfPlane(grid.count, grid.pitch, block.material.plane_strain_modulus)
    own = solve_with_model(
        grid.compliance(block), model, grid.rough, grid.weights, Constraints(load=0.3)
    )
    other = solve([block], grid.rough, 0.3)
    assert own.converged
    error = np.abs(own.pressure - other.pressure).max() / own.pressure.max()
    assert error < 1e-6
    assert own.approach == pytest.approx(other.approach, rel=1e-6)


def test_a_rough_body_with_tilted_pressure(grid, dense):
    def height(x):
        return 0.02 * np.cos(5 * x) * np.exp(-((x / 2.0) ** 4))

    def direction(x):
        return 0.3 * x, np.ones_like(x)

    body = grid.body(height=height)
    tilted = FiniteElementCompliance(body, grid.hats, direction)
    b = hat_forces(body.surface, grid.hats, direction)
    found = solve_variational_inequality([(body, b)], grid.smooth, grid.weights, 0.6)
    pressure, _ = dense(tilted.matrix(), grid.smooth, grid.weights, 0.6)
    np.testing.assert_allclose(found.pressure, pressure, atol=1e-8 * pressure.max())


def test_what_hats_do_to_held_components_is_nothing(grid, dense, solve):
    """The outer hats reach over points that the support holds."""
    body = grid.body(support=Support(within=(1.25, np.inf)))
    assert body.held[body.surface.point[np.abs(body.surface.x) < 1.3]].any()
    found = solve([body], 0.002 * grid.smooth, 3.0)
    pressure, _ = dense(grid.compliance(body).matrix(), 0.002 * grid.smooth, grid.weights, 3.0)
    np.testing.assert_allclose(found.pressure, pressure, atol=1e-8 * pressure.max())


def test_loads_that_cannot_be_borne_are_refused(grid, block, solve):
    with pytest.raises(ValueError, match="must be positive"):
        solve([block], grid.smooth, 0.0)
    with pytest.raises(ValueError, match="exceeds the hardness"):
        solve([block], grid.smooth, 3.0, 1.0)
