"""Interrupted cost studies go on from what they have measured, and measure it once."""

import json
import os
import signal
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from scenes import SMOOTH, STEEL, changed, problem, resolved

from comparisons.campaigns.cost import measure as cost_measure
from comparisons.campaigns.cost import methods as cost_methods
from comparisons.campaigns.cost.cost import GOES_ON, _problem, cost
from comparisons.campaigns.cost.measure import FOLDER, CostTask, MeasuredRun, cost_cache, measure
from comparisons.campaigns.cost.methods import FINEST, METHODS
from comparisons.common.progress import no_progress
from comparisons.models.finite_element.level import problem_of_approach

SMALL = tuple(method for method in METHODS if method.name in (FINEST.name, "P2"))
# The command line, with methods and settings left out that would only take time.
COMMAND = """
import sys
from comparisons.campaigns.cost import cost, methods
from comparisons.cli import main
methods.HALF_PLANE_PITCHES, methods.FINITE_ELEMENT_PITCHES = (2.0, 1.0, 0.5), (2.0, 1.0)
small = tuple(m for m in methods.METHODS if m.name in ("hats, FFT", "P2"))
cost.cost.__defaults__ = (cost.no_progress, small, False)
if __name__ == "__main__":
    sys.exit(main())
"""


def saved(out: Path) -> dict[str, int]:
    """The measured settings, and when each was written."""
    return {path.name: path.stat().st_mtime_ns for path in (out / FOLDER).glob("*.npz")}


class Here:
    """Measures in this process, at few settings.

    asked    method and setting of each that was measured
    stop_at  the number of the one that is interrupted, 0 for none
    """

    def __init__(self) -> None:
        self.asked, self.stop_at = [], 0

    def measure(self, task: CostTask) -> MeasuredRun:
        self.asked.append((task.method.name, task.setting))
        if self.stop_at == len(self.asked):
            raise KeyboardInterrupt
        return measure(task)


@pytest.fixture
def here(monkeypatch) -> Here:
    state = Here()
    monkeypatch.setattr(cost_methods, "HALF_PLANE_PITCHES", (2.0, 1.0, 0.5))
    monkeypatch.setattr(cost_methods, "FINITE_ELEMENT_PITCHES", (2.0,))
    monkeypatch.setattr(cost_measure, "ProcessWorker", None)
    monkeypatch.setattr(cost_measure, "measure", state.measure)
    monkeypatch.setattr("comparisons.campaigns.cost.cost.cost_page", lambda study: "")
    return state


@pytest.fixture(scope="module")
def measured() -> tuple[CostTask, MeasuredRun]:
    """A setting with stresses under two frictions."""
    made = problem(changed(SMOOTH, stress={"points": [60, 20]}, load={"friction": [0.0, 0.1]}))
    task = CostTask(made, FINEST, 1e-5, repeats=2)
    return task, measure(task)


class TestStore:
    def test_settings_are_told_apart(self, measured, tmp_path):
        task, row = measured
        cache = cost_cache(tmp_path, task.problem.scene, 2)
        cache.save(task.name, row)
        for other in ({"setting": 2e-5}, {"half_block": True}, {"method": METHODS[-1]}):
            assert cache.load(replace(task, **other).name) is None
        assert cache.load(replace(task, limit=7.0).name) is not None

    @pytest.mark.parametrize(
        ("name", "other"),
        [("machine", {"processor": "another"}), ("versions", {"numpy": "0"}),
         ("program_code", "another")],
    )  # fmt: skip
    def test_another_machine_or_version_measures_anew(
        self, measured, name, other, tmp_path, monkeypatch
    ):
        task, row = measured
        cost_cache(tmp_path, task.problem.scene, 2).save(task.name, row)
        monkeypatch.setattr(cost_measure, name, lambda *places: other)
        assert cost_cache(tmp_path, task.problem.scene, 2).load(task.name) is None

    def test_so_does_another_scene_or_number_of_repeats(self, measured, tmp_path):
        task, row = measured
        cost_cache(tmp_path, task.problem.scene, 2).save(task.name, row)
        other = resolved(changed(SMOOTH, load={"per_length": 3.5e6}))
        assert cost_cache(tmp_path, other, 2).load(task.name) is None
        assert cost_cache(tmp_path, task.problem.scene, 3).load(task.name) is None


