"""The race of finite-element codes: one problem for all, decks and results read rightly, judged.

The other codes need not be there; where one is, its pressures are held against the reference.
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparisons.benchmarks.finite_element_peers import __main__ as finite_element_peers
from comparisons.benchmarks.finite_element_peers import calculix as fe_peers_calculix
from comparisons.benchmarks.finite_element_peers import cases as fe_peers_cases
from comparisons.benchmarks.finite_element_peers import codes as fe_peers_codes
from comparisons.benchmarks.finite_element_peers import crosscheck as fe_peers_crosscheck
from comparisons.benchmarks.finite_element_peers import freefem as fe_peers_freefem
from comparisons.benchmarks.finite_element_peers.process import Code, FailedError, Run, spent
from comparisons.benchmarks.finite_element_peers.race import Point, race
from comparisons.benchmarks.finite_element_peers.task import Answer, Task, gap, run_program
from comparisons.benchmarks.finite_element_peers.verdict import Verdict, medians, time_at, verdicts

WAVES = np.array([[2e-7, 0.5, 0.3], [1e-7, 0.2, -1.0]])


@pytest.fixture(scope="module")
def cylinder():
    """Hertz's contact with a reference good enough for what is raced here."""
    return fe_peers_cases.made("cylinder", np.zeros((0, 3)), (5, 10), finest=40)


@pytest.fixture(scope="module")
def task(cylinder):
    """One mesh, with waves on the parabola."""
    return replace(cylinder.task(5, 0.4, 1), waves=WAVES)


def test_reference_is_hertz_contact_but_for_the_block(cylinder):
    """A block 40 a deep and wide presses back: 2.1e-4 more at the peak, as much less wide."""
    found, exact = cylinder.reference, fe_peers_cases.hertz()
    assert found.pressure.max() == pytest.approx(1.00021 * exact.peak_pressure, rel=5e-5)
    wide = replace(exact, half_width=exact.half_width / 1.00021)
    error = found.pressure - 1.00021 * wide.pressure(found.x)
    assert np.abs(error).max() < 0.04 * exact.peak_pressure  # next to the root at the edge
    assert np.abs(error[np.abs(found.x) < 0.9]).max() < 1e-3 * exact.peak_pressure
    load = found.pressure.sum() * (found.x[1] - found.x[0])  # equal hats
    assert load == pytest.approx(exact.load_per_length, rel=1e-9)


def test_errors_are_relative_to_the_reference(cylinder):
    right = cylinder.reference
    assert cylinder.errors(right) == {"peak": 0.0, "pressure": 0.0}
    more = cylinder.errors(replace(right, pressure=1.02 * right.pressure))
    assert more == pytest.approx({"peak": 0.02, "pressure": 0.02})
    aside = cylinder.errors(replace(right, x=right.x + 0.01))
    assert aside["peak"] == 0.0
    assert 0.01 < aside["pressure"] < 0.05


def test_pressure_is_nothing_beside_the_nodes():
    answer = Answer(np.array([0.0, 1.0]), np.array([2.0, 4.0]), np.zeros(1), 0, 0)
    assert list(answer.at(np.array([-0.1, 0.5, 1.1]))) == [0.0, 3.0, 0.0]


def test_gap_is_the_parabola_and_its_waves():
    x = 0.37
    waves = sum(a * (1.0 - np.cos(2.0 * np.pi * x / length + phi)) for a, length, phi in WAVES)
    assert gap(np.array([x]), 5.0, WAVES)[0] == pytest.approx(x**2 / 10.0 + waves, rel=1e-14)
    assert gap(np.array([x]), 5.0, WAVES[:0])[0] == pytest.approx(x**2 / 10.0, rel=1e-14)


def test_files_hold_all_of_a_task_and_of_an_answer(task, tmp_path):
    task.save(str(tmp_path / "task.npz"))
    again = Task.load(str(tmp_path / "task.npz"))
    for name, value in vars(task).items():
        np.testing.assert_array_equal(getattr(again, name), value)
    answer = Answer(np.arange(3.0), np.ones(3), np.array([0.1, 0.2]), 12, 3)
    answer.save(str(tmp_path / "answer.npz"))
    again = Answer.load(str(tmp_path / "answer.npz"))
    for name, value in vars(answer).items():
        np.testing.assert_array_equal(getattr(again, name), value)


