"""Wrong scenes and profiles: one line that names the place, status 2, nothing written."""

import os
import subprocess
import sys
import types
from pathlib import Path

import pytest

from comparisons.cli import main

ROOT = Path(__file__).parents[2]

GOOD = {
    "title": '"A good scene"',
    "roller.radius": '"8.2 mm"',
    "roller.youngs_modulus": '"207 GPa"',
    "roller.poissons_ratio": "0.3",
    "body.youngs_modulus": '"207 GPa"',
    "body.poissons_ratio": "0.3",
    "load.per_length": '"3.85 N/um"',
}
MEASURED = {"profile.file": '"trace.csv"', "profile.x_unit": '"um"', "profile.z_unit": '"um"'}
SINUSOID = {
    "profile.kind": '"sinusoid"',
    "profile.wavelength": '"50 um"',
    "profile.amplitude": '"0.2 um"',
}
SELF_AFFINE = {
    "profile.kind": '"self-affine"',
    "profile.hurst": "0.8",
    "profile.rms_slope": "0.03",
    "profile.samples": "257",
    "profile.length": '"1 mm"',
}
LAYER = {"body.thickness": '"5 mm"'}
TRACE = "x_um,height_um\n" + "".join(f"{i},{(i * 7) % 5 / 10}\n" for i in range(40))


