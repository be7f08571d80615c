"""Where scenes lie on the finished maps, and what is said of them before they are solved."""

import sys
from pathlib import Path

import numpy as np
import pytest

from comparisons.campaigns.maps.answer import first_answer
from comparisons.campaigns.maps.content import differences, places, scaled, unscaled
from comparisons.campaigns.maps.groups import GROUPS
from comparisons.campaigns.maps.map import finished_map, finished_names, mark_of, request_of
from comparisons.campaigns.maps.place import (
    interpolated,
    place_on,
    places_of,
    problem_named,
)
from comparisons.cli import main
from comparisons.common.errors import SceneError
from comparisons.common.progress import no_progress
from comparisons.models.finite_element.level import problem_of_approach
from comparisons.models.posing import problem_of
from comparisons.scenes.scene import Origin, Scene


def problem(name: str, **changes):
    tables = Scene.read(name).tables | changes
    return problem_of(Scene.of(tables, Origin(name, Path(), name)))


@pytest.mark.parametrize("name", finished_names())
def test_a_point_of_a_map_lies_there_with_its_own_error(name):
    """The groups that a point's scene was given are those that are read off it."""
    content = finished_map(name)
    columns, rows = (len(content[axis]["values"]) for axis in "xy")
    request = request_of(
        name,
        f"{columns}x{rows}",
        *(f"{_axis(content[a])}" for a in "xy"),
        quantity=content["quantity"],
    )
    for number in (3 * columns + 4, 6 * columns + 1):
        point = request.points[number]
        place = place_on(name, problem_of(point.scene))
        assert place.groups == pytest.approx(tuple(point.at.values())[::-1], rel=0.01)
        quantity = content["quantity"]
        expected = content["points"][number]["quantities"][quantity]["difference"]
        assert place.errors[quantity] == pytest.approx(expected, rel=0.02, abs=2e-5)


def _axis(axis: dict) -> str:
    return f"{axis['group']}={axis['values'][0]:g}:{axis['values'][-1]:g}"


@pytest.mark.parametrize("name", finished_names())
def test_between_points_the_error_is_known_to_a_tenth(name):
    """By every second point from its four neighbours, at twice the distance: there an error has
    four times its deviation from straight lines. A coating's is zero amid its map, so that it is
    known to a tenth at the map's own spacing, from 1 % on."""
    least, most = (1e-2, 0.4) if name == "modulus-coating" else (1e-3, 0.1)
    content = finished_map(name)
    error = differences(content, content["quantity"])
    s = scaled(error, content)
    guess = unscaled(0.25 * (s[1:-1, :-2] + s[1:-1, 2:] + s[:-2, 1:-1] + s[2:, 1:-1]), content)
    off = np.abs(guess - error[1:-1, 1:-1]) / np.maximum(np.abs(error[1:-1, 1:-1]), least)
    assert np.nanquantile(off, 0.9) < most


def test_between_two_points_it_is_straight_on_the_scale():
    content = finished_map("curvature-thickness")
    error = differences(content, "peak_pressure")
    x = [10.0 ** np.mean(places(content["x"])[2:4]), content["y"]["values"][5]]
    error_there = interpolated(content, "peak_pressure", *x)
    assert error_there == pytest.approx(unscaled(np.mean(scaled(error[5, 2:4], content)), content))


def test_smooth_scenes_take_the_map_of_what_they_have():
    [place] = places_of(problem("smooth"))
    assert place.name == "curvature-thickness"
    groups = dict(zip(("a_over_thickness", "a_over_radius"), place.groups, strict=True))
    values = {name: GROUPS[name].value_of(problem("smooth")) for name in groups}
    assert sorted(place.groups) == sorted(values.values()) and min(place.groups) == 0.0
    # solved: -0.92 % under an elastic roller; the map's is rigid, with a body as stiff as both
    assert -0.011 < place.errors["peak_pressure"] < -0.005
    assert "<= " in place.text and "peak pressure −" in place.text.replace("-", "−")


def test_friction_of_unlike_bodies_is_on_the_other_map():
    tables = Scene.read("smooth-sliding").tables
    roller = tables["roller"] | {"youngs_modulus": 10.0 * tables["body"]["youngs_modulus"]}
    load = tables["load"] | {"friction": [0.5]}
    names = {place.name for place in places_of(problem("smooth-sliding", roller=roller, load=load))}
    assert names == {"curvature-thickness", "thickness-friction"}


