"""Sliding contact with the surfaces moved by friction: exact solution, limits, termination."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import toeplitz

from analytic import coupled_contact
from analytic.contact import ContactError, contact_residuals, solve_contact
from analytic.coupled_contact import solve_coupled
from analytic.coupled_equilibrium import CoupledEquilibrium, krylov_step
from analytic.coupling import CoupledHalfPlane, CoupledPair, TangentialHalfPlane, hat_sign
from analytic.equilibrium import Constraints
from analytic.exact.hertz import hertz_from_load
from analytic.gap import HatGrid, roller_gap
from analytic.operators import DenseCompliance, HalfPlane
from analytic.patches import contact_patches
from analytic.periodic import PeriodicHalfPlane

DATA = Path(__file__).resolve().parents[1] / "data"
REFERENCES = json.loads((DATA / "f_rounded_punch_and_sliding.json").read_text(encoding="utf-8"))
SLIDING = REFERENCES["sliding_cylinder"]
RADIUS, MODULUS, LOAD = 7.5706e-3, 115.385e9, 3.55e6
HERTZ = hertz_from_load(LOAD, RADIUS, MODULUS)
COUPLINGS = [0.05, 0.3, 0.75]  # mu beta; the last is friction 1.5 at the largest beta


def pressed(grid, gap, friction_dundurs, constraints=None, start=None):
    """Solution on a grid, load prescribed unless said otherwise."""
    return solve_coupled(
        CoupledHalfPlane(grid.count, grid.pitch, MODULUS, friction_dundurs),
        grid.average(gap),
        grid.weights,
        constraints or Constraints(load=LOAD),
        start,
    )


def uncoupled(grid, gap, constraints=None):
    return solve_contact(
        HalfPlane(grid.count, grid.pitch, MODULUS),
        grid.average(gap),
        grid.weights,
        constraints or Constraints(load=LOAD),
    )


def rough_gap(seed: int, amplitude: float = 0.4e-6):
    """Roller over a seeded sum of waves from 20 um to 200 um."""
    rng = np.random.default_rng(seed)
    waves = 2.0 * np.pi / np.geomspace(20e-6, 200e-6, 12)
    phases, heights = rng.uniform(0, 2 * np.pi, 12), rng.normal(0, amplitude / 3, 12)

    def gap(x):
        ripple = np.cos(np.multiply.outer(x, waves) + phases) @ heights
        return roller_gap(RADIUS)(x) - ripple

    return gap


ROUGH_GRID = HatGrid.within(-1.1e-3, 1.1e-3, 4e-6)


class Reference:
    """A row of the tabulated sliding cylinder, under LOAD, in metres and pascals."""

    def __init__(self, row: dict) -> None:
        top, _, bottom = row["beta"].partition("/")
        self.friction_dundurs = float(top) / float(bottom or 1.0) * float(row["mu"])
        self.half = np.sqrt(LOAD * RADIUS / (MODULUS * float(row["P_R_over_Estar_ahalf2"])))
        self.edges = self.half * np.array(
            [-float(row["b_trailing_over_ahalf"]), float(row["c_leading_over_ahalf"])]
        )
        self.peak = float(row["peak_p_R_over_Estar_ahalf"]) * MODULUS * self.half / RADIUS
        self.centroid = float(row["load_line_x_over_ahalf"]) * self.half
        profile = row["profile_about_contact_centre"]
        self.x = self.edges.mean() + self.half * np.array([float(p["xi"]) for p in profile])
        self.pressure = (
            np.array([float(p["p_R_over_Estar_ahalf"]) for p in profile])
            * MODULUS
            * self.half
            / RADIUS
        )


CASES = [pytest.param(Reference(row), id=f"beta {row['beta']} mu {row['mu']}") for row in SLIDING]


def exact_pressure(friction_dundurs: float):
    """Edges (2,) [m] and pressure(x) [Pa] of the header's formula, for any mu beta."""
    shift = np.arctan(friction_dundurs) / np.pi
    half = np.sqrt(4.0 * LOAD * RADIUS / (np.pi * MODULUS * (1.0 - 4.0 * shift**2)))
    leading, trailing = 0.5 + shift, 0.5 - shift
    b, c = 2.0 * leading * half, 2.0 * trailing * half

    def pressure(x):
        sides = np.maximum(c - x, 0.0) ** leading * np.maximum(x + b, 0.0) ** trailing
        return MODULUS / (2.0 * RADIUS) * np.sin(np.pi * leading) * sides

    return np.array([-b, c]), pressure


