"""run.npz, and runs shown again from their folders: what was written, or one line that says why."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparisons.cli import main
from comparisons.commands.output import show
from comparisons.common.errors import InputError
from comparisons.common.progress import no_progress
from comparisons.judging.study import Run
from comparisons.models.level import deformed_height
from comparisons.output.arrays import COMPONENTS, FILE, RunArrays
from comparisons.output.terminal import summary
from comparisons.runs.write import write_files


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory, wavy_outcome: Run) -> Path:
    """The folder that a run leaves, with a word for its page."""
    folder = tmp_path_factory.mktemp("runs") / "run"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("comparisons.output.page.page.render", lambda *_: "the page")
        write_files(replace(wavy_outcome, directory=folder), no_progress)
    return folder


@pytest.fixture
def copied(written: Path, tmp_path: Path) -> Path:
    """A run's folder to spoil."""
    return Path(shutil.copytree(written, tmp_path / "run"))


def test_arrays_are_exact_but_for_stresses_which_have_single_precision(written, wavy_outcome):
    again, mu = RunArrays.read(written), wavy_outcome.problem.scene.load.friction[-1]
    assert again.models == list(wavy_outcome.levels(mu)) and again.answers == {}
    for name, level in wavy_outcome.levels(mu).items():
        columns = (level.grid.x, level.solution.pressure, level.solution.gap)
        columns += (deformed_height(wavy_outcome.problem, level),)
        for read, known in zip(again.contact(name, mu).values(), columns, strict=True):
            np.testing.assert_array_equal(read, known)
        stress, field = again.stress(name, mu), level.stress.field
        np.testing.assert_array_equal(stress["x"], wavy_outcome.window.x)
        np.testing.assert_array_equal(stress["z"], wavy_outcome.window.z)
        for part in COMPONENTS:
            np.testing.assert_array_equal(stress[part], getattr(field, part).astype(np.float32))
        np.testing.assert_allclose(stress["tau1"], field.tau1, atol=1e-6 * field.tau1.max())
    assert again.stress("half_plane", 0.77) is None


def test_run_npz_is_small(written, wavy_outcome):
    points = wavy_outcome.window.x.size * wavy_outcome.window.z.size
    frictions = wavy_outcome.problem.scene.load.friction
    models = len(wavy_outcome.levels(frictions[-1]))
    fields = 3 * 4 * models * len(frictions) * points  # bytes
    assert (written / FILE).stat().st_size < fields + 250_000


def test_report_prints_what_the_run_printed(written, wavy_outcome, capsys):
    show(summary(wavy_outcome))
    before = capsys.readouterr().out
    assert main(["report", str(written)]) == 0
    assert capsys.readouterr().out.split() == before.split()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (Path.unlink, "[Errno 2] No such file"),
        (lambda path: path.write_bytes(path.read_bytes()[: path.stat().st_size // 2]), ""),
        (lambda path: path.write_bytes(b"no zip"), ""),
        (lambda path: np.savez(path, x=np.zeros(3)), "'answers'"),
    ],
)
def test_a_file_of_no_arrays_is_one_line(copied, change, message):
    change(copied / FILE)
    with pytest.raises(InputError) as refused:
        RunArrays.read(copied)
    said = str(refused.value)
    assert f"run.npz: cannot be read: {message}" in said and "allowed is run.npz as" in said
    assert "\n" not in said and len(said) < 600


@pytest.mark.parametrize("name", ["none", "empty"])
def test_one_wrong_folder_of_two_writes_nothing(copied, tmp_path, capsys, name):
    (tmp_path / "empty").mkdir()
    summary = tmp_path / "summary.html"
    folders = [str(copied), str(tmp_path / name)]
    assert main(["report", *folders, "--summary", str(summary)]) == 2
    assert f"{name}: holds no result.json; allowed is" in capsys.readouterr().err
    assert not summary.exists()


def test_a_page_that_is_missing_or_in_the_way_is_one_line(copied, tmp_path, capsys):
    assert main(["report", str(copied), "--summary", str(tmp_path)]) == 2
    said = f"{tmp_path}: cannot be written: is a folder; allowed is a file"
    assert said in capsys.readouterr().err
    (copied / "report.html").unlink()
    assert main(["report", str(copied), "--pdf"]) == 2
    assert "run: holds no report.html; allowed is what a run wrote" in capsys.readouterr().err


def test_a_summary_changes_no_folder_and_json_says_what_was_made(
    copied, tmp_path, capsys, monkeypatch
):
    other = Path(shutil.copytree(copied, tmp_path / "other"))

    def files() -> dict:
        every = [p for folder in (copied, other) for p in folder.rglob("*") if p.is_file()]
        return {path: (path.stat().st_mtime_ns, path.read_bytes()) for path in every}

    before = files()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", "/nowhere")
    assert main(["report", str(copied), str(other), "--pdf", "--json"]) == 0
    printed = capsys.readouterr()
    assert files() == before
    assert Path("results/summary.html").read_text().count("report.html") == 2
    content = json.loads(printed.out)
    assert content["summary"] == "results/summary.html"
    for folder, run in zip((copied, other), content["runs"], strict=True):
        assert run["report"] == str(folder / "report.html") and run["pdf"] is None
        assert f"{folder / 'report.pdf'}: not printed: no Chromium or Chrome" in printed.err
    result = json.loads((copied / "result.json").read_text())
    wanted = {"study": "contact", "quantity": "peak_pressure", "source": "finite_element"}
    peaks = [f["value"] for f in result["figures"] if wanted.items() <= f.items()]
    assert run["verdict"] == result["verdict"] and run["figures"]["peak_pressure"] == max(peaks)