def test_a_scene_on_no_map_gets_bounds_by_estimates():
    for name in ("layer", "ground-unrun", "coated"):
        [first, line] = first_answer(problem_of(Scene.read(name)))
        assert first.startswith("by the half-plane ")
        assert line.startswith("by estimates, on no finished map: model error at most about peak")
    assert "100 % or more" in first_answer(problem_of(Scene.read("layer")))[1]


def test_a_finished_map_is_shown_and_not_solved(pressed, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("comparisons.campaigns.maps.map.solved_in", None)
    out = tmp_path / "map"
    asked = ["map", "curvature-thickness", "--quantity", "contact_length", "--out", str(out)]
    assert main([*asked, "--mark", pressed]) == 0
    said = capsys.readouterr().out
    assert "contact length stays small" in said and "made by: crosscheck map curvature-" in said
    assert {path.name for path in out.iterdir()} == {"map.json", "map.svg"}
    unmarked = (out / "map.svg").read_text()
    assert main(asked) == 0
    assert (out / "map.svg").read_text() != unmarked


def test_what_a_map_does_not_have_is_refused(tmp_path, capsys):
    out = str(tmp_path / "map")
    asked = ["map", "curvature-thickness", "--out", out]
    assert main([*asked, "--quantity", "mean_gap"]) == 2
    assert "--quantity: mean_gap is not on this map" in capsys.readouterr().err
    assert main(["map", "modulus-coating", "--out", out, "--mark", "smooth"]) == 2
    assert "--mark: smooth has no coating_modulus_ratio to be marked at" in capsys.readouterr().err
    assert main([*asked, "--mark", "nowhere"]) == 2
    assert not (tmp_path / "map").exists()


@pytest.fixture
def pressed(tmp_path) -> str:
    """A scene of a prescribed approach."""
    path = tmp_path / "pressed.toml"
    path.write_text(
        "[roller]\nradius = 0.01\nrigid = true\n[body]\nyoungs_modulus = 2e9\n"
        "poissons_ratio = 0.3\nthickness = 1e-3\n[load]\napproach = 4e-6\n"
        "[resolution]\nelements = 8\nlevels = 2\n"
    )
    return str(path)


def test_a_prescribed_approach_is_marked_under_its_load(pressed, tmp_path, capsys):
    _, values = mark_of(finished_map("curvature-thickness"), problem_named(pressed))
    a = problem_of_approach(Scene.read(pressed), no_progress).hertz.half_width
    assert sorted(values) == pytest.approx([a / 0.01, a / 1e-3])
    out = str(tmp_path / "map")
    assert main(["map", "curvature-thickness", "--mark", pressed, "--out", out]) == 0


def test_of_a_prescribed_approach_nothing_is_said_before_its_load_is_known(
    pressed, tmp_path, capsys, monkeypatch
):
    def refused(*_):
        raise SceneError("as far as that")

    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setattr("comparisons.runs.run.solve_scene", refused)
    assert main(["run", pressed, "--out", str(tmp_path / "out")]) == 2
    assert "as far as that" in capsys.readouterr().err


def test_marks_are_the_scenes_groups():
    slab = problem("smooth", body=Scene.read("smooth").tables["body"] | {"thickness": 2e-3})
    name, values = mark_of(finished_map("curvature-thickness"), slab)
    assert name == "smooth" and sorted(values) == sorted(places_of(slab)[0].groups)


def test_a_scene_off_a_map_is_not_marked_at_its_edge(tmp_path, capsys):
    out = str(tmp_path / "map")
    assert main(["map", "curvature-thickness", "--mark", "layer", "--out", out]) == 2
    said = capsys.readouterr().err
    assert "layer lies off the map: its a/t is 4.5; allowed is 0.05 to 4" in said
    assert not (tmp_path / "map").exists()


def test_a_mark_of_another_kind_is_told(tmp_path, capsys):
    out = str(tmp_path / "map")
    assert main(["map", "slope-wavelength", "--mark", "sinusoid", "--out", out]) == 0
    said = capsys.readouterr().err
    assert "--mark: sinusoid has an elastic roller, has another law of elasticity" in said
