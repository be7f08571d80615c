"""The convergence of Hertz's contact: runs that measure what they report, judged rightly."""

from dataclasses import replace

import numpy as np
import pytest

from comparisons.benchmarks import hertz_convergence
from comparisons.benchmarks.hertz_convergence import (
    ADAPTED,
    FEWEST,
    HERTZ,
    HertzRun,
    adapted,
    demands,
    distance,
    equal_edges,
    order,
    unknowns_ratio,
)

RUN = HertzRun(10.0, 1000, 30, 0.1, 1e-2, 2e-3, 1e-3, 1e-2, 2e-3)


def series(hats_order=1.0, **fixed):
    """Four runs, each with twice the edges and hats, four times the unknowns; L2 of that order in
    edges."""
    return tuple(
        replace(
            RUN,
            size=10.0 * 2.0**k,
            unknowns=1000 * 4**k,
            count=30 * 2**k,
            **{
                "node": 1e-2 * 4.0**-k,
                "hats": 1e-2 * 2.0 ** (-hats_order * k),
            }
            | fixed,
        )
        for k in range(4)
    )


def test_runs_report_errors_and_cost():
    coarse, fine = equal_edges(5), equal_edges(10)
    assert coarse.seconds > 0.0
    assert fine.unknowns > 1.5 * coarse.unknowns
    assert fine.count == coarse.count + 10
    assert np.log2(coarse.hats / fine.hats) == pytest.approx(1.0, abs=0.2)
    assert 2e-3 < coarse.node < 3e-2 and 3e-4 < fine.node < 3e-3
    assert fine.peak < 0.5 * fine.node
    assert fine.half_width < 2e-3
    assert fine.tau1 < 5e-3
    own = adapted(1e-2)
    assert own.hats < 1e-2 and own.unknowns < fine.unknowns


def test_distance_of_a_heavier_pressure():
    assert distance(lambda x: 1.5 * HERTZ.pressure(x)) == pytest.approx(0.5)


def test_orders_are_fitted():
    assert order(series(), "size", "node") == pytest.approx(-2.0)
    assert order(series(), "unknowns", "hats") == pytest.approx(-0.5)


def test_ratio_of_unknowns_at_the_same_error():
    found = unknowns_ratio(series(), series(2.0))
    assert [error for error, _ in found] == [run.hats for run in series(2.0)]
    assert [ratio for _, ratio in found] == pytest.approx([1.0, 4.0, 16.0, 64.0])


GOOD = {"degree 2": series(), FEWEST: series(), ADAPTED: series(2.0)[1:]}


def holds(**changes):
    return [demand.holds for demand in demands(GOOD | changes)]


def test_demands_hold_and_each_can_fail():
    assert holds() == [True] * 4
    stalled = series(node=1e-2, hats=1e-2)
    assert holds(**{"degree 2": stalled})[:2] == [False, False]
    assert holds(**{ADAPTED: series()})[2:] == [False, False]


def test_command_prints_every_run_and_order_and_says_what_holds(monkeypatch, capsys):
    monkeypatch.setattr(hertz_convergence, "all_series", lambda finest, tolerances: GOOD)
    assert hertz_convergence.main([]) == 0
    shown = capsys.readouterr().out
    assert shown.count("order in unknowns") == 3
    assert shown.count("│ degree 2") == 11
    assert shown.count("holds ") == 4
    monkeypatch.setattr(hertz_convergence, "all_series", lambda *_: GOOD | {ADAPTED: series()})
    assert hertz_convergence.main([]) == 1
