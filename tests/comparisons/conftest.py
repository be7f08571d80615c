"""Finished runs in a fraction of a second: real contact solutions, closed-form stress fields.

The run that stands for the finite elements is the same solver on a body one per cent stiffer,
with a structured mesh beside it: what shows results needs results, not a factorisation.
"""

import math
import os
import pickle
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
from scenes import PROJECT, STEADY, WAVY, resolved

import meshes.build
from analytic.contact.patches import contact_patches
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import hertz_extremes, hertz_from_load, hertz_stress
from analytic.operators.half_plane import HalfPlane
from analytic.stress_state import Extremum, StressState
from comparisons.cli import main
from comparisons.common import tasks
from comparisons.common.tasks import Tasks
from comparisons.drawing.style import Picture, drawing
from comparisons.figures.quantity import MODELS, QUANTITIES
from comparisons.judging.study import Case, Run, Solved, studied
from comparisons.models.level import Level, MeshField, Solution, StressResult
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.output.page import page
from comparisons.output.page.page import PICTURES
from comparisons.runs.run import record_of
from comparisons.studies import STUDIES
from meshes.block import BlockMesh, structured

# What fails on a page fails its test; those of what a failure costs say so.
page.attempted = lambda what, make: make()
# Tests count and replace what is done in their own process; those of several processes say so.
tasks.WORTH_A_FORK = tasks.WORTH_A_START = math.inf

STIFFER = 1.01
SAMPLING = 1.25e-3  # what half the samples of a trace change, in any figure


