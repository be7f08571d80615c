"""Profiles of scenes: lines of maps, where they lie, what was taken off, and their account."""

import copy
import hashlib
import json
from pathlib import Path

import numpy as np
import pytest
from scenes import SMOOTH, as_toml, changed, resolved

from analytic.exact.hertz import hertz_from_load
from analytic.material import combined_modulus
from analytic.surface.filters import filtered
from analytic.surface.roughness import roughness
from analytic.surface.roughness_standard import standard_roughness
from analytic.surface.synthetic import ground_texture, self_affine
from analytic.surface.turned import turned, turned_height
from comparisons.common.errors import SceneError
from comparisons.drawing.blocks import TextTable
from comparisons.output.page.tables.problem import problem_items
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SINUSOID_REACH, SINUSOID_WAVES, SceneSurface, surface_of

BARE = changed(SMOOTH, roller={"radius": 8e-3}, load={"per_length": 1e6})
X = np.arange(201.0)  # um
WAVES = 0.3 * np.cos(2.0 * np.pi * X / 20.0)  # um, whole waves
ROUGH = {"kind": "self-affine", "hurst": 0.8, "rms_height": 3e-6, "samples": 2001, "length": 4e-3}
TURNED = {"kind": "turned", "feed": "0.1 mm", "nose_radius": "0.8 mm", "length": "4 mm"}
HEIGHTS = np.random.default_rng(2).standard_normal((6, 41))  # nm, columns and rows 1 um apart
MAP = {"file": "map.npy", "spacing": "1 um", "z_unit": "nm"}


def scene_with(folder: Path = Path("."), position=None, **profile) -> Scene:
    place = {} if position is None else {"position": position}
    return resolved(changed(BARE, profile=profile, load=place), "mine", folder)


def with_profile(*folder: Path, **fields) -> SceneSurface:
    """The surface of a scene with this profile."""
    return surface_of(scene_with(*folder, **fields))


def measured(folder: Path, height: np.ndarray, **profile):
    """The surface of a scene with a trace of these heights [um] over X."""
    rows = np.column_stack([X, height]).tolist()
    (folder / "trace.csv").write_text("\n".join(f"{x!r},{z!r}" for x, z in rows))
    fields = {"file": "trace.csv", "x_unit": "um", "z_unit": "um", **profile}
    return with_profile(folder, **fields)


def test_units_of_the_file(tmp_path):
    surface = measured(tmp_path, WAVES, z_unit="nm", x_unit="mm", form="none")
    assert surface.profile.x == pytest.approx((X - 100.0) * 1e-3, rel=1e-12, abs=1e-18)
    assert np.ptp(surface.profile.height) == pytest.approx(0.6e-9, rel=1e-12)


@pytest.mark.parametrize(("put", "at"), [(None, 100), ("30 um", 30)])
def test_the_roller_stands_where_it_is_put_or_on_the_middle(tmp_path, put, at):
    surface = measured(tmp_path, WAVES, position=put)
    assert surface.position == pytest.approx(at * 1e-6, rel=1e-15)
    assert surface.profile.x[at] == pytest.approx(0.0, abs=1e-20)
    ends = np.array([-at, 200.0 - at]) * 1e-6
    assert surface.profile.x[[0, -1]] == pytest.approx(ends, rel=1e-14)


@pytest.mark.parametrize("form", ["none", "mean", "line", "arc"])
def test_height_zero_is_the_mean_line(tmp_path, form):
    surface = measured(tmp_path, WAVES + 250.0, form=form)
    trapezoids = np.array([0.5, *np.ones(199), 0.5])
    mean = np.average(surface.profile.height, weights=trapezoids)
    assert mean == pytest.approx(0.0, abs=1e-12 * 250e-6)
    assert surface.info.form.kind == form
    assert surface.info.form.mean == pytest.approx(250e-6, rel=1e-4)


