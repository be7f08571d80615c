"""Wrong input, alone and together, is answered by one line with what is allowed;
what is nearly right, by what to type."""

import io
import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from scenes import python

from comparisons.cli import main
from comparisons.commands.output import show_json
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of

GOOD = {
    "roller.radius": '"8.2 mm"',
    "roller.youngs_modulus": '"207 GPa"',
    "roller.poissons_ratio": "0.3",
    "body.youngs_modulus": '"207 GPa"',
    "body.poissons_ratio": "0.3",
    "load.per_length": '"3.85 N/um"',
}
# What a measured profile's file may hold.
TRACE = "x,height\n" + "".join(f"{i},{(i * 7) % 5 / 10}\n" for i in range(40))


def toml(changes: dict) -> str:
    """GOOD with the changes, as a scene file."""
    return "\n".join(f"{name} = {text}" for name, text in {**GOOD, **changes}.items())


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """The working folder of a run that must never begin to solve, with a scene in it."""
    solve_scene = "comparisons.runs.run.solve_scene"
    monkeypatch.setattr(solve_scene, lambda *_: pytest.fail("a wrong scene was solved"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text(toml({}))
    return tmp_path


MISSPELT = ("mine.tml", "mine", "mne.toml")
PLACES = (["run", "smooth", "--out"], ["report", ".", "--summary"], ["verify", "--junit"])
FILES = {
    "empty": (b"", "scene.toml: is empty; allowed are sections"),
    "binary": (b"[roller]\n\x80\x81\xff", "is not text (byte 9 is not UTF-8); allowed is a TOML"),
    "not TOML": (b"[roller]\nradius = 8.2 mm\n", "line 2, column"),
    "field twice": (b"[roller]\nradius = 1\nradius = 2\n", "field is given twice (at line 3,"),
    "a profile": (b"x_um,height_um\n0,0.0\n1,1.4\n", "is not TOML: "),
    "nested deep": (b"a = " + b"[" * 5000 + b"]" * 5000, "is beyond what TOML may hold"),
    "a wrong field": (b"roller.raduis = 1\n", "roller.raduis: is no known field; the nearest is"),
    "large": (b"# " + b"a" * 2**20, "allowed are 1048576 for a scene"),
}


@pytest.mark.parametrize(("content", "fragment"), FILES.values(), ids=FILES)
def test_wrong_file(folder, content, fragment, complaint):
    (folder / "scene.toml").write_bytes(content)
    assert fragment in complaint("run", "scene.toml", "--json")


UNITS = 'crosscheck: --units: is "{}"; allowed is a unit of length and one of stress'
COUNTS = ("3", "1x3", "3x201", "x", "3x-2")
AXES = [
    ("", "is ''"),
    ("a_over_width=１:2", "is"),
    ("a_over_thicknes", "there is no group a_over_thicknes; the nearest is a_over_th"),
    ("rms_slope=0.2:0.1", "the range is 0.2:0.1"),
    ("rms_slope=a:b", "is 'rms_slope=a:b'; allowed is GROUP"),
    ("rms_slope=0:1", "the range is 0:1; allowed are two numbers above 0"),
    ("rms_slope=1", "is 'rms_slope=1'"),
]
MARKS = [
    ("smooth", "", "the scene has no name"),
    ("modulus-coating", "smooth", "smooth has no coating_modulus_ratio to be mark"),
    ("slope-wavelength", "smooth", "smooth is smooth, and the map is of a rough"),
    ("smooth", "periodic", "periodic is rough, and the map is of a smooth surface"),
    ("curvature-thickness", "smooth", "smooth lies off the map: its a/t is 0; allowed is 0.05 to"),
]
SWEEPS = [
    ("position", 'is "position"; allowed is FIELD=A,B,C'),
    ("load=1 GPa:2 GPa", "allowed is FIELD=A,B,C or FIELD=FROM:TO:N"),
    ("load=1 GPa:2 MPa:3", "two numbers of one unit"),
    ("load=1:2:0", "how many values, from 2"),
    ("load=1e5:2e5:３", "how many values"),
    ("position=1", "allowed are from 2 to"),
    ("amplitude=3", "the nearest is profile.amplitude"),
    ("load.position=0:1:100000", "from 2 to 10000"),
]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ["run", "smoth"],
            "smoth: is neither a file nor a scene; the nearest scene is smooth, all are",
        ),
        (["rnu"], "No such command 'rnu'"),
        (["run"], "Missing argument"),
        (["run", "smooth", "--moddels", "half-plane"], "No such option: --moddels"),
        (["run", "smooth", "smooth"], "unexpected extra argument"),
        (["run", "smooth", "--models", "fem"], "no model fem; the nearest is finite-element; all"),
        (["run", "smooth", "--models", ","], "models: is empty; allowed are half-plane, finite-"),
        (["run", "smooth", "--out", "/dev/null/there"], "/dev/null is not a folder"),
        (["run", "absent.toml"], "absent.toml: there is no such file"),
        (["run", "/dev/null"], "is not a regular file; allowed is a TOML file"),
        (["run", ""], "allowed is a scene's file or name"),
        *((["run", name], "there is no such file, but mine.toml; allowed") for name in MISSPELT),
        *(([*words, ""], "is empty; allowed is a path") for words in PLACES),
        (["run", "smooth", "--out="], "is empty; allowed is a path"),
        (["run", "smooth", "--out", " "], "is empty; allowed is a path"),
        *((["map", "smooth", "--points", n], "--points: is") for n in ("５x５", *COUNTS)),
        *((["map", "smooth", "--x", axis], f"--x: {said}") for axis, said in AXES),
        (["map", "smooth", "--y", ""], "--y: is ''"),
        (["map", "smooth", "--x", "rms_slope", "--y", "rms_slope"], "--y: is rms_slope, as --x"),
        (["map", "smooth", "--quantity", ""], "--quantity: there is no "),
        (["map", "smooth", "--quantity", "peak"], "--quantity: there is no peak"),
        (["map", "curvature-thickness", "--quantity", "mean_gap"], "mean_gap is not on this"),
        *((["map", name, "--mark", scene], said) for name, scene, said in MARKS),
        (["map", "smooth", "--workers", "²"], "--workers: is '²'"),
        (["sweep", "sinusoid"], "--over: is missing"),
        *((["sweep", "sinusoid", "--over", over], said) for over, said in SWEEPS),
        (["sweep", "smooth", "--over", "position=4"], "a smooth scene is the same everywhere"),
        (["run", "smooth", "--tolerance", "０.1"], 'tolerance.peak_pressure: is "０.1", which'),
        *(
            (["run", "mine.toml", "--tolerance", wrong], f"tolerance.peak_pressure: is {said}")
            for wrong, said in (("5", "5; allow"), ("x", '"x"'), ("500%", '"500%"'), ("nan", "nan"))
        ),
        (["run", "smooth", "--answer", "nothing"], "--answer: is"),
        (["run", "smooth", "--units", "mm,MPa"], "--units: is given without --answer"),
        *(
            (["run", "smooth", "--answer", "one=a.csv", "--units", units], UNITS.format(units))
            for units in ("mm,kg", "mm,um", "", "mm,MPaa")
        ),
        (["init", "trace.csv", "--radius", "８"], "--radius: is"),
        (["init", "."], ".: is a directory; a profile is a file"),
        (["run", "mine.toml", "--plan", "--json"], "run: allowed is one of --plan, --json"),
        (["table", ".", "--csv", "--json"], "table: allowed is one of --csv, --json"),
        (["table", "."], "is no result of a run"),
        (["table", "empty"], "holds no run"),
        (["table", "nowhere"], "nowhere"),
        (["cost", "smoth"], "the nearest scene is smooth"),
        (["cost", "smooth", "--out", "/dev/null/there"], "/dev/null is not a folder"),
        *(([word, "--out", "mine.toml"], "is not a folder") for word in ("stability", "verify")),
        *(([word, "--junit", "."], "allowed is a file") for word in ("stability", "verify")),
        (["deck", "mine.toml", "--for", "ansys"], "'--for': 'ansys' is not one of 'calculix', "),
    ],
)
def test_what_no_command_can_do_is_refused(folder, complaint, arguments, said):
    (folder / "result.json").write_text('{"schema": 3, "scene": {}}')
    (folder / "empty").mkdir()
    (folder / "a.csv").write_text("x,p\n")
    assert said in complaint(*arguments)


