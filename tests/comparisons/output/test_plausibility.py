"""Scenes that can hardly be meant: units left out or mistaken are doubted, and still solved."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scenes import posed

from comparisons.cli import main
from comparisons.output.plausibility import warnings_about, warnings_about_result
from comparisons.scenes.files import scene_names
from comparisons.scenes.scene import Origin, Scene
from comparisons.scenes.surface import surface_of

STEEL = {"youngs_modulus": "207 GPa", "poissons_ratio": 0.3}
X = 0.5 * np.arange(801)  # um
Z = 0.2 * np.sin(X)


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    rows = (f"{x:.6g},{z:.6g}\n" for x, z in zip(X, Z, strict=True))
    (tmp_path / "trace.csv").write_text("".join(rows))
    return tmp_path


def doubts(folder: Path, radius="8 mm", modulus="207 GPa", load="0.5 N/um", **profile) -> str:
    tables = {
        "roller": {"radius": radius, **STEEL},
        "body": {**STEEL, "youngs_modulus": modulus},
        "load": {"per_length": load},
    }
    if profile:
        tables["profile"] = {"file": "trace.csv", "x_unit": "um", "z_unit": "um", **profile}
    scene = Scene.of(tables, Origin("made", folder, "made.toml"))
    return "; ".join(warnings_about(scene, surface_of(scene)))


@pytest.mark.parametrize("name", scene_names())
def test_scenes_that_come_along_are_not_doubted(name):
    scene = Scene.read(name)
    assert warnings_about(scene, surface_of(scene)) == []


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"radius": 8}, "roller.radius is 8 m"),
        ({"modulus": 207}, "body.youngs_modulus is 207 Pa"),
        ({"modulus": "207e6 GPa"}, "body.youngs_modulus is 2"),
        ({"load": 0.5}, "smooth bodies would have 1.5"),
        ({"load": "500 N/um"}, "0.84 of the radius"),
        ({"z_unit": "mm"}, "check x_unit and z_unit"),
        ({"z_unit": "nm", "x_unit": "mm"}, "check x_unit"),
        ({"x_unit": "mm"}, "the trace is 400"),
    ],
)
def test_a_mistaken_unit_is_doubted(folder, change, words):
    assert words in doubts(folder, **change)
    assert doubts(folder) == doubts(folder, z_unit="um") == ""


@pytest.mark.parametrize(
    ("head", "words"),
    [
        (
            "x (mm),z (nm)",
            'x_unit is "um", but "mm" by "x (mm),z (nm)" in the file; profile.z_unit',
        ),
        ("x,z in nm", 'profile.x_unit is "um", but "nm"'),
        ("x [µm],z [um]", ""),
        ("x [pixels],z [V]", ""),
        ("a trace in um", ""),
    ],
)
def test_units_that_the_file_names_otherwise_are_doubted(folder, head, words):
    trace = folder / "trace.csv"
    trace.write_text(f"{head}\n{trace.read_text()}", encoding="utf-8")
    said = doubts(folder, z_unit="um")
    assert words in said and bool(words) == bool(said)


SCENE = """
roller = {radius = "8 mm", youngs_modulus = "207 GPa", poissons_ratio = 0.3}
body = {youngs_modulus = "207 GPa", poissons_ratio = 0.3}
profile = {file = "trace.csv", x_unit = "um", z_unit = "UNIT"}
load = {per_length = LOAD}
resolution = {levels = 2}
"""


def run(folder: Path, unit: str, load: str) -> int:
    (folder / "s.toml").write_text(SCENE.replace("UNIT", unit).replace("LOAD", load))
    return main(["run", "s.toml", "--models", "half-plane"])


@pytest.mark.parametrize(
    ("load", "words"),
    [
        ("0.5", ("rms slope", "exceeds the combined modulus")),
        ("0.05", ("rms slope", "exceeds the combined modulus", "is shorter than 4 samples")),
    ],
)
def test_a_run_says_its_doubts_beside_its_figures(folder, capsys, undrawn, load, words):
    assert run(folder, "mm", f'"{load} N/um"') == 0
    out, err = capsys.readouterr()
    assert "peak pressure" in out and "plausibility warning" not in out
    lines = err.splitlines()
    assert all(line.startswith("crosscheck: plausibility warning: ") for line in lines)
    assert all(word in line for word, line in zip(words, lines, strict=True)) and err.isascii()


def test_a_doubt_comes_before_anything_is_solved(folder, capsys):
    """Without a terminal, too: a trace in the wrong unit may take minutes."""
    assert run(folder, "um", '"5000 N/um"') == 2
    out, err = capsys.readouterr()
    doubt, error = err.splitlines()
    assert out == "" and "smooth bodies would have" in doubt
    assert "reaches the end of the trace" in error and "smooth bodies" not in error


def test_a_field_that_does_not_hold_the_contact_is_doubted(smooth_outcome):
    window = replace(smooth_outcome.window, ends=(-0.9e-6, 0.9e-6))
    assert warnings_about_result(smooth_outcome) == []
    problem = replace(smooth_outcome.problem, window=window)
    [words] = warnings_about_result(posed(smooth_outcome, problem=problem))
    assert words.startswith("stress.half_range: there is contact beyond −900.0 nm to 900.0 nm")
