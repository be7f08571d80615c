"""Whole runs of both models: files, figures against exact values, repetition, pruning, refusals;
and recorded runs repeated from their record alone: the same figures, and what is found if not.
Scenes that cannot be solved are refused; a budget that is spent leaves the question open."""

import io
import json
import re
import shlex
import shutil
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
from rich.console import Console
from scenes import (
    KNOWN_STEEL,
    QUICK,
    SMOOTH,
    STEEL,
    as_toml,
    changed,
    compared_verdicts,
    problem,
    python,
    resolved,
    run_of,
    without_cost,
)

from comparisons.cli import main
from comparisons.common.errors import ExitStatus, InputError, SceneError
from comparisons.common.progress import Early, Lasting
from comparisons.common.provenance import versions
from comparisons.figures.quantity import MODELS
from comparisons.judging.study import MODEL_ERROR
from comparisons.judging.verdict.headline import kind_of
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from comparisons.output.page.tables.verification import commands
from comparisons.output.result import FILE, read_result, result_of
from comparisons.runs.rerun import rerun
from comparisons.runs.run import level_cache, planned, run
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of

pytestmark = pytest.mark.usefixtures("undrawn")


@pytest.fixture(scope="module")
def said() -> list[str]:
    """Messages of the run of `smooth`."""
    return []


@pytest.fixture(scope="module")
def smooth(tmp_path_factory, said):
    return run(resolved(QUICK), tmp_path_factory.mktemp("smooth") / "out", MODELS, said.append)


def figures(outcome) -> dict:
    """result.json without what may differ from run to run."""
    return without_cost(json.loads(json.dumps(result_of(outcome).result)))


def values(outcome, model, friction=0.0) -> dict[str, float]:
    """Values of a model, by quantity."""
    known = outcome.figures.of(study="contact", source=model, friction=friction)
    return {figure.quantity: figure.value for figure in known}


class TestSmooth:
    def test_agrees_but_is_not_judged_without_what_it_lacks(self, smooth):
        assert smooth.exit_status == ExitStatus.INCONCLUSIVE
        assert compared_verdicts(smooth) == {"agree"}
        assert kind_of(smooth) == "inconclusive"
        assert smooth.solved.refinement == "every judged quantity is resolved"

    @pytest.fixture
    def exact(self, smooth):
        hertz = smooth.problem.hertz
        return {
            "peak_pressure": hertz.peak_pressure,
            "contact_length": 2.0 * hertz.half_width,
            "tau1_max": hertz.tau1_max,
            "tau1_max_depth": hertz.tau1_max_depth,
            "txz_max_abs": 0.25 * hertz.peak_pressure,
        }

    @pytest.mark.parametrize(
        ("model", "near"),
        [
            ("half_plane", (1e-4, 1e-3, 1e-4, 1e-3, 1e-4)),
            ("finite_element", (1e-3, 2e-3, 1e-2, 1e-2, 1e-2)),
        ],
    )
    def test_meets_hertz(self, smooth, exact, model, near):
        figure_values = values(smooth, model)
        assert figure_values["contact_ratio"] == pytest.approx(1.0, rel=near[1])
        for (name, value), most in zip(exact.items(), near, strict=True):
            assert figure_values[name] == pytest.approx(value, rel=most), name

    def test_stated_uncertainties_cover_the_errors(self, smooth, exact):
        """All but one in twenty, which is by a factor of two at most."""
        over = []
        for model in MODELS:
            for name, value in exact.items():
                figure = smooth.figures.one(study="contact", source=model, quantity=name)
                error = abs(figure.value / value - 1.0) - 1e-6
                over.append(error / figure.numerical)
        assert len(over) == 10 and sorted(over)[-2] <= 1.0 and max(over) <= 2.0

    def test_the_true_difference_of_both_models_is_nothing(self, smooth):
        """Both solve Hertz's contact; by the sequence of their difference, not of each model."""
        rows = {row.quantity: row for row in smooth.figures.of(study="comparison")}
        for name in ("peak_pressure", "contact_length", "tau1_max", "txz_max_abs"):
            assert abs(rows[name].value) <= rows[name].numerical, name

    def test_the_half_plane_s_answer_is_said_before_finite_elements_are_solved(self, smooth, said):
        figures, left = (line for line in said if isinstance(line, Early))
        assert figures.startswith("half-plane: peak pressure 4.150 GPa, contact length 1.089 mm, ")
        assert left.startswith("left out, by estimates at most: peak pressure 8 %, contact length")
        assert left.endswith(" %, mostly finite deformation")
        stages = [line for line in said[: said.index(left)] if "finite elements: contact" in line]
        assert stages == []

    def test_checks_and_iterations(self, smooth):
        for model in MODELS:
            assert smooth.findings["contact"].said("converged", model) == "yes"
            checks = smooth.figures.of(study="checks", source=model)
            assert len(checks) == 5 and max(figure.value for figure in checks) <= 1e-8
        for level in smooth.runs["finite_element"].levels:
            assert 3 <= level.solution.iterations["applications"] <= 8

    def test_files(self, smooth):
        out = smooth.directory
        read, content = read_result(out), result_of(smooth).result
        written = {str(p.relative_to(out)) for p in out.rglob("*") if p.is_file()}
        assert {*read.record["files"]} == {*written}
        content["record"] |= {"files": read.record["files"]}
        assert json.loads((out / "result.json").read_text()) == content
        assert read.figures == smooth.figures
        assert read.findings == {n: replace(f, data=None) for n, f in smooth.findings.items()}
        assert read.record["versions"]["fenics-dolfinx"]
        assert "<html" in (out / "report.html").read_text()
        assert not (out / "half_plane" / "mesh.msh").exists()

    def test_leaving_steps_out_changes_no_figure(self, smooth):
        """The roller on a factorisation of its own, though the body's would do."""
        with patch.object(Problem, "shares_factor", False):
            whole = run(smooth.problem.scene, None, MODELS)
        two, one = (each.runs["finite_element"].finest.unknowns for each in (whole, smooth))
        assert two == 2 * one
        for model in MODELS:
            assert values(whole, model) == pytest.approx(values(smooth, model), rel=1e-7, abs=1e-12)


