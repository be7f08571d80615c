"""What friction does by moving the surfaces: measured, told, judged, and left out where nothing."""

import json
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

import comparisons.assessment.normal_tangential_coupling
from comparisons.assessment.effects.estimates import estimates
from comparisons.assessment.normal_tangential_coupling import BEYOND_THE_END, SHIFT, couplings
from comparisons.common.errors import SceneError
from comparisons.common.numbers import UNKNOWN
from comparisons.common.progress import Stages, no_progress
from comparisons.common.quantities import QUANTITIES
from comparisons.models.half_plane import half_plane_level
from comparisons.models.level import ModelRun
from comparisons.models.plan import make_plan
from comparisons.models.problem import problem_of
from comparisons.report.tables.comparison import coupling_line, coupling_table
from comparisons.results.outcome import Outcome
from comparisons.runs.run import run
from comparisons.scenes.resolve import resolve_tables

REFERENCES = json.loads(
    (Path(__file__).resolve().parents[2] / "data" / "f_rounded_punch_and_sliding.json").read_text(
        encoding="utf-8"
    )
)["sliding_cylinder"]
STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
RIGID = {
    "title": "Rigid roller",
    "roller": {"radius": 8e-3, "rigid": True},
    "body": dict(STEEL),
    "load": {"per_length": 1e6, "friction": [0.0, 0.1, 0.3]},
}
FIELD = {"points": [60, 20]}
HALF_PLANE = ("half_plane",)


def scene_of(tables: dict, **load):
    tables = {**tables, "load": {**tables["load"], **load}}
    return resolve_tables(tables, name="made", folder=Path("."), source="made.toml")


def solved(tables: dict, **load) -> Outcome:
    """A run that leaves no files: drawing them takes longer than all the rest."""
    with patch("comparisons.runs.run.write_files"):
        return run(scene_of(tables, **load), Path("made"), HALF_PLANE)


def half_plane_of(problem) -> ModelRun:
    plan = make_plan(problem, HALF_PLANE)
    levels = (
        half_plane_level(problem, plan, pitch, None, Stages(no_progress))
        for pitch in problem.pitches
    )
    return ModelRun("half_plane", tuple(levels))


def coupling_estimate(problem, couplings) -> dict | None:
    """How much friction may change by moving the surfaces, by quantity."""
    return estimates(problem, problem.hertz.peak_pressure, (), couplings).get(
        "normal_tangential_coupling"
    )


@pytest.fixture(scope="module")
def rigid() -> Outcome:
    """Three friction coefficients, with a field."""
    scene = scene_of(RIGID | {"stress": FIELD})
    return run(scene, None, HALF_PLANE)


@pytest.fixture(scope="module")
def rigid_coupled() -> Outcome:
    return solved(RIGID | {"stress": FIELD}, friction=0.3, coupled=True)


