"""The scenes that come with the project, and measured traces, through both models."""

import numpy as np
import pytest
from scenes import (
    MEASURED,
    PROJECT,
    compared_verdicts,
    finite_elements,
    half_plane_at,
    judging,
    run_of,
)

from comparisons.common.errors import ExitStatus
from comparisons.common.numbers import percent_as_written, rounded_up
from comparisons.common.progress import Stages
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.quantity import MODELS
from comparisons.judging.model_error.show import not_modelled_line
from comparisons.judging.rule import relative_l2, values_of
from comparisons.judging.verdict.headline import kind_of, within_of
from comparisons.models.finite_element.bodies import BodyCache, bodies_of
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.posing import problem_of
from comparisons.models.problem import Levels
from comparisons.scenes.scene import Scene

FEW = Levels(3, effects=2)


@pytest.mark.parametrize(
    ("name", "ratio", "peak"),
    [
        ("ground-unrun", 0.69, 2.72),
        ("ground-run-in", 0.87, 1.66),
        ("ground-polished", 0.987, 1.39),
    ],
)
def test_half_plane_on_ground_surfaces_as_the_spline_is_resolved(name, ratio, peak):
    """Contact ratio and peak pressure over p0, at a limit that five grids approach."""
    problem = problem_of(Scene.read(name))
    levels = (half_plane_at(problem, problem.pitches[0] / 2.0**n) for n in range(5))
    by_level = [values_of(level, problem) for level in levels]
    two_a = 2.0 * problem.hertz.half_width
    ratios = grid_convergence([f["contact_length"] / two_a for f in by_level], 2.0)
    peaks = grid_convergence([f["peak_pressure"] for f in by_level], 2.0)
    assert ratios.uncertainty < 2e-3 and peaks.uncertainty < 2e-3 * peaks.value
    assert ratios.limit == pytest.approx(ratio, abs=0.015)
    assert peaks.limit / problem.hertz.peak_pressure == pytest.approx(peak, rel=0.02)


def quick(name: str, effects: bool) -> Scene:
    """A shipped scene, with fewer points of the fields, which are not looked at here."""
    return Scene.read(name).unchecked({"stress.points": (60, 24), "budget.effects": effects})


@pytest.fixture
def unrun():
    """Run with tolerances that the third level meets."""
    scene = quick("ground-unrun", effects=False).unchecked({"load.friction": (0.0,)})
    wide = scene.tolerances | {"contact_length": 0.05, "tau1_max": 0.05}
    return run_of(judging(scene, wide), levels=FEW)


class TestGroundUnrun:
    def test_models_agree_but_share_what_a_flat_linear_body_lacks(self, unrun):
        """At a/R = 0.07 and pressures of 0.05 E the agreement alone proves the numerics."""
        assert unrun.exit_status == ExitStatus.INCONCLUSIVE
        assert kind_of(unrun) == "inconclusive"
        for effect in ("finite deformation", "law of elasticity"):
            assert effect in not_modelled_line(unrun)
        assert unrun.solved.refinement == "every judged quantity is resolved"
        assert len(unrun.runs["finite_element"].levels) == 3
        assert compared_verdicts(unrun) == {"agree"}

    def test_pressures_agree_on_the_same_hats(self, unrun):
        pairs = zip(*(unrun.runs[name].levels for name in MODELS), strict=True)
        differences = [
            relative_l2(one.solution.pressure, other.solution.pressure) for one, other in pairs
        ]
        assert differences[-1] < 3e-3
        assert differences[0] > differences[1] > differences[2]

    def test_asperities_carry_at_least_twice_the_smooth_shear_near_the_surface(self, unrun):
        """Bailey and Sayles found this on unrun ground surfaces, by both models."""
        hertz = unrun.problem.hertz
        for model in MODELS:
            known = unrun.figures.of(study="contact", source=model)
            assert known.one(quantity="tau1_max").value > 2.0 * hertz.tau1_max
            assert known.one(quantity="tau1_max_depth").value < 0.05 * hertz.half_width

    def test_below_half_a_the_field_is_that_of_smooth_bodies(self, unrun):
        from analytic.exact.hertz import hertz_stress

        deep = unrun.window.z > 0.5 * unrun.problem.hertz.half_width
        x, z = np.meshgrid(unrun.window.x, unrun.window.z[deep])
        smooth = hertz_stress(unrun.problem.hertz, x, z).tau1
        for model in unrun.runs.values():
            rough = model.finest.stress.field.tau1[deep]
            assert np.linalg.norm(rough - smooth) / np.linalg.norm(smooth) < 0.05


