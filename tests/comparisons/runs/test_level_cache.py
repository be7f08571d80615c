"""Where a run's finished levels are, and what change of the program they survive."""

from itertools import compress
from pathlib import Path

import numpy as np
import pytest
from scenes import SMOOTH, problem

from comparisons.campaigns.cases import Trial, answers_of, carry_out
from comparisons.campaigns.maps import map as map_of_groups
from comparisons.common import provenance
from comparisons.common.progress import no_progress
from comparisons.models.plan import make_plan
from comparisons.runs.run import CODE, level_cache


def test_levels_are_inside_a_folder_that_exists(tmp_path, smooth_outcome):
    out = tmp_path / "out"
    out.mkdir()
    level = smooth_outcome.runs["half_plane"].levels[0]
    cache = level_cache(out, smooth_outcome.problem, smooth_outcome.plan)
    cache.save("first", level)
    assert [path.name for path in tmp_path.iterdir()] == ["out"]
    assert [path.relative_to(out) for path in out.rglob("*.npz")] == [
        (out / ".unfinished/run/first.npz").relative_to(out)
    ]
    assert np.array_equal(cache.load("first").solution.pressure, level.solution.pressure)
    cache.discard()
    assert not list(out.iterdir())


def test_the_end_of_another_command_leaves_levels_alone(tmp_path, smooth_outcome):
    """Into the folder of a run that was stopped; and the end of that run the other's answers."""
    out, cases = tmp_path / "out", [Trial("tests", "nothing", "half_plane", tuple)]
    levels = level_cache(out, smooth_outcome.problem, smooth_outcome.plan)
    levels.save("first", smooth_outcome.runs["half_plane"].levels[0])
    carry_out("stability", cases, out, None, no_progress)
    assert levels.load("first") is not None
    answers = answers_of(out, "verify", cases)
    answers.save("1", ((), None, 0.0))
    carry_out("stability", cases, out, None, no_progress)
    levels.discard()
    assert levels.load("first") is None and answers.load("1") == ((), None, 0.0)
    answers.discard()
    assert [path.name for path in tmp_path.rglob("*")] == ["out", "stability.json"]


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A project with one function in every place that shapes a cached result, and in two more."""
    places = {
        *CODE,
        *map_of_groups.CODE,
        "comparisons/output",
        "comparisons/cli.py",
    }
    for place in places:
        path = tmp_path / place
        path = path if path.suffix else path / "law.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(LAW)
    monkeypatch.setattr(provenance, "PROJECT", tmp_path)
    yield tmp_path
    provenance.program_code.cache_clear()


LAW = '"""A law."""\n\ndef half(x):\n    """Of x."""\n    return x / 2\n'


def keys() -> tuple[str, str]:
    """Of levels, and of a map."""
    posed = problem(SMOOTH)
    provenance.program_code.cache_clear()
    levels = level_cache(Path("out"), posed, make_plan(posed, ("half_plane",))).key()
    return levels, provenance.program_code(*map_of_groups.CODE)


@pytest.mark.parametrize(
    ("place", "loses"),
    [
        ("comparisons/output/law.py", ""),
        ("comparisons/cli.py", ""),
        ("comparisons/models/law.py", "levels map"),
        ("analytic/law.py", "levels map"),
        ("comparisons/studies/law.py", "levels map"),
        ("comparisons/campaigns/maps/point.py", "map"),
    ],
)
def test_what_is_cached_is_lost_to_a_change_of_what_shapes_it_alone(project, place, loses):
    before = keys()
    (project / place).write_text(LAW.replace("2", "3"))
    lost = [one != other for one, other in zip(before, keys(), strict=True)]
    assert list(compress(("levels", "map"), lost)) == loses.split()


def test_every_place_that_shapes_a_result_is_there():
    for place in {*CODE, *map_of_groups.CODE}:
        assert (provenance.PROJECT / place).exists(), place
