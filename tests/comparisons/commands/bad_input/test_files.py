"""Scenes and profiles that cannot be read: one line that names the file and the place."""

import os
import subprocess
import sys

import pytest
from scenes import PROJECT

MEASURED = {"profile.file": '"trace.csv"', "profile.x_unit": '"um"', "profile.z_unit": '"um"'}

FILES = {
    "empty": (b"", "scene.toml: is empty; allowed are sections"),
    "binary": (b"[roller]\n\x80\x81\xff", "is not text (byte 9 is not UTF-8); allowed is a TOML"),
    "not TOML": (b"[roller]\nradius = 8.2 mm\n", "line 2, column"),
    "field twice": (b"[roller]\nradius = 1\nradius = 2\n", "field is given twice (at line 3,"),
    "a profile": (b"x_um,height_um\n0,0.0\n1,1.4\n", "is not TOML: "),
    "nested deep": (b"a = " + b"[" * 5000 + b"]" * 5000, "is beyond what TOML may hold"),
    "large": (b"# " + b"a" * 2**20, "allowed are 1048576 for a scene"),
}


@pytest.mark.parametrize(("content", "fragment"), FILES.values(), ids=FILES)
def test_wrong_file(folder, content, fragment, complaint):
    (folder / "scene.toml").write_bytes(content)
    assert fragment in complaint("run", "scene.toml")


PROFILES = {
    "missing": (None, "trace.csv: there is no such file"),
    "empty": (b"", "trace.csv: is empty"),
    "binary": (b"\x00\x01\x02" * 50, "SurfaceTopography"),
    "lost height": (b"0,0.1\n1,0.2\n2,nan\n3,0.1\n4,0.2\n", "line 3: height is lost"),
}


@pytest.mark.parametrize(("content", "fragment"), PROFILES.values(), ids=PROFILES)
def test_wrong_profile(folder, content, fragment, toml, complaint):
    (folder / "scene.toml").write_text(toml(MEASURED))
    if content is not None:
        (folder / "trace.csv").write_bytes(content)
    line = complaint("run", "scene.toml")
    assert line.startswith("crosscheck: scene.toml: profile.file: ")
    assert fragment in line


@pytest.mark.parametrize(
    ("scene", "fragment"),
    [
        ("smoth", "smoth: is neither a file nor a scene; the nearest scene is smooth, all are"),
        ("absent.toml", "absent.toml: there is no such file"),
        ("/dev/null", "is not a regular file; allowed is a TOML file"),
        ("", "allowed is a scene's file or name"),
    ],
)
def test_no_scene_there(scene, fragment, complaint):
    assert fragment in complaint("run", scene)


def test_control_characters_of_a_name_are_shown_harmless(complaint):
    line = complaint("run", "\x1b[31m.toml")
    assert "\x1b" not in line and r"\x1b[31m.toml" in line


def test_as_a_process(tmp_path, toml):
    (tmp_path / "scene.toml").write_text(toml({"roller.raduis": "1"}))
    done = subprocess.run(
        [sys.executable, "-m", "comparisons.cli", "run", "scene.toml", "--json"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(PROJECT)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("crosscheck: ") and done.stderr.count("\n") == 1
    assert "the nearest is roller.radius" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]