def sliding_errors(friction_dundurs: float, elements: int):
    """L2 and peak error and largest edge error [pitches], over offsets of the apex off a node:
    the error depends on where the edges fall between two nodes."""
    edges, pressure = exact_pressure(friction_dundurs)
    highest = pressure(np.linspace(*edges, 20001)).max()
    square, peak, edge = [], [], []
    for offset in np.arange(8) / 8:
        pitch = 3.6 * HERTZ.half_width / elements
        grid = HatGrid.within(-2.0 * HERTZ.half_width, 1.6 * HERTZ.half_width, pitch)
        shift = offset * pitch
        found = pressed(grid, lambda x, s=shift: roller_gap(RADIUS)(x - s), friction_dundurs)
        exact = pressure(grid.x - shift)
        square.append(np.sum((found.pressure - exact) ** 2) / np.sum(exact**2))
        peak.append(abs(found.pressure.max() / highest - 1.0))
        patch = contact_patches(grid.x, found.pressure, found.gap)[0] - shift
        edge.append(np.abs(patch - edges).max() / pitch)
    return np.sqrt(np.mean(square)), np.mean(peak), max(edge)


class TestSlidingCylinder:
    @pytest.mark.parametrize("reference", CASES)
    def test_tabulated_solutions(self, reference):
        reach = 1.5 * HERTZ.half_width
        grid = HatGrid.within(-reach, reach, 2.0 * reach / 2000)
        found = pressed(grid, roller_gap(RADIUS), reference.friction_dundurs)
        patch = contact_patches(grid.x, found.pressure, found.gap)
        assert found.converged and len(patch) == 1
        assert found.pressure.max() == pytest.approx(reference.peak, rel=1e-6)
        assert np.abs(patch[0] - reference.edges).max() < 0.1 * grid.pitch
        at_points = np.interp(reference.x, grid.x, found.pressure)
        assert at_points == pytest.approx(reference.pressure, rel=1e-5)
        centroid = grid.x @ found.pressure / found.pressure.sum()
        assert centroid == pytest.approx(reference.centroid, abs=1e-6 * HERTZ.half_width)
        # friction drags the body's surface to +x: the contact moves to -x
        assert patch[0].mean() < 0.0 and centroid < 0.0

    @pytest.mark.parametrize("friction_dundurs", [0.25, 0.75])
    def test_orders_are_those_of_the_singular_edge(self, friction_dundurs):
        """p goes as s^(1/2 - n) at the trailing edge, n = atan(mu beta)/pi. Hats follow any other
        place with order 2, so the L2 order is that exponent and a half more; the peak is smooth.
        """
        errors = [sliding_errors(friction_dundurs, elements) for elements in (120, 480, 1920)]
        l2, peak, edge = (np.array(e) for e in zip(*errors, strict=True))
        expected = 1.0 - np.arctan(friction_dundurs) / np.pi
        assert 0.5 * np.log2(l2[:-1] / l2[1:]) == pytest.approx(expected, abs=0.05)
        assert 0.5 * np.log2(peak[:-1] / peak[1:]).mean() == pytest.approx(2.0, abs=0.2)
        assert l2[-1] < 4e-3 and peak[-1] < 1e-6
        assert edge.max() < 0.25

    def test_small_shift_is_proportional_to_friction_and_beta(self):
        """Centre at -2 n h, n = atan(mu beta)/pi; the peak changes in second order."""
        reach = 1.3 * HERTZ.half_width
        grid = HatGrid.within(-reach, reach, 2.0 * reach / 1000)
        plain = uncoupled(grid, roller_gap(RADIUS))
        for size in (1e-6, 1e-4, 1e-2):
            found = pressed(grid, roller_gap(RADIUS), size)
            moved = grid.x @ (found.pressure - plain.pressure) / found.pressure.sum()
            assert moved == pytest.approx(-8.0 / (3.0 * np.pi) * size * HERTZ.half_width, rel=1e-3)
            assert abs(found.pressure.max() / plain.pressure.max() - 1.0) < 0.2 * size**2 + 1e-7