def toml(changes: dict) -> str:
    """GOOD with the changes, as a scene file; None takes a field away."""
    fields = {name: text for name, text in {**GOOD, **changes}.items() if text is not None}
    top = [f"{name} = {text}" for name, text in fields.items() if "." not in name]
    sections: dict[str, list[str]] = {}
    for path, text in fields.items():
        if "." in path:
            section, name = path.split(".")
            sections.setdefault(section, []).append(f"{name} = {text}")
    return "\n".join([*top, *(f"[{s}]\n" + "\n".join(rows) for s, rows in sections.items())])


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The working folder of a run that must never begin to solve."""

    def run(*arguments):
        pytest.fail("a wrong scene was solved")

    monkeypatch.setitem(sys.modules, "comparisons.run", types.SimpleNamespace(run=run))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def complaint(folder: Path, capsys, *arguments: str) -> str:
    """The one line that the command ends with, after status 2 and without a trace of a result."""
    before = sorted(folder.rglob("*"))
    status = main(list(arguments))
    out, err = capsys.readouterr()
    assert status == 2, err
    assert out == ""
    assert err.startswith("crosscheck: ") and err.endswith("\n") and err.count("\n") == 1
    assert sorted(folder.rglob("*")) == before
    return err.strip()


# field, what the file says, how the line goes on after "scene.toml: field: "
VALUES = [
    (
        "roller.radius",
        '"-3 mm"',
        'is "-3 mm"; allowed is a length above 0: a number in m or "8.2 mm"',
    ),
    ("roller.radius", "0", "is 0; allowed is a length above 0"),
    ("body.youngs_modulus", "0.0", "is 0.0; allowed is a pressure above 0"),
    (
        "body.poissons_ratio",
        "0.5",
        "is 0.5; allowed is a number without unit at least 0 and below 0.5",
    ),
    ("roller.poissons_ratio", "-0.1", "is -0.1; allowed is a number"),
    ("body.hardness", '"0 GPa"', 'is "0 GPa"; allowed is a pressure above 0'),
    ("body.thickness", "0", "is 0; allowed is a length above 0"),
    ("body.width", "-1", "is -1; allowed is a length above 0"),
    ("load.per_length", "-1.0", "is -1.0; allowed is a load per length above 0"),
    ("load.friction", "-0.1", "is -0.1; allowed is a number"),
    ("load.friction", "1.6", "is 1.6; allowed is a number without unit at least 0 and at most 1.5"),
    ("load.friction", "nan", "is nan, which is not finite; allowed"),
    ("load.friction", "[]", "is an empty list; allowed is"),
    ("load.friction", "[0.1, 0.2, 0.1]", "lists 0.1 twice; allowed is"),
    ("load.friction", "[0, -0.0]", "lists 0 twice"),
    ("load.friction", '[0, "a"]', 'is "a", which is not a number and a unit'),
    ("roller.radius", "inf", "is inf, which is not finite; allowed"),
    ("roller.radius", "1" + "0" * 400, "is 1.000e+400, which is not finite"),
    ("roller.radius", '"1e400 mm"', 'is "1e400 mm", which is not finite'),
    # sizes
    ("load.per_length", "1e300", "is 1.000e+300, whose size is not from 1e-30 to 1e+30 in SI; a"),
    ("load.per_length", "1e-300", "is 1e-300, whose size is not from 1e-30 to 1e+30 in SI; all"),
    ("roller.radius", "1e-320", "is 1e-320, whose size is not from 1e-30 to 1e+30 in SI; allowed"),
    ("roller.radius", '"1e-25 um"', 'is "1e-25 um", whose size is not from 1e-30 to 1e+30 in SI'),
    ("load.position", "-1.1e30", "is -1.100e+30, whose size is not from 1e-30 to 1e+30 in SI"),
    ("load.friction", "1e-31", "is 1e-31, whose size is not from 1e-30 to 1e+30 in SI; allowed"),
    ("stress.depth", "1e31", "is 1.000e+31, whose size is not from 1e-30 to 1e+30 in SI; allowed"),
    # units
    ("roller.radius", '"8.2"', 'is "8.2", which has no unit; allowed is a length'),
    ("roller.radius", '"8.2 GPa"', 'is "8.2 GPa", a pressure; allowed is a length'),
    ("load.per_length", '"3 kN"', 'is "3 kN", of dimension ['),
    ("roller.radius", '"8.2 furlogs"', 'is "8.2 furlogs", and "furlogs" is no known unit; allowed'),
    ("body.hardness", '"7 gpa"', 'is "7 gpa", and "gpa" is no known unit (did you mean "GPa"?)'),
    ("roller.radius", '"8,2 mm"', 'is "8,2 mm", and ",2 mm" is not a unit'),
    ("roller.radius", '"eight mm"', 'is "eight mm", which is not a number and a unit'),
    ("roller.radius", '"2 mm + 1 mm"', 'is "2 mm + 1 mm", and "mm + 1 mm" is not a unit'),
    ("budget.memory", '"8 rad"', 'is "8 rad", without dimension; allowed is an amount of memory'),
    ("load.friction", '"0.1 mm"', 'is "0.1 mm", a length; allowed is a number'),
    # types
    ("roller.radius", "[1, 2]", "is a list; allowed is a length"),
    ("roller.radius", "true", "is true; allowed is a length"),
    ("roller.radius", "{m = 1}", "is a table; allowed is a length"),
    ("load.per_length", "1991-06-01", "is a date or time; allowed is a load per length"),
    ("title", "3", "is 3; allowed is a string"),
    ("title", '" "', "is blank; allowed is a string"),
    ("title", '"a\\nb"', "holds a control character; allowed is a string of one line"),
    ("finite_element.geometry", "3", 'is 3; allowed is "flat" or "rough"'),
    ("roller.rigid", '"yes"', 'is "yes"; allowed is true or false'),
    ("resolution.levels", "2.5", "is 2.5; allowed is a whole number from 2 to 6"),
    # names
    ("roller.raduis", "1", "is no known field; the nearest is roller.radius"),
    ("body.THICKNESS", "1", "is no known field; the nearest is body.thickness"),
    ("roller.friction", "0.1", "is no known field; the nearest is load.friction"),
    ("frictoin", "0.1", "is no known field; the nearest is load.friction"),
    ("Titel", "1", "is no known field; the nearest is title"),
    ("tolerance.peak_presure", "0.1", "is no known field; the nearest is tolerance.peak_pressure"),
    # what is missing, and what excludes what
    ("roller.radius", None, "is missing; allowed is a length above 0"),
    ("roller.youngs_modulus", None, "is missing; allowed is youngs_modulus with poissons_ratio"),
    ("roller.poissons_ratio", None, "is missing; allowed is youngs_modulus with poissons_ratio"),
    ("load.hertz_peak_pressure", '"1 GPa"', "is given beside per_length; allowed is exactly one"),
    ("body.base", '"bonded"', "is given for a half-plane, which has none; allowed only with"),
    # stress, tolerance, settings
    ("stress.depth", "0", "is 0; allowed is a number of half-widths above 0 or a length"),
    ("stress.depth", '"1 a"', 'is "1 a", a time; allowed is a number of half-widths'),
    ("stress.half_range", '"-1 mm"', 'is "-1 mm"; allowed is a number of half-widths'),
    (
        "stress.points",
        "[200, 2]",
        "holds 2; allowed is a list of two whole numbers [along x, along z], at least 3 each",
    ),
    ("stress.points", "[1, 200]", "holds 1; allowed is a list of two whole numbers"),
    ("stress.points", "[1, 2, 3]", "is a list of 3; allowed is a list of two"),
    ("stress.points", "600", "is 600; allowed is a list of two"),
    ("stress.points", "[600, 2.5]", "holds 2.5; allowed is a list of two"),
    ("stress.points", "[100_000, 100_000]", "asks for 10000000000 points; allowed is a list"),
    ("tolerance.tau1_max", "0", "is 0; allowed is a number without unit above 0 and below 1"),
    ("tolerance.pressure_l2", '"100 %"', 'is "100 %"; allowed is a number'),
    ("finite_element.block", "9", "is 9; allowed is a number without unit at least 10"),
    ("finite_element.block", "1e4", "is 10000.0; allowed is a number"),
    ("finite_element.growth", "0.6", "is 0.6; allowed is a number without unit at least 0.05 and"),
    ("resolution.levels", "1", "is 1; allowed is a whole number from 2 to 6"),
    ("resolution.pitch", "0", "is 0; allowed is a length above 0"),
    ("budget.time", '"0 s"', 'is "0 s"; allowed is a time above 0: a number in s or "300 s"'),
    ("budget.memory", "-1", "is -1; allowed is an amount of memory above 0: a number in byte"),
]

# changes, and how the line goes on after "scene.toml: "
COMBINATIONS = [
    (
        {"tolerance.tau1_max": "0.02"},
        "tolerance.tau1_max: needs a [stress] section; allowed is contact_length, contact_ratio, "
        "peak_pressure, pressure_l2 without one",
    ),
    ({"tolerance.tau1_field_deep": '"5 %"'}, "tolerance.tau1_field_deep: needs a [stress] section"),
    ({"tolerence.tau1_max": "0.1"}, "tolerence: is no known section; the nearest is [tolerance]"),
    (
        {"body.youngs_modulus": None, "body.young_modulus": "1"},
        "body.young_modulus: is no known field; the nearest is body.youngs_modulus",
    ),
    (
        {name: None for name in GOOD if name.startswith("roller")},
        "roller: is missing; allowed is a section [roller]",
    ),
    ({"load.per_length": None, "load": "3"}, "load: is 3; allowed is a section [load]"),
    ({"roller.rigid": "true"}, "roller.youngs_modulus: is given beside rigid = true; allowed"),
    (
        {"load.per_length": None, "load.friction": "0.1"},
        "load.per_length: is missing; allowed is exactly one of per_length, hertz_peak_pressure",
    ),
    (
        {"load.per_length": None, "load.approach": '"2 um"'},
        "load.approach: has no meaning on a half-plane, whose displacement has no datum; allowed",
    ),
    (
        {**LAYER, "body.base": '"glued"'},
        'body.base: is "glued"; allowed is "bonded" or "frictionless"',
    ),
    (
        {
            **LAYER,
            "body.base": '"frictionless"',
            "body.width": '"40 mm"',
            "load.friction": "[0, 0.1]",
        },
        "load.friction: is 0.1 on a body of finite width on a frictionless base",
    ),
    ({"profile.form": '"line"'}, "profile.file: is missing; allowed is file (measured) or kind"),
    ({**MEASURED, **SINUSOID}, "profile.kind: is given beside file; allowed is one of the two"),
    (
        {**MEASURED, "profile.x_unit": '"GPa"'},
        'profile.x_unit: is "GPa", a pressure; allowed is a unit of length',
    ),
    ({**MEASURED, "profile.z_unit": '"2 um"'}, 'profile.z_unit: is "2 um", and "2 um" is not a'),
    (
        {**MEASURED, "profile.z_unit": None},
        "profile.z_unit: is missing; allowed is a unit of length",
    ),
    (
        {**MEASURED, "profile.x_unit": None},
        "profile.x_unit: is missing; allowed is exactly one of x_unit and spacing",
    ),
    (
        {**MEASURED, "profile.spacing": '"1 um"'},
        "profile.spacing: is given beside x_unit; allowed is exactly one of x_unit and spacing",
    ),
    (
        {**MEASURED, "profile.form": '"parabola"'},
        'profile.form: is "parabola"; allowed is "none" or "mean" or "line" or "arc"',
    ),
    (
        {**MEASURED, "profile.file": '"a\\u0000b"'},
        "profile.file: holds a control character; allowed is",
    ),
    (
        {**MEASURED, "load.position": '"40 um"'},
        "load.position: is 4e-05 m; allowed is inside the trace, above 0 m and below 3.9e-05 m",
    ),
    (
        {**SINUSOID, "profile.kind": '"sinus"'},
        'profile.kind: is "sinus" (did you mean "sinusoid"?); allowed is "sinusoid" or',
    ),
    (
        {**SINUSOID, "profile.hurst": "0.8"},
        'profile.hurst: does not belong to kind = "sinusoid"; allowed there are amplitude, length',
    ),
    (
        {**SINUSOID, "profile.form": '"arc"'},
        'profile.form: does not belong to kind = "sinusoid"; allowed there are',
    ),
    (
        {**SINUSOID, "profile.wavelength": None},
        "profile.wavelength: is missing; allowed is a length above 0",
    ),
    (
        {**SINUSOID, "profile.wavelength": '"1 nm"', "profile.length": '"1 m"'},
        "profile: samples must be a whole number",
    ),
    (
        {**SELF_AFFINE, "profile.rms_height": '"1 um"'},
        "profile.rms_height: is given beside rms_slope; allowed is exactly one of rms_slope and",
    ),
    (
        {**SELF_AFFINE, "profile.rms_slope": None},
        "profile.rms_slope: is missing; allowed is exactly one of rms_slope and rms_height",
    ),
    (
        {**SELF_AFFINE, "profile.samples": "7"},
        "profile.samples: is 7; allowed is a whole number from 8 to",
    ),
    (
        {**SELF_AFFINE, "profile.samples": "10_000_000_000"},
        "profile.samples: is 10000000000; allowed is a whole number from 8 to",
    ),
    (
        {**SELF_AFFINE, "profile.shortest_wavelength": '"1 um"'},
        "profile: shortest_wavelength 1e-06 m is below two sample spacings",
    ),
    (
        {**SELF_AFFINE, "profile.longest_wavelength": '"2 mm"'},
        "profile: longest_wavelength 0.002 m",
    ),
    (
        {**SELF_AFFINE, "profile.seed": "-1"},
        "profile.seed: is -1; allowed is a whole number from 0",
    ),
]


@pytest.mark.parametrize(("field", "text", "rest"), VALUES)
def test_wrong_value(folder, capsys, field, text, rest):
    (folder / "scene.toml").write_text(toml({field: text}))
    line = complaint(folder, capsys, "run", "scene.toml")
    assert line.startswith(f"crosscheck: scene.toml: {field}: {rest}")


@pytest.mark.parametrize(("changes", "rest"), COMBINATIONS)
def test_wrong_combination(folder, capsys, changes, rest):
    (folder / "scene.toml").write_text(toml(changes))
    (folder / "trace.csv").write_text(TRACE)
    line = complaint(folder, capsys, "run", "scene.toml")
    assert line.startswith(f"crosscheck: scene.toml: {rest}")


def test_every_base_scene_is_right_without_its_mistake(folder, capsys):
    """Otherwise the cases above could fail for another reason than the one they state."""
    from comparisons.resolve import load_scene

    (folder / "trace.csv").write_text(TRACE)
    for changes in ({}, MEASURED, SINUSOID, SELF_AFFINE, LAYER):
        (folder / "scene.toml").write_text(toml(changes))
        assert load_scene("scene.toml").name == "scene"


FILES = {
    "empty": (b"", "scene.toml: is empty; allowed are sections"),
    "comments only": (b"# nothing\n\n", "scene.toml: is empty; allowed are sections"),
    "binary": (b"[roller]\n\x80\x81\xff", "is not text (byte 9 is not UTF-8); allowed is a TOML"),
    "zeros": (bytes(100), "scene.toml: is not TOML"),
    "not TOML": (b"[roller]\nradius 8.2 mm\n", "is not TOML: "),
    "line named": (b"[roller]\nradius = 8.2 mm\n", "line 2, column"),
    "field twice": (b"[roller]\nradius = 1\nradius = 2\n", "line 3"),
    "a profile": (TRACE.encode(), "is not TOML: "),
    "nested deep": (b"a = " + b"[" * 5000 + b"]" * 5000, "is beyond what TOML may hold"),
    "digits without end": (b"a = " + b"9" * 5000, "is beyond what TOML may hold"),
    "large": (b"# " + b"a" * 2**20, "allowed are 1048576 for a scene"),
}


@pytest.mark.parametrize(("content", "fragment"), FILES.values(), ids=FILES)
def test_wrong_file(folder, capsys, content, fragment):
    (folder / "scene.toml").write_bytes(content)
    assert fragment in complaint(folder, capsys, "run", "scene.toml")


PROFILES = {
    "missing": (None, "trace.csv: there is no such file"),
    "empty": (b"", "trace.csv: is empty"),
    "binary": (b"\x00\x01\x02" * 50, "SurfaceTopography"),
    "words": (b"a\nb\nc\n", "trace.csv: has no samples"),
    "two samples": (b"0,1\n1,2\n", "trace.csv: "),
    "heights alone": (b"0.1\n0.2\n0.3\n0.4\n0.5\n", "one column"),
    "three columns": (b"0 1 2\n1 2 3\n2 3 4\n3 4 5\n", "trace.csv, line 1"),
    "word among numbers": (TRACE.replace("20,0", "20,peak").encode(), "trace.csv, line 22"),
    "lost height": (TRACE.replace("20,0.0", "20,nan").encode(), "line 22: height is lost"),
    "x twice": (TRACE.replace("20,0.0", "19,0.0").encode(), "trace.csv, line "),
}


@pytest.mark.parametrize(("content", "fragment"), PROFILES.values(), ids=PROFILES)
def test_wrong_profile(folder, capsys, content, fragment):
    (folder / "scene.toml").write_text(toml(MEASURED))
    if content is not None:
        (folder / "trace.csv").write_bytes(content)
    line = complaint(folder, capsys, "run", "scene.toml")
    assert line.startswith("crosscheck: scene.toml: profile.file: ")
    assert fragment in line


def test_profile_that_is_a_folder(folder, capsys):
    (folder / "scene.toml").write_text(toml(MEASURED))
    (folder / "trace.csv").mkdir()
    assert "trace.csv: is a directory" in complaint(folder, capsys, "run", "scene.toml")


def test_spacing_for_a_file_of_two_columns(folder, capsys):
    changes = {**MEASURED, "profile.x_unit": None, "profile.spacing": '"1 um"'}
    (folder / "scene.toml").write_text(toml(changes))
    (folder / "trace.csv").write_text(TRACE)
    assert "spacing is for heights alone" in complaint(folder, capsys, "run", "scene.toml")


def test_arc_that_fits_nothing(folder, capsys, monkeypatch):
    """Whatever the form's own reason, the line names the field."""

    def remove_form(profile, form):
        raise ValueError("no circular arc fits the profile; remove a line instead")

    monkeypatch.setattr("comparisons.scene_profile.remove_form", remove_form)
    (folder / "scene.toml").write_text(toml(MEASURED))
    (folder / "trace.csv").write_text(TRACE)
    assert "profile.form: no circular arc" in complaint(folder, capsys, "run", "scene.toml")


