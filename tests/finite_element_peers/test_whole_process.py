"""A whole process finds what its solution finds, and its times are those of the least meshes."""

import json
from math import inf

import numpy as np
import pytest

from tests.finite_element_peers import cases, whole_process
from tests.finite_element_peers.whole_process import MESH, PEER, process, solve, stored, time_at


def test_a_process_prints_the_peak_of_its_solution(cylinder, tmp_path, monkeypatch):
    monkeypatch.setattr(whole_process, "ROUNDS", 1)
    task = cylinder.task(5, 0.4)
    file = stored(task, tmp_path / "task.npz")
    (wall, seconds), found = process("P2", file)
    known = cases.solved(2, 1, task)
    assert found == [known.unknowns, pytest.approx(known.peak, rel=1e-9)]
    assert wall > 0.0 and seconds > 0.0


def test_a_peers_process_reads_its_mesh(cylinder, tmp_path, capsys):
    pytest.importorskip("skfem", reason="scikit-fem is not installed: pip install scikit-fem")
    task = cylinder.task(10, 0.4)
    solve(PEER, stored(task, tmp_path / "task.npz"))
    unknowns, peak = json.loads(capsys.readouterr().out)
    assert unknowns == 2 * len(task.mesh.points)
    assert abs(peak / cylinder.peak - 1.0) < 4e-3


def test_a_mesh_alone_prints_nothing(cylinder, tmp_path, capsys):
    file = stored(cylinder.task(5, 0.4), tmp_path / "task.npz")
    solve(MESH, file)
    assert capsys.readouterr().out == ""
    solve("P3", file)
    unknowns, peak = json.loads(capsys.readouterr().out)
    exact = cylinder.peak
    assert unknowns > 1000 and abs(peak / exact - 1.0) < np.sqrt(1e-4)


def test_codes_are_compared_with_and_without_the_time_of_the_mesh():
    curves = {
        ("crosscheck, P2", 0.2): [(1e-3, 1.0, 1.0), (1e-5, 9.0, 9.0)],
        ("crosscheck, P3", 0.2): [(1e-4, 2.0, 2.0)],
        ("peer", 0.2): [(1e-4, 1.0, 4.0)],
        ("never", 0.2): [(1e-3, 1.0, 2.0)],
    }
    ahead, never = whole_process.verdicts(curves, ["peer", "never"])
    assert ahead.holds and "2 times; 0.5 times" in ahead.text
    assert never.holds and "inf times" in never.text
    behind = curves | {("peer", 0.2): [(1e-4, 1.0, 1.5)]}
    assert not whole_process.verdicts(behind, ["peer"])[0].holds


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
