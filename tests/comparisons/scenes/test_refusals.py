"""Scenes that cannot be: one line that names the field, what it is, and what is allowed."""

import datetime
import math

import pytest
from scenes import CONSTANTS, HOT, SMOOTH, STEEL, changed, resolved

from comparisons.common.errors import SceneError
from comparisons.models.posing import problem_of

TRACED = SMOOTH | {"profile": {"file": "trace.csv", "x_unit": "um", "z_unit": "um"}}
WAVE = {"kind": "sinusoid", "wavelength": 5e-5, "amplitude": 2e-7}
WAVY = SMOOTH | {"profile": WAVE}
ROUGH = {"kind": "self-affine", "hurst": 0.8, "rms_height": 3e-6, "samples": 2001, "length": 4e-3}
ROUGH = SMOOTH | {"profile": ROUGH}
TURNED = {"kind": "turned", "feed": "0.1 mm", "nose_radius": "0.8 mm", "length": "4 mm"}
TURNED = SMOOTH | {"profile": TURNED}
MAP = SMOOTH | {"profile": {"file": "map.npy", "spacing": "1 um", "z_unit": "nm"}}
RIGID = SMOOTH | {"roller": {"radius": 8e-3, "rigid": True}}
LAYER = changed(SMOOTH, body={"thickness": 5e-3})
COAT = {"thickness": 1e-5, "youngs_modulus": 4e11, "poissons_ratio": 0.2}
COAT_HEAT = {f"heat.coating_{name}": 10.0 for name in ("conductivity", "density", "specific_heat")}
COATED = SMOOTH | {"coating": {"thickness": 1e-5, **STEEL}}
MURNAGHAN = changed(SMOOTH, body={"law": "murnaghan", "murnaghan": CONSTANTS})
YIELDING = changed(SMOOTH, body={"yield_stress": 2e8})
FLOWING = changed(YIELDING, finite_element={"plastic": True})
SLIDING = changed(SMOOTH, load={"friction": 0.1})
FINITE = changed(RIGID, finite_element={"deformation": "finite"})
STRESSED = changed(HOT, heat={"stresses": True, "body_expansion": "12 um/m/K"}, stress={})
PERIODIC = {"roller": {"rigid": True}, "body": STEEL, "profile": WAVE | {"periodic": True}}
PERIODIC |= {"load": {"mean_pressure": 140e6, "friction": [0.0, 0.3]}}
SLIPPING = SLIDING | {"partial_slip": {"load": 0.5}}
SCATTERED = SMOOTH | {"scatter": {"load": "2 %"}}
PEAK = {"quantity": "peak_pressure", "value": "9.351 MPa", "source": "a manual"}
PUBLISHED = SMOOTH | {"published": {"p0": PEAK}}
UNDER = "is {:g} m under a contact of 0.000545 m half-width; allowed is from 0.001 to 1e"
LENGTH = 'allowed is a length above 0: a number in m or "8.2 mm"'

