"""Cases, rows and files of `verify` and `stability`; published benchmarks, two of them solved."""

import io
import json
import os
from functools import partial
from xml.etree import ElementTree

import numpy as np
import pytest
from rich.console import Console
from scenes import STEEL, changed, resolved

from comparisons.campaigns import benchmarks, robustness
from comparisons.campaigns.cases import (
    ENDED,
    Row,
    Trial,
    answers_of,
    bounded,
    carry_out,
    junit_of,
    order_figure,
    relative_error,
    rows_of,
)
from comparisons.cli import main
from comparisons.common import tasks
from comparisons.common.errors import ExitStatus
from comparisons.common.progress import no_progress
from comparisons.figures.figure import Figure
from comparisons.scenes.files import benchmark_names, scene_names
from comparisons.scenes.scene import Scene


def figure(value: float, high: float = 1.0, low: float = 0.0) -> Figure:
    return bounded("error", value, high, "the exact one", low, "a note")


def case(*figures: Figure, name: str = "made") -> Trial:
    return Trial("tests", name, "half_plane", partial(tuple, figures))


def failing() -> None:
    raise ArithmeticError("no\nsolution [bold]")


RAISES = Trial("tests", "raises", "finite_element", failing)


def row(*figures: Figure) -> Row:
    [row] = rows_of([case(*figures)])
    return row


@pytest.mark.parametrize(
    ("value", "high", "low", "holds"),
    [
        (1.0, 1.0, 0.0, True),
        (1.1, 1.0, 0.0, False),
        (np.nan, 1.0, 0.0, False),
        (np.inf, np.inf, 0.0, False),
        (0.5, 1.0, 0.6, False),
        (-0.1, 1.0, 0.0, False),
    ],
)
def test_a_case_holds_within_the_bounds_of_its_figure(value, high, low, holds):
    assert row(figure(value, high, low)).holds is holds


def test_orders_and_errors_count_on_both_sides():
    held = [row(order_figure("", order, 2.0, 0.25, "")).holds for order in (1.7, 1.8, 2.2, 2.3)]
    assert held == [False, True, True, False]
    assert relative_error("", 0.75, 1.0, 1.0, "").value == 0.25


def test_a_row_without_a_figure_fails_and_says_why():
    assert not row().holds and row().faults == ["half_plane, tests, made: no figures"]


def test_a_case_that_ends_its_process_is_a_row(monkeypatch):
    monkeypatch.setattr(tasks, "cores", lambda: 2)
    for worth in ("WORTH_A_FORK", "WORTH_A_START"):
        monkeypatch.setattr(tasks, worth, 0.0)
    deadly = Trial("tests", "deadly", "half_plane", partial(os._exit, 3))
    assert [row.fault for row in rows_of([deadly, case(figure(0.5))])] == [ENDED, None]


def test_what_is_kept_of_a_stopped_command_is_not_computed_again(tmp_path):
    good = case(figure(0.5))
    (first,) = rows_of([good], kept=answers_of(tmp_path, "verify", [good]))
    again = Trial(good.group, good.name, good.model, failing)
    (row,) = rows_of([again], kept=answers_of(tmp_path, "verify", [again]))
    assert row.figures == first.figures and row.holds
    assert answers_of(tmp_path, "verify", [good, RAISES]).load("1") is None  # of other cases


@pytest.fixture
def written(tmp_path):
    """A campaign of three rows, its folder and what was announced."""
    (tmp_path / "result.json").write_text("a run's own")
    announced = []
    cases = case(figure(np.inf)), RAISES, case(figure(0.1), name="good")
    junit = tmp_path / "ci" / "rows.xml"
    return carry_out("stability", cases, tmp_path, junit, announced.append), tmp_path, announced


def test_one_bad_row_does_not_end_the_others_and_the_table_shows_all(written):
    campaign, _, announced = written
    assert campaign.exit_status == ExitStatus.OUTSIDE_TOLERANCE
    assert [row.holds for row in campaign.rows] == [False, False, True]
    assert announced[-1] == "3 of 3, 2 failed: half_plane: tests: good"
    console = Console(width=160, file=io.StringIO())
    console.print(campaign.tables())
    text = console.file.getvalue()
    assert "1 of 3 cases hold" in text and "[bold]" in text and "DOES NOT HOLD" in text


def test_json_holds_all_rows_beside_the_other_files_of_the_folder(written):
    campaign, folder, _ = written
    content = json.loads((folder / "stability.json").read_text())
    assert (content["passed"], content["failed"], content["holds"]) == (1, 2, False)
    assert content["faults"] == campaign.faults
    infinite, raised, good = content["rows"]
    assert infinite["figures"][0]["value"] is None
    assert raised["error"] == "ArithmeticError: no solution [bold]"
    bounds = {"value": 0.1, "high": 1.0, "low": 0.0, "reference": "the exact one"}
    assert good["figures"] == [{"name": "error", **bounds, "holds": True}]
    names = sorted(path.name for path in folder.iterdir())
    assert names == ["ci", "result.json", "stability.json"]


