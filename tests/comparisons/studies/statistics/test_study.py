"""[statistics] of a scene: what it solves, that its causes are the cause, and what a run says."""

import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scenes import GROUND, SMOOTH, STEEL, as_toml, resolved, run_of

from analytic.statistics.penetration import RIDGE
from comparisons.cli import main
from comparisons.common.errors import InputError
from comparisons.figures.figure import Series
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.models.problem import Levels
from comparisons.output.result import read_result
from comparisons.runs.run import run
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of
from comparisons.studies.statistics.study import patch_columns, summit_rows

ROUGH = {
    "kind": "self-affine", "hurst": 0.8, "rms_slope": 0.05, "samples": 4097, "length": 4e-3,
    "seed": 2, "shortest_wavelength": 12e-6, "longest_wavelength": 200e-6,
}  # fmt: skip
SCENE = SMOOTH | {"profile": ROUGH, "load": {"per_length": 2e6}, "statistics": {"traces": 8}}


@pytest.fixture
def outcome():
    return run_of(SCENE, "half_plane")


@pytest.fixture
def loads(outcome):
    """Columns by name: values (7,) from the heaviest load down."""
    columns = outcome.findings["statistics"].table("loads").columns
    return {name: column.numbers for name, column in columns.items()}


@pytest.fixture
def uncertainties(outcome):
    """Uncertainties of the columns."""
    columns = outcome.findings["statistics"].table("loads").columns
    return {name: column.sizes for name, column in columns.items()}


def pressure(source):
    return f"figures.{source}.mean_real_pressure"


def patches_of(outcome) -> dict[str, list[dict]]:
    """Rows by model."""
    series = outcome.findings["statistics"].series
    return {table.source: table.rows() for table in series if table.name == "patches"}


def test_loads_go_down_three_decades_from_the_scenes(loads):
    assert loads["load"] == pytest.approx(2e6 * np.logspace(0, -3, 7))


def test_the_trace_under_the_scenes_load_is_the_models(outcome, loads, uncertainties):
    level, name = outcome.runs["half_plane"].finest, "figures.trace.real_length"
    assert loads[name][0] == pytest.approx(level.contact_length, rel=5e-3)
    assert loads[pressure("trace")][0] == pytest.approx(2e6 / level.contact_length, rel=5e-3)
    assert 0.0 < uncertainties[name][0] < 0.01 * loads[name][0]


def test_the_theory_hardly_moves_where_ridges_do(loads):
    """Three decades: less than twice by the theory, and by Hertz of one ridge the root of 1000."""
    sources = ("moments", "peaks", "trace", "random")
    grown = {name: loads[pressure(name)][0] / loads[pressure(name)][-1] for name in sources}
    assert 1.4 < grown["moments"] < 2.0 and 1.4 < grown["peaks"] < 2.0
    assert 3.5 < grown["random"] < np.sqrt(1000.0) and 3.5 < grown["trace"] < np.sqrt(1000.0)


def test_a_light_load_rests_on_few_ridges_that_hertz_knows(loads, uncertainties):
    few, solved = loads["patches"] < 2.5, loads[pressure("random")]
    error = 0.15 * solved + uncertainties[pressure("random")]
    assert few.any() and np.all(np.abs(loads["even"] - solved)[few] < error[few])


def test_a_heavy_load_has_no_cause_left_but_the_summits(loads):
    """Tens of contacts: Persson's ridges meet the solved ones within a third."""
    few, ridges = loads["causes.few contacts"], loads["causes.ridges"]
    assert loads["patches"][0] > 25.0
    assert 1.0 < few[0] < 1.33 and np.all(np.diff(few) >= 0.0)
    assert 1.2 < ridges[0] < np.sqrt(2.0)
    assert ridges[-1] == pytest.approx(np.sqrt(2.0), rel=1e-3)


def test_causes_multiply_to_the_difference(loads, uncertainties):
    ratio = loads[pressure("moments")] / loads[pressure("random")]
    causes = [values for name, values in loads.items() if name.startswith("causes.")]
    assert len(causes) == 3 and np.prod(causes, axis=0) == pytest.approx(ratio)
    assert loads["difference"] == pytest.approx(ratio - 1.0)
    scatter = uncertainties[pressure("random")] / loads[pressure("random")]
    assert np.all(uncertainties["difference"] > ratio * scatter)


