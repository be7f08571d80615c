"""The problem on which finite-element codes are compared: its reference, all its solutions, whole
processes, and what CalculiX is given and says."""

import json

import numpy as np
import pytest

from tests.finite_element_peers import calculix, cases, scikit_fem, whole_process
from tests.finite_element_peers.calculix import deck, last_contact
from tests.finite_element_peers.task import FailedError, gap
from tests.finite_element_peers.whole_process import PEER, process, solve, stored
from tests.harness import AbsentError


@pytest.fixture(scope="module")
def cylinder() -> cases.BlockCase:
    """Hertz's contact, with a reference that is good enough for what is compared here."""
    return cases.cylinder(finest=40)


def test_reference_is_hertz_contact_but_for_the_block(cylinder):
    """A block 40 a deep and wide presses back: 2.1e-4 more at the peak."""
    assert cylinder.peak == pytest.approx(1.00021 * cases.hertz().peak_pressure, rel=5e-5)


@pytest.mark.parametrize(("degree", "hats"), [(2, 1), (2, 2), (3, 2)])
def test_ours_meets_the_reference(cylinder, degree, hats):
    answer = cases.solved(degree, hats, cylinder.task(20, 0.2))
    assert answer.peak == pytest.approx(cylinder.peak, rel=1e-3)
    assert answer.unknowns > 1000


@pytest.mark.parametrize("peer", [calculix, scikit_fem])
def test_peers_find_the_same_pressures(peer, cylinder):
    try:
        peer.check_installed()
    except AbsentError as absent:
        pytest.skip(str(absent))
    assert peer.solve(cylinder.task(10, 0.4)).peak == pytest.approx(cylinder.peak, rel=4e-3)


def test_a_process_prints_the_peak_of_its_solution(cylinder, tmp_path, monkeypatch):
    monkeypatch.setattr(whole_process, "ROUNDS", 1)
    task = cylinder.task(5, 0.4)
    file = stored(task, tmp_path / "task.npz")
    (wall, seconds), printed = process("P2", file)
    known = cases.solved(2, 1, task)
    assert printed == [known.unknowns, pytest.approx(known.peak, rel=1e-9)]
    assert wall > 0.0 and seconds > 0.0


def test_a_peers_process_reads_its_mesh(cylinder, tmp_path, capsys):
    pytest.importorskip("skfem", reason="scikit-fem is not installed: pip install scikit-fem")
    task = cylinder.task(10, 0.4)
    solve(PEER, stored(task, tmp_path / "task.npz"))
    unknowns, peak = json.loads(capsys.readouterr().out)
    assert unknowns == 2 * len(task.mesh.points)
    assert abs(peak / cylinder.peak - 1.0) < 4e-3


@pytest.fixture(scope="module")
def task(cylinder):
    return cylinder.task(5, 0.4)


def blocks(deck: str) -> dict[str, list[list[str]]]:
    """Rows by their keyword line."""
    cards: dict[str, list[list[str]]] = {}
    for line in deck.splitlines():
        if line.startswith("*"):
            rows = cards.setdefault(line, [])
        else:
            rows.append(line.split(","))
    return cards


def test_calculix_block_has_the_gap_on_its_top(task):
    cards = blocks(deck(task))
    nodes = np.array(cards["*NODE"], dtype=float)
    count = len(task.mesh.points)
    x, z = task.mesh.points.T
    top = task.touchable(x, z)
    lowered = np.where(top, gap(x), 0.0)
    np.testing.assert_allclose(nodes[:count, 1], x, rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(nodes[:count, 2], -z - lowered, rtol=1e-13, atol=1e-13)
    assert np.abs(nodes[:count, 2] + z).max() > 1e-6
    assert nodes[count:, 2].min() == 0.0  # the punch begins where the gap does
    elements = np.array(cards["*ELEMENT,TYPE=CPE6,ELSET=BLOCK"], dtype=int)[:, 1:] - 1
    corner = nodes[elements[:, :3], 1:]
    side, other = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    assert (side[:, 0] * other[:, 1] - side[:, 1] * other[:, 0]).min() > 0.0
    flat = task.mesh.points[elements]
    for middle, ends in ((3, (0, 1)), (4, (1, 2)), (5, (2, 0))):
        np.testing.assert_allclose(flat[:, middle], flat[:, ends].mean(axis=1), atol=1e-12)


def test_calculix_faces_cover_the_top_and_sets_the_support(task):
    cards = blocks(deck(task))
    elements = np.array(cards["*ELEMENT,TYPE=CPE6,ELSET=BLOCK"], dtype=int)[:, 1:] - 1
    faces = cards["*SURFACE,NAME=TOP"]
    ends = {"S1": (0, 1), "S2": (1, 2), "S3": (2, 0)}
    pairs = np.array([elements[int(e) - 1][list(ends[face])] for e, face in faces])
    assert np.abs(np.diff(task.mesh.points[pairs, 0])).sum() == pytest.approx(np.ptp(task.ends))
    fixed = np.array(cards["*NSET,NSET=FIXED"], dtype=int).ravel() - 1
    np.testing.assert_array_equal(fixed, np.flatnonzero(task.fixed(*task.mesh.points.T)))


FRD = """    2C                             3                                     1
 -1         1 1.00000E+00 0.00000E+00 0.00000E+00
 -3
 -4  CONTACT     6    1
 -5  COPEN       1    4    1    1
 -1         1 0.00000E+00 0.00000E+00 0.00000E+00 7.00000E+00 0.00000E+00 0.00000E+00
 -1         9 0.00000E+00 0.00000E+00 0.00000E+00 8.00000E+00 0.00000E+00 0.00000E+00
 -3
 -4  DISP        4    1
 -1         1 1.00000E+00 1.00000E+00 1.00000E+00 9.00000E+00
 -3
 -4  CONTACT     6    1
 -1         1 0.00000E+00-1.00000E+00 0.00000E+00 2.50000E+00 0.00000E+00 0.00000E+00
 -1        12 0.00000E+00 0.00000E+00 0.00000E+00-1.00000E-01 0.00000E+00 0.00000E+00
 -3
"""


def test_calculix_pressures_are_those_of_the_last_increment():
    nodes, pressure = last_contact(FRD)
    assert list(nodes) == [1, 12]
    assert list(pressure) == [2.5, -0.1]
    with pytest.raises(FailedError, match="no contact pressures"):
        last_contact(FRD.replace("CONTACT", "STRESS"))
