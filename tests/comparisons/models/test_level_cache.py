"""Where a run's finished levels are, and what change of the program they survive."""

import os
from itertools import compress
from pathlib import Path

import numpy as np
import pytest
from scenes import SMOOTH, problem

from comparisons.common import provenance
from comparisons.models.level_cache import CODE, level_cache
from comparisons.models.plan import make_plan
from comparisons.studies.cost import study as cost_study
from comparisons.studies.maps import request as map_request


def test_levels_are_inside_a_folder_that_exists(tmp_path, smooth_outcome):
    out = tmp_path / "out"
    out.mkdir()
    level = smooth_outcome.runs["half_plane"].levels[0]
    cache = level_cache(out, smooth_outcome.problem.scene, smooth_outcome.plan)
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
        *cost_study.CODE,
        *map_request.CODE,
        "comparisons/report",
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
    levels = level_cache(Path("out"), posed.scene, make_plan(posed, ("half_plane",))).key
    cost, points = (provenance.program_code(*each.CODE) for each in (cost_study, map_request))
    return levels, cost, points


@pytest.mark.parametrize(
    ("place", "loses"),
    [
        ("comparisons/report/law.py", ""),
        ("comparisons/cli.py", ""),
        ("comparisons/models/law.py", "levels cost map"),
        ("analytic/law.py", "levels cost map"),
        ("comparisons/assessment/effects/law.py", "levels map"),
        ("comparisons/assessment/law.py", "map"),
        ("comparisons/studies/cost/measure.py", "cost"),
        ("comparisons/studies/maps/point.py", "map"),
    ],
)
def test_what_is_cached_is_lost_to_a_change_of_what_shapes_it_alone(project, place, loses):
    before = keys()
    (project / place).write_text(LAW.replace("2", "3"))
    lost = [one != other for one, other in zip(before, keys(), strict=True)]
    assert list(compress(("levels", "cost", "map"), lost)) == loses.split()


def test_the_key_follows_the_code_and_not_its_text(project):
    before = keys()
    path = project / "analytic/law.py"
    path.write_text(
        '"""Halves."""\n\n\ndef half(x):  # of x\n    """Half."""\n\n    return x / 2\n'
    )
    assert keys() == before
    path.write_text(LAW.replace("x / 2", "x[1:3, 0:2]"))  # a constant from Python 3.14 on
    sliced = keys()
    assert sliced != before
    path.write_text(LAW.replace("x / 2", "x[1:4, 0:2]"))
    assert keys() not in (before, sliced)
    path.write_text(LAW.replace("x / 2", "2 * x"))
    assert keys() != before


def test_every_place_that_shapes_a_result_is_there():
    for place in {*CODE, *cost_study.CODE, *map_request.CODE}:
        assert (provenance.PROJECT / place).exists(), place


def test_sources_are_compiled_again_only_when_they_have_changed(project, tmp_path, monkeypatch):
    """Those that changed a moment ago always are: they may change again within the clock's step."""
    compiled, code_of = [], provenance._code_of

    def noted(source: Path) -> str:
        compiled.append(source.relative_to(tmp_path).as_posix())
        return code_of(source)

    def compiled_now() -> list[str]:
        compiled.clear()
        provenance.program_code.cache_clear()
        provenance.program_code("analytic", "meshes")
        return compiled

    monkeypatch.setattr(provenance, "_code_of", noted)
    monkeypatch.setattr(provenance, "KNOWN_CODE", tmp_path / "known.json")
    monkeypatch.setattr(provenance.sys, "dont_write_bytecode", False)
    os.utime(project / "analytic/law.py", (1e9, 1e9))
    assert compiled_now() == ["analytic/law.py", "meshes/law.py"]
    assert compiled_now() == ["meshes/law.py"]
    (project / "analytic/law.py").write_text(LAW.replace("2", "3"))
    for path, time in ("analytic", 1e9 + 1.0), ("meshes", 1e9):
        os.utime(project / path / "law.py", (time, time))
    assert compiled_now() == ["analytic/law.py", "meshes/law.py"]
    assert compiled_now() == []
