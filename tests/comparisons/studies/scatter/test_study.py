"""Uncertain inputs of a scene against Hertz's closed form, and what a run makes of them. Shares of
variance against functions whose shares are known, and where these must vanish."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from scenes import PROFILES, SMOOTH, as_toml, changed, half_plane_at, problem, resolved, run_of

from analytic.exact.hertz import hertz_from_load
from analytic.material import combined_modulus
from comparisons.cli import main
from comparisons.common.cache import Cache
from comparisons.common.executors import ExecutorWorker
from comparisons.common.tasks import Tasks
from comparisons.judging.study import unsolved
from comparisons.models.level import Solution
from comparisons.models.plan import make_plan
from comparisons.output.result import read_result
from comparisons.runs.run import run
from comparisons.scenes.studies.scatter import Spread
from comparisons.scenes.surface import surface_of
from comparisons.studies.scatter.shares import designs, shares
from comparisons.studies.scatter.study import begin, sampled, solve, values_at

INPUTS = {"load": "4 %", "body_youngs_modulus": "6 %", "roller_radius": "3 %"}
SCENE = changed(SMOOTH, scatter=INPUTS | {"samples": 64, "seed": 3})
TRACE = {"file": str(PROFILES / "ground_polished.csv"), "x_unit": "um", "z_unit": "um"}
ROUGH = changed(SMOOTH, profile=TRACE, load={"per_length": 2e5})


@pytest.fixture
def outcome():
    return run_of(SCENE, "half_plane")


@pytest.fixture(scope="module")
def exact():
    """Hertz's peak pressure and contact length of many random samples of the same inputs."""
    scene, rng = resolved(SCENE), np.random.default_rng(0)
    surface = surface_of(scene)
    pairs = []
    for point in rng.random((20_000, 3)):
        one, _ = sampled(scene, surface, point)
        modulus = combined_modulus(one.roller.material, one.body.material)
        hertz = hertz_from_load(one.load.value, one.roller.radius, modulus)
        pairs.append((hertz.peak_pressure, 2.0 * hertz.half_width))
    return dict(zip(("peak_pressure", "contact_length"), np.array(pairs).T, strict=True))


@pytest.mark.parametrize("quantity", ["peak_pressure", "contact_length"])
def test_mean_and_interval_are_those_of_hertz(outcome, exact, quantity):
    figure, values = outcome.figures.one(study="scatter", quantity=quantity), exact[quantity]
    assert figure.value == pytest.approx(np.median(values), rel=2e-3)
    assert figure.spread.mean == pytest.approx(values.mean(), rel=2e-3)
    assert figure.spread.deviation == pytest.approx(values.std(), rel=0.1)
    low, high = np.percentile(values, (2.5, 97.5))
    assert figure.by_inputs == pytest.approx(0.5 * (high - low) / np.median(values), rel=0.15)


def test_shares_are_those_of_the_powers_in_hertz(outcome):
    """p0 goes with the roots of P, E* and 1/R, and E* with half a power of one of two equal
    moduli."""
    parts = np.array([0.5 * 4.0, 0.25 * 6.0, 0.5 * 3.0]) ** 2
    shares = outcome.figures.one(study="scatter", quantity="peak_pressure").spread.shares
    assert set(shares) == set(INPUTS)
    for name, part in zip(INPUTS, parts, strict=True):
        assert shares[name]["first"] == pytest.approx(part / parts.sum(), abs=0.06)
        assert shares[name]["total"] == pytest.approx(part / parts.sum(), abs=0.06)


def test_samples_are_counted(outcome):
    [counts] = outcome.findings["scatter"].table("samples").rows()
    assert counts["solutions"] == 64 * (3 + 2) and counts["failed"] == 0
    assert "scatter" not in run_of(SMOOTH, "half_plane").findings


