"""Running-in as part of a scene: read, refused, carried out, told, repeated."""

import copy
import json
from collections.abc import Callable
from dataclasses import replace
from io import StringIO
from pathlib import Path

import numpy as np
import pytest

import comparisons.running_in
from analytic.exact.hertz import hertz_from_load
from analytic.profile import Profile
from analytic.roughness import roughness
from analytic.running_in import run_in
from comparisons.cli import main
from comparisons.errors import SceneError
from comparisons.exit_status import ExitStatus
from comparisons.outcome import Outcome
from comparisons.plan import MODELS, make_plan
from comparisons.problem import problem_of
from comparisons.report.headline import headline
from comparisons.report.page import render
from comparisons.report.running_in_picture import running_in_in_words
from comparisons.report.sheet import problem_sheet
from comparisons.resolve import load_scene, resolve_tables
from comparisons.running_in import run_in_scene
from comparisons.scene import ResolvedScene
from comparisons.table import run_in_text, summary

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
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


def resolved(changes: dict | None = None, source: dict = WAVY) -> ResolvedScene:
    """The wavy scene with fields of sections replaced; None takes a field or a section away."""
    tables = copy.deepcopy(source)
    for section, fields in (changes or {}).items():
        if fields is None:
            tables.pop(section, None)
            continue
        merged = {**tables.get(section, {}), **fields}
        tables[section] = {name: value for name, value in merged.items() if value is not None}
    return resolve_tables(tables, name="wavy", folder=Path("."), source="wavy.toml")


class TestReading:
    def test_a_stroke_is_centred_on_the_roller(self):
        scene = resolved({"load": {"position": 5e-6}})
        assert scene.running_in.positions == pytest.approx([-25e-6, -10e-6, 5e-6, 20e-6, 35e-6])
        assert scene.running_in.hardness == HARDNESS
        assert scene.running_in.sweeps == 10 and scene.running_in.load is None

    def test_positions_are_places_on_the_trace_in_their_order(self):
        positions = [20e-6, -30e-6, 0.0]
        scene = resolved({"running_in": {"positions": positions, "stroke": None, "passes": None}})
        assert scene.running_in.positions == tuple(positions)

    def test_defaults_are_written_out_and_read_again(self):
        scene = resolved(
            {"body": {"hardness": 3e9}, "running_in": {"hardness": None, "passes": None}}
        )
        assert scene.running_in.hardness == 3e9
        assert len(scene.running_in.positions) == 15
        table = scene.tables["running_in"]
        assert table == {"hardness": 3e9, "stroke": 60e-6, "passes": 15, "sweeps": 10}
        again = resolve_tables(
            json.loads(json.dumps(scene.tables)), name="wavy", folder=Path("."), source="x"
        )
        assert again == scene and np.array_equal(again.profile.x, scene.profile.x)

    def test_without_the_section_nothing_is_there(self):
        scene = resolved({"running_in": None})
        assert scene.running_in is None and scene.as_dict()["running_in"] is None
        assert "running_in" not in scene.tables
        problem = problem_of(scene)
        plan = make_plan(problem, MODELS)
        assert problem.scene is scene and not plan.running_in
        assert not any("running-in" in text for text in plan.assumptions)
        assert not any("running" in skipped.step for skipped in plan.skipped)

    def test_a_made_trace_is_long_enough_for_the_stroke(self):
        one = resolved({"running_in": None}).profile.length
        assert resolved().profile.length - one == pytest.approx(60e-6, abs=2e-6)
        places = {"positions": [-50e-6, 10e-6], "stroke": None, "passes": None}
        longer = resolved({"running_in": places}).profile.length
        assert longer - one == pytest.approx(100e-6, abs=2e-6)


