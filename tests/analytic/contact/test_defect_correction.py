"""The outer iteration with a model: it solves the operator's problem, not the model's."""

from functools import partial

import numpy as np
import pytest
from blocks import SumOfBodies
from scipy.linalg import toeplitz

from analytic.contact import defect_correction as defect
from analytic.contact.coupled import solve_coupled
from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import assessed, solve_contact
from analytic.grid import HatGrid, roller_gap
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface, TangentialLayer
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from analytic.operators.tangential import CoupledHalfPlane, CoupledPair
from analytic.surface.synthetic import self_affine

solve_with_coupled_model = partial(solve_with_model, solver=solve_coupled)

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
    return GRID.hat_integrals(lambda x: roller_gap(RADIUS)(x) - amplitude * np.cos(wave * x + 0.4))


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


@pytest.mark.parametrize("constraints", [Constraints(load=LOAD), Constraints(approach=2e-6)])
def test_a_start_nearer_than_the_model_takes_no_longer(constraints):
    """The solution of nearly the same operator, and in the end the same answer."""
    given = perturbed(), half_plane(), average_gap(), GRID.weights, constraints
    found = solve_with_model(*given)
    near = Dense(given[0].matrix * 1.001)
    start = solve_with_model(near, *given[1:]).pressure
    nearer = solve_with_model(*given, start, nearer=True)
    assert nearer.converged
    assert nearer.iterations["steps"] < found.iterations["steps"]
    assert nearer.iterations["applications"] <= found.iterations["applications"]
    np.testing.assert_allclose(nearer.pressure, found.pressure, atol=1e-6 * found.pressure.max())


@pytest.mark.parametrize("factor", [0.3, 0.7, 1.5, 3.0])
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


@pytest.mark.parametrize("modulus", [MODULUS, 2.0 * MODULUS])
def test_a_large_common_displacement_does_not_stall_the_iteration(modulus):
    """A rigid part of the compliance changes the approach and nothing else, whatever the model."""
    operator = perturbed()
    rigid = 1e4 * operator.matrix.max() * np.ones_like(operator.matrix)
    plain, raised = (
        solve_with_model(
            body,
            half_plane(modulus),
            average_gap(),
            GRID.weights,
            Constraints(load=LOAD),
            tolerance=1e-9,
        )
        for body in (operator, Dense(operator.matrix + rigid))
    )
    assert plain.converged and raised.converged
    assert raised.iterations["steps"] == plain.iterations["steps"]
    assert raised.pressure == pytest.approx(plain.pressure, abs=1e-6 * plain.pressure.max())


@pytest.mark.parametrize("base", [0.0, 1.0, 10.0, 60.0])
def test_an_approach_takes_no_more_steps_than_its_load(base):
    """A body on a base that gives way: the half-plane takes its datum from one application."""
    rigid = base * half_plane().column[0] * np.ones((GRID.count, GRID.count))
    operator = Dense(perturbed().matrix + rigid)
    gap = average_gap()

    def found(constraints):
        return solve_with_model(operator, half_plane(), gap, GRID.weights, constraints)

    by_load = found(Constraints(load=LOAD))
    pressed = found(Constraints(approach=by_load.approach))
    assert by_load.converged and pressed.converged
    assert pressed.iterations["applications"] == pressed.iterations["steps"] + 1
    assert by_load.iterations["steps"] - 1 <= pressed.iterations["steps"]
    assert pressed.iterations["steps"] <= by_load.iterations["steps"]
    # an approach is met to a part of all the displacement, the base's included
    near = 1e-6 * (1.0 + base) * by_load.pressure.max()
    assert pressed.pressure == pytest.approx(by_load.pressure, abs=near)


@pytest.mark.parametrize("base", [0.0, 1.0, 10.0, 60.0])
@pytest.mark.parametrize("change", [1e-9, 1e-8, 1e-7])
def test_on_a_base_little_is_not_taken_for_rounding(base, change):
    """What the last steps still move, too many nodes being free to be solved for directly."""
    grid = HatGrid.within(-0.5e-3, 0.5e-3, 1e-6)
    plain = HalfPlane(grid.count, grid.pitch, MODULUS)
    model = plain.on_base(base * plain.column[0] / grid.pitch**2)
    gap = grid.hat_integrals(roller_gap(RADIUS))
    load = Constraints(load=LOAD)
    first = solve_contact(model, gap, grid.weights, load)
    pressed = Constraints(approach=first.approach)
    size = np.abs(model.apply(first.pressure)).max()
    waves = change * size * np.cos(np.arange(grid.count))
    second = solve_contact(model, gap + waves, grid.weights, pressed, first.pressure)
    assert np.count_nonzero(first.pressure) > 200
    assert second.residuals.penetration < 0.05 * change