def test_it_is_the_same_again_and_by_any_executor(outcome):
    with ThreadPoolExecutor(1) as executor:
        opens = partial(ExecutorWorker, executor)
        again = run(resolved(SCENE), None, ("half_plane",), opens=opens)
    assert again.figures.of(study="scatter") == outcome.figures.of(study="scatter")
    other = run_of(SCENE, "half_plane", scatter={"seed": 4})
    assert other.figures.of(study="scatter") != outcome.figures.of(study="scatter")


def test_the_band_of_pressures_holds_the_nominal_one(outcome):
    scatter, level = outcome.data("scatter"), outcome.runs["half_plane"].levels[0]
    middle = np.abs(scatter.x) < 0.8 * outcome.problem.hertz.half_width
    pressure = level.solution.pressure[middle]
    assert np.all((scatter.band[0][middle] < pressure) & (pressure < scatter.band[1][middle]))


def test_a_run_says_it(tmp_path, capsys, drawn_only):
    scene = tmp_path / "uncertain.toml"
    tables = SMOOTH | {
        "scatter": {"load": "6 %", "samples": 16},
        "tolerance": {"peak_pressure": 0.02, "contact_length": 0.02},
        "resolution": {"levels": 2},
        "budget": {"effects": False},
    }
    scene.write_text(as_toml(tables))
    out = tmp_path / "out"
    with drawn_only("pressure"):
        assert main(["run", str(scene), "--out", str(out)]) in (1, 4)
        page = (out / "report.html").read_text()
        assert main(["report", str(out)]) == 0
    assert (out / "report.html").read_text() == page
    said = " ".join(capsys.readouterr().out.split())
    assert "Your inputs move the" in said and "most by load 100%" in said
    assert 'id="inputs"' in page and "Saltelli" in page
    [scatter] = read_result(out).figures.of(study="scatter", quantity="peak_pressure")
    # the root of a load of 6 %, 1.96 deviations to either side
    low, high = scatter.spread.interval
    assert 0.5 * (high - low) / scatter.value == pytest.approx(0.03 * 1.96, rel=0.1)


def test_finished_samples_are_not_solved_again(tmp_path, monkeypatch):
    kept, posed = Cache(tmp_path, "key", {}), problem(changed(SCENE, scatter={"samples": 8}))
    half_plane = Solution("half_plane", (half_plane_at(posed),))
    scene = unsolved(posed, make_plan(posed, ("half_plane",)))

    def solve_all():
        tasks = Tasks(kept=kept)
        begin(scene, tasks)
        case = replace(scene.cases[0], runs={"half_plane": half_plane})
        return solve(replace(scene, cases=(case,)), {}, tasks)

    first = solve_all()
    monkeypatch.setattr("comparisons.studies.scatter.study._solve_batch", None)
    again = solve_all()
    assert again.figures == first.figures
    np.testing.assert_array_equal(again.data.band, first.data.band)


class TestASample:
    def test_normal_and_uniform_inputs_have_their_quantiles(self):
        share = np.linspace(0.0005, 0.9995, 1000)
        normal = values_at(Spread(2.0), 10.0, share)
        assert normal.mean() == pytest.approx(10.0)
        assert normal.std() == pytest.approx(2.0, rel=0.02)
        assert normal.min() > 4.0 and normal.max() < 16.0
        relative = values_at(Spread(0.1, relative=True), -10.0, share)
        assert relative.std() == pytest.approx(1.0, rel=0.02)
        assert values_at(Spread(range=(1.0, 3.0)), 99.0, share) == pytest.approx(1.0 + 2.0 * share)

    def test_the_roller_moves_along_the_trace(self):
        scene = resolved(changed(ROUGH, scatter={"position": 20e-6}))
        [left] = designs(8, 1, 0)[0][:1]
        surface = surface_of(scene)
        _, moved = sampled(scene, surface, left)
        far = values_at(Spread(20e-6), 0.0, left[0])
        assert moved.position == pytest.approx(surface.position + far)
        assert moved.profile.x == pytest.approx(surface.profile.x - far)
        assert np.array_equal(moved.profile.height, surface.profile.height)

    def test_noise_and_tip_change_the_heights(self):
        inputs = {"noise": 10e-9, "tip_radius": {"range": [5e-6, 6e-6]}}
        scene = resolved(changed(ROUGH, scatter=inputs))
        surface, points = surface_of(scene), np.array([(0.5, 0.2), (0.5, 0.7), (0.5, 0.2)])
        one, other, again = (sampled(scene, surface, p)[1].profile.height for p in points)
        assert (one - other).std() == pytest.approx(np.sqrt(2.0) * 10e-9, rel=0.3)
        assert np.array_equal(one, again)

    def test_what_has_no_solution_is_counted(self):
        beyond = {"position": {"range": [0.0, 1.5e-3]}, "samples": 8}
        outcome = run_of(ROUGH, "half_plane", scatter=beyond)
        findings = outcome.findings["scatter"]
        [counts] = findings.table("samples").rows()
        assert 0 < counts["failed"] < counts["solutions"]
        assert "end of the trace" in findings.said("first failure")
        known = outcome.figures.of(study="scatter", quantity="peak_pressure")
        assert np.isfinite(known.one(friction=0.0).spread.mean)


