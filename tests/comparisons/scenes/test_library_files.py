"""Scenes that come along: they resolve, and can be written out and read again."""

import json

import numpy as np
import pytest

from analytic.exact.hertz import hertz_from_load
from analytic.material import combined_modulus
from comparisons.scenes.files import SCENES, scene_names
from comparisons.scenes.scene import Origin, Scene
from comparisons.scenes.surface import surface_of


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
