"""Scenes: one meaning in any units, defaults, tables that give the scene again, other values.
Finding scenes and reading them as TOML; shipped ones can be written out again. Fields
that are set beside a scene's file: as the file would have them, or refused in a line."""

import copy
import datetime
import json
import os
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scenes import QUICK, SMOOTH, changed, python, resolved, run_of

from analytic.exact.hertz import hertz_from_load
from analytic.material import Material, combined_modulus
from comparisons.common.errors import InputError, SceneError
from comparisons.figures.quantity import QUANTITIES
from comparisons.scenes.fields import Extent, file_fields
from comparisons.scenes.files import (
    SCENES,
    find_scene,
    name_of,
    read_toml,
    scene_names,
    scene_titles,
    value_of,
)
from comparisons.scenes.finite_element import FiniteElementSection
from comparisons.scenes.running_in import RunningInSection
from comparisons.scenes.scene import Origin, Scene, sections_of, with_settings, with_tolerance
from comparisons.scenes.sections import BudgetSection, ResolutionSection, ToleranceSection
from comparisons.scenes.surface import surface_of

STEEL = {"youngs_modulus": "207 GPa", "poissons_ratio": 0.3}
BARE = {
    "roller": {"radius": "8.2 mm", **STEEL},
    "body": dict(STEEL),
    "load": {"per_length": "3.85 N/um"},
}
FULL = {
    "title": "All of it",
    "roller": {"radius": "8.2 mm", **STEEL},
    "body": {
        **STEEL,
        "hardness": "7 GPa",
        "thickness": "5 mm",
        "width": "40 mm",
        "base": "bonded",
    },
    "coating": {"thickness": "2 um", "youngs_modulus": "400 GPa", "poissons_ratio": 0.2},
    "profile": {
        "kind": "self-affine",
        "hurst": 0.8,
        "rms_height": "0.4 um",
        "samples": 513,
        "length": "2 mm",
        "seed": 7,
        "shortest_wavelength": "40 um",
        "longest_wavelength": "1 mm",
    },
    "load": {"hertz_peak_pressure": "2 GPa", "friction": [0, 0.1], "position": "0.1 mm"},
    "running_in": {
        "hardness": "6 GPa",
        "load": "3 N/um",
        "positions": ["-0.2 mm", 3e-4],
        "sweeps": 3,
    },
    "stress": {"depth": "512.3456789 um", "half_range": 1.5, "points": [30, 20]},
    "tolerance": {"peak_pressure": 0.01, "tau1_max_depth": "5 %"},
    "finite_element": {
        "roller_shape": "circle",
        "roller_body": "disc",
        "element": "P3",
        "block": 200,
        "growth": 0.1,
        "plastic": False,
    },
    "resolution": {"pitch": "1 um", "levels": 4},
    "budget": {"time": "10 min", "memory": "2 GiB"},
}


BY_NAME = "answers", "published"  # of others, each in a section of its own name
SECTIONS = {name: part for name, part in sections_of(Scene).items() if name not in BY_NAME}
PLACES = [(section, name) for section, table in SECTIONS.items() for name in file_fields(table)]


def test_a_bare_scene_has_the_defaults():
    scene = resolved(BARE)
    assert (scene.name, scene.title) == ("made", "made")
    assert scene.roller.material == scene.body.material == Material(207e9, 0.3)
    assert scene.roller.radius == 0.0082
    assert (scene.load.kind, scene.load.value) == ("per_length", 3.85e6)
    assert scene.load.friction == (0.0,)
    assert (scene.profile, scene.stress, surface_of(scene).profile) == (None, None, None)
    assert scene.tolerances == {"peak_pressure": 0.02, "contact_length": 0.02, "tau1_max": 0.02}
    assert (scene.finite_element.coupled, scene.finite_element.element) == (False, "P2")
    assert (scene.body.base, scene.coating) == (None, None)


