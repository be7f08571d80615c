"""Places that cannot be meant, and streams that are not there."""

import io
import json
import os
import subprocess
import sys

import pytest
from scenes import PROJECT

from comparisons.commands.output import show_json


@pytest.mark.parametrize(
    "arguments",
    [
        ["run", "smooth", "--out", ""],
        ["run", "smooth", "--out="],
        ["run", "smooth", "--out", " "],
        ["report", ".", "--summary", ""],
        ["verify", "--junit", ""],
    ],
)
def test_an_empty_place_is_not_the_working_folder(folder, complaint, arguments):
    (folder / "result.json").write_text("mine")
    assert "is empty; allowed is a path" in complaint(*arguments)
    assert (folder / "result.json").read_text() == "mine"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["map", "smooth", "--points", "５x５"], "--points: is"),
        (["map", "smooth", "--x", ""], "--x: is ''"),
        (["map", "smooth", "--y", ""], "--y: is ''"),
        (["map", "smooth", "--quantity", ""], "--quantity: there is no "),
        (["map", "smooth", "--mark", ""], "the scene has no name"),
        (["map", "smooth", "--x", "a_over_width=１:2"], "--x: is"),
        (["map", "smooth", "--workers", "²"], "--workers: is '²'"),
        (["sweep", "smooth", "--over", "load=1e5:2e5:３"], "how many values"),
        (["run", "smooth", "--tolerance", "０.1"], "--tolerance: is"),
        (["init", "trace.csv", "--radius", "８"], "--radius: is"),
    ],
)
def test_digits_of_other_scripts_and_empty_words_are_refused(folder, complaint, arguments, said):
    assert said in complaint(*arguments)


@pytest.mark.parametrize(
    "arguments",
    [
        ["run", "{}"],
        ["run", "smooth", "--models", "half-plane", "--out", "{}"],
        ["run", "smooth", "--models", "half-plane", "--junit", "{}"],
        ["init", "{}"],
        ["table", "{}"],
    ],
)
def test_a_name_that_no_file_can_have_is_wrong_input(folder, complaint, arguments):
    said = complaint(*(word.format(5000 * "x") for word in arguments))
    assert "xxxx" in said and len(said) < 1000


def test_a_scene_does_not_replace_its_profile(folder, trace, complaint):
    (folder / "trace.toml").write_text(trace)
    assert "is the profile itself; allowed is another --out" in complaint("init", "trace.toml")
    assert "is the profile itself" in complaint("init", "trace.toml", "--force")


@pytest.mark.skipif(os.name != "posix", reason="a shell closes the stream")
@pytest.mark.parametrize(("closed", "words"), [(">&-", ""), ("2>&-", "smooth-sliding")])
def test_a_closed_stream_is_no_defect(closed, words):
    done = subprocess.run(
        ["sh", "-c", f'"$0" -m comparisons.cli scenes {closed}', sys.executable],
        env={**os.environ, "PYTHONPATH": str(PROJECT)},
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert words in done.stdout


def test_characters_that_the_terminal_lacks_are_shown_otherwise(tmp_path, trace):
    (tmp_path / "trace.csv").write_text("x [µm],z [µm]\n" + trace.partition("\n")[2])
    done = subprocess.run(
        [sys.executable, "-m", "comparisons.cli", "init", "trace.csv"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(PROJECT), "PYTHONIOENCODING": "ascii"},
        capture_output=True,
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert rb'by "x [\xb5m],z [\xb5m]" in the file' in done.stdout


def test_json_is_json_in_every_encoding(monkeypatch):
    bytes_ = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(bytes_, "latin-1", "backslashreplace"))
    show_json({"title": "Ra → µm"})
    sys.stdout.flush()
    assert json.loads(bytes_.getvalue()) == {"title": "Ra → µm"}