def test_one_model_alone_gives_its_own_figures(smooth, tmp_path):
    """The other model's presence changes nothing, and what one does not need is never loaded."""
    path = tmp_path / "scene.toml"
    path.write_text(as_toml(QUICK))
    code = (
        "import sys; from comparisons.cli import main; "
        f"status = main(['run', {str(path)!r}, '--out', {str(tmp_path / 'out')!r}, "
        "'--models', 'half-plane']); "
        "heavy = {'dolfinx', 'petsc4py', 'gmsh', 'pyvista'} & set(sys.modules); "
        "sys.exit(f'loaded {heavy}' if heavy else status)"
    )
    done = python("-c", code)
    assert done.returncode == 0, done.stderr
    result = read_result(tmp_path / "out")
    alone = result.figures.of(study="contact")
    assert alone == smooth.figures.of(study="contact", source="half_plane")
    assert {"comparison", "model_error"}.isdisjoint(result.findings)
    assert result.verdict == "not compared"
    why = result.findings["problem"].said("skipped", "finite_element model")
    assert why == "not asked for"
    assert not (tmp_path / "out" / "finite_element").exists()


def test_one_model_replaces_a_comparison_with_a_word(smooth, tmp_path, capsys):
    out = tmp_path / "out"
    shutil.copytree(smooth.directory, out)
    assert main(["run", "smooth", "--models", "half-plane", "--out", str(out)]) == 0
    assert "replaces a comparison; --out keeps both" in capsys.readouterr().err
    assert main(["run", "smooth", "--models", "half-plane", "--out", str(out)]) == 0
    assert "replaces" not in capsys.readouterr().err


