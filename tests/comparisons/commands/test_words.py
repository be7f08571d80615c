"""What is nearly right at the door is answered by what to type."""

import math
from pathlib import Path

import numpy as np
import pytest

from comparisons.cli import main
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of

SCENE = """
roller = {radius = "8 mm", youngs_modulus = "207 GPa", poissons_ratio = 0.3}
body = {youngs_modulus = "207 GPa", poissons_ratio = 0.3}
load = {per_length = "0.5 N/um"}
"""


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text(SCENE)
    return tmp_path


def answered(capsys, *arguments: str) -> str:
    """The one line that refuses a command."""
    assert main(list(arguments)) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1
    return err


@pytest.mark.parametrize("content", [b"x,z\n0,1\n1,2\n", b"\xff\xfe\x00", b"0,1\n" * 300_000])
def test_a_trace_in_the_place_of_a_scene_is_told_init(folder, capsys, content):
    (folder / "my trace.txt").write_bytes(content)
    said = answered(capsys, "run", "my trace.txt")
    assert "is no scene; of a measured trace `crosscheck init 'my trace.txt'` makes one" in said


@pytest.mark.parametrize("name", ["mine.tml", "mine", "mne.toml"])
def test_a_misspelt_scene_beside_one_is_told_its_name(folder, capsys, name):
    assert "there is no such file, but mine.toml; allowed" in answered(capsys, "run", name)


def test_a_tolerance_may_be_a_percentage(folder, capsys, undrawn):
    (folder / "mine.toml").write_text(f"{SCENE}tolerance = {{peak_pressure = 0.5}}\n")
    run = ["run", "mine.toml", "--models", "half-plane", "--json", "--tolerance"]
    assert main([*run, "5%"]) == 0
    assert '"peak_pressure": 0.05' in capsys.readouterr().out
    for wrong in ("5", "x", "500%", "nan"):
        assert f"--tolerance: is {wrong}; allowed is a number" in answered(capsys, *run, wrong)


def test_a_plan_says_levels_and_seconds_and_solves_nothing(folder, capsys):
    assert main(["run", "mine.toml", "--plan"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("planned: about ") and " s on " in out and "\n3 levels (" in out
    assert "skipped: coupling: there is no friction" in out
    assert [path.name for path in folder.iterdir()] == ["mine.toml"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["run", "mine.toml", "--plan", "--json"], "run: allowed is one of --plan, --json"),
        (["table", ".", "--csv", "--json"], "table: allowed is one of --csv, --json"),
        (["deck", "mine.toml", "--for", "ansys"], "'--for': 'ansys' is not one of 'calculix', "),
        (["init", "."], ".: is a directory; a profile is a file"),
    ],
)
def test_what_no_command_can_do_is_refused(folder, capsys, arguments, said):
    assert said in answered(capsys, *arguments)
    assert [path.name for path in folder.iterdir()] == ["mine.toml"]


def test_units_come_from_a_header_that_names_them(folder, capsys):
    rows = "".join(f"{0.5 * k},{0.2 * math.sin(0.1 * k)}\n" for k in range(2000))
    (folder / "mine.toml").write_text(SCENE + 'profile = {file = "trace.csv"}\n')
    (folder / "trace.csv").write_text("x [um],z [nm]\n" + rows)
    profile = surface_of(Scene.read("mine.toml")).profile
    assert np.ptp(profile.x) == pytest.approx(999.5e-6)
    assert np.ptp(profile.height) == pytest.approx(0.4e-9, rel=0.05)
    (folder / "trace.csv").write_text("position,height\n" + rows)
    assert "profile.x_unit: is missing; allowed is" in answered(capsys, "run", "mine.toml")