def test_control_characters_of_a_name_are_shown_harmless(folder, complaint):
    line = complaint("run", "\x1b[31m.toml")
    assert "\x1b" not in line and r"\x1b[31m.toml" in line


def test_characters_that_the_terminal_lacks_are_shown_otherwise(tmp_path):
    (tmp_path / "trace.csv").write_text("x [µm],z [µm]\n" + TRACE.partition("\n")[2])
    asked = "-m", "comparisons.cli", "init", "trace.csv"
    done = python(*asked, cwd=tmp_path, PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr) == (0, "")
    assert r'by "x [\xb5m],z [\xb5m]" in the file' in done.stdout


def test_json_is_json_in_every_encoding(monkeypatch):
    bytes_ = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(bytes_, "latin-1", "backslashreplace"))
    show_json({"title": "Ra → µm"})
    sys.stdout.flush()
    assert json.loads(bytes_.getvalue()) == {"title": "Ra → µm"}


@pytest.mark.parametrize("content", [b"x,z\n0,1\n1,2\n", b"\xff\xfe\x00", b"0,1\n" * 300_000])
def test_a_trace_in_the_place_of_a_scene_is_told_init(folder, complaint, content):
    (folder / "my trace.txt").write_bytes(content)
    said = complaint("run", "my trace.txt")
    assert "is no scene; of a measured trace `crosscheck init 'my trace.txt'` makes one" in said


def test_a_tolerance_may_be_a_percentage(tmp_path, monkeypatch, capsys, undrawn):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text(toml({"tolerance.peak_pressure": "0.5"}))
    assert main(["run", "mine.toml", "--models", "half-plane", "--json", "--tolerance", "5%"]) == 0
    assert '"peak_pressure": 0.05' in capsys.readouterr().out


def test_a_plan_says_levels_and_seconds_and_solves_nothing(folder, capsys):
    (folder / "mine.toml").write_text(toml({"load.per_length": '"0.5 N/um"'}))
    assert main(["run", "mine.toml", "--plan"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("planned: about ") and " s on " in out and "\n3 levels (" in out
    assert "skipped: coupling: there is no friction" in out
    assert [path.name for path in folder.iterdir()] == ["mine.toml"]


def test_units_come_from_a_header_that_names_them(folder, complaint):
    rows = "".join(f"{0.5 * k},{0.2 * math.sin(0.1 * k)}\n" for k in range(2000))
    (folder / "mine.toml").write_text(toml({"profile.file": '"trace.csv"'}))
    (folder / "trace.csv").write_text("x [um],z [nm]\n" + rows)
    profile = surface_of(Scene.read("mine.toml")).profile
    assert np.ptp(profile.x) == pytest.approx(999.5e-6)
    assert np.ptp(profile.height) == pytest.approx(0.4e-9, rel=0.05)
    (folder / "trace.csv").write_text("position,height\n" + rows)
    assert "profile.x_unit: is missing; allowed is" in complaint("run", "mine.toml")
