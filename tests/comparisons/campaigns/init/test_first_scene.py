"""Scene from a measured profile, which runs as it stands."""

import gzip
import json
import sys
from importlib.util import find_spec
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from scenes import PROFILES

from comparisons.campaigns.init import first_scene
from comparisons.campaigns.init.first_scene import EXAMPLE, write_first_scene
from comparisons.campaigns.init.show import picture
from comparisons.cli import main
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of

SHIPPED = sorted(PROFILES.glob("*.csv"))
X = 0.5 * np.arange(801)  # um
Z = 0.2 * np.sin(2.0 * np.pi * X / 31.0) + 0.05 * np.cos(2.0 * np.pi * X / 7.0)  # um
RMS = np.sqrt(0.5 * (0.2**2 + 0.05**2)) * 1e-6


def rows(x, z, separator=",") -> str:
    return "".join(f"{a:.6g}{separator}{b:.6g}\n" for a, b in zip(x, z, strict=True))


def heights(z) -> str:
    return "".join(f"{value:.6g}\n" for value in z)


NAMED = ("x_um,z_um\n" + rows(X, Z)).encode()
FILES = {
    "commas under named columns": NAMED.replace(b"z_um", b"height_um"),
    "decimal commas": ("x [mm];z [µm]\n" + rows(1e-3 * X, Z, ";").replace(".", ",")).encode(
        "latin-1"
    ),
    "no header, micrometres": rows(X, Z, "\t").encode(),
    "no header, millimetres and nanometres": rows(1e-3 * X, 1e3 * Z, " ").encode(),
    "UTF-16": ("Distance (um)\tHeight (nm)\n" + rows(X, 1e3 * Z, "\t")).encode("utf-16"),
    "a count first": (
        "index,x in µm,y in µm\n"
        + "".join(f"{i},{a:.6g},{b:.6g}\n" for i, (a, b) in enumerate(zip(X, Z, strict=True)))
    ).encode(),
    "raw and levelled": (
        "x [mm],raw [um],levelled [nm]\n"
        + "".join(f"{a / 1e3:.6g},{b:.6g},0\n" for a, b in zip(X, Z, strict=True))
    ).encode(),
    "packed": gzip.compress(NAMED),
    "heights with their spacing": ("# step = 0,5 um\n# z in nm\n" + heights(1e3 * Z)).encode(),
    "lost samples": ("x_um,z_um\n" + rows(X, Z).replace("100,", "100,NaN #", 1)).encode(),
}


