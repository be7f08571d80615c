"""Hat grids and the averages of the gap over them."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad, trapezoid
from scipy.interpolate import CubicSpline

from analytic.grid import HatGrid, roller_gap


def test_grids_of_halved_pitch_nest():
    coarse = HatGrid.within(-0.93e-3, 1.27e-3, 4e-6)
    fine = HatGrid.within(-0.93e-3, 1.27e-3, 2e-6)
    nodes = 2 * np.arange(coarse.first, coarse.last + 1)
    assert np.isin(nodes, range(fine.first, fine.last + 1)).all()
    assert 0.0 in coarse.x


@pytest.mark.parametrize("pitch", [1e-6, 3.7e-6, 1e-4])
def test_hats_stay_inside(pitch):
    grid = HatGrid.within(-1e-3, 1.5e-3, pitch)
    assert grid.x[0] - pitch >= -1e-3 - 1e-9 * pitch
    assert grid.x[-1] + pitch <= 1.5e-3 + 1e-9 * pitch
    assert len(grid.x) == grid.count == len(grid.weights)
    assert grid.x[0] - 2 * pitch < -1e-3 and grid.x[-1] + 2 * pitch > 1.5e-3


def test_an_end_that_is_a_multiple_of_the_pitch_counts_whatever_its_last_bit():
    end = 0.3
    for nudge in (np.nextafter(end, 0.0), end, np.nextafter(end, 1.0)):
        assert HatGrid.within(-nudge, nudge, 0.1).count == 5


def test_too_few_hats_are_refused():
    with pytest.raises(ValueError, match="fewer than three"):
        HatGrid.within(0.0, 1.0, 0.3)


def test_average_of_a_parabola_is_exact():
    grid = HatGrid.within(-1e-3, 1e-3, 5e-6)
    expected = grid.pitch * (grid.x**2 + grid.pitch**2 / 6.0) / (2.0 * 8e-3)
    assert grid.hat_integrals(roller_gap(8e-3)) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("pitch", [0.3, 1.0, 4.7])
def test_average_of_a_spline_is_exact_between_its_knots(pitch):
    """Hats finer and coarser than the samples, against adaptive integration."""
    rng = np.random.default_rng(4)
    knots = np.sort(rng.uniform(-20.0, 20.0, 40))
    spline = CubicSpline(knots, rng.standard_normal(40))
    grid = HatGrid.within(-15.0, 15.0, pitch)
    means = grid.hat_integrals(spline, knots)
    for i in (0, 1, grid.count // 2, grid.count - 1):
        node = grid.x[i]

        def integrand(x, node=node):
            return spline(x) * max(0.0, 1.0 - abs(x - node) / pitch)

        breaks = np.union1d(knots[np.abs(knots - node) < pitch], [node - pitch, node, node + pitch])
        pairs = pairwise(breaks)
        assert means[i] == pytest.approx(sum(quad(integrand, *pair)[0] for pair in pairs), abs=1e-9)


def test_gap_of_a_rough_surface_is_the_parabola_less_the_heights():
    x = np.linspace(-1.0, 1.0, 5)
    assert roller_gap(2.0, np.sin)(x) == pytest.approx(x**2 / 4.0 - np.sin(x))


def test_averages_are_exact_for_polynomials():
    grid, power = HatGrid(0.3, -2, 1), np.arange(7)
    exact = np.zeros((4, 7))
    for i, node in enumerate(grid.x):
        # The hat's second derivative is three deltas: integrate x^k twice.
        a, b, c = (
            t ** (power + 2.0) / ((power + 1.0) * (power + 2.0))
            for t in (node - 0.3, node, node + 0.3)
        )
        exact[i] = (a - 2.0 * b + c) / 0.3
    means = np.stack([grid.hat_integrals(lambda x, k=k: x**k) for k in power], axis=1)
    assert means == pytest.approx(exact, rel=1e-12, abs=1e-14)
    assert means[:, 0] == pytest.approx(grid.weights, rel=1e-14)


def test_averages_with_a_knot_follow_a_kink():
    kink = 1.6
    [mean] = HatGrid(1.5, 1, 1).hat_integrals(lambda x: np.abs(x - kink), np.array([kink]))
    x = np.linspace(0.0, 3.0, 300001)
    direct = trapezoid(np.interp(x, [0.0, 1.5, 3.0], [0, 1, 0]) * np.abs(x - kink), x)
    assert mean == pytest.approx(direct, rel=1e-8)
