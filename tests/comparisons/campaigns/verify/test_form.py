"""The exact cases for other codes: what is exported can be solved, and a filled form is judged."""

import csv
from pathlib import Path

import pytest

import comparisons as crosscheck
from comparisons.campaigns.decks.write import write_deck
from comparisons.campaigns.verify.form import (
    COLUMNS,
    export_form,
    form_cases,
    is_covered,
    judged_form,
)
from comparisons.cli import main
from comparisons.common.errors import ExitStatus, InputError
from comparisons.notebook import scene_of


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("form")
    assert export_form(out) == len(form_cases())
    return out


def filled_in(folder: Path, out: Path, factor: float, uncertainty: str, count: int = 10**6) -> Path:
    """A form whose first answers are the expected values times a factor."""
    with (folder / "form.csv").open() as file:
        rows = list(csv.DictReader(file))
    for row in rows[:count]:
        row |= {"answer": f"{factor * float(row['expected']):.12g}", "uncertainty": uncertainty}
    with out.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    return out


def test_every_figure_has_a_row_and_no_expected_value_is_nothing(folder):
    with (folder / "form.csv").open() as file:
        rows = [
            (row["case"], row["quantity"], float(row["expected"])) for row in csv.DictReader(file)
        ]
    assert len(rows) == len({row[:2] for row in rows}) == sum(len(c.exact) for c in form_cases())
    assert all(value > 0.0 for *_, value in rows)
    assert len({case.name for case in form_cases()}) == len(form_cases()) > 35
    for case in form_cases():
        assert f"`{case.name}`" in (folder / "README.md").read_text()


@pytest.mark.parametrize(
    ("name", "bound"),
    [
        ("hertz-steel-on-steel-friction-0.3", 1e-3),
        ("sliding-rigid-on-steel-friction-0.5", 1e-3),
        *((f"rough-half-plane-{seed}", 2e-3) for seed in (20, 21, 22)),
    ],
)
def test_an_exported_scene_has_its_expected_figures(folder, name, bound):
    """By the half-plane, from the files alone; of a trace, those of the pressures behind it."""
    run = crosscheck.run(folder / f"{name}.toml", "half-plane")
    (case,) = (case for case in form_cases() if case.name == name)
    bounds = {"peak_pressure": bound, "contact_length": bound, "tau1_max": 5 * bound}
    for quantity in bounds.keys() & case.exact:
        figure = run.figure(quantity, "half_plane")
        assert figure.value == pytest.approx(case.exact[quantity], rel=bounds[quantity])


@pytest.mark.parametrize("name", ["rough-hard-coating-2", "layer-bonded-nu-0.3-a-1-t"])
def test_exported_scenes_make_decks(folder, tmp_path, name):
    assert write_deck(scene_of(folder / f"{name}.toml"), "calculix", tmp_path / "deck").nodes


@pytest.mark.parametrize(
    ("factor", "uncertainty", "status", "covered"),
    [
        (1.0, "0.001", ExitStatus.DONE, True),
        (1.005, "", ExitStatus.DONE, False),
        (1.02, "0.005", ExitStatus.OUTSIDE_TOLERANCE, False),
        (1.02, "0.03", ExitStatus.INCONCLUSIVE, True),
    ],
)
def test_a_form_is_judged_as_figures_of_a_run_are(
    folder, tmp_path, factor, uncertainty, status, covered
):
    judged = judged_form(filled_in(folder, tmp_path / "form.csv", factor, uncertainty))
    assert judged.exit_status == status and judged.empty == 0
    assert {is_covered(figure) for figure in judged.figures} == {covered}
    assert [figure.value for figure in judged.figures] == pytest.approx(
        [factor - 1.0] * len(judged.figures), abs=1e-9
    )


def test_the_command_prints_the_sheet(folder, tmp_path, capsys):
    form = filled_in(folder, tmp_path / "form.csv", 1.0001, "0.001", 3)
    assert main(["verify", "--answers", str(form)]) == 0
    printed = capsys.readouterr().out
    assert "3 agree, 0 differ, 0 inconclusive; 3 within their own uncertainty" in printed
    assert "hertz-steel-on-steel" in printed and "1.4e+09 Pa" in printed


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("", "", "no answer"),
        (",,", ",many,", "answer: is many"),
        (",peak_pressure,Pa,1400000000,0.01,", ",peak,Pa,1,0.01,1", "no figure of the form"),
        (",,", ",1,-1", "uncertainty: is -1"),
        ("tolerance", "limit", "no column tolerance"),
        (None, "", "no column"),
    ],
)
def test_what_is_no_form_is_refused(folder, tmp_path, old, new, message):
    """`old` of the form is `new`; without it nothing is left."""
    text = (folder / "form.csv").read_text()
    (tmp_path / "form.csv").write_text("" if old is None else text.replace(old, new, 1))
    with pytest.raises(InputError, match=message):
        judged_form(tmp_path / "form.csv")


@pytest.mark.parametrize(
    "arguments", [["--answers", "none.csv"], ["--answers", "a", "--export", "b"]]
)
def test_the_command_refuses_what_it_cannot_judge(monkeypatch, tmp_path, arguments):
    monkeypatch.chdir(tmp_path)
    assert main(["verify", *arguments]) == ExitStatus.BAD_INPUT