@pytest.mark.parametrize(
    ("scene", "fragment"),
    [
        ("smoth", "smoth: is neither a file nor a scene; the nearest scene is smooth, all are"),
        ("absent.toml", "absent.toml: there is no such file"),
        ("absent/scene", "absent/scene: there is no such file"),
        (".", "is a directory; allowed is a TOML file"),
        ("/dev/null", "is not a regular file; allowed is a TOML file"),
        ("", "allowed is a scene's file or name"),
    ],
)
def test_no_scene_there(folder, capsys, scene, fragment):
    assert fragment in complaint(folder, capsys, "run", scene)


def test_unreadable_scene(folder, capsys, monkeypatch):
    def read_bytes(path):
        raise PermissionError(13, "Permission denied", str(path))

    (folder / "scene.toml").write_text(toml({}))
    monkeypatch.setattr(Path, "read_bytes", read_bytes)
    assert "scene.toml: cannot be read: Permission denied" in complaint(
        folder, capsys, "run", "scene.toml"
    )


def test_control_characters_of_a_name_are_shown_harmless(folder, capsys):
    line = complaint(folder, capsys, "run", "\x1b[31m.toml")
    assert "\x1b" not in line and r"\x1b[31m.toml" in line


@pytest.mark.parametrize(
    ("changes", "arguments", "fragment"),
    [
        ({"roller.raduis": "1"}, ["scene.toml"], "the nearest is roller.radius"),
        (MEASURED, ["scene.toml", "--json"], "profile.file: trace.csv: there is no such file"),
        ({}, ["scene.toml", "--out", "scene.toml"], "scene.toml is not a folder"),
    ],
)
def test_as_a_process(tmp_path, changes, arguments, fragment):
    (tmp_path / "scene.toml").write_text(toml(changes))
    done = subprocess.run(
        [sys.executable, "-m", "comparisons.cli", "run", *arguments],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("crosscheck: ") and done.stderr.count("\n") == 1
    assert fragment in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]
