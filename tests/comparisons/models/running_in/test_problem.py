"""The surface that is pressed is the run-in one: under what load, where, how finely; its files."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scenes import half_plane_at

import comparisons.models.running_in
from analytic.exact.hertz import HertzContact
from analytic.profile import Profile
from analytic.running_in import RunIn, run_in
from analytic.surface.roughness import roughness
from comparisons.judging.study import Run
from comparisons.models.posing import problem_of
from comparisons.models.running_in import run_in_surface
from comparisons.output.record import read_result
from comparisons.runs.run import Known, run
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface, surface_of


def run_in_of(scene: Scene) -> SceneSurface:
    """Its surface, run in."""
    return run_in_surface(scene, surface_of(scene))


def by_itself(
    scene: Scene, pair: HertzContact, worn: RunIn, profile: Profile, pitch: float
) -> RunIn:
    """The profile, run in as the scene has it."""
    places = np.array(scene.running_in.places(0.0))
    how = pair.radius, pair.combined_modulus, worn.constraints, places
    return run_in(profile, *how, pitch=pitch)


class TestProblem:
    def test_the_run_in_surface_is_the_one_that_is_pressed(self, resolved, pair):
        scene = resolved()
        problem, surface = problem_of(scene), surface_of(scene)
        worn = problem.surface.run_in
        assert worn.volume > 0.0 and worn.converged and worn.status == "settled"
        assert problem.surface.profile is worn.profile
        assert problem.surface.info.roughness == roughness(worn.profile)
        x = np.linspace(-50e-6, 50e-6, 999)
        lowered = surface.profile.spline()(x) - worn.profile.spline()(x)
        assert problem.gap(x) == pytest.approx(
            x**2 / (2.0 * pair.radius) - surface.profile.spline()(x) + lowered, abs=1e-18
        )
        assert lowered.max() > 1e-9

    def test_it_is_run_in_under_the_scenes_pair_load_and_places(self, resolved, pair, hardness):
        scene = resolved({"load": {"position": 5e-6}})
        surface = surface_of(scene)
        worn = run_in_surface(scene, surface).run_in
        other = by_itself(scene, pair, worn, surface.profile.shifted(-5e-6), worn.pitch)
        assert worn.constraints.load == pair.load_per_length
        assert worn.constraints.hardness == hardness
        assert other.volume == pytest.approx(worn.volume, rel=1e-6)
        assert worn.passes[0].position == pytest.approx(-30e-6)

    def test_the_load_is_the_scenes_unless_it_has_its_own(self, resolved, pair):
        scenes = {"per_length": None, "hertz_peak_pressure": pair.peak_pressure}
        own = {"load": 1.5 * pair.load_per_length}
        for changes, times in (({"load": scenes}, 1.0), ({"running_in": own}, 1.5)):
            load = run_in_of(resolved(changes)).run_in.constraints.load
            assert load == pytest.approx(times * pair.load_per_length, rel=1e-12)

    def test_running_in_is_done_once(self, monkeypatch, resolved):
        problem = problem_of(resolved())

        def again(*arguments, **named):
            pytest.fail("run in twice")

        monkeypatch.setattr(comparisons.models.running_in, "run_in", again)
        assert problem_of(problem.scene, problem.surface).surface is problem.surface

    def test_hats_are_fine_enough_for_the_volume_and_nest_in_the_samples(self, resolved, pair):
        scene = resolved()
        worn = run_in_of(scene).run_in
        octaves = np.log2(worn.pitch / worn.before.spacing)
        assert octaves == pytest.approx(round(octaves), abs=1e-9)
        finer = by_itself(scene, pair, worn, worn.before, 0.25 * worn.pitch)
        assert worn.volume == pytest.approx(finer.volume, rel=5e-3)

    def test_a_long_flat_trace_does_not_ask_for_more_hats_than_the_contact_needs(
        self, resolved, pair
    ):
        scene = resolved()
        x = np.linspace(-2e-3, 2e-3, 2001)
        waves = Profile(x, 1e-12 * np.cos(2.0 * np.pi * x / 8e-6))
        surface = run_in_surface(scene, replace(surface_of(scene), profile=waves))
        assert surface.run_in.pitch > pair.half_width / 2500.0


@pytest.mark.usefixtures("undrawn")
class TestRun:
    @pytest.fixture(scope="class")
    @classmethod
    def done(cls, tmp_path_factory, resolved) -> Run:
        return run(resolved(), tmp_path_factory.mktemp("run-in") / "out", ("half_plane",))

    def test_files_hold_the_surface_before_and_after(self, done: Run):
        worn, out = done.problem.surface.run_in, done.directory
        table = np.loadtxt(out / "run_in_profile.csv", delimiter=",", skiprows=1)
        header = (out / "run_in_profile.csv").read_text().splitlines()[0]
        assert header == "x [m],height before running-in [m],height [m]"
        assert table[:, 0] == pytest.approx(worn.profile.x, rel=1e-11)
        assert table[:, 1] - table[:, 2] == pytest.approx(worn.lowering, abs=1e-17)
        assert read_result(out / "result.json").findings["running_in"].said("status") == "settled"
        assert not (done.directory / "half_plane" / "run_in_profile.csv").exists()

    def test_the_record_holds_the_surface_before_and_repeats_the_run(self, done: Run, tmp_path):
        record = json.loads((done.directory / "record.json").read_text())
        trace = done.problem.surface.run_in.before
        assert record["profile"]["x"] == trace.x.tolist()
        assert record["profile"]["height"] == trace.height.tolist()
        scene = Scene.of(record["scene"])
        placed = Profile(np.array(record["profile"]["x"]), np.array(record["profile"]["height"]))
        known = Known(replace(surface_of(scene), profile=placed))
        again = run(scene, tmp_path / "again", ("half_plane",), known=known)
        assert again.record["hashes"] == done.record["hashes"]
        assert set(done.record["hashes"]) == {"half_plane_pressure", "run_in_profile"}
        assert again.findings["running_in"] == done.findings["running_in"]


def test_the_scene_that_comes_along_flattens_the_unrun_surface_to_its_hardness():
    """On ground as steep as the unrun, peaks end at the hardness, and little material goes."""
    scene = Scene.read("ground-running-in")
    problem = problem_of(scene)
    worn = problem.surface.run_in
    assert worn.status == "settled" and worn.converged
    assert not any(one.at_end for one in worn.passes)
    assert 1e-12 * 30.0 < worn.volume < 1e-12 * 45.0
    level = half_plane_at(problem, problem.pitches[-1])
    peak = level.solution.pressure.max()
    assert peak == pytest.approx(scene.running_in.hardness, rel=0.02)
    unrun = problem_of(Scene.read("ground-unrun"))
    before = half_plane_at(unrun, unrun.pitches[-1])
    assert before.solution.pressure.max() > 1.5 * peak
    ratios = [worn.contact_length / problem.hertz.half_width / 2.0 for worn in (before, level)]
    assert ratios == pytest.approx([0.69, 0.72], abs=0.01)