# fields of [running_in] and of other sections, how the line goes on after "wavy.toml: "
WRONG = [
    ({"hardness": None}, "running_in.hardness: is missing; allowed is a pressure above 0, here or"),
    ({"hardness": 0.0}, "running_in.hardness: is 0.0; allowed is a pressure above 0"),
    ({"hardness": "7 mm"}, 'running_in.hardness: is "7 mm", a length; allowed is a pressure'),
    ({"load": -1.0}, "running_in.load: is -1.0; allowed is a load per length above 0"),
    ({"load": "3 GPa"}, 'running_in.load: is "3 GPa", a pressure; allowed is a load per length'),
    ({"stroke": None, "passes": None}, "running_in.positions: is missing; allowed is exactly one"),
    ({"positions": [0.0]}, "running_in.stroke: is given beside positions; allowed is exactly one"),
    (
        {"positions": [0.0], "stroke": None},
        "running_in.passes: is given beside positions, which are one pass each; allowed with",
    ),
    (
        {"positions": [], "stroke": None, "passes": None},
        "running_in.positions: is an empty list; allowed is a length",
    ),
    (
        {"positions": [0.0, "4 GPa"], "stroke": None, "passes": None},
        'running_in.positions: is "4 GPa", a pressure; allowed is a length',
    ),
    (
        {"positions": [0.0, 1e-6, 0.0], "stroke": None, "passes": None},
        "running_in.positions: lists 0 twice; allowed is",
    ),
    ({"stroke": 0.0}, "running_in.stroke: is 0.0; allowed is a length above 0"),
    ({"passes": 1}, "running_in.passes: is 1; allowed is a whole number from 2 to 1000"),
    ({"passes": 2.0}, "running_in.passes: is 2.0; allowed is a whole number"),
    ({"sweeps": 0}, "running_in.sweeps: is 0; allowed is a whole number from 1 to 1000"),
    ({"sweeps": True}, "running_in.sweeps: is true; allowed is a whole number"),
    ({"sweep": 3}, "running_in.sweep: is no known field; the nearest is running_in.sweeps"),
]


@pytest.mark.parametrize(("fields", "line"), WRONG)
def test_a_wrong_field_is_named_with_what_is_allowed(fields, line):
    with pytest.raises(SceneError) as error:
        resolved({"running_in": fields})
    assert str(error.value).startswith(f"wavy.toml: {line}")


class TestRestOfTheScene:
    def refused(self, changes: dict) -> str:
        with pytest.raises(SceneError) as error:
            resolved(changes)
        return str(error.value)

    def test_a_smooth_surface_has_nothing_to_run_in(self):
        found = self.refused({"profile": None})
        assert found == (
            "wavy.toml: running_in: is given for a smooth surface; allowed only with [profile]"
        )

    def test_an_approach_is_no_load_to_run_in_under(self):
        rigid = {"rigid": True, "youngs_modulus": None, "poissons_ratio": None}
        layer = {
            "roller": rigid,
            "body": {"thickness": 1e-3},
            "load": {"per_length": None, "approach": 1e-6},
        }
        found = self.refused(layer)
        assert found.startswith("wavy.toml: running_in.load: is missing; allowed is a load per")
        scene = resolved({**layer, "running_in": {"load": LOAD}})
        assert scene.running_in.load == LOAD

    def test_the_roller_must_stay_on_the_trace(self):
        length = {"profile": {"length": 1e-3}}
        places = {"positions": [0.0, 0.6e-3], "stroke": None, "passes": None}
        assert self.refused({**length, "running_in": places}) == (
            "wavy.toml: running_in.positions: is 0.0006 m; allowed is inside the trace, above "
            "-0.0005 m and below 0.0005 m"
        )
        assert self.refused({**length, "running_in": {"stroke": 1.2e-3}}) == (
            "wavy.toml: running_in.stroke: is 0.0012 m; allowed is below 0.001 m, to stay on the "
            "trace about the roller's centre"
        )

    def test_a_body_too_soft_to_carry_the_load(self):
        with pytest.raises(SceneError, match=r"^wavy.toml: running_in.hardness: the load 200000 N"):
            run_in_scene(resolved({"running_in": {"hardness": 1e8}}))

    def test_the_command_line_says_one_line_and_writes_nothing(self, tmp_path, monkeypatch, capsys):
        monkeypatch.chdir(tmp_path)
        (tmp_path / "wrong.toml").write_text(
            '[roller]\nradius = "10 mm"\nrigid = true\n'
            '[body]\nyoungs_modulus = "210 GPa"\npoissons_ratio = 0.3\n'
            '[profile]\nkind = "sinusoid"\nwavelength = "40 um"\namplitude = "0.1 um"\n'
            '[running_in]\nstroke = "60 um"\n'
            "[load]\nper_length = 2e5\n"
        )
        assert main(["run", "wrong.toml"]) == ExitStatus.BAD_INPUT
        out, err = capsys.readouterr()
        assert out == "" and err.count("\n") == 1
        assert err.startswith("crosscheck: wrong.toml: running_in.hardness: is missing; allowed")
        assert [path.name for path in tmp_path.iterdir()] == ["wrong.toml"]


