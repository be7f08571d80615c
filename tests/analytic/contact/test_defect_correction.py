"""The outer iteration with a model: it solves the operator's problem, not the model's."""

from dataclasses import dataclass

import numpy as np
import pytest
from blocks import SumOfBodies
from scipy.linalg import toeplitz

from analytic.contact import defect_correction as defect
from analytic.contact.coupled import solve_coupled
from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution, assessed, solve_contact
from analytic.grid import HatGrid, roller_gap
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface, TangentialLayer
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from analytic.operators.tangential import CoupledPair, coupled_half_planes
from analytic.surface.synthetic import self_affine

RADIUS, MODULUS, LOAD = 7.5706e-3, 115.385e9, 1.0e6
GRID = HatGrid.within(-0.5e-3, 0.5e-3, 4e-6)
LOADED, PRESSED = Constraints(load=LOAD), Constraints(approach=2e-6)


@dataclass(frozen=True)
class Matrix:
    """A compliance given as its matrix (n, n), that knows nothing but how to apply it."""

    matrix: np.ndarray

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        return self.matrix @ pressure


def half_plane(modulus: float = MODULUS) -> HalfPlane:
    return HalfPlane(GRID.count, GRID.pitch, modulus)


def average_gap(amplitude: float = 0.3e-6) -> np.ndarray:
    wave = 2.0 * np.pi / 60e-6
    return GRID.hat_integrals(lambda x: roller_gap(RADIUS)(x) - amplitude * np.cos(wave * x + 0.4))


def perturbed() -> Matrix:
    """A half-plane with a few per cent of smooth, symmetric, positive deviation."""
    matrix = toeplitz(half_plane().column)
    x = GRID.x / GRID.x[-1]
    bumps = np.exp(-8.0 * (x[:, None] - np.linspace(-0.8, 0.8, 5)) ** 2)
    return Matrix(matrix + 0.05 * matrix.mean() * bumps @ bumps.T)


def on_base(times: float) -> Matrix:
    """The perturbed body on a base that gives way by so many of a half-plane's coefficients."""
    rigid = times * half_plane().column[0] * np.ones((GRID.count, GRID.count))
    return Matrix(perturbed().matrix + rigid)


def solved(
    operator, constraints=LOADED, start=None, model=None, gap=None, **options
) -> ContactSolution:
    """Solution with the half-plane as model, unless another, on the averaged gap."""
    model = half_plane() if model is None else model
    gap = average_gap() if gap is None else gap
    return solve_with_model(operator, model, gap, GRID.weights, constraints, start, **options)


def assert_pressures(result: ContactSolution, expected: ContactSolution, tolerance: float) -> None:
    """Equal to a part of the largest one."""
    largest = expected.pressure.max()
    assert result.pressure == pytest.approx(expected.pressure, abs=tolerance * largest)


@pytest.mark.parametrize("constraints", [LOADED, Constraints(load=LOAD, hardness=3e9), PRESSED])
def test_result_is_that_of_the_operator(constraints):
    operator = perturbed()
    result = solved(operator, constraints)
    assert result.converged
    assert result.iterations["applications"] <= 8
    assert misses(operator, result, average_gap(), constraints) < 1e-7


@pytest.mark.parametrize("bodies", [1, 2])
def test_the_model_itself_needs_one_step(bodies):
    """Two bodies add."""
    pair = SumOfBodies(*bodies * [half_plane(bodies * MODULUS)])
    result = solved(pair)
    assert result.iterations["applications"] == 1
    assert_pressures(result, solve_contact(half_plane(), average_gap(), GRID.weights, LOADED), 1e-9)


@pytest.mark.parametrize("constraints", [LOADED, PRESSED])
def test_a_start_nearer_than_the_model_takes_no_longer(constraints):
    """The solution of nearly the same operator, and in the end the same answer."""
    operator = perturbed()
    result = solved(operator, constraints)
    start = solved(Matrix(operator.matrix * 1.001), constraints).pressure
    nearer = solved(operator, constraints, start, nearer=True)
    assert nearer.converged
    assert nearer.iterations["steps"] < result.iterations["steps"]
    assert nearer.iterations["applications"] <= result.iterations["applications"]
    assert_pressures(nearer, result, 1e-6)


@pytest.mark.parametrize("factor", [0.3, 0.7, 1.5, 3.0])
def test_a_model_of_the_wrong_modulus_does_not_change_the_answer(factor):
    result = solved(half_plane(), model=half_plane(factor * MODULUS))
    assert result.converged and result.iterations["steps"] > 1
    assert_pressures(result, solve_contact(half_plane(), average_gap(), GRID.weights, LOADED), 1e-5)


