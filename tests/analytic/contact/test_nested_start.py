"""Restriction to grids of doubled pitch, and what the nested solver costs. Displacements
continued over the gaps: what the continuation is, and what it buys."""

from unittest.mock import patch

import numpy as np
import pytest
from hats import solved
from scipy.linalg import toeplitz

from analytic.contact.active_set import ActiveSet
from analytic.contact.equilibrium import Constraints, EquilibriumProblem
from analytic.contact.nested_start import COARSEST, coarse_start
from analytic.contact.preconditioner import Extension, RowExtension, extension_from
from analytic.grid import HatGrid, restricted, roller_gap
from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import PeriodicHalfPlane


def cubic(x):
    return 0.3 + x - 2.0 * x**2 + 0.7 * x**3


class TestRestricted:
    @pytest.mark.parametrize(("last", "odd"), [(9, True), (10, False)])
    def test_they_are_the_coarse_grids_own_averages(self, last, odd):
        """An even count lacks half a hat at its end."""
        fine, coarse = HatGrid(0.5, -9, last), HatGrid(1.0, -4, last // 2)
        assert coarse.x == pytest.approx(fine.x[1::2])
        coarser = restricted(fine.hat_integrals(cubic), periodic=False)
        off = np.abs(coarser / coarse.hat_integrals(cubic) - 1.0)
        assert off[:-1].max() < 1e-13
        assert off[-1] < 1e-13 if odd else off[-1] > 1e-3
        assert restricted(fine.weights, periodic=False) == pytest.approx(coarse.weights)

    def test_a_periodic_line_wraps_round(self):
        def wave(x):
            return np.sin(2.0 * np.pi * x / 8.0) + np.cos(6.0 * np.pi * x / 8.0)

        # piecewise integration of the same wave: fine cells on both active, so equal to rounding
        fine, coarse = HatGrid(0.5, 0, 15), HatGrid(1.0, 0, 7)
        knots = np.arange(-4, 24) * 0.5
        shifted = coarse.hat_integrals(lambda x: wave(x + 0.5), knots)
        around = restricted(fine.hat_integrals(wave), periodic=True)
        assert around == pytest.approx(shifted, abs=1e-12)


@pytest.mark.parametrize("count", [COARSEST - 1, COARSEST, 3 * COARSEST, 8 * COARSEST + 1])
@pytest.mark.parametrize("kind", [HalfPlane, PeriodicHalfPlane])
def test_a_coarse_start_is_close_to_the_solution(kind, count):
    operator, weights = kind(count, 1.0 / count, 1.0), np.full(count, 1.0 / count)
    x = (np.arange(count) - 0.5 * (count - 1)) / count
    # of curvature 1, and once around
    gap = (1.0 - np.cos(2.0 * np.pi * x)) / (2.0 * np.pi) ** 2 / count
    spent = {"exchanges": 0, "applications": 0}

    problem = EquilibriumProblem(operator, gap, weights, Constraints(load=0.03), spent)
    start = coarse_start(problem)
    assert start.shape == (count,) and np.all(start >= 0.0)
    nested = count >= COARSEST and not (kind is PeriodicHalfPlane and count % 2)
    assert (spent["exchanges"] > 0) == nested
    if nested:
        assert weights @ start == pytest.approx(0.03, rel=0.05)
        assert 0.25 < np.count_nonzero(start) / count < 0.6


def cylinder(count: int):
    """Half-width 2/3 of the window's half, on the free half-plane."""
    grid = HatGrid(2.0 / count, -(count // 2) + 1, count // 2 - 1)
    load = np.pi * (2.0 / 3.0) ** 2 / 4.0
    return HalfPlane(grid.count, grid.pitch, 1.0), grid.hat_integrals(roller_gap(1.0)), load


def sinusoid(count: int):
    """Westergaard's contact at 0.3 of the closing pressure pi E* A/L."""
    grid = HatGrid(1.0 / count, 0, count - 1)
    gap = grid.hat_integrals(lambda x: 1e-3 * (1.0 - np.cos(2.0 * np.pi * x)))
    return PeriodicHalfPlane(count, grid.pitch, 1.0), gap, 0.3 * np.pi * 1e-3


def rough(count: int, periodic: bool = True, seed: int = 4):
    """Waves 1 to 60 with a self-affine spectrum, about a tenth in contact."""
    rng = np.random.default_rng(seed)
    orders = np.arange(1, 61)
    heights = 1e-3 * orders**-1.3 * rng.rayleigh(size=60)
    phases = rng.uniform(0.0, 2.0 * np.pi, 60)

    def gap(x):
        return -np.cos(np.multiply.outer(2.0 * np.pi * x, orders) + phases) @ heights

    grid = HatGrid(1.0 / count, 0, count - 1)
    operator = (PeriodicHalfPlane if periodic else HalfPlane)(count, grid.pitch, 1.0)
    return operator, grid.hat_integrals(gap), 4e-4


class TestCost:
    """Cost on the finest grid: what is left to do there once the coarser ones have settled."""

    COUNTS = 2 ** np.arange(10, 15)

    def spent(self, problem, count: int) -> int:
        """Applications on the finest grid."""
        operator, gap, load = problem(count)
        with patch.object(operator, "apply", wraps=operator.apply) as applied:
            solved(operator, gap, load=load)
        return applied.call_count

    @pytest.mark.parametrize("problem", [cylinder, sinusoid])
    def test_applications_on_the_finest_grid_do_not_grow(self, problem):
        spent = [self.spent(problem, count) for count in self.COUNTS]
        assert max(spent) <= 22
        assert spent[-1] <= 2 * spent[0]

    @pytest.mark.parametrize("periodic", [True, False])
    def test_on_a_rough_surface_they_hardly_grow(self, periodic):
        """Mean of four surfaces, on grids whose contact is too large to be solved for directly."""

        def mean(count: int) -> float:
            problems = [lambda n, s=seed: rough(n, periodic, s) for seed in range(4)]
            return np.mean([self.spent(problem, count) for problem in problems])

        few, many = mean(8192), mean(32768)
        assert many < 1.35 * few
        assert many < 40

    def test_a_free_rough_contact_costs_like_a_periodic_one(self):
        around = self.spent(rough, 4096)
        free = self.spent(lambda count: rough(count, periodic=False), 4096)
        assert free <= 1.5 * around


COUNT = 60
SETS = {
    "one node": np.array([17]),
    "first node": np.array([0]),
    "last node": np.array([COUNT - 1]),
    "all nodes": np.arange(COUNT),
    "both ends": np.array([0, COUNT - 1]),
    "patches": np.r_[4:11, 12:13, 20:33, 50:58],
    "every third": np.arange(1, COUNT, 3),
}


def preconditioner(operator, nodes: np.ndarray) -> np.ndarray:
    """E' B E on these nodes, as a matrix."""
    extension, columns = Extension(nodes, operator.ring, closed=True), np.eye(len(nodes))
    return np.stack([extension.gather(operator.precondition(extension.extend(c))) for c in columns])


@pytest.mark.parametrize("nodes", SETS.values(), ids=SETS.keys())
@pytest.mark.parametrize("kind", [HalfPlane, PeriodicHalfPlane], ids=["open", "closed"])
def test_the_preconditioner_is_symmetric_positive_definite(nodes, kind):
    product = preconditioner(kind(COUNT, 1.0, 1.0), nodes)
    assert product == pytest.approx(product.T, abs=1e-13 * np.abs(product).max())
    assert np.linalg.eigvalsh(product).min() > 0.0


class TestIterations:
    """Conjugate gradients on patches of 14 touching and 14 open nodes, for any displacements."""

    PERIOD = 28

    def applications(self, patches: int) -> int:
        count = self.PERIOD * patches
        operator, weights = PeriodicHalfPlane(count, 1.0, 1.0), np.ones(count)
        rng = np.random.default_rng(7)
        lower = np.arange(count) % self.PERIOD >= self.PERIOD // 2
        gap = np.cumsum(rng.standard_normal(count)) * 1e-3
        spent = {"exchanges": 0, "applications": 0}
        problem = EquilibriumProblem(operator, gap, weights, Constraints(load=count), spent)
        active = ActiveSet(lower, np.zeros(count, dtype=bool))
        rest = problem.equilibrium(np.ones(count), active, 1e-8)
        touching = ~lower
        assert np.abs(rest.weighted_gap[touching]).max() < 1e-5 * np.ptp(rest.weighted_gap)
        return spent["applications"]

    def test_their_number_hardly_grows_with_the_patches(self):
        few, many = self.applications(20), self.applications(400)
        assert many < 1.5 * few
        assert many < 40


def test_the_free_half_planes_ring_is_long_enough():
    """Closing the line for the inverse must not join what happens at its two ends."""
    operator = HalfPlane(512, 1.0, 1.0)
    inverse = np.linalg.inv(toeplitz(operator.column))
    product = preconditioner(operator, np.arange(512))
    spectrum = np.linalg.eigvals(np.linalg.solve(inverse, product)).real
    assert np.sort(spectrum)[-2] / np.sort(spectrum)[1] < 4.0


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("nodes", [range(5, 30), range(30), range(30, 60), range(60), range(7, 8)])
def test_a_row_of_nodes_is_continued_alike(nodes, closed):
    nodes = np.array(nodes)
    row, any_set = extension_from(nodes, COUNT, closed), Extension(nodes, COUNT, closed)
    assert isinstance(row, RowExtension)
    rng = np.random.default_rng(12)
    moved, forces = rng.normal(size=len(nodes)), rng.normal(size=COUNT)
    assert row.extend(moved) == pytest.approx(any_set.extend(moved), abs=1e-14)
    assert row.gather(forces) == pytest.approx(any_set.gather(forces), abs=1e-13)