class TestFigures:
    @pytest.mark.parametrize("entry", [1, 2])
    def test_changes_are_those_of_the_exact_sliding_cylinder(self, rigid, entry):
        """Rigid on nu = 0.3: beta = 2/7, mu = 0.1 and 0.3."""
        reference = REFERENCES[entry - 1]
        model = rigid.result["models"]["half_plane"][entry]
        assert model["friction"] == float(reference["mu"]) and reference["beta"] == "2/7"
        found, hertz = model["normal_tangential_coupling"], rigid.problem.hertz
        wider = float(reference["ahalf_over_aHertz_same_load"])
        peak = float(reference["peak_over_p0Hertz_same_load"])
        shift = float(reference["load_line_x_over_ahalf"]) * wider
        assert found["peak_pressure"]["difference"] == pytest.approx(peak - 1.0, abs=2e-5)
        assert found["peak_pressure"]["value"] / hertz.peak_pressure == pytest.approx(
            peak, rel=2e-5
        )
        assert found["contact_length"]["value"] / hertz.half_width == pytest.approx(
            2.0 * wider, rel=1e-3
        )
        assert found[SHIFT]["difference"] == pytest.approx(shift, rel=1e-3)
        assert found[SHIFT]["value"] == pytest.approx(shift * hertz.half_width, rel=1e-3)
        assert found["converged"] is True and model["normal_tangential_coupling_why"] is None

    def test_the_model_s_own_figures_stay_without_it(self, rigid):
        own = [model["contact"] for model in rigid.result["models"]["half_plane"]]
        assert own[0] == own[1] == own[2]
        assert own[0]["peak_pressure"] == pytest.approx(rigid.problem.hertz.peak_pressure, rel=1e-4)

    def test_no_friction_no_change(self, rigid):
        model = rigid.result["models"]["half_plane"][0]
        assert (
            model["normal_tangential_coupling"] is None
            and model["normal_tangential_coupling_why"] == "there is no friction"
        )
        assert "coupling" not in {item["step"] for item in rigid.result["skipped"]}

    def test_stresses_are_compared_too(self, rigid):
        found = rigid.result["models"]["half_plane"][2]["normal_tangential_coupling"]
        # on the surface tau1 = mu p where sx + p is what the coupling changes most
        assert -0.05 < found["tau1_max"]["difference"] < -0.005
        assert found["tau1_field_near"]["value"] is None
        near, deep = (found[f"tau1_field_{part}"]["difference"] for part in ("near", "deep"))
        assert 0.01 < deep < near < found["pressure_l2"]["difference"]

    def test_a_figure_that_is_zero_without_has_a_value_and_no_relative_change(self, rigid):
        """At friction 0.3 the largest shear stands on the surface, by a touch of the pressure."""
        problem, level = rigid.problem, rigid.runs["half_plane"].finest
        still = {"tau1_max_depth": 0.0, "contact_ratio": 0.0, "peak_pressure": 2.0}
        moved = {"tau1_max_depth": 3e-5, "contact_ratio": 0.0, "peak_pressure": 3.0}
        answers = iter([moved, still])
        with patch(
            "comparisons.assessment.normal_tangential_coupling.figures", lambda *_: next(answers)
        ):
            changes = comparisons.assessment.normal_tangential_coupling._changes(
                problem, level, level, 0.3, rigid.window
            )
        assert changes[
            "tau1_max_depth"
        ] == comparisons.assessment.normal_tangential_coupling.Change(3e-5, None)
        assert changes["contact_ratio"] == comparisons.assessment.normal_tangential_coupling.Change(
            0.0, 0.0
        )
        assert changes["peak_pressure"].difference == pytest.approx(0.5)
        told = replace(rigid.couplings[2], changes=changes)
        assert told.as_dict()["tau1_max_depth"] == {"value": 3e-5, "difference": None}
        outcome = replace(rigid, couplings=(told,))
        [row] = [row for row in coupling_table(outcome).rows if "depth" in row[0]]
        assert row[1:] == ("30.00 µm", UNKNOWN)
        effect = coupling_estimate(problem, (told,))
        assert effect["peak_pressure"] == pytest.approx(0.5)
        scale = QUANTITIES["tau1_max_depth"].scale(problem.hertz)
        assert effect["tau1_max_depth"] == pytest.approx(3e-5 / scale)

    @pytest.mark.parametrize("friction", [0.0, 0.3])
    def test_equal_materials_skip_it(self, friction):
        tables = RIGID | {"roller": {"radius": 8e-3, **STEEL}}
        outcome = solved(tables, friction=friction)
        model = outcome.result["models"]["half_plane"][0]
        skipped = {item["step"]: item["because"] for item in outcome.result["skipped"]}
        why = "equal constants" if friction else "no friction"
        assert (
            model["normal_tangential_coupling"] is None
            and why in model["normal_tangential_coupling_why"]
        )
        assert skipped["coupling"] == model["normal_tangential_coupling_why"]
        assert outcome.couplings == () and coupling_table(outcome) is None
        assert coupling_line(outcome) is None

    def test_softer_roller_moves_the_contact_the_other_way(self):
        soft = {"youngs_modulus": 3e9, "poissons_ratio": 0.3}
        one = solved(RIGID, friction=0.3)
        swapped = RIGID | {
            "roller": {"radius": 8e-3, **soft},
            "load": {"hertz_peak_pressure": 5e7},
        }
        other = solved(swapped, friction=0.3)
        assert one.couplings[0].changes[SHIFT].value < 0.0
        assert other.problem.dundurs_beta < 0.0 < other.couplings[0].changes[SHIFT].value


