"""Maps that are killed, interrupted, cut short, and solved by others: the same file in the end."""

import io
import json
import os
import signal
import sys
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import nullcontext, suppress
from functools import partial
from pathlib import Path
from unittest.mock import patch

import pytest
from rich.console import Console

from comparisons.campaigns.grid import DIED, Point, finish, point_cache
from comparisons.campaigns.maps.content import MAP, PICTURE, map_table
from comparisons.campaigns.maps.make import TIMES, exit_status, make_map
from comparisons.campaigns.maps.point import NOT_CONVERGED
from comparisons.campaigns.maps.request import request_of
from comparisons.cli import main
from comparisons.common.cache import NO_CACHE
from comparisons.common.errors import ExitStatus
from comparisons.common.executors import ExecutorWorker
from comparisons.common.processes import ProcessWorker
from comparisons.common.progress import no_progress
from comparisons.common.tasks import Tasks, called, carried_out
from comparisons.scenes.scene import Scene

SCENE = """
title = "Small"

[roller]
radius = "10 mm"
rigid = true

[body]
youngs_modulus = "200 GPa"
poissons_ratio = 0.3

[load]
hertz_peak_pressure = "1 GPa"

[finite_element]
growth = 0.5

[resolution]
pitch = "20 um"
"""
ASKED = ("--points", "2x2", "--x", "a_over_thickness=1:2", "--y", "poissons_ratio=0.2:0.3")
FOLDER = "map_points"
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
        Tasks(ProcessWorker, 1, point_cache(out, "map")) as tasks,
        patch("comparisons.campaigns.grid.tasks_by", lambda *_: nullcontext(tasks)),
    ):
        make_map(request_of(str(scene), *ASKED[1::2]), out)
        tasks.kept = NO_CACHE
        tasks.add("loaded", called, eval, "list(__import__('sys').modules)")
        return out, tasks.result("loaded")


@pytest.fixture(scope="module")
def undisturbed(made) -> Path:
    return made[0]


def saved(out: Path) -> dict[str, int]:
    """The finished points, and when each was written."""
    return {path.name: path.stat().st_mtime_ns for path in (out / FOLDER).glob("*.npz")}


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="there is no /proc to look in")
class TestStopped:
    def test_killed_and_interrupted_it_ends_with_the_same_map(
        self, scene, undisturbed, started, session, until, tmp_path
    ):
        """No worker outlives its map, and no finished point is computed again."""
        out, before = tmp_path / "out", {}
        for enough, stop, status in ((1, self.kill, -9), (2, self.interrupt, 130)):
            with started(*COMMAND, scene, *ASKED, "--workers", "1", "--out", out) as process:
                assert until(lambda enough=enough: len(saved(out)) >= enough)
                stop(process.pid)
                assert process.wait(20.0) == status
                assert until(lambda leader=process.pid: not session(leader), 20.0)
                said = process.stderr.read()
            assert not (out / MAP).exists()
            assert before.items() <= saved(out).items()
            before = saved(out)
        assert said == (
            "crosscheck: interrupted; finished points are kept, the same command goes on from "
            "there\n"
        )
        (out / FOLDER / ".half.7.part").write_text("{")
        assert main(["map", str(scene), *ASKED, "--workers", "1", "--out", str(out)]) == 0
        assert before.items() <= saved(out).items() and len(saved(out)) == 4
        assert (out / MAP).read_bytes() == (undisturbed / MAP).read_bytes()
        assert (out / PICTURE).read_bytes() == (undisturbed / PICTURE).read_bytes()
        assert sorted(p.name for p in out.iterdir()) == [MAP, PICTURE, FOLDER, TIMES]
        assert not list((out / FOLDER).glob(".*"))

    def kill(self, process: int) -> None:
        os.kill(process, signal.SIGKILL)

    def interrupt(self, process: int) -> None:
        os.killpg(process, signal.SIGINT)  # as a terminal does


def test_a_map_holds_no_times(undisturbed):
    content = (undisturbed / MAP).read_text()
    assert "seconds" not in content
    times = json.loads((undisturbed / TIMES).read_text())["seconds"]
    assert len(times) == 4 and min(times) > 0.0


def test_ranks_make_the_same_map(scene, undisturbed, tmp_path, launch):
    arguments = ("-m", "comparisons.cli", "map", scene, *ASKED, "--out", tmp_path / "out")
    end = launch(2, *arguments)
    assert end.returncode == 0, end.stderr
    assert (tmp_path / "out" / MAP).read_bytes() == (undisturbed / MAP).read_bytes()
    assert end.stdout.count("made by: crosscheck map") == 1


