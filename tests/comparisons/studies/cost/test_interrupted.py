"""Cost studies that are interrupted go on from what they have measured, and measure it once."""

import json
import os
import signal
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparisons.common.progress import no_progress
from comparisons.models.finite_element.level import problem_of_approach
from comparisons.scenes.resolve import resolve_tables
from comparisons.studies.cost import methods as cost_methods
from comparisons.studies.cost import study as cost_study
from comparisons.studies.cost.cache import FOLDER, cost_cache, name_of
from comparisons.studies.cost.cost import GOES_ON, _problem, cost
from comparisons.studies.cost.measure import Measured, Task, measure
from comparisons.studies.cost.methods import FINEST, METHODS

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
SMOOTH = {
    "title": "Smooth",
    "roller": {"radius": 7.5706e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"per_length": 3.55e6},
}
P2 = next(method for method in METHODS if method.name == "P2")
SMALL = (FINEST, P2)
# The command line, with methods and settings left out that would only take time.
COMMAND = """
import sys
from comparisons.studies.cost import cost, methods
from comparisons.cli import main
methods.HALF_PLANE_PITCHES, methods.FINITE_ELEMENT_PITCHES = (2.0, 1.0, 0.5), (2.0, 1.0)
small = tuple(m for m in methods.METHODS if m.name in ("hats, FFT", "P2"))
cost.cost.__defaults__ = (*cost.cost.__defaults__[:-1], small)
if __name__ == "__main__":
    sys.exit(main())
"""


def scene(**sections):
    tables = SMOOTH | {name: SMOOTH.get(name, {}) | more for name, more in sections.items()}
    return resolve_tables(tables, name="made", folder=Path("."), source="made.toml")


def kept(out: Path) -> dict[str, int]:
    """The measured settings, and when each was written."""
    return {path.name: path.stat().st_mtime_ns for path in (out / FOLDER).glob("*.npz")}


class Here:
    """Measures in this process, at few settings.

    asked    method and setting of each that was measured
    stop_at  the number of the one that is interrupted, 0 for none
    """

    def __init__(self) -> None:
        self.asked, self.stop_at = [], 0

    def carried_out(self, call, task: Task) -> Measured:
        self.asked.append((task.method, task.setting))
        if self.stop_at == len(self.asked):
            raise KeyboardInterrupt
        return measure(task)


@pytest.fixture
def here(monkeypatch) -> Here:
    found = Here()
    monkeypatch.setattr(cost_methods, "HALF_PLANE_PITCHES", (2.0, 1.0, 0.5))
    monkeypatch.setattr(cost_methods, "FINITE_ELEMENT_PITCHES", (2.0,))
    monkeypatch.setattr(cost_study, "_carried_out", found.carried_out)
    monkeypatch.setattr("comparisons.studies.cost.page.cost_page", lambda found: "")
    return found


@pytest.fixture(scope="module")
def measured() -> tuple[Task, Measured]:
    """A setting with stresses under two frictions."""
    made = scene(stress={"points": [60, 20]}, load={"friction": [0.0, 0.1]})
    task = Task(made, None, FINEST.name, 1e-5, repeats=2)
    return task, measure(task)


class TestStore:
    def test_what_comes_back_is_what_was_measured(self, measured, tmp_path):
        task, found = measured
        store = cost_cache(tmp_path, task.scene, 2)
        assert store.load(name_of(task)) is None
        store.save(name_of(task), found)
        again = store.load(name_of(task))
        for name in ("seconds", "total", "wall", "spread", "repeats", "memory", "spent"):
            assert getattr(again, name) == getattr(found, name)
        assert again.answer.figures == found.answer.figures
        assert np.array_equal(again.answer.pressure, found.answer.pressure)
        for one, other in zip(again.answer.stresses, found.answer.stresses, strict=True):
            assert one.extremes == other.extremes
            assert np.array_equal(one.field.sx, other.field.sx)
        assert again.answer.level.solution.residuals == found.answer.level.solution.residuals

    def test_settings_are_told_apart(self, measured, tmp_path):
        task, found = measured
        store = cost_cache(tmp_path, task.scene, 2)
        store.save(name_of(task), found)
        for other in ({"setting": 2e-5}, {"half_block": True}, {"method": "hats, dense"}):
            assert store.load(name_of(replace(task, **other))) is None
        assert store.load(name_of(replace(task, limit=7.0))) is not None

    @pytest.mark.parametrize(
        "patched",
        [
            ("comparisons.studies.cost.cache.machine", {"processor": "another"}),
            ("comparisons.studies.cost.cache.versions", {"numpy": "0"}),
            ("comparisons.studies.cost.cache.program_code", "another"),
        ],
    )
    def test_another_machine_or_version_measures_anew(
        self, measured, patched, tmp_path, monkeypatch
    ):
        task, found = measured
        cost_cache(tmp_path, task.scene, 2).save(name_of(task), found)
        assert cost_cache(tmp_path, task.scene, 2).load(name_of(task)) is not None
        monkeypatch.setattr(patched[0], lambda *given: patched[1])
        assert cost_cache(tmp_path, task.scene, 2).load(name_of(task)) is None

    def test_so_does_another_scene_or_number_of_repeats(self, measured, tmp_path):
        task, found = measured
        cost_cache(tmp_path, task.scene, 2).save(name_of(task), found)
        other = scene(load={"per_length": 3.5e6})
        assert cost_cache(tmp_path, other, 2).load(name_of(task)) is None
        assert cost_cache(tmp_path, task.scene, 3).load(name_of(task)) is None

    def test_what_was_cut_short_is_not_there(self, measured, tmp_path):
        task, found = measured
        store = cost_cache(tmp_path, task.scene, 2)
        store.save(name_of(task), found)
        [path] = store.folder.iterdir()
        path.write_bytes(path.read_bytes()[:-100])
        assert store.load(name_of(task)) is None
        (store.folder / ".half.npz.7.part").write_text("PK")
        store.remove_leftovers()
        assert list(store.folder.iterdir()) == [path]