class TestSwitch:
    def test_coupled_answer_is_the_exact_one(self, rigid_coupled):
        reference = REFERENCES[1]
        half = rigid_coupled.problem.hertz.half_width * float(
            reference["ahalf_over_aHertz_same_load"]
        )
        contact = rigid_coupled.result["models"]["half_plane"][0]["contact"]
        [edges] = contact["patches"]
        assert edges[0] == pytest.approx(
            -half * float(reference["b_trailing_over_ahalf"]), rel=1e-3
        )
        assert edges[1] == pytest.approx(half * float(reference["c_leading_over_ahalf"]), rel=1e-3)

    def test_both_ways_round_tell_the_same_change(self, rigid, rigid_coupled):
        one, other = rigid.couplings[2].changes, rigid_coupled.couplings[0].changes
        for name in ("peak_pressure", SHIFT, "pressure_l2", "tau1_max"):
            assert one[name].difference == pytest.approx(other[name].difference, rel=0.03)

    def test_default_is_the_published_way(self):
        assert not scene_of(RIGID).coupled
        assert scene_of(RIGID).as_dict()["load"]["coupled"] is False
        assert problem_of(scene_of(RIGID)).coupling == 0.0

    def test_strong_coupling_finds_its_ground(self):
        """mu beta = 0.75 reaches beyond 1.5 Hertz half-widths, where the other answer ends."""
        tables = RIGID | {"body": {"youngs_modulus": 210e9, "poissons_ratio": 0.0}}
        shift = np.arctan(0.75) / np.pi
        half = 1.0 / np.sqrt(1.0 - 4.0 * shift**2)
        outcome = solved(tables, friction=1.5, coupled=True)
        other = solved(tables, friction=1.5)
        a = outcome.problem.hertz.half_width
        [edges] = outcome.runs["half_plane"].finest.patches / a
        assert edges == pytest.approx(
            np.array([-1.0 - 2.0 * shift, 1.0 - 2.0 * shift]) * half, abs=5e-3
        )
        assert other.problem.extent[0] / a == pytest.approx(-1.5) and edges[0] < -1.5
        length = other.couplings[0].changes["contact_length"].value
        assert length / a == pytest.approx(2.0 * half, rel=2e-3)

    def test_one_friction_alone(self):
        with pytest.raises(SceneError, match=r"load\.coupled: is true with 3 friction.*allowed"):
            scene_of(RIGID, coupled=True)

    def test_equal_materials_are_the_same_either_way(self):
        tables = RIGID | {"roller": {"radius": 8e-3, **STEEL}}
        one = solved(tables, friction=0.3)
        other = solved(tables, friction=0.3, coupled=True)
        for key in ("contact", "normal_tangential_coupling", "stress"):
            first, second = (o.result["models"]["half_plane"][0][key] for o in (one, other))
            assert first == second


