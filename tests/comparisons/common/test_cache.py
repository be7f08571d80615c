"""Cached results: the same as saved, or none: of another key, name or state of the program."""

import json
import shutil
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

from comparisons.common.cache import Cache, kinds_of


@dataclass(frozen=True)
class Part:
    name: str
    values: tuple[float, ...]


@dataclass(frozen=True)
class Some:
    x: np.ndarray
    count: int
    parts: dict[str, Part]


@dataclass(frozen=True)
class Checked:
    count: int

    def __post_init__(self) -> None:
        self.count.bit_length()  # of None an AttributeError


VALUE = Some(np.linspace(0.0, 1.0, 50), 3, {"one": Part("a", (0.1, 2.0)), "two": Part("b", ())})


def same(cached: Some) -> bool:
    return np.array_equal(cached.x, VALUE.x) and (cached.count, cached.parts) == (3, VALUE.parts)


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    cached = Cache(tmp_path / "cache", "key", kinds_of(Some))
    cached.save("some", VALUE)
    return cached


def test_a_result_comes_back_for_its_key_and_name_alone(cache):
    assert same(cache.load("some"))
    assert replace(cache, key="other").load("some") is None
    assert cache.load("other") is None
    shutil.copy(cache.path("some"), cache.path("other"))
    assert cache.load("other") is None


EARLIER = [
    {"value": {"kind": "Gone", "fields": {}}},
    {"value": {"kind": "Some", "fields": {"x": 1.0}}},
    {"value": {"kind": "Checked", "fields": {"count": None}}},
    {"value": {"array": "a9"}},
    {"value": {"dict": 3}},
    {},
    [],
]


@pytest.mark.parametrize("outline", EARLIER, ids=str)
def test_what_an_earlier_state_of_the_program_wrote_is_none(cache, outline):
    if isinstance(outline, dict) and outline:
        outline = outline | {"key": "key"}
    np.savez(cache.path("old"), outline=np.array(json.dumps(outline)))
    assert replace(cache, kinds=cache.kinds | {"Checked": Checked}).load("old") is None


def test_without_a_folder_nothing_is_cached():
    nowhere = Cache(None, "key", {})
    nowhere.save("some", VALUE)
    assert nowhere.load("some") is None
    nowhere.discard()