@pytest.mark.parametrize("modulus", [MODULUS, 2.0 * MODULUS])
def test_a_large_common_displacement_does_not_stall_the_iteration(modulus):
    """A rigid part of the compliance changes the approach and nothing else, whatever the model."""
    matrix = perturbed().matrix
    plain, raised = (
        solved(Matrix(matrix + rigid), model=half_plane(modulus), tolerance=1e-9)
        for rigid in (0.0, 1e4 * matrix.max())
    )
    assert plain.converged and raised.converged
    assert raised.iterations["steps"] == plain.iterations["steps"]
    assert_pressures(raised, plain, 1e-6)


@pytest.mark.parametrize("base", [0.0, 1.0, 10.0, 60.0])
def test_an_approach_takes_no_more_steps_than_its_load(base):
    """A body on a base that gives way: the half-plane takes its datum from one application."""
    by_load = solved(on_base(base))
    pressed = solved(on_base(base), Constraints(approach=by_load.approach))
    assert by_load.converged and pressed.converged
    assert pressed.iterations["applications"] == pressed.iterations["steps"] + 1
    assert by_load.iterations["steps"] - 1 <= pressed.iterations["steps"]
    assert pressed.iterations["steps"] <= by_load.iterations["steps"]
    # an approach is met to a part of all the displacement, the base's included
    assert_pressures(pressed, by_load, 1e-6 * (1.0 + base))


@pytest.mark.parametrize("base", [0.0, 1.0, 10.0, 60.0])
@pytest.mark.parametrize("change", [1e-9, 1e-8, 1e-7])
def test_on_a_base_little_is_not_taken_for_rounding(base, change):
    """The last steps still move a little, too many nodes being free to be solved for directly."""
    grid = HatGrid.within(-0.5e-3, 0.5e-3, 1e-6)
    plain = HalfPlane(grid.count, grid.pitch, MODULUS)
    model = plain.on_base(base * plain.column[0] / grid.pitch**2)
    gap = grid.hat_integrals(roller_gap(RADIUS))
    first = solve_contact(model, gap, grid.weights, LOADED)
    pressed = Constraints(approach=first.approach)
    size = np.abs(model.apply(first.pressure)).max()
    waves = change * size * np.cos(np.arange(grid.count))
    second = solve_contact(model, gap + waves, grid.weights, pressed, first.pressure)
    assert np.count_nonzero(first.pressure) > 200
    assert second.residuals.penetration < 0.05 * change


def test_a_body_on_a_base_that_gives_nearly_all_the_way_is_solved_all_the_same():
    """Further off than a datum of the model can be."""
    result = solved(on_base(1e3), Constraints(approach=1e-3), tolerance=1e-11)
    assert result.converged
    by_load = solved(on_base(1e3), Constraints(load=result.load), tolerance=1e-9)
    assert_pressures(result, by_load, 1e-5)


@pytest.mark.parametrize("above", [0.0, 3e-6])
def test_the_datum_may_come_from_a_nearby_solution(above):
    """Or from an even pressure where that one touches nowhere."""
    gap, approach = average_gap() + above * GRID.weights, Constraints(approach=1.5e-6)
    first = solved(on_base(10.0), approach, gap=gap)
    assert first.converged and (first.load > 0.0) == (above == 0.0)
    for start in (first.pressure, np.zeros(GRID.count)):
        again = solved(on_base(10.0), approach, start, gap=gap)
        assert again.converged
        assert again.iterations["steps"] <= first.iterations["steps"]
        assert_pressures(again, first, 1e-5)


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


def sliding(friction_dundurs: float, modulus: float = MODULUS) -> CoupledPair:
    return coupled_half_planes(GRID.count, GRID.pitch, modulus, friction_dundurs)


def dragged(operator, model, gap: np.ndarray, constraints=LIGHT) -> ContactSolution:
    """The sliding contact with a coupled model."""
    weights = GRID.weights
    return solve_with_model(operator, model, gap, weights, constraints)


def misses(operator, result, gap: np.ndarray, constraints: Constraints) -> float:
    """How far the contact conditions fail, over the range of displacements; written anew."""
    moved = operator.apply(result.pressure)
    gap = gap + moved - result.approach * GRID.weights
    touching = result.pressure > 0.0
    free = touching & (result.pressure < 0.999999 * constraints.hardness)
    wrong = [np.abs(gap[free]), -gap[~touching], gap[touching & ~free], -result.pressure]
    return max(np.max(excess, initial=0.0) for excess in wrong) / np.ptp(moved)