def test_everything_that_can_be_said():
    scene = resolved(FULL)
    assert scene.title == "All of it"
    assert (scene.body.hardness, scene.body.thickness, scene.body.width) == (7e9, 0.005, 0.04)
    assert (scene.load.kind, scene.load.value) == ("hertz_peak_pressure", 2e9)
    assert scene.load.friction == (0.0, 0.1)
    assert surface_of(scene).position == 1e-4
    places = {"positions": (-2e-4, 3e-4), "sweeps": 3}
    assert scene.running_in == RunningInSection(hardness=6e9, load=3e6, **places)
    assert scene.stress.depth == Extent(512.3456789e-6, in_half_widths=False)
    assert scene.stress.half_range == Extent(1.5, in_half_widths=True)
    assert scene.stress.points == (30, 20)
    assert scene.tolerances == {
        "peak_pressure": 0.01,
        "contact_length": 0.02,
        "tau1_max": 0.02,
        "tau1_max_depth": 0.05,
    }
    assert (scene.coating.material, scene.coating.thickness) == (Material(400e9, 0.2), 2e-6)
    assert scene.finite_element == FiniteElementSection(
        roller_shape="circle",
        roller_body="disc",
        coupled=False,
        deformation="linear",
        plastic=False,
        element="P3",
        block=200.0,
        growth=0.1,
    )
    assert scene.resolution == ResolutionSection(pitch=1e-6, levels=4)
    assert scene.budget == BudgetSection(time=600.0, memory=2.0**31)


def test_every_compared_quantity_can_be_judged():
    assert set(ToleranceSection.model_fields) == set(QUANTITIES)


def test_extent_in_metres():
    assert Extent(1.5, in_half_widths=True).metres(2e-4) == pytest.approx(3e-4, rel=1e-15)
    assert Extent(1.5, in_half_widths=False).metres(2e-4) == 1.5


def test_a_layer():
    """Bonded unless it says otherwise; under a rigid roller it may be given an approach."""
    layer = resolved(BARE).changed("body.thickness", "5 mm")
    assert layer.body.base == layer.tables["body"]["base"] == "bonded"
    assert layer.changed("body.base", "frictionless").body.base == "frictionless"
    rigid = layer.changed({"roller": {"radius": "8.2 mm", "rigid": True}, "load.approach": "2 um"})
    assert rigid.roller.material is None
    assert (rigid.load.kind, rigid.load.value) == ("approach", 2e-6)


def test_a_loose_base_carries_friction_where_the_body_has_no_end():
    loose = resolved(BARE).changed({"body.thickness": "5 mm", "body.base": "frictionless"})
    assert loose.changed("load.friction", 0.1).load.friction == (0.1,)
    ended = loose.changed("body.width", "40 mm")
    assert ended.changed("load.friction", 0).load.friction == (0.0,)


IN_SI = {
    ("roller", "radius"): (Decimal("0.0082"), {"m": 0, "mm": -3, "um": -6, "cm": -2, "nm": -9}),
    ("roller", "youngs_modulus"): (
        Decimal("207e9"),
        {"Pa": 0, "GPa": 9, "N/mm^2": 6, "kN/mm^2": 9, "N/um**2": 12},
    ),
    ("body", "hardness"): (Decimal("7e9"), {"GPa": 9, "MPa": 6, "bar": 5, "N/m^2": 0}),
    ("load", "hertz_peak_pressure"): (Decimal("2e9"), {"GPa": 9, "kPa": 3, "hPa": 2}),
    ("load", "position"): (Decimal("1e-4"), {"mm": -3, "micron": -6, "m": 0, "km": 3}),
    ("profile", "length"): (Decimal("0.002"), {"mm": -3, "um": -6, "dm": -1}),
    ("profile", "rms_height"): (Decimal("4e-7"), {"um": -6, "nm": -9, "angstrom": -10}),
    ("stress", "depth"): (Decimal("512.3456789e-6"), {"um": -6, "mm": -3, "m": 0}),
    ("resolution", "pitch"): (Decimal("1e-6"), {"um": -6, "nm": -9}),
    ("budget", "memory"): (Decimal(2**31), {"byte": 0, "kB": 3, "GB": 9}),
}
CHOICES = st.fixed_dictionaries(
    {field: st.sampled_from(sorted(units)) for field, (_, units) in IN_SI.items()}
)


