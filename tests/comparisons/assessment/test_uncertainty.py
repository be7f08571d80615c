"""Grid convergence: known sequences, coverage on made-up but realistic ones."""

from dataclasses import replace

import numpy as np
import pytest

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid, roller_gap
from analytic.operators.half_plane import HalfPlane
from comparisons.assessment.comparison import compared, uncertainties
from comparisons.assessment.uncertainty import DOMAIN, grid_convergence, length_resolution
from comparisons.models.level import ModelRun
from comparisons.results.outcome import Outcome


def sequence(limit, error, order, levels=3):
    return [limit + error * 2.0 ** (-order * k) for k in range(levels)]


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_a_pure_power_gives_its_order_and_limit(order):
    found = grid_convergence(sequence(7.0, 0.3, order), formal_order=2.0)
    assert found.behaviour == "monotone"
    assert found.order == pytest.approx(order)
    assert found.limit == pytest.approx(7.0)
    assert found.uncertainty == pytest.approx(1.25 * abs(found.value - 7.0))


@pytest.mark.parametrize(
    ("order", "behaviour", "taken"),
    [(0.8, "monotone", 1.0), (0.6, "irregular", 1.0), (2.2, "monotone", 2.0)],
)
def test_orders_are_limited_on_both_sides(order, behaviour, taken):
    values = sequence(7.0, 0.3, order)
    found = grid_convergence(values, formal_order=2.0)
    change = max(abs(values[2] - values[1]), abs(values[1] - values[0]) / 4.0)
    assert (found.behaviour, found.order) == (behaviour, pytest.approx(order))
    assert found.uncertainty == pytest.approx(1.25 * change / (2.0**taken - 1.0))


def test_only_the_last_three_levels_count():
    assert grid_convergence([99.0, -5.0, *sequence(7.0, 0.3, 2.0)], 2.0) == grid_convergence(
        sequence(7.0, 0.3, 2.0), 2.0
    )


def test_two_levels_tell_nothing():
    found = grid_convergence([1.0, 1.1], 2.0)
    assert found.uncertainty == np.inf and found.behaviour == "too few levels"


def test_an_accidental_agreement_is_not_convergence():
    """The last step is nearly nothing: the step before it, at the formal order, still counts."""
    found = grid_convergence([1.0, 1.2, 1.2001], 2.0)
    assert found.behaviour == "irregular"
    assert found.uncertainty == pytest.approx(0.2 / 4.0)


@pytest.mark.parametrize(
    ("values", "behaviour", "uncertainty"),
    [
        ([1.0, 1.2, 1.1], "oscillating", 0.1),
        ([1.0, 1.1, 1.3], "diverging", 1.25 * 0.2),
        ([1.0, 1.4, 1.35], "oscillating", 0.1),
        ([1.0, 1.8, 1.9], "irregular", 0.2),
        ([1.0, 1.4, 1.7], "irregular", 1.25 * 0.3),
        ([5.0, 5.0, 5.0], "settled", 0.0),
        ([0.0, 0.0, 0.0], "settled", 0.0),
        ([5.0, 5.0, 5.1], "irregular", 1.25 * 0.1),
        ([5.0, 5.1, 5.1], "irregular", 0.025),
    ],
)
def test_irregular_sequences(values, behaviour, uncertainty):
    found = grid_convergence(values, 2.0)
    assert found.behaviour == behaviour
    assert found.uncertainty == pytest.approx(uncertainty, abs=1e-12)


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
    covered, widths = [], []
    for offset in np.linspace(0.0, 0.9, 10):
        peaks, lengths = [], []
        for elements in (90, 180, 360):
            reach = 1.5 * hertz.half_width
            grid = HatGrid.within(-reach, reach, 2.0 * reach / elements)
            shift = offset * 2.0 * reach / 360
            solution = solve_contact(
                HalfPlane(grid.count, grid.pitch, hertz.combined_modulus),
                grid.hat_integrals(lambda x, shift=shift: roller_gap(hertz.radius)(x - shift)),
                grid.weights,
                Constraints(load=hertz.load_per_length),
            )
            peaks.append(solution.pressure.max())
            lengths.append(np.ptp(contact_patches(grid.x, solution.pressure, solution.gap)))
        for values, exact in ((peaks, hertz.peak_pressure), (lengths, 2.0 * hertz.half_width)):
            found = grid_convergence(values, 2.0)
            covered.append(abs(found.value - exact) <= found.uncertainty)
            widths.append(found.uncertainty / exact)
    assert np.mean(covered) >= 0.9
    assert np.median(widths) < 2e-3


def test_a_boundary_counts_more_than_what_half_its_distance_changes(smooth_outcome: Outcome):
    """By an order of 1/2: 2.4 times. The far-boundary level's place is taken by another level."""
    assert pytest.approx(1.0 / (np.sqrt(2.0) - 1.0)) == DOMAIN
    levels = smooth_outcome.runs["half_plane"].levels
    run = ModelRun("finite_element", levels, far_boundary_check=levels[1])
    found = uncertainties(run, smooth_outcome.problem, 0.0)["peak_pressure"]
    first, second, last = (level.solution.pressure.max() for level in levels)
    assert found.domain == pytest.approx(DOMAIN * abs(second - first) / last)
    assert found.total == found.iteration + found.discretisation + found.domain


def test_three_grids_that_share_an_edge_do_not_know_it_better_than_it_is_found(
    smooth_outcome: Outcome,
):
    """A twentieth of a pitch for each of the two edges; of many patches they err by chance."""
    level = smooth_outcome.runs["half_plane"].finest
    run = ModelRun("half_plane", (level, level, level))
    found = uncertainties(run, smooth_outcome.problem, 0.0)
    expected = 0.1 * level.grid.pitch / level.contact_length
    assert found["contact_length"].discretisation == pytest.approx(expected)
    assert found["contact_ratio"].discretisation == pytest.approx(expected)
    assert found["peak_pressure"].discretisation == 0.0
    assert length_resolution(1.0, 9) == pytest.approx(3.0 * length_resolution(1.0, 1))


def test_a_difference_is_as_uncertain_as_the_ratio_that_it_is(smooth_outcome: Outcome):
    """Half-plane over finite elements is 3: both relative uncertainties count three times; at 1/3
    the half-plane's by a third, the reference's still whole."""
    pair = smooth_outcome.runs["half_plane"], smooth_outcome.runs["finite_element"]
    problem = smooth_outcome.problem
    one, other = (uncertainties(run, problem, 0.0)["peak_pressure"].total for run in pair)
    for times, share, whole in ((3.0, 3.0, 3.0), (1.0 / 3.0, 1.0 / 3.0, 1.0)):
        levels = tuple(
            replace(
                level,
                solution=replace(level.solution, pressure=times * level.solution.pressure),
            )
            for level in pair[0].levels
        )
        scaled = replace(pair[0], levels=levels)
        runs = {"half_plane": scaled, "finite_element": pair[1]}
        row = compared(problem, runs, smooth_outcome.window)[0]
        assert row.quantity == "peak_pressure"
        assert row.difference == pytest.approx(times - 1.0, abs=0.02)
        assert row.uncertainty == pytest.approx(share * one + whole * other, rel=0.01)