def test_forms_take_off_what_they_say(tmp_path):
    tilted = WAVES + 0.01 * X
    assert measured(tmp_path, tilted, form="line").info.form.slope == pytest.approx(0.01, rel=1e-2)
    kept = measured(tmp_path, tilted, form="none").profile
    assert kept.height[200] - kept.height[0] == pytest.approx(2e-6, rel=1e-12)
    arc = np.sqrt(50e3**2 - (X - 100.0) ** 2) - 50e3
    form = measured(tmp_path, 0.01 * WAVES + arc, form="arc").info.form
    assert form.radius == pytest.approx(50e-3, rel=2e-2)


def test_a_line_is_removed_unless_the_scene_says_otherwise(tmp_path):
    tilted = WAVES + 0.01 * X
    plain, line = measured(tmp_path, tilted), measured(tmp_path, tilted, form="line")
    assert np.array_equal(plain.profile.height, line.profile.height)
    assert plain.info == line.info


def test_account_of_a_measured_profile(tmp_path):
    surface = measured(tmp_path, WAVES)
    info = surface.info
    assert info.source == "trace.csv"
    assert info.path == tmp_path / "trace.csv"
    assert info.sha256 == hashlib.sha256((tmp_path / "trace.csv").read_bytes()).hexdigest()
    assert (info.samples, info.bridged, info.trimmed) == (201, 0, 0)
    assert info.length == pytest.approx(200e-6, rel=1e-14)
    assert info.spacing == pytest.approx(1e-6, rel=1e-9)
    assert info.roughness.rq == pytest.approx(0.3e-6 / np.sqrt(2.0), rel=1e-2)
    assert info.roughness.max_slope == pytest.approx(0.3 * 2.0 * np.pi / 20.0, rel=2e-2)
    assert "path" not in info.as_dict()


def test_heights_alone_with_a_spacing(tmp_path):
    (tmp_path / "trace.txt").write_text("\n".join(map(repr, WAVES.tolist())))
    surface = with_profile(tmp_path, file="trace.txt", z_unit="um", spacing="0.5 um")
    assert surface.info.length == pytest.approx(100e-6, rel=1e-14)


def test_lost_samples_are_bridged_on_request(tmp_path):
    rows = [f"{x},{z}" for x, z in zip(X.tolist(), WAVES.tolist(), strict=True)]
    rows[0] = "0,"
    rows[50] = "50,nan"
    rows[60] = "60,nan"
    (tmp_path / "trace.csv").write_text("\n".join(rows))
    fields = {"file": "trace.csv", "x_unit": "um", "z_unit": "um"}
    with pytest.raises(SceneError, match=r"profile\.file: .*trace\.csv, line 1: height"):
        with_profile(tmp_path, **fields)
    info = with_profile(tmp_path, **fields, dropouts="bridge").info
    assert (info.samples, info.bridged, info.trimmed) == (200, 2, 1)


def test_paths_start_from_the_scene(tmp_path, monkeypatch):
    (tmp_path / "scenes").mkdir()
    measured(tmp_path / "scenes", WAVES)
    monkeypatch.chdir(tmp_path)
    tables = changed(BARE, profile={"file": "trace.csv", "x_unit": "um", "z_unit": "um"})
    (tmp_path / "scenes" / "mine.toml").write_text(as_toml(tables))
    assert surface_of(Scene.read("scenes/mine.toml")).info.samples == 201