IN_NUMBERS = resolved(FULL)
HEIGHTS = surface_of(IN_NUMBERS).profile.height


@settings(max_examples=60, deadline=None, derandomize=True)
@given(CHOICES)
def test_units_do_not_matter(units):
    """Not even in the last bit: quantities are converted as decimals."""
    tables = copy.deepcopy(FULL)
    for (section, name), (value, powers) in IN_SI.items():
        unit = units[section, name]
        tables[section][name] = f"{value.scaleb(-powers[unit])} {unit}"
    scene = resolved(tables)
    assert scene.tables == IN_NUMBERS.tables
    assert np.array_equal(surface_of(scene).profile.height, HEIGHTS)


@pytest.mark.parametrize("tables", [BARE, FULL], ids=["bare", "full"])
def test_written_out_tables_give_the_scene_again(tables):
    scene = resolved(tables)
    again = resolved(json.loads(json.dumps(scene.tables)))
    assert again.tables == scene.tables


def test_tolerances_of_stresses_are_written_out_with_stress_alone():
    tolerances = resolved(BARE).tables["tolerance"]
    assert tolerances == {"peak_pressure": 0.02, "contact_length": 0.02}
    with_stress = resolved({**BARE, "stress": {}}).tables["tolerance"]
    assert with_stress == {**tolerances, "tau1_max": 0.02}


def test_tables_are_a_copy():
    scene = resolved(BARE)
    scene.tables["load"]["friction"].append(0.5)
    scene.written["load"]["friction"] = 0.5
    assert scene.tables["load"]["friction"] == [0.0]
    assert scene.changed("load.coupled", True).load.friction == (0.0,)


class TestChanged:
    def test_what_was_not_given_follows_again(self):
        plain = resolved(BARE)
        soft = plain.changed("body.poissons_ratio", 0.4999)
        assert (plain.finite_element.element, soft.finite_element.element) == ("P2", "P3")
        assert soft.written["body"] == {"youngs_modulus": "207 GPa", "poissons_ratio": 0.4999}
        assert (plain.name, plain.source) == (soft.name, soft.source)

    def test_none_takes_a_field_away(self):
        scene = resolved(FULL).changed("body.hardness", None)
        assert scene.body.hardness is None and "hardness" not in scene.tables["body"]
        assert resolved(BARE).changed("stress", None).tables == resolved(BARE).tables

    def test_unchecked_is_what_it_is_set_to(self):
        scene = resolved(BARE)
        odd = scene.unchecked({"body.poissons_ratio": 0.4999, "body.thickness": 1.0})
        assert (odd.body.poissons_ratio, odd.finite_element.element) == (0.4999, "P2")
        assert (odd.body.thickness, odd.body.base) == (1.0, None)
        assert odd.written == scene.written and scene.body.thickness is None


HEAVY = {"analytic.contact", "comparisons.models", "fem", "dolfinx", "scipy", "pint"}


def test_reading_a_scene_loads_no_physics():
    """Nor anything else that takes time: a solid's constants have units of our own table."""
    code = "import sys, comparisons; comparisons.Scene.read('ground-running-in'); "
    loaded = set(python("-c", f"{code}print(*sys.modules)").stdout.split())
    assert "comparisons.scenes.scene" in loaded
    assert loaded.isdisjoint(HEAVY)