class TestProblem:
    def test_the_run_in_surface_is_the_one_that_is_pressed(self):
        scene = resolved()
        problem = problem_of(scene)
        worn = problem.scene.worn
        assert worn.volume > 0.0 and worn.converged and worn.status == "shaken down"
        assert problem.scene.profile is worn.profile
        assert problem.scene.profile_info.roughness == roughness(worn.profile)
        x = np.linspace(-50e-6, 50e-6, 999)
        lowered = scene.profile.spline()(x) - worn.profile.spline()(x)
        assert problem.gap(x) == pytest.approx(
            x**2 / (2.0 * RADIUS) - scene.profile.spline()(x) + lowered, abs=1e-18
        )
        assert lowered.max() > 1e-9

    def test_it_is_run_in_under_the_scenes_pair_load_and_places(self):
        scene = resolved({"load": {"position": 5e-6}})
        worn = run_in_scene(scene).worn
        other = run_in(
            scene.profile.shifted(-5e-6),
            RADIUS,
            PAIR.combined_modulus,
            worn.constraints,
            np.array(scene.running_in.positions),
            pitch=worn.pitch,
        )
        assert worn.constraints.load == LOAD and worn.constraints.hardness == HARDNESS
        assert other.volume == pytest.approx(worn.volume, rel=1e-6)
        assert worn.passes[0].position == pytest.approx(-30e-6)

    @pytest.mark.parametrize(
        ("load", "own", "expected"),
        [
            ({"per_length": None, "hertz_peak_pressure": PAIR.peak_pressure}, None, LOAD),
            ({}, 1.5 * LOAD, 1.5 * LOAD),
        ],
    )
    def test_the_load_is_its_own_or_the_scenes(self, load, own, expected):
        scene = run_in_scene(resolved({"load": load, "running_in": {"load": own}}))
        assert scene.worn.constraints.load == pytest.approx(expected, rel=1e-12)

    def test_running_in_is_done_once(self, monkeypatch):
        problem = problem_of(resolved())

        def again(*arguments, **named):
            pytest.fail("run in twice")

        monkeypatch.setattr(comparisons.running_in, "run_in", again)
        assert problem_of(problem.scene).scene is problem.scene

    def test_hats_are_fine_enough_for_the_volume_and_nest_in_the_samples(self):
        scene = run_in_scene(resolved())
        worn = scene.worn
        octaves = np.log2(worn.pitch / worn.before.spacing)
        assert octaves == pytest.approx(round(octaves), abs=1e-9)
        finer = run_in(
            worn.before,
            RADIUS,
            PAIR.combined_modulus,
            worn.constraints,
            np.array(scene.running_in.positions),
            pitch=0.25 * worn.pitch,
        )
        assert worn.volume == pytest.approx(finer.volume, rel=5e-3)

    def test_a_long_flat_trace_does_not_ask_for_more_hats_than_the_contact_needs(self):
        scene = resolved()
        x = np.linspace(-2e-3, 2e-3, 2001)
        waves = Profile(x, 1e-12 * np.cos(2.0 * np.pi * x / 8e-6))
        scene = run_in_scene(replace(scene, profile=waves))
        assert scene.worn.pitch > PAIR.half_width / 2500.0


@pytest.fixture(scope="module")
def outcome(finish: Callable[..., Outcome]) -> Outcome:
    return finish({**WAVY, "title": "Wavy, run in", "stress": {"points": [60, 20]}})


