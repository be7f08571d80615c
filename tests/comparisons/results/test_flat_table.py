"""Many runs as one table."""

import csv
import io
import json
import sys

import pytest

from comparisons.cli import main
from comparisons.common.provenance import as_json
from comparisons.results.flat_table import COLUMNS, EFFECT_COLUMNS, GROUPS, tidy_rows, write_table


@pytest.fixture(scope="module")
def runs(tmp_path_factory, smooth_outcome, wavy_outcome, finish, smooth_tables):
    """Three runs, one of a single model, in a folder; and what is no run."""
    folder = tmp_path_factory.mktemp("runs")
    alone = finish(smooth_tables, ("half_plane",))
    for name, outcome in (("a", smooth_outcome), ("deep/b", wavy_outcome), ("c", alone)):
        (folder / name).mkdir(parents=True)
        (folder / name / "result.json").write_text(as_json(outcome.result))
    (folder / ".part-x").mkdir()
    (folder / ".part-x" / "result.json").write_text("{")
    return folder


def expected(result: dict) -> int:
    return sum(len(rows) for rows in result["comparison"].values())


def test_a_row_for_each_run_friction_and_quantity(runs, smooth_outcome, wavy_outcome):
    rows = tidy_rows([runs])
    assert all(tuple(row) == COLUMNS for row in rows)
    keys = [(row["run"], row["friction"], row["quantity"]) for row in rows]
    assert len(set(keys)) == len(keys)
    counts = [sum(row["run"] == str(runs / name) for row in rows) for name in ("a", "deep/b")]
    assert counts == [expected(o.result) for o in (smooth_outcome, wavy_outcome)]


def test_figures_are_those_of_the_result(runs, wavy_outcome):
    result = wavy_outcome.result
    for row in tidy_rows([runs / "deep"]):
        (said,) = [
            r for r in result["comparison"][row["quantity"]] if r["friction"] == row["friction"]
        ]
        shown = said.keys() - {"not_modelled_exceeds_tolerance"}
        assert {name: row[name] for name in shown} == {name: said[name] for name in shown}
        (error,) = [
            r for r in result["model_error"][row["quantity"]] if r["friction"] == row["friction"]
        ]
        assert row["model_error"] == error["value"]
        assert row["model_error_uncertainty"] == error["uncertainty"]
        assert row["model_error_verdict"] == error["verdict"]
        assert (abs(row["interaction"]), row["jump"]) == (abs(error["interaction"]), error["jump"])
        assert {name: row[name] for name in GROUPS} == result["groups"]
        assert row["validity"] == result["validity"]["verdict"]
    units = {row["quantity"]: row["unit"] for row in tidy_rows([runs])}
    assert units["peak_pressure"] == "Pa"
    assert (units["contact_length"], units["pressure_l2"]) == ("m", "")


def test_effects_have_columns(runs, tmp_path):
    result = json.loads((runs / "a" / "result.json").read_text())
    for quantity in ("peak_pressure", "pressure_l2"):
        result["model_error"][quantity][0]["effects"] = {
            "finite_strain": {"value": 0.25, "uncertainty": 0.1}
        }
        result["model_error"][quantity][0]["interaction"] = 0.125
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
    entry = smooth_outcome.result["models"]["half_plane"][0]
    found = {row["quantity"]: row for row in rows if row["friction"] == entry["friction"]}
    assert found["peak_pressure"]["half_plane"] == entry["contact"]["peak_pressure"]
    assert found["tau1_max_depth"]["half_plane"] == entry["stress"]["tau1_max_at"][1]
    assert found["txz_max_abs"]["half_plane"] == entry["stress"]["txz_max_abs"]
    assert {row["finite_element"] for row in rows} == {None}
    assert "pressure_l2" not in found


def test_a_run_is_counted_once(runs):
    assert tidy_rows([runs, runs / "a"]) == tidy_rows([runs])


def test_csv_on_standard_output_and_in_a_file(runs, tmp_path, capsys):
    assert main(["table", str(runs)]) == 0
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


def test_parquet(runs, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet", reason="no pyarrow: pip install pyarrow")
    rows = tidy_rows([runs])
    write_table(tmp_path / "all.parquet", rows)
    assert parquet.read_table(tmp_path / "all.parquet").to_pylist() == rows


def test_without_pyarrow_one_line_says_how_to_get_it(runs, tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert main(["table", str(runs), "--out", str(tmp_path / "all.parquet")]) == 2
    err = capsys.readouterr().err
    assert "pip install pyarrow" in err and err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (None, "holds no run"),
        ("{", "is not JSON"),
        ('{"schema": 99}', "schema: is 99, of a later crosscheck; allowed is 2"),
        ('{"schema": 1}', "schema: is 1, of an earlier crosscheck; allowed is 2: run the scene"),
        ('{"schema": 2, "scene": {}}', "is no result of a run"),
    ],
)
def test_what_is_no_run_is_one_line(tmp_path, capsys, content, words):
    if content is not None:
        (tmp_path / "result.json").write_text(content)
    assert main(["table", str(tmp_path)]) == 2
    out, err = capsys.readouterr()
    assert out == "" and words in err and err.count("\n") == 1


@pytest.mark.parametrize(
    ("out", "words"), [("all.xlsx", "ends with .xlsx"), ("no/all.csv", "no is no folder")]
)
def test_a_file_that_cannot_be_is_refused(runs, tmp_path, capsys, monkeypatch, out, words):
    monkeypatch.chdir(tmp_path)
    assert main(["table", str(runs), "--out", out]) == 2
    assert words in capsys.readouterr().err
    assert main(["table", "nowhere"]) == 2
