"""The outer iteration with a model: it solves the operator's problem, not the model's."""

import numpy as np
import pytest
from scipy.linalg import toeplitz

from analytic.contact import solve_contact
from analytic.defect import solve_with_model
from analytic.equilibrium import Constraints
from analytic.gap import HatGrid, roller_gap
from analytic.operators import HalfPlane, SumOfBodies

RADIUS, MODULUS, LOAD = 7.5706e-3, 115.385e9, 1.0e6
GRID = HatGrid.within(-0.5e-3, 0.5e-3, 4e-6)


class Dense:
    """A symmetric compliance given as a matrix."""

    def __init__(self, matrix: np.ndarray) -> None:
        self.matrix = matrix

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        return self.matrix @ pressure


def half_plane(modulus: float = MODULUS) -> HalfPlane:
    return HalfPlane(GRID.count, GRID.pitch, modulus)


def average_gap(amplitude: float = 0.3e-6) -> np.ndarray:
    wave = 2.0 * np.pi / 60e-6
    return GRID.average(lambda x: roller_gap(RADIUS)(x) - amplitude * np.cos(wave * x + 0.4))


def perturbed() -> Dense:
    """A half-plane with a few per cent of smooth, symmetric, positive deviation."""
    matrix = toeplitz(half_plane().column)
    x = GRID.x / GRID.x[-1]
    bumps = np.exp(-8.0 * (x[:, None] - np.linspace(-0.8, 0.8, 5)) ** 2)
    return Dense(matrix + 0.05 * matrix.mean() * bumps @ bumps.T)


@pytest.mark.parametrize(
    "constraints",
    [Constraints(load=LOAD), Constraints(load=LOAD, hardness=3e9), Constraints(approach=2e-6)],
)
def test_result_is_that_of_the_operator(constraints):
    operator = perturbed()
    solution = solve_with_model(operator, half_plane(), average_gap(), GRID.weights, constraints)
    assert solution.converged
    assert solution.iterations["applications"] <= 8
    gap = average_gap() + operator.apply(solution.pressure) - solution.approach * GRID.weights
    scale = np.ptp(operator.apply(solution.pressure))
    free = (solution.pressure > 0) & (solution.pressure < constraints.hardness)
    assert np.abs(gap[free]).max() < 1e-7 * scale
    assert gap[solution.pressure == 0].min() > -1e-7 * scale


def test_the_model_itself_needs_one_step():
    solution = solve_with_model(
        half_plane(), half_plane(), average_gap(), GRID.weights, Constraints(load=LOAD)
    )
    direct = solve_contact(half_plane(), average_gap(), GRID.weights, Constraints(load=LOAD))
    assert solution.iterations["applications"] == 1
    assert solution.pressure == pytest.approx(direct.pressure, abs=1e-9 * direct.pressure.max())


@pytest.mark.parametrize("factor", [0.7, 1.5])
def test_a_model_of_the_wrong_modulus_does_not_change_the_answer(factor):
    right = solve_contact(half_plane(), average_gap(), GRID.weights, Constraints(load=LOAD))
    solution = solve_with_model(
        half_plane(),
        half_plane(factor * MODULUS),
        average_gap(),
        GRID.weights,
        Constraints(load=LOAD),
    )
    assert solution.converged
    assert solution.iterations["steps"] > 1
    assert solution.pressure == pytest.approx(right.pressure, abs=1e-5 * right.pressure.max())


def test_what_does_not_converge_says_so():
    """An operator that is not symmetric positive definite has no such minimum to find."""
    rng = np.random.default_rng(2)
    matrix = toeplitz(half_plane().column)
    operator = Dense(matrix + matrix.max() * rng.standard_normal(matrix.shape))
    solution = solve_with_model(
        operator, half_plane(), average_gap(), GRID.weights, Constraints(load=LOAD)
    )
    assert not solution.converged
    assert solution.residuals.worst > 1e-6


def test_two_bodies_add():
    pair = SumOfBodies(half_plane(2.0 * MODULUS), half_plane(2.0 * MODULUS))
    solution = solve_with_model(
        pair, half_plane(), average_gap(), GRID.weights, Constraints(load=LOAD)
    )
    direct = solve_contact(half_plane(), average_gap(), GRID.weights, Constraints(load=LOAD))
    assert solution.pressure == pytest.approx(direct.pressure, abs=1e-9 * direct.pressure.max())


def test_a_large_common_displacement_does_not_stall_the_iteration():
    """A rigid part of the compliance changes the approach and nothing else."""
    operator = perturbed()
    rigid = 1e4 * operator.matrix.max() * np.ones_like(operator.matrix)
    plain, raised = (
        solve_with_model(
            body, half_plane(), average_gap(), GRID.weights, Constraints(load=LOAD), tolerance=1e-9
        )
        for body in (operator, Dense(operator.matrix + rigid))
    )
    assert plain.converged and raised.converged
    assert raised.pressure == pytest.approx(plain.pressure, abs=1e-6 * plain.pressure.max())