def test_junit_has_a_testcase_for_each_figure_and_error(written):
    campaign, folder, _ = written
    text = (folder / "ci" / "rows.xml").read_text()
    assert text == junit_of(campaign)
    [suite] = ElementTree.fromstring(text.encode())
    assert (suite.get("tests"), suite.get("failures")) == ("3", "2")
    first, raised, good = suite
    assert first.get("classname") == "stability.half_plane"
    assert first.get("name") == "tests: made: error"
    assert "inf, expected at most 1" in first.find("failure").get("message")
    assert "ArithmeticError" in raised.find("failure").get("message")
    assert good.find("system-out").text == "0.1, expected at most 1 (the exact one); a note"


def test_no_rows_are_no_success(tmp_path):
    empty = carry_out("stability", (), tmp_path, None, no_progress)
    assert empty.exit_status == ExitStatus.OUTSIDE_TOLERANCE


@pytest.mark.parametrize(("value", "status"), [(0.5, 0), (2.0, 1)])
def test_the_command_ends_with_what_the_rows_say(tmp_path, monkeypatch, capsys, value, status):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(robustness, "all_cases", lambda: [case(figure(value))])
    assert main(["stability", "--junit", "ci.xml"]) == status
    out, err = capsys.readouterr()
    assert f"{1 - status} of 1 cases hold" in out and err == ""
    assert (tmp_path / "ci.xml").is_file()
    assert main(["stability", "--json"]) == status
    shown = capsys.readouterr().out
    written = (tmp_path / "results" / "stability" / "stability.json").read_text()
    assert json.loads(shown) == json.loads(written)


def test_each_case_has_a_name_of_its_own_and_both_models_have_many():
    cases = robustness.all_cases()
    names = [(case.model, case.group, case.name) for case in cases]
    assert len(set(names)) == len(names) >= 74
    assert sum(case.model == "finite_element" for case in cases) >= 33


STATED = {"quantity": "peak_pressure", "value": "9.351 MPa", "source": "a manual"}
PLAIN = {
    "roller": {"radius": 4e-3, **STEEL},
    "body": STEEL,
    "load": {"per_length": 1e4},
    "published": {"p0": STATED},
}


def carried_out(out):
    how = out, None, no_progress, benchmarks.Benchmarks
    return carry_out("benchmarks", benchmarks.cases(), *how)


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(benchmarks, "benchmark_names", lambda: ["vm191", "vm272"])
        return carried_out(tmp_path_factory.mktemp("benchmarks"))


def test_published_figures_agree_but_for_the_doubtful_one(solved):
    assert solved.holds and [row.case.name for row in solved.rows] == ["vm191", "vm272"]
    verdicts = {
        f"{name} {row[0]}": row[6] for name, rows in solved.published.items() for row in rows
    }
    assert verdicts == {
        "vm191 target, 2b": "agree",
        "vm191 Mechanical APDL, 2b": "differ, doubtful",
        "vm272 2a": "agree",
        "vm272 p0": "agree",
        "vm272 stick, 2c": "agree",
    }


def test_both_models_are_shown_in_the_published_unit(solved):
    [_, peak, stick] = solved.published["vm272"]
    assert peak[1] == "9.351 MPa"
    for texts, size, unit in ((peak[2:4], 9.351, "MPa"), (stick[2:4], 0.9930, "mm")):
        for text in texts:
            assert text.split()[1] == unit
            assert float(text.split()[0]) == pytest.approx(size, rel=2e-3)


def test_a_figure_beyond_its_scatter_differs(tmp_path, monkeypatch):
    scene = Scene.read("vm272").changed({"published.p0.value": "9.400 MPa"})
    monkeypatch.setattr(Scene, "read", lambda name: scene)
    monkeypatch.setattr(benchmarks, "benchmark_names", lambda: ["vm272"])
    campaign = carried_out(tmp_path)
    assert not campaign.holds and "p0" in str(campaign.published)


def test_every_benchmark_says_what_is_published_and_where():
    names = benchmark_names()
    assert len(names) >= 10 and not set(names) & set(scene_names())
    for name in names:
        scene = Scene.read(name)
        assert scene.published and scene.title
        assert Scene.of(scene.tables).tables == scene.tables  # what a record repeats
        for section in scene.published.values():
            assert section.size > 0.0 and 0.0 < section.spread < 0.2 and len(section.source) > 20


def test_they_are_listed(capsys):
    assert main(["scenes", "--benchmarks", "--json"]) == 0
    assert list(json.loads(capsys.readouterr().out)) == benchmark_names()


@pytest.mark.parametrize(("value", "spread"), [("9.351 MPa", 5e-4 / 9.351), ("30 mm", 0.5 / 30)])
def test_scatter_is_at_least_that_of_the_digits(value, spread):
    quantity = "peak_pressure" if "Pa" in value else "contact_length"
    stated = STATED | {"value": value, "quantity": quantity}
    scene = resolved(changed(PLAIN, published={"p0": stated}))
    assert scene.published["p0"].spread == pytest.approx(spread)