@pytest.mark.parametrize("gap", [roller_gap(RADIUS), rough_gap(1)], ids=["smooth", "rough"])
class TestSymmetries:
    def test_without_friction_it_is_the_uncoupled_solution_bit_for_bit(self, gap):
        found, plain = pressed(ROUGH_GRID, gap, 0.0), uncoupled(ROUGH_GRID, gap)
        assert np.array_equal(found.pressure, plain.pressure)
        assert found.iterations == plain.iterations

    def test_hardly_any_friction_changes_hardly_anything(self, gap):
        found, plain = pressed(ROUGH_GRID, gap, 1e-12), uncoupled(ROUGH_GRID, gap)
        assert found.pressure == pytest.approx(plain.pressure, abs=1e-8 * plain.pressure.max())
        assert found.approach == pytest.approx(plain.approach, rel=1e-9)

    @pytest.mark.parametrize("friction_dundurs", COUPLINGS)
    def test_sliding_the_other_way_is_the_mirror(self, gap, friction_dundurs):
        """So is changing the places of the bodies: either turns the sign of mu beta."""
        grid = HatGrid(4e-6, -275, 275)
        forth = pressed(grid, gap, friction_dundurs)
        back = pressed(grid, lambda x: gap(-x), -friction_dundurs)
        error = np.abs(forth.pressure - back.pressure[::-1]).max()
        assert forth.converged and error < 1e-8 * forth.pressure.max()

    def test_lengths_and_moduli_scale(self, gap):
        """Pressure with the modulus, load with modulus and length: figures to rounding."""
        grid = ROUGH_GRID
        found = pressed(grid, gap, 0.3)
        length, stiffness = 1e-7, 1e4
        small = HatGrid(grid.pitch * length, grid.first, grid.last)
        other = solve_coupled(
            CoupledHalfPlane(small.count, small.pitch, MODULUS * stiffness, 0.3),
            grid.average(gap) * length**2,
            small.weights,
            Constraints(load=LOAD * stiffness * length),
        )
        error = np.abs(other.pressure / stiffness - found.pressure).max()
        assert error < 1e-8 * found.pressure.max()

    @pytest.mark.parametrize("friction_dundurs", COUPLINGS)
    def test_prescribed_approach_returns_the_load(self, gap, friction_dundurs):
        by_load = pressed(ROUGH_GRID, gap, friction_dundurs)
        approach = Constraints(approach=by_load.approach)
        by_approach = pressed(ROUGH_GRID, gap, friction_dundurs, approach)
        assert by_approach.converged
        assert by_approach.load == pytest.approx(LOAD, rel=1e-8)


def dense_matrix(grid, friction_dundurs):
    even = HalfPlane(grid.count, grid.pitch, MODULUS).column
    odd = friction_dundurs * grid.pitch**2 / MODULUS * hat_sign(np.arange(grid.count))
    return toeplitz(even + odd, even - odd)


