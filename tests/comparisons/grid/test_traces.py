"""Scenes and traces from folders: one table and picture, on two workers, killed and begun again."""

import csv
import json
import os
import shutil
import signal
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scenes import PROJECT

import comparisons as crosscheck
from comparisons.cli import main
from comparisons.common.errors import InputError, SceneError
from comparisons.drawing import style
from comparisons.grid.sweep_picture import sweep_figure
from comparisons.scenes.files import SCENES

SCENE = """
title = "Ground"
roller = {radius = "7.57 mm", youngs_modulus = "210 GPa", poissons_ratio = 0.3}
body = {youngs_modulus = "210 GPa", poissons_ratio = 0.3}
profile = {file = "0.csv", x_unit = "um", z_unit = "um"}
load = {hertz_peak_pressure = "1 GPa"}
resolution = {levels = 2}
"""
MEASURED = SCENES / "profiles" / "ground_unrun.csv"
LONG, WRONG = 600, "no_trace.csv"  # samples of a trace


def cut(folder: Path, count: int) -> list[str]:
    """Names of traces in a folder, made of equal lengths of a longer one."""
    folder.mkdir()
    whole = np.loadtxt(MEASURED, delimiter=",", skiprows=3)
    starts = np.linspace(0, len(whole) - LONG, count).astype(int)
    names = [f"ground {number:02}.csv" for number in range(count)]
    for name, start in zip(names, starts, strict=True):
        np.savetxt(folder / name, whole[start : start + LONG], delimiter=",")
    return names


@pytest.fixture
def scene(tmp_path) -> Path:
    """A scene beside a folder of five traces and what is none."""
    path = tmp_path / "gear.toml"
    path.write_text(SCENE)
    cut(tmp_path / "traces", 5)
    # of words an instrument's reader would be asked, in a process of its own
    (tmp_path / "traces" / WRONG).write_text("0,0\n1,1\n")
    return path


def saved(out: Path) -> dict[str, int]:
    """The finished points, and when each was written."""
    return {path.name: path.stat().st_mtime_ns for path in (out / "sweep_points").glob("*.npz")}


def test_traces_on_a_cluster_killed_and_begun_again_make_the_same_table(
    scene, tmp_path, started, until, capsys
):
    """Solved points are not solved again; a file without a trace is a line, others go on."""
    distributed = pytest.importorskip(
        "distributed", reason="Dask is not installed: pip install distributed"
    )
    asked = ["sweep", str(scene), "--over", "profile.file=traces", "--out"]
    killed, whole = tmp_path / "killed", tmp_path / "whole"
    assert main([*asked, str(whole), "--workers", "1"]) == 0
    said = capsys.readouterr().out
    assert "6 scenes (6 of profile.file), 1 failed" in said and f"traces/{WRONG}: " in said
    with distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster:
        where = [str(killed), "--workers", cluster.scheduler_address]
        with started(sys.executable, "-m", "comparisons.cli", *asked, *where) as process:
            assert until(lambda: len(saved(killed)) >= 2)  # what is none is the first of them
            os.kill(process.pid, signal.SIGKILL)
            assert process.wait(20.0) == -signal.SIGKILL
        before = saved(killed)
        assert len(before) < 6 and not (killed / "sweep.json").exists()
        assert main([*asked, *where]) == 0
    assert before.items() <= saved(killed).items() and len(saved(killed)) == 6
    for name in ("sweep.csv", "sweep.json", "sweep.svg"):
        assert (killed / name).read_bytes() == (whole / name).read_bytes()


