"""Reports drawn again from their folders: the same page, nothing solved, wrong folders refused."""

import json
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

from comparisons.cli import main
from comparisons.common.progress import no_progress
from comparisons.output.page.saved import FILE, read_run
from comparisons.runs.write import write_files
from comparisons.studies.study import Run


@pytest.fixture(scope="module")
def written(
    tmp_path_factory: pytest.TempPathFactory, rendered: Callable[[Run], str]
) -> Callable[[Run], Path]:
    """`written(outcome)`: the folder that its run leaves; each is written and drawn once."""
    folders: dict[int, Path] = {}

    def folder_of(outcome: Run) -> Path:
        if id(outcome) not in folders:
            folder = tmp_path_factory.mktemp("runs") / "run"
            with patch("comparisons.output.page.page.render", lambda *_: rendered(outcome)):
                write_files(replace(outcome, directory=folder), no_progress)
            folders[id(outcome)] = folder
        return folders[id(outcome)]

    return folder_of


@pytest.fixture
def copied(written, smooth_outcome: Run, tmp_path: Path) -> Path:
    """A run's folder to spoil."""
    return Path(shutil.copytree(written(smooth_outcome), tmp_path / "run"))


def forbidden(*_: object, **__: object) -> None:
    raise AssertionError("something is solved or meshed")


@pytest.mark.parametrize("name", ["wavy_outcome", "half_plane_outcome"])
def test_the_page_drawn_again_is_the_same_and_nothing_is_solved_for_it(
    request, written, tmp_path, name, capsys, monkeypatch
):
    """Whatever the settings of matplotlib."""
    import matplotlib

    folder = Path(shutil.copytree(written(request.getfixturevalue(name)), tmp_path / "run"))
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    (folder / "report.html").write_text("lost")
    for place in (
        "comparisons.models.nearest_operator.solve_contact",
        "comparisons.models.half_plane.half_plane_on",
        "meshes.build.run_worker",
        "comparisons.models.finite_element.level.finite_element_level",
    ):
        monkeypatch.setattr(place, forbidden)
    with matplotlib.rc_context({"font.size": 31.0, "axes.grid": False, "lines.linewidth": 9.0}):
        assert main(["report", str(folder)]) == 0
        assert matplotlib.rcParams["font.size"] == 31.0
    after = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert after == before
    assert str(folder / "report.html") in capsys.readouterr().out.replace("\n", "")


def test_what_is_kept_is_exact_but_for_fields_and_small(written, wavy_outcome: Run):
    folder = written(wavy_outcome)
    again = read_run(folder)
    for name, run in wavy_outcome.runs.items():
        level = again.runs[name].finest
        np.testing.assert_array_equal(level.solution.pressure, run.finest.solution.pressure)
        for friction in wavy_outcome.problem.scene.load.friction:
            mine, solved = level.stress(friction).field, run.finest.stress(friction).field
            np.testing.assert_array_equal(mine.tau1, solved.tau1.astype(np.float32))
            np.testing.assert_array_equal(mine.txz, solved.txz.astype(np.float32))
    assert again.exit_status == wavy_outcome.exit_status
    points = wavy_outcome.window.x.size * wavy_outcome.window.z.size
    fields = 2 * 2 * len(wavy_outcome.problem.scene.load.friction) * points * 4  # bytes
    assert (folder / FILE).stat().st_size < fields + 250_000


