"""Where a run's finished levels are, and what change of the program they survive."""

from itertools import compress
from pathlib import Path

import numpy as np
import pytest
from scenes import SMOOTH, problem

from comparisons.campaigns.cost import measure as cost_measure
from comparisons.campaigns.maps import map as map_of_groups
from comparisons.common import provenance
from comparisons.models.level_cache import CODE, level_cache
from comparisons.models.plan import make_plan


def test_levels_are_inside_a_folder_that_exists(tmp_path, smooth_outcome):
    out = tmp_path / "out"
    out.mkdir()
    level = smooth_outcome.runs["half_plane"].levels[0]
    cache = level_cache(out, smooth_outcome.problem, smooth_outcome.plan)
    cache.save("first", level)
    assert [path.name for path in tmp_path.iterdir()] == ["out"]
    assert [path.relative_to(out) for path in out.rglob("*.npz")] == [
        (out / ".unfinished/first.npz").relative_to(out)
    ]
    assert np.array_equal(cache.load("first").solution.pressure, level.solution.pressure)
    cache.discard()
    assert not list(out.iterdir())


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A project with one function in every place that shapes a cached result, and in two more."""
    places = {
        *CODE,
        *cost_measure.CODE,
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


def keys() -> tuple[str, str, str]:
    """Of levels, of a cost study and of a map."""
    posed = problem(SMOOTH)
    provenance.program_code.cache_clear()
    levels = level_cache(Path("out"), posed, make_plan(posed, ("half_plane",))).key
    cost, points = (provenance.program_code(*each.CODE) for each in (cost_measure, map_of_groups))
    return levels, cost, points


@pytest.mark.parametrize(
    ("place", "loses"),
    [
        ("comparisons/output/law.py", ""),
        ("comparisons/cli.py", ""),
        ("comparisons/models/law.py", "levels cost map"),
        ("analytic/law.py", "levels cost map"),
        ("comparisons/studies/model_error/law.py", "levels map"),
        ("comparisons/studies/law.py", "map"),
        ("comparisons/campaigns/cost/measure.py", "cost"),
        ("comparisons/campaigns/maps/point.py", "map"),
    ],
)
def test_what_is_cached_is_lost_to_a_change_of_what_shapes_it_alone(project, place, loses):
    before = keys()
    (project / place).write_text(LAW.replace("2", "3"))
    lost = [one != other for one, other in zip(before, keys(), strict=True)]
    assert list(compress(("levels", "cost", "map"), lost)) == loses.split()


def test_every_place_that_shapes_a_result_is_there():
    for place in {*CODE, *cost_measure.CODE, *map_of_groups.CODE}:
        assert (provenance.PROJECT / place).exists(), place
