"""Surfaces of scenes: lines of maps, cut-offs, turned profiles, and what is said of them."""

import json
from pathlib import Path

import numpy as np
import pytest
from scenes import SMOOTH, changed, resolved

from analytic.surface.filters import filtered
from analytic.surface.roughness import roughness
from analytic.surface.roughness_standard import standard_roughness
from analytic.surface.turned import turned, turned_height
from comparisons.common.errors import SceneError
from comparisons.output.page.tables.problem import roughness_rows
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface, surface_of

BARE = changed(SMOOTH, roller={"radius": 8e-3}, load={"per_length": 1e6})
ROUGH = {"kind": "self-affine", "hurst": 0.8, "rms_height": 3e-6, "samples": 2001, "length": 4e-3}
TURNED = {"kind": "turned", "feed": "0.1 mm", "nose_radius": "0.8 mm", "length": "4 mm"}
HEIGHTS = np.random.default_rng(2).standard_normal((6, 41))  # nm, columns and rows 1 um apart
MAP = {"file": "map.npy", "spacing": "1 um", "z_unit": "nm"}


def scene_with(folder: Path = Path("."), **profile) -> Scene:
    return resolved(changed(BARE, profile=profile), "mine", folder)


def with_profile(folder: Path = Path("."), **profile) -> SceneSurface:
    """The surface of a scene with this profile."""
    return surface_of(scene_with(folder, **profile))


@pytest.fixture
def mapped(tmp_path):
    """A folder with a map."""
    np.save(tmp_path / MAP["file"], HEIGHTS)
    return tmp_path


def complaint(*folder, **profile) -> str:
    with pytest.raises(SceneError) as caught:
        with_profile(*folder, **profile)
    assert "\n" not in str(caught.value)
    return str(caught.value)


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

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            ({}, "is a map of 6 rows and 41 columns, 4e-05 m by 5e-06 m, and a profile is one li"),
            ({"row": 6}, "has no row 6 (a map of 6 rows and 41 columns"),
            ({"line": [[0, 0], ["50 um", 0]]}, "line leaves the map"),
        ],
    )
    def test_choices_that_the_file_does_not_allow(self, mapped, changes, words):
        message = complaint(mapped, **MAP, **changes)
        assert message.startswith(f"mine.toml: profile.file: {mapped / 'map.npy'}: {words}")

    def test_text_needs_its_unit(self, tmp_path):
        (tmp_path / "trace.csv").write_text("0,1\n1,2\n2,0\n3,1\n4,1\n")
        message = complaint(tmp_path, file="trace.csv", x_unit="um")
        assert message.startswith("mine.toml: profile.z_unit: is missing; allowed is a unit of len")


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


class TestTurned:
    def test_it_is_what_the_tool_leaves(self):
        surface = with_profile(**TURNED, phase=0.25)
        wanted = turned(feed=1e-4, nose_radius=8e-4, length=4e-3, phase=0.25)
        assert np.array_equal(surface.profile.height, wanted.height)
        figures = surface.info.roughness
        assert figures.rt == pytest.approx(turned_height(1e-4, 8e-4, 8e-5), rel=1e-3)
        assert surface.info.standard.rsm == pytest.approx(1e-4, rel=1e-3)
        assert scene_with(**TURNED).tables["profile"]["seed"] == 0

    def test_noise_is_that_of_its_seed(self):
        changes = {**TURNED, "noise": "50 nm", "noise_wavelength": "10 um"}
        one, same, other = (with_profile(**changes, seed=seed) for seed in (1, 1, 2))
        assert np.array_equal(one.profile.height, same.profile.height)
        assert np.std(one.profile.height - other.profile.height) > 5e-8


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
    [ra, *_] = roughness_rows(outcome.problem.surface.info)
    assert ra[2] == f"{1e9 * outcome.problem.surface.info.standard.ra:#.4g} nm"