def test_effective_width_tends_to_hertz(loads):
    ratios = loads["figures.moments.effective_half_width"] / loads["half_width"]
    assert np.all(np.diff(ratios) >= 0.0) and ratios[0] < 1.15 and ratios[-1] > 3.0
    solved = loads["figures.random.effective_half_width"][0]
    assert solved == pytest.approx(loads["half_width"][0], rel=0.1)


def test_filters_take_the_sharpest_summits_first(outcome):
    rows = {kind: [] for kind in ("as pressed", "cut-off", "sampling")}
    profile = outcome.problem.surface.profile
    for row in summit_rows(profile, None):
        rows[row["treatment"]].append(row)
    assert [len(column) for column in rows.values()] == [1, 4, 2]
    for finer, coarser in zip(rows["cut-off"], rows["cut-off"][1:], strict=False):
        assert coarser["summits.moments.radius"] > 1.3 * finer["summits.moments.radius"]
        assert coarser["summits.moments.density"] < finer["summits.moments.density"]
        assert coarser["bandwidth"] < finer["bandwidth"]
    (pressed,) = rows["as pressed"]
    for name, near in (("radius", 0.15), ("density", 0.2)):
        for kind in ("peaks", "summits"):
            counted, by_moments = (pressed[f"{kind}.{by}.{name}"] for by in ("peaks", "moments"))
            assert counted == pytest.approx(by_moments, rel=near)


def test_cutoffs_can_be_asked_for():
    profile = surface_of(resolved(SCENE)).profile
    rows = summit_rows(profile, (20e-6, 50e-6))
    assert [row["size"] for row in rows if row["treatment"] == "cut-off"] == [20e-6, 50e-6]
    with pytest.raises(ValueError, match="does not suit the trace"):
        summit_rows(profile, (1.0,))


class TestPatches:
    def test_each_is_what_its_pressure_makes_it(self, outcome):
        [patches] = patches_of(outcome).values()
        level = outcome.runs["half_plane"].finest
        assert len(patches) == len(level.patches)
        assert sum(patch["load"] for patch in patches) == pytest.approx(2e6, rel=1e-6)
        assert max(patch["peak"] for patch in patches) == level.solution.pressure.max()
        for patch in patches:
            assert patch["depth.sphere"] < patch["depth.ridge"]
            flows, cuts = patch["depth.sphere"] > 0.01, patch["depth.ridge"] > 0.1
            kind = "cutting" if cuts else "plastic" if flows else "elastic"
            assert patch["kinds.exact"] == kind
            assert "plastic_strain" not in patch
        assert len({patch["kinds.exact"] for patch in patches}) > 1

    def test_one_smooth_patch_has_the_rollers_radius(self):
        """Hertz: h/R of a ridge is (a/R)^2, its radius the roller's."""
        done = run_of(SMOOTH, "half_plane")
        wanted = SimpleNamespace(metal="ferrous", lubricated=False)
        scene = done.problem.scene.unchecked({"statistics": wanted})
        level = done.runs["half_plane"].finest
        columns = patch_columns(replace(done.problem, scene=scene), level, unsure=0.0)
        [patch] = Series("patches", columns).rows()
        hertz = done.problem.hertz
        assert patch["radius"] == pytest.approx(hertz.radius, rel=1e-3)
        depth = (hertz.half_width / hertz.radius) ** 2
        assert patch["depth.ridge"] == pytest.approx(depth, rel=1e-3)
        assert RIDGE == 4.0

    def test_beside_them_stands_where_the_finite_elements_flow(self):
        """First flow of a ridge is at 1.67 (Tresca) to 1.79 (von Mises) yield stresses; the book's
        limit, h/R = 0.01, stands for a steel of three times this one's."""
        profile = ROUGH | {"samples": 1025, "length": 1.6e-3, "seed": 4, "rms_slope": 0.025}
        profile |= {"shortest_wavelength": 50e-6, "longest_wavelength": 400e-6}
        tables = {
            "title": "Flow", "roller": {"radius": 10e-3, **STEEL}, "profile": profile,
            "body": {**STEEL, "yield_stress": 1.5e9, "hardening_modulus": 10e9},
            "load": {"hertz_peak_pressure": 1.2e9}, "statistics": {"traces": 4},
            "stress": {"points": [30, 10]}, "finite_element": {"plastic": True},
            "resolution": {"pitch": 4e-6}, "budget": {"effects": False},
        }  # fmt: skip
        elastic, flowing = patches_of(run_of(tables, levels=Levels(1))).values()
        assert "plastic_strain" not in elastic[0]
        assert {patch["kinds.exact"] for patch in flowing} == {"elastic"}
        for patch in flowing:
            if patch["peak"] > 2.0 * 1.5e9:
                assert patch["plastic_strain"] > 1e-4
            if patch["peak"] < 1.5 * 1.5e9:
                assert patch["plastic_strain"] < 1e-6
        largest = [max(patch["peak"] for patch in patches) for patches in (elastic, flowing)]
        assert largest[1] < largest[0]
        assert any(patch["plastic_strain"] > 1e-4 for patch in flowing)


