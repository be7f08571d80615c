"""A picture or a table that fails costs itself alone: no figure, and nothing else of the page."""

import re
from dataclasses import replace

import pytest

from comparisons.cli import main
from comparisons.common.errors import ExitStatus
from comparisons.drawing import blocks, style
from comparisons.output.page import page
from comparisons.output.page.tables import verification

RUN = ["run", "smooth", "--models", "half-plane", "--out", "out"]
FILES = {"half_plane", "result.json", "run.npz"}
# of the figures alone, without time and folder
FIGURES = re.compile(r'"figures": .*?"series"', re.DOTALL)


def fails(*_: object, **__: object) -> None:
    raise ZeroDivisionError("no *size*")


@pytest.fixture(autouse=True)
def as_it_runs(tmp_path, monkeypatch, unpainted):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(page, "attempted", blocks.attempted)


def test_it_is_named_in_its_place_and_all_else_is_there(tmp_path, monkeypatch, capsys, page_of):
    assert main(RUN) == 0
    before = FIGURES.search((tmp_path / "out/result.json").read_text())[0]
    images = len(page_of((tmp_path / "out/report.html").read_text()).images)
    assert capsys.readouterr().err.count("\n") == 0
    for name in ("overview", "fields"):
        monkeypatch.setitem(page.PICTURES, name, fails)
    monkeypatch.setattr(verification, "record_rows", fails)
    [yielding] = [study for study in page.STUDIES if study.name == "yield"]
    [problem] = [study for study in page.STUDIES if study.name == "problem"]
    failing = replace(yielding, caption=fails), replace(problem, blocks=fails)
    others = (study for study in page.STUDIES if study is not yielding)
    monkeypatch.setattr(page, "STUDIES", (*others, *failing))
    assert main(RUN) == 0
    out, err = capsys.readouterr()
    assert "out/report.html" in out
    lost = "overview", "fields", "problem", "yield", "record"
    why = "ZeroDivisionError: no *size* in test_lost_pictures.py, line "
    said = err.splitlines()
    for line, name in zip(said, sorted(lost, key=err.index), strict=True):
        assert line.startswith(f"crosscheck: {name} is not shown: {why}")
    again = page_of((tmp_path / "out/report.html").read_text())
    assert len(again.images) == images - 3  # two components of the field
    for name in lost:
        assert f"{name.capitalize()} is not shown: ZeroDivisionError" in again.text
    assert FIGURES.search((tmp_path / "out/result.json").read_text())[0] == before
    assert {path.name for path in tmp_path.iterdir()} == {"out"}


def test_a_page_that_fails_costs_no_more_than_the_page(tmp_path, monkeypatch, capsys, undrawn):
    assert main(RUN) == 0
    with monkeypatch.context() as patch:
        patch.setattr(page, "rendered", fails)
        assert main([*RUN, "--pdf"]) == 0
    out, err = capsys.readouterr()
    assert err.startswith("crosscheck: report is not shown: ZeroDivisionError")
    assert err.count("\n") == 1
    assert out.endswith("written: out/result.json and the fields beside it\n")
    # nor does it leave the page of another run
    assert {path.name for path in (tmp_path / "out").iterdir()} == FILES
    monkeypatch.setenv("CROSSCHECK_TRACEBACK", "1")
    monkeypatch.setattr(page, "rendered", fails)
    assert main(RUN) == ExitStatus.DEFECT
    assert "in fails\n" in capsys.readouterr().err


def test_pictures_of_campaigns_are_left_out(monkeypatch, capsys):
    drawn = style.svgs({"sweep.svg": fails, "zone.svg": lambda: style.figure(1.0, 1.0)})
    assert list(drawn) == ["zone.svg"]
    assert capsys.readouterr().err.startswith("crosscheck: sweep.svg is not shown: Zero")
