"""Finished levels of an unfinished run: where they are, and what others may do to them."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from comparisons.models import level_cache as checkpoint
from comparisons.models.level_cache import LevelCache


@pytest.fixture
def kept(tmp_path, smooth_outcome):
    """A checkpoint of a run into an existing folder, with a level to keep."""
    out = tmp_path / "out"
    out.mkdir()
    return LevelCache(out, smooth_outcome.problem.scene, smooth_outcome.plan)


@pytest.fixture
def level(smooth_outcome):
    return smooth_outcome.runs["half_plane"].levels[0]


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_levels_are_kept_inside_a_folder_that_exists(tmp_path, kept, level):
    kept.save("first", level)
    assert names(tmp_path) == ["out"]
    assert names(tmp_path / "out") == [".unfinished"]
    assert names(tmp_path / "out" / ".unfinished") == ["first.npz"]
    assert np.array_equal(kept.load("first").solution.pressure, level.solution.pressure)
    kept.discard()
    assert names(tmp_path / "out") == []


def test_a_folder_that_another_run_removed_is_made_again(kept, level, monkeypatch):
    savez = np.savez

    def after_the_other_ended(part, **arrays):
        monkeypatch.setattr(np, "savez", savez)
        shutil.rmtree(kept.folder)
        savez(part, **arrays)

    monkeypatch.setattr(np, "savez", after_the_other_ended)
    kept.save("first", level)
    assert names(kept.folder) == ["first.npz"]


def test_two_runs_do_not_write_the_same_part(kept, level, monkeypatch):
    parts = []
    savez = np.savez
    monkeypatch.setattr(np, "savez", lambda part, **a: (parts.append(part), savez(part, **a)))
    for process in (11, 12):
        monkeypatch.setattr("os.getpid", lambda process=process: process)
        kept.save("first", level)
    assert len(set(parts)) == 2
    assert names(kept.folder) == ["first.npz"]


def test_discarding_twice_is_no_error(kept, level):
    kept.save("first", level)
    kept.discard()
    kept.discard()
    assert kept.load("first") is None


def test_one_process_of_several_keeps_levels(kept, level, monkeypatch):
    monkeypatch.setenv("PMIX_RANK", "1")
    kept.save("first", level)
    assert not kept.folder.exists()
    monkeypatch.setenv("PMIX_RANK", "0")
    kept.save("first", level)
    monkeypatch.setenv("PMIX_RANK", "1")
    kept.discard()
    assert names(kept.folder) == ["first.npz"]


def test_the_key_follows_the_code_and_not_its_text(tmp_path, monkeypatch):
    def key(text):
        (tmp_path / "analytic").mkdir(exist_ok=True)
        (tmp_path / "analytic/law.py").write_text(text)
        return checkpoint.program_code()

    monkeypatch.setattr(checkpoint, "SOURCES", tmp_path)
    law = '"""A law."""\n\ndef half(x):\n    """Of x."""\n    return x / 2\n'
    told = '"""Halves."""\n\n\ndef half(x):  # of x\n    """Half of x."""\n\n    return x / 2\n'
    assert key(told) == key(law)
    assert key(law.replace("2", "3")) != key(law)
    assert key(law.replace("x / 2", "2 * x")) != key(law)
