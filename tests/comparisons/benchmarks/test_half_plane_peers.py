"""The comparisons with other codes: measured rightly, judged rightly, run without the others."""

import re
import sys
from dataclasses import replace

import numpy as np
import pytest

from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import PeriodicHalfPlane
from comparisons.benchmarks.half_plane_peers import __main__ as half_plane_peers
from comparisons.benchmarks.half_plane_peers import crosscheck as peers_crosscheck
from comparisons.benchmarks.half_plane_peers.cases import (
    CONTACT_SHARE,
    REFINED,
    cylinder,
    rough,
    sinusoid,
)
from comparisons.benchmarks.half_plane_peers.code import Answer, Code, decades
from comparisons.benchmarks.half_plane_peers.operators import displacements
from comparisons.benchmarks.half_plane_peers.race import Entry, race
from comparisons.benchmarks.half_plane_peers.verdict import verdicts
from comparisons.benchmarks.half_plane_peers.yardstick import TOLERANCE, Measure, measure
from comparisons.benchmarks.half_plane_scaling import __main__ as half_plane_scaling
from comparisons.benchmarks.half_plane_scaling.growth import Growth, demands

COUNT = 128
CASES = {"cylinder": cylinder, "sinusoid": sinusoid, "rough": lambda count: rough(count, 1)}


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("element", ["hat", "strip"])
@pytest.mark.parametrize("count", [50, 64])
def test_yardsticks_operators_are_those_of_the_elements(element, closed, count):
    pressure = np.random.default_rng(1).random(count)
    kind = PeriodicHalfPlane if closed else HalfPlane
    known = count * kind(count, 1.0 / count, 1.0, element=element).apply(pressure)
    difference = displacements(pressure, element, closed) - known
    assert np.ptp(difference) < 1e-13 * np.ptp(known)  # datums differ by a constant


def test_points_sink_under_a_wave_as_the_half_plane_does():
    wave = np.cos(2.0 * np.pi * 3.0 * np.arange(COUNT) / COUNT)
    assert displacements(wave, "point", True) == pytest.approx(wave / (3.0 * np.pi), abs=1e-15)


@pytest.mark.parametrize("name", CASES)
def test_ours_meets_the_yardstick_and_the_reference(name):
    case = CASES[name](256)
    for code in peers_crosscheck.codes():
        found = measure(case, code.solve(case, 0.0, 0).pressure, code.element)
        assert found.worst < TOLERANCE
        assert found.error < (0.06 if name == "rough" else 0.005)


@pytest.mark.parametrize("name", CASES)
def test_yardstick_rejects_wrong_pressures(name):
    case = CASES[name](COUNT)
    code = peers_crosscheck.codes()[0]
    right = code.solve(case, 0.0, 0).pressure
    highest = np.argmax(right)
    moved, heavier, pulled = np.roll(right, 1), 1.000001 * right, right.copy()
    pulled[np.argmin(right)] -= 1e-6 * right[highest]
    for wrong in (moved, heavier, pulled, np.zeros_like(right), np.full_like(right, np.nan)):
        assert measure(case, wrong, code.element).worst > TOLERANCE
    assert measure(case, heavier, code.element).load_balance == pytest.approx(1e-6, rel=1e-3)
    assert measure(case, pulled, code.element).negative_pressure == pytest.approx(1e-6, rel=1e-3)
    other = "hat" if code.element == "strip" else "strip"
    assert measure(case, right, other).worst > TOLERANCE


def test_yardstick_sees_one_node_that_overlaps():
    case = sinusoid(COUNT)
    code = peers_crosscheck.codes()[0]
    pressure = code.solve(case, 0.0, 0).pressure
    moved = displacements(pressure, code.element, True)
    open_gap = case.gaps + moved
    open_gap -= pressure @ open_gap / np.sum(pressure)
    node = np.argmax(open_gap)
    raised = case.gaps.copy()
    raised[node] -= open_gap[node] + 1e-6 * np.ptp(moved)
    found = measure(replace(case, gaps=raised), pressure, code.element)
    assert found.penetration == pytest.approx(1e-6, rel=1e-6)
    assert found.complementarity < TOLERANCE


def test_hertz_solves_the_closed_line_that_the_peers_are_given():
    """Up to what points leave of a pressure that ends as a root."""
    left = []
    for count in (256, 4096):
        case = cylinder(count)
        left.append(measure(case, case.expected[::REFINED], "point").complementarity)
    assert left[1] < 2e-6
    assert np.log(left[0] / left[1]) / np.log(16.0) == pytest.approx(1.5, abs=0.1)


