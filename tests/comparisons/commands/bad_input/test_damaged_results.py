"""Result files that somebody edited or cut: one line and status 2, nothing written or concluded."""

import json
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from comparisons.cli import main
from comparisons.common.progress import no_progress
from comparisons.runs.write import write_files
from comparisons.studies.study import Run

FIRST = ("figures", 0)  # the half-plane's peak pressure


@pytest.fixture(scope="module")
def finished(tmp_path_factory, smooth_outcome: Run) -> Path:
    folder = tmp_path_factory.mktemp("finished") / "run"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("comparisons.output.page.page.render", lambda *_: "before")
        write_files(replace(smooth_outcome, directory=folder), no_progress)
    return folder


@pytest.fixture
def damaged(finished: Path, tmp_path: Path) -> Callable[..., Path]:
    """`damaged(file, value, *keys)`: a run's folder with another value there, None for none."""

    def folder(file: str, value: object, *keys: str | int) -> Path:
        copied = Path(shutil.copytree(finished, tmp_path / "run"))
        whole = json.loads((copied / file).read_text())
        part = whole
        for key in keys[:-1]:
            part = part[key]
        if value is None:
            del part[keys[-1]]
        else:
            part[keys[-1]] = value
        (copied / file).write_text(json.dumps(whole))
        return copied

    return folder


def refused(capsys, *arguments: object) -> str:
    status = main([str(argument) for argument in arguments])
    out, err = capsys.readouterr()
    assert (status, out, err.count("\n")) == (2, "", 1), err
    return err


@pytest.mark.parametrize(
    ("command", "file", "value", "keys", "words"),
    [
        ("report", "result.json", None, ("figures",), "is no result of a run (KeyError"),
        ("report", "result.json", 99, ("schema",), "schema: is 99, of a later crosscheck; allowed"),
        ("report", "result.json", 1, ("schema",), "is 1, of an earlier crosscheck; allowed is 3"),
        ("report", "result.json", [], ("series",), "sums up to nothing"),
        ("rerun", "result.json", float("nan"), (*FIRST, "value"), "is not JSON: NaN is no number"),
        ("table", "result.json", "high", (*FIRST, "value"), "could not convert string to float"),
        ("table", "result.json", 3.0, ("verdict",), "verdict: is 3.0"),
    ],
)
def test_damaged_files_are_refused(damaged, capsys, command, file, value, keys, words):
    folder = damaged(file, value, *keys)
    assert words in refused(capsys, command, folder)
    assert (folder / "report.html").read_text() == "before"


def test_a_table_is_no_folder(finished, tmp_path, capsys):
    place = tmp_path / "rows.csv"
    place.mkdir()
    words = refused(capsys, "table", finished, "--out", place)
    assert "rows.csv: is a folder; allowed is a file" in words
    assert list(place.iterdir()) == []