def test_friction_changes_stresses_and_not_the_contact(smooth):
    outcome = run_of(QUICK, load={"friction": [0.0, 0.1]})
    for model in MODELS:
        still, sliding = (values(outcome, model, friction) for friction in (0.0, 0.1))
        for name in ("peak_pressure", "contact_length", "peak_position"):
            assert still[name] == sliding[name]
        peak = outcome.problem.hertz.peak_pressure
        assert sliding["tau1_max"] / peak == pytest.approx(0.304827336, rel=0.01)
        assert sliding["txz_max_abs"] / peak == pytest.approx(0.280567188, rel=0.01)
    # what the still run alone finds, the run with both finds too
    assert values(outcome, "half_plane") == values(smooth, "half_plane")


def test_a_run_that_was_stopped_says_what_it_takes_and_goes_on(tmp_path, smooth, monkeypatch):
    """On the terminal before it begins, and beside the levels that are kept."""
    monkeypatch.setattr("comparisons.runs.long.LONG", 0.0)
    said, path = [], tmp_path / ".out.unfinished" / "run" / "progress.txt"

    def stop(stage: str) -> None:
        said.append(stage)
        if "far boundary" in stage:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(resolved(QUICK), tmp_path / "out", MODELS, stop)
    assert [p.name for p in tmp_path.iterdir()] == [".out.unfinished"]
    began, total, levels, *stages = path.read_text().splitlines()
    assert began.startswith("started 20") and levels.startswith("3 levels (")
    assert any("finite elements: contact, level 3" in stage for stage in stages)
    [line] = (line for line in said if isinstance(line, Lasting))
    assert f"{began.removeprefix('started ')}: {total}; " in line and line.endswith(str(path))
    outcome = run(resolved(QUICK), tmp_path / "out", MODELS)
    assert figures(outcome) == figures(smooth)
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


def test_a_plan_says_what_the_run_then_says_and_flow_how_far_it_is(monkeypatch):
    monkeypatch.setattr("comparisons.common.tasks.cores", lambda: 1)
    monkeypatch.setattr("comparisons.runs.run.cores", lambda: 1)
    said, body = [], {**STEEL, "yield_stress": 1e9}
    pressed = {"load": {"hertz_peak_pressure": 3e9}, "resolution": {"elements": 4, "levels": 2}}
    pressed |= {"budget": {"time": 3.0}, "tolerance": {"peak_pressure": 0.02}}
    flows = SMOOTH | {"roller": {"radius": 8e-3, "rigid": True}, "finite_element": {}, "body": body}
    scene = resolved(flows | pressed)
    run(scene, None, MODELS, said.append)
    [total] = [line for line in said if line.startswith("planned: ")]
    total_of_plan, _, effects, *_, skipped = planned(scene, surface_of(scene), MODELS)
    assert total == total_of_plan and "both models" in total and "leaves out" in total
    assert effects.startswith("effects computed: ") and "plastic flow" in effects
    assert skipped.startswith("skipped: ")
    shares = [*map(int, re.findall(r"plastic flow, (\d+) % of the load", "\n".join(said)))]
    assert len(shares) > 10 and min(shares) < 60 and max(shares) == 100


def test_levels_of_another_scene_or_a_torn_file_are_not_used(tmp_path, smooth):
    plan, posed = smooth.plan, smooth.problem
    kept = level_cache(tmp_path / "out", posed, plan)
    level = smooth.runs["finite_element"].levels[0]
    kept.save("level", level)
    again = kept.load("level")
    assert np.array_equal(again.solution.pressure, level.solution.pressure)
    assert again.solution.residuals == level.solution.residuals
    assert np.array_equal(again.mesh.points, level.mesh.points)
    assert again.stress.extremes == level.stress.extremes
    other = problem(changed(QUICK, load={"per_length": 3.56e6}))
    assert level_cache(tmp_path / "out", other, plan).load("level") is None
    whole = replace(plan, domain_check=not plan.domain_check)
    assert level_cache(tmp_path / "out", posed, whole).load("level") is None
    path = tmp_path / ".out.unfinished" / "run" / "level.npz"
    path.write_bytes(path.read_bytes()[:1000])
    assert kept.load("level") is None
    kept.discard()
    assert list(tmp_path.iterdir()) == []


def test_plan_says_what_it_leaves_out():
    plan = make_plan(problem_of(Scene.read("smooth")), MODELS)
    assert {"refinement under asperities", "hardness"} <= plan.skipped.keys()
    sliding = make_plan(problem_of(Scene.read("ground-unrun")), MODELS)
    assert "refinement under asperities" not in sliding.skipped


