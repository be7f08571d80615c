"""Grids of scenes: what is solved once, again, or not at all."""

from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import nullcontext
from functools import partial

import pytest

from comparisons.common.errors import SceneError
from comparisons.common.executors import ExecutorWorker
from comparisons.common.tasks import Tasks, carried_out
from comparisons.grid.points import DIED, SOLVED, Point, failed, solved_in
from comparisons.scenes.scene import Scene

SCENE = Scene.read("smooth")


def point_at(x: float) -> Point:
    return Point({"x": x}, "peak_pressure", SCENE, None, f"key{x:g}")


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


class Solved(list[float]):
    """Where points were solved, in order; what solves them says where they are."""

    def solve(self, point: Point) -> dict:
        self.append(point.at["x"])
        return {"status": SOLVED, "x": point.at["x"]}


@pytest.fixture
def solve_in(monkeypatch, tmp_path):
    """solve_in(points, opens, why_not): the results at points, those that were solved, and the
    steps."""

    def solve(points, opens=None, *why_not):
        solved, steps = Solved(), []
        tasks = "comparisons.grid.points.tasks_by"
        monkeypatch.setattr(tasks, lambda _, kept: nullcontext(Tasks(opens, 2, kept)))
        points = [point if isinstance(point, Point) else point_at(point) for point in points]
        how = solved.solve, None, steps.append, *why_not
        return solved_in(tmp_path, ("map.json",), points, *how), solved, steps

    return solve


def test_a_point_that_takes_its_process_along_fails_and_no_other_does(solve_in):
    answers, solved, _ = solve_in(range(8), partial(ExecutorWorker, Fragile(2, 7)))
    for x in (2, 7):
        assert answers[x] == failed(DIED)
    assert [answer["x"] for answer in answers if answer["status"] == SOLVED] == [0, 1, 3, 4, 5, 6]
    assert sorted(solved) == [0, 1, 3, 4, 5, 6]


def test_what_is_kept_whole_is_not_solved_again(solve_in, tmp_path):
    assert solve_in((0, 1, 2))[1] == [0, 1, 2]
    path = tmp_path / "map_points" / "key1.npz"
    path.write_bytes(path.read_bytes()[:-9])
    answers, solved, steps = solve_in((0, 1, 1, 2, 3))
    assert sorted(solved) == [1, 3] and [answer["x"] for answer in answers] == [0, 1, 1, 2, 3]
    checked = [f"map: checking {number} of 2 points" for number in (1, 2)]
    assert steps == [*checked, *(f"map: {done} of 4 points" for done in range(5))]


def test_combinations_that_do_not_go_are_answers_and_values_that_never_do_are_refused(
    solve_in, tmp_path
):
    points = [Point({"x": x, "y": y}, "", SCENE, None, f"{x}{y}") for x in "ab" for y in "cd"]

    def answers(*wrong):
        whys = {key: f"no {key}" for key in wrong}
        return solve_in(points, None, lambda point: whys.get(point.key))[0]

    with pytest.raises(SceneError, match=r"^no ad \(at y = d\)$"):
        answers("ad", "bd")
    assert list(tmp_path.iterdir()) == []
    statuses = [answer["status"] for answer in answers("ad", "bc")]
    assert statuses == [SOLVED, "failed", "failed", SOLVED]
