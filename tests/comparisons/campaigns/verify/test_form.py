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
    "name", ["hertz-steel-on-steel-friction-0.3", "sliding-rigid-on-steel-friction-0.5"]
)
def test_an_exported_scene_has_its_expected_figures(folder, name):
    solved_as_expected(folder, name, 1e-3)


@pytest.mark.parametrize("seed", [20, 21, 22])
def test_an_exported_trace_has_the_pressures_that_it_was_made_from(folder, seed):
    solved_as_expected(folder, f"rough-half-plane-{seed}", 2e-3)


def solved_as_expected(folder: Path, name: str, bound: float) -> None:
    """By the half-plane, from the files alone."""
    found = crosscheck.run(folder / f"{name}.toml", "half-plane")
    (case,) = (case for case in form_cases() if case.name == name)
    for quantity in ("peak_pressure", "contact_length"):
        value = found.figure(quantity, "half_plane").value
        assert value == pytest.approx(case.exact[quantity], rel=bound)
    shear = found.figure("tau1_max", "half_plane")
    if "tau1_max" in case.exact and shear is not None:
        assert shear.value == pytest.approx(case.exact["tau1_max"], rel=5 * bound)


def test_exported_scenes_make_decks(folder, tmp_path):
    for number, name in enumerate(("rough-hard-coating-2", "layer-bonded-nu-0.3-a-1-t")):
        assert write_deck(
            scene_of(folder / f"{name}.toml"), "calculix", tmp_path / str(number)
        ).nodes


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


def test_what_is_no_form_is_refused(folder, tmp_path):
    form = (folder / "form.csv").read_text()
    for text, said in (
        (form, "no answer"),
        (form.replace(",,", ",many,", 1), "answer: is many"),
        (
            form.replace("hertz-steel-on-steel,peak_pressure", "hertz,peak", 1).replace(
                ",,", ",1,", 1
            ),
            "no figure of the form",
        ),
        (form.replace(",,", ",1,-1", 1), "uncertainty: is -1"),
        (form.replace("tolerance", "limit", 1), "no column tolerance"),
        ("", "no column"),
    ):
        path = tmp_path / "form.csv"
        path.write_text(text)
        with pytest.raises(InputError, match=said):
            judged_form(path)
    assert main(["verify", "--answers", str(tmp_path / "none.csv")]) == 2
    assert main(["verify", "--answers", "a", "--export", "b"]) == 2
