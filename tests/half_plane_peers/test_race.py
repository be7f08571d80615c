"""The race of half-plane codes: fair to each code, judged rightly, runs without the peers."""

import re
import sys
from dataclasses import replace

import pytest

from tests.half_plane_peers.cases import sinusoid
from tests.half_plane_peers.codes import LineAnswer, LineCode, crosscheck, decades
from tests.half_plane_peers.race import LineResult, demands, main, race
from tests.half_plane_peers.yardstick import ContactResiduals


@pytest.fixture(scope="module")
def case():
    return sinusoid(64)


@pytest.fixture(scope="module")
def code(case):
    """Its load is wrong by twice its tolerance."""
    right = crosscheck()[0].solve(case, 0.0, 0).pressure

    def solve(_, tolerance, most):
        return LineAnswer(right * (1.0 + 2.0 * tolerance), 7)

    return LineCode("approaching", "strip", solve, decades(-6, -12))


def test_the_loosest_tolerance_that_is_enough_is_taken(case, code):
    (result,) = race(case, [code], 10.0, 3)
    assert result.tolerance == pytest.approx(1e-9)  # 1e-8 is exceeded twofold
    assert result.meets
    assert result.steps == 7


def test_a_code_that_never_meets_the_yardstick_is_named(case, code):
    (result,) = race(case, [replace(code, tolerances=decades(-3, -6))], 10.0, 3)
    assert not result.meets
    assert not result.over


def result(seconds, error=0.01, worst=1e-10, over=False):
    residuals = ContactResiduals(worst, 0.0, 0.0, 0.0, error)
    return LineResult("code", seconds, over, 1e-9, None, residuals)


@pytest.mark.parametrize(
    ("count", "peers", "holds"),
    [
        (256, [result(1.1), result(9.0)], True),
        (256, [result(9.0), result(0.9)], False),
        (4096, [result(2.9)], False),
        (4096, [result(3.1)], True),
        (65536, [result(19.0)], False),
        (65536, [result(21.0)], True),
        (65536, [result(21.0, error=0.009)], False),
        (65536, [result(100.0, over=True, worst=1.0, error=0.001)], True),
        (256, [result(0.1, worst=1e-3, error=0.001), result(1.1)], True),
        (256, [], True),
    ],
)
def test_demands_are_against_the_best_peer_that_meets_the_yardstick(count, peers, holds):
    assert all(demand.holds for demand in demands("case", count, result(1.0), peers)) is holds


def test_ours_has_to_meet_the_yardstick():
    found = demands("case", 256, result(1.0, worst=1e-7), [result(9.0)])
    assert not all(demand.holds for demand in found)


def test_absent_peers_are_named(monkeypatch, capsys):
    for name in ("tamaas", "ContactMechanics"):
        monkeypatch.setitem(sys.modules, name, None)
    status = main(["--sizes", "32", "--seeds", "--repeats", "1"])
    shown = capsys.readouterr().out
    assert status == 1  # nothing is shown without a peer
    assert "skipped: Tamaas is not installed: pip install tamaas" in shown
    assert "skipped: ContactMechanics is not installed" in shown
    assert len(re.findall(r"(cylinder|sinusoid).*crosscheck, (hats|strips)", shown)) == 4


@pytest.mark.parametrize("module", ["tamaas", "ContactMechanics"])
def test_peers_meet_the_yardstick(module, capsys):
    pytest.importorskip(module, reason=f"{module} is not installed: pip install {module}")
    main(["--sizes", "64", "--seeds", "1", "--repeats", "1"])
    shown = capsys.readouterr().out
    assert "never meets" not in shown
    assert shown.count("error") > 3