def test_a_body_on_a_base_that_gives_nearly_all_the_way_is_solved_all_the_same():
    """Further off than a datum of the model can be."""
    rigid = 1e3 * half_plane().column[0] * np.ones((GRID.count, GRID.count))
    operator, gap = Dense(perturbed().matrix + rigid), average_gap()
    found = solve_with_model(
        operator, half_plane(), gap, GRID.weights, Constraints(approach=1e-3), tolerance=1e-11
    )
    assert found.converged
    by_load = solve_with_model(
        operator, half_plane(), gap, GRID.weights, Constraints(load=found.load), tolerance=1e-9
    )
    assert found.pressure == pytest.approx(by_load.pressure, abs=1e-5 * by_load.pressure.max())


@pytest.mark.parametrize("above", [0.0, 3e-6])
def test_the_datum_may_come_from_a_nearby_solution(above):
    """Or from an even pressure where that one touches nowhere."""
    rigid = 10.0 * half_plane().column[0] * np.ones((GRID.count, GRID.count))
    operator, model = Dense(perturbed().matrix + rigid), half_plane()
    gap, approach = average_gap() + above * GRID.weights, Constraints(approach=1.5e-6)
    first = solve_with_model(operator, model, gap, GRID.weights, approach)
    assert first.converged and (first.load > 0.0) == (above == 0.0)
    for start in (first.pressure, np.zeros(GRID.count)):
        again = solve_with_model(operator, model, gap, GRID.weights, approach, start)
        assert again.converged
        assert again.iterations["steps"] <= first.iterations["steps"]
        assert again.pressure == pytest.approx(first.pressure, abs=1e-5 * first.pressure.max())


LIGHT = Constraints(load=0.8e6)
CAPPED = Constraints(load=0.8e6, hardness=8e9)


def rough_gap(seed: int) -> np.ndarray:
    curve = self_affine(
        hurst=0.8,
        samples=2049,
        length=4e-3,
        seed=seed,
        rms_slope=0.05,
        shortest_wavelength=60e-6,
        longest_wavelength=0.4e-3,
    ).spline()
    return GRID.hat_integrals(lambda x: roller_gap(RADIUS)(x) - curve(x))


def sliding(friction_dundurs: float, modulus: float = MODULUS) -> CoupledHalfPlane:
    return CoupledHalfPlane(GRID.count, GRID.pitch, modulus, friction_dundurs)


def misses(operator, found, gap: np.ndarray, constraints: Constraints) -> float:
    """How far the contact conditions fail, over the range of displacements; written anew."""
    moved = operator.apply(found.pressure)
    gap = gap + moved - found.approach * GRID.weights
    touching = found.pressure > 0.0
    free = touching & (found.pressure < 0.999999 * constraints.hardness)
    wrong = [np.abs(gap[free]), -gap[~touching], gap[touching & ~free], -found.pressure]
    return max(np.max(each, initial=0.0) for each in wrong) / np.ptp(moved)


