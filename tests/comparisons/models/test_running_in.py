"""Running-in as a scene has it, read or refused in one line; the surface that is then pressed,
under what load, where, how finely, its files; and what result, plan, table, report tell."""

import json
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scenes import STEEL, half_plane_at, posed, refound, resolved

import comparisons.models.running_in
from analytic.exact.hertz import hertz_from_load
from analytic.profile import Profile
from analytic.running_in import RunIn, run_in
from analytic.surface.roughness import roughness
from comparisons.common.errors import ExitStatus, SceneError
from comparisons.figures.figure import Statement
from comparisons.figures.quantity import MODELS
from comparisons.judging.presentation import lines_of, parts_of
from comparisons.judging.study import Run
from comparisons.judging.verdict.headline import headline
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.models.running_in import run_in_surface
from comparisons.output.page.page import render
from comparisons.output.record import read_result
from comparisons.output.result_json import content_of, result_of
from comparisons.runs.run import Known, run
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface, surface_of
from comparisons.studies.running_in import STUDY

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
    """The wavy scene with fields of sections replaced; None takes a field or a section away."""
    fields = {}
    for section, table in (changes or {}).items():
        named = {f"{section}.{name}": value for name, value in (table or {}).items()}
        fields |= {section: None} if table is None else named
    return resolved(WAVY, "wavy").changed(fields)


def refused(changes: dict) -> str:
    """The one line that refuses the wavy scene with such changes, or its surface."""
    with pytest.raises(SceneError) as error:
        surface_of(wavy(changes))
    return str(error.value)


def run_in_of(scene: Scene) -> SceneSurface:
    """Its surface, run in."""
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
        assert problem.gap(x) == pytest.approx(
            x**2 / (2.0 * PAIR.radius) - surface.profile.spline()(x) + lowered, abs=1e-18
        )
        assert lowered.max() > 1e-9

    def test_it_is_run_in_under_the_scenes_pair_load_and_places(self):
        scene = wavy({"load": {"position": 5e-6}})
        surface = surface_of(scene)
        worn = run_in_surface(scene, surface).run_in
        other = by_itself(scene, worn, surface.profile.shifted(-5e-6), worn.pitch)
        assert worn.constraints.load == PAIR.load_per_length
        assert worn.constraints.hardness == HARDNESS
        assert other.volume == pytest.approx(worn.volume, rel=1e-6)
        assert worn.passes[0].position == pytest.approx(-30e-6)

    def test_the_load_is_the_scenes_unless_it_has_its_own(self):
        scenes = {"per_length": None, "hertz_peak_pressure": PAIR.peak_pressure}
        own = {"load": 1.5 * PAIR.load_per_length}
        for changes, times in (({"load": scenes}, 1.0), ({"running_in": own}, 1.5)):
            load = run_in_of(wavy(changes)).run_in.constraints.load
            assert load == pytest.approx(times * PAIR.load_per_length, rel=1e-12)

    def test_running_in_is_done_once(self, monkeypatch):
        problem = problem_of(wavy())

        def again(*arguments, **named):
            pytest.fail("run in twice")

        monkeypatch.setattr(comparisons.models.running_in, "run_in", again)
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


class TestReading:
    def test_a_stroke_is_centred_on_the_roller(self):
        scene = wavy({"load": {"position": 5e-6}})
        assert scene.running_in.places(5e-6) == pytest.approx([-25e-6, -10e-6, 5e-6, 20e-6, 35e-6])
        assert scene.running_in.hardness == HARDNESS
        assert scene.running_in.sweeps == 10 and scene.running_in.load is None

    def test_positions_are_places_on_the_trace_in_their_order(self):
        positions = [20e-6, -30e-6, 0.0]
        scene = wavy({"running_in": {"positions": positions, "stroke": None, "passes": None}})
        assert scene.running_in.places(0.0) == tuple(positions)

    def test_defaults_are_written_out_and_read_again(self):
        scene = wavy({"body": {"hardness": 3e9}, "running_in": {"hardness": None, "passes": None}})
        assert scene.running_in.hardness == 3e9
        assert len(scene.running_in.places(0.0)) == 15
        table = scene.tables["running_in"]
        assert table == {"hardness": 3e9, "stroke": 60e-6, "passes": 15, "sweeps": 10}
        again = Scene.of(json.loads(json.dumps(scene.tables)))
        assert again.running_in == scene.running_in
        assert np.array_equal(surface_of(again).profile.x, surface_of(scene).profile.x)

    def test_without_the_section_nothing_is_there(self):
        scene = wavy({"running_in": None})
        assert scene.running_in is None and surface_of(scene).as_dict(scene)["running_in"] is None
        assert "running_in" not in scene.tables
        assert problem_of(scene).scene is scene

    def test_a_made_trace_is_long_enough_for_the_stroke(self):
        one = surface_of(wavy({"running_in": None})).profile.length
        assert surface_of(wavy()).profile.length - one == pytest.approx(60e-6, abs=2e-6)
        places = {"positions": [-50e-6, 10e-6], "stroke": None, "passes": None}
        longer = surface_of(wavy({"running_in": places})).profile.length
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
def test_a_wrong_field_is_named_with_what_is_allowed(fields, line):
    with pytest.raises(SceneError) as error:
        wavy({"running_in": fields})
    assert str(error.value).startswith(f"wavy.toml: {line}")