class TestGoesOn:
    def test_from_where_it_stopped(self, here, tmp_path):
        out = tmp_path / "out"
        here.stop_at = 3
        with pytest.raises(KeyboardInterrupt, match=GOES_ON):
            cost(resolved(SMOOTH), out, 1, methods=SMALL)
        before = saved(out)
        assert len(before) == 2 and [path.name for path in out.iterdir()] == [FOLDER]
        here.stop_at = 0
        study = cost(resolved(SMOOTH), out, 1, methods=SMALL)
        assert here.asked[2] == here.asked[3]  # what was stopped is asked again, nothing else
        assert len(set(here.asked)) == 4 == len(here.asked) - 1
        assert before.items() <= saved(out).items() and len(study.rows) == 4

    def test_a_finished_study_is_there_at_once(self, here, tmp_path):
        cost(resolved(SMOOTH), tmp_path, 1, methods=SMALL)
        content, asked = (tmp_path / "cost.json").read_text(), len(here.asked)
        cost(resolved(SMOOTH), tmp_path, 1, methods=SMALL)
        assert len(here.asked) == asked == 4
        assert (tmp_path / "cost.json").read_text() == content
        cost(resolved(changed(SMOOTH, load={"per_length": 3.5e6})), tmp_path, 1, methods=SMALL)
        assert len(here.asked) == 2 * asked

    def test_what_failed_is_tried_again(self, here, tmp_path, monkeypatch):
        tried = []

        def failing(task):
            tried.append(task.method.name)
            raise cost_measure.RefusedError(cost_measure.FAILED, "MeshError: no mesh")

        cost(resolved(SMOOTH), tmp_path, 1, methods=SMALL)
        for path in (tmp_path / FOLDER).glob("P2*"):
            path.unlink()
        monkeypatch.setattr(cost_measure, "measure", failing)
        for _ in range(2):
            study = cost(resolved(SMOOTH), tmp_path, 1, methods=SMALL)
            assert study.rows[-1].because == "MeshError: no mesh"
        assert tried == ["P2", "P2"]

    def test_the_load_of_an_approach_is_sought_once(self, tmp_path, monkeypatch):
        tables = SMOOTH | {
            "roller": {"radius": 7.5706e-3, "rigid": True},
            "body": {**STEEL, "thickness": 4e-4},
            "load": {"approach": 2e-6},
            "resolution": {"pitch": 2e-5},
        }
        scene = resolved(tables)
        first = _problem(scene, cost_cache(tmp_path, scene, 1), no_progress)
        monkeypatch.setattr("comparisons.campaigns.cost.cost._load_of_approach", None)
        again = _problem(scene, cost_cache(tmp_path, scene, 1), no_progress)
        assert again.hertz.load_per_length == first.hertz.load_per_length
        assert (
            first.hertz.load_per_length
            == problem_of_approach(scene, no_progress).constraints().load
        )


@pytest.fixture
def command(tmp_path) -> tuple:
    """`crosscheck cost` of a small scene, and its folder."""
    (tmp_path / "small.toml").write_text(
        "roller = {radius = 7.5706e-3, youngs_modulus = 210e9, poissons_ratio = 0.3}\n"
        "body = {youngs_modulus = 210e9, poissons_ratio = 0.3}\n"
        "load = {per_length = 3.55e6}\n"
    )
    (tmp_path / "program.py").write_text(COMMAND)
    out = tmp_path / "out"
    scene, program = tmp_path / "small.toml", tmp_path / "program.py"
    return (sys.executable, program, "cost", scene, "--repeats", 1, "--out", out), out


def test_a_ctrl_c_ends_it_and_the_same_command_goes_on(command, started, until):
    words, out = command
    with started(*words) as process:
        assert until(lambda: len(saved(out)) >= 1)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        assert process.wait(20.0) == 130
        said = process.stderr.read()  # nobody holds it any more
    assert said == f"crosscheck: interrupted; {GOES_ON}\n"
    before = saved(out)
    assert 1 <= len(before) < 5 and not (out / "cost.json").exists()
    with started(*words) as process:
        printed, said = process.communicate(timeout=120.0)
        assert process.returncode == 0 and said == "" and "cost.html" in printed
    assert before.items() <= saved(out).items() and len(saved(out)) == 5
    content = json.loads((out / "cost.json").read_text())
    assert [row["status"] for row in content["rows"]] == ["ok"] * 5
    assert sorted(path.name for path in out.iterdir()) == ["cost.html", "cost.json", FOLDER]