def test_a_dask_cluster_makes_the_same_map(scene, undisturbed, tmp_path):
    distributed = pytest.importorskip(
        "distributed", reason="Dask is not installed: pip install distributed"
    )
    with distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster:
        where = cluster.scheduler_address
        out = tmp_path / "out"
        assert main(["map", str(scene), *ASKED, "--workers", where, "--out", str(out)]) == 0
    assert (out / MAP).read_bytes() == (undisturbed / MAP).read_bytes()


def test_a_worker_loads_what_solves_and_nothing_that_shows(made):
    shows = {"matplotlib", "rich", "typer", "pyvista", "vtkmodules", "jinja2", "gmsh"}
    assert "dolfinx" in made[1] and not shows & set(made[1])


class Fragile(Executor):
    """Solves at once what is submitted; at a deadly point it says what Dask would."""

    def __init__(self, *deadly: float) -> None:
        self.deadly = deadly

    def submit(self, *task):
        future = Future()
        if task[-1].at["x"] in self.deadly:
            future.set_exception(BrokenExecutor("killed"))
        else:
            future.set_result(carried_out(*task[1:]))
        return future


def point_at(x: float) -> Point:
    return Point({"x": x}, "peak_pressure", Scene.read("smooth"), None, f"key{x:g}")


class Solved(list[float]):
    """Where points were solved, in order; what solves them says where they are."""

    def solve(self, point: Point) -> dict:
        self.append(point.at["x"])
        return {"status": "solved", "x": point.at["x"]}


def test_a_point_that_takes_its_process_along_fails_and_no_other_does(tmp_path):
    cache, solved = point_cache(tmp_path, "map"), Solved()
    with Tasks(partial(ExecutorWorker, Fragile(2, 7)), 2, cache) as tasks:
        finish([point_at(x) for x in range(8)], solved.solve, tasks, no_progress, "map")
    found = [cache.load(f"key{x}")[0] for x in range(8)]
    for x in (2, 7):
        assert found[x] == {"status": "failed", "why": DIED}
    assert [f["x"] for f in found if f["status"] == "solved"] == [0, 1, 3, 4, 5, 6]
    assert sorted(solved) == [0, 1, 3, 4, 5, 6]


def test_what_is_kept_whole_is_not_solved_again(tmp_path):
    cache, solved, stages = point_cache(tmp_path, "map"), Solved(), []
    for points in ((0, 1, 2), (0, 1, 1, 2, 3)):
        before = list(solved)
        finish([point_at(x) for x in points], solved.solve, Tasks(kept=cache), stages.append, "map")
        path = tmp_path / FOLDER / "key1.npz"
        path.write_bytes(path.read_bytes()[:-9])
    assert sorted(solved[len(before) :]) == [1, 3]
    assert stages[-5:] == [f"map: {done} of 4 points" for done in range(5)]


def test_failed_points_are_in_the_map_with_their_reason(scene, tmp_path, monkeypatch):
    request = request_of(str(scene), "2x2", "a_over_width=0.3:3", "poissons_ratio=0.2:0.6")
    assert [point.why is None for point in request.points] == [True, True, False, False]
    answer = {"status": "failed", "why": "no"}
    monkeypatch.setattr("comparisons.campaigns.maps.make.solve_point", lambda point: answer)
    monkeypatch.setattr(
        "comparisons.campaigns.grid.tasks_by", lambda _, kept: nullcontext(Tasks(kept=kept))
    )
    content = make_map(request, tmp_path / "out")
    whys = [point["why"] for point in content["points"]]
    assert whys[:2] == ["no", "no"] and "body.poissons_ratio" in whys[2]
    assert [rule["law"] for rule in content["rules"]] == ["no simple bound"] * 4
    assert exit_status(content) == ExitStatus.DONE
    content["points"][0]["why"] = f"half_plane: {NOT_CONVERGED}"
    assert exit_status(content) == ExitStatus.NOT_CONVERGED
    assert "failed, 2: " in printed(map_table(content, tmp_path))


def printed(renderable: object) -> str:
    console = Console(width=200, record=True, file=io.StringIO())
    console.print(renderable)
    return console.export_text()


@pytest.mark.parametrize(
    ("workers", "what"),
    [("0", "--workers: is 0"), ("two", "--workers: is 'two'"), ("tcp://127.0.0.1:1", "--workers:")],
)
def test_wrong_workers_leave_nothing(scene, tmp_path, capsys, monkeypatch, workers, what):
    out = tmp_path / "out"
    with suppress(ImportError):  # where it is not installed, that is said
        from distributed.config import config

        monkeypatch.setitem(config["distributed"]["comm"]["timeouts"], "connect", "1s")  # of 30
    assert main(["map", str(scene), *ASKED, "--workers", workers, "--out", str(out)]) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.startswith(f"crosscheck: {what}")
    assert len(said.err.splitlines()) == 1 and not out.exists()
