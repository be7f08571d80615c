"""Scenes that cannot be: one line that names the field, what it is, and what is allowed."""

import pytest
from scenes import BOTH_CONDUCT, SMOOTH, STEEL, changed, resolved

from comparisons.common.errors import SceneError
from comparisons.scenes.surface import surface_of

ROUGH = {"kind": "self-affine", "hurst": 0.8, "rms_height": 3e-6, "samples": 2001, "length": 4e-3}
TURNED = {"kind": "turned", "feed": "0.1 mm", "nose_radius": "0.8 mm", "length": "4 mm"}
MAP = {"file": "map.npy", "spacing": "1 um", "z_unit": "nm"}
CONSTANTS = {"l": "-150 GPa", "m": -600e9, "n": -700e9}
COAT = {"thickness": 1e-5, "youngs_modulus": 4e11, "poissons_ratio": 0.2}

RIGID = SMOOTH | {"roller": {"radius": 8e-3, "rigid": True}}
YIELDING = changed(SMOOTH, body={"yield_stress": 2e8})
HOT = changed(SMOOTH, load={"friction": 0.1}, heat={"speed": "1 m/s", **BOTH_CONDUCT})
STRESSED = changed(HOT, heat={"stresses": True, "body_expansion": "12 um/m/K"}, stress={})