TOML_VALUES = st.recursive(
    st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=20)
    | st.sampled_from(["8.2 mm", "2 GPa", "3 N/um", "1 s", "1 GB", "bonded", "line", "sinusoid"])
    | st.dates()
    | st.just(datetime.time(1, 2)),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=5,
)


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.sampled_from([*PLACES, *((s, None) for s in [*SECTIONS, "title"])]), TOML_VALUES)
def test_any_value_is_taken_or_refused_in_one_line(place, value):
    section, name = place
    tables = copy.deepcopy(FULL)
    if name is None:
        tables[section] = value
    else:
        tables.setdefault(section, {})[name] = value
    try:
        resolved(tables)
    except SceneError as error:
        line = str(error)
        assert line.startswith(f"made.toml: {section}") or section == "profile"
        assert "allowed" in line or "must" in line or "nearest" in line or " is " in line
        assert "\n" not in line and "pydantic" not in line and "Value error" not in line


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.sampled_from([None, *SECTIONS]), st.text(min_size=1, max_size=30))
@example(None, "PELET")  # near load.per_length, whose message says more
def test_any_unknown_name_is_answered_with_a_known_one(section, name):
    known = {"title", *SECTIONS, *(field for _, field in PLACES)}
    tables = copy.deepcopy(FULL)
    place = tables if section is None else tables.setdefault(section, {})
    if name in known:
        return
    place[name] = 1
    with pytest.raises(SceneError, match="is no known field; the nearest is ") as caught:
        resolved(tables)
    nearest = str(caught.value).partition("the nearest is ")[2].partition(",")[0]
    place = tuple(nearest.split("."))
    assert nearest == "title" or nearest.strip("[]") in SECTIONS or place in PLACES


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


def test_scenes_of_the_ground_disc_share_their_load():
    """p0 = 4.15 GPa and a = 544.6 um, half of the trace: Bailey and Sayles (1991)."""
    for name in ("smooth", "smooth-sliding", "ground-unrun", "ground-run-in", "ground-polished"):
        scene = Scene.read(name)
        modulus = combined_modulus(scene.roller.material, scene.body.material)
        hertz = hertz_from_load(scene.load.value, scene.roller.radius, modulus)
        assert hertz.peak_pressure == pytest.approx(4.15e9, rel=1e-5)
        assert hertz.half_width == pytest.approx(544.578e-6, rel=1e-5)
        if scene.profile is not None:
            surface = surface_of(scene)
            assert surface.position == 1118e-6
            assert surface.profile.x[[0, -1]] == pytest.approx([-1118e-6, 1118e-6], rel=1e-12)
            assert surface.info.samples == 2237


@pytest.mark.parametrize("name", scene_names())
def test_written_out_tables_give_the_scene_again_and_survive_json(name):
    scene = Scene.read(name)
    assert scene.name == name != scene.title
    assert scene.stress is not None or scene.heat is not None
    surface = surface_of(scene)
    tables = surface.completed(scene.tables)
    again = Scene.of(json.loads(json.dumps(tables)), Origin(name, SCENES))
    assert again.tables == tables
    if scene.profile is not None:
        traced = surface_of(again).profile
        assert np.array_equal(traced.x, surface.profile.x)
        assert np.array_equal(traced.height, surface.profile.height)
    plain = surface.as_dict(scene)
    assert json.loads(json.dumps(plain, allow_nan=False)) == plain
    assert plain["name"] == name and plain["title"] == scene.title
    assert plain["roller"].get("radius", np.inf) == scene.roller.radius
    assert plain["load"]["position"] == surface.position
    assert plain["load"]["friction"] == list(scene.load.friction)
    assert (plain["profile"] is None) == (scene.profile is None)
    assert len(json.dumps(plain)) < 4000