@pytest.mark.parametrize("friction_dundurs", COUPLINGS)
@pytest.mark.parametrize("hardness", [np.inf, 6e9])
def test_conditions_hold_on_the_dense_matrix(friction_dundurs, hardness):
    """Signs by the matrix itself; on its own set the solution is that of the linear system."""
    constraints = Constraints(load=LOAD, hardness=hardness)
    gap = rough_gap(2)
    found = pressed(ROUGH_GRID, gap, friction_dundurs, constraints)
    matrix, weights = dense_matrix(ROUGH_GRID, friction_dundurs), ROUGH_GRID.weights
    residuals = contact_residuals(
        matrix @ found.pressure,
        found.pressure,
        ROUGH_GRID.average(gap),
        weights,
        found.approach,
        constraints,
    )[1]
    assert residuals.worst < 1e-9
    capped = found.pressure >= hardness
    assert capped.any() == np.isfinite(hardness)
    assert np.all(found.gap[capped] < 1e-12)
    free = np.flatnonzero((found.pressure > 0.0) & ~capped)
    assert len(contact_patches(ROUGH_GRID.x, found.pressure, found.gap)) > 3
    system = np.zeros((len(free) + 1, len(free) + 1))
    system[:-1, :-1] = matrix[np.ix_(free, free)]
    system[:-1, -1], system[-1, :-1] = -weights[free], weights[free]
    held = np.where(capped, found.pressure, 0.0)
    known = -(ROUGH_GRID.average(gap) + matrix @ held)[free]
    solved = np.linalg.solve(system, np.append(known, LOAD - weights @ held))[:-1]
    assert found.pressure[free] == pytest.approx(solved, abs=1e-7 * solved.max())


class TestContraction:
    """The part with a proof, alone: what exchanges that never settle are left to."""

    @pytest.fixture
    def unsettled(self, monkeypatch):
        monkeypatch.setattr(
            coupled_contact, "_exchange", lambda problem, start, settled=0.0: (start, False)
        )

    @pytest.mark.parametrize("friction_dundurs", [*COUPLINGS, 1.5])
    def test_it_finds_the_same_solution(self, friction_dundurs, monkeypatch, unsettled):
        grid = HatGrid.within(-1.1e-3, 1.1e-3, 10e-6)
        found = pressed(grid, rough_gap(1), friction_dundurs)
        monkeypatch.undo()
        expected = pressed(grid, rough_gap(1), friction_dundurs)
        assert found.converged and found.iterations["contractions"] > 1
        assert expected.converged and expected.iterations["contractions"] == 0
        error = np.abs(found.pressure - expected.pressure).max()
        assert error < 1e-7 * expected.pressure.max()
        assert found.approach == pytest.approx(expected.approach, rel=1e-8)

    def test_steps_needed_follow_from_friction_and_beta(self, unsettled):
        """Each step leaves mu beta of the error, so that 1e-10 takes log 1e-10 / log mu beta."""
        grid = HatGrid.within(-1.1e-3, 1.1e-3, 10e-6)
        for size in (0.01, 0.1, 0.3):
            steps = pressed(grid, rough_gap(1), size).iterations["contractions"]
            assert 0.4 < steps / (np.log(1e-10) / np.log(size)) < 1.3

    @pytest.mark.parametrize("hardness", [np.inf, 6e9])
    def test_prescribed_approach_and_hardness(self, hardness, monkeypatch, unsettled):
        grid = HatGrid.within(-1.1e-3, 1.1e-3, 10e-6)
        constraints = Constraints(approach=3e-5, hardness=hardness)
        found = pressed(grid, rough_gap(1), 0.3, constraints)
        monkeypatch.undo()
        expected = pressed(grid, rough_gap(1), 0.3, constraints)
        assert found.converged
        assert found.load == pytest.approx(expected.load, rel=1e-7)

    def test_what_does_not_converge_says_so(self, monkeypatch, unsettled):
        monkeypatch.setattr(coupled_contact, "MAX_CONTRACTIONS", 2)
        assert not pressed(ROUGH_GRID, rough_gap(1), 0.75).converged


def test_a_set_that_returns_ends_the_exchanges(monkeypatch):
    """A node that changes sides for ever: the contraction finishes what they cannot."""
    own = CoupledEquilibrium.broken_signs

    def restless(self, rest, sides):
        broken = own(self, rest, sides)
        tensile, joining = broken.tensile.copy(), broken.joining.copy()
        tensile[0], joining[0] = not sides.lower[0], sides.lower[0]
        return replace(broken, tensile=tensile, joining=joining)

    monkeypatch.setattr(CoupledEquilibrium, "broken_signs", restless)
    found = pressed(ROUGH_GRID, rough_gap(1), 0.3)
    assert found.converged and found.iterations["contractions"] > 1
    assert found.iterations["exchanges"] < 100