# base, fields that change, how the line goes on after "made.toml: "
SOLIDS = [
    (SMOOTH, {"body.yield_stress": 0}, "body.yield_stress: is 0; allowed is a pressure above 0"),
    (SMOOTH, {"body.hardening_modulus": 1e9}, "body.hardening_modulus: is given for a body that"),
    (SMOOTH, {"body.hardening": {"kinematic": 1e9}}, "body.hardening: is given for a body that"),
    (
        SMOOTH,
        {"body.thickness": 1e-5, "coating": {"thickness": 1e-5, **STEEL}},
        "coating.thickness: is 1e-05 m on a body of 1e-05 m",
    ),
    (
        SMOOTH,
        {"coating": {"thickness": 2e-6, "material": "DLC"}},
        "coating.poissons_ratio: is missing",
    ),
    (SMOOTH, {"body.law": "henky"}, 'body.law: is "henky" (did you mean "hencky"'),
    (SMOOTH, {"body.law": "linear"}, "roller.law: is missing beside a linear one; allowed is"),
    (SMOOTH, {"body.law": "murnaghan"}, "body.murnaghan: is missing; allowed is a table"),
    (SMOOTH, {"roller.murnaghan": CONSTANTS}, "roller.murnaghan: is given for another law"),
    *(
        (SMOOTH, {"body.law": "murnaghan", "body.murnaghan": wrong}, f"body.murnaghan.{complaint}")
        for wrong, complaint in (
            ({"l": 1.0, "m": 1.0}, "n: is missing; allowed is a pressure"),
            ({**CONSTANTS, "k": 1.0}, "k: is no known field; the nearest is body.murnaghan."),
            ({**CONSTANTS, "n": "1 mm"}, 'n: is "1 mm", a length; allowed is a pressure'),
        )
    ),
    *(
        (YIELDING, {"body.hardening": law}, f"body.hardening{complaint}")
        for law, complaint in (
            ({"table": [[0, 2e8], [0.1, 1e8]]}, ": is no law: a hardening table must not soften"),
            ({"table": [[0, 2e8], [0.1]]}, ".table: holds a list of 1; allowed is a list of 2"),
            ({"table": []}, ".table: is a list of 0; allowed is a list of 2 to 1000, each a"),
            ({"voce": {"saturated": 3e8}}, ".voce.rate: is missing; allowed is a number"),
            (
                {"ludwik": {"strength": 1e8, "exponent": 2}},
                ".ludwik.exponent: is 2; allowed is a number",
            ),
            ({"vocce": {}}, ".vocce: is no known field; the nearest is body.hardening.voce"),
            ({}, ".table: is missing; allowed is at least one of table, voce"),
            (1e9, ": is 1000000000.0; allowed is a table with one or several of"),
        )
    ),
    (
        SMOOTH,
        {"body": {"material": "carbn steel"}},
        'body.material: is "carbn steel", which is no known solid; did you mean "carbon steel"?',
    ),
    (SMOOTH, {"body": {"material": 7}}, "body.material: is 7, which is no known solid; allowed is"),
    (
        SMOOTH,
        {"body": {"material": "100Cr6", "law": "murnaghan"}},
        "body.murnaghan: is missing",
    ),
]
ROLLERS = [
    (RIGID, {"roller.law": "hencky"}, "roller.law: is given beside rigid"),
    (RIGID, {"roller.material": "100Cr6"}, "roller.material: is given beside rigid = true"),
    (RIGID, {"roller.support": "opposite"}, "roller.support: is given beside rigid = true"),
    (SMOOTH, {"roller.support": "oposite"}, 'roller.support: is "oposite" (did you mean "opposite'),
    (SMOOTH, {"roller.support": {"hub": "9 mm"}}, "roller.support: has a hub of 0.009 m; allowed"),
    (SMOOTH, {"roller.support": {"shaft": "2 mm"}}, "roller.support.shaft: is no known field; the"),
    (SMOOTH, {"roller.support": {"hub": 0.0}}, "roller.support.hub: is 0.0; allowed is a length"),
    (
        SMOOTH,
        {"body.thickness": 1e-3, "load.approach": 1e-6},
        "load.approach: has no meaning for an elastic roller",
    ),
]
SOLVING = [
    (
        RIGID,
        {"finite_element.roller_body": "disc"},
        'finite_element.roller_body: is "disc", but the roller is rigid; allowed',
    ),
    (
        SMOOTH,
        {"finite_element.plastic": True},
        "finite_element.plastic: is true, but the body has no yield stress; allowed",
    ),
    (
        YIELDING,
        {"finite_element": {"plastic": True, "element": "P3"}},
        'finite_element.element: is "P3" with plastic; allowed there is "P2"',
    ),
    (
        YIELDING,
        {"finite_element": {"plastic": True, "coupled": False}, "load.friction": 0.2},
        "finite_element.coupled: is false for a body that yields under friction; allowed",
    ),
    (
        RIGID,
        {"finite_element": {"deformation": "finite", "element": "P1"}},
        'finite_element.element: is "P1" with',
    ),
    (
        RIGID,
        {"finite_element": {"deformation": "finite", "coupled": False}, "load.friction": 0.2},
        "finite_element.coupled: is false at finite deformation with friction; allowed",
    ),
    (
        SMOOTH,
        {"resolution": {"pitch": "1 um", "elements": 8}},
        "resolution.elements: is given beside pitch; allowed is at most one of",
    ),
]
HEAT = [
    (HOT, {"heat.speed": 0}, "heat.speed: is 0; allowed is a speed above 0"),
    (HOT, {"heat.slide_to_roll": 0}, "heat.slide_to_roll: is 0, which slides nowhere; allowed is"),
    (HOT, {"heat.base": "insulated"}, "heat.base: is given for a half-plane"),
    (HOT, {"heat.coating_density": 1e3}, "heat.coating_density: is given for a body without one"),
    (HOT, {"coating": COAT}, "heat.coating_conductivity: is missing; allowed is a"),
    (HOT, {"load.friction": 0.0}, "heat: is given without friction; allowed with load."),
    (
        HOT,
        {"body": {"material": "alumina"}, "heat.body_specific_heat": None},
        "heat.body_specific_heat: is missing; allowed is",
    ),
    (STRESSED, {"stress": None}, "heat.stresses: is true without [stress]; allowed with it"),
    (
        STRESSED,
        {"heat.body_expansion": None},
        "heat.body_expansion: is missing for stresses = true",
    ),
    (STRESSED, {"heat.body_expansion": 0.1}, "heat.body_expansion: is 0.1; allowed is a coeffic"),
    (STRESSED, {"heat.stresses": False}, "heat.body_expansion: is given without use; allowed with"),
    (STRESSED, {"heat.coating_expansion": 1e-5}, "heat.coating_expansion: is given for a body wit"),
    (
        STRESSED,
        {"coating": COAT}
        | {f"heat.coating_{name}": 10.0 for name in ("conductivity", "density", "specific_heat")},
        "heat.coating_expansion: is missing; allowed is a",
    ),
    (STRESSED, {"body.width": "4 mm"}, "heat.stresses: is true for a body of finite width"),
    (STRESSED, {"finite_element.element": "P1"}, "heat.stresses: is true with linear elements; al"),
    (
        STRESSED,
        {"finite_element": {"deformation": "finite", "coupled": True}},
        "heat.stresses: is true beside a nonlinear body; allowed",
    ),
]
PROFILES = [
    *(
        (MAP, changes, f"profile.{complaint}")
        for changes, complaint in (
            ({"row": 1, "column": 2}, "column: is given beside row; allowed is at most one of"),
            ({"row": -1}, "row: is -1; allowed is a whole number from 0"),
            ({"line": 3}, "line: is 3; allowed is a list of 2, each a list of 2, each a length"),
            (
                {"line": [[0, 0, 0], [1, 1]]},
                "line: holds a list of 3; allowed is a list of 2, each a",
            ),
            (
                {"line": [[0, "a"], [1, 1]]},
                'line: holds "a", which is not a number and a unit; all',
            ),
            ({"line": [[0, 0], [-1, 1]]}, "line: holds -1; allowed is a length at least 0"),
            ({"line": [[1, 1], [1, 1]]}, "line: starts where it ends; allowed is a list of 2"),
            ({"cutoff": "0.8"}, 'cutoff: is "0.8", which has no unit; allowed is a length abo'),
            ({"cutoff": 0}, "cutoff: is 0; allowed is a length above 0"),
            ({"short_cutoff": "auto"}, 'short_cutoff: is "auto", which is not a number'),
        )
    ),
    (ROUGH, {"cutoff": "3 mm"}, "profile.cutoff: a cut-off of 0.003 m does not suit the trace; al"),
    (ROUGH, {"short_cutoff": "1 um"}, "profile.short_cutoff: a cut-off of 1e-06 m does not suit"),
    (
        ROUGH,
        {"cutoff": "0.1 mm", "short_cutoff": "0.2 mm"},
        "profile.cutoff: the short cut-off of 0.0002 m must lie below the cut-off of 0.0001 m",
    ),
    (
        ROUGH,
        {"length": 1e-3, "cutoff": "auto"},
        "profile.cutoff: the trace of 1 mm is too short for the standard's cut-off",
    ),
    (TURNED, {"feed": "1 mm"}, "profile: feed 0.001 m must be at most nose_radius, 0.0008 m"),
    (TURNED, {"samples_per_feed": 16}, "profile: samples_per_feed must be at least 132"),
    (TURNED, {"noise_wavelength": "5 um"}, "profile: noise_wavelength is given without noise"),
    (TURNED, {"hurst": 0.8}, 'profile.hurst: does not belong to kind = "turned"; allowed there'),
    (
        TURNED,
        {"length": None},
        'profile.length: is missing for kind = "turned"; allowed is a length',
    ),
]
OF_PROFILES = [
    (SMOOTH | {"profile": base}, {f"profile.{name}": value for name, value in changes.items()}, why)
    for base, changes, why in PROFILES
]


@pytest.mark.parametrize(
    ("base", "changes", "complaint"), [*SOLIDS, *ROLLERS, *SOLVING, *HEAT, *OF_PROFILES]
)
def test_the_line_names_the_field(base, changes, complaint):
    scene = resolved(base)
    with pytest.raises(SceneError) as refused:
        surface_of(scene.changed(changes))
    assert str(refused.value).startswith(f"made.toml: {complaint}")
    assert "\n" not in str(refused.value)
