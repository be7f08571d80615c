"""Wrong fields of a scene, alone and together: the line names one and what is allowed."""

import pytest

from comparisons.scenes.scene import Scene

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

# field, what the file says, how the line goes on after "scene.toml: field: "
VALUES = [
    (
        "roller.radius",
        '"-3 mm"',
        'is "-3 mm"; allowed is a length above 0: a number in m or "8.2 mm"',
    ),
    ("body.poissons_ratio", "0.5", "is 0.5; allowed is a number without unit at least 0 and below"),
    ("load.friction", "1.6", "is 1.6; allowed is a number without unit at least 0 and at most 1.5"),
    ("load.friction", "[]", "is an empty list; allowed is"),
    ("load.friction", "[0, -0.0]", "lists 0 twice"),
    ("load.friction", "[" + "0.1," * 2000 + "]", "is a list of 2000 values, more than 1000; allow"),
    ("profile.columns", "[[1, 2], 3]", "holds a list; allowed is one or two columns by name"),
    ("roller.radius", "inf", "is inf, which is not finite; allowed"),
    ("roller.radius", "1e-320", "is 1e-320, whose size is not from 1e-30 to 1e+30 in SI; allowed"),
    ("load.per_length", '"3 kN"', 'is "3 kN", a force: a force per length is "3 kN/mm"; allowed'),
    ("body.hardness", '"7 gpa"', 'is "7 gpa", and "gpa" is no known unit (did you mean "GPa"?)'),
    ("roller.radius", "[1, 2]", "is a list; allowed is a length"),
    ("load.per_length", "1991-06-01", "is a date or time; allowed is a load per length"),
    ("title", "3", "is 3; allowed is a string"),
    ("title", '"a\\nb"', "holds a control character; allowed is a string of one line"),
    ("finite_element.deformation", "3", 'is 3; allowed is "linear" or "finite"'),
    ("roller.rigid", '"yes"', 'is "yes"; allowed is true or false'),
    ("resolution.levels", "2.5", "is 2.5; allowed is a whole number from 2 to 6"),
    ('""', "3", "is no known field; the nearest is"),
    ("roller.raduis", "1", "is no known field; the nearest is roller.radius"),
    ("roller.diameter", "1", "is no known field; the nearest is roller.radius"),
    ("roller.friction", "0.1", "is no known field; the nearest is load.friction"),
    ("load.force", "1", "is no known field; the nearest is load.per_length, a force per length"),
    ("frictoin", "0.1", "is no known field; the nearest is load.friction"),
    ("roller.radius", None, "is missing; allowed is a length above 0"),
    ("roller.youngs_modulus", None, "is missing; allowed is youngs_modulus with poissons_ratio"),
    ("load.hertz_peak_pressure", '"1 GPa"', "is given beside per_length; allowed is exactly one"),
    ("body.base", '"bonded"', "is given for a half-plane, which has none; allowed only with"),
    ("stress.depth", '"1 a"', 'is "1 a", a time; allowed is a number of half-widths'),
    (
        "stress.points",
        "[200, 2]",
        "holds 2; allowed is a list of two whole numbers [along x, along z], from 3 to 20000 each",
    ),
    ("stress.points", "[1, 2, 3]", "is a list of 3; allowed is a list of two"),
    ("stress.points", "[20_000, 20_000]", "asks for 400000000 points; allowed is a list"),
]
# changes, and how the line goes on after "scene.toml: "
COMBINATIONS = [
    (
        {"tolerance.tau1_max": "0.02"},
        "tolerance.tau1_max: needs a [stress] section; allowed is contact_length, "
        "peak_pressure without one",
    ),
    ({"tolerence.tau1_max": "0.1"}, "tolerence: is no known section; the nearest is [tolerance]"),
    (
        {"body.youngs_modulus": None, "body.young_modulus": "1"},
        "body.young_modulus: is no known field; the nearest is body.youngs_modulus",
    ),
    (
        {f"roller.{name}": None for name in ("radius", "youngs_modulus", "poissons_ratio")},
        "roller: is missing; allowed is a section [roller]",
    ),
    ({"load.per_length": None, "load": "3"}, "load: is 3; allowed is a section [load]"),
    (
        {"load.per_length": None, "load.approach": '"2 um"'},
        "load.approach: has no meaning on a half-plane, whose displacement has no datum; allowed",
    ),
    ({"load.position": '"3 mm"'}, "load.position: is on a smooth body without ends, which is the"),
    ({"profile.form": '"line"'}, "profile.file: is missing; allowed is file (measured) or kind"),
    ({**MEASURED, **SINUSOID}, "profile.kind: is given beside file; allowed is one of the two"),
    (
        {**MEASURED, "profile.x_unit": '"GPa"'},
        'profile.x_unit: is "GPa", a pressure; allowed is a unit of length',
    ),
    (
        {**MEASURED, "profile.x_unit": None},
        'profile.x_unit: is missing; allowed is a unit of length as a string, such as "um", or sp',
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
        {**SINUSOID, "profile.wavelength": '"1 nm"', "profile.length": '"1 m"'},
        "profile: the trace would have 4000001 samples; allowed is a whole number from 8",
    ),
    (
        {**SELF_AFFINE, "profile.rms_height": '"1 um"'},
        "profile.rms_height: is given beside rms_slope; allowed is exactly one of rms_slope and",
    ),
    (
        {**SELF_AFFINE, "profile.shortest_wavelength": '"1 um"'},
        "profile: shortest_wavelength 1e-06 m is below two sample spacings",
    ),
]


@pytest.mark.parametrize(
    ("changes", "rest"),
    [*(({field: text}, f"{field}: {rest}") for field, text, rest in VALUES), *COMBINATIONS],
)
def test_wrong_fields(folder, changes, rest, toml, trace, complaint):
    (folder / "scene.toml").write_text(toml(changes))
    (folder / "trace.csv").write_text(trace)
    line = complaint("run", "scene.toml")
    assert line.startswith(f"crosscheck: scene.toml: {rest}")


def test_every_base_scene_is_right_without_its_mistake(folder, toml, trace):
    """Otherwise the cases above could fail for another reason than the one they state."""
    (folder / "trace.csv").write_text(trace)
    for changes in ({}, MEASURED, SINUSOID, SELF_AFFINE, LAYER):
        (folder / "scene.toml").write_text(toml(changes))
        assert Scene.read("scene.toml").name == "scene"
