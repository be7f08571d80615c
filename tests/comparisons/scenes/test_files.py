"""Finding scenes and reading them as TOML; those that come along can be written out again."""

import json
import os
from pathlib import Path

import numpy as np
import pytest

from analytic.exact.hertz import hertz_from_load
from analytic.material import combined_modulus
from comparisons.common.errors import SceneError
from comparisons.scenes.files import (
    SCENES,
    find_scene,
    name_of,
    read_toml,
    scene_names,
    scene_titles,
)
from comparisons.scenes.scene import Origin, Scene
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