class TestRoughGround:
    WAVY = RIGID | {
        "profile": {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.2e-6},
        "body": {**STEEL, "hardness": 4e9},
        "load": {"hertz_peak_pressure": 1e9, "friction": 0.3},
    }

    def test_change_under_a_hardness(self):
        outcome = solved(self.WAVY)
        [coupling] = outcome.couplings
        assert coupling.converged
        assert coupling.changes["peak_pressure"].value <= 4e9
        assert coupling.changes[SHIFT].value < 0.0

    def test_a_trace_that_ends_on_one_side_changes_nothing(self):
        """Ground is added to the grid where there is some, here behind the contact alone."""
        problem = problem_of(scene_of(self.WAVY))
        run_of_it = half_plane_of(problem)
        trace, edge = problem.scene.profile, run_of_it.finest.grid.x[-1] + 2e-6
        keep = trace.x <= edge
        short = replace(trace, x=trace.x[keep], height=trace.height[keep])
        ended = replace(problem, scene=replace(problem.scene, profile=short))
        [one] = couplings(problem, run_of_it, None, no_progress)
        [other] = couplings(ended, run_of_it, None, no_progress)
        for name, change in one.changes.items():
            assert other.changes[name].difference == pytest.approx(change.difference, abs=1e-7)

    def test_a_contact_that_goes_far_is_followed(self, monkeypatch):
        """The first stretches are too short for it."""
        tables = RIGID | {"body": {"youngs_modulus": 210e9, "poissons_ratio": 0.0}}
        problem = problem_of(scene_of(tables, friction=1.5))
        run_of_it = half_plane_of(problem)
        [expected] = couplings(problem, run_of_it, None, no_progress)
        stretched = comparisons.assessment.normal_tangential_coupling._stretched
        monkeypatch.setattr(
            comparisons.assessment.normal_tangential_coupling,
            "_stretched",
            lambda p, g, more: stretched(p, g, 1 + more // 64),
        )
        [found] = couplings(problem, run_of_it, None, no_progress)
        for name, change in expected.changes.items():
            assert found.changes[name].difference == pytest.approx(change.difference, abs=1e-7)

    def test_no_change_is_told_where_the_trace_ends(self):
        problem = problem_of(scene_of(self.WAVY))
        run_of_it = half_plane_of(problem)
        [found] = couplings(problem, run_of_it, None, no_progress)
        assert found.changes
        edge = run_of_it.finest.patches[0, 0] - 0.5e-6
        # a trace that ends just beyond the contact at rest
        cut = problem.scene.profile
        keep = (cut.x >= edge) & (cut.x <= -edge)
        short = replace(cut, x=cut.x[keep], height=cut.height[keep])
        ended = replace(problem, scene=replace(problem.scene, profile=short))
        level = run_of_it.finest
        grid = replace(
            level.grid,
            first=int(np.ceil(short.x[0] / level.grid.pitch)) + 1,
            last=int(np.floor(short.x[-1] / level.grid.pitch)) - 1,
        )
        inside = slice(grid.first - level.grid.first, grid.last - level.grid.first + 1)
        solution = replace(level.solution, pressure=level.solution.pressure[inside])
        ending = replace(run_of_it, levels=(replace(level, grid=grid, solution=solution),))
        [found] = couplings(ended, ending, None, no_progress)
        assert found.changes == {} and found.why == BEYOND_THE_END
        assert found.as_dict() is None


class TestEstimate:
    def test_measured_changes_take_the_place_of_the_estimate(self, rigid):
        effect = coupling_estimate(rigid.problem, rigid.couplings)
        last = rigid.couplings[2].changes
        for name in ("peak_pressure", "contact_length", "pressure_l2", "tau1_max_depth"):
            assert effect[name] == abs(last[name].difference)

    def test_what_was_not_measured_is_estimated(self, rigid):
        effect = coupling_estimate(rigid.problem, ())
        size = 0.3 * rigid.problem.dundurs_beta
        assert effect["pressure_l2"] == pytest.approx(1.6 * size)
        without = [replace(c, changes={}, why=BEYOND_THE_END) for c in rigid.couplings]
        assert coupling_estimate(rigid.problem, tuple(without)) == effect

    def test_what_both_models_contain_is_not_missing(self, rigid_coupled):
        assert coupling_estimate(rigid_coupled.problem, rigid_coupled.couplings) is None

    def test_equal_materials_have_no_such_effect(self, wavy_outcome):
        assert wavy_outcome.problem.dundurs_beta == 0.0
        assert coupling_estimate(wavy_outcome.problem, ()) is None
