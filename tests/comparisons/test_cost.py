"""Cost studies: what is measured, by what errors are measured, what is recommended and follows."""

import io
import json
import sys
import time
import types
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from analytic.exact.hertz import hertz_from_load
from comparisons import cost_measure, cost_methods
from comparisons.cli import main
from comparisons.compare import figures
from comparisons.cost import content_of, cost, judged
from comparisons.cost_choice import Assessed, choices, followed, pareto
from comparisons.cost_measure import Measured, ProcessorStages, Refused, Task, measure
from comparisons.cost_methods import (
    ADAPTED,
    FINEST,
    METHODS,
    is_half_plane_problem,
    why_not,
)
from comparisons.cost_page import cost_page
from comparisons.cost_reference import error_of, is_exact, references
from comparisons.cost_solve import Answer, touching_strips
from comparisons.cost_store import FOLDER
from comparisons.cost_study import FAILED, OK, SKIPPED, Row, Study, _asked, _series
from comparisons.cost_table import cells, cost_summary, notes_of, refusals, shown
from comparisons.errors import SceneError
from comparisons.fresh_process import ProcessEnded
from comparisons.plan import MODELS
from comparisons.problem import problem_of
from comparisons.report.style import Picture
from comparisons.resolve import load_scene, resolve_tables
from comparisons.run import run
from comparisons.stages import silent
from comparisons.tolerance import with_tolerance

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
SMOOTH = {
    "title": "Smooth",
    "roller": {"radius": 7.5706e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"per_length": 3.55e6},
}
WAVY = SMOOTH | {
    "profile": {"kind": "sinusoid", "wavelength": 100e-6, "amplitude": 0.3e-6},
    "load": {"per_length": 2e5},
}
HERTZ = hertz_from_load(3.55e6, 7.5706e-3, 210e9 / 0.91 / 2.0)
BY_NAME = {method.name: method for method in METHODS}
SMALL = (FINEST, BY_NAME["P2"])


def problem(tables, **sections):
    return problem_of(scene(tables, **sections))


def scene(tables, **sections):
    tables = tables | {name: tables.get(name, {}) | more for name, more in sections.items()}
    return resolve_tables(tables, name="made", folder=Path("."), source="made.toml")


def row(name, setting, seconds, peak, status=OK, stress_seconds=0.0):
    """A row whose peak pressure is off by `peak`, of an exact 1."""
    answer = Answer(
        figures=({"peak_pressure": 1.0 + peak, "contact_length": 1.0},),
        x=np.array([-1.0, 0.0, 1.0]),
        pressure=np.array([0.0, 1.0, 0.0]),
        stresses=(),
        elements=1,
        unknowns=100,
        converged=True,
        level=None,
    )
    times = {"contact": seconds, "stresses": stress_seconds}
    measured = Measured(answer, times, seconds, seconds, (seconds, seconds), 1, 10**8, seconds)
    return Row(BY_NAME[name], setting, status, None if status == OK else "why", measured)


def assessed(*rows):
    return [
        Assessed(r, {"peak_pressure": abs(r.measured.answer.figures[0]["peak_pressure"] - 1.0)})
        for r in rows
    ]


def chosen(rows, tolerance, floor=0.0):
    reference = types.SimpleNamespace(floor=floor)
    found = choices(Study((), {}), rows, {"peak_pressure": reference}, {"peak_pressure": tolerance})
    return found[0]


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """A whole study of two methods at three and two settings, and its folder."""
    folder = tmp_path_factory.mktemp("cost") / "out"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cost_methods, "HALF_PLANE_PITCHES", (2.0, 1.0, 0.5))
        patch.setattr(cost_methods, "FINITE_ELEMENT_PITCHES", (2.0, 1.0))
        return cost(scene(SMOOTH), folder, 2, methods=SMALL), folder


