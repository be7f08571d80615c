"""Python's way in: the same figures as the command line, tables, pictures, examples that run."""

import doctest
import importlib
import json
from pathlib import Path

import numpy as np
import pytest
from scenes import STEEL_PAIR, as_toml, without_cost

import comparisons as crosscheck
from comparisons.api import scene_of
from comparisons.cli import main
from comparisons.common.errors import ExitStatus, InputError
from comparisons.figures.quantity import models_named
from comparisons.grid.map import Map, finished_map
from comparisons.runs.finished import FinishedRun
from comparisons.scenes.surface import surface_of

SLIDING = STEEL_PAIR | {
    "title": "Smooth",
    "load": {"per_length": 1e6, "friction": [0.0, 0.1]},
    "tolerance": {"peak_pressure": 0.5, "contact_length": 0.5, "tau1_max": 0.5},
    "stress": {"points": [12, 6]},
    "resolution": {"pitch": 30e-6, "levels": 2},
    "finite_element": {"block": 10, "growth": 0.5},
    "budget": {"effects": False, "time": 0.9},
}


@pytest.fixture(scope="module")
def sliding() -> FinishedRun:
    return crosscheck.run(SLIDING)


def test_python_says_what_the_command_line_prints_and_writes(
    sliding, tmp_path, capsys, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("comparisons.output.page.page.render", lambda *_: "")
    Path("scene.toml").write_text(as_toml(SLIDING))
    status = main(["run", "scene.toml", "--out", "out", "--json"])
    printed = without_cost(json.loads(capsys.readouterr().out))
    assert without_cost(json.loads(json.dumps(sliding.result))) == printed
    again = crosscheck.read("out")
    assert status == sliding.exit_status == again.exit_status
    assert without_cost(again.result) == printed
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out", "scene.toml"]


def test_a_run_prints_in_ten_lines_and_shows_its_tables(sliding):
    title, first, *others = str(sliding).splitlines()
    assert title == SLIDING["title"] and len(others) <= 8
    assert "\x1b" not in str(sliding) and max(map(len, others)) <= 100
    assert sliding.within == max(error.reach for error in sliding.outcome.model_errors)
    assert first.startswith("The half-plane is right within ")
    assert any(line.lower().startswith(sliding.verdict) for line in others[:2])
    assert any(line.startswith("peak pressure") and "whole" in line for line in others)
    assert any(line.startswith("Next:  ") for line in others)
    html = sliding._repr_html_()
    assert html.startswith("<pre") and "model error of the half-plane" in html


def test_scenes_by_name_path_and_tables(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("scene.toml").write_text(as_toml(SLIDING))
    by_path, by_tables = scene_of("scene.toml"), scene_of(SLIDING)
    assert by_path.tables == by_tables.tables == scene_of(by_path).tables
    assert surface_of(scene_of("ground-unrun")).info.samples == 2237


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: scene_of("smoth"), "the nearest scene is smooth"),
        (lambda: crosscheck.run("smooth", "fem"), "models: there is no model fem"),
        (lambda: crosscheck.run("smooth", ()), "models: is empty"),
        (lambda: crosscheck.read("nowhere"), "nowhere: holds no result.json"),
        (lambda: crosscheck.map("smooth", "8"), "--points"),
        (
            lambda: crosscheck.run("smooth", 5),
            "models: is 5; allowed are half-plane, finite-element",
        ),
        (
            lambda: crosscheck.run("smooth", tolerance="0.1"),
            'is "0.1", which has no unit; allowed is a number',
        ),
        (
            lambda: crosscheck.run("smooth", tolerance=True),
            "tolerance.peak_pressure: is true; allowed is a number",
        ),
        (lambda: crosscheck.run("smooth", out="/dev/null/a"), "/dev/null is not a folder"),
        (lambda: scene_of(7), "scene: is 7; allowed is a name, a path, tables"),
        (lambda: scene_of({"title": object()}), "title: is of type object; allowed is"),
    ],
)
def test_wrong_input_is_one_line_before_anything_is_solved(call, words, monkeypatch):
    monkeypatch.setattr("comparisons.runs.run.solve_scene", None)
    with pytest.raises(InputError) as caught:
        call()
    assert words in str(caught.value) and "\n" not in str(caught.value)


