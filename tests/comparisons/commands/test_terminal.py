"""What a terminal gets and a pipe does not: colour, progress; and what a shell may complete."""

import os
import pty
import re
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest
from scenes import PROJECT

from comparisons.cli import app
from comparisons.commands import arguments
from comparisons.scenes.files import scene_names

SCENE = """
title = "Seen"
roller = {radius = "8 mm", youngs_modulus = "210 GPa", poissons_ratio = 0.3}
body = {youngs_modulus = "210 GPa", poissons_ratio = 0.3}
load = {per_length = "1 N/um"}
"""
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
    """What a run says where both its outputs go to a terminal."""
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
    """What it says where both its outputs are piped: nothing to standard error."""
    done = subprocess.run(
        [sys.executable, *command], cwd=folder, env=environment(**more), capture_output=True,
        text=True, check=True
    )  # fmt: skip
    assert done.stderr == ""
    return done.stdout


@pytest.fixture
def folder(tmp_path) -> Path:
    (tmp_path / "scene.toml").write_text(SCENE)
    return tmp_path


def coloured(said: str) -> bool:
    """Whether a colour is set; bold and moves of the cursor are none."""
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
    """What the shell is told that the last word of a line may become."""
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