def test_the_independent_solver_agrees_on_a_rough_scene():
    """Our iteration on the compliance, and PETSc's variational inequality on the whole system. Of
    two equal blocks the first has one, with twice its compliance, the second the same one twice."""
    from fem.body.surface import hat_forces
    from fem.contact.variational_inequality import solve_variational_inequality

    problem = problem_of(Scene.read("sinusoid"))
    level = finite_elements(problem)
    grid, pressure = level.grid, level.solution.pressure
    assert len(level.patches) >= 5
    bodies = bodies_of(problem, Refinement(grid.pitch), level.patches, Stages(), BodyCache())
    assert (bodies.roller, bodies.roller_share) == (None, 1.0)
    other = solve_variational_inequality(
        [(bodies.rough, hat_forces(bodies.rough.surface, grid.hats))] * 2,
        grid.hat_integrals(problem.gap, problem.knots),
        grid.weights,
        problem.hertz.load_per_length,
    )
    assert other.pressure == pytest.approx(pressure, abs=1e-6 * pressure.max())
    assert grid.weights @ other.pressure == pytest.approx(level.solution.load, rel=1e-6)


@pytest.mark.parametrize("name", ["self-affine", "sinusoid", "smooth-sliding"])
def test_other_scenes_agree(name):
    outcome = run_of(quick(name, effects=False), levels=FEW)
    assert outcome.exit_status == ExitStatus.INCONCLUSIVE  # no effect is computed
    assert "agree" in compared_verdicts(outcome)


@pytest.mark.parametrize(
    ("name", "verdict", "peak", "length"),
    [
        # what a thin incompressible layer, and a coating, do is none of the half-plane's
        ("layer", "fails", -0.58, 1.08),
        # the largest shear stands on the coating's lower side, where elements resolve it slowly
        ("coated", "inconclusive", -5.3e-3, 1.4e-2),
        ("finite-strain", "holds", -5.2e-3, 5.5e-3),
    ],
)
def test_scenes_that_leave_an_assumption_behind(name, verdict, peak, length):
    outcome = run_of(quick(name, effects=True), levels=FEW)
    assert kind_of(outcome) == verdict
    by_level = {row.quantity: row.value for row in outcome.figures.of(study="comparison")}
    assert by_level["peak_pressure"] == pytest.approx(peak, rel=0.1)
    assert by_level["contact_length"] == pytest.approx(length, rel=0.1)


def test_the_run_in_flank_of_case_hardened_steel_holds():
    """At 1.2 GPa, whichever published steel's third-order constants it has, and nothing flows."""
    outcome = run_of(quick("gear-flank", effects=True))
    assert kind_of(outcome) == "holds"
    size = within_of(outcome).size
    assert 0.02 < size < 0.04 < outcome.problem.scene.tolerances["peak_pressure"]
    said = f"within {percent_as_written(rounded_up(size))}"
    for page in ("README.md", "comparisons/docs/user_guide.md"):
        assert said in (PROJECT / page).read_text(encoding="utf-8")
    assert all(error.part("law_of_elasticity") is not None for error in outcome.model_errors)
    yield_stress = outcome.problem.scene.body.yield_stress
    shears = outcome.figures.of(study="contact", quantity="tau1_max")
    assert 0.5 * yield_stress > max(figure.value for figure in shears) > 0.3 * yield_stress


@pytest.mark.parametrize(
    ("trace", "load"),
    [
        ("real_stylus_mitutoyo", "3.55 N/um"),
        ("real_confocal_lay_row", "0.5 N/um"),
        ("real_stylus_dektak", "0.5 N/um"),
    ],
)
def test_measured_traces_from_a_scene_of_five_lines(trace, load, tmp_path):
    path = MEASURED / f"{trace}.csv"
    if not path.exists():
        pytest.skip(f"{path.name} is not there: measured by others, it is not shipped")
    scene = tmp_path / "trace.toml"
    scene.write_text(
        'roller = {radius = "7.5706 mm", youngs_modulus = "210 GPa", poissons_ratio = 0.3}\n'
        'body = {youngs_modulus = "210 GPa", poissons_ratio = 0.3}\n'
        f'profile = {{file = "{path}", x_unit = "um", z_unit = "um"}}\n'
        f'load = {{per_length = "{load}"}}\n'
        "tolerance = {peak_pressure = 0.05, contact_length = 0.05}\n"
        "budget = {effects = false}\n"
    )
    outcome = run_of(Scene.read(scene))
    assert outcome.exit_status in (ExitStatus.DONE, ExitStatus.INCONCLUSIVE)
    assert compared_verdicts(outcome) == {"agree"}
