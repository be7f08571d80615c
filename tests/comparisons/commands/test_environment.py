"""What a command finds around it: modules in the working folder, variables, strange titles."""

import io
import json
import os
import subprocess
import sys
from contextlib import redirect_stdout

import pytest
from scenes import PROJECT

from comparisons.cli import main
from comparisons.output.result_json import content_of, result_of

pytestmark = pytest.mark.usefixtures("undrawn")  # what runs in this process

MODULES = ("numpy", "signal", "pickle", "threading", "meshes", "analytic", "gmsh", "scipy")
SMALL = """
roller = {radius = 0.01, rigid = true}
body = {youngs_modulus = 210e9, poissons_ratio = 0.3}
load = {hertz_peak_pressure = 1e9}
resolution = {levels = 2}
stress = {points = [12, 6]}
"""
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


def command(*arguments, cwd, **variables):
    environment = os.environ | {"PYTHONPATH": str(PROJECT), "PYTHONSAFEPATH": "1"} | variables
    return subprocess.run(
        [sys.executable, *arguments], cwd=cwd, env=environment, capture_output=True, text=True
    )


def test_no_module_of_the_working_folder_is_run(tmp_path):
    work = tmp_path / "work"
    work.mkdir()
    for name in MODULES:
        (work / f"{name}.py").write_text(f"open({str(tmp_path / name)!r}, 'w')")
    (tmp_path / "program.py").write_text(PROGRAM)
    done = command(tmp_path / "program.py", cwd=work)
    assert done.stdout == "done\n", done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"work", "program.py"}


def test_a_table_gives_nothing_to_obey(tmp_path, smooth_outcome, capsys):
    title = "=1+2\x1b]0;owned\x07\x9b31m"
    result = content_of(result_of(smooth_outcome))
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
    (tmp_path / os.fsdecode(b"sc\xe9ne.toml")).write_text(SMALL)
    scene, out = os.fsdecode(b"sc\xe9ne.toml"), os.fsdecode(b"r\xe9sultats")
    words = ["-m", "comparisons.cli", "run", scene, "--models", "half-plane"]
    done = command(*words, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "results/sc\ufffdne/report.html").exists()
    summary = os.fsdecode(b"\xe9.html")
    monkeypatch.chdir(tmp_path)
    for arguments in (
        ["run", scene, "--models", "half-plane", "--out", out],
        ["rerun", out],
        ["table", out],
        ["report", out, "--summary", summary],
    ):
        # as the command opens its own
        stdout = io.TextIOWrapper(io.BytesIO(), "utf-8", "backslashreplace")
        with redirect_stdout(stdout):
            assert main(arguments) == 0, arguments
    assert b"r%E9sultats/report.html" in (tmp_path / summary).read_bytes()
