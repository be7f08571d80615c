"""Many runs as one table."""

import csv
import io
import json

import pytest
from scenes import STEADY

from comparisons.cli import main
from comparisons.common.numbers import rounded_up
from comparisons.common.provenance import as_json
from comparisons.output.flat_csv import judged_rows, tidy_rows
from comparisons.output.records import COLUMNS
from comparisons.output.result import result_of
from comparisons.studies import meaning


@pytest.fixture(scope="module")
def runs(tmp_path_factory, smooth_outcome, wavy_outcome, finish):
    """Three runs, one of a single model, in a folder; and what is no run."""
    folder = tmp_path_factory.mktemp("runs")
    alone = finish(STEADY, ("half_plane",))
    for name, outcome in (("a", smooth_outcome), ("deep/b", wavy_outcome), ("c", alone)):
        (folder / name).mkdir(parents=True)
        (folder / name / "result.json").write_text(as_json(result_of(outcome).result))
    (folder / ".part-x").mkdir()
    (folder / ".part-x" / "result.json").write_text("{")
    return folder


def test_a_row_for_each_figure_of_every_study(runs, wavy_outcome):
    rows = tidy_rows([runs / "deep"])
    for row, figure in zip(rows, wavy_outcome.figures, strict=True):
        assert tuple(row) == COLUMNS
        assert (row["study"], row["quantity"], row["against"]) == (*figure.key[:2], figure.against)
        assert (row["value"], row["verdict"]) == (figure.value, figure.verdict)
        assert row["unit"] == ("" if figure.against else meaning(figure).unit)
    assert {"contact", "comparison", "model_error", "quiescent_zone"} <= {r["study"] for r in rows}


def test_people_see_what_is_judged_and_of_a_run_that_judges_nothing_its_contact(runs, capsys):
    assert main(["table", str(runs)]) == 0
    printed = capsys.readouterr().out.split("\n\n")
    for name, said in zip(("a", "c", "deep/b"), printed, strict=True):
        rows = [r for r in judged_rows(tidy_rows([runs])) if r["run"] == str(runs / name)]
        assert all(row["study"] == "contact" if name == "c" else row["verdict"] for row in rows)
        title, _, _, *lines = said.splitlines()
        assert len(lines) == len(rows) > 0 and max(map(len, lines)) < 120
        assert "half-plane" in said and "peak pressure" in said
        size = rows[0]["within"]
        size = "unknown" if size is None else f"{100.0 * rounded_up(size):.2g} %"
        assert title == f"{runs / name}, right within {size}"


def test_a_run_is_counted_once(runs):
    assert tidy_rows([runs, runs / "a"]) == tidy_rows([runs])


def test_a_foreign_result_is_named_and_passed_over(runs, tmp_path, capsys):
    for name, content in (("foreign", '{"rows": []}'), ("later", '{"schema": 99}')):
        (tmp_path / name).mkdir()
        (tmp_path / name / "result.json").write_text(content)
    assert main(["table", str(tmp_path), str(runs / "a"), "--json"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out) == tidy_rows([runs / "a"])
    lines = [line.partition("result.json: ")[2] for line in err.splitlines()]
    assert [line.partition(": ")[0] for line in lines] == ["schema", "schema"]
    assert all(line.endswith("; it is passed over") for line in lines)


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


def test_a_file_that_cannot_be_is_refused(runs, tmp_path, complaint):
    (tmp_path / "in.csv").mkdir()
    said = "in.csv: cannot be written: is a folder; allowed is a file"
    assert said in complaint("table", runs, "--out", tmp_path / "in.csv")
    said = "ends with .xlsx; allowed is .csv"
    assert said in complaint("table", runs, "--out", tmp_path / "all.xlsx")