class TestWholeStudy:
    def test_every_setting_is_a_row_measured_by_hertz(self, small):
        found, _ = small
        assert [r.method.name for r in found.study.rows] == ["hats, FFT"] * 3 + ["P2"] * 2
        for each in found.assessed:
            assert each.row.status == OK and each.row.measured.repeats == 2
            peak = each.row.measured.answer.figures[0]["peak_pressure"]
            exact = abs(peak / HERTZ.peak_pressure - 1.0)
            assert each.errors["peak_pressure"] == pytest.approx(exact, rel=1e-6)
            assert 0.0 < exact < 2e-3
        assert found.references["peak_pressure"].source == "exact (Hertz)"

    def test_time_stages_and_memory(self, small):
        found, _ = small
        half_plane, finite = (found.study.of(name) for name in ("hats, FFT", "P2"))
        assert set(finite[0].measured.seconds) >= {"mesh", "assembly", "factorisation", "contact"}
        assert 0.0 < half_plane[-1].seconds(True) < finite[-1].seconds(True) < 5.0
        assert 2e7 < half_plane[-1].measured.memory < finite[-1].measured.memory

    def test_the_recommendation_followed_meets_the_tolerance(self, small, tmp_path, monkeypatch):
        """By what `run` makes of it: at that level, and where it ends."""
        monkeypatch.setattr("comparisons.report.page.render", lambda outcome: "")
        found, _ = small
        choice = found.choices[-1]
        assert choice.quantity == "all" and choice.finite_element is not None
        for picked in (choice.half_plane, choice.finite_element):
            wanted = picked.row.method.model
            sections = followed(picked.row, found.problem)
            outcome = run(scene(SMOOTH, **sections), tmp_path / wanted, (wanted,))
            level = outcome.runs[wanted].levels[sections["resolution"]["levels"] - 1]
            assert level.grid.pitch == pytest.approx(picked.row.setting, rel=1e-12)
            contact = outcome.result["models"][wanted][0]["contact"]
            reached = figures(level, outcome.problem, 0.0)
            for name, exact in (
                ("peak_pressure", HERTZ.peak_pressure),
                ("contact_length", 2.0 * HERTZ.half_width),
            ):
                assert abs(contact[name] / exact - 1.0) <= found.problem.scene.tolerance[name]
                error = abs(reached[name] / exact - 1.0)
                assert error == pytest.approx(picked.errors[name], rel=0.02, abs=1e-9)
                assert error <= found.problem.scene.tolerance[name]

    def test_files(self, small):
        found, folder = small
        assert {p.name for p in folder.iterdir()} == {"cost.json", "cost.html", FOLDER}
        content = json.loads((folder / "cost.json").read_text())
        assert content == json.loads(json.dumps(content_of(found)))
        assert len(content["rows"]) == 5 and content["machine"]["threads"] == 1
        last = content["choices"][-1]
        assert content["rows"][last["finite_element"]["row"]]["method"] == "P2"
        assert "peak_pressure" in content["rows"][0]["best_for"] + content["rows"][2]["best_for"]

    def test_page_needs_no_network_and_has_all_rows_and_sentences(self, small):
        found, folder = small
        page = (folder / "cost.html").read_text()
        assert "http://" not in page and "https://" not in page and "<script" not in page
        assert page.count('<tr class="ok">') == 5
        assert page.count("data:image/svg+xml") == 3
        for choice in found.choices:
            assert choice.sentence in page
        assert "finite_element = {element = &quot;P2&quot;, growth = 0." in page

    def test_table(self, small):
        from rich.console import Console

        found, _ = small
        console = Console(width=140, record=True, file=io.StringIO())
        console.print(cost_summary(found))
        text = console.export_text()
        assert "For all tolerances of the scene take the half-plane (hats, FFT" in text
        assert "threads 1" in text and "exact (Hertz)" in text