class TestTelling:
    def test_result(self, outcome: Outcome):
        told, worn = outcome.result["running_in"], outcome.problem.scene.worn
        assert told["passes"] == len(worn.passes) == 5 * told["sweeps"]
        assert told["volume_moved"] == worn.volume == sum(told["volume_by_pass"])
        assert told["largest_lowering"] == worn.largest_lowering > 0.0
        assert told["shaken_down"] is True and told["converged"] is True
        assert told["at_ends_of_trace"] == []
        assert told["roughness_before"]["rq"] > told["roughness_after"]["rq"] > 0.0
        assert outcome.result["groups"]["rms_slope"] == told["roughness_after"]["rms_slope"]
        assert json.loads(json.dumps(outcome.result, allow_nan=False)) == outcome.result
        for model in outcome.result["models"].values():
            assert model[0]["contact"]["peak_pressure"] < 1.03 * HARDNESS

    def test_result_without_running_in(self, wavy_outcome: Outcome):
        assert wavy_outcome.result["running_in"] is None
        assert "running-in" not in render(wavy_outcome)

    def test_plan_and_assumptions(self, outcome: Outcome):
        assert outcome.plan.running_in
        [said] = [text for text in outcome.plan.assumptions if text.startswith("running-in")]
        assert "what flows is lost" in said

    def test_report_shows_both_surfaces_and_one_sentence(self, outcome: Outcome, monkeypatch):
        from comparisons.report import running_in_picture

        figures = []
        monkeypatch.setattr(
            running_in_picture, "data_uri", lambda figure: figures.append(figure) or "data:"
        )
        picture = running_in_picture.running_in_picture(outcome)
        worn = outcome.problem.scene.worn
        assert len(figures) == 2  # wide and narrow
        for figure in figures:
            [axes] = figure.axes
            lines = {line.get_label(): line.get_xydata() for line in axes.lines}
            assert axes.get_xlabel() == "x [µm]" and axes.get_ylabel() == "height [nm]"
            for label, profile in (("before running-in", worn.before), ("after", worn.profile)):
                points = lines[label]
                assert points[:, 1] * 1e-9 == pytest.approx(
                    profile.spline()(points[:, 0] * 1e-6), abs=1e-15
                )
        said = running_in_in_words(outcome.problem.scene)
        assert picture.caption.endswith(said)
        assert f"In {len(worn.passes)} passes ({worn.sweeps} sweeps over 5 places)" in said
        assert said.count(". ") == 0 and said.endswith(" deep.")
        page = render(outcome)
        assert '<section id="running-in">' in page and page.index("running-in") > 0

    def test_table(self, outcome: Outcome):
        from rich.console import Console

        console = Console(width=80, record=True, file=StringIO())
        console.print(summary(outcome))
        shown = console.export_text().splitlines()
        [row] = [line for line in shown if line.startswith("run in")]
        worn = outcome.problem.scene.worn
        assert f"moved in {len(worn.passes)} passes, shaken down" in row
        peak = max(run.finest.solution.pressure.max() for run in outcome.runs.values())
        softer = replace(worn.constraints, hardness=peak / 1.8)
        scene = replace(outcome.problem.scene, worn=replace(worn, constraints=softer))
        sharp = replace(outcome, problem=replace(outcome.problem, scene=scene))
        assert run_in_text(sharp).endswith("; pressed then, up to 1.80 times its hardness")
        assert "times its hardness" not in row
        [surface] = [line for line in shown if line.startswith("surface")]
        assert "before running-in " in surface or "at the cut-off" not in surface
        assert "Roughness before running-in (ISO 21920-2)" in dict(problem_sheet(outcome))

    def test_what_fell_short_is_told(self, outcome: Outcome):
        problem = outcome.problem
        worn = problem.scene.worn
        passes = (replace(worn.passes[0], at_end=True), *worn.passes[1:])
        scene = replace(problem.scene, worn=replace(worn, status="passes spent", passes=passes))
        plan = make_plan(replace(problem, scene=scene), MODELS)
        short = [text for text in plan.assumptions if text.startswith("running-in")][1:]
        assert "has not shaken down in" in short[0] and "-3e-05 m" in short[1]
        said = running_in_in_words(scene)
        assert "it has not shaken down." in said and "an end of the trace" in said

    def test_hats_too_coarse_for_the_surface_are_told(self, monkeypatch):
        monkeypatch.setattr(comparisons.running_in, "MOST_HATS", 100)
        problem = problem_of(resolved())
        worn = problem.scene.worn
        [said] = [
            text
            for text in make_plan(problem, MODELS).assumptions
            if "too coarse for the shortest waves" in text
        ]
        assert f"{worn.pitch:g} m apart" in said

    def test_a_pass_that_did_not_converge_ends_with_status_3(self, outcome: Outcome):
        assert outcome.exit_status in (ExitStatus.DONE, ExitStatus.OUTSIDE_TOLERANCE)
        problem = outcome.problem
        worn = problem.scene.worn
        passes = (replace(worn.passes[0], converged=False), *worn.passes[1:])
        scene = replace(problem.scene, worn=replace(worn, passes=passes))
        failed = replace(outcome, problem=replace(problem, scene=scene))
        assert not failed.converged
        assert failed.exit_status == ExitStatus.NOT_CONVERGED
        said = headline(failed)
        assert said.kind == "not converged"
        assert f"running-in, 1 of {len(passes)} passes" in said.sentence