class TestSurfacesMovedByFriction:
    @pytest.mark.parametrize("constraints", [LIGHT, CAPPED, Constraints(approach=3e-7)])
    @pytest.mark.parametrize("friction_dundurs", [0.05, -0.15, 0.5])
    def test_result_is_that_of_the_operator(self, friction_dundurs, constraints):
        """A few per cent beside the model: as few steps as without friction."""
        symmetric = toeplitz(half_plane().column)
        skew = sliding(friction_dundurs).block(np.arange(GRID.count)) - symmetric
        operator, gap = Matrix(perturbed().matrix + 1.05 * skew), rough_gap(4)
        result = dragged(operator, sliding(friction_dundurs), gap, constraints)
        assert result.converged
        assert result.iterations["steps"] == result.iterations["applications"] <= 9
        assert misses(operator, result, gap, constraints) < 1e-7

    def test_without_a_skew_part_it_is_the_frictionless_contact(self):
        one = dragged(perturbed(), sliding(0.0), rough_gap(4))
        other = solved(perturbed(), LIGHT, gap=rough_gap(4))
        assert_pressures(one, other, 1e-12)
        assert one.iterations == other.iterations

    @pytest.mark.parametrize("constraints", [LIGHT, CAPPED])
    @pytest.mark.parametrize("factor", [0.3, 2.5])
    @pytest.mark.parametrize("seed", [3, 4, 5])
    def test_a_model_of_the_wrong_modulus_does_not_change_the_answer(
        self, seed, factor, constraints
    ):
        gap = rough_gap(seed)
        result = dragged(sliding(0.3), sliding(0.3, factor * MODULUS), gap, constraints)
        assert result.converged and result.iterations["steps"] > 2
        assert_pressures(result, solve_coupled(sliding(0.3), gap, GRID.weights, constraints), 1e-5)

    def test_where_no_whole_step_comes_nearer_shorter_ones_do(self):
        """A model five times too stiff."""
        problem = sliding(0.3), sliding(0.3, 5.0 * MODULUS), rough_gap(3)
        result = dragged(*problem)
        assert result.converged
        assert_pressures(result, solve_coupled(sliding(0.3), problem[2], GRID.weights, LIGHT), 1e-5)

    def test_a_model_without_friction_takes_more_steps_to_the_same(self):
        gap, steps = rough_gap(6), []
        right = solve_coupled(sliding(0.3), gap, GRID.weights, LIGHT)
        for known in (0.3, 0.15, 0.0):
            result = dragged(sliding(0.3), sliding(known), gap)
            assert result.converged
            assert_pressures(result, right, 1e-6)
            steps.append(result.iterations["steps"])
        assert steps[0] == 1 < steps[1] < steps[2] <= 16

    @pytest.mark.parametrize("base", ["bonded", "frictionless"])
    @pytest.mark.parametrize(("thickness", "most"), [(1e-3, 7), (1e-4, 16)])
    def test_a_layer_thinner_than_the_contact(self, base, thickness, most):
        """Half-width 0.15 mm: the half-plane still leads there."""
        body = LayeredBody(Material(105e9, 0.3), thickness, base)
        parts = (kind(GRID.count, GRID.pitch, body) for kind in (LayeredSurface, TangentialLayer))
        operator, gap = CoupledPair(*parts, 0.5), rough_gap(7)
        result = dragged(operator, sliding(0.5 * 2 / 7), gap, LOADED)
        assert result.converged and result.iterations["steps"] <= most
        assert_pressures(result, solve_coupled(operator, gap, GRID.weights, LOADED), 1e-6)

    def test_what_does_not_converge_is_the_best_of_all_steps(self, monkeypatch):
        """So that more of them never make it worse."""
        matrix = sliding(0.3).block(np.arange(GRID.count))
        noise = np.random.default_rng(2).standard_normal(matrix.shape)
        operator, worst = Matrix(matrix + matrix.max() * noise), []
        for steps in (1, 2, 5, 6, 7, 8, 20, 40):
            monkeypatch.setattr(defect, "MAX_STEPS", steps)
            result = dragged(operator, sliding(0.3), rough_gap(3))
            assert not result.converged and result.iterations["steps"] == steps
            worst.append(result.residuals.worst)
        assert sorted(worst, reverse=True) == worst
        assert 1e-6 < worst[-1] < worst[0]


def test_no_pressure_under_an_approach_that_closes_the_gap_is_no_solution():
    """Holds in whatever unit of length."""
    for unit in (1.0, 1e-9):
        gap, weights = np.array([0.2, 0.0, 0.2]) * unit**2, np.ones(3) * unit
        limits = Constraints(approach=0.1 * unit)
        result = assessed(np.zeros(3), np.zeros(3), gap, weights, 0.1 * unit, limits, {})
        assert result.residuals.penetration == pytest.approx(1.0)