@pytest.mark.parametrize("load", [1e20, 1e-15])
def test_pressures_too_few_or_too_many_for_the_trace_are_refused(load):
    scene = wavy({"running_in": {"load": load}, "profile": {"length": 2e-3}})
    with pytest.raises(SceneError, match=r"running_in: takes .* of .* m; allowed are 8 to 4e\+06"):
        run_in_surface(scene, surface_of(scene))


class TestRestOfTheScene:
    def test_a_smooth_surface_has_nothing_to_run_in(self):
        complaint = refused({"profile": None})
        assert complaint.startswith("wavy.toml: running_in: is given for a smooth surface; allowed")

    def test_an_approach_is_no_load_to_run_in_under(self):
        rigid = {"rigid": True, "youngs_modulus": None, "poissons_ratio": None}
        layer = {
            "roller": rigid,
            "body": {"thickness": 1e-3},
            "load": {"per_length": None, "approach": 1e-6},
        }
        complaint = refused(layer)
        assert complaint.startswith("wavy.toml: running_in.load: is missing; allowed is a load per")
        scene = wavy({**layer, "running_in": {"load": PAIR.load_per_length}})
        assert scene.running_in.load == PAIR.load_per_length

    def test_the_roller_must_stay_on_the_trace(self):
        length = {"profile": {"length": 1e-3}}
        places = {"positions": [0.0, 0.6e-3], "stroke": None, "passes": None}
        beyond = refused({**length, "running_in": places})
        assert beyond.startswith("wavy.toml: running_in.positions: is 0.0006 m; allowed is inside")
        too_long = refused({**length, "running_in": {"stroke": 1.2e-3}})
        assert too_long.startswith(
            "wavy.toml: running_in.stroke: is 0.0012 m; allowed is below 0.0"
        )

    def test_a_body_too_soft_to_carry_the_load(self):
        with pytest.raises(SceneError, match=r"^wavy.toml: running_in.hardness: the load 200000 N"):
            problem_of(wavy({"running_in": {"hardness": 1e8}}))


@pytest.fixture(scope="module")
def outcome(finish: Callable[..., Run]) -> Run:
    return finish({**WAVY, "title": "Wavy, run in", "stress": {"points": [60, 20]}})


class TestTelling:
    def test_result(self, outcome: Run):
        findings, run_in = outcome.findings["running_in"], outcome.problem.surface.run_in
        by_quantity = {f.quantity: f.value for f in findings.figures if f.source == "half_plane"}
        assert by_quantity["passes"] == len(run_in.passes) == 5 * by_quantity["sweeps"]
        volumes = findings.table("passes").columns["volume"].values
        assert by_quantity["volume_moved"] == run_in.volume == sum(volumes)
        assert by_quantity["largest_lowering"] == run_in.largest_lowering > 0.0
        assert (findings.said("status"), findings.said("converged")) == ("settled", "yes")
        assert findings.table("at ends of the trace") is None
        known = outcome.figures.of(study="running_in")
        before, after = (known.one(source=s, quantity="rq").value for s in ("before", "after"))
        assert before > after > 0.0
        slope = outcome.figures.one(study="problem", source="scene", quantity="rms_slope")
        assert slope.value == known.one(source="after", quantity="rms_slope").value
        content = content_of(result_of(outcome))
        assert json.loads(json.dumps(content, allow_nan=False)) == content
        for peak in outcome.figures.of(study="contact", quantity="peak_pressure"):
            assert peak.value < 1.03 * HARDNESS

    def test_result_without_running_in(self, wavy_outcome: Run):
        assert "running_in" not in wavy_outcome.findings
        assert 'id="running-in"' not in render(wavy_outcome)

    def test_page_and_terminal_show_it(self, outcome: Run):
        assert '<section id="running-in">' in render(outcome)
        [block], [(name, told)] = parts_of(STUDY, outcome), lines_of(STUDY, outcome)
        assert ("status", "settled") in block.items[2].rows
        assert name == "running in" and told.endswith("(half-plane), settled")

    def test_what_fell_short_is_told(self, outcome: Run):
        problem = outcome.problem
        run_in = problem.surface.run_in
        passes = (replace(run_in.passes[0], at_end=True), *run_in.passes[1:])
        run_in = replace(run_in, status="passes spent", passes=passes)
        surface = replace(problem.surface, run_in=run_in)
        plan = make_plan(replace(problem, surface=surface), MODELS)
        short = [text for text in plan.assumptions if text.startswith("running-in")][1:]
        assert "has not settled in" in short[0] and "from −30 µm" in short[1]
        moved = posed(outcome, problem=replace(problem, surface=surface))
        [(_, said)] = lines_of(STUDY, moved)
        assert said.endswith(", not settled")

    def test_a_pass_that_did_not_converge_ends_with_status_3(self, outcome: Run):
        assert outcome.exit_status != ExitStatus.NOT_CONVERGED
        problem = outcome.problem
        run_in = problem.surface.run_in
        passes = (replace(run_in.passes[0], converged=False), *run_in.passes[1:])
        surface = replace(problem.surface, run_in=replace(run_in, passes=passes))
        failed = posed(outcome, problem=replace(problem, surface=surface))
        failed = refound(failed, "running_in", statements=(Statement("converged", "no"),))
        assert not failed.converged
        assert failed.exit_status == ExitStatus.NOT_CONVERGED
        said = headline(failed)
        assert said.kind == "not converged"
        assert f"running-in, 1 of {len(passes)} passes" in said.within.sentence
