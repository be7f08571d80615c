"""The benchmark of stresses: its direct sums are right, and its demands can fail."""

import numpy as np
import pytest

from analytic.stress.points import stress_at
from comparisons.benchmarks.stress_field import (
    FRICTION,
    StressTime,
    demands,
    direct,
    field_times,
    main,
    rough_line,
)


def test_the_direct_sum_is_that_of_the_elements():
    """In blocks and on nodes of the surface too."""
    line = rough_line(50)
    rng = np.random.default_rng(3)
    x = np.concatenate([rng.uniform(-1.5, 1.5, 900), line.nodes[:5]])
    z = np.concatenate([rng.uniform(0.0, 1.0, 900), np.zeros(5)])
    found = direct(line, x, z)
    expected = stress_at(line.nodes, line.load, FRICTION, x, z, "hat")
    for row, name in zip(found, ("sx", "sz", "txz"), strict=True):
        np.testing.assert_allclose(row, getattr(expected, name), rtol=0.0, atol=2e-13)


def test_the_field_agrees_with_the_sum_that_it_is_timed_against():
    rows = {row.name: row for row in field_times(64, 7, 1)}
    assert rows["convolution"].difference < 1e-13
    assert rows["direct sum"].difference < 1e-12


@pytest.mark.parametrize(
    ("seconds", "difference", "holds"),
    [
        (3.0, 1e-12, [True, True]),
        (2.99, 1e-14, [False, True]),
        (9.0, 1.1e-12, [True, False]),
        (9.0, float("nan"), [True, False]),
    ],
)
def test_demands_are_on_the_ratio_and_the_digits(seconds, difference, holds):
    rows = [
        StressTime("direct sum", seconds, 2e-12),
        StressTime("convolution", 0.01, difference),
    ]
    found = demands(rows)
    assert [demand.holds for demand in found] == holds
    assert "direct sum: 2.0e-12" in found[1].text


def test_every_way_is_printed(capsys):
    """A field so small that it is not 300 times faster."""
    assert main(["--elements=64", "--levels=5", "--repeats=1"]) == 1
    shown = capsys.readouterr().out
    assert "64 x 5 points from 64 elements" in shown
    assert shown.count("│ direct sum") == 1
    assert "FAILS  field: " in shown
