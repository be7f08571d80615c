"""The judge of the hardness cap: agrees where nothing flows, and sees flow where it is."""

from dataclasses import astuple

import numpy as np
import pytest

from comparisons.benchmarks import hardness_cap
from comparisons.benchmarks.hardness_cap import CAPS, CASES, CappedCase, compare, figures


def test_figures():
    x, weights, pressure = np.arange(5.0), np.full(5, 0.5), np.array([0.0, 2.0, 3.0, 0.0, 1.0])
    found = figures(x, pressure, weights, 2.0 * pressure)
    assert astuple(found) == (1.5, 2.0, 3.0, 2.0, 0.5)


@pytest.fixture(scope="module")
def rows():
    return compare(CappedCase("smooth", (1.5, 4.0), None, 1.8, 0.15, 1.5, 0.3))


def test_all_agree_before_anything_flows(rows):
    elastic = rows[0]["elastic"]
    for name in ("flow", *CAPS):
        assert rows[0][name].length == elastic.length
        assert rows[0][name].peak == pytest.approx(elastic.peak, rel=0.02)
        assert rows[0][name].apart < 0.03


def test_flow_widens_the_contact_more_than_a_high_cap(rows):
    """At an elastic peak of 4 Y: 2.1 Y on average, and the lower cap errs less than the higher."""
    elastic, flow, low, _, middle, high = rows[1].values()
    assert elastic.peak == pytest.approx(4.0, rel=0.05)
    assert 1.9 < flow.mean < 2.4
    assert flow.length > high.length > elastic.length
    assert low.apart < middle.apart < high.apart
    assert all(rows[1][name].peak <= cap * (1 + 1e-12) for name, cap in CAPS.items())


def test_loads_that_a_cap_cannot_bear_are_omitted():
    """All hats at a hardness of 2.4 Y bear 9.36, the load is 9.42; one that flows bears more."""
    (row,) = compare(CappedCase("too much", (6.0,), None, 1.8, 0.3, 1.0, 0.6))
    assert list(row) == ["elastic", "flow", *list(CAPS)[1:]]
    assert row["flow"].mean > 2.4


def test_tables_are_printed(rows, monkeypatch, capsys):
    monkeypatch.setattr(hardness_cap, "compare", lambda case: [rows[1]] * len(case.peaks))
    assert hardness_cap.main(["--coarser", "2"]) == 0
    shown = capsys.readouterr().out
    assert all(case.title in shown for case in CASES)
    assert shown.count("cap 2.8 Y") == sum(len(case.peaks) for case in CASES)
