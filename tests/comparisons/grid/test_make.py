"""Maps that are killed, interrupted, cut short, and solved by others: the same file in the end."""

import os
import signal
import sys
from contextlib import nullcontext, suppress
from pathlib import Path
from unittest.mock import patch

import pytest

from comparisons.cli import main
from comparisons.common.cache import NO_CACHE, Cache
from comparisons.common.errors import ExitStatus, InputError
from comparisons.common.processes import ProcessWorker
from comparisons.common.tasks import Tasks, called
from comparisons.grid.map import Map, make_map, request_of

SCENE = """
title = "Small"
roller = {radius = "10 mm", rigid = true}
body = {youngs_modulus = "200 GPa", poissons_ratio = 0.3}
load = {hertz_peak_pressure = "1 GPa"}
finite_element = {growth = 0.5}
resolution = {pitch = "20 um"}
"""
ASKED = ("--points", "2x2", "--x", "a_over_thickness=1:2", "--y", "poissons_ratio=0.2:0.3")
FOLDER = "map_points"
MAP, PICTURE = Map.FILES
COMMAND = (sys.executable, "-m", "comparisons.cli", "map")


@pytest.fixture(scope="module")
def scene(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("scene") / "small.toml"
    path.write_text(SCENE)
    return path


@pytest.fixture(scope="module")
def made(scene, tmp_path_factory) -> tuple[Path, list[str]]:
    """A map that nothing disturbed, and what the worker that solved it had loaded."""
    out = tmp_path_factory.mktemp("undisturbed") / "out"
    with (
        Tasks(ProcessWorker, 1, Cache(out / FOLDER, "", {})) as tasks,
        patch("comparisons.grid.points.tasks_by", lambda *_: nullcontext(tasks)),
    ):
        make_map(request_of(str(scene), *ASKED[1::2]), out)
        tasks.kept = NO_CACHE
        tasks.add("loaded", called, eval, "list(__import__('sys').modules)")
        return out, tasks.result("loaded")


def saved(out: Path) -> dict[str, int]:
    """The finished points, and when each was written."""
    return {path.name: path.stat().st_mtime_ns for path in (out / FOLDER).glob("*.npz")}


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="there is no /proc to look in")
def test_killed_and_interrupted_it_ends_with_the_same_map(
    scene, made, started, session, until, tmp_path
):
    """No worker outlives its map, and no finished point is computed again."""
    out, before = tmp_path / "out", {}
    stops = (1, os.kill, signal.SIGKILL, -9), (2, os.killpg, signal.SIGINT, 130)  # a terminal's
    for enough, stop, how, status in stops:
        with started(*COMMAND, scene, *ASKED, "--workers", "1", "--out", out) as process:
            assert until(lambda enough=enough: len(saved(out)) >= enough)
            stop(process.pid, how)
            assert process.wait(20.0) == status
            assert until(lambda leader=process.pid: not session(leader), 20.0)
            said = process.stderr.read()
        assert not (out / MAP).exists()
        assert before.items() <= saved(out).items()
        before = saved(out)
    kept = "finished points are kept, the same command goes on from there"
    assert said == f"crosscheck: interrupted; {kept}\n"
    assert main(["map", str(scene), *ASKED, "--workers", "1", "--out", str(out)]) == 0
    assert before.items() <= saved(out).items() and len(saved(out)) == 4
    assert (out / MAP).read_bytes() == (made[0] / MAP).read_bytes()
    assert (out / PICTURE).read_bytes() == (made[0] / PICTURE).read_bytes()
    assert sorted(p.name for p in out.iterdir()) == [MAP, PICTURE, FOLDER]


def test_a_dask_cluster_makes_the_same_map(scene, made, tmp_path):
    distributed = pytest.importorskip(
        "distributed", reason="Dask is not installed: pip install distributed"
    )
    with distributed.LocalCluster(1, threads_per_worker=1, dashboard_address=None) as cluster:
        where = cluster.scheduler_address
        out = tmp_path / "out"
        assert main(["map", str(scene), *ASKED, "--workers", where, "--out", str(out)]) == 0
    assert (out / MAP).read_bytes() == (made[0] / MAP).read_bytes()


def test_a_worker_loads_what_solves_and_nothing_that_shows(made):
    shows = {"matplotlib", "rich", "typer", "pyvista", "vtkmodules", "jinja2", "gmsh"}
    assert "dolfinx" in made[1] and not shows & set(made[1])


def test_without_a_folder_it_is_named_after_the_scene(scene, monkeypatch, capsys):
    def asked(request, out, *more):
        raise InputError(str(out))

    monkeypatch.setattr("comparisons.grid.map.make_map", asked)
    assert main(["map", str(scene), *ASKED]) == ExitStatus.BAD_INPUT
    assert capsys.readouterr().err == "crosscheck: results/small\n"


@pytest.mark.parametrize(
    ("workers", "what"),
    [("0", "--workers: is 0"), ("two", "--workers: is 'two'"), ("tcp://127.0.0.1:1", "--workers:")],
)
def test_wrong_workers_leave_nothing(scene, tmp_path, complaint, monkeypatch, workers, what):
    with suppress(ImportError):  # where it is not installed, that is said
        from distributed.config import config

        monkeypatch.setitem(config["distributed"]["comm"]["timeouts"], "connect", "1s")  # of 30
    said = complaint("map", scene, *ASKED, "--workers", workers, "--out", tmp_path / "out")
    assert said.startswith(f"crosscheck: {what}")
