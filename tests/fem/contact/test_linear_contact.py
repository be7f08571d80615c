"""Linear bodies by Newton's method and by PETSc's variational inequality: dense solutions."""

from dataclasses import dataclass

import numpy as np
import pytest

from fem.body.elasticity import Support
from fem.body.surface import hat_forces
from fem.contact.nonlinear import solve_nonlinear_contact, state_at_rest
from fem.contact.terms import LinearContact, LinearResponse
from fem.contact.variational_inequality import solve_variational_inequality


@dataclass(frozen=True)
class Found:
    pressure: np.ndarray
    approach: float
    iterations: int


def by_newton(grid, bodies, gap, load, hardness=np.inf):
    pairs = [(LinearResponse(body), LinearContact(grid.compliance(body))) for body in bodies]
    start = state_at_rest(pairs, np.ones(grid.count))
    found = solve_nonlinear_contact(pairs, gap, grid.weights, start, load, hardness=hardness)
    return Found(found.state.pressure, found.state.approach, found.iterations)


def by_inequality(grid, bodies, gap, load, hardness=np.inf):
    pairs = [(body, hat_forces(body.surface, grid.hats)) for body in bodies]
    return solve_variational_inequality(pairs, gap, grid.weights, load, hardness)


@pytest.fixture(params=[by_newton, by_inequality])
def solve(request, grid):
    return lambda *given: request.param(grid, *given)


def test_pressure_and_approach_are_the_dense_ones(
    grid, block, block_matrix, dense, gap_and_load, solve
):
    gap, load = gap_and_load
    found = solve([block], gap, load)
    pressure, approach = dense(block_matrix, gap, grid.weights, load)
    np.testing.assert_allclose(found.pressure, pressure, atol=1e-9 * pressure.max())
    assert found.approach == pytest.approx(approach, rel=1e-9)
    assert found.iterations <= 15
    assert grid.weights @ found.pressure == pytest.approx(load, rel=1e-10)


def test_pressure_is_capped_at_the_hardness(grid, block, block_matrix, solve):
    """The conditions themselves, on the dense compliance: open, in contact or at the hardness."""
    hardness, load = 0.4, 0.6
    found = solve([block], grid.rough, load, hardness)
    pressure = found.pressure
    opening = (grid.rough + block_matrix @ pressure) / grid.pitch - found.approach
    none, full = pressure < 1e-9, pressure > hardness * (1 - 1e-9)
    assert none.sum() > 5
    assert full.sum() > 5
    assert pressure.min() >= 0.0
    assert pressure.max() <= hardness * (1 + 1e-12)
    scale = np.ptp(block_matrix @ pressure) / grid.pitch
    assert opening[none].min() > -1e-9 * scale
    assert opening[full].max() < 1e-9 * scale
    assert np.abs(opening[~none & ~full]).max() < 1e-9 * scale
    assert grid.weights @ pressure == pytest.approx(load, rel=1e-10)


@pytest.mark.parametrize("ratio", [1.0, 0.5, 1e-6, 1e6])
def test_an_elastic_roller_is_a_second_body(grid, block, block_matrix, dense, ratio, solve):
    roller = grid.body(ratio, 0.2, support=Support("bonded", "fixed"))
    load = 0.6 * min(1.0, ratio)
    found = solve([block, roller], grid.rough, load)
    pressure, _ = dense(
        block_matrix + grid.compliance(roller).matrix(), grid.rough, grid.weights, load
    )
    np.testing.assert_allclose(found.pressure, pressure, atol=1e-8 * pressure.max())


@pytest.mark.parametrize("size", [1e-9, 1e9])
def test_units_of_pressure_do_not_matter(grid, block, size, solve):
    unit = solve([block], grid.rough, 0.3)
    scaled = solve([grid.body(size)], grid.rough, 0.3 * size)
    np.testing.assert_allclose(scaled.pressure / size, unit.pressure, atol=1e-12)
    assert scaled.approach == pytest.approx(unit.approach, rel=1e-12)