class TestRows:
    """What fails or would take too long is a row, told apart."""

    class Process:
        """Gives the answers, or raises them."""

        def __init__(self, *answers):
            self.answers, self.tasks = list(answers), []

        def __call__(self, work, task):
            self.tasks.append(task)
            answer = self.answers.pop(0)
            if isinstance(answer, Exception):
                raise answer
            return answer

    def rows(self, *answers, name="P2", left=1e9):
        process = self.Process(*answers)
        store = types.SimpleNamespace(load=lambda task: None, save=lambda task, found: None)
        ask = _asked(store, process)
        found = _series(BY_NAME[name], problem(SMOOTH), 3, left, ask, silent)
        return found, process

    def test_refused_and_failed(self):
        good = row("P2", 1.0, 1.0, 0.0).measured
        wild = replace(good, answer=replace(good.answer, converged=False))
        refused, failed = Refused("budget.memory", True), Refused("MeshError: no mesh", False)
        found, _ = self.rows(good, failed, wild, refused)
        assert [r.status for r in found] == [OK, FAILED, FAILED, SKIPPED]
        assert found[1].because == "MeshError: no mesh" and found[2].because == "did not converge"
        assert found[2].measured is wild

    def test_a_lost_process_is_a_failure_and_the_finer_settings_are_skipped(self):
        good = row("P2", 1.0, 1.0, 0.0).measured
        found, process = self.rows(good, ProcessEnded())
        assert [r.status for r in found] == [OK, FAILED, SKIPPED, SKIPPED]
        assert len(process.tasks) == 2

    def test_what_would_not_end_in_time_is_skipped(self):
        """After a second the next one takes 3.5, and there are 3 left."""
        found, process = self.rows(row("P2", 1.0, 1.0, 0.0).measured, left=4.0)
        assert [r.status for r in found] == [OK, SKIPPED, SKIPPED, SKIPPED]
        assert "budget.time" in found[1].because and process.tasks[0].limit <= 1.0

    def test_a_dense_matrix_that_is_too_large_is_skipped(self, monkeypatch):
        monkeypatch.setattr("comparisons.cost_study.MOST_DENSE", 100)
        good = row("hats, dense", 1.0, 1e-3, 0.0).measured
        found, _ = self.rows(good, good, name="hats, dense")
        assert [r.status for r in found][:3] == [OK, OK, SKIPPED]
        assert found[2].because.startswith("113 elements; a dense matrix")

    def test_they_are_kept_and_told_apart(self, monkeypatch):
        rows = [row("P2", 1e-5, 1.0, 1e-4), row("P2", 5e-6, 1.0, 1e-4, status=FAILED)]
        rows += [Row(BY_NAME["P1"], None, SKIPPED, "does not apply")]
        found = judged(problem(SMOOTH), Study(tuple(rows), {}))
        names = shown(found)
        texts = [cells(found, each, names) for each in found.assessed]
        assert texts[1][-1].endswith("failed") and "skipped" in texts[2]
        assert refusals(found) == [
            "P2 5.00 µm failed: why",
            "P1 skipped: does not apply",
        ]
        monkeypatch.setattr(
            "comparisons.cost_page.cost_picture", lambda *a: Picture("data:,", "", "")
        )
        page = cost_page(found)
        assert all(f'<tr class="{status}">' in page for status in (OK, FAILED, SKIPPED))
        content = content_of(found)
        assert [r["status"] for r in content["rows"]] == [OK, FAILED, SKIPPED]
        assert all(
            each not in front for front in found.fronts.values() for each in found.assessed[1:]
        )
        assert notes_of(found)

    def test_nothing_to_measure_by_is_an_error_of_the_scene(self):
        wavy = problem(WAVY)
        with pytest.raises(SceneError, match="nothing to measure errors by: why"):
            judged(wavy, Study((Row(FINEST, 1e-6, FAILED, "why"),), {}))


