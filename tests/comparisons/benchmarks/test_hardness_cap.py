"""The judge of the hardness cap: agrees where nothing flows, and sees flow where it is."""

from dataclasses import replace

import numpy as np
import pytest

from comparisons.benchmarks import hardness_cap
from comparisons.benchmarks.hardness_cap import CAPS, CASES, Case, compare, figures, table


def test_figures():
    x, weights = np.arange(5.0), np.full(5, 0.5)
    found = figures(x, np.array([0.0, 2.0, 3.0, 0.0, 1.0]), weights)
    assert (found.length, found.mean, found.peak, found.place) == (1.5, 2.0, 3.0, 2.0)


@pytest.fixture(scope="module")
def rows():
    return compare(Case("smooth", (1.5, 4.0), None, 1.8, 0.15, 1.5, 0.3))


def test_all_agree_before_anything_flows(rows):
    row = rows[0]
    for found in (row.plastic, *row.capped.values()):
        assert found.length == row.elastic.length
        assert found.peak == pytest.approx(row.elastic.peak, rel=0.02)
    assert max(row.apart.values()) < 0.03


def test_flow_widens_the_contact_more_than_a_high_cap(rows):
    """At an elastic peak of 4 Y: 2.1 Y on average, and the lower cap errs less than the higher."""
    row = rows[1]
    assert row.elastic.peak == pytest.approx(4.0, rel=0.05)
    assert 1.9 < row.plastic.mean < 2.4
    assert row.plastic.length > row.capped[3.0].length > row.elastic.length
    assert row.apart[2.4] < row.apart[2.8] < row.apart[3.0]
    assert all(found.peak <= cap * (1 + 1e-12) for cap, found in row.capped.items())


def test_loads_that_a_cap_cannot_bear_are_left_out():
    """All hats at a hardness of 2.4 Y bear 9.36, the load is 9.42; one that flows bears more."""
    (row,) = compare(Case("too much", (6.0,), None, 1.8, 0.3, 1.0, 0.6))
    assert set(row.capped) == set(CAPS[1:])
    assert row.plastic.mean > 2.4


def test_tables_are_printed(rows, monkeypatch, capsys):
    monkeypatch.setattr(hardness_cap, "compare", lambda case: rows)
    assert hardness_cap.main(["--coarser", "2"]) == 0
    shown = capsys.readouterr().out
    assert all(case.title in shown for case in CASES)
    assert shown.count("cap 2.8 Y") == len(rows) * len(CASES)
    assert len(table(replace(CASES[0], title="x"), rows).rows) == len(rows) * (2 + len(CAPS))
