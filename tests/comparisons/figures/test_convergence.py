"""Grid convergence: known sequences, the fits of a textbook, coverage of exact contacts."""

from types import SimpleNamespace

import numpy as np
import pytest
from hats import pressed
from scenes import QUICK, problem

from analytic.contact.patches import contact_patches
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid, roller_gap
from comparisons.figures.convergence import IRREGULAR, LEVELS, REGULAR, TWO_GRIDS, grid_convergence
from comparisons.judging.rule import formal_order


def sequence(limit, error, order, levels=3):
    return [limit + error * 2.0 ** (-order * k) for k in range(levels)]


@pytest.mark.parametrize("order", [0.6, 1.0, 1.5, 2.0])
@pytest.mark.parametrize("levels", [3, 4])
def test_a_pure_power_gives_its_order_and_limit(order, levels):
    result = grid_convergence(sequence(7.0, 0.3, order, levels), formal_order=2.0)
    assert result.behaviour == "monotone" and result.safety_factor == REGULAR
    assert result.order == pytest.approx(order, abs=1e-5)
    assert result.limit == pytest.approx(7.0, abs=1e-6)
    assert result.uncertainty == pytest.approx(REGULAR * abs(result.value - 7.0), rel=1e-4)


def test_an_order_above_the_formal_one_counts_as_that():
    """A little above it is regular; far above it no order is known, and the fit has a deviation."""
    little, far = (grid_convergence(sequence(7.0, 0.3, order), 2.0) for order in (2.05, 3.0))
    assert (little.behaviour, far.behaviour) == ("monotone", "irregular")
    assert little.order == pytest.approx(2.05) and far.order == pytest.approx(3.0)
    last = 0.3 * 2.0**-4.1
    assert little.uncertainty > REGULAR * last
    assert far.deviation > 0.0 and far.uncertainty > abs(far.value - 7.0)


def fitted(values, power):
    """f_0, c and s by normal equations, with the weights written out."""
    size = 2.0 ** (power * np.arange(len(values) - 1, -1, -1))
    weight = (1.0 / size) / np.sum(1.0 / size)
    mean = weight @ size, weight @ values
    slope = weight @ ((size - mean[0]) * (values - mean[1])) / (weight @ (size - mean[0]) ** 2)
    limit = mean[1] - slope * mean[0]
    left = len(values) * weight @ (values - limit - slope * size) ** 2
    return limit, slope, np.sqrt(left / (len(values) - 2))


@pytest.mark.parametrize("formal_order", [1.0, 2.0])
@pytest.mark.parametrize(
    ("values", "behaviour"),
    [
        ([1.0, 1.2, 1.1], "oscillating"),
        ([1.0, 1.4, 1.35], "oscillating"),
        ([1.0, 1.05, 0.9], "oscillating"),  # farther each time: a scatter as wide as the data
        ([9.0, 1.1, 1.05, 1.07], "oscillating"),
        ([1.0, 1.1, 1.3], "diverging"),
        ([1.0, 1.2, 1.2001], "irregular"),  # two values that agree by chance
        ([1.0, 1.4, 1.7], "irregular"),
        ([5.0, 5.0, 5.1], "irregular"),
        ([5.0, 5.1, 5.1], "irregular"),
    ],
)
def test_what_shows_no_order_is_fitted_with_the_formal_one(values, behaviour, formal_order):
    result = grid_convergence(values, formal_order)
    values = values[-LEVELS:]
    limit, slope, deviation = fitted(np.array(values), formal_order)
    assert result.behaviour == behaviour and result.formal_order == formal_order
    assert (result.limit, result.deviation) == pytest.approx((limit, deviation))
    data_range = np.ptp(values) / (len(values) - 1)
    assert result.safety_factor == (REGULAR if deviation < data_range else IRREGULAR)
    expected = result.safety_factor * abs(slope) + deviation
    if behaviour == "diverging" or values == [1.0, 1.4, 1.7]:
        expected = max(expected, values[-1] - values[-2])
    assert result.uncertainty == pytest.approx(expected)
    assert abs(result.value - result.limit) < result.uncertainty