@pytest.fixture(scope="module")
def finished(wavy_outcome) -> FinishedRun:
    return FinishedRun.of(wavy_outcome)


def test_curves_are_those_of_the_finest_level(finished):
    level = finished.outcome.runs["half_plane"].finest
    curves = finished.contact()
    assert np.array_equal(curves["x"], level.grid.x)
    assert np.array_equal(curves["pressure"], level.solution.pressure)
    assert set(curves) == {"x", "pressure", "gap", "deformed_height"}
    with pytest.raises(InputError, match="model: is fem"):
        finished.contact("fem")


def test_several_runs_in_one_table(finished, smooth_outcome):
    runs = finished, FinishedRun.of(smooth_outcome)
    both = crosscheck.compare(*runs)
    assert len(both.rows) == sum(len(run.figures) for run in runs)
    text = repr(both)
    assert "Wavy body" in text and "Smooth roller" in text
    assert crosscheck.compare(list(runs)).rows == both.rows
    assert crosscheck.compare([finished]).rows == crosscheck.compare(finished).rows


@pytest.fixture
def pyplot():
    from matplotlib import pyplot

    pyplot.switch_backend("agg")
    pyplot.close("all")  # figures that the tests of another file left open
    yield pyplot
    pyplot.close("all")


@pytest.mark.parametrize(
    ("draw", "words"),
    [
        (lambda plot: plot.problem(), None),
        (lambda plot: plot.pressure(), "p/p₀"),
        (lambda plot: plot.close_up(), "p/p₀"),
        (lambda plot: plot.surfaces(), None),
        (lambda plot: plot.field(), "z/a"),
        (lambda plot: plot.field("txz", 0.1), "z/a"),
        (lambda plot: plot.sections(1), None),
        (lambda plot: plot.mesh(2), None),
        (lambda plot: plot.model_error(), None),
    ],
)
def test_plots_return_the_axes_of_one_open_figure(finished, pyplot, draw, words):
    axes = draw(finished.plot)
    (number,) = pyplot.get_fignums()
    assert {axis.figure for axis in axes} == {pyplot.figure(number)}
    assert words is None or axes[0].get_ylabel() == words
    axes[0].figure.canvas.draw()


def test_fields_are_told_apart(finished, pyplot):
    titles = {
        (name, mu): finished.plot.field(name, mu)[0].get_title(loc="left")
        for name in ("tau1", "txz")
        for mu in (0.0, 0.1)
    }
    assert len(set(titles.values())) == 4
    level = finished.outcome.solved.case(0.1).runs["half_plane"].finest
    extreme = level.stress.extremes["txz"].value
    largest = abs(extreme) / finished.outcome.problem.hertz.peak_pressure
    assert f"{largest:.4f} p₀" in titles["txz", 0.1]


@pytest.mark.parametrize(
    "draw",
    [
        lambda plot: plot.field("sx"),
        lambda plot: plot.field("tau1", 0.5),
        lambda plot: plot.mesh(3),
        lambda plot: plot.view("fem"),
        lambda plot: plot.view(array="sxx"),
    ],
)
def test_a_picture_that_is_not_there_is_one_line(finished, pyplot, draw):
    with pytest.raises(InputError, match="allowed is"):
        draw(finished.plot)
    assert pyplot.get_fignums() == []


