"""The measure of contact conditions is exact and rejects wrong pressures; peers race by it."""

import sys
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from tests.half_plane_peers.cases import REFINED, cylinder, rough, sinusoid
from tests.half_plane_peers.codes import crosscheck
from tests.half_plane_peers.race import main
from tests.half_plane_peers.yardstick import TOLERANCE, displacements, measure

COUNT = 128
CASES = {"cylinder": cylinder, "sinusoid": sinusoid, "rough": partial(rough, seed=1)}


def test_points_sink_under_a_wave_as_the_half_plane_does():
    wave = np.cos(2.0 * np.pi * 3.0 * np.arange(COUNT) / COUNT)
    assert displacements(wave, "point", True) == pytest.approx(wave / (3.0 * np.pi), abs=1e-15)


@pytest.mark.parametrize("name", CASES)
def test_ours_meets_the_yardstick_and_the_reference(name):
    case = CASES[name](256)
    for code in crosscheck():
        measured = measure(case, code.solve(case, 0.0, 0).pressure, code.element)
        assert measured.worst < TOLERANCE
        assert measured.error < (0.06 if name == "rough" else 0.005)


@pytest.mark.parametrize("name", CASES)
def test_wrong_pressures_are_rejected(name):
    case = CASES[name](COUNT)
    right = crosscheck()[0].solve(case, 0.0, 0).pressure
    heavier, tension = 1.000001 * right, right.copy()
    tension[np.argmin(right)] -= 1e-6 * right.max()
    wrong = (np.roll(right, 1), heavier, tension, np.zeros(COUNT), np.full(COUNT, np.nan))
    assert all(measure(case, pressure, "strip").worst > TOLERANCE for pressure in wrong)
    assert measure(case, heavier, "strip").load_balance == pytest.approx(1e-6, rel=1e-3)
    assert measure(case, tension, "strip").negative_pressure == pytest.approx(1e-6, rel=1e-3)
    assert measure(case, right, "hat").worst > TOLERANCE


def test_one_node_that_overlaps_is_seen():
    case = sinusoid(COUNT)
    pressure = crosscheck()[0].solve(case, 0.0, 0).pressure
    moved = displacements(pressure, "strip", True)
    open_gap = case.gaps + moved
    open_gap -= pressure @ open_gap / np.sum(pressure)
    node = np.argmax(open_gap)
    raised = case.gaps.copy()
    raised[node] -= open_gap[node] + 1e-6 * np.ptp(moved)
    measured = measure(replace(case, gaps=raised), pressure, "strip")
    assert measured.penetration == pytest.approx(1e-6, rel=1e-6)
    assert measured.complementarity < TOLERANCE


def test_hertz_solves_the_periodic_line_that_the_peers_are_given():
    """Up to the error of points under a pressure that ends as a square root."""
    cases = [cylinder(count) for count in (256, 4096)]
    left = [measure(case, case.expected[::REFINED], "point").complementarity for case in cases]
    assert left[1] < 2e-6
    assert np.log(left[0] / left[1]) / np.log(16.0) == pytest.approx(1.5, abs=0.1)


def test_the_race_runs_without_peers_and_names_them(monkeypatch, capsys):
    for name in ("tamaas", "ContactMechanics"):
        monkeypatch.setitem(sys.modules, name, None)
    assert main(["--sizes", "32", "--seeds", "--repeats", "1"]) == 1  # without a peer it shows none
    assert capsys.readouterr().out.count("is not installed") == 2


@pytest.mark.parametrize("module", ["tamaas", "ContactMechanics"])
def test_peers_meet_the_yardstick(module, capsys):
    pytest.importorskip(module, reason=f"{module} is not installed: pip install {module}")
    main(["--sizes", "64", "--seeds", "1", "--repeats", "1"])
    shown = capsys.readouterr().out
    assert "never meets" not in shown
    assert shown.count("error") > 3