def test_a_sequence_that_has_settled_has_nothing_left():
    for value in (5.0, 0.0):
        result = grid_convergence([value] * 3, 2.0)
        assert (result.behaviour, result.uncertainty, result.limit) == ("settled", 0.0, value)
    assert grid_convergence([5.0, 5.0, 5.0 + 1e-12], 2.0).uncertainty < 2e-12


def test_only_the_finest_levels_count():
    values = sequence(7.0, 0.3, 1.7, LEVELS)
    assert grid_convergence([99.0, -5.0, *values], 2.0) == grid_convergence(values, 2.0)


def test_fewer_than_three_levels_show_no_order():
    one, two = (grid_convergence(values, 2.0) for values in ([1.1], [1.0, 1.1]))
    assert one.uncertainty == np.inf and two.uncertainty == pytest.approx(0.1 * TWO_GRIDS)
    assert one.behaviour == two.behaviour == "too few levels"
    assert two.order is None and two.safety_factor is None and two.limit == two.value


@pytest.mark.parametrize(
    "values", [[5.0, 5.0, 5.0], [1.0, 1.2, 1.1], [1.0, 1.1, 1.3], [1.0, 1.8, 1.9], [1.0, 1.2, 1.25]]
)
def test_no_figure_is_known_better_than_it_is_read(values):
    plain = grid_convergence(values, 2.0)
    assert grid_convergence(values, 2.0, resolution=9.0).uncertainty == 9.0
    assert grid_convergence(values, 2.0, resolution=1e-9 * plain.uncertainty) == plain


def test_uncertainty_scales_with_the_figure():
    small = grid_convergence(sequence(1.0, 0.1, 1.3), 2.0)
    large = grid_convergence([1e9 * v for v in sequence(1.0, 0.1, 1.3)], 2.0)
    assert large.uncertainty == pytest.approx(1e9 * small.uncertainty)


def test_stated_uncertainty_covers_the_error_of_hertz():
    """Peak pressure and contact length on shifted grids, against the exact values."""
    hertz = hertz_from_load(3.55e6, 7.5706e-3, 115.385e9)
    smooth, load = roller_gap(hertz.radius), hertz.load_per_length
    covered, widths = [], []
    for offset in np.linspace(0.0, 0.9, 10):
        peaks, lengths = [], []
        for elements in (90, 180, 360):
            reach = 1.5 * hertz.half_width
            grid = HatGrid.within(-reach, reach, 2.0 * reach / elements)
            shift = offset * 2.0 * reach / 360
            solution = pressed(
                grid, hertz.combined_modulus, lambda x, s=shift: smooth(x - s), load=load
            )
            peaks.append(solution.pressure.max())
            lengths.append(np.ptp(contact_patches(grid.x, solution.pressure, solution.gap)))
        answers = hertz.peak_pressure, 2.0 * hertz.half_width
        for values, exact, order in zip((peaks, lengths), answers, (2.0, 1.0), strict=True):
            result = grid_convergence(values, order)
            covered.append(abs(result.value - exact) <= result.uncertainty)
            widths.append(result.uncertainty / exact)
    assert np.mean(covered) >= 0.9
    assert np.median(widths) < 2e-3


# Hertz's contact, nu = 0.3, a / h doubled each time: what linear elements find, over the exact.
ON_LINEAR_ELEMENTS = {
    "peak_pressure": (1.025928, 1.010387, 1.003821, 1.001950),
    "tau1_max": (1.049511, 1.010069, 1.003530, 1.000164),
}


@pytest.mark.parametrize("name", ON_LINEAR_ELEMENTS)
def test_linear_elements_converge_by_the_first_order_at_most(name):
    values = ON_LINEAR_ELEMENTS[name]
    linear = problem(QUICK | {"finite_element": {"element": "P1"}})
    orders = [
        formal_order(
            name,
            [SimpleNamespace(mesh=mesh, stress=STRESSED, grid=SimpleNamespace(pitch=1.0))],
            linear,
        )
        for mesh in ("some", None)
    ]
    assert orders == [1.0, 2.0]  # of the half-plane, which has no elements, as ever
    assert grid_convergence(values, orders[0]).uncertainty > abs(values[-1] - 1.0)


STRESSED = SimpleNamespace(extremes={"tau1": SimpleNamespace(z=1.0)})
