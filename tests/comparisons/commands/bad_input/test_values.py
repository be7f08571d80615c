"""Wrong fields of a scene: the line names the field and what is allowed."""

import pytest

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


@pytest.mark.parametrize(("field", "text", "rest"), VALUES)
def test_wrong_value(folder, field, text, rest, toml, complaint):
    (folder / "scene.toml").write_text(toml({field: text}))
    line = complaint("run", "scene.toml")
    assert line.startswith(f"crosscheck: scene.toml: {field}: {rest}")
