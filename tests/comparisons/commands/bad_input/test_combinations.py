"""Fields that do not go together: the line names one of them and what is allowed."""

import pytest

from comparisons.scenes.resolve import load_scene

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
        {f"roller.{name}": None for name in ("radius", "youngs_modulus", "poissons_ratio")},
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


@pytest.mark.parametrize(("changes", "rest"), COMBINATIONS)
def test_wrong_combination(folder, changes, rest, toml, trace, complaint):
    (folder / "scene.toml").write_text(toml(changes))
    (folder / "trace.csv").write_text(trace)
    line = complaint("run", "scene.toml")
    assert line.startswith(f"crosscheck: scene.toml: {rest}")


def test_every_base_scene_is_right_without_its_mistake(folder, toml, trace):
    """Otherwise the cases above could fail for another reason than the one they state."""
    (folder / "trace.csv").write_text(trace)
    for changes in ({}, MEASURED, SINUSOID, SELF_AFFINE, LAYER):
        (folder / "scene.toml").write_text(toml(changes))
        assert load_scene("scene.toml").name == "scene"
