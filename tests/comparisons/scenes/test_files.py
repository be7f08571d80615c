"""Finding scenes and reading them as TOML; those that come along can be written out again.
Fields that are set beside a scene's file: as the file would have them, or refused in a line."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from scenes import QUICK, SMOOTH, changed, resolved, run_of

from analytic.exact.hertz import hertz_from_load
from analytic.material import combined_modulus
from comparisons.common.errors import InputError, SceneError
from comparisons.scenes.files import (
    SCENES,
    find_scene,
    name_of,
    read_toml,
    scene_names,
    scene_titles,
    value_of,
)
from comparisons.scenes.scene import Origin, Scene, with_settings, with_tolerance
from comparisons.scenes.surface import surface_of


def test_the_scenes_that_come_along():
    assert scene_names() == sorted(scene_names())
    titles = scene_titles()
    assert list(titles) == scene_names()
    assert len(set(titles.values())) == len(titles)


def test_a_path_is_taken_as_it_is(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text("a = 1")
    (tmp_path / "no_ending").write_text("a = 1")
    assert os.fspath(find_scene("mine.toml")) == "mine.toml"
    assert find_scene(tmp_path / "mine.toml") == tmp_path / "mine.toml"
    assert os.fspath(find_scene("no_ending")) == "no_ending"


def test_a_name_wins_over_a_file_called_the_same(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "smooth").write_text("a = 1")
    assert find_scene("smooth") == SCENES / "smooth.toml"
    assert find_scene("./smooth").samefile(tmp_path / "smooth")


@pytest.mark.parametrize(
    ("wrong", "nearest"),
    [("smoth", "smooth"), ("selfaffine", "self-affine"), ("ground_run_in", "ground-run-in")],
)
def test_an_unknown_name_is_answered_with_the_nearest(wrong, nearest):
    with pytest.raises(SceneError, match=f"the nearest scene is {nearest}, all are") as caught:
        find_scene(wrong)
    assert all(name in str(caught.value) for name in scene_names())


def test_byte_order_mark_and_windows_lines(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_bytes("\ufefftitle = 'a'\r\n[load]\r\nfriction = 0.1\r\n".encode())
    assert read_toml(path) == {"title": "a", "load": {"friction": 0.1}}


def test_a_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.toml")
    with pytest.raises(SceneError, match="is not a regular file"):
        read_toml(tmp_path / "pipe.toml")


@pytest.mark.parametrize(
    "key", ["a." * 100_000 + "a", "a . " * 33 + "a", "[a" + ".a" * 40 + "]\nb"]
)
def test_a_key_of_many_parts_is_refused_before_it_is_read(tmp_path, key, monkeypatch):
    monkeypatch.setattr("tomllib.loads", lambda text: pytest.fail("read"))
    (tmp_path / "scene.toml").write_text(f"{key} = 1")
    with pytest.raises(SceneError, match="has a key of more than 32 parts"):
        read_toml(tmp_path / "scene.toml")


@pytest.mark.parametrize(
    "value", ['"' + "a." * 100 + '"', "1 # " + "a." * 100, "'" + "a." * 100 + "'", "'''\na.a'''"]
)
def test_dots_in_texts_and_comments_are_no_key(tmp_path, value):
    (tmp_path / "scene.toml").write_text(f"a = {value}\n")
    assert list(read_toml(tmp_path / "scene.toml")) == ["a"]


@pytest.mark.parametrize(
    ("file", "name"),
    [(b"sc\xe9ne.toml", "sc\ufffdne"), ("scène.toml".encode(), "scène"), (b"a\nb.toml", "a b")],
)
def test_a_file_is_named_in_text_whatever_bytes_name_it(file, name):
    assert name_of(Path(os.fsdecode(file))) == name


def test_scenes_of_the_ground_disc_share_their_load():
    """p0 = 4.15 GPa and a = 544.6 um, half of the trace: Bailey and Sayles (1991)."""
    for name in ("smooth", "smooth-sliding", "ground-unrun", "ground-run-in", "ground-polished"):
        scene = Scene.read(name)
        modulus = combined_modulus(scene.roller.material, scene.body.material)
        hertz = hertz_from_load(scene.load.value, scene.roller.radius, modulus)
        assert hertz.peak_pressure == pytest.approx(4.15e9, rel=1e-5)
        assert hertz.half_width == pytest.approx(544.578e-6, rel=1e-5)
        if scene.profile is not None:
            surface = surface_of(scene)
            assert surface.position == 1118e-6
            assert surface.profile.x[[0, -1]] == pytest.approx([-1118e-6, 1118e-6], rel=1e-12)
            assert surface.info.samples == 2237


@pytest.mark.parametrize("name", scene_names())
def test_written_out_tables_give_the_scene_again_and_survive_json(name):
    scene = Scene.read(name)
    assert scene.name == name != scene.title
    assert scene.stress is not None or scene.heat is not None
    surface = surface_of(scene)
    tables = surface.completed(scene.tables)
    again = Scene.of(json.loads(json.dumps(tables)), Origin(name, SCENES))
    assert again.tables == tables
    if scene.profile is not None:
        traced = surface_of(again).profile
        assert np.array_equal(traced.x, surface.profile.x)
        assert np.array_equal(traced.height, surface.profile.height)
    plain = surface.as_dict(scene)
    assert json.loads(json.dumps(plain, allow_nan=False)) == plain
    assert plain["name"] == name and plain["title"] == scene.title
    assert plain["roller"].get("radius", np.inf) == scene.roller.radius
    assert plain["load"]["position"] == surface.position
    assert plain["load"]["friction"] == list(scene.load.friction)
    assert (plain["profile"] is None) == (scene.profile is None)
    assert len(json.dumps(plain)) < 4000


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