@pytest.mark.parametrize(
    ("load", "wavelength"),
    [
        ({"per_length": 1e6}, 50e-6),
        ({"hertz_peak_pressure": 1e9}, 50e-6),
        ({"per_length": 1e3}, 5e-3),
    ],
)
def test_a_sinusoid_outlasts_its_contact(load, wavelength):
    tables = {**copy.deepcopy(BARE), "load": load}
    tables["profile"] = {"kind": "sinusoid", "wavelength": wavelength, "amplitude": 2e-7}
    scene = resolved(tables)
    surface = surface_of(scene)
    modulus = combined_modulus(scene.roller.material, scene.body.material)
    force = load.get("per_length", np.pi * 1e9**2 * 8e-3 / modulus)
    half_width = hertz_from_load(force, 8e-3, modulus).half_width
    widest = np.sqrt(half_width**2 + 4.0 * 8e-3 * 2e-7)
    wanted = max(SINUSOID_REACH * widest, SINUSOID_WAVES * wavelength)
    assert wanted <= surface.profile.length * (1.0 + 1e-12)
    assert surface.profile.length <= wanted + wavelength / 16.0
    assert surface.completed(scene.tables)["profile"]["length"] == pytest.approx(wanted, rel=1e-12)


def test_a_sinusoid_has_a_crest_under_the_roller():
    surface = with_profile(
        kind="sinusoid", wavelength="50 um", amplitude="0.2 um", length="1.01 mm"
    )
    middle = len(surface.profile.x) // 2
    assert surface.profile.x[middle] == 0.0
    assert surface.profile.height[middle] == 2e-7
    wave = 2e-7 * np.cos(2.0 * np.pi * surface.profile.x / 50e-6)
    assert surface.profile.height == pytest.approx(wave, abs=1e-18)
    assert (surface.info.source, surface.info.sha256) == ("sinusoid", None)
    assert surface.info.form.kind == "none"


SLOPED = {"hurst": 0.8, "rms_slope": 0.03, "samples": 257, "length": 1e-3}
TEXTURE = {"rms_height": 4e-7, "samples": 513, "length": 5e-4, "shortest_wavelength": 1e-5}
TEXTURE |= {"roll_off_wavelength": 8e-5, "longest_wavelength": 2.5e-4}
FED = {"feed": 1e-4, "nose_radius": 8e-4, "length": 4e-3, "phase": 0.25}
FED |= {"noise": 5e-8, "noise_wavelength": 1e-5}


@pytest.mark.parametrize(
    ("kind", "made", "fields"),
    [("self-affine", self_affine, SLOPED), ("ground", ground_texture, TEXTURE),
     ("turned", turned, FED)],
)  # fmt: skip
def test_a_made_profile_is_that_of_its_seed(kind, made, fields):
    surface = with_profile(kind=kind, seed=5, **fields)
    wanted = made(seed=5, **fields).height
    assert np.array_equal(surface.profile.height, wanted)
    other = with_profile(kind=kind, seed=6, **fields)
    assert np.std(other.profile.height - wanted) > 5e-8
    assert scene_with(kind=kind, **fields).tables["profile"]["seed"] == 0
    figures = surface.info.roughness
    assert kind != "self-affine" or figures.rms_slope == pytest.approx(0.03, rel=1e-12)
    assert kind != "ground" or figures.rsk < 0.0


@pytest.fixture
def mapped(tmp_path):
    """A folder with a map."""
    np.save(tmp_path / MAP["file"], HEIGHTS)
    return tmp_path


class TestMaps:
    def test_a_row(self, mapped):
        surface = with_profile(mapped, **MAP, row=3, form="none")
        wanted = 1e-9 * HEIGHTS[3]
        made = surface.profile.height
        np.testing.assert_allclose(made - made[0], wanted - wanted[0], rtol=0.0, atol=1e-20)
        assert surface.info.place == "row 3 of 6 rows and 41 columns, 4e-05 m by 5e-06 m"
        assert surface.info.format == "npy"

    def test_a_line_between_two_points(self, mapped):
        line = [["0 um", "2 um"], ["40 um", "2 um"]]
        along = with_profile(mapped, **MAP, line=line)
        row = with_profile(mapped, **MAP, row=2)
        np.testing.assert_allclose(along.profile.height, row.profile.height, rtol=0.0, atol=1e-20)

    def test_the_choice_survives_a_record(self, mapped):
        line = [["0 um", "1 um"], ["40 um", "4 um"]]
        scene = scene_with(mapped, **MAP, line=line)
        tables = json.loads(json.dumps(scene.tables))
        assert tables == scene.tables
        again = resolved(tables, "mine", mapped)
        assert again.tables == scene.tables
        surface = surface_of(scene)
        assert np.array_equal(surface_of(again).profile.height, surface.profile.height)


