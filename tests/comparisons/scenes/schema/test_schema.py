"""The JSON Schema of a scene: valid itself, it takes every shipped scene and what a scene may say,
and refuses a misspelt field, a wrong choice and a wrong type."""

import json

import pytest
from jsonschema import Draft202012Validator
from scenes import CONSTANTS, HOT, SMOOTH, changed, resolved

from comparisons.cli import main
from comparisons.common.errors import SceneError
from comparisons.scenes.files import benchmark_names, find_scene, read_toml, scene_names
from comparisons.scenes.scene import Scene
from comparisons.scenes.schema.json_schema import schema_for_editors

SCHEMA = schema_for_editors(Scene)
VALIDATOR = Draft202012Validator(SCHEMA)
ANSWER = {"file": "a.csv", "units": {"length": "mm"}, "columns": ["x", 2], "up": "-y"}
PROFILE = {"file": "map.npy", "spacing": "1 um", "line": [[0, "1 um"], ["4 um", 0]]}
TAKEN = [
    changed(SMOOTH, body={"law": "murnaghan", "murnaghan": CONSTANTS}),
    changed(SMOOTH, roller={"support": {"hub": "2 mm"}}),
    changed(SMOOTH, body={"yield_stress": 1e9, "hardening": {"kinematic": "1 GPa"}}),
    changed(SMOOTH, body={"yield_stress": 2e8, "hardening": {"table": [[0, 2e8], [0.1, 3e8]]}}),
    changed(SMOOTH, scatter={"load": "2 %", "body_youngs_modulus": {"range": [2e11, 3e11]}}),
    changed(SMOOTH, answers={"mine": ANSWER}),
    changed(SMOOTH, profile=PROFILE | {"cutoff": "auto"}),
    changed(
        SMOOTH, load={"friction": [0, 0.1]}, budget={"effects": "all"}, stress={"depth": "1 mm"}
    ),
    HOT,
]
REFUSED = [
    ({"roller": {"radios": 1e-3}}, "radios"),
    ({"body": {"base": "bond", "thickness": 1e-3}}, "bond"),
    ({"body": {"hardening": {"vocce": {}}, "yield_stress": 1e9}}, "vocce"),
    ({"finite_element": {"element": "P4"}}, "P4"),
    ({"roller": {"rigid": 1}}, "1"),
    ({"body": {"poissons_ratio": 0.5}}, "0.5"),
    ({"load": {"friction": "quite"}}, "quite"),
    ({"resolution": {"levels": 1}}, "1"),
    ({"answers": {"mine": {"file": "a.csv", "up": "x"}}}, "x"),
    ({"scatter": {"load": "2 m"}}, "2 m"),
    ({"coatin": {"thickness": 1e-6}}, "coatin"),
]


def test_it_is_valid_and_printed(capsys):
    Draft202012Validator.check_schema(SCHEMA)
    assert main(["scenes", "--schema"]) == 0
    assert json.loads(capsys.readouterr().out) == SCHEMA


@pytest.mark.parametrize("name", [*scene_names(), *benchmark_names()])
def test_it_takes_every_shipped_scene_as_written_and_as_resolved(name):
    VALIDATOR.validate(read_toml(find_scene(name)))
    VALIDATOR.validate(Scene.read(name).tables)


@pytest.mark.parametrize("tables", TAKEN)
def test_it_takes_what_a_scene_takes(tables):
    VALIDATOR.validate(tables)
    VALIDATOR.validate(resolved(tables).tables)


@pytest.mark.parametrize(("sections", "wrong"), REFUSED)
def test_it_refuses_what_a_scene_refuses(sections, wrong):
    tables = changed(SMOOTH, **sections)
    assert wrong in "".join(error.message for error in VALIDATOR.iter_errors(tables))
    with pytest.raises(SceneError, match=wrong):
        resolved(tables)


@pytest.mark.parametrize("missing", ["roller", "body", "load"])
def test_a_missing_section_is_refused(missing):
    tables = {name: table for name, table in SMOOTH.items() if name != missing}
    assert [error.message for error in VALIDATOR.iter_errors(tables)] == [
        f"'{missing}' is a required property"
    ]


def test_every_field_says_what_it_is_and_what_is_allowed():
    for table in (SCHEMA, *SCHEMA["$defs"].values()):
        for name, field in table["properties"].items():
            assert (
                "$ref" in field
                or "additionalProperties" in field
                or (". Allowed: " in field["description"])
            ), name
        assert table["additionalProperties"] is False