class TestChoice:
    def test_what_nothing_beats(self):
        rows = assessed(
            row("P1", 4.0, 1.0, 1e-1),
            row("P1", 2.0, 2.0, 1e-2),
            row("P2", 4.0, 1.5, 5e-2),
            row("P2", 2.0, 3.0, 2e-2),
            row("P3", 4.0, 9.0, 1e-5),
            row("P3", 2.0, 0.1, 0.0, status=FAILED),
        )
        front = pareto(rows, "peak_pressure", floor=1e-3)
        assert [each.row.setting for each in front] == [4.0, 4.0, 2.0, 4.0]
        assert [each.row.method.name for each in front] == ["P1", "P2", "P1", "P3"]

    def test_below_the_floor_nothing_is_closer(self):
        rows = assessed(row("P2", 2.0, 1.0, 5e-4), row("P3", 2.0, 2.0, 1e-6))
        assert len(pareto(rows, "peak_pressure", floor=1e-3)) == 1

    def test_time_of_a_contact_figure_is_without_the_stresses(self):
        one = row("P2", 2.0, 1.0, 0.0, stress_seconds=5.0)
        assert (one.seconds(False), one.seconds(True)) == (1.0, 6.0)
        rows = assessed(one, row("P3", 2.0, 2.0, 0.0))
        assert chosen(rows, 0.1).finite_element.row is one

    def test_the_cheapest_that_meets_the_tolerance(self):
        rows = assessed(
            row("hats, FFT", 4.0, 0.1, 3e-2),
            row("hats, FFT", 2.0, 0.2, 1e-3),
            row("P1", 1.0, 5.0, 1e-3),
            row("P2", 4.0, 1.0, 3e-2),
            row("P2", 2.0, 2.0, 2e-3),
            row("P2", 1.0, 8.0, 2e-4),
        )
        choice = chosen(rows, 0.01)
        assert choice.half_plane.row is rows[1].row and choice.finite_element.row is rows[4].row
        assert choice.sentence == (
            "For 1 % of the peak pressure take the half-plane (hats, FFT at a pitch of 2.00 m: "
            "expect 200 ms); of the finite elements P2 at a pitch of 2.00 m, 100 unknowns: "
            "expect 2.0 s."
        )

    def test_not_one_that_meets_it_by_chance(self):
        rows = assessed(
            row("P2", 4.0, 1.0, 1e-5), row("P2", 2.0, 2.0, 5e-2), row("P2", 1.0, 8.0, 1e-3)
        )
        assert chosen(rows, 0.01).finite_element.row.setting == 1.0

    def test_the_floor_counts_as_error(self):
        rows = assessed(row("P2", 4.0, 1.0, 8e-3), row("P2", 2.0, 2.0, 1e-3))
        assert chosen(rows, 0.01, floor=5e-3).finite_element.row.setting == 2.0

    def test_a_reference_that_is_not_good_enough_recommends_nothing(self):
        choice = chosen(assessed(row("P2", 4.0, 1.0, 0.0)), 0.01, floor=0.02)
        assert choice.finite_element is choice.half_plane is None
        assert "nothing can be said: the reference itself is that uncertain" in choice.sentence

    def test_cheaper_ones_that_run_does_not_have_are_named(self):
        rows = assessed(row("P2 adapted", 0.01, 0.5, 1e-3), row("P2", 4.0, 1.0, 1e-3))
        choice = chosen(rows, 0.01)
        assert choice.cheapest.row.method.name == ADAPTED
        assert choice.sentence.endswith(
            "P2 at a pitch of 4.00 m, 100 unknowns: expect 1.0 s; no setting of the half-plane "
            "will do; cheapest of all is P2 adapted to 0.01, 100 unknowns: expect 500 ms."
        )

    def test_nothing_will_do(self):
        sentence = chosen(assessed(row("P2", 4.0, 1.0, 0.5)), 0.01).sentence
        assert sentence == "For 1 % of the peak pressure no measured setting will do."


class TestMethods:
    @pytest.mark.parametrize(
        ("sections", "half_plane", "adapted"),
        [
            ({}, True, True),
            ({"roller": {"poissons_ratio": 0.2}}, True, False),
            ({"body": {"thickness": 2e-3}}, False, False),
            ({"body": {"hardness": 9e9}}, True, False),
            ({"finite_element": {"gap": "displaced"}}, False, False),
            ({"finite_element": {"roller_shape": "circle"}}, False, False),
            ({"finite_element": {"roller_body": "disc"}}, False, False),
        ],
    )
    def test_where_they_apply(self, sections, half_plane, adapted):
        made = problem(SMOOTH, **sections)
        assert is_half_plane_problem(made) is half_plane
        assert is_exact(made) is half_plane
        assert (why_not(BY_NAME[ADAPTED], made) is None) is adapted
        assert all(why_not(m, made) is None for m in METHODS if not m.adapted)

    def test_friction_that_moves_the_surfaces_leaves_hats_alone(self):
        made = problem(
            SMOOTH, roller={"poissons_ratio": 0.0}, load={"friction": [0.3], "coupled": True}
        )
        plain = [m for m in METHODS if m.model == "half_plane"]
        assert [why_not(m, made) is None for m in plain] == [m == FINEST for m in plain]
        assert not is_exact(made)

    @pytest.mark.parametrize("element", ["hats", "strips"])
    def test_dense_and_fft_find_the_same(self, element):
        made = scene(SMOOTH, stress={"points": [60, 20]})
        pitch = problem_of(made).pitches[0]
        one, other = (
            measure(Task(made, None, f"{element}, {way}", pitch)).answer for way in ("FFT", "dense")
        )
        assert one.pressure == pytest.approx(other.pressure, rel=1e-6)
        for name, value in one.figures[0].items():
            assert other.figures[0][name] == pytest.approx(value, rel=1e-6)
            assert value > 0.0

    @pytest.mark.parametrize("element", ["hats", "strips"])
    def test_of_hertz_errors_fall_with_the_pitch(self, element):
        made = scene(SMOOTH, stress={"points": [60, 20]})
        exact = {
            "peak_pressure": HERTZ.peak_pressure,
            "contact_length": 2.0 * HERTZ.half_width,
            "tau1_max": HERTZ.tau1_max,
        }
        errors = []
        for part in (1.0, 0.125):
            pitch = part * problem_of(made).pitches[0]
            found = measure(Task(made, None, f"{element}, FFT", pitch)).answer.figures[0]
            errors.append([abs(found[name] / value - 1.0) for name, value in exact.items()])
        assert np.all(np.array(errors[0]) < [1e-3, 1.5e-2, 1e-3])
        assert np.all(np.array(errors[1]) < np.array(errors[0]) / 4.0)

    def test_strips_reach_from_edge_to_edge(self):
        grid = problem(SMOOTH).grid(1e-4)
        pressure = np.zeros(grid.count)
        pressure[[2, 3, 6]] = 1.0
        patches = touching_strips(grid, types.SimpleNamespace(pressure=pressure))
        assert patches / 1e-4 - grid.first == pytest.approx(np.array([[1.5, 3.5], [5.5, 6.5]]))


