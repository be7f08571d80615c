"""Running-in as a scene has it: read, with its defaults, or refused in one line."""

import json
from collections.abc import Callable

import numpy as np
import pytest

from comparisons.common.errors import SceneError
from comparisons.models.posing import problem_of
from comparisons.models.running_in import run_in_surface
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of


class TestReading:
    def test_a_stroke_is_centred_on_the_roller(self, resolved, hardness):
        scene = resolved({"load": {"position": 5e-6}})
        assert scene.running_in.places(5e-6) == pytest.approx([-25e-6, -10e-6, 5e-6, 20e-6, 35e-6])
        assert scene.running_in.hardness == hardness
        assert scene.running_in.sweeps == 10 and scene.running_in.load is None

    def test_positions_are_places_on_the_trace_in_their_order(self, resolved):
        positions = [20e-6, -30e-6, 0.0]
        scene = resolved({"running_in": {"positions": positions, "stroke": None, "passes": None}})
        assert scene.running_in.places(0.0) == tuple(positions)

    def test_defaults_are_written_out_and_read_again(self, resolved):
        scene = resolved(
            {"body": {"hardness": 3e9}, "running_in": {"hardness": None, "passes": None}}
        )
        assert scene.running_in.hardness == 3e9
        assert len(scene.running_in.places(0.0)) == 15
        table = scene.tables["running_in"]
        assert table == {"hardness": 3e9, "stroke": 60e-6, "passes": 15, "sweeps": 10}
        again = Scene.of(json.loads(json.dumps(scene.tables)))
        assert again.running_in == scene.running_in
        assert np.array_equal(surface_of(again).profile.x, surface_of(scene).profile.x)

    def test_without_the_section_nothing_is_there(self, resolved):
        scene = resolved({"running_in": None})
        assert scene.running_in is None and surface_of(scene).as_dict(scene)["running_in"] is None
        assert "running_in" not in scene.tables
        assert problem_of(scene).scene is scene

    def test_a_made_trace_is_long_enough_for_the_stroke(self, resolved):
        one = surface_of(resolved({"running_in": None})).profile.length
        assert surface_of(resolved()).profile.length - one == pytest.approx(60e-6, abs=2e-6)
        places = {"positions": [-50e-6, 10e-6], "stroke": None, "passes": None}
        longer = surface_of(resolved({"running_in": places})).profile.length
        assert longer - one == pytest.approx(100e-6, abs=2e-6)


# fields of [running_in] and of other sections, how the line goes on after "wavy.toml: "
WRONG = [
    ({"hardness": None}, "running_in.hardness: is missing; allowed is a pressure above 0, here or"),
    ({"stroke": None, "passes": None}, "running_in.positions: is missing; allowed is exactly one"),
    ({"positions": [0.0]}, "running_in.stroke: is given beside positions; allowed is exactly one"),
    (
        {"positions": [0.0], "stroke": None},
        "running_in.passes: is given beside positions, which are one pass each; allowed with",
    ),
    (
        {"positions": [0.0, 1e-6, 0.0], "stroke": None, "passes": None},
        "running_in.positions: lists 0 twice; allowed is",
    ),
    ({"passes": 1}, "running_in.passes: is 1; allowed is a whole number from 2 to 1000"),
]


@pytest.mark.parametrize(("fields", "line"), WRONG)
def test_a_wrong_field_is_named_with_what_is_allowed(fields, line, resolved):
    with pytest.raises(SceneError) as error:
        resolved({"running_in": fields})
    assert str(error.value).startswith(f"wavy.toml: {line}")


@pytest.mark.parametrize("load", [1e20, 1e-15])
def test_pressures_too_few_or_too_many_for_the_trace_are_refused(resolved, load):
    scene = resolved({"running_in": {"load": load}, "profile": {"length": 2e-3}})
    with pytest.raises(SceneError, match=r"running_in: takes .* of .* m; allowed are 8 to 4e\+06"):
        run_in_surface(scene, surface_of(scene))


class TestRestOfTheScene:
    @pytest.fixture
    def refused(self, resolved) -> Callable[[dict], str]:
        def said(changes: dict) -> str:
            with pytest.raises(SceneError) as error:
                surface_of(resolved(changes))
            return str(error.value)

        return said

    def test_a_smooth_surface_has_nothing_to_run_in(self, refused):
        complaint = refused({"profile": None})
        assert complaint.startswith("wavy.toml: running_in: is given for a smooth surface; allowed")

    def test_an_approach_is_no_load_to_run_in_under(self, resolved, refused, pair):
        rigid = {"rigid": True, "youngs_modulus": None, "poissons_ratio": None}
        layer = {
            "roller": rigid,
            "body": {"thickness": 1e-3},
            "load": {"per_length": None, "approach": 1e-6},
        }
        complaint = refused(layer)
        assert complaint.startswith("wavy.toml: running_in.load: is missing; allowed is a load per")
        scene = resolved({**layer, "running_in": {"load": pair.load_per_length}})
        assert scene.running_in.load == pair.load_per_length

    def test_the_roller_must_stay_on_the_trace(self, refused):
        length = {"profile": {"length": 1e-3}}
        places = {"positions": [0.0, 0.6e-3], "stroke": None, "passes": None}
        beyond = refused({**length, "running_in": places})
        assert beyond.startswith("wavy.toml: running_in.positions: is 0.0006 m; allowed is inside")
        too_long = refused({**length, "running_in": {"stroke": 1.2e-3}})
        assert too_long.startswith(
            "wavy.toml: running_in.stroke: is 0.0012 m; allowed is below 0.0"
        )

    def test_a_body_too_soft_to_carry_the_load(self, resolved):
        with pytest.raises(SceneError, match=r"^wavy.toml: running_in.hardness: the load 200000 N"):
            problem_of(resolved({"running_in": {"hardness": 1e8}}))
