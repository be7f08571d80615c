"""The [finite_element] switches: what follows from others, what they refuse, and what is said."""

import copy
from pathlib import Path

import pytest

from analytic.material import Law
from analytic.material.hardening import Hardening
from comparisons.common.errors import SceneError
from comparisons.models.assumptions import assumptions_of
from comparisons.models.posing import problem_of
from comparisons.scenes.scene import Origin, Scene

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
ELASTIC = {
    "roller": {"radius": 8e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"per_length": 1e6, "friction": 0.2},
}
RIGID = {**ELASTIC, "roller": {"radius": 8e-3, "rigid": True}}


def scene_of(tables: dict, finite_element: dict | None = None, **sections: dict):
    tables = copy.deepcopy(tables)
    for name, fields in {**sections, "finite_element": finite_element or {}}.items():
        merged = {**tables.get(name, {}), **fields}
        tables[name] = {key: value for key, value in merged.items() if value is not None}
    return Scene.of(tables, Origin("mine", Path("."), "mine.toml"))


@pytest.mark.parametrize(
    ("as_written", "follows"),
    [
        ({}, {"gap": "reference", "block": 400.0}),
        ({"block": 40}, {"block": 40.0}),
    ],
)
def test_what_follows_from_other_fields(as_written, follows):
    settings = scene_of(ELASTIC, as_written).finite_element
    assert {name: getattr(settings, name) for name in follows} == follows


@pytest.mark.parametrize(
    ("ratio", "as_written", "element"),
    [
        (0.49, {}, "P2"),
        (0.4901, {}, "P3"),
        (0.4999, {"element": "P2"}, "P2"),
        (0.4999, {"deformation": "finite", "coupled": True}, "P2"),
    ],
)
def test_elements_are_cubic_near_incompressibility(ratio, as_written, element):
    tables = {**RIGID, "body": {**STEEL, "poissons_ratio": ratio}}
    assert scene_of(tables, as_written).finite_element.element == element


WAVE = {"kind": "sinusoid", "wavelength": 5e-5, "amplitude": 1e-7}


def test_a_rough_boundary_is_met_where_it_has_come_to():
    assert scene_of(ELASTIC, {"geometry": "rough"}, profile=WAVE).finite_element.gap == "displaced"
    kept = scene_of(ELASTIC, {"geometry": "rough", "gap": "reference"}, profile=WAVE)
    assert kept.finite_element.gap == "reference"


@pytest.mark.parametrize(("profile", "boundary"), [(WAVE, "rough"), (None, "flat")])
def test_finite_deformation_takes_the_boundary_that_there_is(profile, boundary):
    sections = {} if profile is None else {"profile": profile}
    assert (
        scene_of(RIGID, {"deformation": "finite"}, **sections).finite_element.geometry == boundary
    )
    assert scene_of(RIGID, {}, **sections).finite_element.geometry == "flat"


@pytest.mark.parametrize("switches", [{"deformation": "finite"}, {"plastic": True}])
def test_several_friction_coefficients_couple_where_each_moves_the_contact(switches):
    body, load = {"yield_stress": 1e9}, {"friction": [0.0, 0.1]}
    assert scene_of(RIGID, switches, body=body, load=load).finite_element.coupled


def test_a_body_that_yields():
    steel = {"yield_stress": "2.5 GPa", "hardening_modulus": "1 GPa"}
    scene = scene_of(RIGID, {"plastic": True, "coupled": True}, body=steel)
    assert (scene.body.yield_stress, scene.body.hardening_modulus) == (2.5e9, 1e9)


@pytest.mark.parametrize("load", [False, True])
@pytest.mark.parametrize("coupled_there", [None, False, True])
def test_coupling_is_that_of_the_load_unless_it_is_said(load, coupled_there):
    as_written = {} if coupled_there is None else {"coupled": coupled_there}
    scene = scene_of(RIGID, as_written, load={"coupled": load})
    assert scene.load.coupled == load
    assert scene.finite_element.coupled == (load if coupled_there is None else coupled_there)


