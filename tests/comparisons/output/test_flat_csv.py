"""Many runs as one table."""

import csv
import io
import json

import pytest
from rich.console import Console

from comparisons.cli import main
from comparisons.common.numbers import with_unit
from comparisons.common.provenance import as_json
from comparisons.output.flat_csv import COLUMNS, EFFECT_COLUMNS, LONG_COLUMNS, tidy_rows
from comparisons.output.result_json import content_of
from comparisons.output.terminal import PLAIN, summary
from comparisons.studies import meaning
from comparisons.studies.problem import GROUPS


@pytest.fixture(scope="module")
def runs(tmp_path_factory, smooth_outcome, wavy_outcome, finish, smooth_tables):
    """Three runs, one of a single model, in a folder; and what is no run."""
    folder = tmp_path_factory.mktemp("runs")
    alone = finish(smooth_tables, ("half_plane",))
    for name, outcome in (("a", smooth_outcome), ("deep/b", wavy_outcome), ("c", alone)):
        (folder / name).mkdir(parents=True)
        (folder / name / "result.json").write_text(as_json(content_of(outcome)))
    (folder / ".part-x").mkdir()
    (folder / ".part-x" / "result.json").write_text("{")
    return folder


def test_a_row_for_each_run_friction_and_quantity(runs, smooth_outcome, wavy_outcome):
    rows = tidy_rows([runs])
    assert all(tuple(row) == COLUMNS for row in rows)
    keys = [(row["run"], row["friction"], row["quantity"]) for row in rows]
    assert len(set(keys)) == len(keys)
    counts = [sum(row["run"] == str(runs / name) for row in rows) for name in ("a", "deep/b")]
    runs = smooth_outcome, wavy_outcome
    assert counts == [len(run.figures.of(study="comparison")) for run in runs]


def test_figures_are_those_of_the_result(runs, wavy_outcome):
    groups = {f.quantity: f.value for f in wavy_outcome.figures.of(study="problem", source="scene")}
    for row in tidy_rows([runs / "deep"]):
        known = wavy_outcome.figures.of(quantity=row["quantity"], friction=row["friction"])
        said, error = known.one(study="comparison"), known.one(study="model_error")
        for name, figure in (("difference", said), ("model_error", error)):
            assert row[name] == figure.value
        assert (row["uncertainty"], row["verdict"]) == (said.numerical, said.verdict)
        assert (row["tolerance"], row["model_error_verdict"]) == (said.tolerance, error.verdict)
        assert row["model_error_uncertainty"] == error.numerical
        for model in ("half_plane", "finite_element"):
            figure = known.one(study="contact", source=model)
            assert row[model] == (figure and figure.value)
        assert abs(row["interaction"]) == abs(error.part("interaction").value)
        assert row["jump"] == error.part("jump").value
        assert {name: row[name] for name in GROUPS} == dict.fromkeys(GROUPS) | groups
        assert row["validity"] == "inconclusive"
    units = {row["quantity"]: row["unit"] for row in tidy_rows([runs])}
    assert units["peak_pressure"] == "Pa"
    assert (units["contact_length"], units["pressure_l2"]) == ("m", "")


def test_effects_have_columns(runs, tmp_path):
    result = json.loads((runs / "a" / "result.json").read_text())
    for figure in result["figures"]:
        if figure["study"] == "model_error" and figure.get("against") == "whole":
            figure["parts"] |= {
                "finite_strain": {"value": 0.25, "uncertainty": 0.1},
                "interaction": {"value": 0.125},
            }
    (tmp_path / "result.json").write_text(json.dumps(result))
    of = {r["quantity"]: r for r in reversed(tidy_rows([tmp_path]))}
    row = of["peak_pressure"]
    # of the half-plane, as the report has it: what it lacks makes its figure too low
    assert row["effect_finite_strain"] == -0.25
    assert of["pressure_l2"]["effect_finite_strain"] == 0.25  # norms have no sign
    assert (row["interaction"], of["pressure_l2"]["interaction"]) == (-0.125, 0.125)
    assert [row[name] for name in EFFECT_COLUMNS.values()].count(None) == len(EFFECT_COLUMNS) - 1


