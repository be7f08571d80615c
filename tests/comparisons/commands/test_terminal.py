"""Surroundings of a command: a terminal or a pipe, modules in the working folder, variables,
strange titles; and what a shell may complete."""

import io
import json
import os
import pty
import re
import subprocess
import sys
from contextlib import redirect_stdout, suppress
from pathlib import Path

import pytest
from scenes import PROJECT, STEADY, as_toml, python

from comparisons.cli import app, main
from comparisons.commands import arguments
from comparisons.output.result import result_of
from comparisons.scenes.files import scene_names

pytestmark = pytest.mark.usefixtures("undrawn")  # what runs in this process
COMMAND = """
import sys
import comparisons.output.page.page
comparisons.output.page.page.render = lambda *_: ""
from comparisons.cli import main
sys.exit(main(["run", "scene.toml", "--models", "half-plane"]))
"""


def environment(**more: str) -> dict[str, str]:
    plain = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "FORCE_COLOR")}
    return plain | {"PYTHONPATH": str(PROJECT), "TERM": "xterm-256color", "COLUMNS": "90"} | more


def in_terminal(folder: Path, **more: str) -> str:
    """Text of a run where both its outputs go to a terminal."""
    ours, theirs = pty.openpty()
    command = [sys.executable, "-c", COMMAND]
    said = b""
    with subprocess.Popen(
        command, cwd=folder, env=environment(**more), stdout=theirs, stderr=theirs
    ) as process:
        os.close(theirs)
        with suppress(OSError):  # the last writer has gone
            while piece := os.read(ours, 65536):
                said += piece
    os.close(ours)
    assert process.returncode == 0, said
    return said.decode()


def in_pipe(*command: str, folder: Path, **more: str) -> str:
    """Text of a run where both its outputs are piped: nothing to standard error."""
    done = python(*command, cwd=folder, env=environment(**more))
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


@pytest.fixture
def folder(tmp_path) -> Path:
    (tmp_path / "scene.toml").write_text(as_toml(STEADY))
    return tmp_path


def coloured(said: str) -> bool:
    """True where a colour is set; bold and moves of the cursor are none."""
    codes = ";".join(re.findall(r"\x1b\[([\d;]*)m", said)).split(";")
    return any(code in ("38", "48") or re.fullmatch("[349][0-7]", code) for code in codes)


@pytest.mark.parametrize("more", [{}, {"NO_COLOR": "1"}])
def test_a_terminal_gets_progress_and_colours_unless_it_wants_none(folder, more):
    said = in_terminal(folder, **more)
    assert coloured(said) != bool(more)
    assert "half-plane: contact, level 1" in said and "peak pressure" in said


@pytest.mark.parametrize("more", [{}, {"FORCE_COLOR": "1"}])
def test_a_pipe_gets_neither(folder, more):
    said = in_pipe("-c", COMMAND, folder=folder, **more)
    assert "\x1b" not in said and "peak pressure" in said


def answer(line: str) -> list[str]:
    """Words that the shell is told the last one of a line may become."""
    asked = {"COMP_WORDS": line, "COMP_CWORD": str(line.count(" "))}
    asked["_CROSSCHECK_COMPLETE"] = "complete_bash"
    return in_pipe("-m", "comparisons.cli", folder=PROJECT, **asked).split()


def test_scenes_are_completed(tmp_path, monkeypatch):
    shown = [p for p in sorted(PROJECT.glob("[!.]*")) if p.is_dir() or p.suffix == ".toml"]
    beside = [f"{path.name}{'/' * path.is_dir()}" for path in shown]
    assert answer("crosscheck run ") == [*scene_names(), *beside]
    assert arguments.complete_scenes("smooth") == ["smooth", "smooth-sliding"]
    (tmp_path / "mine.toml").touch()
    (tmp_path / "mine.csv").touch()
    assert answer(f"crosscheck run {tmp_path}/m") == [f"{tmp_path}/mine.toml"]


def test_commands_groups_and_models_are_completed():
    assert answer("crosscheck sta") == ["stability"]
    assert answer("crosscheck map smooth --x friction") == ["friction_dundurs"]
    assert arguments.complete_maps("curv") == ["curvature-thickness"]
    assert arguments.complete_models("half") == ["half-plane", "half-plane,finite-element"]
    assert arguments.complete_quantities("tau1") == ["tau1_max", "tau1_max_depth"]


def test_every_command_has_json():
    from typer.main import get_command

    without = {
        name
        for name, command in get_command(app).commands.items()
        if not any("--json" in option.opts for option in command.params)
    }
    assert without == set()


MODULES = ("numpy", "signal", "pickle", "threading", "meshes", "analytic", "gmsh", "scipy")
# The mesher and a process beside, as a run starts them.
PROGRAM = """
import numpy as np
from comparisons.common.processes import ProcessWorker
from comparisons.common.tasks import Tasks, called
from meshes.block import BlockSpec
from meshes.build import build_block

if __name__ == "__main__":
    build_block(BlockSpec(1.0, 1.0, np.array([[-0.5, 0.5]]), 0.25))
    with Tasks(ProcessWorker) as tasks:
        tasks.add("length", called, len, "abc")
        print("done" if tasks.result("length") == 3 else "")
"""


def test_no_module_of_the_working_folder_is_run(tmp_path):
    work = tmp_path / "work"
    work.mkdir()
    for name in MODULES:
        (work / f"{name}.py").write_text(f"open({str(tmp_path / name)!r}, 'w')")
    (tmp_path / "program.py").write_text(PROGRAM)
    done = python(tmp_path / "program.py", cwd=work, PYTHONSAFEPATH="1")
    assert done.stdout == "done\n", done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"work", "program.py"}


def test_a_table_gives_nothing_to_obey(tmp_path, smooth_outcome, capsys):
    title = "=1+2\x1b]0;owned\x07\x9b31m"
    result = result_of(smooth_outcome).result
    result = result | {"scene": result["scene"] | {"title": title}}
    (tmp_path / "result.json").write_text(json.dumps(result))
    texts = []
    for option in ((), ("--csv",), ("--json",)):
        assert main(["table", str(tmp_path), *option]) == 0
        texts.append(capsys.readouterr().out)
    _, printed, as_json = texts
    for text in texts:
        assert all(c.isprintable() or c == "\n" for c in text)
    assert "'=1+2\\x1b]0;owned" in printed
    assert json.loads(as_json)[0]["title"] == title


def test_a_scene_need_not_be_named_in_utf_8(tmp_path, monkeypatch):
    (tmp_path / os.fsdecode(b"sc\xe9ne.toml")).write_text(as_toml(STEADY | {"stress": None}))
    scene, out = os.fsdecode(b"sc\xe9ne.toml"), os.fsdecode(b"r\xe9sultats")
    words = ["-m", "comparisons.cli", "run", scene, "--models", "half-plane"]
    done = python(*words, cwd=tmp_path, PYTHONSAFEPATH="1")
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "results/sc\ufffdne/report.html").exists()
    summary = os.fsdecode(b"\xe9.html")
    monkeypatch.chdir(tmp_path)
    for words in (
        ["run", scene, "--models", "half-plane", "--out", out],
        ["rerun", out],
        ["table", out],
        ["report", out, "--summary", summary],
    ):
        # as the command opens its own
        stdout = io.TextIOWrapper(io.BytesIO(), "utf-8", "backslashreplace")
        with redirect_stdout(stdout):
            assert main(words) == 0, words
    assert b"r%E9sultats/report.html" in (tmp_path / summary).read_bytes()