INCH = 25400.0  # um
HEADS = {  # units of x and of z, as a scene has them
    "x [inch], z [microinch]": (INCH, 1e-6 * INCH, "inch", "microinch"),
    "x_in,z_uin": (INCH, 1e-6 * INCH, "inch", "microinch"),
    "Distance (mils), Height (micro-inches)": (1e-3 * INCH, 1e-6 * INCH, "mil", "microinch"),
    "x / um, z / \N{ANGSTROM SIGN}": (1.0, 1e-4, "um", "angstrom"),
    "X [um], Z [Angstrom]": (1.0, 1e-4, "um", "angstrom"),
    "Lateral (MM), Raw (Micrometers)": (1e3, 1.0, "mm", "um"),
    "x [cm], z [pm]": (1e4, 1e-6, "cm", "pm"),
    "position (um), height (um) (raw)": (1.0, 1.0, "um", "um"),
}


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """The working folder, with a trace in it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "trace.csv").write_bytes(NAMED)
    return tmp_path


@pytest.fixture(autouse=True)
def undrawn(monkeypatch, one_reader) -> None:
    """Drawing takes the longest."""
    monkeypatch.setattr(first_scene, "picture", lambda scene: "")


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_a_shipped_profile_makes_a_scene_that_loads_as_it_was_read(path, tmp_path):
    made = write_first_scene(path, tmp_path / "mine.toml")
    surface = surface_of(Scene.read(tmp_path / "mine.toml"))
    assert surface.info.roughness == made.surface.info.roughness
    assert surface.info.path.samefile(path)
    assert made.profile.fields == {"x_unit": "um", "z_unit": "um", "form": "line"}
    assert all("x_um,height_um" in made.profile.reasons[name] for name in ("x_unit", "z_unit"))
    columns = np.loadtxt(path, delimiter=",", skiprows=3)
    np.testing.assert_allclose(surface.info.trace.height, 1e-6 * columns[:, 1], rtol=1e-12)


@pytest.mark.parametrize("content", FILES.values(), ids=FILES)
def test_every_format_is_read_in_its_own_units(folder, content):
    (folder / "trace.dat").write_bytes(content)
    assert main(["init", "trace.dat"]) == 0
    info = surface_of(Scene.read(folder / "trace.toml")).info
    assert info.length == pytest.approx(400e-6, rel=1e-9)
    assert info.roughness.rq == pytest.approx(RMS, rel=0.02)
    assert (info.bridged > 0) == (b"NaN" in content)


@pytest.mark.parametrize("head", HEADS)
def test_units_that_a_header_names_count(folder, head, capsys):
    x_unit, z_unit, *names = HEADS[head]
    (folder / "trace.csv").write_text(f"{head}\n" + rows(X / x_unit, Z / z_unit))
    assert main(["init", "trace.csv"]) == 0
    assert "guessed by size" not in capsys.readouterr().out
    scene = Scene.read("trace.toml")
    surface = surface_of(scene)
    assert [scene.tables["profile"][name] for name in ("x_unit", "z_unit")] == names
    assert surface.info.length == pytest.approx(400e-6, rel=1e-5)
    assert surface.info.roughness.rq == pytest.approx(RMS, rel=0.02)


@pytest.mark.parametrize(
    ("head", "unit", "option"),
    [("x [foo], z [um]", "foo", "--x-unit"), ("x (um), z (mV)", "mV", "--z-unit")],
)
def test_units_that_are_no_length_are_errors_unless_another_is_given(
    folder, complaint, head, unit, option
):
    (folder / "trace.csv").write_text(f"{head}\n" + rows(X, Z))
    said = complaint("init", "trace.csv")
    assert f'"{unit}" is no known unit of length (by "{head}" in the file); known are m, mm' in said
    assert all(f" {name}" in said for name in ("angstrom", "inch", "mil", "microinch", option))
    assert main(["init", "trace.csv", option, "um"]) == 0


def test_a_missing_stretch_is_told_bridged_and_refused_without(folder, capsys, complaint):
    kept = (X < 100.0) | (X > 300.0)
    (folder / "trace.csv").write_text("x_um,z_um\n" + rows(X[kept], Z[kept]))
    assert main(["init", "trace.csv"]) == 0
    said = capsys.readouterr().out
    assert "801 samples, 400.0 um long, 500.0 nm apart" in said
    assert "nothing was measured from 99.50 um to 300.5 um: what is pressed there is a" in said
    info = surface_of(Scene.read("trace.toml")).info
    assert info.bridged == 401 and info.roughness.rt < 1.5 * np.ptp(Z) * 1e-6
    text = Path("trace.toml").read_text().replace('dropouts = "bridge"', "")
    Path("trace.toml").write_text(text)
    said = complaint("run", "trace.toml", "--models", "half-plane")
    assert "x has a gap from 9.95e-05 m to 0.0003005 m (401 samples lost)" in said


UNEVEN = np.cumsum(np.random.default_rng(2).uniform(0.2, 0.8, 101)).round(3)


@pytest.mark.parametrize(
    ("x", "z", "words"),
    [
        (UNEVEN, Z[:101], ["long, 204.0 nm to 789.0 nm apart"]),
        (X, Z + 5.0 * (X == 150.0), ["a spike stands out of the trace, by 4.9"]),
        (
            0.5 * np.arange(4001),
            np.sin(0.1 * np.arange(4001)),
            [
                "as pressed: the whole trace without its line",
                "ISO 21920-2: waves longer than 0.8 mm and shorter than 2.5 um are filtered off",
                "section lengths: 1 where the standard asks for 5, so that Rz is Rt",
            ],
        ),
    ],
    ids=["uneven samples", "a spike", "two columns of roughness"],
)
def test_what_the_trace_is_like_is_told(folder, capsys, x, z, words):
    (folder / "trace.csv").write_text("x_um,z_um\n" + rows(x, z))
    assert main(["init", "trace.csv"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert all(part in said for part in words)


def test_bodies_and_load_are_options(folder):
    options = ["--radius", "4 mm", "--load", "0.05 N/um", "--youngs-modulus", "70 GPa"]
    options += ["--poissons-ratio", "0.33", "--hardness", "2 GPa", "--friction", "0.2"]
    assert main(["init", "trace.csv", *options]) == 0
    scene = Scene.read("trace.toml")
    assert (scene.roller.radius, scene.load.kind, scene.load.value) == (
        pytest.approx(4e-3), "per_length", pytest.approx(5e4)
    )  # fmt: skip
    for material in (scene.roller.material, scene.body.material):
        assert (material.youngs_modulus, material.poissons_ratio) == (pytest.approx(70e9), 0.33)
    assert (scene.body.hardness, list(scene.load.friction)) == (pytest.approx(2e9), [0.2])
    assert main(["init", "trace.csv", "--force", "--material", "AISI 4140"]) == 0
    scene = Scene.read("trace.toml")
    assert scene.roller.solid == scene.body.solid == "42CrMo4"
    assert scene.body.youngs_modulus == pytest.approx(205e9)


def test_a_picture_stands_beside_the_scene(folder, capsys, complaint, monkeypatch):
    monkeypatch.setattr(first_scene, "picture", picture)
    assert main(["init", "trace.csv", "--out", "mine.toml"]) == 0
    assert "picture mine.svg" in capsys.readouterr().out
    assert ElementTree.parse("mine.svg").getroot().tag.endswith("svg")
    assert Path("mine.svg").stat().st_size > 20_000
    Path("mine.toml").unlink()
    Path("mine.svg").write_text("mine")
    said = complaint("init", "trace.csv", "--out", "mine.toml")
    assert "mine.svg: is there already; allowed is --force" in said
    assert main(["init", "trace.csv", "--out", "mine.toml", "--no-picture"]) == 0
    assert Path("mine.svg").read_text() == "mine"


@pytest.mark.parametrize(
    ("text", "least", "most"),
    [
        # as an atomic force microscope has it: 100 nm long, some tenths of a nanometre rough
        ("x_nm,z_nm\n" + rows(X / 4.0, Z), 10e-9, 5e-6),
        ("x_um,z_um\n" + rows(0.1 * X, 0.01 * Z), 10e-6, 1e-3),
    ],
    ids=["100 nm", "40 um"],
)
def test_a_short_trace_gets_a_small_roller(folder, text, least, most):
    (folder / "trace.csv").write_text(text)
    assert least <= write_first_scene(Path("trace.csv")).scene.roller.radius <= most


@pytest.mark.parametrize("turned", [False, True])
def test_the_line_of_a_map_runs_across_the_lay(folder, turned):
    lay = np.outer(np.sin(np.arange(90) / 2.0), np.ones(70))
    lay = lay if turned else lay.T
    if find_spec("SurfaceTopography") is None:  # imported here, its HDF5 would meet dolfinx's
        pytest.skip("SurfaceTopography is not installed")
    head = "# Width: {} µm\n# Height: {} µm\n# Value units: µm".format(*lay.T.shape)
    np.savetxt(folder / "map.txt", 0.1 * lay, header=head, comments="", encoding="utf-8")
    made = write_first_scene(Path("map.txt"))
    name = "column" if turned else "row"
    assert made.profile.fields[name] == 35
    why = f"slopes along {name}s are all that there are, none the other way"
    assert made.profile.reasons[name] == f"the middle one of 70, across the lay: {why}"
    assert made.surface.info.roughness.rq == pytest.approx(1e-7 / np.sqrt(2.0), rel=0.05)


def test_the_scene_says_its_examples_and_runs_unchanged(folder, monkeypatch, capsys):
    monkeypatch.setattr("comparisons.output.page.page.render", lambda *_: "")
    (folder / "trace.csv").write_text("x_um,z_um\n" + rows(X, 0.05 * Z))
    assert main(["init", "trace.csv"]) == 0
    said = capsys.readouterr().out
    assert "put in yours: roller.radius = 10 mm, roller.material = rail steel, body." in said
    assert "load.hertz_peak_pressure = 1 GPa" in said and "finite deformation" in said
    assert main(["run", "trace.toml", "--models", "half-plane", "--out", "out"]) == 0
    scene = json.loads((folder / "out/result.json").read_text())["scene"]
    assert (scene["title"], scene["roller"]["radius"]) == ("trace under a smooth roller", 0.01)


def test_the_form_of_a_round_specimen_is_an_arc(folder):
    (folder / "trace.csv").write_text("x_um,z_um\n" + rows(X, Z - (X - 200.0) ** 2 / 1e4))
    made = write_first_scene(Path("trace.csv"))
    assert made.profile.fields["form"] == "arc"
    assert made.surface.info.form.radius == pytest.approx(5e-3, rel=0.01)


def test_what_is_asked_for_is_not_guessed(folder):
    (folder / "trace.csv").write_text(rows(X, Z))
    assert main(["init", "trace.csv", "--x-unit", "mm", "--z-unit", "nm"]) == 0
    info = surface_of(Scene.read("trace.toml")).info
    assert info.length == pytest.approx(0.4)
    assert info.roughness.rq == pytest.approx(1e-3 * RMS, rel=0.02)


def test_json(folder, capsys):
    assert main(["init", "trace.csv", "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["scene"] == "trace.toml"
    assert answer["profile"]["samples"] == 801
    assert answer["fields"] == {"x_unit": "um", "z_unit": "um", "form": "line"}
    assert answer["examples"] == ["radius", "material", "hertz_peak_pressure"]
    assert answer["surface"]["pressed"]["rq"] == pytest.approx(RMS, rel=0.02)


@pytest.mark.parametrize(
    ("name", "content", "arguments", "words"),
    [
        ("absent.csv", None, [], "there is no such file"),
        ("trace.csv", b"one\ntwo\n", [], "has no samples"),
        ("trace.csv", b"1,2\n2,x\n3,4\n4,5\n", [], "is not a number"),
        ("trace.bin", b"\x00\x01\x02" * 99, [], "SurfaceTopography"),
        ("trace.csv", heights(Z).encode(), [], 'allowed is --spacing, such as "0.5 um"'),
        ("trace.csv", rows(X, Z).encode(), ["--x-unit", "kg"], "--x-unit: is "),
        ("trace.csv", rows(X, Z).encode(), ["--spacing", "1 um", "--x-unit", "um"],
         "bring their own x"),
        ("trace.csv", rows(X, Z).encode(), ["--row", "1"], "is a line scan"),
        ("trace.csv", rows(X, Z).encode(), ["--out", "no/scene.toml"], "no is no folder"),
        ("trace.csv", rows(X, Z).encode(), ["--out", "trace.csv", "--force"], "the profile itself"),
        ("trace.toml", NAMED, [], "is the profile itself; allowed is another --out"),
        ("trace.toml", NAMED, ["--force"], "is the profile itself"),
        ("trace.csv", rows(1e-3 * X[:9], Z[:9]).encode(), ["--x-unit", "um", "--z-unit", "um"],
         "trace.csv: load"),
        ("trace.csv", None, ["--radius", "4 N"], "--radius: is "),
        ("trace.csv", None, ["--poissons-ratio", "0.6"], "--poissons-ratio: is 0.6; allowed is"),
        ("trace.csv", None, ["--load", "1 N/um", "--peak-pressure", "1 GPa"],
         "trace.csv: load.hertz_peak_pressure: is given beside per_length; allowed is exactly one"),
        ("trace.csv", None, ["--radius", "9 m", "--load", "1 N/um"], "trace.csv: load"),
        ("trace.csv", None, ["--columns", "0,1,2"], "--columns: is a list of 3"),
    ],
)  # fmt: skip
def test_what_cannot_be_used_is_one_line_and_leaves_nothing(
    folder, complaint, name, content, arguments, words
):
    if content is not None:
        (folder / name).write_bytes(content)
    assert words in complaint("init", name, *arguments)


def test_a_scene_is_not_overwritten_but_by_force(folder, complaint):
    (folder / "trace.toml").write_text("mine")
    said = complaint("init", "trace.csv")
    assert "trace.toml: is there already; allowed is --force" in said
    assert main(["init", "trace.csv", "--force"]) == 0
    assert surface_of(Scene.read("trace.toml")).info.samples == 801


def test_a_scene_is_short_and_says_what_is_guessed_and_what_is_an_example(folder):
    (folder / "trace.csv").write_text(rows(X, Z))
    made = write_first_scene(Path("trace.csv"))
    lines = made.path.read_text().splitlines()
    assert 15 <= len(lines) <= 25 and max(map(len, lines)) <= 100
    said = dict(line.partition(" = ")[::2] for line in lines if "  # " in line)
    assert {*made.examples, *made.profile.reasons, "file", "friction"} == said.keys()
    assert all(EXAMPLE in said[name] for name in made.examples)
    assert all(why in said[name] for name, why in made.profile.reasons.items())
    for part in made.scene.elastic_sections.values():
        assert part.measured_law is not None


def test_a_terminal_asks_for_what_no_trace_shows(folder, monkeypatch, capsys):
    (folder / "trace.csv").write_text(rows(X, Z))
    answers = ["8 N", '"8 mm"', "", "no such steel", "42CrMo4"]
    monkeypatch.setattr("builtins.input", lambda question: print(question) or answers.pop(0))
    for stream in (sys.stdin, sys.stdout):
        monkeypatch.setattr(stream, "isatty", lambda: True)
    assert main(["init", "trace.csv"]) == 0
    said = capsys.readouterr().out
    assert "--radius: is " in said and "--material: is " in said and not answers
    scene = Scene.read("trace.toml")
    assert (scene.roller.radius, scene.body.solid) == (pytest.approx(8e-3), "42CrMo4")
    assert scene.load.kind == "hertz_peak_pressure"
    known = ["--radius", "1 mm", "--peak-pressure", "1 GPa", "--youngs-modulus", "70 GPa"]
    for options in (["--yes"], ["--json"], known):
        capsys.readouterr()
        assert main(["init", "trace.csv", "--force", *options]) == 0
    assert "examples" not in capsys.readouterr().out
    assert Scene.read("trace.toml").roller.radius == pytest.approx(1e-3)