class TestFilter:
    def test_a_cutoff_takes_the_long_waves_off(self):
        plain, made = with_profile(**ROUGH), with_profile(**ROUGH, cutoff="0.8 mm")
        wanted = filtered(plain.profile, 0.8e-3)
        assert np.array_equal(made.profile.height, wanted.height)
        assert made.info.cutoff == 0.8e-3
        assert made.info.roughness.rq < 0.6 * plain.info.roughness.rq
        assert made.info.roughness == roughness(wanted)

    def test_both_cutoffs(self):
        plain = with_profile(**ROUGH)
        made = with_profile(**ROUGH, cutoff="0.8 mm", short_cutoff="25 um")
        wanted = filtered(plain.profile, 0.8e-3, 25e-6)
        assert np.array_equal(made.profile.height, wanted.height)
        slope = made.info.roughness.rms_slope
        assert slope < 0.7 * plain.info.roughness.rms_slope
        assert made.info.standard == standard_roughness(plain.profile, 0.8e-3, 25e-6)

    def test_an_automatic_cutoff_is_written_out(self):
        scene = scene_with(**ROUGH, cutoff="auto")
        surface = surface_of(scene)
        assert surface.info == with_profile(**ROUGH, cutoff="0.8 mm").info
        assert surface.completed(scene.tables)["profile"]["cutoff"] == surface.info.cutoff == 0.8e-3
        assert scene.tables["profile"]["cutoff"] == "auto"

    def test_the_standards_figures_do_not_hang_on_what_is_pressed(self):
        plain, made = with_profile(**ROUGH), with_profile(**ROUGH, cutoff="0.8 mm")
        assert plain.info.cutoff is None
        assert plain.info.standard == made.info.standard
        assert plain.info.standard.cutoff == 0.8e-3
        assert plain.info.standard.short_cutoff is None  # samples 2 um apart

    def test_a_trace_too_short_for_the_standard_says_so(self):
        info = with_profile(**ROUGH | {"length": 1e-3}).info
        assert info.standard is None
        assert "the trace of 1 mm is too short for the standard's cut-off" in info.standard_why


def test_a_turned_surface_is_what_the_tool_leaves():
    surface = with_profile(**TURNED, phase=0.25)
    wanted = turned(feed=1e-4, nose_radius=8e-4, length=4e-3, phase=0.25)
    assert np.array_equal(surface.profile.height, wanted.height)
    figures = surface.info.roughness
    assert figures.rt == pytest.approx(turned_height(1e-4, 8e-4, 8e-5), rel=1e-3)
    assert surface.info.standard.rsm == pytest.approx(1e-4, rel=1e-3)


def test_the_result_has_the_surface_as_pressed_and_by_the_standard(finish):
    load = {"hertz_peak_pressure": 1e9}
    profile = {**TURNED, "cutoff": "0.8 mm"}
    outcome = finish({**BARE, "load": load, "profile": profile}, ("half_plane",))
    known = outcome.figures.of(study="problem", quantity="rq")
    pressed, standard = (known.one(source=s).value for s in ("as pressed", "standard"))
    assert pressed == roughness(outcome.problem.surface.profile).rq
    assert standard == outcome.problem.surface.info.standard.rq
    cutoffs = outcome.figures.of(study="problem", quantity="cutoff")
    assert [figure.value for figure in cutoffs] == [0.8e-3, 0.8e-3]
    [table] = [item for item in problem_items(outcome) if isinstance(item, TextTable)]
    [ra] = [row for row in table.rows if row[0] == "Ra"]
    assert ra[2] == f"{1e9 * outcome.problem.surface.info.standard.ra:#.4g} nm"