def test_a_view_holds_the_field_with_depth_downwards(finished):
    plotter = finished.plot.view("half_plane", "tau1 (friction 0.1)")
    mesh = plotter.mesh
    field = finished.outcome.solved.case(0.1).runs["half_plane"].finest.stress.field
    assert np.array_equal(mesh["tau1 (friction 0.1)"], field.tau1.ravel().astype(np.float32))
    assert plotter.camera.up == (0.0, -1.0, 0.0)
    sight = np.subtract(plotter.camera.focal_point, plotter.camera.position)
    assert np.cross(sight, plotter.camera.up)[0] > 0.0  # x to the right
    plotter.close()


def test_report_is_written_where_it_is_asked_for(finished, tmp_path, monkeypatch):
    monkeypatch.setattr("comparisons.output.page.page.render", lambda run, *_: f"<p>{id(run)}</p>")
    path = finished.report(tmp_path / "mine.html")
    assert path.read_text() == f"<p>{id(finished.outcome)}</p>"


def test_a_finished_map_prints_and_draws(pyplot):
    content = finished_map("thickness-friction")
    shown = Map(content, None)
    assert "points" in repr(shown) and "map.json" not in repr(shown)
    assert "Model error of the half-plane" in shown.plot.map()[0].get_title(loc="left")


def test_what_functions_return_is_of_one_kind(finished):
    table, deck = crosscheck.compare(finished), crosscheck.deck("smooth", "calculix")
    for result in (finished, table, deck, Map(finished_map("thickness-friction"), None)):
        assert 0 < len(result.summary.splitlines()) <= 10, result.summary
        assert result.exit_status in ExitStatus and result._repr_html_().startswith("<pre")
        assert result.figures.rows and all(isinstance(row, dict) for row in result.figures.rows)


def test_examples_run(tmp_path, monkeypatch, pyplot):
    monkeypatch.chdir(tmp_path)
    results = [
        doctest.testmod(importlib.import_module(name), extraglobs={"crosscheck": crosscheck})
        for name in ("comparisons", "comparisons.api")
    ]
    assert all(result.attempted > 8 and result.failed == 0 for result in results)
    assert list(tmp_path.iterdir()) == []


def test_figures_are_a_table_and_records(finished):
    figures = finished.figures
    assert tuple(figures) == tuple(finished.outcome.figures)
    text = repr(figures)
    assert "model_error" in text and "peak_pressure" in text and "0.1" in text
    frame = figures.of(study="contact")
    assert {figure.study for figure in frame} == {"contact"}
    assert len(figures.rows) == len(figures)
    pandas = pytest.importorskip("pandas")
    table = figures.frame()
    assert isinstance(table, pandas.DataFrame) and len(table) == len(figures)


@pytest.mark.parametrize("name", ["half-plane", "half_plane"])
def test_a_model_has_one_name_written_in_two_ways(finished, name):
    assert finished.figure("peak_pressure", name, friction=0.1).source == "half_plane"
    assert finished.contact(name)["x"] is not None and finished.stress(name)["x"] is not None
    assert models_named(name) == ("half_plane",)


@pytest.mark.parametrize(
    ("wanted", "words"),
    [
        (("peak_presure", "half-plane"), "quantity: is peak_presure; the nearest here is peak_pre"),
        (("peak_pressure", "halfplane"), "source: is halfplane; the nearest here is half_plane"),
        (("peak_pressure", "half-plane", "contacts"), "study: is contacts; the nearest here is co"),
    ],
)
def test_a_figure_that_a_run_has_not_raises_with_the_nearest(finished, wanted, words):
    with pytest.raises(InputError, match=words):
        finished.figure(*wanted)
    known = "allowed is friction = 0, friction = 0.1"
    with pytest.raises(InputError, match=rf"is not known at friction = 0\.3; {known}"):
        finished.figure("peak_pressure", "half-plane", friction=0.3)


def test_a_scene_prints_itself_in_few_lines():
    lines = repr(crosscheck.Scene.read("ground-unrun")).splitlines()
    assert len(lines) <= 12 and any("roller" in line and "mm" in line for line in lines)