SMALL = SMOOTH | {"stress": {"points": [60, 20]}}
TRACED = """
roller = {radius = "8 mm", youngs_modulus = "210 GPa", poissons_ratio = 0.3}
body = {youngs_modulus = "210 GPa", poissons_ratio = 0.3}
profile = {file = "trace.csv", x_unit = "um", z_unit = "um", form = "line", cutoff = "auto"}
load = {per_length = "0.5 N/um"}
resolution = {levels = 2}
"""


def recorded(folder, tables=SMALL, models=("half_plane",)):
    run(resolved(tables), folder, models)
    return folder


def contents(folder):
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def change(path, alter):
    """Alter the content of a JSON file in place."""
    content = json.loads(path.read_text())
    alter(content)
    path.write_text(json.dumps(content))


@pytest.fixture(scope="module")
def both(tmp_path_factory):
    """The folder of a run of both models."""
    tables = SMALL | {"roller": {"radius": 7.5706e-3, "rigid": True}, "body": KNOWN_STEEL}
    return recorded(tmp_path_factory.mktemp("both") / "out", tables, MODELS)


@pytest.fixture(scope="module")
def half_plane_run(tmp_path_factory):
    return run(resolved(SMALL), tmp_path_factory.mktemp("half") / "out", ("half_plane",))


@pytest.fixture
def spoilable(half_plane_run, tmp_path):
    """A copy to spoil."""
    return shutil.copytree(half_plane_run.directory, tmp_path / "spoilable")


def peak_of(result):
    """The half-plane's peak pressure, as result.json holds it."""
    wanted = ("contact", "peak_pressure", "half_plane")
    return next(f for f in result["figures"] if (f["study"], f["quantity"], f["source"]) == wanted)


def cost_of(levels):
    """The series that says on how many levels the whole model was solved."""
    columns = {"columns": {"levels": [levels]}, "units": {"levels": ""}}
    return {"study": MODEL_ERROR, "name": "cost", "source": "", "at": {}, **columns}


def whole_levels(findings) -> int:
    return findings[MODEL_ERROR].table("cost").columns["levels"].values[0]


def test_the_same_machine_repeats_every_figure_and_touches_nothing(both, monkeypatch):
    """The effects on as many levels as recorded: where time ends those of a run, it does not end
    those of its repetition."""
    monkeypatch.setattr("comparisons.judging.model_error.refinement._settled", lambda *_: False)
    assert whole_levels(read_result(both).findings) == 2
    before = contents(both)
    repetition = rerun(both)
    assert repetition.levels[1] > 2
    assert whole_levels(repetition.outcome.findings) == 2
    assert repetition.movement.moved == ()
    assert repetition.movement.rounding == repetition.movement.new == 0
    assert repetition.movement.same > 150
    assert repetition.bits and repetition.other == {}
    assert repetition.exit_status == 0
    assert contents(both) == before


def test_out_keeps_the_repetition(half_plane_run, tmp_path):
    again = tmp_path / "again"
    rerun(half_plane_run.directory, again)
    assert set(contents(again)) == set(contents(half_plane_run.directory))
    assert read_result(again).record["levels"] == 3


@pytest.mark.parametrize("out", [".", "deeper/again"])
def test_the_recorded_folder_is_not_written_to(half_plane_run, out):
    with pytest.raises(InputError, match=r"--out: .* is in the recorded folder"):
        rerun(half_plane_run.directory, half_plane_run.directory / out)


@pytest.mark.parametrize("place", [0, 1])
def test_the_lines_of_a_report_work_in_its_folder(
    half_plane_run, spoilable, monkeypatch, capsys, place
):
    """Those that repeat the run and that print its page, as they stand."""
    words, line = commands(half_plane_run)[place]
    assert "folder" in words
    program, *arguments = shlex.split(line)
    assert Path(program).is_file()
    monkeypatch.chdir(spoilable)
    assert main(arguments) == 0
    assert ["same", "NOT COMPARED"][place] in capsys.readouterr().out