@pytest.mark.parametrize("seed", [1, 2])
def test_rough_lines_touch_over_a_tenth(seed):
    case = rough(1024, seed)
    pressure = peers_crosscheck.codes()[1].solve(case, 0.0, 0).pressure
    assert np.mean(pressure > 0.0) == pytest.approx(CONTACT_SHARE, abs=3.0 / 1024)


def _approaching(case):
    """A code whose load is wrong by twice its tolerance."""
    right = peers_crosscheck.codes()[0].solve(case, 0.0, 0).pressure

    def solve(_, tolerance, most):
        return Answer(right * (1.0 + 2.0 * tolerance), 7)

    return Code("approaching", "strip", solve, decades(-6, -12))


@pytest.mark.parametrize("first", [0, 2, 6])
def test_race_takes_the_loosest_tolerance_that_is_enough(first):
    case = sinusoid(64)
    code = _approaching(case)
    (entry,) = race(case, [code], 10.0, 3, {code.name: first})
    assert code.tolerances[entry.tolerance] == pytest.approx(1e-9)  # 1e-8 is exceeded twofold
    assert entry.meets
    assert entry.steps == 7


def test_race_names_a_code_that_never_gets_there():
    case = sinusoid(64)
    code = replace(_approaching(case), tolerances=decades(-3, -6))
    (entry,) = race(case, [code], 10.0, 3, {})
    assert not entry.meets
    assert not entry.over


def _entry(seconds, error=0.01, worst=1e-10, over=False):
    return Entry("code", seconds, over, 0, None, Measure(worst, 0.0, 0.0, 0.0, error))


@pytest.mark.parametrize(
    ("count", "peers", "holds"),
    [
        (256, [_entry(1.1), _entry(9.0)], True),
        (256, [_entry(9.0), _entry(0.9)], False),
        (4096, [_entry(2.9)], False),
        (4096, [_entry(3.1)], True),
        (65536, [_entry(19.0)], False),
        (65536, [_entry(21.0)], True),
        (65536, [_entry(21.0, error=0.009)], False),
        (65536, [_entry(100.0, over=True, worst=1.0, error=0.001)], True),
        (256, [_entry(0.1, worst=1e-3, error=0.001), _entry(1.1)], True),
        (256, [], True),
    ],
)
def test_verdicts_are_against_the_best_peer_that_meets_the_yardstick(count, peers, holds):
    assert all(verdict.holds for verdict in verdicts("case", count, _entry(1.0), peers)) is holds


def test_verdict_on_ours_that_misses_the_yardstick():
    assert not all(v.holds for v in verdicts("case", 256, _entry(1.0, worst=1e-7), [_entry(9.0)]))


def _grown(count, power=1.0, overhead=1.5, memory=200.0):
    pair = 1e-9 * count**power
    return Growth(count, 40.0 * overhead * pair, 9, 30.0, 40.0, pair, int(memory * count))


@pytest.mark.parametrize(
    ("changed", "holds"),
    [({}, True), ({"power": 1.3}, False), ({"overhead": 2.1}, False), ({"power": 1.1}, True)],
)
def test_demands_on_growth(changed, holds):
    rows = [_grown(count, **changed) for count in (16384, 65536, 262144)]
    assert all(holding for holding, _ in demands(rows)) is holds


def test_memory_has_to_grow_with_the_nodes_alone():
    rows = [_grown(65536), _grown(262144, memory=300.0)]
    assert [holding for holding, _ in demands(rows)] == [True, True, False]


def test_peers_that_are_absent_are_named(monkeypatch, capsys):
    for name in ("tamaas", "ContactMechanics"):
        monkeypatch.setitem(sys.modules, name, None)
    status = half_plane_peers.main(["--sizes", "32", "--seeds", "--repeats", "1"])
    shown = capsys.readouterr().out
    assert status == 1  # nothing is shown without a peer
    assert "skipped: Tamaas is not installed: pip install tamaas" in shown
    assert "skipped: ContactMechanics is not installed" in shown
    assert len(re.findall(r"(cylinder|sinusoid).*crosscheck, (hats|strips)", shown)) == 4


@pytest.mark.parametrize("module", ["tamaas", "ContactMechanics"])
def test_peers_meet_the_yardstick(module, capsys):
    pytest.importorskip(module, reason=f"{module} is not installed")
    half_plane_peers.main(["--sizes", "64", "--seeds", "1", "--repeats", "1"])
    shown = capsys.readouterr().out
    assert "never meets" not in shown
    assert shown.count("error") > 3


def test_scaling_prints_every_size(capsys):
    half_plane_scaling.main(["--sizes", "1024", "2048", "--repeats", "1"])
    shown = capsys.readouterr().out
    assert len(re.findall(r"│ +(1024|2048) │", shown)) == 4
    assert shown.count("time as n^") == 2
