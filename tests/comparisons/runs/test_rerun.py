"""Recorded runs repeated from their record alone: the same figures, and what is found if not."""

import io
import json
import re
import shlex
import shutil
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console
from scenes import SMOOTH, resolved

from comparisons.cli import main
from comparisons.common.errors import InputError
from comparisons.common.provenance import versions
from comparisons.figures.quantity import MODELS
from comparisons.judging.study import MODEL_ERROR
from comparisons.output.page.tables.verification import commands
from comparisons.output.record import read_result
from comparisons.runs.rerun import rerun, rerun_summary
from comparisons.runs.run import run
from comparisons.scenes.scene import Scene

pytestmark = pytest.mark.usefixtures("undrawn")

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
    return recorded(tmp_path_factory.mktemp("both") / "out", models=MODELS)


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
    columns = {"levels": {"values": [levels]}}
    return {"study": MODEL_ERROR, "name": "cost", "is_account": True, "columns": columns}


def whole_levels(findings) -> int:
    return findings[MODEL_ERROR].table("cost").columns["levels"].values[0]


def test_the_same_machine_repeats_every_figure_and_touches_nothing(both, monkeypatch):
    """The effects on as many levels as recorded: where time ends those of a run, it does not end
    those of its repetition."""
    monkeypatch.setattr("comparisons.judging.model_error.refinement._settled", lambda *_: False)
    assert whole_levels(read_result(both / "result.json").findings) == 2
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
    assert json.loads((again / "record.json").read_text())["levels"] == 3


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
    stated = read_result(spoilable / "result.json").figures.one(quantity="peak_pressure").numerical
    assert 1e-5 < stated < 1e-4

    def alter(result):
        peak_of(result)["value"] *= 1.0 + part

    change(spoilable / "result.json", alter)
    assert main(["rerun", str(spoilable)]) == status
    printed = capsys.readouterr().out
    [row] = [line for line in printed.splitlines() if line.startswith("contact.peak_pressure")]
    assert f"{-part:.2e}" in row and f"{stated:.2e}" in row and words in printed


def test_other_versions_are_named(spoilable):
    change(spoilable / "record.json", lambda record: record["versions"].update(numpy="0.1"))
    repetition = rerun(spoilable)
    assert repetition.other == {"numpy": ("0.1", versions()["numpy"])}
    console = Console(width=120, file=io.StringIO(), record=True)
    console.print(rerun_summary(repetition))
    assert f"Other than recorded: numpy 0.1, now {versions()['numpy']}." in console.export_text()


def test_as_many_levels_as_recorded_whatever_they_take(tmp_path):
    """More than the scene begins with, and less than its open questions ask for."""
    tables = SMALL | {
        "tolerance": {"peak_pressure": 1e-9},
        "budget": {"time": 1e-6},
        "resolution": {"levels": 2, "pitch": 1e-4},
    }
    folder = recorded(tmp_path / "out", tables)
    record = json.loads((folder / "record.json").read_text())
    assert record["levels"] == 1
    assert rerun(folder).levels == (1, 1)
    open_ended = tables | {"budget": {"time": 300.0}, "tolerance": {"peak_pressure": 2e-3}}
    folder = recorded(tmp_path / "more", open_ended)
    change(folder / "record.json", lambda record: record["scene"]["budget"].update(time=1e-6))
    repetition = rerun(folder)
    assert repetition.levels == (5, 5)
    assert [row.name for row in repetition.movement.moved] == ["scene.budget.time"]


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

    def test_a_sample_that_changed_in_the_record_is_refused(self, folder, capsys):
        def alter(record):
            record["profile"]["trace"]["height"][7] += 1e-9

        change(folder / "out" / "record.json", alter)
        assert main(["rerun", str(folder / "out")]) == 2
        assert "profile.trace: has another SHA-256 than recorded" in capsys.readouterr().err


def test_a_made_surface_is_taken_from_the_record(tmp_path, monkeypatch):
    """Not made again: the generator of another numpy may give another one from the seed."""
    tables = {name: SMOOTH[name] for name in ("roller", "body")} | {
        "profile": {"kind": "self-affine", "hurst": 0.8, "rms_slope": 0.02, "samples": 1024}
        | {"length": 2e-3, "seed": 3},
        "load": {"per_length": 2e5},
        "resolution": {"levels": 2},
    }
    folder = recorded(tmp_path / "out", tables)

    def other(**parameters):
        raise AssertionError("made again")

    monkeypatch.setattr("comparisons.scenes.surface._MAKERS", {"self-affine": other})
    assert rerun(folder).movement.moved == ()


@pytest.mark.parametrize(
    ("file", "text", "words"),
    [
        ("record.json", None, "holds no record.json"),
        ("result.json", None, "holds no result.json"),
        ("record.json", "{" * 100_000, "record.json: is not JSON"),
        ("record.json", "[]", "record.json: is no table"),
        ("record.json", '{"schema": 99}', "schema: is 99, of a later crosscheck; allowed is 2"),
        ("record.json", '{"schema": 2}', "record.json: is no record of a run"),
        ("result.json", '{"schema": 2}', "is 2, of an earlier crosscheck; .* run the scene again"),
        ("result.json", '{"schema": 3, "figures": 3, "scene": 4}', "result.json: is no result"),
    ],
)
def test_a_folder_without_a_whole_record_is_refused(spoilable, capsys, file, text, words):
    path = spoilable / file
    if text is None:
        path.unlink()
    else:
        path.write_text(text)
    before = contents(spoilable)
    assert main(["rerun", str(spoilable)]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1
    assert len(err) < 400
    assert re.search(words, err), err
    assert contents(spoilable) == before


@pytest.mark.parametrize(
    ("alter", "words"),
    [
        (lambda r: r.update(models=["fem"]), "is no record of a run"),
        (lambda r: r.update(levels=0), "levels: is 0; allowed is from 1 to 8"),
        (lambda r: r.update(models=[]), "is no record of a run"),
        (lambda r: r["scene"].pop("roller"), "record.json: roller: is missing"),
        (lambda r: r["scene"]["load"].update(per_length=-1.0), "load.per_length: "),
        (lambda r: r["scene"].update(profile={"kind": "sinusoid"}), "is no record of a run"),
        (lambda r: r.pop("versions"), "is no record of a run .KeyError"),
    ],
)
def test_a_record_that_cannot_be_is_refused(spoilable, alter, words):
    change(spoilable / "record.json", alter)
    with pytest.raises(InputError, match=words):
        rerun(spoilable)


@pytest.mark.parametrize(
    "alter",
    [
        lambda r: r["series"].append(cost_of(10**9)),
        lambda r: r.update(series="3"),
        lambda r: r["figures"].append(3),
        lambda r: r["figures"].append(r["figures"][0]),
        lambda r: peak_of(r).update(value=10**400),
        lambda r: peak_of(r).update(value=float("nan")),
        lambda r: peak_of(r).update(value="high"),
        lambda r: r.pop("figures"),
        lambda r: r.update(verdict=3.0),
    ],
)
def test_figures_that_no_run_writes_are_refused_before_anything_is_solved(
    spoilable, alter, monkeypatch
):
    monkeypatch.setattr("comparisons.runs.rerun.run", None)
    change(spoilable / "result.json", alter)
    with pytest.raises(InputError, match=r"result.json: .*; allowed is "):
        rerun(spoilable)


def test_no_such_folder(tmp_path, capsys):
    assert main(["rerun", str(tmp_path / "none")]) == 2
    assert "none: is no folder; allowed is the folder of a finished run" in capsys.readouterr().err