@pytest.mark.parametrize(
    ("part", "status", "words"),
    [
        (1e-3, 1, "MOVED  1 figure moved by more than the stated uncertainty"),
        (1e-5, 0, "1 figure moved, within the stated uncertainty"),
    ],
)
def test_a_tampered_figure_is_found(spoilable, capsys, part, status, words):
    stated = read_result(spoilable).figures.one(quantity="peak_pressure").numerical
    assert 1e-5 < stated < 1e-4
    change(spoilable / FILE, lambda r: peak_of(r).update(value=(1.0 + part) * peak_of(r)["value"]))
    assert main(["rerun", str(spoilable)]) == status
    printed = capsys.readouterr().out
    [row] = [line for line in printed.splitlines() if line.startswith("contact.peak_pressure")]
    assert f"{-part:.2e}" in row and f"{stated:.2e}" in row and words in printed


def test_other_versions_are_named(spoilable):
    change(spoilable / FILE, lambda r: r["record"]["versions"].update(numpy="0.1"))
    repetition = rerun(spoilable)
    assert repetition.other == {"numpy": ("0.1", versions()["numpy"])}
    console = Console(width=120, file=io.StringIO(), record=True)
    console.print(repetition.tables())
    assert f"Other than recorded: numpy 0.1, now {versions()['numpy']}." in console.export_text()


def test_as_many_levels_as_recorded_whatever_they_take(tmp_path):
    """More than the scene begins with, and less than its open questions ask for."""
    tables = SMALL | {
        "tolerance": {"peak_pressure": 1e-9},
        "budget": {"time": 1e-6},
        "resolution": {"levels": 2, "pitch": 1e-4},
    }
    folder = recorded(tmp_path / "out", tables)
    assert read_result(folder).record["levels"] == 1
    assert rerun(folder).levels == (1, 1)
    open_ended = tables | {"budget": {"time": 300.0}, "tolerance": {"peak_pressure": 2e-3}}
    folder = recorded(tmp_path / "more", open_ended)
    change(folder / FILE, lambda result: result["scene"]["budget"].update(time=1e-6))
    repetition = rerun(folder)
    assert repetition.levels == (5, 5)
    assert repetition.movement.moved == ()


class TestTrace:
    @pytest.fixture
    def folder(self, tmp_path):
        x = np.linspace(0.0, 2400.0, 481)
        height = 0.2 * np.cos(x / 32.0) + 0.1 * np.sin(x / 53.0) + 1e-3 * x + 3.0
        np.savetxt(tmp_path / "trace.csv", np.column_stack([x, height]), delimiter=",")
        (tmp_path / "scene.toml").write_text(TRACED)
        run(Scene.read(tmp_path / "scene.toml"), tmp_path / "out", ("half_plane",))
        return tmp_path

    @pytest.mark.parametrize("fate", ["gone", "changed"])
    def test_its_file_is_not_needed(self, folder, fate):
        trace = folder / "trace.csv"
        trace.unlink() if fate == "gone" else trace.write_text("0,0\n1,1\n")
        shutil.move(folder / "out", folder / "elsewhere")
        repetition = rerun(folder / "elsewhere")
        assert repetition.movement.moved == () and repetition.movement.rounding == 0
        info = repetition.outcome.problem.surface.info
        assert info.form.slope == pytest.approx(1e-3, rel=0.2)
        assert info.cutoff is not None and info.standard is not None

    def test_a_sample_that_changed_in_the_record_is_refused(self, folder, complaint):
        with np.load(folder / "out" / "run.npz") as file:
            arrays = dict(file)
        arrays["trace_height"][7] += 1e-9
        np.savez(folder / "out" / "run.npz", **arrays)
        said = complaint("rerun", folder / "out")
        assert "run.npz: trace: has another SHA-256 than recorded" in said