def block_mesh(problem: Problem, cells: int = 24) -> BlockMesh:
    """A square block, finer towards the middle of its top."""
    line = 40.0 * problem.hertz.half_width * np.linspace(-1.0, 1.0, cells + 1) ** 3
    return structured(line, line[cells // 2 :])


def stress_of(problem: Problem, modulus: float, window: Window, friction: float) -> StressResult:
    hertz = hertz_from_load(problem.hertz.load_per_length, problem.scene.roller.radius, modulus)
    known = hertz_extremes(hertz, friction)
    txz = max(known.txz_max, known.txz_min, key=lambda extreme: abs(extreme.value))
    field = hertz_stress(hertz, window.x, window.z[:, None], friction)
    deepest = Extremum(2.0 * known.tau1.value, known.tau1.x, known.tau1.z)
    extremes = {"tau1": known.tau1, "txz": txz, "von_mises": deepest}
    maxima = {name: by_asperity(problem, extremes[name]) for name in ("tau1", "txz")}
    return StressResult(friction, extremes, maxima, field)


def by_asperity(problem: Problem, largest: Extremum) -> np.ndarray:
    """Value [Pa], x and z [m] (3, k): of the largest, 0 of the others."""
    maxima = np.full((3, len(problem.asperities) + 1), np.nan)
    maxima[0], place = 0.0, np.searchsorted(problem.asperities, largest.x)
    maxima[:, place] = abs(largest.value), largest.x, largest.z
    return maxima


def levels_of(
    problem: Problem, name: str, pitch: float, window: Window | None
) -> dict[float, Level]:
    """Levels of one contact, by friction coefficient."""
    modulus = problem.modulus * (STIFFER if name == "finite_element" else 1.0)
    grid = problem.grid(pitch)
    operator = HalfPlane(grid.count, pitch, modulus)
    weighted_gap = grid.hat_integrals(problem.gap, problem.knots)
    solution = solve_contact(operator, weighted_gap, grid.weights, problem.constraints())
    mesh = block_mesh(problem) if name == "finite_element" else None
    mesh_field = None
    if mesh is not None and window is not None:
        zero = np.zeros(len(mesh.points))
        nodal = {
            friction: StressState(zero, zero, zero) for friction in problem.scene.load.friction
        }
        moved = dict.fromkeys(problem.scene.load.friction, 0.001 * mesh.points[:, ::-1])
        nu = np.full(len(mesh.points), 0.3)
        mesh_field = MeshField(mesh.points, mesh.triangles, nodal, moved, nu)
    level = Level(
        grid=grid,
        solution=solution,
        displacement=0.5 * operator.apply(solution.pressure) / grid.weights,
        patches=contact_patches(grid.x, solution.pressure, solution.gap),
        seconds={"contact": 0.0123, "stresses": 0.456}
        if mesh is None
        else {"mesh": 1.25, "assembly": 0.375, "factorisation": 1.125, "contact": 0.25},
        unknowns=grid.count if mesh is None else 2 * len(mesh.points),
        mesh=mesh,
        mesh_field=mesh_field,
    )
    if window is None:
        return dict.fromkeys(problem.scene.load.friction, level)
    stresses = (stress_of(problem, modulus, window, mu) for mu in problem.scene.load.friction)
    return {stress.friction: replace(level, stress=stress) for stress in stresses}


def finished_run(tables: dict, models: tuple[str, ...] = MODELS) -> Run:
    """The run of a scene given as tables."""
    scene = resolved(tables)
    problem = problem_of(scene)
    plan = make_plan(problem, models)
    window = None
    if scene.stress is not None:
        columns, rows = scene.stress.points
        half_width = problem.hertz.half_width
        window = Window(
            np.linspace(-1.5, 1.5, columns + 1) * half_width,
            np.linspace(0.0, 1.0, rows) ** 2 * half_width,
            (-1.5 * half_width, 1.5 * half_width),
        )
    problem = replace(problem, window=window)
    levels = {
        name: [levels_of(problem, name, pitch, window) for pitch in problem.pitches]
        for name in models
    }
    # there are no finite elements to show effects, and no other contact that friction makes
    plan = replace(plan, effects=False, coupling=False)
    resolved_all = "every judged quantity is resolved"
    cases = []
    for mu in problem.scene.load.friction:
        runs = {n: Solution(n, tuple(level[mu] for level in of)) for n, of in levels.items()}
        cases.append(Case(problem.under(mu), runs))
    solved = Solved(problem, plan, tuple(cases), resolved_all)
    sizes = dict.fromkeys(QUANTITIES, SAMPLING)
    with (
        patch("comparisons.judging.effects.sampling.sampling_changes", lambda *_: sizes),
        patch("comparisons.judging.ladder.cost.other_elements", lambda *_: {}),
    ):
        findings = studied(STUDIES, solved, Tasks())
    return Run(solved, findings, record_of(solved, findings), Path("results/made"), STUDIES)


@pytest.fixture(scope="session")
def finish() -> Callable[..., Run]:
    """`finish(tables, models)`: the run of a scene given as tables."""
    return finished_run


@pytest.fixture(scope="session")
def smooth_outcome() -> Run:
    return finished_run(STEADY)


@pytest.fixture(scope="session")
def wavy_outcome() -> Run:
    """Rough, with a hardness and two friction coefficients."""
    return finished_run(WAVY)


def no_pictures(run: Run) -> dict:
    """Stands in for `comparisons.output.page.page.draw`, which takes longer than all the rest of a
    run: the page has all its words, and nothing to look at."""
    blank = Picture("data:image/svg+xml;base64,", "", "")
    return {name: [blank] for name in PICTURES}


@pytest.fixture(scope="session")
def drawn_only() -> Callable[..., AbstractContextManager]:
    """`with drawn_only("fields"):` of a report's pictures those named alone are drawn."""

    @contextmanager
    def of(*names: str) -> Iterator[None]:
        def draw(run: Run) -> dict:
            return no_pictures(run) | {name: PICTURES[name](run) for name in names}

        with patch("comparisons.output.page.page.draw", draw), drawing():
            yield

    return of


@pytest.fixture(scope="module")
def undrawn() -> Iterator[None]:
    """The reports of a whole module without pictures."""
    with patch("comparisons.output.page.page.draw", no_pictures):
        yield


@pytest.fixture
def complaint(tmp_path: Path, capsys: pytest.CaptureFixture) -> Callable[..., str]:
    """`complaint(*arguments)`: the one line that the command ends with, after status 2 and without
    a trace of a result in the test's folder."""

    def held() -> dict[Path, bytes | bool]:
        return {path: path.is_file() and path.read_bytes() for path in tmp_path.rglob("*")}

    def line(*arguments: object) -> str:
        before = held()
        status = main(list(map(str, arguments)))
        out, err = capsys.readouterr()
        assert status == 2, err
        assert out == ""
        assert err.startswith("crosscheck: ") and err.endswith("\n") and err.count("\n") == 1
        assert held() == before
        return err.strip()

    return line


@pytest.fixture(scope="session")
def meshed() -> dict[bytes, tuple[np.ndarray, np.ndarray]]:
    """gmsh's answers so far, by the pickled task."""
    return {}


@pytest.fixture(scope="module", autouse=True)
def meshed_once(meshed: dict[bytes, tuple[np.ndarray, np.ndarray]]) -> Iterator[None]:
    """gmsh makes each mesh once: its start takes most of its time, and many modules have the same
    scenes. `tests/meshes` show that equal tasks give equal meshes to the last bit."""
    mesh = meshes.build.run_worker

    def cached(task: tuple) -> tuple[np.ndarray, np.ndarray]:
        key = pickle.dumps(task)
        if key not in meshed:
            meshed[key] = mesh(task)
        vertices, triangles = meshed[key]
        return vertices.copy(), triangles.copy()

    with patch("meshes.build.run_worker", cached):
        yield


def running(leader: int) -> list[int]:
    """Processes that run in a session; zombies have ended."""
    numbers = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[3]) == leader and fields[0] != "Z":
            numbers.append(int(path.parent.name))
    return numbers


@pytest.fixture(scope="session")
def session() -> Callable[[int], list[int]]:
    """`session(leader)`: numbers of the processes that run in it, as /proc tells them."""
    return running


@pytest.fixture(scope="session")
def started() -> Callable[..., AbstractContextManager[subprocess.Popen]]:
    """`with started("python", …) as process`: a command in a session of its own, of which nothing
    is left in the end."""

    @contextmanager
    def opened(*command: object) -> Iterator[subprocess.Popen]:
        process = subprocess.Popen(
            list(map(str, command)),
            cwd=PROJECT,
            env=os.environ | {"PYTHONPATH": str(PROJECT)},
            start_new_session=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        try:
            yield process
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
            for number in running(process.pid):
                os.kill(number, signal.SIGKILL)
            process.communicate()

    return opened


@pytest.fixture(scope="session")
def until() -> Callable[..., bool]:
    """`until(condition, patience)`: whether it came true in so many seconds."""

    def came_true(condition: Callable[[], bool], patience: float = 60.0) -> bool:
        end = time.monotonic() + patience
        while time.monotonic() < end:
            if condition():
                return True
            time.sleep(0.02)
        return False

    return came_true
