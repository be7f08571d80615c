"""The problem on which finite-element codes are compared: its reference, all its solutions, and
whole processes."""

import pytest

from tests.finite_element_peers import calculix, cases, scikit_fem, whole_process
from tests.finite_element_peers.whole_process import process, stored
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
