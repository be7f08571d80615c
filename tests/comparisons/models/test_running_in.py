"""Running-in as a scene has it; the surface that is then pressed, under what load, where, how
finely, its files; and what the result tells."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import STEEL, resolved

from analytic.exact.hertz import hertz_from_load
from analytic.profile import Profile
from analytic.running_in import RunIn, run_in
from analytic.surface.roughness import roughness
from comparisons.judging.study import Run
from comparisons.models.posing import problem_of
from comparisons.models.running_in import run_in_surface
from comparisons.output.result import read_result
from comparisons.runs.rerun import rerun
from comparisons.runs.run import run
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface, surface_of

pytestmark = pytest.mark.usefixtures("undrawn")
LOAD, RADIUS = 2e5, 10e-3
PAIR = hertz_from_load(LOAD, RADIUS, 210e9 / 1.82)
HARDNESS = 1.25 * PAIR.peak_pressure
WAVY = {
    "roller": {"radius": RADIUS, **STEEL},
    "body": dict(STEEL),
    "profile": {"kind": "sinusoid", "wavelength": 40e-6, "amplitude": 0.1e-6},
    "load": {"per_length": LOAD},
    "running_in": {"hardness": HARDNESS, "stroke": 60e-6, "passes": 5},
}


def wavy(changes: dict | None = None) -> Scene:
    """The wavy scene with fields replaced; None takes one away."""
    return resolved(WAVY, "wavy").changed(changes or {})


def run_in_of(scene: Scene) -> SceneSurface:
    """Surface of the scene, run in."""
    return run_in_surface(scene, surface_of(scene))


def by_itself(scene: Scene, worn: RunIn, profile: Profile, pitch: float) -> RunIn:
    """The profile, run in as the scene has it."""
    places = np.array(scene.running_in.places(0.0))
    how = PAIR.radius, PAIR.combined_modulus, worn.constraints, places
    return run_in(profile, *how, pitch=pitch)


class TestProblem:
    def test_the_run_in_surface_is_the_one_that_is_pressed(self):
        scene = wavy()
        problem, surface = problem_of(scene), surface_of(scene)
        worn = problem.surface.run_in
        assert worn.volume > 0.0 and worn.converged and worn.status == "settled"
        assert problem.surface.profile is worn.profile
        assert problem.surface.info.roughness == roughness(worn.profile)
        x = np.linspace(-50e-6, 50e-6, 999)
        lowered = surface.profile.spline()(x) - worn.profile.spline()(x)
        unworn = x**2 / (2.0 * PAIR.radius) - surface.profile.spline()(x)
        assert problem.gap(x) == pytest.approx(unworn + lowered, abs=1e-18)
        assert lowered.max() > 1e-9

    def test_it_is_run_in_under_the_scenes_pair_load_and_places(self):
        scene = wavy({"load.position": 5e-6})
        surface = surface_of(scene)
        worn = run_in_surface(scene, surface).run_in
        other = by_itself(scene, worn, surface.profile.shifted(-5e-6), worn.pitch)
        assert worn.constraints.load == PAIR.load_per_length
        assert worn.constraints.hardness == HARDNESS
        assert other.volume == pytest.approx(worn.volume, rel=1e-6)
        assert worn.passes[0].position == pytest.approx(-30e-6)

    def test_the_load_is_the_scenes_unless_it_has_its_own(self):
        scenes = {"load.per_length": None, "load.hertz_peak_pressure": PAIR.peak_pressure}
        own = {"running_in.load": 1.5 * PAIR.load_per_length}
        for changes, times in ((scenes, 1.0), (own, 1.5)):
            load = run_in_of(wavy(changes)).run_in.constraints.load
            assert load == pytest.approx(times * PAIR.load_per_length, rel=1e-12)

    def test_running_in_is_done_once(self, monkeypatch):
        problem = problem_of(wavy())
        monkeypatch.setattr("comparisons.models.running_in.run_in", None)
        assert problem_of(problem.scene, problem.surface).surface is problem.surface

    def test_hats_are_fine_enough_for_the_volume_and_nest_in_the_samples(self):
        scene = wavy()
        worn = run_in_of(scene).run_in
        octaves = np.log2(worn.pitch / worn.before.spacing)
        assert octaves == pytest.approx(round(octaves), abs=1e-9)
        finer = by_itself(scene, worn, worn.before, 0.25 * worn.pitch)
        assert worn.volume == pytest.approx(finer.volume, rel=5e-3)

    def test_a_long_flat_trace_does_not_ask_for_more_hats_than_the_contact_needs(self):
        scene = wavy()
        x = np.linspace(-2e-3, 2e-3, 2001)
        waves = Profile(x, 1e-12 * np.cos(2.0 * np.pi * x / 8e-6))
        surface = run_in_surface(scene, replace(surface_of(scene), profile=waves))
        assert surface.run_in.pitch > PAIR.half_width / 2500.0


class TestRun:
    @pytest.fixture(scope="class")
    @classmethod
    def done(cls, tmp_path_factory) -> Run:
        return run(wavy(), tmp_path_factory.mktemp("run-in") / "out", ("half_plane",))

    def test_files_hold_the_surface_before_and_after(self, done: Run):
        worn, out = done.problem.surface.run_in, done.directory
        table = np.loadtxt(out / "run_in_profile.csv", delimiter=",", skiprows=1)
        header = (out / "run_in_profile.csv").read_text().splitlines()[0]
        assert header == "x [m],height before running-in [m],height [m]"
        assert table[:, 0] == pytest.approx(worn.profile.x, rel=1e-11)
        assert table[:, 1] - table[:, 2] == pytest.approx(worn.lowering, abs=1e-17)
        assert read_result(out).findings["running_in"].said("status") == "settled"
        assert not (done.directory / "half_plane" / "run_in_profile.csv").exists()

    def test_the_record_holds_the_surface_before_and_repeats_the_run(self, done: Run):
        before, arrays = done.problem.surface.run_in.before, read_result(done.directory).arrays
        assert np.array_equal(arrays.arrays["profile_x"], before.x)
        assert np.array_equal(arrays.arrays["profile_height"], before.height)
        repetition = rerun(done.directory)
        assert repetition.bits and repetition.movement.moved == ()
        hashed = {"trace", "profile", "half_plane_pressure", "run_in_profile"}
        assert set(done.record["hashes"]) == hashed
        assert repetition.outcome.findings["running_in"] == done.findings["running_in"]