def test_the_scene_says_what_it_was(outcome):
    tables = outcome.problem.scene.tables
    assert resolved(tables).scatter == outcome.problem.scene.scatter
    assert problem(tables).scene.scatter.seed == 3


def shares_of(function, inputs: int, samples: int, seed: int = 0):
    cube = designs(samples, inputs, seed)
    return shares(function(cube), cube)


def test_a_design_mixes_two_and_changes_one_input_each():
    one, other, *mixed = designs(16, 3, 5)
    for i, sample in enumerate(mixed):
        changed = np.array([j == i for j in range(3)])
        assert np.array_equal(sample, np.where(changed, other, one))
    assert not np.any(one == other)
    assert np.array_equal(designs(16, 3, 5), designs(16, 3, 5))
    assert not np.array_equal(designs(16, 3, 5), designs(16, 3, 6))


def test_ishigami():
    """sin x + 7 sin^2 y + 0.1 z^4 sin x on (-pi, pi)^3: shares in closed form."""

    def ishigami(cube):
        x, y, z = np.moveaxis(np.pi * (2.0 * cube - 1.0), -1, 0)
        return np.sin(x) + 7.0 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x)

    x = 0.5 * (1.0 + 0.1 * np.pi**4 / 5.0) ** 2
    y, together = 7.0**2 / 8.0, 8.0 * 0.1**2 * np.pi**8 / 225.0
    exact = np.array([[x, y, 0.0], [x + together, y, together]]) / (x + y + together)
    result = shares_of(ishigami, 3, 4096)
    assert result.first == pytest.approx(exact[0], abs=0.02)
    assert result.total == pytest.approx(exact[1], abs=0.02)
    assert np.all(np.abs(result.first - exact[0]) < 2.0 * result.first_uncertainty)
    coarse = shares_of(ishigami, 3, 256)
    assert np.all(coarse.first_uncertainty > 2.0 * result.first_uncertainty)


@pytest.mark.parametrize("samples", [16, 64])
def test_few_samples_suffice_for_a_line(samples):
    slopes = np.array([3.0, -1.0, 0.5])
    result = shares_of(lambda cube: 10.0 + cube @ slopes, 3, samples)
    exact = slopes**2 / np.sum(slopes**2)
    assert result.first == pytest.approx(exact, abs=0.02)
    assert result.total == pytest.approx(result.first, abs=1e-12)


def test_samples_without_an_answer_are_left_out():
    cube = designs(64, 2, 0)
    values = cube @ np.array([1.0, 1.0])
    values[2, 5] = np.nan
    assert shares(values, cube).first == pytest.approx([0.5, 0.5], abs=0.05)


def test_what_does_not_vary_has_no_shares():
    cube = designs(16, 2, 0)
    assert shares(np.full(cube.shape[:2], 3.0), cube) is None
    assert shares(np.full(cube.shape[:2], np.nan), cube) is None
