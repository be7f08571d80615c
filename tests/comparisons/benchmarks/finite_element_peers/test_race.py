"""The race of finite-element codes: judged at equal error, runs without the peers.

Where a peer is installed, its pressures are compared with the reference.
"""

from dataclasses import replace
from math import inf

import pytest

from comparisons.benchmarks.finite_element_peers import cases, race
from comparisons.benchmarks.finite_element_peers.calculix import calculix
from comparisons.benchmarks.finite_element_peers.cases import BlockCode, FailedError
from comparisons.benchmarks.finite_element_peers.race import (
    BlockResult,
    TimesAtError,
    time_at,
    times_at_errors,
)
from comparisons.benchmarks.finite_element_peers.scikit_fem import scikit_fem
from comparisons.benchmarks.harness import AbsentError


def test_time_at_an_error_lies_on_the_power_law_between():
    curve = [(4.0**-k, 8.0**k) for k in range(1, 5)]
    for target in (0.25, 0.1, 0.004):
        assert time_at(curve, target) == pytest.approx(target**-1.5)
    assert time_at(curve, 0.9) == 8.0
    assert time_at(curve, 1e-3) == inf


def test_an_error_that_changes_sign_on_the_way_does_not_count():
    assert time_at([(1e-1, 1.0), (1e-6, 2.0), (1e-2, 4.0)], 1e-2) == pytest.approx(2.0)
    assert time_at([(1e-1, 1.0), (1e-6, 2.0), (1e-2, 4.0)], 1e-3) == inf
    assert time_at([(1e-3, 1.0), (1e-2, 4.0)], 1e-2) == 1.0


def results(name, seconds, configuration="", worst=1.0):
    code = BlockCode(name, configuration, lambda task: None)
    return [
        BlockResult(
            code,
            edges,
            seconds * edges,
            None,
            {"peak": 0.1 * worst / edges, "pressure": worst / edges},
        )
        for edges in (10, 1000)
    ]


def test_codes_are_compared_at_equal_error():
    raced = results("ours", 1.0) + results("peer", 3.0) + results("other", 0.5, worst=1.5)
    found = times_at_errors("case", raced, "ours")
    assert {times.peer for times in found} == {"peer", "other"}
    for times in found:
        if times.ours > 10.0:  # beyond the coarsest mesh
            ratio = {"peer": 3.0, "other": 0.75}[times.peer]
            assert times.theirs / times.ours == pytest.approx(ratio)
            assert times.demand.holds is (ratio > 1.0)


def test_the_best_of_several_configurations_counts():
    raced = results("ours", 9.0, "slow") + results("ours", 1.0, "fast") + results("peer", 3.0)
    found = times_at_errors("case", raced, "ours")
    assert [times.theirs / times.ours for times in found] == pytest.approx([3.0] * 7)


@pytest.mark.parametrize(
    ("times", "holds"),
    [((1.0, 2.0), True), ((2.0, 1.0), False), ((1.0, inf), True), ((inf, 1.0), False)],
)
def test_ours_has_to_reach_what_the_peer_reaches(times, holds):
    assert TimesAtError("case", "peer", *times).demand.holds is holds


def test_a_code_that_fails_or_is_slow_gets_no_finer_meshes(cylinder, capsys):
    asked = []

    def fails(task):
        asked.append(task.mesh.spec.surface_size)
        if len(asked) == 4:
            raise FailedError("no pressures")
        return replace(cylinder.reference, seconds=float(len(asked)))

    codes = [
        BlockCode("failing", "", fails),
        BlockCode("slow", "", lambda task: replace(cylinder.reference, seconds=99.0)),
    ]
    found = race.race(replace(cylinder, edges=(5, 6, 7)), codes, rounds=2, limit=60.0)
    assert asked == pytest.approx([1 / 5, 1 / 5, 1 / 5, 1 / 6])
    assert [(r.code.name, r.edges, r.seconds) for r in found] == [
        ("failing", 5, 2.5),
        ("slow", 5, 99.0),
    ]
    shown = capsys.readouterr().out
    assert "cylinder, 6 edges: no pressures" in shown
    assert "cylinder, 5 edges: 99 s" in shown


def test_absent_peers_are_named(cylinder, monkeypatch, capsys):
    def absent():
        raise AbsentError("Some is not installed")

    for name in ("calculix", "scikit_fem"):
        monkeypatch.setattr(race, name, absent)
    monkeypatch.setattr(cases, "cylinder", lambda: replace(cylinder, edges=(5,)))
    assert race.main(["--cases", "cylinder", "--rounds", "1"]) == 1
    shown = capsys.readouterr().out
    assert shown.count("skipped: Some is not installed") == 2
    assert "no peer is installed" in shown
    assert shown.count("a hat an edge") == 1


@pytest.mark.parametrize("peer", [calculix, scikit_fem])
def test_peers_find_the_same_pressures(peer, cylinder):
    try:
        (code,) = peer()
    except AbsentError as absent:
        pytest.skip(str(absent))
    answer = code.solve(cylinder.task(10))
    assert cylinder.errors(answer)["pressure"] < 0.03
    assert cylinder.errors(answer)["peak"] < 0.004
    assert answer.seconds is None or answer.seconds > 0.0
