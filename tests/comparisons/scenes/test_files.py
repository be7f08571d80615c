"""Finding scenes and reading them as TOML."""

import os
from pathlib import Path

import pytest

from comparisons.common.errors import SceneError
from comparisons.scenes.files import (
    SCENES,
    find_scene,
    name_of,
    read_toml,
    scene_names,
    scene_titles,
)


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