class TestCost:
    """Applications, not seconds."""

    @pytest.mark.parametrize("gap", [roller_gap(RADIUS), rough_gap(1), rough_gap(1, 4e-6)])
    @pytest.mark.parametrize("friction_dundurs", COUPLINGS)
    def test_three_times_the_uncoupled_problem_at_most(self, gap, friction_dundurs):
        grid = HatGrid.within(-1.3e-3, 1.3e-3, 2.6e-3 / 4000)
        plain, found = uncoupled(grid, gap), pressed(grid, gap, friction_dundurs)
        assert found.converged and found.iterations["contractions"] == 0
        assert found.iterations["applications"] < 3.0 * plain.iterations["applications"]

    @pytest.mark.parametrize("friction_dundurs", COUPLINGS)
    def test_hardly_grows_with_the_number_of_elements(self, friction_dundurs):
        """A profile of fixed bandwidth: each doubling adds a level, which takes as many as the
        last, about a dozen."""
        spent = []
        for elements in (2000, 8000, 32000):
            grid = HatGrid.within(-1.1e-3, 1.1e-3, 2.2e-3 / elements)
            found = pressed(grid, rough_gap(3), friction_dundurs)
            assert found.converged
            spent.append(found.iterations["applications"])
        assert spent[-1] < 150
        assert max(np.diff(spent)) < 2 * 20

    def test_a_bad_start_costs_no_more_than_a_search_in_vain(self):
        """All nodes touching, or one: where exchanges do not settle the coarser grids help."""
        expected = pressed(ROUGH_GRID, rough_gap(1), 0.75)
        for start in (np.ones(ROUGH_GRID.count), np.eye(ROUGH_GRID.count)[3]):
            found = pressed(ROUGH_GRID, rough_gap(1), 0.75, start=start)
            assert found.converged
            error = np.abs(found.pressure - expected.pressure).max()
            assert error < 1e-7 * expected.pressure.max()


@settings(max_examples=40, deadline=None, derandomize=True, database=None)
@given(
    seed=st.integers(0, 10**6),
    friction_dundurs=st.floats(-0.75, 0.75),
    amplitude=st.floats(0.0, 5e-6),
    load=st.floats(1e3, 5e6),
    hardness=st.sampled_from([np.inf, 1e10]),
)
def test_any_rough_contact_ends_and_holds(seed, friction_dundurs, amplitude, load, hardness):
    grid = HatGrid.within(-1.6e-3, 1.6e-3, 8e-6)
    constraints = Constraints(load=load, hardness=hardness)
    found = pressed(grid, rough_gap(seed, amplitude), friction_dundurs, constraints)
    assert found.converged
    assert found.pressure.min() >= 0.0 and found.pressure.max() <= hardness


def test_more_load_than_the_hardness_carries_is_refused():
    with pytest.raises(ContactError, match="exceeds what the surface can carry"):
        pressed(ROUGH_GRID, rough_gap(1), 0.3, Constraints(load=LOAD, hardness=1e9))


def test_a_vanishing_load_rests_on_one_crest():
    found = pressed(ROUGH_GRID, rough_gap(1), 0.5, Constraints(load=1e-9))
    assert found.converged
    assert np.count_nonzero(found.pressure) <= 2