def test_a_run_says_it(tmp_path, capsys, drawn_only):
    scene = tmp_path / "rough.toml"
    asked = {"traces": 4, "metal": "nonferrous", "lubricated": True, "cutoffs": "20 um"}
    tables = {"profile": GROUND["profile"], "load": {"per_length": 1e6}, "statistics": asked}
    scene.write_text(as_toml(SMOOTH | tables))
    out = tmp_path / "out"
    with drawn_only("statistics"):
        assert main(["run", str(scene), "--out", str(out), "--models", "half-plane"]) == 0
        page = (out / "report.html").read_text()
        assert main(["report", str(out)]) == 0
    assert (out / "report.html").read_text() == page
    said = " ".join(capsys.readouterr().out.split())
    words = "mean real pressure", "summits alone x", "asperities by h/R"
    assert all(part in said for part in words)
    words = " ".join(page.split())
    assert 'id="statistics"' in page and "below 0.0001, cutting above 0.3" in words
    findings = read_result(out).findings["statistics"]
    loads, (patches,) = findings.table("loads"), [s for s in findings.series if s.name == "patches"]
    assert findings.table("traces").columns["traces"].values == (4,)
    assert len(loads.rows()) == 7
    causes = {name.partition(".")[2] for name in loads.columns if name.startswith("causes")}
    assert causes == {"summits alone", "ridges", "few contacts"}
    for patch in patches.rows():
        assert (patch["depth.sphere"] > 1e-4) == (patch["kinds.exact"] != "elastic")


def test_without_the_section_nothing_of_it_runs(monkeypatch):
    """Nor do the theories load, and the plan says so."""
    monkeypatch.setitem(sys.modules, "analytic.statistics.rough_bodies", None)
    scene = resolved({name: part for name, part in SCENE.items() if name != "statistics"})
    done = run(scene, None, ("half_plane",))
    assert "statistics" not in done.findings
    said = done.findings["problem"].statements
    skipped = {line.source: line.text for line in said if line.name == "skipped"}
    assert skipped["statistics of rough contact"] == "the scene has no [statistics]"
    plan = make_plan(problem_of(resolved(SCENE)), ("finite_element",))
    assert plan.skipped["statistics of rough contact"] == "they need the half-plane"


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"profile": {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 1e-7}}, "all as high"),
        ({"profile": ROUGH | {"rms_slope": 1e-12}}, "statistics: the profile is smooth"),
        ({"profile": ROUGH | {"rms_slope": 1e-7}}, "statistics: the roughness hardly shows"),
        ({"profile": ROUGH | {"shortest_wavelength": 2e-3, "longest_wavelength": 4e-3}}, "peaks;"),
        ({"statistics": {"cutoffs": "1 m"}}, "statistics: a cut-off of 1 m does not suit"),
        ({"budget": {"memory": 8e5}}, "budget.memory: is 8e+05 bytes, but [statistics] of light"),
    ],
)
def test_wrong_input_is_one_line(changes, message):
    with pytest.raises(InputError) as refusal:
        run(resolved(SCENE | changes), None, ("half_plane",))
    assert message in str(refusal.value) and "\n" not in str(refusal.value)


def test_the_scene_that_comes_along_has_both_kinds_of_asperities():
    scene = Scene.read("rough-statistics")
    assert scene.statistics.traces >= 8
    [patches] = patches_of(run_of(scene, "half_plane", levels=Levels(2))).values()
    assert {patch["kinds.exact"] for patch in patches} == {"elastic", "plastic"}