def spoil(folder: Path, what: str) -> None:
    path = folder / what
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda f: shutil.rmtree(f), "run: is no folder; allowed is the folder of a finished run"),
        (lambda f: (f / FILE).unlink(), "run: holds no report.npz; allowed is what this version"),
        (lambda f: (f / "result.json").unlink(), "run: holds no result.json; allowed is"),
        (lambda f: spoil(f, FILE), "report.npz: cannot be read: "),
        (lambda f: spoil(f, "record.json"), "record.json: is not JSON: "),
        (lambda f: (f / FILE).write_bytes(b"no zip"), "report.npz: cannot be read: "),
        (
            lambda f: (f / FILE).write_bytes(
                (f / FILE).read_bytes().replace(b"a1.npy", b"\x07" * 6, 1)
            ),
            "report.npz: cannot be read: ",
        ),
        (
            lambda f: np.savez(f / FILE, outline=np.array(json.dumps({"schema": 9}))),
            "report.npz: schema: is 9; allowed is 3; ",
        ),
        (
            lambda f: np.savez(
                f / FILE,
                outline=np.array(json.dumps({"schema": 3, "outcome": {"dict": [["x", 1]]}})),
            ),
            "report.npz: cannot be read: 'run'; allowed is",
        ),
        (lambda f: spoil(f, "finite_element/mesh.msh"), "mesh.msh: cannot be read: "),
    ],
)
def test_a_folder_that_holds_no_whole_run_is_wrong_input(copied, capsys, change, message):
    change(copied)
    left = (copied / "report.html").read_bytes() if copied.is_dir() else None
    assert main(["report", str(copied)]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1 and len(said) < 600
    if left is not None:
        assert (copied / "report.html").read_bytes() == left


def test_one_wrong_folder_of_two_leaves_the_other_as_it_was(copied, tmp_path, capsys):
    (copied / "report.html").write_text("before")
    summary = tmp_path / "summary.html"
    arguments = [str(copied), str(tmp_path / "none"), "--summary", str(summary)]
    assert main(["report", *arguments]) == 2
    assert "none: is no folder" in capsys.readouterr().err
    assert main(["report", str(copied), "--summary", str(tmp_path)]) == 2
    assert f"--summary: {tmp_path} is a folder; allowed is a file" in capsys.readouterr().err
    assert (copied / "report.html").read_text() == "before"
    assert not summary.exists()


def test_a_damaged_mesh_costs_a_batch_its_own_report_alone(
    copied, written, wavy_outcome, tmp_path, capsys, monkeypatch, no_pictures
):
    monkeypatch.setattr("comparisons.output.page.page.draw", no_pictures)
    whole = Path(shutil.copytree(written(wavy_outcome), tmp_path / "whole"))
    for folder in (copied, whole):
        (folder / "report.html").write_text("before")
    mesh = copied / "finite_element/mesh.msh"
    mesh.write_bytes(mesh.read_bytes().replace(b"$Nodes", b"$Nod", 1))
    monkeypatch.chdir(tmp_path)
    assert main(["report", "run", "whole"]) == 2
    err = capsys.readouterr().err
    assert "run/finite_element/mesh.msh: cannot be read: " in err and err.count("\n") == 1
    assert (copied / "report.html").read_text() == "before"
    assert (whole / "report.html").read_text() != "before"
    summary = (tmp_path / "results/summary.html").read_text()
    assert "whole/report.html" in summary and "run/report" not in summary


def test_a_summary_changes_no_folder(copied, tmp_path):
    other = Path(shutil.copytree(copied, tmp_path / "other"))
    (copied / "report.html").write_text("as it was")

    def files() -> dict:
        every = [path for folder in (copied, other) for path in folder.rglob("*")]
        return {
            path: (path.stat().st_mtime_ns, path.is_file() and path.read_bytes()) for path in every
        }

    before = files()
    summary = tmp_path / "all.html"
    assert main(["report", str(copied), str(other), "--summary", str(summary)]) == 0
    assert files() == before
    assert summary.read_text().count("report.html") == 2


def test_json_says_what_was_made_and_without_a_browser_why_there_is_no_pdf(
    copied, tmp_path, capsys, monkeypatch, no_pictures
):
    monkeypatch.setattr("comparisons.output.page.page.draw", no_pictures)
    summary = tmp_path / "over" / "summary.html"
    monkeypatch.setenv("PATH", "/nowhere")
    assert main(["report", str(copied), "--summary", str(summary), "--pdf", "--json"]) == 0
    printed = capsys.readouterr()
    content = json.loads(printed.out)
    assert content["summary"] == str(summary)
    [run] = content["runs"]
    assert run["report"] == str(copied / "report.html")
    assert run["pdf"] is None
    assert not (copied / "report.pdf").exists()
    assert "report.pdf: not printed: no Chromium or Chrome starts here" in printed.err
    assert printed.err.count("\n") == 1
    assert run["verdict"] in ("holds", "fails", "inconclusive")
    result = json.loads((copied / "result.json").read_text())
    wanted = {"study": "contact", "quantity": "peak_pressure", "source": "finite_element"}
    peak = next(f["value"] for f in result["figures"] if wanted.items() <= f.items())
    assert run["figures"]["peak_pressure"] == peak