@pytest.mark.parametrize(
    ("tables", "as_written", "sections", "complaint"),
    [
        (RIGID, {"roller_body": "disc"}, {}, 'roller_body: is "disc", but the roller is rigid'),
        (ELASTIC, {"plastic": True}, {}, "plastic: is true, but the body has no yield stress"),
        (
            ELASTIC,
            {"plastic": True, "element": "P3"},
            {"body": {"yield_stress": 1e9}},
            'element: is "P3" with plastic; allowed there is "P2"',
        ),
        (RIGID, {"deformation": "finite", "element": "P1"}, {}, 'element: is "P1" with'),
        (
            RIGID,
            {"deformation": "finite", "geometry": "flat"},
            {"profile": WAVE},
            'geometry: is "flat" at finite deformation',
        ),
        (
            RIGID,
            {"deformation": "finite", "coupled": False},
            {},
            "coupled: is false at finite deformation",
        ),
        (ELASTIC, {"geometry": "rough"}, {}, 'geometry: is "rough" for a smooth body'),
        (
            ELASTIC,
            {"plastic": True, "coupled": False},
            {"body": {"yield_stress": 1e9}},
            "coupled: is false for a body that yields",
        ),
    ],
)
def test_refusals_name_the_field_and_what_is_allowed(tables, as_written, sections, complaint):
    with pytest.raises(SceneError) as refused:
        scene_of(tables, as_written, **sections)
    message = str(refused.value)
    assert message.startswith("mine.toml: finite_element.") and message.count("\n") == 0
    assert complaint in message and "allowed" in message


CONSTANTS = {"l": "-150 GPa", "m": -600e9, "n": -700e9}


def test_laws_of_elasticity_are_the_bodies_own():
    """And come back from the record as they were."""
    law = {"law": "murnaghan", "murnaghan": CONSTANTS}
    scene = scene_of(ELASTIC, body=law, roller={"law": "hencky"})
    assert scene.body.material.law == Law("murnaghan", (-150e9, -600e9, -700e9))
    assert scene.roller.material.law == Law("hencky")
    again = Scene.of(scene.tables, Origin("mine", Path("."), "mine.toml"))
    assert (again.body, again.roller) == (scene.body, scene.roller)
    assert scene_of(ELASTIC).body.material.law.name == "neo-hookean"


def test_laws_of_hardening_are_read_with_their_units_and_come_back():
    table = {"table": [[0, "280 MPa"], [0.05, "340 MPa"]], "kinematic": "1 GPa"}
    scene = scene_of(ELASTIC, body={"yield_stress": "280 MPa", "hardening": table})
    law = scene.body.flow_stress()
    assert law == Hardening(280e6, table=((0.0, 280e6), (0.05, 340e6)), kinematic=1e9)
    again = Scene.of(scene.tables, Origin("mine", Path("."), "mine.toml"))
    assert again.body == scene.body
    voce = {"voce": {"rate": 12, "saturated": "400 MPa"}}
    scene = scene_of(ELASTIC, body={"yield_stress": "280 MPa", "hardening": voce})
    assert scene.body.flow_stress().voce == (400e6, 12.0)


