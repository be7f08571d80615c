"""The contact solver on the half-plane: Hertz, limits, hard cases, residuals."""

import numpy as np
import pytest
from hats import solved
from scipy.linalg import toeplitz
from scipy.optimize import nnls
from strips import StripHalfPlane

from analytic.contact import exchange
from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactError, Residuals, assessed, solve_contact
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid, roller_gap
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane


def test_two_thousand_elements_meet_hertz(roller):
    reach = 1.5 * roller.hertz.half_width
    grid = HatGrid.within(-reach, reach, 2.0 * reach / 2000)
    solution = roller.pressed(grid, roller.smooth())
    patch = contact_patches(grid.x, solution.pressure, solution.gap)
    assert solution.pressure.max() / roller.hertz.peak_pressure == pytest.approx(1.0, abs=1e-5)
    assert np.ptp(patch) / 2.0 / roller.hertz.half_width == pytest.approx(1.0, abs=1e-4)
    assert len(patch) == 1


def test_uniform_strips_converge_to_hertz(roller):
    """The method as published: collocated strips, of first order at the contact's edge."""
    errors = []
    for elements in (120, 240, 480, 960):
        reach = 1.5 * roller.hertz.half_width
        grid = HatGrid.within(-reach, reach, 2.0 * reach / elements)
        operator = StripHalfPlane(grid.count, grid.pitch, roller.modulus)
        gap = grid.pitch * roller.smooth()(grid.x)
        solution = solved(operator, gap, load=roller.load)
        exact = roller.hertz.pressure(grid.x)
        errors.append(np.linalg.norm(solution.pressure - exact) / np.linalg.norm(exact))
    assert np.log2(errors[0] / errors[-1]) / 3.0 == pytest.approx(1.0, abs=0.1)
    assert errors[-1] < 1e-3
    assert solution.pressure.max() / roller.hertz.peak_pressure == pytest.approx(1.0, abs=1e-5)


ROUGH_GRID = HatGrid.within(-0.9e-3, 0.9e-3, 4e-6)


def dense_oracle(roller, grid, gap):
    """Pressures by non-negative least squares on the Cholesky factor, approach by bisection."""
    factor = np.linalg.cholesky(toeplitz(HalfPlane(grid.count, grid.pitch, roller.modulus).column))
    size = np.abs(factor).max()
    weighted_gap = grid.hat_integrals(gap)

    def at(approach):
        target = np.linalg.solve(factor, approach * grid.weights - weighted_gap)
        scale = np.abs(target).max()
        return nnls(factor.T / size, target / scale, maxiter=20000)[0] * (scale / size)

    low, high = -1e-5, 1e-4
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if grid.weights @ at(middle) < roller.load else (low, middle)
    return at(0.5 * (low + high))


@pytest.mark.parametrize("seed", [1, 2])
def test_rough_contact_agrees_with_non_negative_least_squares(roller, seed):
    grid = HatGrid.within(-0.8e-3, 0.8e-3, 10e-6)
    solution = roller.pressed(grid, roller.rough(seed))
    oracle = dense_oracle(roller, grid, roller.rough(seed))
    assert len(contact_patches(grid.x, solution.pressure, solution.gap)) > 3
    assert solution.pressure == pytest.approx(oracle, abs=1e-6 * oracle.max())


@pytest.mark.parametrize("seed", range(6))
def test_the_primal_method_reaches_the_same_solution(roller, seed, monkeypatch):
    """The method that ends the cycles of the fast one must solve every problem by itself."""
    gap = roller.rough(seed)
    constraints = Constraints(load=0.3 * roller.load, hardness=3e9)
    grid = HatGrid.within(-0.5e-3, 0.5e-3, 8e-6)
    fast = roller.pressed(grid, gap, constraints)
    monkeypatch.setattr(exchange, "MAX_EXCHANGES", 0)
    slow = roller.pressed(grid, gap, constraints)
    assert slow.iterations["exchanges"] < 8 * fast.iterations["exchanges"]
    assert slow.pressure == pytest.approx(fast.pressure, abs=1e-7 * fast.pressure.max())


class TestHardness:
    def test_a_load_beyond_the_hardness_is_refused(self, roller):
        with pytest.raises(ContactError, match="exceeds what the surface can carry"):
            roller.pressed(ROUGH_GRID, roller.rough(7), Constraints(load=roller.load, hardness=1e9))

    @pytest.mark.parametrize("count", [1023, 4095, 16383])
    @pytest.mark.parametrize("above_mean", [1.05, 1.5])
    def test_a_plateau_costs_few_exchanges(self, roller, count, above_mean):
        """Nearly every node at the hardness, where block exchanges may come round in a circle."""
        reach = 2.0 * roller.hertz.half_width
        grid = HatGrid.within(-reach, reach, 2.0 * reach / (count + 1))
        hardness = above_mean * roller.load / grid.weights.sum()
        limits = Constraints(load=roller.load, hardness=hardness)
        solution = roller.pressed(grid, roller.smooth(), limits)
        assert solution.iterations["applications"] < 200
        assert np.mean(solution.pressure >= hardness) == pytest.approx(1.0 / above_mean, abs=5e-3)