@pytest.fixture(scope="module")
def study():
    """The finest method on waves, at five settings."""
    made = scene(WAVY)
    pitches = FINEST.settings(problem_of(made))[:5]
    rows = [Row(FINEST, p, OK, None, measure(Task(made, None, FINEST.name, p))) for p in pitches]
    return problem_of(made), Study(tuple(rows), {})


class TestReference:
    def test_of_a_rough_half_plane_is_its_finest_with_its_uncertainty(self, study):
        made, rows = study
        found = references(made, rows, None)
        last = rows.rows[-1]
        for name, reference in found.items():
            assert reference.row is last and reference.source.startswith("hats, FFT at ")
            assert 0.0 < reference.floor < 0.05, name
        finer = measure(Task(made.scene, None, FINEST.name, 0.25 * last.setting)).answer
        for name in ("peak_pressure", "contact_length"):
            true = error_of(finer, name, found[name], made, None)
            assert true <= found[name].floor

    def test_errors_fall_towards_it(self, study):
        made, rows = study
        found = judged(made, rows)
        for name in ("peak_pressure", "pressure_l2"):
            errors = [each.errors[name] for each in found.assessed]
            assert errors[-1] is None
            assert errors[0] > 3.0 * errors[2] > 0.0
        texts = cells(found, found.assessed[-1], shown(found))
        assert texts[-1] == "reference"

    def test_two_rows_tell_no_uncertainty(self, study):
        made, rows = study
        assert references(made, replace(rows, rows=rows.rows[:2]), None) == {}


class TestMeasure:
    @pytest.fixture
    def calls(self, monkeypatch):
        """Every go of `solved`, which takes no time."""
        calls, answer = [], row("P2", 1.0, 1.0, 0.0).measured.answer

        def solved(method, problem, setting, window, stages, halved):
            calls.append(setting)
            with stages.stage("contact"):
                return answer

        monkeypatch.setattr(cost_measure, "solved", solved)
        monkeypatch.setattr(cost_measure, "_begun", [])
        return calls

    def test_the_first_go_does_not_count(self, calls):
        found = measure(Task(scene(SMOOTH), None, FINEST.name, 1e-5, repeats=3, limit=60.0))
        assert (len(calls), found.repeats) == (4, 3)

    def test_no_more_than_fit_and_at_least_one(self, calls):
        assert measure(Task(scene(SMOOTH), None, FINEST.name, 1e-5, 3, limit=0.0)).repeats == 1
        assert len(calls) == 2

    def test_what_goes_wrong_is_told(self, monkeypatch):
        def solved(*arguments):
            raise SceneError("made.toml: budget.memory: is too small")

        monkeypatch.setattr(cost_measure, "solved", solved)
        task = Task(scene(SMOOTH), None, FINEST.name, 1e-5)
        assert measure(task) == Refused("made.toml: budget.memory: is too small", skipped=True)
        monkeypatch.setattr(cost_measure, "solved", lambda *a: 1 / 0)
        assert measure(task) == Refused("ZeroDivisionError: division by zero", skipped=False)

    def test_seconds_are_the_processors(self):
        stages = ProcessorStages()
        with stages.stage("waiting"):
            time.sleep(0.05)
        assert stages.seconds["waiting"] < 0.02