class TestRun:
    @pytest.fixture(scope="class")
    @classmethod
    def done(cls, tmp_path_factory) -> Outcome:
        from comparisons.run import run

        heard = []
        out = tmp_path_factory.mktemp("run-in") / "out"
        outcome = run(resolved(), out, ("half_plane",), heard.append)
        assert "running the surface in" in heard
        return outcome

    def test_files_hold_the_surface_before_and_after(self, done: Outcome):
        worn, out = done.problem.scene.worn, done.directory
        table = np.loadtxt(out / "run_in_profile.csv", delimiter=",", skiprows=1)
        header = (out / "run_in_profile.csv").read_text().splitlines()[0]
        assert header == "x [m],height before running-in [m],height [m]"
        assert table[:, 0] == pytest.approx(worn.profile.x, rel=1e-11)
        assert table[:, 1] - table[:, 2] == pytest.approx(worn.lowering, abs=1e-17)
        assert json.loads((out / "result.json").read_text())["running_in"]["shaken_down"] is True
        assert not (done.directory / "half_plane" / "run_in_profile.csv").exists()

    def test_the_record_holds_the_surface_before_and_repeats_the_run(self, done: Outcome, tmp_path):
        from comparisons.run import run

        record = json.loads((done.directory / "record.json").read_text())
        trace = done.problem.scene.worn.before
        assert record["profile"]["x"] == trace.x.tolist()
        assert record["profile"]["height"] == trace.height.tolist()
        scene = resolve_tables(record["scene"], name="wavy", folder=Path("."), source="record")
        placed = Profile(np.array(record["profile"]["x"]), np.array(record["profile"]["height"]))
        again = run(replace(scene, profile=placed), tmp_path / "again", ("half_plane",))
        assert again.record["hashes"] == done.record["hashes"]
        assert set(done.record["hashes"]) == {"half_plane_pressure", "run_in_profile"}
        assert again.result["running_in"] == done.result["running_in"]


def test_the_scene_that_comes_along_flattens_the_unrun_surface_to_its_hardness():
    """On ground as steep as the unrun, peaks end at the hardness, and little material goes."""
    scene = load_scene("ground-running-in")
    problem = problem_of(scene)
    worn = problem.scene.worn
    assert worn.status == "shaken down" and worn.converged
    assert not any(one.at_end for one in worn.passes)
    assert 1e-12 * 30.0 < worn.volume < 1e-12 * 45.0
    from comparisons.half_plane import half_plane_level
    from comparisons.stages import Stages

    plan = make_plan(problem, ("half_plane",))
    level = half_plane_level(problem, plan, problem.pitches[-1], None, Stages())
    peak = level.solution.pressure.max()
    assert peak == pytest.approx(scene.running_in.hardness, rel=0.02)
    unrun = problem_of(load_scene("ground-unrun"))
    before = half_plane_level(unrun, plan, unrun.pitches[-1], None, Stages())
    assert before.solution.pressure.max() > 1.5 * peak
    ratios = [found.contact_length / problem.hertz.half_width / 2.0 for found in (before, level)]
    assert ratios == pytest.approx([0.69, 0.72], abs=0.01)