def test_a_single_model_has_its_figures_alone(runs, smooth_outcome):
    rows = tidy_rows([runs / "c"])
    known = smooth_outcome.figures.of(study="contact", source="half_plane", friction=0.0)
    by_quantity = {row["quantity"]: row for row in rows if row["friction"] == 0.0}
    for name in ("peak_pressure", "tau1_max_depth", "txz_max_abs"):
        assert by_quantity[name]["half_plane"] == known.one(quantity=name).value
        assert by_quantity[name]["uncertainty"] == known.one(quantity=name).numerical
    assert {row["validity"] for row in rows} == {"not compared"}
    assert {row["finite_element"] for row in rows} == {None}
    assert "pressure_l2" not in by_quantity


def test_below_a_rough_boundary_the_depth_is_the_terminals(finish, wavy_outcome, tmp_path):
    """It counts from the deformed boundary, of one model alone, too."""
    rough = wavy_outcome.problem.scene.changed("finite_element.geometry", "rough")
    alone = finish(rough.written, ("finite_element",))
    depth = alone.figures.one(study="contact", quantity="tau1_max_depth", friction=0.0)
    [field] = alone.runs["finite_element"].finest.stresses[:1]
    assert abs(depth.value - field.extremes["tau1"].z) > 0.1e-6
    (tmp_path / "result.json").write_text(as_json(content_of(alone)))
    [row] = [
        row
        for row in tidy_rows([tmp_path])
        if (row["quantity"], row["friction"]) == ("tau1_max_depth", 0.0)
    ]
    assert row["finite_element"] == depth.value
    shown = io.StringIO()
    Console(file=shown, width=80).print(summary(alone))
    lines = [line for line in shown.getvalue().splitlines() if line.startswith("tau1 max depth")]
    assert any(with_unit(depth.value, "m").translate(PLAIN) in line for line in lines)


def test_long_has_a_row_for_each_figure_of_every_study(runs, wavy_outcome, capsys):
    assert main(["table", str(runs / "deep"), "--long", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert len(rows) == len(wavy_outcome.figures) and set(rows[0]) == set(LONG_COLUMNS)
    for row, figure in zip(rows, wavy_outcome.figures, strict=True):
        assert (row["study"], row["quantity"], row["against"]) == (*figure.key[:2], figure.against)
        assert (row["value"], row["verdict"]) == (figure.value, figure.verdict)
        assert row["unit"] == ("" if figure.against else meaning(figure).unit)
    assert {"contact", "comparison", "model_error", "quiescent_zone"} <= {r["study"] for r in rows}


def test_a_run_is_counted_once(runs):
    assert tidy_rows([runs, runs / "a"]) == tidy_rows([runs])


def test_csv_on_standard_output_and_in_a_file(runs, tmp_path, capsys):
    assert main(["table", str(runs), "--csv"]) == 0
    printed = capsys.readouterr().out
    read = list(csv.DictReader(io.StringIO(printed)))
    rows = tidy_rows([runs])
    for text, row in zip(read, rows, strict=True):
        assert {name: "" if v is None else str(v) for name, v in row.items()} == text
    assert main(["table", str(runs), "--out", str(tmp_path / "all.csv")]) == 0
    assert (tmp_path / "all.csv").read_text() == printed
    assert capsys.readouterr().out == f"{len(rows)} rows of 3 runs in {tmp_path / 'all.csv'}\n"


def test_json(runs, capsys):
    assert main(["table", str(runs / "a"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == tidy_rows([runs / "a"])


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (None, "holds no run"),
        ("{", "is not JSON"),
        ('{"schema": 99}', "schema: is 99, of a later crosscheck; allowed is 3"),
        ('{"schema": 1}', "schema: is 1, of an earlier crosscheck; allowed is 3: run the scene"),
        ('{"schema": 3, "scene": {}}', "is no result of a run"),
    ],
)
def test_what_is_no_run_is_one_line(tmp_path, capsys, content, words):
    if content is not None:
        (tmp_path / "result.json").write_text(content)
    assert main(["table", str(tmp_path)]) == 2
    out, err = capsys.readouterr()
    assert out == "" and words in err and err.count("\n") == 1


@pytest.mark.parametrize(
    ("out", "words"),
    [("all.xlsx", "ends with .xlsx; allowed is .csv"), ("no/all.csv", "no is no folder")],
)
def test_a_file_that_cannot_be_is_refused(runs, tmp_path, capsys, monkeypatch, out, words):
    monkeypatch.chdir(tmp_path)
    assert main(["table", str(runs), "--out", out]) == 2
    assert words in capsys.readouterr().err
    assert main(["table", "nowhere"]) == 2