class TestSurfacesMovedByFriction:
    @pytest.mark.parametrize("constraints", [LIGHT, CAPPED, Constraints(approach=3e-7)])
    @pytest.mark.parametrize("friction_dundurs", [0.05, -0.15, 0.5])
    def test_result_is_that_of_the_operator(self, friction_dundurs, constraints):
        """A few per cent beside the model: as few steps as without friction."""
        skew = sliding(friction_dundurs).block(np.arange(GRID.count)) - toeplitz(
            half_plane().column
        )
        operator = Dense(perturbed().matrix + 1.05 * skew)
        gap = rough_gap(4)
        found = solve_with_coupled_model(
            operator, sliding(friction_dundurs), gap, GRID.weights, constraints
        )
        assert found.converged
        assert found.iterations["steps"] == found.iterations["applications"] <= 9
        assert misses(operator, found, gap, constraints) < 1e-7

    def test_without_a_skew_part_it_is_the_frictionless_contact(self):
        gap = rough_gap(4)
        one = solve_with_coupled_model(perturbed(), sliding(0.0), gap, GRID.weights, LIGHT)
        other = solve_with_model(perturbed(), half_plane(), gap, GRID.weights, LIGHT)
        assert one.pressure == pytest.approx(other.pressure, abs=1e-12 * one.pressure.max())
        assert one.iterations == other.iterations

    @pytest.mark.parametrize("constraints", [LIGHT, CAPPED])
    @pytest.mark.parametrize("factor", [0.3, 2.5])
    @pytest.mark.parametrize("seed", [3, 4, 5])
    def test_a_model_of_the_wrong_modulus_does_not_change_the_answer(
        self, seed, factor, constraints
    ):
        gap = rough_gap(seed)
        right = solve_coupled(sliding(0.3), gap, GRID.weights, constraints)
        found = solve_with_coupled_model(
            sliding(0.3), sliding(0.3, factor * MODULUS), gap, GRID.weights, constraints
        )
        assert found.converged and found.iterations["steps"] > 2
        assert found.pressure == pytest.approx(right.pressure, abs=1e-5 * right.pressure.max())

    def test_where_no_whole_step_comes_nearer_shorter_ones_do(self, monkeypatch):
        """A model five times too stiff."""
        gap = rough_gap(3)
        right = solve_coupled(sliding(0.3), gap, GRID.weights, LIGHT)

        def found():
            return solve_with_coupled_model(
                sliding(0.3), sliding(0.3, 5.0 * MODULUS), gap, GRID.weights, LIGHT
            )

        assert found().converged
        assert found().pressure == pytest.approx(right.pressure, abs=1e-5 * right.pressure.max())
        monkeypatch.setattr(defect, "PATIENCE", defect.MAX_STEPS)
        assert found().residuals.worst > 1e-3

    def test_a_model_without_friction_takes_more_steps_to_the_same(self):
        gap, steps = rough_gap(6), []
        right = solve_coupled(sliding(0.3), gap, GRID.weights, LIGHT)
        for known in (0.3, 0.15, 0.0):
            found = solve_with_coupled_model(sliding(0.3), sliding(known), gap, GRID.weights, LIGHT)
            assert found.converged
            assert found.pressure == pytest.approx(right.pressure, abs=1e-6 * right.pressure.max())
            steps.append(found.iterations["steps"])
        assert steps[0] == 1 < steps[1] < steps[2] <= 16

    @pytest.mark.parametrize("base", ["bonded", "frictionless"])
    @pytest.mark.parametrize(("thickness", "most"), [(1e-3, 7), (1e-4, 16)])
    def test_a_layer_thinner_than_the_contact(self, base, thickness, most):
        """Half-width 0.15 mm: the half-plane still leads there."""
        body = LayeredBody(Material(105e9, 0.3), thickness, base)
        operator = CoupledPair(
            LayeredSurface(GRID.count, GRID.pitch, body),
            TangentialLayer(GRID.count, GRID.pitch, body),
            0.5,
        )
        gap = rough_gap(7)
        right = solve_coupled(operator, gap, GRID.weights, Constraints(load=LOAD))
        found = solve_with_coupled_model(
            operator, sliding(0.5 * 2 / 7), gap, GRID.weights, Constraints(load=LOAD)
        )
        assert found.converged and found.iterations["steps"] <= most
        assert found.pressure == pytest.approx(right.pressure, abs=1e-6 * right.pressure.max())

    def test_what_does_not_converge_is_the_best_of_all_steps(self, monkeypatch):
        """So that more of them never make it worse."""
        rng = np.random.default_rng(2)
        matrix = sliding(0.3).block(np.arange(GRID.count))
        operator = Dense(matrix + matrix.max() * rng.standard_normal(matrix.shape))
        worst = []
        for steps in (1, 2, 5, 6, 7, 8, 20, 40):
            monkeypatch.setattr(defect, "MAX_STEPS", steps)
            found = solve_with_coupled_model(
                operator, sliding(0.3), rough_gap(3), GRID.weights, LIGHT
            )
            assert not found.converged and found.iterations["steps"] == steps
            worst.append(found.residuals.worst)
        assert sorted(worst, reverse=True) == worst
        assert 1e-6 < worst[-1] < worst[0]


def test_no_pressure_under_an_approach_that_closes_the_gap_is_no_solution():
    """In whatever unit of length."""
    for unit in (1.0, 1e-9):
        gap, weights = np.array([0.2, 0.0, 0.2]) * unit**2, np.ones(3) * unit
        limits = Constraints(approach=0.1 * unit)
        found = assessed(np.zeros(3), np.zeros(3), gap, weights, 0.1 * unit, limits, {})
        assert found.residuals.penetration == pytest.approx(1.0)