# Of each scene: a field, its value (None takes it away), and how the line goes on after it; or
# several fields, and how it goes on after the file.
SAID = [
    (SMOOTH, [
        ("roller.radius", "-3 mm", f'is "-3 mm"; {LENGTH}'),
        ("roller.radius", math.inf, "is inf, which is not finite; allowed"),
        ("roller.radius", 1e-320,
         "is 1e-320, whose size is not from 1e-30 to 1e+30 in SI; allowed"),
        ("roller.radius", [1, 2], "is a list; allowed is a length"),
        ("roller.radius", None, "is missing; allowed is a length above 0"),
        ("roller.raduis", 1, "is no known field; the nearest is roller.radius"),
        ("roller.diameter", 1, "is no known field; the nearest is roller.radius"),
        ("roller.friction", 0.1, "is no known field; the nearest is load.friction"),
        ("roller.rigid", "yes", 'is "yes"; allowed is true or false'),
        ("roller.youngs_modulus", None,
         "is missing; allowed is youngs_modulus with poissons_ratio"),
        ("roller.murnaghan", CONSTANTS, "is given for another law"),
        ("roller.support", "oposite", 'is "oposite" (did you mean "opposite'),
        ("roller.support", {"hub": "9 mm"}, "has a hub of 0.009 m; allowed"),
        ("roller.support.shaft", "2 mm", "is no known field; the"),
        ("roller.support.hub", 0.0, "is 0.0; allowed is a length"),
        ("roller", None, "is missing; allowed is a section [roller]"),
        ("body.poissons_ratio", 0.5,
         "is 0.5; allowed is a number without unit at least 0 and below"),
        ("body.hardness", "7 gpa", 'is "7 gpa", and "gpa" is no known unit (did you mean "GPa"?)'),
        ("body.hardness", 1.0,
         "is 1 Pa, which carries the load on 3.55e+06 m, more than the roller is wide; allowed is "
         "2.34e+08 Pa or more"),
        ("body.yield_stress", 0, "is 0; allowed is a pressure above 0"),
        ("body.hardening_modulus", 1e9, "is given for a body that"),
        ("body.hardening", {"kinematic": 1e9}, "is given for a body that"),
        ("body.base", "bonded", "is given for a half-plane, which has none; allowed only with"),
        ("body.law", "henky", 'is "henky" (did you mean "hencky"'),
        ({"body.law": "linear"}, "roller.law: is missing beside a linear one; allowed is"),
        ({"body.law": "murnaghan"}, "body.murnaghan: is missing; allowed is a table"),
        ({"body.youngs_modulus": None, "body.young_modulus": 1},
         "body.young_modulus: is no known field; the nearest is body.youngs_modulus"),
        ({"body": {"material": "carbn steel"}},
         'body.material: is "carbn steel", which is no known solid; did you mean "carbon steel"?'),
        ({"body": {"material": 7}}, "body.material: is 7, which is no known solid; allowed is"),
        ({"body": {"material": "100Cr6", "law": "murnaghan"}}, "body.murnaghan: is missing"),
        ({"body.thickness": 1e-3, "load.approach": 1e-6},
         "load.approach: has no meaning for an elastic roller"),
        ({"body.thickness": 1e-5, "coating": COATED["coating"]},
         "coating.thickness: is 1e-05 m on a body of 1e-05 m"),
        ({"coating": {"thickness": 2e-6, "material": "DLC"}}, "coating.poissons_ratio: is missing"),
        ("load.friction", 1.6,
         "is 1.6; allowed is a number without unit at least 0 and at most 1.5"),
        ("load.friction", [], "is a list of 0 values, not of 1 to 1000; allowed is"),
        ("load.friction", [0, -0.0], "lists 0 twice"),
        ("load.friction", [0.1] * 2000, "is a list of 2000 values, not of 1 to 10"),
        ("load.per_length", "3 kN", 'is "3 kN", a force: a force per length is "3 kN/mm"; allowed'),
        ("load.per_length", datetime.date(1991, 6, 1),
         "is a date or time; allowed is a load per length"),
        ("load.force", 1, "is no known field; the nearest is load.per_length, a force per length"),
        ("load.approach", "2 um",
         "has no meaning on a half-plane, whose displacement has no datum; allowed"),
        ({"load.per_length": 1e6, "load.hertz_peak_pressure": "1 GPa"},
         "load.hertz_peak_pressure: is given beside per_length; allowed is exactly one"),
        ("load.position", "3 mm", "is on a smooth body without ends, which is the"),
        ("load", 3, "is 3; allowed is a section [load]"),
        ("load.frictoin", 0.1, "is no known field; the nearest is load.friction"),
        ("title", 3, "is 3; allowed is a string"),
        ("title.x", 1, "title is no table; allowed is a scene's field"),
        ("title", "a\nb", "holds a control character; allowed is a string of one line"),
        ("finite_element.deformation", 3, 'is 3; allowed is "linear" or "finite"'),
        ("finite_element.plastic", True, "is true, but the body has no yield stress; allowed"),
        ("statistics", {}, "is given for a smooth surface; allowed only with"),
        ("resolution.levels", 2.5, "is 2.5; allowed is a whole number from 2 to 6"),
        ({"resolution": {"pitch": "1 um", "elements": 8}},
         "resolution.elements: is given beside pitch; allowed is at most one of"),
        ({"": 3}, '"": is no known field; the nearest is'),
        ("frictoin", 0.1, "is no known field; the nearest is load.friction"),
        ({"tolerence.tau1_max": 0.1},
         "tolerence: is no known section; the nearest is [tolerance]"),
        ("tolerance.tau1_max", 0.02,
         "needs a [stress] section; allowed is contact_length, peak_pressure without one"),
        ("stress.depth", "1 a", 'is "1 a", a time; allowed is a number of half-widths'),
        ("stress.depth", 1e6, "is 545 m; allowed is at most half of what the unbounded body is"),
        ("stress.half_range", 1e6, "is 545 m; allowed is at most half of what the"),
        ("stress.half_range", 1e-12, "is 5.45e-16 m; allowed is at least"),
        ("stress.points", [200, 2], "holds 2; allowed is a whole number from 3 to 20000"),
        ("stress.points", [1, 2, 3], "is a list of 3; allowed is a list of 2, each a whole"),
        ("stress.points", [20_000, 20_000],
         "asks for 400000000 points; allowed are 50000000 in all"),
        ("profile.columns", [[1, 2], 3], "holds a list of 2; allowed is the name of a column"),
        ({"profile.form": "line"},
         "profile.file: is missing; allowed is exactly one of file, kind"),
        *(("body.thickness", size, UNDER.format(size)) for size in (1e-30, 1e-9, 1e3, 1e30)),
    ]),
    (COATED, [
        *(("coating.thickness", size, UNDER.format(size)) for size in (1e-30, 1e-9, 1e3, 1e30)),
        *(("coating.youngs_modulus", modulus,
           f"is {modulus:g} Pa on a body of 2.1e+11 Pa; allowed is from 210")
          for modulus in (1e-30, 1e30)),
        ({"load": {"approach": 2e-6}, "body.thickness": 1e-3, "roller": RIGID["roller"],
          "scatter": {"load": "2 %"}}, "scatter: is given with a coating and load"),
    ]),
    (RIGID, [
        ("roller.law", "hencky", "is given beside rigid"),
        ("roller.material", "100Cr6", "is given beside rigid = true"),
        ("roller.support", "opposite", "is given beside rigid = true"),
        ("finite_element.roller_body", "disc", 'is "disc", but the roller is rigid; allowed'),
        ("scatter.roller_youngs_modulus", "2 %", "is given without roller.youngs_modulus"),
        *(({"load": {"approach": 1e-6}, "body.thickness": size},  # measured by what it cuts off
           f"body.thickness: is {size:g} m under a contact of 0.000126 m half-width")
          for size in (1e-30, 1e30)),
    ]),
    (LAYER, [
        ({"body.base": "frictionless", "body.width": "40 mm", "load.friction": [0, 0.1]},
         "load.friction: is 0.1 on a body of finite width"),
    ]),
    (MURNAGHAN, [
        ("body.murnaghan.n", None, "is missing; allowed is a pressure"),
        ("body.murnaghan.k", 1.0, "is no known field; the nearest is body.murnaghan."),
        ("body.murnaghan.n", "1 mm", 'is "1 mm", a length; allowed is a pressure'),
    ]),
    (YIELDING, [
        ("body.hardening", {"table": [[0, 2e8], [0.1, 1e8]]},
         "is no law: a hardening table must not soften"),
        ("body.hardening.table", [[0, 2e8], [0.1]], "holds a list of 1; allowed is a list of 2"),
        ("body.hardening.table", [], "is a list of 0; allowed is a list of 2 to 1000, each a"),
        ({"body.hardening": {"voce": {"saturated": 3e8}}},
         "body.hardening.voce.rate: is missing; allowed is a number"),
        ({"body.hardening": {"ludwik": {"strength": 1e8, "exponent": 2}}},
         "body.hardening.ludwik.exponent: is 2; allowed is a number"),
        ("body.hardening.vocce", {}, "is no known field; the nearest is body.hardening.voce"),
        ({"body.hardening": {}},
         "body.hardening.table: is missing; allowed is at least one of table, voce"),
        ("body.hardening", 1e9, "is 1000000000.0; allowed is a table with one or several of"),
    ]),
    (FLOWING, [
        ("finite_element.element", "P3", 'is "P3" with plastic; allowed there is "P2"'),
        ({"finite_element.coupled": False, "load.friction": 0.2},
         "finite_element.coupled: is false for a body that yields under friction; allowed"),
    ]),
    (FINITE, [
        ("finite_element.element", "P1", 'is "P1" with'),
        ({"finite_element.coupled": False, "load.friction": 0.2},
         "finite_element.coupled: is false at finite deformation with friction; allowed"),
    ]),
    (HOT, [
        ("heat.speed", 0, "is 0; allowed is a speed above 0"),
        ("heat.slide_to_roll", 0, "is 0, which slides nowhere; allowed is"),
        ("heat.base", "insulated", "is given for a half-plane"),
        ("heat.coating_density", 1e3, "is given for a body without one"),
        ({"coating": COAT}, "heat.coating_conductivity: is missing; allowed is a"),
        ({"load.friction": 0.0}, "heat: is given without friction; allowed with load."),
        ({"body": {"material": "alumina"}, "heat.body_specific_heat": None},
         "heat.body_specific_heat: is missing; allowed is"),
    ]),
    (STRESSED, [
        ({"stress": None}, "heat.stresses: is true without [stress]; allowed with it"),
        ("heat.body_expansion", None, "is missing for stresses = true"),
        ("heat.body_expansion", 0.1, "is 0.1; allowed is a coeffic"),
        ({"heat.stresses": False}, "heat.body_expansion: is given without use; allowed with"),
        ("heat.coating_expansion", 1e-5, "is given for a body wit"),
        (COAT_HEAT | {"coating": COAT}, "heat.coating_expansion: is missing; allowed is a"),
        ({"body.width": "4 mm"}, "heat.stresses: is true for a body of finite width"),
        ({"finite_element.element": "P1"}, "heat.stresses: is true with linear elements; al"),
        ({"finite_element": {"deformation": "finite", "coupled": True}},
         "heat.stresses: is true beside a nonlinear body; allowed"),
    ]),
    (TRACED, [
        ("profile.kind", "sinusoid", "is given beside file; allowed is exactly one of"),
        ("profile.file", "absent.csv", "absent.csv: there is no such file"),
        ("profile.x_unit", "GPa", 'is "GPa", a pressure; allowed is a unit of length'),
        ("profile.x_unit", None,
         'is missing; allowed is a unit of length as a string, such as "um", or sp'),
        ("load.position", "40 um",
         "is 4e-05 m; allowed is inside the trace, above 0 m and below 3.9e-05 m"),
    ]),
    (MAP, [
        ({"profile.row": 1, "profile.column": 2},
         "profile.column: is given beside row; allowed is at most one of"),
        ("profile.row", -1, "is -1; allowed is a whole number from 0"),
        ("profile.line", 3, "is 3; allowed is a list of 2, each a list of 2, each a length"),
        ("profile.line", [[0, 0, 0], [1, 1]], "holds a list of 3; allowed is a list of 2, each a"),
        ("profile.line", [[0, "a"], [1, 1]], 'holds "a", which is not a number and a unit; all'),
        ("profile.line", [[0, 0], [-1, 1]], "holds -1; allowed is a length at least 0"),
        ("profile.line", [[1, 1], [1, 1]], "starts where it ends; allowed is a list of 2"),
        ("profile.cutoff", "0.8", 'is "0.8", which has no unit; allowed is a length abo'),
        ("profile.cutoff", 0, "is 0; allowed is a length above 0"),
        ("profile.short_cutoff", "auto", 'is "auto", which is not a number'),
    ]),
    (WAVY, [
        ("profile.kind", "sinus",
         'is "sinus" (did you mean "sinusoid"?); allowed is "sinusoid" or'),
        ({"profile.wavelength": "1 nm", "profile.length": "1 m"},
         "profile: the trace would have 4000001 samples; allowed is a whole number from 8"),
    ]),
    (ROUGH, [
        ({"statistics": {"metal": "steel"}}, "statistics.metal: is"),
        ({"statistics": {"traces": 1}},
         "statistics.traces: is 1; allowed is a whole number from 4 to 256"),
        ({"profile.rms_slope": 0.03},
         "profile.rms_height: is given beside rms_slope; allowed is exactly one of rms_slope, rms"),
        ({"profile.shortest_wavelength": "1 um"},
         "profile: shortest_wavelength 1e-06 m is below two sample spacings"),
        ("profile.cutoff", "3 mm", "a cut-off of 0.003 m does not suit the trace; al"),
        ("profile.short_cutoff", "1 um", "a cut-off of 1e-06 m does not suit"),
        ({"profile.cutoff": "0.1 mm", "profile.short_cutoff": "0.2 mm"}, "profile.cutoff: the "
         "short cut-off of 0.0002 m must lie below the cut-off of 0.0001 m"),
        ({"profile.length": 1e-3, "profile.cutoff": "auto"},
         "profile.cutoff: the trace of 1 mm is too short for the standard's cut-off"),
    ]),
    (TURNED, [
        ({"profile.feed": "1 mm"}, "profile: feed 0.001 m must be at most nose_radius, 0.0008 m"),
        ({"profile.samples_per_feed": 16}, "profile: samples_per_feed must be at least 132"),
        ({"profile.noise_wavelength": "5 um"}, "profile: noise_wavelength is given without noise"),
        ("profile.hurst", 0.8, 'does not belong to kind = "turned"; allowed there'),
        ("profile.length", None, 'is missing for kind = "turned"; allowed is a length'),
    ]),
    (PERIODIC, [
        ("roller.radius", 8e-3, "is given beside profile.periodic = true"),
        ({"profile.periodic": False}, "roller.radius: is missing; allowed is a length"),
        ("profile.length", 0.7e-4, "is 1.4 wavelengths; allowed is a whole"),
        ({"load.per_length": 1e5, "load.mean_pressure": 1e8},
         "load.mean_pressure: is given beside per_length"),
        ({"body.hardness": 141e6}, "load.mean_pressure: is 1.4e+08 Pa at a body.hardness"),
        ("statistics", {}, "is given for a periodic surface; allowed is none"),
        ("finite_element.deformation", "finite",
         'does not fit a periodic surface; allowed is "linear"'),
        ({"body.thickness": 1e-3, "body.base": "frictionless"},
         "load.friction: is given on a frictionless base"),
    ]),
    (SLIPPING, [
        ("partial_slip.load", 1.0, "is 1.0; allowed is a number without unit above 0 and below 1"),
        ({"partial_slip": {"loads": [0.5, -1.0]}}, "partial_slip.loads: holds -1"),
        ({"partial_slip": {"loads": []}}, "partial_slip.loads: is a list of 0"),
        ({"partial_slip": {"loads": [0], "bulk_stress": 1e8}},
         "partial_slip.bulk_stress: is given without a load"),
        ("partial_slip.loads", [0.5], "is given beside load"),
        ("partial_slip.load", None, "is missing"),
        ("partial_slip.bulk_stress", "2 m", 'is "2 m", a length; allowed is a pressure'),
        ({"load.friction": 0.0}, "partial_slip: is given without friction; allowed"),
        ({"finite_element.deformation": "finite"}, "partial_slip: is of small strains; "),
    ]),
    (SCATTERED, [
        ({"scatter": {}}, "scatter.load: is missing"),
        ("scatter.load", "0 %", 'is "0 %"; allowed is a standard deviation in per cent'),
        ("scatter.load", "40 %", "reaches -0.2"),
        ("scatter.load", 3.0, "is 3.0; allowed is a standard deviation in per cent"),
        ("scatter.samples", 100, "is 100; allowed is a power of two, as 64 or 128"),
        ("scatter.body_poissons_ratio", 0.1, "reaches"),
        ("scatter.noise", "5 nm", "is given for a smooth surface"),
        ("scatter.correlation_length", "2 um", "is given without noise"),
        ("scatter.roller_radius", {"range": ["2 mm", "1 mm"]}, "has a range from 0.002 to 0.001"),
        ("scatter.lod", "2 %", "is no known field; the nearest is scatter.load"),
        ({"load.friction": [0.0, 0.1], "scatter.friction": 0.01},
         "scatter.friction: is given for 2 coefficients; allowed with one"),
    ]),
    (PUBLISHED, [
        ("published.p0.value", "9.351", 'is "9.351", which has no unit'),
        ("published.p0.value", "9.351 mm",
         'is "9.351 mm", a length; allowed is a number and its unit'),
        ("published.p0.value", "-1 MPa", "is -1 MPa; allowed is a size above 0"),
        ("published.p0.quantity", "weight", 'is "weight"; allowed is'),
        ({"published.p0.doubtful": True}, "published.p0.note: is missing beside doubtful = true"),
        ("published.p0.sources", "x", "is no known field; the nearest is"),
    ]),
]  # fmt: skip
ROWS = [(base, *row) if len(row) == 3 else (base, "", *row) for base, rows in SAID for row in rows]


@pytest.mark.parametrize(("base", "field", "value", "said"), ROWS)
def test_the_line_names_the_field(tmp_path, monkeypatch, base, field, value, said):
    """And the scene is right without the mistake."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "trace.csv").write_text("".join(f"{x},{x * 7 % 5 / 10}\n" for x in range(40)))
    changes, line = ({field: value}, f"{field}: {said}") if field else (value, said)
    scene = resolved(base)
    with pytest.raises(SceneError) as refused:
        problem_of(scene.changed(changes), load=1e6)
    assert str(refused.value).startswith(f"made.toml: {line}")
    assert "\n" not in str(refused.value)