class TestLimits:
    def test_one_touching_node_at_vanishing_load(self, roller):
        solution = roller.pressed(ROUGH_GRID, roller.rough(1), Constraints(load=1e-6))
        assert np.count_nonzero(solution.pressure) == 1

    @pytest.mark.parametrize("load", [1e-2, 1e-6])
    def test_a_light_load_under_a_far_surface_costs_no_more(self, roller, load):
        """A common gap a million times the compression must not drown it in rounding."""
        half_width = hertz_from_load(load, roller.radius, roller.modulus).half_width
        grid = HatGrid.within(-3.0 * half_width, 3.0 * half_width, half_width / 150.0)
        near, far = (
            roller.pressed(grid, lambda x, c=c: roller.smooth()(x) + c, Constraints(load=load))
            for c in (0.0, 1e6 * half_width**2 / roller.radius)
        )
        assert far.iterations["applications"] < 3 * near.iterations["applications"]
        assert far.pressure == pytest.approx(near.pressure, abs=1e-4 * near.pressure.max())

    def test_full_contact_of_a_shallow_wave(self, roller):
        """All gaps closed: p - p_smooth is E* times slope amplitude over two, in phase."""
        grid = HatGrid.within(-2e-3, 2e-3, 2e-6)
        wavelength, height = 100e-6, 0.01e-6
        wave = 2.0 * np.pi / wavelength
        plain = roller.pressed(grid, roller.smooth())
        rough = roller.pressed(grid, lambda x: roller.smooth()(x) - height * np.cos(wave * x))
        inside = np.abs(grid.x) < 0.5 * roller.hertz.half_width
        expected = 0.5 * roller.modulus * height * wave * np.cos(wave * grid.x)
        added = (rough.pressure - plain.pressure)[inside]
        assert added == pytest.approx(expected[inside], abs=0.02 * expected.max())

    def test_no_contact_below_the_first_touch(self, roller):
        solution = roller.pressed(ROUGH_GRID, roller.smooth(), Constraints(approach=-1e-6))
        assert not solution.pressure.any() and solution.load == 0.0

    @pytest.mark.parametrize(
        "wrong", [{}, {"load": 1.0, "approach": 1.0}, {"load": -1.0}, {"load": np.nan}]
    )
    def test_constraints_that_make_no_sense(self, wrong):
        with pytest.raises(ValueError):
            Constraints(**wrong)


def test_residuals_see_each_kind_of_error(roller):
    reach = 1.5 * roller.hertz.half_width
    grid = HatGrid.within(-reach, reach, 0.01 * reach)
    solution = roller.pressed(grid, roller.smooth())
    operator = HalfPlane(grid.count, grid.pitch, roller.modulus)
    weighted_gap = grid.hat_integrals(roller.smooth())

    def residuals(pressure, approach=solution.approach, hardness=np.inf):
        limits = Constraints(load=roller.load, hardness=hardness)
        moved = operator.apply(pressure)
        checked = assessed(moved, pressure, weighted_gap, grid.weights, approach, limits, {})
        return checked.residuals

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
    state = assessed(displacement, pressure, weighted_gap, grid.weights, approach, constraints, {})
    assert state.gap[~inner].max() > 1e-8
    assert state.residuals.complementarity > 0.01


def test_a_residual_that_is_no_number_does_not_count_as_met():
    none = Residuals(0.0, np.nan, 0.0, 0.0, 0.0)
    assert not none.worst <= 1.0
    operator, load = HalfPlane(8, 1.0, 1.0), Constraints(load=1e-200)
    light = solve_contact(operator, np.arange(8.0), np.ones(8), load)
    assert np.isfinite(light.residuals.worst)


def test_a_coating_too_stiff_for_rounding_ends_unconverged_and_carries_the_load():
    """Diamond-like carbon on rubber: waves of 1.5 um give way 1e10 times less than those of mm."""
    grid = HatGrid.within(-1.508e-3, 1.508e-3, 1.508e-6)
    rubber, coating = Material(68.54e3, 0.49), Material(232e9, 0.2)
    operator = LayeredSurface(grid.count, grid.pitch, LayeredBody(coating, 2e-6, rubber))
    gap, load = grid.hat_integrals(roller_gap(0.1)), 0.7084
    solution = solve_contact(operator, gap, grid.weights, Constraints(load=load))
    assert solution.iterations["exchanges"] < 2000
    assert not solution.converged
    assert solution.pressure.min() == 0.0
    assert grid.weights @ solution.pressure == pytest.approx(load, rel=1e-6)
