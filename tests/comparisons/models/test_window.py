"""The points of the fields: what is asked for, and what must not depend on it."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import STEEL, half_plane_at, resolved

from comparisons.common.errors import SceneError
from comparisons.models.posing import problem_of
from comparisons.models.window import field_ends, search_window, window_of
from comparisons.scenes.fields import Extent
from comparisons.scenes.files import SCENES, read_toml
from comparisons.scenes.scene import Origin, Scene


def problem(name="ground-unrun", **stress):
    tables = read_toml(SCENES / f"{name}.toml")
    tables["stress"] = {**tables["stress"], **stress}
    return problem_of(Scene.of(tables, Origin(name, SCENES, name)))


@pytest.mark.parametrize("name", ["ground-unrun", "ground-run-in"])
def test_extremes_do_not_depend_on_the_points_of_the_field(name):
    extremes = []
    for points in ([3, 3], [40, 16], [600, 200]):
        posed = problem(name, points=points)
        level = half_plane_at(posed, fields=True)
        extremes.append([e.value for e in level.stress.extremes.values()])
    assert extremes[:2] == [pytest.approx(extremes[2], rel=1e-9)] * 2


def test_a_trace_that_is_nothing_beside_the_window_is_refused_before_it_is_searched(tmp_path):
    """Nanometres high and picometres long: its waves ask for more points than there is memory."""
    height = np.cumsum(np.random.default_rng(1).standard_normal(256))
    np.savetxt(tmp_path / "trace.csv", np.column_stack([0.08 * np.arange(256), height]))
    tables = {
        "roller": {"radius": 1e-5, **STEEL},
        "body": STEEL,
        "profile": {"file": "trace.csv", "x_unit": "pm", "z_unit": "nm"},
        "load": {"hertz_peak_pressure": 1e9},
    }
    scene = resolved(tables | {"stress": {}}, folder=tmp_path)
    with pytest.raises(SceneError, match=r"stress.half_range: is 2.6e-07 m; .*: check x_unit and"):
        problem_of(scene)


@pytest.mark.parametrize("columns", [3, 10, 77, 600, 2500])
def test_points_belong_to_the_grid_of_every_level(columns):
    posed = problem(points=[columns, 20])
    window = window_of(posed)
    assert len(window.x) == pytest.approx(columns, rel=0.5)
    assert len(window.z) == 20 and window.z[0] == 0.0
    spacing = np.diff(window.x).mean()
    for pitch in posed.pitches:
        ratio = window.stride(pitch) / window.subdivisions(pitch)
        assert ratio * pitch == pytest.approx(spacing, rel=1e-9)
        assert min(window.stride(pitch), window.subdivisions(pitch)) == 1


def test_the_search_is_as_dense_as_the_coarsest_pressures():
    posed = problem(points=[10, 10])
    searched = search_window(posed)
    assert np.diff(searched.x).max() == pytest.approx(posed.pitches[0])
    assert searched.z[1] < posed.pitches[0]
    assert (searched.z[3:] / searched.z[2:-1]).max() < 1.7


@pytest.mark.parametrize(
    ("stress", "words"),
    [
        ({"half_range": 1e6}, "stress.half_range: is .* allowed is at most"),
        ({"depth": 1e6}, "stress.depth: is .* allowed is at most"),
        ({"half_range": 1e-9}, "stress.half_range: is .* allowed is at least"),
    ],
)
def test_windows_that_show_nothing_or_leave_the_body_are_refused(stress, words):
    with pytest.raises(SceneError, match=words):
        problem(**stress)


def test_a_shallow_window_of_many_rows():
    window = window_of(problem(depth="1 nm", points=[50, 300]))
    assert len(window.z) == 300 and window.z[-1] == pytest.approx(1e-9)


@pytest.mark.parametrize(
    ("asked", "extent", "ends"),
    [
        (None, (-1.6, 1.6), (-1.5, 1.5)),
        (None, (4.8, 5.2), (3.5, 6.5)),
        (None, (-3.0, 2.0), (-3.0, 2.0)),
        (0.5, (-1.6, 1.6), (-0.5, 0.5)),
        (0.5, (0.3, 1.6), (-0.5, 0.5)),
        (0.5, (4.8, 5.2), (4.5, 5.5)),
        (0.5, (4.0, 6.0), (4.0, 6.0)),
    ],
)
def test_a_field_stands_about_contact_that_it_would_not_show(asked, extent, ends):
    """All in half-widths; an extent has a margin of 0.15 beside the contact."""
    half_range = None if asked is None else Extent(asked, in_half_widths=True)
    posed = problem()
    a, scene = posed.hertz.half_width, posed.scene.unchecked({"stress.half_range": half_range})
    moved = replace(posed, scene=scene, extent=(extent[0] * a, extent[1] * a))
    assert np.array(field_ends(moved)) / a == pytest.approx(np.array(ends))