def test_programs_solve_as_often_as_asked_and_sort(task, tmp_path):
    calls = []

    def solve(given: Task) -> tuple[np.ndarray, np.ndarray, int, int]:
        calls.append(given.approach)
        return np.array([1.0, 0.0]), np.array([5.0, 6.0]), 7, 8

    task.save(str(tmp_path / "task.npz"))
    run_program(solve, str(tmp_path / "task.npz"), str(tmp_path / "answer.npz"))
    answer = Answer.load(str(tmp_path / "answer.npz"))
    assert calls == [task.approach] * 2
    assert len(answer.seconds) == 2
    assert list(answer.x) == [0.0, 1.0]
    assert list(answer.pressure) == [6.0, 5.0]


@pytest.mark.parametrize("settings", fe_peers_codes.SETTINGS)
def test_ours_falls_with_the_mesh(cylinder, settings, tmp_path):
    files = str(tmp_path / "task.npz"), str(tmp_path / "answer.npz")
    error = []
    for edges in (10, 20):
        cylinder.task(edges, 0.2, 0).save(files[0])
        fe_peers_crosscheck.main(settings, *files)
        answer = Answer.load(files[1])
        assert np.all(np.diff(answer.x) >= 0.0)
        error.append(cylinder.errors(answer)["pressure"])
    assert error[1] < (0.017 if settings == "21" else 0.01)
    if not settings.endswith("s"):  # few hats hold no smooth curve, more of them a far better one
        assert np.log2(error[0] / error[1]) == pytest.approx(1.0, abs=0.2)


def test_freefem_mesh_is_ours(task):
    lines = fe_peers_freefem.mesh_text(task).splitlines()
    vertices, triangles, edges = map(int, lines[0].split())
    assert (vertices, triangles) == (len(task.vertices), len(task.triangles))
    rows = [
        np.array([row.split() for row in part], dtype=float)
        for part in (
            lines[1 : 1 + vertices],
            lines[1 + vertices : 1 + vertices + triangles],
            lines[1 + vertices + triangles :],
        )
    ]
    np.testing.assert_array_equal(rows[0][:, :2], task.vertices)
    np.testing.assert_array_equal(rows[1][:, :3] - 1, task.triangles[:, :3])
    assert len(rows[2]) == edges
    ends = task.vertices[rows[2][:, :2].astype(int) - 1]
    length = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    label = rows[2][:, 2]
    wide, ground = 2.0 * task.half_width, np.ptp(task.ground)
    lengths = {kind: length[label == kind].sum() for kind in (1, 2, 3)}
    assert lengths == pytest.approx({1: wide + 2 * task.depth, 2: ground, 3: wide - ground})


def test_freefem_script_has_the_problem_in_full(task):
    script = fe_peers_freefem.script(task)
    assert f"d = {task.approach:.17g};" in script
    assert f"R = {task.radius:.17g}," in script
    for name, values in zip(("amplitude", "wave", "phase"), WAVES.T, strict=True):
        assert f"{name} = [{', '.join(f'{v:.17g}' for v in values)}]" in script
    assert "run <= 1;" in script
    flat = fe_peers_freefem.script(replace(task, waves=WAVES[:0]))
    assert "amplitude = [0], wave = [1], phase = [0];" in flat


def test_freefem_answers_are_read():
    head = "run 0.5 4 88 0\nrun 0.25 4 88 0\n"
    answer = fe_peers_freefem.parse(head + "0.5 3e-6\n-0.5 1e-6\n0 2e-6\n")
    assert list(answer.x) == [-0.5, 0.0, 0.5]
    assert list(answer.pressure) == [1e-6, 2e-6, 3e-6]
    assert list(answer.seconds) == [0.5, 0.25]
    assert (answer.unknowns, answer.steps) == (88, 4)
    with pytest.raises(FailedError, match="not settled"):
        fe_peers_freefem.parse("run 0.5 101 88 2\n0 1\n")
    with pytest.raises(FailedError, match="no pressures"):
        fe_peers_freefem.parse("")


def _blocks(deck: str) -> dict[str, list[list[str]]]:
    """Rows by their keyword line."""
    found: dict[str, list[list[str]]] = {}
    for line in deck.splitlines():
        if line.startswith("*"):
            rows = found.setdefault(line, [])
        else:
            rows.append(line.split(","))
    return found


