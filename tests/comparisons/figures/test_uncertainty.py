"""Uncertainties by cause, and how they add up."""

from dataclasses import replace

import numpy as np
import pytest

from comparisons.figures.uncertainty import (
    DOMAIN,
    Reading,
    difference_of_figures,
    iteration,
    length_resolution,
    peak_resolution,
)
from comparisons.judging.comparison import SHOWN, discretisations
from comparisons.judging.rule import judged, judged_by, relative_resolution
from comparisons.judging.study import Case, Run
from comparisons.models.level import Solution


def of_pressures(run: Solution, levels: tuple, factors: tuple[float, ...]) -> Solution:
    """The run on these levels with so many times their pressures."""
    made = (
        replace(level, solution=replace(level.solution, pressure=f * level.solution.pressure))
        for level, f in zip(levels, factors, strict=True)
    )
    return replace(run, levels=tuple(made))


def test_a_boundary_counts_more_than_what_half_its_distance_changes(smooth_outcome: Run):
    """The order of 1/2 gives 2.4 times. Another level stands in for the far-boundary level."""
    assert pytest.approx(1.0 / (np.sqrt(2.0) - 1.0)) == DOMAIN
    levels = smooth_outcome.runs["half_plane"].levels
    run = Solution("finite_element", levels, {"domain": levels[1:2]})
    stated = judged(run, smooth_outcome.problem)["peak_pressure"]
    first, second, last = (level.solution.pressure.max() for level in levels)
    assert stated.uncertainty.parts["domain"] == pytest.approx(DOMAIN * abs(second - first) / last)
    assert stated.numerical == pytest.approx(sum(stated.uncertainty.parts.values()))


def test_three_grids_that_share_an_edge_do_not_know_it_better_than_it_is_found(smooth_outcome: Run):
    """A twentieth of a pitch for each of the two edges; of many patches they err by chance."""
    level = smooth_outcome.runs["half_plane"].finest
    run = Solution("half_plane", (level, level, level))
    stated = judged(run, smooth_outcome.problem)
    expected = 0.1 * level.grid.pitch / level.contact_length
    assert stated["contact_length"].uncertainty.parts["discretisation"] == pytest.approx(expected)
    assert stated["peak_pressure"].uncertainty.parts["discretisation"] == 0.0
    assert length_resolution(1.0, 9) == pytest.approx(3.0 * length_resolution(1.0, 1))


def test_a_difference_is_as_uncertain_as_the_ratio_that_it_is(smooth_outcome: Run):
    """Where the half-plane's figure is three times as large, so is the uncertainty; its
    causes add up."""
    pair = smooth_outcome.runs["half_plane"], smooth_outcome.runs["finite_element"]

    def scaled(times):
        half_plane = of_pressures(pair[0], pair[0].levels, (times,) * len(pair[0].levels))
        row, *_ = judged(half_plane, smooth_outcome.problem, pair[1]).values()
        assert row.quantity == "peak_pressure"
        assert row.value == pytest.approx(times - 1.0, abs=0.02)
        parts = row.uncertainty.parts
        assert row.numerical == parts["iteration"] + parts["discretisation"] + parts["domain"]
        return parts

    one, three, third = scaled(1.0), scaled(3.0), scaled(1.0 / 3.0)
    for part in ("discretisation", "domain"):
        assert three[part] == pytest.approx(3.0 * one[part], rel=1e-6)
        assert third[part] == pytest.approx(one[part] / 3.0, rel=1e-6)
    assert three["iteration"] == pytest.approx(3.0 * one["iteration"], rel=0.02)
    assert third["iteration"] == pytest.approx(one["iteration"], rel=0.02)


def test_a_difference_has_its_own_sequence(smooth_outcome: Run):
    """Errors that both models have on each level leave none in their difference."""
    half_plane = smooth_outcome.runs["half_plane"]
    same = replace(half_plane, name="finite_element")
    difference = judged(half_plane, smooth_outcome.problem, same)["peak_pressure"]
    alone = judged(half_plane, smooth_outcome.problem)["peak_pressure"]
    assert alone.uncertainty.parts["discretisation"] > 1e-6
    assert difference.uncertainty.parts["discretisation"] == 0.0


def test_what_either_model_repeats_counts_in_their_difference():
    """Levels that are numbers: one on a smaller block, the other there and by longer increments."""
    one = Solution("one", (5.0, 4.0), {"domain": (6.0,)})
    other = Solution("other", (3.0, 3.5), {"domain": (3.2,), "increments": (2.0, 2.6)})

    def read(one: float, other: float) -> dict[str, float]:
        return {"difference": one - other}

    [figure] = judged_by("", (one, other), read, lambda *_: Reading(1.0), {}).values()
    parts = figure.uncertainty.parts
    assert (figure.value, figure.against, figure.levels) == (0.5, "other", (2.0, 0.5))
    assert parts["domain"] == pytest.approx(DOMAIN * (1.0 + 0.2))
    assert parts["increments"] == pytest.approx(3.0 * 0.4)


def test_bounds_of_several_levels_add(smooth_outcome: Run):
    """Two models add both residuals; a difference of lengths adds what is read of both."""
    one, other = (run.finest for run in smooth_outcome.runs.values())
    solutions = one.solution, other.solution
    assert iteration(*solutions) == pytest.approx(sum(map(iteration, solutions)))
    assert iteration(*solutions) > 0.0
    read = [length_resolution(level.grid.pitch, 1) for level in (one, other)]
    whole = pytest.approx(sum(read) / other.contact_length, rel=0.01)
    assert relative_resolution(one, other) == whole
    assert difference_of_figures(0.01, 1.0, 0.02) == pytest.approx(0.03)


@pytest.mark.parametrize("offset", [0.0, 0.2, 0.5])
def test_a_peak_between_nodes_is_read_within_its_resolution(offset):
    x = np.arange(-20, 21) + offset
    nodal = np.sqrt(np.maximum(1.0 - (x / 15.0) ** 2, 0.0))
    resolution = peak_resolution(nodal)
    assert 1.0 - nodal.max() <= resolution < 2.5 * (0.5 / 15.0) ** 2


def test_refinement_ends_by_the_worst_of_difference_and_models(smooth_outcome: Run):
    """Errors that both models share are in both figures, once each, and not in their difference."""
    problem = smooth_outcome.problem

    def open_ones(sizes, others):
        pair = smooth_outcome.runs["half_plane"], smooth_outcome.runs["finite_element"]
        both = zip(pair, (sizes, others), strict=True)
        runs = {run.name: of_pressures(run, (run.finest,) * 3, times) for run, times in both}
        both = discretisations(Case(problem, runs))
        alone = [discretisations(Case(problem, {n: r})) for n, r in runs.items()]
        return both["peak_pressure"], [quantities["peak_pressure"] for quantities in alone]

    both, alone = open_ones((1.16, 1.04, 1.0), (1.16, 1.04, 1.0))
    assert min(alone) > 0.01
    assert both == pytest.approx(SHOWN * max(alone))
    assert alone[0] == pytest.approx(alone[1])
    # Where they err apart, the difference decides.
    both, alone = open_ones((1.16, 1.04, 1.0), (0.84, 0.96, 1.0))
    assert both > 1.5 * max(alone)