@pytest.mark.parametrize(
    ("sections", "complaint"),
    [
        ({"body": {"hardening_modulus": 1e9}}, "body.hardening_modulus: is given for a body that"),
        ({"body": {"hardening": {"kinematic": 1e9}}}, "body.hardening: is given for a body that"),
        *(
            ({"body": {"yield_stress": 2e8, "hardening": law}}, f"body.hardening: {complaint}")
            for law, complaint in (
                ({"table": [[0, 2e8], [0.1, 1e8]]}, "is no law: a hardening table must not soften"),
                ({"table": [[0.1, 2e8], [0.2, 3e8]]}, "is no law: a hardening table begins at"),
                ({"table": [[0, 3e8], [0.2, 4e8]]}, "is no law: a hardening table begins at"),
                ({"table": [[0, 2e8], [0, 3e8]]}, "is no law: plastic strains of a hardening"),
                ({"table": [[0, 2e8], [0.1]]}, "has a row a list of its table"),
                ({"table": []}, "has a table of 0 rows"),
                ({"voce": {"saturated": 1e8, "rate": 3}}, "is no law: Voce's law wants"),
                ({"voce": {"saturated": 3e8}}, "has voce = a table, not saturated and rate"),
                ({"ludwik": {"strength": 1e8, "exponent": 2}}, "is 2; allowed is a number"),
                ({"vocce": {}}, 'holds "vocce" .did you mean "voce"'),
                ({}, "is a table; allowed"),
                (1e9, "is 1000000000.0; allowed is a table with one of"),
                (
                    {"ludwik": {"strength": 1e8, "exponent": 0.5}, "table": [[0, 2e8], [1, 3e8]]},
                    "is no law: a metal hardens by one of",
                ),
            )
        ),
        ({"body": {"yield_stress": 0}}, "body.yield_stress: is 0; allowed is a pressure above 0"),
        (
            {
                "body": {"thickness": 1e-3},
                "load": {"per_length": None, "approach": 1e-6, "friction": 0.0},
            },
            "load.approach: has no meaning for an elastic roller",
        ),
        (
            {"body": {"thickness": 1e-5}, "coating": {"thickness": 1e-5, **STEEL}},
            "coating.thickness: is 1e-05 m on a body of 1e-05 m",
        ),
        ({"coating": {"thickness": 0.0, **STEEL}}, "coating.thickness: is 0"),
        ({"body": {"law": "henky"}}, r'body.law: is "henky" \(did you mean "hencky"'),
        ({"body": {"law": "murnaghan"}}, "body.murnaghan: is missing; allowed is a table"),
        ({"roller": {"murnaghan": CONSTANTS}}, "roller.murnaghan: is given for another law"),
        (
            {"body": {"law": "murnaghan", "murnaghan": {"l": 1.0, "m": 1.0}}},
            'body.murnaghan: lacks "n"',
        ),
        (
            {"body": {"law": "murnaghan", "murnaghan": {**CONSTANTS, "k": 1.0}}},
            'body.murnaghan: holds "k"',
        ),
        (
            {"body": {"law": "murnaghan", "murnaghan": {**CONSTANTS, "n": "1 mm"}}},
            'body.murnaghan: is "1 mm"',
        ),
        (
            {
                "roller": {
                    "rigid": True,
                    "law": "hencky",
                    "youngs_modulus": None,
                    "poissons_ratio": None,
                }
            },
            "roller.law: is given beside rigid",
        ),
        (
            {"roller": {"support": "oposite"}},
            r'roller.support: is "oposite" \(did you mean "opposite"\?\); allowed is "opposite", ',
        ),
        ({"roller": {"support": {"hub": "9 mm"}}}, "roller.support: has a hub of 0.009 m; allowed"),
        ({"roller": {"support": {"shaft": "2 mm"}}}, 'roller.support: holds "shaft"'),
        (
            {"roller": {"support": {"hub": 0.0}}},
            r"roller.support: is 0\.0; allowed is a length above",
        ),
        (
            {
                "roller": {"rigid": True, "youngs_modulus": None, "poissons_ratio": None}
                | {"support": "opposite"}
            },
            "roller.support: is given beside rigid = true; allowed is one of the two",
        ),
        (
            {"resolution": {"pitch": "1 um", "elements": 8}},
            "resolution.elements: is given beside pitch; allowed is one of the two",
        ),
    ],
)
def test_bodies_that_cannot_be(sections, complaint):
    with pytest.raises(SceneError, match=complaint):
        scene_of(ELASTIC, **sections)


@pytest.mark.parametrize("support", ["opposite", "half disc", {"hub": "2 mm"}])
def test_a_support_of_the_roller_comes_back_as_it_was_given(support):
    scene = scene_of(ELASTIC, roller={"support": support})
    written = scene.tables["roller"]["support"]
    assert written == (support if isinstance(support, str) else {"hub": 2e-3})
    assert type(scene).of(scene.tables).roller.support == scene.roller.support
    disc = scene.changed("finite_element.roller_body", "disc")
    spoken = "\n".join(assumptions_of(problem_of(disc)))
    assert "held" in spoken and "not given: roller.support" not in spoken


@pytest.mark.parametrize(
    ("as_written", "said", "unsaid"),
    [
        ({}, "the gap is on the undeformed surface", "finite elements:"),
        ({"gap": "displaced"}, "the deformed one, and the pressure acts along the roller's", None),
        ({"roller_shape": "circle"}, "finite elements: it is an exact circle", "disc"),
        ({"roller_body": "disc"}, "finite elements: it is an elastic body of finite", None),
        ({"coupled": True}, "finite elements: the sliding traction moves the surfaces", None),
    ],
)
def test_assumptions_say_what_is_dropped(as_written, said, unsaid):
    tables = {**ELASTIC, "body": {**STEEL, "poissons_ratio": 0.2}}
    spoken = "\n".join(assumptions_of(problem_of(scene_of(tables, as_written))))
    assert said in spoken
    assert unsaid is None or unsaid not in spoken


@pytest.mark.parametrize(("thickness", "exact"), [(None, True), (1e-3, False)])
def test_friction_is_without_effect_on_half_planes_alone(thickness, exact):
    """Of like bodies: a layer's surface is moved by it."""
    body = STEEL if thickness is None else {**STEEL, "thickness": thickness}
    tables = {**ELASTIC, "body": body, "load": {**ELASTIC["load"], "friction": 0.1}}
    [spoken] = [s for s in assumptions_of(problem_of(scene_of(tables))) if "traction" in s]
    assert ("Dundurs" in spoken) is exact
