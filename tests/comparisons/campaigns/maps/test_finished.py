"""The maps that come with the project: complete, made by the command that they name, true."""

import shlex
from functools import cache

import pytest

from comparisons.campaigns.grid import FAILED, SOLVED
from comparisons.campaigns.maps.map import FINISHED, finished_map, request_of
from comparisons.campaigns.maps.picture import map_figure
from comparisons.campaigns.maps.point import TOLERANCES, solve_point
from comparisons.common.provenance import versions
from comparisons.drawing.style import svgs

# A point of each that costs little and whose error is well above its uncertainty: column, row.
CHEAP = {
    "curvature-thickness": (9, 9),
    "modulus-coating": (9, 8),
    "ratio-thickness": (9, 9),
    "slope-wavelength": (9, 0),
    "thickness-friction": (9, 9),
}


@cache
def asked_for(name: str):
    """The request that the command named in a map makes."""
    content = finished_map(name)
    program, command, scene, *options = shlex.split(content["command"])
    assert (program, command) == ("crosscheck", "map")
    values = dict(zip(options[::2], options[1::2], strict=True))
    assert values.keys() == {"--points", "--x", "--y", "--quantity"}
    return request_of(scene, **{name.removeprefix("--"): value for name, value in values.items()})


@pytest.fixture(params=CHEAP)
def finished(request) -> tuple[str, dict]:
    return request.param, finished_map(request.param)


def test_each_map_has_its_scene_and_picture():
    files = {f"{name}.{end}" for name in CHEAP for end in ("json", "toml", "svg")}
    assert {path.name for path in FINISHED.iterdir()} == files


def test_the_command_asks_for_the_same_points(finished):
    name, content = finished
    request = asked_for(name)
    assert request.scene.source == name
    assert request.tables == content["scene"]
    assert request.finite_element == content["finite_element"]
    assert [[*p.at.values()] for p in request.points] == [
        [p["y"], p["x"]] for p in content["points"]
    ]
    assert (content["x"], content["y"]) == (request.x, request.y)
    assert content["tolerances"] == list(TOLERANCES)


def test_every_point_was_computed(finished):
    _, content = finished
    kinds = [point["status"] for point in content["points"]]
    assert set(kinds) <= {SOLVED, FAILED} and kinds.count(SOLVED) >= 0.95 * len(kinds)


def test_one_point_is_what_it_was(finished):
    name, content = finished
    request, (column, row) = asked_for(name), CHEAP[name]
    number = row * len(content["x"]["values"]) + column
    again = solve_point(request.points[number])
    before = content["points"][number]
    assert again["status"] == before["status"] == SOLVED
    for quantity, error in again["quantities"].items():
        finished = before["quantities"][quantity]
        # another gmsh or solver may give another mesh, and errors as far off as they claim
        assert abs(error["difference"] - finished["difference"]) <= finished["uncertainty"], (
            quantity
        )


def test_pictures_show_the_points(finished):
    name, content = finished
    if versions()["matplotlib"] != content["versions"]["matplotlib"]:
        pytest.skip("another matplotlib draws another file")
    drawn = svgs({"map.svg": lambda: map_figure(content)})
    assert (FINISHED / f"{name}.svg").read_text(encoding="utf-8") == drawn["map.svg"]