def test_calculix_block_has_the_gap_on_its_top(task):
    blocks = _blocks(fe_peers_calculix.deck(task))
    nodes = np.array(blocks["*NODE"], dtype=float)
    count = len(task.points)
    x, z = task.points.T
    ground = task.touchable(x, z)
    lowered = np.where(ground, task.gap(x), 0.0)
    np.testing.assert_allclose(nodes[:count, 1], x, rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(nodes[:count, 2], -z - lowered, rtol=1e-13, atol=1e-13)
    assert np.abs(nodes[:count, 2] + z).max() > 1e-6
    assert nodes[count:, 2].min() == 0.0  # the punch begins where the gap does
    elements = np.array(blocks["*ELEMENT,TYPE=CPE6,ELSET=BLOCK"], dtype=int)[:, 1:] - 1
    corner = nodes[elements[:, :3], 1:]
    side, other = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    assert (side[:, 0] * other[:, 1] - side[:, 1] * other[:, 0]).min() > 0.0
    flat = task.points[elements]
    for middle, ends in ((3, (0, 1)), (4, (1, 2)), (5, (2, 0))):
        np.testing.assert_allclose(flat[:, middle], flat[:, ends].mean(axis=1), atol=1e-12)


def test_calculix_faces_cover_the_ground_and_sets_the_support(task):
    blocks = _blocks(fe_peers_calculix.deck(task))
    elements = np.array(blocks["*ELEMENT,TYPE=CPE6,ELSET=BLOCK"], dtype=int)[:, 1:] - 1
    faces = blocks["*SURFACE,NAME=GROUND"]
    ends = {"S1": (0, 1), "S2": (1, 2), "S3": (2, 0)}
    pairs = np.array([elements[int(e) - 1][list(ends[face])] for e, face in faces])
    assert np.abs(np.diff(task.points[pairs, 0])).sum() == pytest.approx(np.ptp(task.ground))
    held = np.array(blocks["*NSET,NSET=HELD"], dtype=int).ravel() - 1
    np.testing.assert_array_equal(held, np.flatnonzero(task.held(*task.points.T)))


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
    nodes, pressure = fe_peers_calculix.last_contact(FRD)
    assert list(nodes) == [1, 12]
    assert list(pressure) == [2.5, -0.1]
    with pytest.raises(FailedError, match="no contact pressures"):
        fe_peers_calculix.last_contact(FRD.replace("CONTACT", "STRESS"))


def test_calculix_iterations_are_counted():
    rows = (
        "SUMMARY\n  STEP   INC\n\n 1  1  1  1  9  0.1\n 1  1  1  2  9  0.1\n 1  2  1  1  9  0.1\n"
    )
    assert fe_peers_calculix.iterations(rows) == 3


def test_time_at_an_error_lies_on_the_power_law_between():
    curve = [(4.0**-k, 8.0**k) for k in range(1, 5)]
    for target in (0.25, 0.1, 0.004):
        assert time_at(curve, target) == pytest.approx(target**-1.5)
    assert time_at(curve, 0.9) == 8.0
    assert time_at(curve, 1e-3) is None


def test_an_error_that_changes_sign_on_the_way_is_no_merit():
    assert time_at([(1e-1, 1.0), (1e-6, 2.0), (1e-2, 4.0)], 1e-2) == pytest.approx(2.0)
    assert time_at([(1e-1, 1.0), (1e-6, 2.0), (1e-2, 4.0)], 1e-3) is None
    assert time_at([(1e-3, 1.0), (1e-2, 4.0)], 1e-2) == 1.0


def _points(code, solve, how="", worst=1.0):
    return [
        Point(
            code,
            how,
            edges,
            0.4,
            9,
            9,
            solve * edges,
            1.0 + solve * edges,
            {"peak": 0.1 * worst / edges, "pressure": worst / edges},
        )
        for edges in (10, 1000)
    ]


def test_verdicts_compare_at_equal_error():
    points = _points("ours", 1.0) + _points("peer", 3.0) + _points("other", 0.5, worst=1.5)
    found = verdicts("case", points, "ours")
    assert {v.peer for v in found} == {"peer", "other"}
    assert all(v.holds for v in found if v.peer == "peer")
    assert not any(v.holds for v in found if v.peer == "other" and v.target < 0.1)
    assert medians(found)["peer"][0] == pytest.approx(3.0)
    assert medians(found)["other"][0] == pytest.approx(0.75)
    late = next(v for v in found if v.peer == "peer" and v.target == 3e-3 and v.error == "pressure")
    assert late.whole_ratio == pytest.approx(1001 / 334.3, rel=0.1)


def test_the_best_of_several_configurations_counts():
    points = _points("ours", 9.0, "slow") + _points("ours", 1.0, "fast") + _points("peer", 3.0)
    assert all(v.ratio == pytest.approx(3.0) for v in verdicts("case", points, "ours"))


@pytest.mark.parametrize(
    ("times", "holds"),
    [((1.0, 2.0), True), ((2.0, 1.0), False), ((1.0, None), True), ((None, 1.0), False)],
)
def test_what_only_one_reaches_is_a_verdict_without_ratio(times, holds):
    verdict = Verdict("case", "peak", 0.1, "peer", times, times)
    assert verdict.holds is holds
    assert (verdict.ratio is None) == (None in times)


def test_a_code_that_fails_is_not_asked_for_finer_meshes(cylinder):
    asked, told = [], []

    def solve(task: Task, folder: Path, limit: float) -> Run:
        asked.append(task.surface_size)
        if len(asked) == 3:
            raise FailedError("no more")
        seconds = np.array([9.0, float(len(asked)), float(len(asked))])
        return Run(replace(cylinder.reference, seconds=seconds), 0.1 * len(asked))

    case = replace(cylinder, ladder=(5, 6, 7))
    (point,) = race(case, [Code("code", "how", solve)], [0.4], 2, 1.0, told.append)
    assert asked == pytest.approx([1 / 5, 1 / 5, 1 / 6])
    assert (point.edges, point.solve, point.whole) == (5, 1.5, pytest.approx(0.15))
    assert "6 edges" in told[0]
    assert "no more" in told[0]


def test_processes_are_charged_their_processor_time(tmp_path):
    busy = "import time\nwhile time.process_time() < 0.3: pass"
    assert 0.29 < spent([sys.executable, "-c", busy], tmp_path, 60.0) < 1.0
    assert spent([sys.executable, "-c", "import time; time.sleep(0.5)"], tmp_path, 60.0) < 0.3
    with pytest.raises(FailedError, match="not done after 1 s"):
        spent([sys.executable, "-c", "while True: pass"], tmp_path, 1.0)
    with pytest.raises(FailedError, match=r"^last$"):
        spent(
            [sys.executable, "-c", "import sys; print('one', flush=True); sys.exit('last')"],
            tmp_path,
            9.0,
        )


def test_absent_peers_are_named(cylinder, monkeypatch, capsys):
    monkeypatch.setattr(fe_peers_cases, "cylinder", lambda: replace(cylinder, ladder=(5,)))
    monkeypatch.setattr(fe_peers_codes, "ours", lambda: [fe_peers_codes.our_code("21")])
    absent = [word for peer in fe_peers_codes.PEERS for word in (peer.option, "/nowhere/at/all")]
    arguments = ["--cases", "cylinder", "--rounds", "1", "--meshes", *absent]
    assert finite_element_peers.main(arguments) == 1
    shown = capsys.readouterr().out
    for peer in fe_peers_codes.PEERS:
        assert f"skipped: {peer.name} is not there (/nowhere/at/all): {peer.get}" in shown
    assert "no peer is there" in shown
    assert shown.count("a hat an edge") == 1


@pytest.mark.parametrize("peer", fe_peers_codes.PEERS, ids=lambda peer: peer.name)
def test_peers_find_the_same_pressures(peer, cylinder, tmp_path):
    if not fe_peers_codes.there(peer, peer.start):
        pytest.skip(f"{peer.name} is not installed: {peer.get}")
    run = peer.code(peer.start).solve(cylinder.task(10, 0.4, 0), tmp_path, 60.0)
    assert cylinder.errors(run.answer)["pressure"] < 0.03
    assert cylinder.errors(run.answer)["peak"] < 0.004
    assert 0.0 < run.answer.seconds[-1] < run.whole