class TestGoesOn:
    def test_from_where_it_stopped(self, here, tmp_path):
        out = tmp_path / "out"
        here.stop_at = 3
        with pytest.raises(KeyboardInterrupt, match=GOES_ON):
            cost(scene(), out, 1, methods=SMALL)
        before = kept(out)
        assert len(before) == 2 and [path.name for path in out.iterdir()] == [FOLDER]
        here.stop_at = 0
        found = cost(scene(), out, 1, methods=SMALL)
        assert here.asked[2] == here.asked[3]  # what was stopped is asked again, nothing else
        assert len(set(here.asked)) == 4 == len(here.asked) - 1
        assert before.items() <= kept(out).items() and len(found.study.rows) == 4

    def test_a_finished_study_is_there_at_once(self, here, tmp_path):
        cost(scene(), tmp_path, 1, methods=SMALL)
        content, asked = (tmp_path / "cost.json").read_text(), len(here.asked)
        cost(scene(), tmp_path, 1, methods=SMALL)
        assert len(here.asked) == asked == 4
        assert (tmp_path / "cost.json").read_text() == content
        cost(scene(load={"per_length": 3.5e6}), tmp_path, 1, methods=SMALL)
        assert len(here.asked) == 2 * asked

    def test_what_failed_is_tried_again(self, here, tmp_path, monkeypatch):
        tried = []

        def failing(call, task):
            tried.append(task.method)
            return cost_study.Refused("MeshError: no mesh", skipped=False)

        cost(scene(), tmp_path, 1, methods=SMALL)
        for path in (tmp_path / FOLDER).glob("P2*"):
            path.unlink()
        monkeypatch.setattr(cost_study, "_carried_out", failing)
        for _ in range(2):
            found = cost(scene(), tmp_path, 1, methods=SMALL)
            assert found.study.rows[-1].because == "MeshError: no mesh"
        assert tried == ["P2", "P2"]

    def test_the_load_of_an_approach_is_sought_once(self, tmp_path, monkeypatch):
        tables = SMOOTH | {
            "roller": {"radius": 7.5706e-3, "rigid": True},
            "body": {**STEEL, "thickness": 4e-4},
            "load": {"approach": 2e-6},
            "resolution": {"pitch": 2e-5},
        }
        given = resolve_tables(tables, name="made", folder=Path("."), source="made.toml")
        first = _problem(given, cost_cache(tmp_path, given, 1), no_progress)
        monkeypatch.setattr("comparisons.studies.cost.cost.fresh_process", lambda: 1 / 0)
        again = _problem(given, cost_cache(tmp_path, given, 1), no_progress)
        assert again.hertz.load_per_length == first.hertz.load_per_length
        assert (
            first.hertz.load_per_length
            == problem_of_approach(given, no_progress).constraints().load
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
        assert until(lambda: len(kept(out)) >= 1)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        assert process.wait(20.0) == 130
        said = process.stderr.read()  # nobody holds it any more
    assert said == f"crosscheck: interrupted; {GOES_ON}\n"
    before = kept(out)
    assert 1 <= len(before) < 5 and not (out / "cost.json").exists()
    with started(*words) as process:
        printed, said = process.communicate(timeout=120.0)
        assert process.returncode == 0 and said == "" and "cost.html" in printed
    assert before.items() <= kept(out).items() and len(kept(out)) == 5
    content = json.loads((out / "cost.json").read_text())
    assert [row["status"] for row in content["rows"]] == ["ok"] * 5
    assert sorted(path.name for path in out.iterdir()) == ["cost.html", "cost.json", FOLDER]