def test_traces_are_named_by_their_files_in_table_and_picture(scene, monkeypatch):
    monkeypatch.chdir(PROJECT)  # a pattern counts from the scene's folder
    swept = crosscheck.sweep(scene, "profile.file=traces/*0[12].csv, traces/" + WRONG, workers=1)
    names = ["ground 01.csv", "ground 02.csv", WRONG]
    lines = repr(swept).splitlines()
    assert [name for name in names if any(line.strip().startswith(name) for line in lines)] == names
    assert [point["status"] for point in swept.content["points"]] == ["solved"] * 2 + ["failed"]
    assert "mean" in repr(swept)  # traces are a sample
    content = swept.content
    content["over"][0]["values"] = [f"traces/{'a ground flank ' * 2}{n}.csv" for n in range(50)]
    with style.drawing():
        drawn = sweep_figure(content | {"points": [
            content["points"][0] | {"values": [name]} for name in content["over"][0]["values"]
        ]})  # fmt: skip
        drawn.draw_without_rendering()
    ticks = drawn.axes[-1].get_xticklabels()
    boxes = [tick.get_window_extent() for tick in ticks]
    assert [tick.get_text() for tick in ticks] == [
        name.removeprefix("traces/") for name in content["over"][0]["values"]
    ]
    assert all(one.x1 <= other.x0 for one, other in pairwise(boxes))
    assert all(drawn.bbox.y0 <= box.y0 and box.x1 <= drawn.bbox.x1 for box in boxes)


def test_traces_of_a_shipped_scene_lie_in_the_working_folder(scene, monkeypatch):
    from comparisons.grid.sweep import sweep_request
    from comparisons.scenes.scene import Scene

    monkeypatch.chdir(scene.parent)
    request = sweep_request([Scene.read("ground-unrun")], ["profile.file=traces"], ("half_plane",))
    files = [Path(file) for file in request.content["over"][0]["values"]]
    assert files == sorted(path.resolve() for path in Path("traces").iterdir())


def test_several_scenes_are_points_of_one_table(scene, tmp_path, capsys):
    """Each as it is, at every value of what is swept beside."""
    other = tmp_path / "other" / "soft.toml"
    other.parent.mkdir()
    shutil.copy(tmp_path / "traces" / "ground 00.csv", scene.parent / "0.csv")
    other.write_text(SCENE.replace("210", "150").replace("0.csv", "../0.csv"))
    out = tmp_path / "out"
    asked = [str(scene), str(other), "--over", "load=0.5 GPa,1e9", "--workers", "1"]
    assert main(["sweep", *asked, "--out", str(out)]) == 0
    with (out / "sweep.csv").open() as lines:
        rows = list(csv.DictReader(lines))
    at = {(row["scene"], row["load.hertz_peak_pressure"]) for row in rows}
    assert at == {(n, load) for n in ("gear", "soft") for load in ("0.5 GPa", "1000000000.0")}
    content = json.loads((out / "sweep.json").read_text())
    assert content["scene"] == {"name": "gear-to-soft", "title": "2 scenes"}
    alone = crosscheck.run(other, "half-plane").figure("peak_pressure", "half-plane").value
    wanted = {"scene": "soft", "study": "contact", "quantity": "peak_pressure"}
    peaks = [float(row["value"]) for row in rows if wanted.items() <= row.items()]
    assert len(peaks) == 2 and peaks[1] == alone
    said = "4 scenes (2 of scene x 2 of load.hertz_peak_pressure), 0 failed"
    assert said in capsys.readouterr().out


def test_what_no_point_may_have_is_refused_before(scene, tmp_path, complaint, monkeypatch):
    monkeypatch.setattr("comparisons.grid.points.called", None)  # nothing is solved
    asked, out = ["sweep", scene, "--over"], ("--out", tmp_path / "out")
    assert "matches no file" in complaint(*asked, "profile.file=nothing/*.csv", *out)
    assert WRONG in complaint(*asked, f"profile.file=traces/{WRONG}", *out)
    beside = ("--over", "load=1 GPa,-1e9")
    said = complaint(*asked, "profile.file=traces", *beside, *out)
    assert "load.hertz_peak_pressure: is -1" in said
    two = ("sweep", "smooth", "sinusoid", "--over", "position=3", *out)
    assert "several scenes have each their own" in complaint(*two)
    with pytest.raises(InputError, match="--over: is missing; allowed is"):
        crosscheck.sweep("smooth")
    with pytest.raises(SceneError, match="no_trace"):
        crosscheck.sweep([scene], f"profile.file=traces/{WRONG}", workers=1)
