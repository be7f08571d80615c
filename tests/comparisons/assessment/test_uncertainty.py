"""Uncertainties by cause, and how they add up."""

from dataclasses import replace

import numpy as np
import pytest

from comparisons.assessment.comparison import compared, uncertainties
from comparisons.assessment.uncertainty import (
    DOMAIN,
    difference_of_figures,
    iteration,
    length_resolution,
    relative_resolution,
)
from comparisons.models.level import ModelRun
from comparisons.results.outcome import Outcome


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


def test_bounds_of_several_levels_add(smooth_outcome: Outcome):
    """Of two models by both residuals; of a difference of lengths by what is read of both."""
    one, other = (run.finest for run in smooth_outcome.runs.values())
    assert iteration(one, other) == iteration(one) + iteration(other) > 0.0
    read = [length_resolution(level.grid.pitch, 1) for level in (one, other)]
    whole = pytest.approx(sum(read) / other.contact_length, rel=0.01)
    assert relative_resolution(one, other) == whole
    assert difference_of_figures(0.01, 1.0, 0.02) == pytest.approx(0.03)
