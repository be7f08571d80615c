"""From a measured profile to a scene that runs as it stands."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
from scenes import PROFILES

from comparisons.cli import main
from comparisons.scenes.resolve import load_scene
from comparisons.scenes.schema.fields import field_type
from comparisons.scenes.schema.profile import VARIETIES
from comparisons.scenes.schema.scene import SECTIONS, SceneFile
from comparisons.studies.init.first_scene import write_first_scene
from comparisons.studies.init.scene_text import FIELDS, scene_text

SHIPPED = sorted(PROFILES.glob("*.csv"))
X = 0.5 * np.arange(801)  # um
Z = 0.2 * np.sin(2.0 * np.pi * X / 31.0) + 0.05 * np.cos(2.0 * np.pi * X / 7.0)  # um
RMS = np.sqrt(0.5 * (0.2**2 + 0.05**2)) * 1e-6


def rows(x, z, separator=",") -> str:
    return "".join(f"{a:.6g}{separator}{b:.6g}\n" for a, b in zip(x, z, strict=True))


def heights(z) -> str:
    return "".join(f"{value:.6g}\n" for value in z)


def sdf(z) -> str:
    head = (
        "aISO-1.0\nNumPoints = 801\nNumProfiles = 5\nXscale = 0.5e-6\nYscale = 1e-6\n"
        "Zscale = 1e-6\nDataType = 7\n*\n"
    )
    line = " ".join(f"{value:.6g}" for value in z)
    flat = " ".join(["0"] * len(z))
    return f"{head}{flat}\n{flat}\n{line}\n{flat}\n{flat}\n*\n"


FILES = {
    "commas under named columns": ("x_um,height_um\n" + rows(X, Z)).encode(),
    "decimal commas": ("x [mm];z [µm]\n" + rows(1e-3 * X, Z, ";").replace(".", ",")).encode(
        "latin-1"
    ),
    "no header, micrometres": rows(X, Z, "\t").encode(),
    "no header, millimetres and nanometres": rows(1e-3 * X, 1e3 * Z, " ").encode(),
    "UTF-16": ("Distance (um)\tHeight (nm)\n" + rows(X, 1e3 * Z, "\t")).encode("utf-16"),
    "heights with their spacing": ("# step = 0,5 um\n# z in nm\n" + heights(1e3 * Z)).encode(),
    "a map": sdf(Z).encode(),
    "lost samples": ("x_um,z_um\n" + rows(X, Z).replace("100,", "100,NaN #", 1)).encode(),
}


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_a_shipped_profile_makes_a_scene_that_loads_as_it_was_read(path, tmp_path):
    made = write_first_scene(path, tmp_path / "mine.toml")
    scene = load_scene(tmp_path / "mine.toml")
    assert scene.profile_info.roughness == made.scene.profile_info.roughness
    assert scene.profile_info.path.samefile(path)
    assert made.profile.fields == {"x_unit": '"um"', "z_unit": '"um"', "form": '"line"'}
    assert all("x_um,height_um" in made.profile.reasons[name] for name in ("x_unit", "z_unit"))
    given = np.loadtxt(path, delimiter=",", skiprows=3)
    np.testing.assert_allclose(scene.profile_info.trace.height, 1e-6 * given[:, 1], rtol=1e-12)


@pytest.mark.parametrize("content", FILES.values(), ids=FILES)
def test_every_format_is_read_in_its_own_units(folder, content):
    (folder / "trace.dat").write_bytes(content)
    assert main(["init", "trace.dat"]) == 0
    info = load_scene(folder / "trace.toml").profile_info
    assert info.length == pytest.approx(400e-6, rel=1e-9)
    assert info.roughness.rq == pytest.approx(RMS, rel=0.02)
    assert (info.bridged > 0) == (b"NaN" in content)
    assert info.place == ("row 2 of 5 rows and 801 columns, 0.0004 m by 4e-06 m"
                          if b"aISO" in content else None)  # fmt: skip


def test_the_scene_runs_unchanged(folder, monkeypatch):
    monkeypatch.setattr("comparisons.report.page.render", lambda outcome: "")  # takes the longest
    (folder / "trace.csv").write_text("x_um,z_um\n" + rows(X, 0.05 * Z))
    assert main(["init", "trace.csv"]) == 0
    assert main(["run", "trace.toml", "--models", "half-plane", "--out", "out"]) == 0
    scene = json.loads((folder / "out/result.json").read_text())["scene"]
    assert (scene["title"], scene["roller"]["radius"]) == ("trace under a smooth roller", 0.01)


def test_a_short_trace_gets_a_small_roller(folder):
    (folder / "trace.csv").write_text("x_um,z_um\n" + rows(0.1 * X, 0.01 * Z))
    radius = write_first_scene(Path("trace.csv")).scene.roller_radius
    assert 1e-5 <= radius <= 1e-3


def test_the_form_of_a_round_specimen_is_an_arc(folder):
    (folder / "trace.csv").write_text("x_um,z_um\n" + rows(X, Z - (X - 200.0) ** 2 / 1e4))
    made = write_first_scene(Path("trace.csv"))
    assert made.profile.fields["form"] == '"arc"'
    assert made.scene.profile_info.form.radius == pytest.approx(5e-3, rel=0.01)


def test_what_is_asked_for_is_not_guessed(folder):
    (folder / "trace.csv").write_text(rows(X, Z))
    assert main(["init", "trace.csv", "--x-unit", "mm", "--z-unit", "nm"]) == 0
    info = load_scene("trace.toml").profile_info
    assert info.length == pytest.approx(0.4)
    assert info.roughness.rq == pytest.approx(1e-3 * RMS, rel=0.02)


def test_json(folder, capsys):
    (folder / "trace.csv").write_bytes(FILES["commas under named columns"])
    assert main(["init", "trace.csv", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["scene"] == "trace.toml"
    assert found["profile"]["samples"] == 801
    assert found["fields"] == {"x_unit": "um", "z_unit": "um", "form": "line"}
    assert found["surface"]["pressed"]["rq"] == pytest.approx(RMS, rel=0.02)


@pytest.mark.parametrize(
    ("name", "content", "arguments", "words"),
    [
        ("trace.csv", None, [], "there is no such file"),
        ("trace.csv", b"", [], "is empty"),
        ("trace.csv", b"one\ntwo\n", [], "has no samples"),
        ("trace.csv", b"1,2\n2,x\n3,4\n4,5\n", [], "is not a number"),
        ("trace.bin", b"\x00\x01\x02" * 99, [], "SurfaceTopography"),
        ("trace.csv", heights(Z).encode(), [], 'allowed is --spacing, such as "0.5 um"'),
        ("trace.csv", rows(X, Z).encode(), ["--x-unit", "kg"], "--x-unit: is "),
        ("trace.csv", rows(X, Z).encode(), ["--spacing", "1 um", "--x-unit", "um"], "beside"),
        ("trace.csv", rows(X, Z).encode(), ["--row", "1"], "is a line scan"),
        ("trace.csv", rows(X, Z).encode(), ["--out", "no/scene.toml"], "no is no folder"),
        ("trace.csv", rows(X, Z).encode(), ["--out", "trace.csv", "--force"], "the profile itself"),
        ("trace.csv", rows(1e-3 * X[:9], Z[:9]).encode(), ["--x-unit", "um", "--z-unit", "um"],
         "trace.csv: load"),
    ],
)  # fmt: skip
def test_what_cannot_be_used_is_one_line_and_leaves_nothing(
    folder, capsys, name, content, arguments, words
):
    if content is not None:
        (folder / name).write_bytes(content)
    before = {path: path.read_bytes() for path in folder.iterdir()}
    assert main(["init", name, *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert words in err and err.count("\n") == 1
    assert {path: path.read_bytes() for path in folder.iterdir()} == before


def test_a_scene_is_not_overwritten_but_by_force(folder, capsys):
    (folder / "trace.csv").write_bytes(FILES["commas under named columns"])
    (folder / "trace.toml").write_text("mine")
    assert main(["init", "trace.csv"]) == 2
    assert "trace.toml: is there already; allowed is --force" in capsys.readouterr().err
    assert (folder / "trace.toml").read_text() == "mine"
    assert main(["init", "trace.csv", "--force"]) == 0
    assert load_scene("trace.toml").profile_info.samples == 801


DESCRIBED = tomllib.loads(FIELDS.read_text(encoding="utf-8"))


def test_every_field_of_a_measured_scene_is_described_and_its_example_allowed():
    of_a_file = VARIETIES["file"].fields()
    for section, table in SECTIONS.items():
        names = set(table.model_fields) if section != "profile" else of_a_file
        fields = dict(DESCRIBED[section])
        assert fields.pop("section") and set(fields) == names
        for name, (_, example) in fields.items():
            value = tomllib.loads(f"value = {example}")["value"]
            field_type(table, name).read(value)
    assert set(SceneFile.model_fields) == set(DESCRIBED)


def test_unused_sections_come_alive_when_their_signs_are_taken_away():
    values = {
        "roller": {"radius": '"10 mm"', "rigid": "true"},
        "body": {"youngs_modulus": '"3 MPa"', "poissons_ratio": "0.3"},
        "load": {"per_length": '"1 N/mm"'},
    }
    text = scene_text("A title", values, {})
    lines = [line for line in text.splitlines() if not line.startswith("# ")]
    tables = tomllib.loads("\n".join(line.removeprefix("#") for line in lines))
    assert tables.keys() == DESCRIBED.keys()
    sections = tables.keys() - {"title"}
    assert all(tables[name].keys() == DESCRIBED[name].keys() - {"section"} for name in sections)
    assert max(map(len, text.splitlines())) <= 100
