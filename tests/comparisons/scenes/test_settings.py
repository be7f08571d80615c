"""Fields that are set beside a scene's file: as the file would have them, or refused in a line."""

import json

import pytest
from scenes import QUICK, SMOOTH, changed, resolved, run_of

from comparisons.common.errors import InputError
from comparisons.scenes.files import scene_names, value_of
from comparisons.scenes.scene import Scene, with_settings, with_tolerance


@pytest.mark.parametrize("name", scene_names())
def test_every_field_may_be_set(name):
    """Of a scene as it is resolved: the values of a table's fields, one by one, change nothing."""
    scene = Scene.read(name)
    for section, table in scene.tables.items():
        for field, value in table.items() if isinstance(table, dict) else ():
            if not isinstance(value, dict):
                text = f"{section}.{field}={json.dumps(value)}"
                assert with_settings(scene, [text]).tables == scene.tables, text


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1.2 GPa", "1.2 GPa"),
        ('"1.2 GPa"', "1.2 GPa"),
        ("true", True),
        ("1_000", 1000),
        ("1e5", 1e5),
        (".5", 0.5),
        ("[0, 0.1]", [0, 0.1]),
        ('{hub = "2 mm"}', {"hub": "2 mm"}),
        ("half disc", "half disc"),
        ("1\nother = 2", "1\nother = 2"),
        ("１２", "１２"),
    ],
)
def test_values_are_those_of_toml_or_the_text_itself(text, value):
    assert value_of(text) == value and type(value_of(text)) is type(value)


def test_several_are_taken_together_and_short_names_are_the_loads():
    settings = ["body.yield_stress=1.2 GPa", "finite_element.plastic=true", "load=1e6"]
    changed = with_settings(resolved(QUICK), [*settings, "friction=[0, 0.1]"])
    assert (changed.body.yield_stress, changed.finite_element.plastic) == (1.2e9, True)
    assert (changed.load.per_length, changed.load.friction) == (1e6, (0.0, 0.1))
    assert with_settings(changed, ["load.hertz_peak_pressure=1 GPa"]).load.per_length is None
    assert changed.named.endswith("--set load=1e6 --set 'friction=[0, 0.1]'")


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (["body.yeild_stress=1 GPa"], "the nearest is body.yield_stress"),
        (["yield_stress=1 GPa"], "the nearest is body.yield_stress"),
        (["body.yield_stress=1 m"], 'body.yield_stress: is "1 m", a length; allowed is'),
        (["title.x=1"], "title is no table"),
        (["body.yield_stress"], '--set: is "body.yield_stress"; allowed is FIELD=VALUE'),
        (["body.yield_stress= "], "allowed is FIELD=VALUE, with FIELD as in"),
        (["a." * 5000 + "b=1"], "allowed is FIELD=VALUE"),
        (["friction=0", "load.friction=0.1"], "--set: load.friction is given twice"),
        (["finite_element.plastic=true"], "is true, but the body has no yield stress"),
        (["load=[" * 5000], "is not a number and a unit"),
    ],
)
def test_what_is_wrong_is_one_line(settings, said):
    with pytest.raises(InputError) as refused:
        with_settings(resolved(QUICK), settings)
    assert said in str(refused.value) and "\n" not in str(refused.value)


@pytest.mark.parametrize("command", ["run", "cost", "map", "sweep", "deck"])
def test_every_command_that_takes_a_scene_refuses_it_and_writes_nothing(
    command, tmp_path, monkeypatch, complaint
):
    monkeypatch.chdir(tmp_path)
    needed = {"sweep": ["--over", "load=1e5,2e5"], "deck": ["--for", "calculix"]}
    asked = [command, "smooth", *needed.get(command, ()), "--set", "body.yeild_stress=1e9"]
    said = "smooth: body.yeild_stress: is no known field; the nearest is body.yield_stress"
    assert said in complaint(*asked)


def test_a_tolerance_replaces_each_that_the_scene_has():
    tightened = with_tolerance(Scene.read("smooth"), 0.005)
    judged = "peak_pressure", "contact_length", "tau1_max"
    assert tightened.tolerances == dict.fromkeys(judged, 5e-3)
    assert tightened.tables["tolerance"] == tightened.tolerances


def test_refinement_stops_where_the_tolerance_is_met():
    coarse = resolved(changed(SMOOTH, resolution={"pitch": 1e-4}))
    levels = []
    for tolerance in (0.2, 2e-3):
        outcome = run_of(with_tolerance(coarse, tolerance), "half_plane")
        assert outcome.solved.refinement == "every judged quantity is resolved"
        levels.append(len(outcome.runs["half_plane"].levels))
    assert levels[0] == 3 < levels[1]
