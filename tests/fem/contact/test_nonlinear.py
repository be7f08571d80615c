"""Newton's method with an active set: linear bodies against dense solutions, nonlinear ones."""

import numpy as np
import pytest
from pressed_bodies import dense_contact

from fem.contact.nonlinear import RESIDUAL, solve_nonlinear_contact, state_at_rest
from fem.solver.mumps import FemError


@pytest.fixture(scope="module")
def solve(grid):
    def solved(bodies, gap, start=None, **wanted):
        start = state_at_rest(bodies, np.ones(grid.count)) if start is None else start
        return solve_nonlinear_contact(bodies, gap, grid.weights, start, **wanted)

    return solved


def test_gaps_are_the_dense_ones_and_the_approach_leads_to_the_same(
    grid, block, block_matrix, gap_and_load, solve
):
    gap, load = gap_and_load
    bodies = [grid.linear(block)]
    solution = solve(bodies, gap, load=load)
    pressure, approach = dense_contact(block_matrix, gap, grid.weights, load)
    assert solution.state.load == load
    opening = (gap + block_matrix @ pressure) / grid.pitch - approach
    np.testing.assert_allclose(
        solution.gap, opening, atol=1e-9 * np.ptp(block_matrix @ pressure) / grid.pitch
    )
    assert len(solution.residuals) == 1
    again = solve(bodies, gap, approach=solution.state.approach)
    np.testing.assert_allclose(again.state.pressure, pressure, atol=1e-9 * pressure.max())
    assert again.state.load == pytest.approx(load, rel=1e-8)


def test_the_way_to_a_load_does_not_matter(grid, block, solve):
    bodies = [grid.linear(block)]
    once = solve(bodies, grid.rough, load=0.6)
    on = solve(bodies, grid.rough, start=once.state, load=0.3)
    back = solve(bodies, grid.rough, load=0.3)
    np.testing.assert_allclose(on.state.pressure, back.state.pressure, atol=1e-9)


def test_friction_is_coupled(grid, block, solve):
    """Unsymmetric: the sliding traction moves the surface that the pressure has to follow."""
    forces, friction = grid.compliance(block), 0.3
    columns = [forces.apply(unit, friction) for unit in np.eye(grid.count)]
    sliding = solve([grid.linear(block, friction)], grid.smooth, load=0.6)
    assert sliding.iterations <= 10
    pressure, _ = dense_contact(np.array(columns).T, grid.smooth, grid.weights, 0.6)
    np.testing.assert_allclose(sliding.state.pressure, pressure, atol=1e-9 * pressure.max())
    without, _ = dense_contact(forces.matrix(), grid.smooth, grid.weights, 0.6)
    assert np.abs(pressure - without).max() > 1e-2 * pressure.max()


class Stiffening:
    """K u (1 + s |u|^2): a smooth nonlinear body whose tangent is known, as a stand-in."""

    symmetric, softness = True, np.ones(1)

    def __init__(self, body, stiffening, limit=np.inf):
        self.held, self.limit = body.held, limit
        self.matrix, self.by = body.stiffness(), stiffening
        self.accepted = []

    def linearised(self, displacement):
        """Componentwise stiffening of springs beside the linear body."""
        from scipy.sparse import diags

        u = displacement.ravel()
        if np.abs(u).max() > self.limit:
            raise FemError("too far")
        force = self.matrix @ u + self.by * u**3
        return force.reshape(-1, 2), self.matrix + diags(3.0 * self.by * u**2)

    def accept(self, displacement):
        self.accepted.append(displacement)


def stiffening(grid, block, limit=np.inf):
    return Stiffening(block, 0.02, limit), grid.linear(block)[1]


def test_newton_converges_quadratically(grid, block, solve):
    """From one load to the next with every hat touching before and after."""
    bodies, gap = [stiffening(grid, block)], 0.002 * grid.smooth
    start = solve(bodies, gap, load=0.6).state
    solution = solve(bodies, gap, start=start, load=1.2)
    history = np.array(solution.residuals[-1])
    assert history[-1] <= RESIDUAL
    late = np.log(history[(history > 1e-11) & (history < 0.1)])  # below is round-off
    orders = np.diff(late[1:]) / np.diff(late[:-1])
    assert len(orders) >= 2
    assert np.all((orders > 1.7) & (orders < 2.3)), history


def test_a_body_that_cannot_follow_a_whole_step_is_led_there(grid, block, solve):
    """Increments are bisected, each is accepted once, and the end is where it is without limit."""
    free = solve([stiffening(grid, block)], grid.smooth, load=0.6)
    reach = np.abs(free.state.displacements[0]).max()
    limited, contact = stiffening(grid, block, 1.02 * reach)
    led = solve([(limited, contact)], grid.smooth, load=0.6)
    np.testing.assert_allclose(led.state.pressure, free.state.pressure, atol=1e-7)
    assert len(limited.accepted) == len(led.residuals) > 1
    np.testing.assert_array_equal(limited.accepted[-1], led.state.displacements[0])


def test_what_does_not_converge_is_an_error(grid, block, solve):
    stuck, contact = stiffening(grid, block, 1e-6)
    with pytest.raises(FemError, match=r"did not converge beyond 0 % of the load: .*too far"):
        solve([(stuck, contact)], grid.smooth, load=0.6)
    assert stuck.accepted == []
