"""Sliding contact with the surfaces moved by friction: exact solution, symmetries, matrix; it ends
whatever it starts from."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import toeplitz

from analytic.contact import coupled as coupled_contact
from analytic.contact.coupled import CoupledEquilibrium, solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactError, assessed
from analytic.exact.sliding import sliding_from_load
from analytic.grid import HatGrid
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import TangentialLayer
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from analytic.operators.tangential import CoupledPair, coupled_half_planes, hat_sign

PAIRS = [(0.1, 2 / 7), (0.3, 2 / 7), (0.5, 2 / 7), (0.3, 0.1), (0.5, 0.5)]  # mu, beta


def sliding_errors(roller, friction_dundurs: float, elements: int):
    """L2 and peak error and largest edge error [pitches], over offsets of the apex off a node:
    the error depends on where the edges fall between two nodes."""
    sliding = sliding_from_load(roller.load, roller.radius, roller.modulus, friction_dundurs, 1.0)
    square, peak, edge = [], [], []
    for offset in np.arange(8) / 8:
        pitch = 3.6 * roller.hertz.half_width / elements
        grid = HatGrid.within(-2.0 * roller.hertz.half_width, 1.6 * roller.hertz.half_width, pitch)
        shift = offset * pitch
        solution = roller.sliding(grid, lambda x, s=shift: roller.smooth()(x - s), friction_dundurs)
        exact = sliding.pressure(grid.x - shift)
        square.append(np.sum((solution.pressure - exact) ** 2) / np.sum(exact**2))
        peak.append(abs(solution.pressure.max() / sliding.peak_pressure - 1.0))
        patch = contact_patches(grid.x, solution.pressure, solution.gap)[0] - shift
        edge.append(np.abs(patch - sliding.edges).max() / pitch)
    return np.sqrt(np.mean(square)), np.mean(peak), max(edge)


class TestSlidingCylinder:
    @pytest.mark.parametrize(("mu", "beta"), PAIRS)
    def test_exact_solutions(self, roller, mu, beta):
        exact = sliding_from_load(roller.load, roller.radius, roller.modulus, mu, beta)
        reach = 1.5 * roller.hertz.half_width
        grid = HatGrid.within(-reach, reach, 2.0 * reach / 2000)
        solution = roller.sliding(grid, roller.smooth(), mu * beta)
        patch = contact_patches(grid.x, solution.pressure, solution.gap)
        assert len(patch) == 1
        assert solution.pressure.max() == pytest.approx(exact.peak_pressure, rel=1e-6)
        assert np.abs(patch[0] - exact.edges).max() < 0.1 * grid.pitch
        x = np.mean(exact.edges) + exact.half_width * np.array([-0.9, -0.5, 0.0, 0.5, 0.9])
        at_points = np.interp(x, grid.x, solution.pressure)
        assert at_points == pytest.approx(exact.pressure(x), rel=1e-5)
        centroid = grid.x @ solution.pressure / solution.pressure.sum()
        assert centroid == pytest.approx(exact.load_position, abs=1e-6 * roller.hertz.half_width)
        # friction drags the body's surface to +x: the contact moves to -x
        assert patch[0].mean() < 0.0 and centroid < 0.0

    @pytest.mark.parametrize("friction_dundurs", [0.0, 0.25, 0.75])
    def test_orders_are_those_of_the_singular_edge(self, roller, friction_dundurs):
        """p goes as s^(1/2 - n) at the trailing edge, n = atan(mu beta)/pi. Hats follow any other
        x with order 2, so the L2 order is that exponent and a half more; the peak is smooth.
        """
        errors = [sliding_errors(roller, friction_dundurs, n) for n in (120, 480, 1920)]
        l2, peak, edge = (np.array(e) for e in zip(*errors, strict=True))
        expected = 1.0 - np.arctan(friction_dundurs) / np.pi
        assert 0.5 * np.log2(l2[:-1] / l2[1:]) == pytest.approx(expected, abs=0.05)
        assert 0.5 * np.log2(peak[:-1] / peak[1:]).mean() == pytest.approx(2.0, abs=0.2)
        assert l2[-1] < 4e-3 and peak[-1] < 1e-6
        assert edge.max() < 0.25

    def test_small_shift_is_proportional_to_friction_and_beta(self, roller):
        """Centre at -2 n h, n = atan(mu beta)/pi; the peak changes in second order."""
        half_width = roller.hertz.half_width
        reach = 1.3 * half_width
        grid = HatGrid.within(-reach, reach, 2.0 * reach / 1000)
        plain = roller.pressed(grid, roller.smooth())
        for size in (1e-6, 1e-4, 1e-2):
            solution = roller.sliding(grid, roller.smooth(), size)
            moved = grid.x @ (solution.pressure - plain.pressure) / solution.pressure.sum()
            assert moved == pytest.approx(-8.0 / (3.0 * np.pi) * size * half_width, rel=1e-3)
            assert abs(solution.pressure.max() / plain.pressure.max() - 1.0) < 0.2 * size**2 + 1e-7


@pytest.fixture(params=["smooth", "rough"])
def gap(request, roller):
    return roller.smooth() if request.param == "smooth" else roller.rough(1)


class TestSymmetries:
    def test_without_friction_it_is_the_uncoupled_solution_bit_for_bit(self, roller, gap):
        coupled, plain = roller.sliding(roller.grid, gap, 0.0), roller.pressed(roller.grid, gap)
        assert np.array_equal(coupled.pressure, plain.pressure)
        assert coupled.iterations == plain.iterations

    def test_hardly_any_friction_changes_hardly_anything(self, roller, gap):
        coupled, plain = roller.sliding(roller.grid, gap, 1e-12), roller.pressed(roller.grid, gap)
        assert coupled.pressure == pytest.approx(plain.pressure, abs=1e-8 * plain.pressure.max())
        assert coupled.approach == pytest.approx(plain.approach, rel=1e-9)

    def test_sliding_the_other_way_is_the_mirror(self, roller, gap, friction_dundurs):
        """So is changing the places of the bodies: either turns the sign of mu beta."""
        grid = HatGrid(4e-6, -275, 275)
        forth = roller.sliding(grid, gap, friction_dundurs)
        back = roller.sliding(grid, lambda x: gap(-x), -friction_dundurs)
        error = np.abs(forth.pressure - back.pressure[::-1]).max()
        assert error < 1e-8 * forth.pressure.max()

    def test_lengths_and_moduli_scale(self, roller, gap):
        """Pressure with the modulus, load with modulus and length: figures to rounding."""
        grid = roller.grid
        solution = roller.sliding(grid, gap, 0.3)
        length, stiffness = 1e-7, 1e4
        small = HatGrid(grid.pitch * length, grid.first, grid.last)
        other = solve_coupled(
            coupled_half_planes(small.count, small.pitch, roller.modulus * stiffness, 0.3),
            grid.hat_integrals(gap) * length**2,
            small.weights,
            Constraints(load=roller.load * stiffness * length),
        )
        error = np.abs(other.pressure / stiffness - solution.pressure).max()
        assert error < 1e-8 * solution.pressure.max()

    def test_prescribed_approach_returns_the_load(self, roller, gap, friction_dundurs):
        by_load = roller.sliding(roller.grid, gap, friction_dundurs)
        approach = Constraints(approach=by_load.approach)
        by_approach = roller.sliding(roller.grid, gap, friction_dundurs, approach)
        assert by_approach.load == pytest.approx(roller.load, rel=1e-8)


@pytest.mark.parametrize("hardness", [np.inf, 6e9])
def test_conditions_hold_on_the_dense_matrix(roller, friction_dundurs, hardness):
    """Signs by the matrix itself; on its own set the solution is that of the linear system."""
    constraints, grid = Constraints(load=roller.load, hardness=hardness), roller.grid
    gap, weights = roller.rough(2), grid.weights
    first = roller.sliding(grid, gap, friction_dundurs, constraints)
    even = HalfPlane(grid.count, grid.pitch, roller.modulus).column
    odd = friction_dundurs * grid.pitch**2 / roller.modulus * hat_sign(np.arange(grid.count))
    matrix = toeplitz(even + odd, even - odd)
    moved, weighted_gap = matrix @ first.pressure, grid.hat_integrals(gap)
    again = assessed(moved, first.pressure, weighted_gap, weights, first.approach, constraints, {})
    assert again.residuals.worst < 1e-9
    capped = first.pressure >= hardness
    assert capped.any() == np.isfinite(hardness)
    assert np.all(first.gap[capped] < 1e-12)
    free = np.flatnonzero((first.pressure > 0.0) & ~capped)
    assert len(contact_patches(grid.x, first.pressure, first.gap)) > 3
    system = np.zeros((len(free) + 1, len(free) + 1))
    system[:-1, :-1] = matrix[np.ix_(free, free)]
    system[:-1, -1], system[-1, :-1] = -weights[free], weights[free]
    held = np.where(capped, first.pressure, 0.0)
    known = -(weighted_gap + matrix @ held)[free]
    solved = np.linalg.solve(system, np.append(known, roller.load - weights @ held))[:-1]
    assert first.pressure[free] == pytest.approx(solved, abs=1e-7 * solved.max())


def test_a_layer_on_its_own_material_drags_as_a_half_plane_does(roller):
    grid = HatGrid.within(-1.1e-3, 1.1e-3, 8e-6)
    normal = HalfPlane(grid.count, grid.pitch, roller.modulus)
    layer = Material(roller.modulus, 0.0)  # beta 1/2
    tangential = TangentialLayer(grid.count, grid.pitch, LayeredBody(layer, 1.0, layer))
    pair = CoupledPair(normal, tangential, 0.6)
    weighted_gap = grid.hat_integrals(roller.rough(1))
    solution = solve_coupled(pair, weighted_gap, grid.weights, Constraints(load=roller.load))
    expected = roller.sliding(grid, roller.rough(1), 0.3)
    assert solution.converged
    assert solution.pressure == pytest.approx(expected.pressure, abs=1e-7 * expected.pressure.max())


class TestContraction:
    """The part with a proof, alone: what exchanges that never settle are left to."""

    @pytest.fixture
    def unsettled(self, monkeypatch):
        monkeypatch.setattr(
            coupled_contact, "exchange_blocks", lambda problem, start: (start, None, False)
        )

    @pytest.mark.parametrize("friction_dundurs", [0.05, 0.3, 0.75, 1.5])
    def test_it_finds_the_same_solution(self, roller, friction_dundurs, monkeypatch, unsettled):
        grid = HatGrid.within(-1.1e-3, 1.1e-3, 10e-6)
        solution = roller.sliding(grid, roller.rough(1), friction_dundurs)
        monkeypatch.undo()
        expected = roller.sliding(grid, roller.rough(1), friction_dundurs)
        assert solution.iterations["contractions"] > 1
        assert expected.iterations["contractions"] == 0
        error = np.abs(solution.pressure - expected.pressure).max()
        assert error < 1e-7 * expected.pressure.max()
        assert solution.approach == pytest.approx(expected.approach, rel=1e-8)

    @pytest.mark.parametrize("hardness", [np.inf, 6e9])
    def test_prescribed_approach_and_hardness(self, roller, hardness, monkeypatch, unsettled):
        grid = HatGrid.within(-1.1e-3, 1.1e-3, 10e-6)
        constraints = Constraints(approach=3e-5, hardness=hardness)
        solution = roller.sliding(grid, roller.rough(1), 0.3, constraints)
        monkeypatch.undo()
        expected = roller.sliding(grid, roller.rough(1), 0.3, constraints)
        assert solution.load == pytest.approx(expected.load, rel=1e-7)


def test_a_set_that_returns_ends_the_exchanges(roller, monkeypatch):
    """A node that changes active for ever: the contraction finishes what they cannot."""
    violations = CoupledEquilibrium.violations

    def restless(self, rest, active):
        violated = violations(self, rest, active)
        tensile, joining = violated.tensile.copy(), violated.joining.copy()
        tensile[0], joining[0] = not active.lower[0], active.lower[0]
        return replace(violated, tensile=tensile, joining=joining)

    monkeypatch.setattr(CoupledEquilibrium, "violations", restless)
    solution = roller.sliding(roller.grid, roller.rough(1), 0.3)
    assert solution.iterations["contractions"] > 1
    assert solution.iterations["exchanges"] < 100


class TestCost:
    """Applications, not seconds."""

    @pytest.mark.parametrize("amplitude", [0.0, 0.4e-6, 4e-6])
    def test_three_times_the_uncoupled_problem_at_most(self, roller, amplitude, friction_dundurs):
        grid = HatGrid.within(-1.3e-3, 1.3e-3, 2.6e-3 / 4000)
        gap = roller.rough(1, amplitude)
        plain, coupled = roller.pressed(grid, gap), roller.sliding(grid, gap, friction_dundurs)
        assert coupled.iterations["contractions"] == 0
        assert coupled.iterations["applications"] < 3.0 * plain.iterations["applications"]

    def test_hardly_grows_with_the_number_of_elements(self, roller, friction_dundurs):
        """A profile of fixed bandwidth: each doubling adds a level, which takes as many as the
        last, about a dozen."""
        spent = []
        for elements in (2000, 8000, 32000):
            grid = HatGrid.within(-1.1e-3, 1.1e-3, 2.2e-3 / elements)
            solution = roller.sliding(grid, roller.rough(3), friction_dundurs)
            spent.append(solution.iterations["applications"])
        assert spent[-1] < 150
        assert max(np.diff(spent)) < 2 * 20

    def test_a_bad_start_costs_no_more_than_a_search_in_vain(self, roller):
        """All nodes touching, or one: where exchanges do not settle the coarser grids help."""
        expected = roller.sliding(roller.grid, roller.rough(1), 0.75)
        for start in (np.ones(roller.grid.count), np.eye(roller.grid.count)[3]):
            solution = roller.sliding(roller.grid, roller.rough(1), 0.75, start=start)
            error = np.abs(solution.pressure - expected.pressure).max()
            assert error < 1e-7 * expected.pressure.max()


@settings(max_examples=40, deadline=None, derandomize=True, database=None)
@given(
    seed=st.integers(0, 10**6),
    friction_dundurs=st.floats(-0.75, 0.75),
    amplitude=st.floats(0.0, 5e-6),
    load=st.floats(1e3, 5e6),
    hardness=st.sampled_from([np.inf, 1e10]),
)
def test_any_contact_ends_and_holds(roller, seed, friction_dundurs, amplitude, load, hardness):
    grid = HatGrid.within(-1.6e-3, 1.6e-3, 8e-6)
    constraints = Constraints(load=load, hardness=hardness)
    solution = roller.sliding(grid, roller.rough(seed, amplitude), friction_dundurs, constraints)
    assert solution.pressure.min() >= 0.0 and solution.pressure.max() <= hardness


def test_more_load_than_the_hardness_carries_is_refused(roller):
    with pytest.raises(ContactError, match="exceeds what the surface can carry"):
        too_soft = Constraints(load=roller.load, hardness=1e9)
        roller.sliding(roller.grid, roller.rough(1), 0.3, too_soft)


def test_a_vanishing_load_rests_on_one_crest(roller):
    solution = roller.sliding(roller.grid, roller.rough(1), 0.5, Constraints(load=1e-9))
    assert np.count_nonzero(solution.pressure) <= 2