class TestPeriodic:
    COUNT, LENGTH, HEIGHT = 256, 50e-6, 0.1e-6

    def wave(self, friction_dundurs, mean_pressure, count=COUNT):
        """A wavy body, crest at x = 0, under a flat that slides."""
        pitch = self.LENGTH / count
        x = pitch * np.arange(count)
        pair = CoupledPair(
            PeriodicHalfPlane(count, pitch, MODULUS),
            TangentialHalfPlane(count, pitch, MODULUS, 0.5, periodic=True),
            friction_dundurs / 0.5,
        )
        k = 2.0 * np.pi / self.LENGTH
        # the hat's average of a wave
        gap = -self.HEIGHT * np.cos(k * x) * pitch * np.sinc(1.0 / count) ** 2
        load = mean_pressure * self.LENGTH
        weights = np.full(count, pitch)
        return x, solve_coupled(pair, gap, weights, Constraints(load=load))

    @pytest.mark.parametrize("friction_dundurs", [0.3, -0.75])
    def test_closed_contact_is_a_turned_wave(self, friction_dundurs):
        """The wave of p sinks by 2 (1 - i mu beta)/(E* k) of itself."""
        k = 2.0 * np.pi / self.LENGTH
        amplitude = 0.5 * MODULUS * k * self.HEIGHT / np.hypot(1.0, friction_dundurs)
        x, found = self.wave(friction_dundurs, 1.5 * amplitude)
        exact = 1.5 * amplitude + amplitude * np.cos(k * x + np.arctan(friction_dundurs))
        assert found.converged and np.all(found.pressure > 0.0)
        assert found.pressure == pytest.approx(exact, abs=1e-4 * amplitude)
        errors = []
        for count in (32, 64, 128):
            x, found = self.wave(friction_dundurs, 1.5 * amplitude, count)
            exact = 1.5 * amplitude + amplitude * np.cos(k * x + np.arctan(friction_dundurs))
            errors.append(np.abs(found.pressure - exact).max())
        orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
        assert orders == pytest.approx(2.0, abs=0.1)

    def test_open_contact_mirrors_and_moves_back(self):
        mean = 0.1 * MODULUS * np.pi * self.HEIGHT / self.LENGTH
        x, forth = self.wave(0.5, mean)
        back = self.wave(-0.5, mean)[1]
        assert forth.converged and np.count_nonzero(forth.pressure == 0.0) > 50
        mirrored = np.roll(back.pressure[::-1], 1)
        assert forth.pressure == pytest.approx(mirrored, abs=1e-8 * forth.pressure.max())
        k = 2.0 * np.pi / self.LENGTH
        assert np.sum(forth.pressure * np.sin(k * x)) < 0.0


def test_a_compliance_given_as_a_matrix_can_be_the_normal_part():
    """The hook for other bodies: any symmetric operator with any tangential one."""
    grid = HatGrid.within(-1.1e-3, 1.1e-3, 8e-6)
    matrix = toeplitz(HalfPlane(grid.count, grid.pitch, MODULUS).column)
    pair = CoupledPair(
        DenseCompliance(matrix), TangentialHalfPlane(grid.count, grid.pitch, MODULUS, 0.5), 0.6
    )
    average = grid.average(rough_gap(1))
    found = solve_coupled(pair, average, grid.weights, Constraints(load=LOAD))
    expected = pressed(grid, rough_gap(1), 0.3)
    assert found.converged
    assert found.pressure == pytest.approx(expected.pressure, abs=1e-7 * expected.pressure.max())


@pytest.mark.parametrize("size", [1, 2, 12])
def test_krylov_step_solves_what_it_spans(size):
    rng = np.random.default_rng(size)
    matrix = np.eye(size) + 0.5 * rng.standard_normal((size, size)) / np.sqrt(size)
    target = rng.standard_normal(size)
    found, left = krylov_step(lambda v: matrix @ v, target, 0.0)
    assert left < 1e-12
    assert matrix @ found == pytest.approx(target, abs=1e-12)


def test_krylov_step_stops_at_its_goal():
    applied = []
    matrix = np.diag(np.linspace(1.0, 2.0, 40))
    target = np.ones(40)

    def apply(vector):
        applied.append(vector)
        return matrix @ vector

    found, left = krylov_step(apply, target, 1e-3)
    assert 1e-5 < left <= 1e-3
    assert np.linalg.norm(target - matrix @ found) == pytest.approx(left, rel=1e-6)
    assert len(applied) < 10
    found, left = krylov_step(apply, target, 7.0)
    assert not found.any() and left == np.sqrt(40.0)