@pytest.mark.parametrize("name", scene_names())
def test_every_field_may_be_set(name):
    """Values of a resolved scene's fields, set one by one, change nothing."""
    scene = Scene.read(name)
    for section, table in scene.tables.items():
        for field, value in table.items() if isinstance(table, dict) else ():
            if not isinstance(value, dict):
                text = f"{section}.{field}={json.dumps(value)}"
                assert with_settings(scene, [text]).tables == scene.tables, text


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1.2 GPa", "1.2 GPa"),
        ('"1.2 GPa"', "1.2 GPa"),
        ("true", True),
        ("1_000", 1000),
        ("1e5", 1e5),
        (".5", 0.5),
        ("[0, 0.1]", [0, 0.1]),
        ('{hub = "2 mm"}', {"hub": "2 mm"}),
        ("half disc", "half disc"),
        ("1\nother = 2", "1\nother = 2"),
        ("１２", "１２"),
    ],
)
def test_values_are_those_of_toml_or_the_text_itself(text, value):
    assert value_of(text) == value and type(value_of(text)) is type(value)


def test_several_are_taken_together_and_short_names_are_the_loads():
    settings = ["body.yield_stress=1.2 GPa", "finite_element.plastic=true", "load=1e6"]
    changed = with_settings(resolved(QUICK), [*settings, "friction=[0, 0.1]"])
    assert (changed.body.yield_stress, changed.finite_element.plastic) == (1.2e9, True)
    assert (changed.load.per_length, changed.load.friction) == (1e6, (0.0, 0.1))
    assert with_settings(changed, ["load.hertz_peak_pressure=1 GPa"]).load.per_length is None
    assert changed.named.endswith("--set load=1e6 --set 'friction=[0, 0.1]'")


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (["body.yeild_stress=1 GPa"], "the nearest is body.yield_stress"),
        (["yield_stress=1 GPa"], "the nearest is body.yield_stress"),
        (["body.yield_stress=1 m"], 'body.yield_stress: is "1 m", a length; allowed is'),
        (["title.x=1"], "title is no table"),
        (["body.yield_stress"], '--set: is "body.yield_stress"; allowed is FIELD=VALUE'),
        (["body.yield_stress= "], "allowed is FIELD=VALUE, with FIELD as in"),
        (["a." * 5000 + "b=1"], "allowed is FIELD=VALUE"),
        (["friction=0", "load.friction=0.1"], "--set: load.friction is given twice"),
        (["finite_element.plastic=true"], "is true, but the body has no yield stress"),
        (["load=[" * 5000], "is not a number and a unit"),
    ],
)
def test_what_is_wrong_is_one_line(settings, said):
    with pytest.raises(InputError) as refused:
        with_settings(resolved(QUICK), settings)
    assert said in str(refused.value) and "\n" not in str(refused.value)


@pytest.mark.parametrize("command", ["run", "cost", "map", "sweep", "deck"])
def test_every_command_that_takes_a_scene_refuses_it_and_writes_nothing(
    command, tmp_path, monkeypatch, complaint
):
    monkeypatch.chdir(tmp_path)
    needed = {"sweep": ["--over", "load=1e5,2e5"], "deck": ["--for", "calculix"]}
    asked = [command, "smooth", *needed.get(command, ()), "--set", "body.yeild_stress=1e9"]
    said = "smooth: body.yeild_stress: is no known field; the nearest is body.yield_stress"
    assert said in complaint(*asked)


def test_a_tolerance_replaces_each_that_the_scene_has():
    tightened = with_tolerance(Scene.read("smooth"), 0.005)
    judged = "peak_pressure", "contact_length", "tau1_max"
    assert tightened.tolerances == dict.fromkeys(judged, 5e-3)
    assert tightened.tables["tolerance"] == tightened.tolerances


def test_refinement_stops_where_the_tolerance_is_met():
    coarse = resolved(changed(SMOOTH, resolution={"pitch": 1e-4}))
    levels = []
    for tolerance in (0.2, 2e-3):
        outcome = run_of(with_tolerance(coarse, tolerance), "half_plane")
        assert outcome.solved.refinement == "every judged quantity is resolved"
        levels.append(len(outcome.runs["half_plane"].levels))
    assert levels[0] == 3 < levels[1]