def test_a_made_surface_is_taken_from_the_record(tmp_path, monkeypatch):
    """Not made again: the generator of another numpy may give another one from the seed."""
    tables = {name: SMOOTH[name] for name in ("roller", "body")} | {
        "profile": {"kind": "self-affine", "hurst": 0.8, "rms_slope": 0.02, "samples": 1024}
        | {"length": 2e-3, "seed": 3},
        "load": {"per_length": 2e5},
        "resolution": {"levels": 2},
    }
    folder = recorded(tmp_path / "out", tables)
    monkeypatch.setattr("comparisons.scenes.surface._MAKERS", {"self-affine": None})
    assert rerun(folder).movement.moved == ()


WAVES = {"kind": "sinusoid", "wavelength": 1e-5, "amplitude": 1e-7}  # of which no trace is kept
NONE_SUCH = "result.json: is no result of a run"


@pytest.mark.parametrize(
    ("spoilt", "words"),
    [
        (None, "holds no result.json; allowed is the folder of a finished run"),
        ("{" * 100_000, NONE_SUCH),
        ("[]", NONE_SUCH),
        ('{"schema": 2}', "schema: is 2; allowed is 3: run the scene again"),
        ('{"schema": 3, "figures": 3, "scene": 4}', NONE_SUCH),
        (lambda r: r["record"].update(levels=0), "levels: is 0; allowed is from 1 to 8"),
        (lambda r: r["series"].append(cost_of(10**9)), "levels: is 1000000000; allowed is from 1"),
        (lambda r: r["scene"].pop("roller"), "result.json: roller: is missing"),
        (lambda r: r["scene"]["load"].update(per_length=-1.0), "load.per_length: "),
        (lambda r: r["scene"].update(profile=WAVES), "is no record of a run"),
        (lambda r: r["record"].pop("versions"), NONE_SUCH),
        (lambda r: r.update(series="3"), NONE_SUCH),
        (lambda r: r["figures"].append(3), NONE_SUCH),
        (lambda r: r["figures"].append(r["figures"][0]), NONE_SUCH),
        (lambda r: peak_of(r).update(value=10**400), NONE_SUCH),
        (lambda r: peak_of(r).update(value=float("nan")), NONE_SUCH),
        (lambda r: peak_of(r).update(value="high"), NONE_SUCH),
        (lambda r: r.pop("figures"), NONE_SUCH),
        (lambda r: r.update(verdict=3.0), NONE_SUCH),
    ],
)
def test_what_no_run_writes_is_refused_before_anything_is_solved(
    spoilable, complaint, spoilt, words, monkeypatch
):
    monkeypatch.setattr("comparisons.runs.rerun.run", None)
    if callable(spoilt):
        change(spoilable / FILE, spoilt)
    else:
        (spoilable / FILE).unlink() if spoilt is None else (spoilable / FILE).write_text(spoilt)
    said = complaint("rerun", spoilable)
    assert len(said) < 400 and words in said


@pytest.mark.parametrize(
    ("sections", "words"),
    [
        (
            {"body": {"hardness": 1e8, "width": 1e-2}},
            "carries the load on .* m, more than the roller",
        ),
        ({"resolution": {"pitch": 1e-12}}, "pressure elements at the finest"),
        ({"resolution": {"pitch": 1e-2}}, "allowed is at most"),
        ({"body": {"width": 1e-3}}, "reaches the end of the body"),
        ({"budget": {"memory": 1e7}}, "budget.memory"),
        (
            {"profile": WAVES | {"wavelength": 5e-5, "length": 6e-4}},
            "reaches the end of the trace",
        ),
    ],
)
def test_a_scene_that_cannot_be_solved_is_refused_and_writes_nothing(tmp_path, sections, words):
    with pytest.raises(SceneError, match=words) as refusal:
        run(resolved(changed(QUICK, **sections)), tmp_path / "out", MODELS)
    assert "\n" not in str(refusal.value) and str(refusal.value).startswith("made.toml: ")
    assert list(tmp_path.iterdir()) == []


def test_a_level_that_would_not_fit_is_not_begun():
    """Room for the three planned levels and none for a fourth."""
    outcome = run_of(QUICK, budget={"memory": 2.9e8}, tolerance={"peak_pressure": 1e-6})
    assert "budget.memory" in outcome.solved.refinement
    assert len(outcome.runs["finite_element"].levels) == 3
