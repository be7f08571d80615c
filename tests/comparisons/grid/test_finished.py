"""The maps that come with the project: complete, made by the command that they name, true; shown,
and scenes of the user's marked on them."""

import shlex
from functools import cache

import pytest

from comparisons.cli import main
from comparisons.common.progress import no_progress
from comparisons.common.provenance import versions
from comparisons.drawing.style import svgs
from comparisons.grid.groups import scene_with
from comparisons.grid.map import FINISHED, finished_map, finished_names, request_of
from comparisons.grid.map_error import solve_point
from comparisons.grid.map_picture import map_figure
from comparisons.grid.mark import mark_of, problem_named, unlike
from comparisons.grid.points import FAILED, SOLVED
from comparisons.models.finite_element.level import problem_of_approach
from comparisons.models.posing import problem_of
from comparisons.scenes.scene import Origin, Scene

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
    assert request.content["command"].startswith(f"crosscheck map {name} ")
    for part in ("scene", "finite_element", "x", "y", "tolerances"):
        assert request.content[part] == content[part]
    assert [[*p.at.values()] for p in request.points] == [
        [p["y"], p["x"]] for p in content["points"]
    ]


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
        apart = abs(error["difference"] - finished["difference"])
        assert apart <= finished["uncertainty"], quantity


def test_pictures_show_the_points(finished):
    name, content = finished
    if versions()["matplotlib"] != content["versions"]["matplotlib"]:
        pytest.skip("another matplotlib draws another file")
    drawn = svgs({"map.svg": lambda: map_figure(content)})
    assert (FINISHED / f"{name}.svg").read_text(encoding="utf-8") == drawn["map.svg"]


STEEL = {"youngs_modulus": 200e9, "poissons_ratio": 0.3}
COATED, LAYER = "modulus-coating", "curvature-thickness"
ON_A_LAYER = {
    "roller": {"radius": 0.01, "rigid": True},
    "load": {"per_length": 1e5},
    "body": {**STEEL, "thickness": 1e-3},
}


@pytest.mark.parametrize("name", finished_names())
def test_a_point_of_a_map_is_marked_where_it_is(name):
    """The groups that a point's scene was given are those that are read off it; nor is that scene
    any other than the map's."""
    content = finished_map(name)
    point = content["points"][3 * len(content["x"]["values"]) + 4]
    groups = {content[axis]["group"]: point[axis] for axis in "xy"}
    posed = problem_of(scene_with(Scene.of(content["scene"], Origin("mine")), groups))
    assert mark_of(content, posed)[1] == pytest.approx((point["x"], point["y"]), rel=0.01)
    assert unlike(content, posed) == ""


@pytest.mark.parametrize(
    ("name", "changes", "why"),
    [
        (COATED, {"roller.youngs_modulus": 300e9}, "roller's modulus is 1.5, not 1"),
        (COATED, {"coating.poissons_ratio": 0.2}, "coating's ratio is 0.2, not 0.3"),
        (LAYER, {"roller": {"radius": 0.01, **STEEL}}, "roller's modulus is 1, not infinite"),
        (LAYER, {"body.poissons_ratio": 0.4}, "Poisson's ratio is 0.4, not 0.3"),
        (LAYER, {"coating": {"thickness": 1e-6, **STEEL}}, "coating's ratio is 0.3, not none"),
        (LAYER, {"load.friction": [0.1]}, "friction is some, not none"),
        (LAYER, {"body.base": "frictionless"}, "base is frictionless, not bonded"),
        (LAYER, {"body.law": "hencky"}, "law of elasticity is hencky, not neo-hookean"),
    ],
)
def test_what_a_scene_differs_by_from_the_map_s(name, changes, why):
    content = finished_map(name)
    tables = content["scene"] if name == COATED else ON_A_LAYER
    scene = Scene.of({"stress": {}} | tables, Origin("mine")).changed(changes)
    assert unlike(content, problem_of(scene)).startswith(why)


def test_a_finished_map_is_shown_and_not_solved(pressed, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("comparisons.grid.map.solved_in", None)
    out = tmp_path / "map"
    asked = ["map", "curvature-thickness", "--quantity", "contact_length", "--out", str(out)]
    assert main([*asked, "--mark", pressed]) == 0
    said = capsys.readouterr().out
    assert "model error of the half-plane, contact length: within 1 % at 19, 2 % at 31" in said
    assert "made by: crosscheck map curvature-" in said
    assert {path.name for path in out.iterdir()} == {"map.json", "map.svg"}
    unmarked = (out / "map.svg").read_text()
    assert main(asked) == 0
    assert (out / "map.svg").read_text() != unmarked


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


def test_a_prescribed_approach_is_marked_under_its_load(pressed):
    _, values = mark_of(finished_map("curvature-thickness"), problem_named(pressed))
    a = problem_of_approach(Scene.read(pressed), no_progress).hertz.half_width
    assert sorted(values) == pytest.approx([a / 0.01, a / 1e-3])


def test_a_mark_of_another_kind_is_told(tmp_path, capsys):
    out = str(tmp_path / "map")
    assert main(["map", "slope-wavelength", "--mark", "sinusoid", "--out", out]) == 0
    said = capsys.readouterr().err
    assert "--mark: sinusoid is not the map's scene: roller's modulus is 1, not infinite; " in said
    assert "; law of elasticity is murnaghan, not neo-hookean; " in said