class TestTolerance:
    def test_it_replaces_each_that_the_scene_has(self):
        found = with_tolerance(load_scene("smooth"), 0.005)
        assert found.tolerance == dict.fromkeys(
            ("peak_pressure", "contact_length", "tau1_max"), 5e-3
        )
        assert found.tables["tolerance"] == found.tolerance

    @pytest.mark.parametrize("wrong", ["0", "1", "-0.1", "nan"])
    def test_not_every_number_is_one(self, wrong, capsys):
        assert main(["run", "smooth", "--tolerance", wrong]) == 2
        assert "--tolerance: is " in capsys.readouterr().err

    def test_the_ladder_stops_where_it_is_met(self, tmp_path, monkeypatch):
        monkeypatch.setattr("comparisons.report.page.render", lambda outcome: "")
        coarse = scene(SMOOTH, resolution={"pitch": 1e-4})
        levels = {}
        for tolerance in (0.2, 2e-3):
            given = with_tolerance(coarse, tolerance)
            outcome = run(given, tmp_path / f"{tolerance}", ("half_plane",))
            assert outcome.result["refinement"] == "every judged quantity is resolved"
            levels[tolerance] = len(outcome.runs["half_plane"].levels)
        assert levels[0.2] == 3 < levels[2e-3]

    def test_the_command_hands_it_on(self, monkeypatch, tmp_path):
        given = []

        def stand_in(scene, out, models, *rest):
            given.append(scene.tolerance)
            return types.SimpleNamespace(result={}, exit_status=0)

        monkeypatch.setitem(sys.modules, "comparisons.run", types.SimpleNamespace(run=stand_in))
        command = ["run", "smooth", "--json", "--out", str(tmp_path / "out")]
        assert main([*command, "--tolerance", "0.01"]) == 0
        assert set(given[0].values()) == {0.01}


class TestCommand:
    @pytest.mark.parametrize(
        ("arguments", "words"),
        [
            (["cost", "smoth"], "the nearest scene is smooth"),
            (["cost", "smooth", "--repeats", "0"], "--repeats: is 0; allowed is 1 or more"),
            (["cost", "smooth", "--out", "/dev/null/there"], "/dev/null is not a folder"),
        ],
    )
    def test_wrong_input(self, arguments, words, capsys):
        assert main(arguments) == 2
        out, err = capsys.readouterr()
        assert out == "" and words in err and err.count("\n") == 1

    def test_several_processes_are_refused(self, monkeypatch, tmp_path):
        monkeypatch.setattr("comparisons.cost.is_several", lambda: True)
        with pytest.raises(ValueError, match="allowed without mpirun"):
            cost(scene(SMOOTH), tmp_path / "out", 1)

    def test_an_interrupt_leaves_nothing(self, monkeypatch, tmp_path):
        def stopped(*arguments):
            raise KeyboardInterrupt

        monkeypatch.setattr("comparisons.cost.measured_study", stopped)
        with pytest.raises(KeyboardInterrupt, match="the same command goes on from there"):
            cost(scene(SMOOTH), tmp_path / "out", 1)
        assert list(tmp_path.iterdir()) == []

    def test_a_runs_own_files_stay_beside_it(self, monkeypatch, tmp_path):
        (tmp_path / "result.json").write_text("{}")
        rows = (row("P2", 1e-5, 1.0, 1e-4),)
        monkeypatch.setattr("comparisons.cost.measured_study", lambda *a: Study(rows, {}))
        monkeypatch.setattr("comparisons.cost_page.cost_page", lambda found: "")
        cost(scene(SMOOTH), tmp_path, 1)
        assert {p.name for p in tmp_path.iterdir()} == {"result.json", "cost.json", "cost.html"}


def test_both_models_are_measured():
    assert {method.model for method in METHODS} == set(MODELS)
