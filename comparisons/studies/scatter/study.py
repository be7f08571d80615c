"""What a scene's uncertain inputs do to the half-plane's figures."""

import math
from collections.abc import Mapping
from dataclasses import asdict

import numpy as np

from comparisons.common.tasks import LATER, Here, Tasks
from comparisons.figures.figure import Findings, SampleSpread
from comparisons.figures.quantity import QUANTITIES
from comparisons.models.half_plane import expected_of
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface
from comparisons.studies.contact import values_of
from comparisons.studies.scatter import show
from comparisons.studies.scatter.figures import NAME, InputScatter, scattered
from comparisons.studies.scatter.samples import solve_samples, solved, values_at
from comparisons.studies.scatter.shares import INTERVAL, Shares, designs, shares
from comparisons.studies.study import Solved, Study

TOGETHER = 16  # samples of a task: what an interrupted run may lose


def begin(solved: Solved, tasks: Tasks) -> None:
    """Make the samples known, before anything is solved."""
    if solved.runs:
        return
    scene, surface = solved.problem.scene, solved.problem.surface
    points = _points(solved.problem)
    x = solved.problem.grid(solved.problem.pitches[0]).x
    cost = expected_of(len(x)).seconds * TOGETHER
    for start in _starts(points):
        batch = points.reshape(-1, len(scene.scatter.inputs))[start : start + TOGETHER]
        by = _by(solved, tasks)
        by.add(_key(start), _batch, scene, surface, batch, x, seconds=cost, urgency=LATER)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    points, by = _points(solved.problem), _by(solved, tasks)
    batches = [by.result(_key(start)) for start in _starts(points)]
    return _gathered(solved.problem, solved.runs["half_plane"].finest, points, batches)


def _points(problem: Problem) -> np.ndarray:
    wanted = problem.scene.scatter
    return designs(wanted.samples, len(wanted.inputs), wanted.seed)


def _starts(points: np.ndarray) -> range:
    """Of the batches of samples."""
    return range(0, points[..., 0].size, TOGETHER)


def _key(start: int) -> str:
    return f"{NAME}-{start}"


def _by(solved: Solved, tasks: Tasks) -> Tasks:
    """Tasks that solve samples: those of the run, or by workers from outside."""
    if solved.opens is None:
        return tasks
    return tasks.held(NAME, NAME, lambda: Tasks(solved.opens, math.inf, tasks.kept))


def _batch(
    here: Here, scene: Scene, surface: SceneSurface, points: np.ndarray, places: np.ndarray
) -> dict[str, object]:
    here.callback("half-plane: uncertain inputs")
    return solve_samples(scene, surface, points, places)


def _gathered(problem: Problem, finest: Level, points: np.ndarray, batches: list[dict]) -> Findings:
    """Figures, shares and band from the batches in their order."""
    wanted, (nominal, _) = problem.scene.scatter, solved(problem)
    x = problem.grid(problem.pitches[0]).x
    found = [each for batch in batches for each in batch["figures"]]
    why = [each for each in found if isinstance(each, str)]
    figures = []
    columns = zip(wanted.inputs.values(), np.moveaxis(points, -1, 0), strict=True)
    scores = np.stack([values_at(spread, 1.0, column) for spread, column in columns], axis=-1)
    for number, (friction, coarse) in enumerate(nominal.items()):
        for quantity, value in values_of(finest, problem, friction).items():
            values = [np.nan if isinstance(f, str) else f[number][quantity] for f in found]
            values = np.array(values).reshape(len(points), -1)
            if coarse[quantity]:
                values *= value / coarse[quantity]
            drawn = values[np.isfinite(values)]
            if not drawn.size:
                continue
            spread = drawn.std(ddof=1) if drawn.size > 1 else 0.0
            parts = _by_input(shares(values, scores, wanted.seed), tuple(wanted.inputs))
            ends = tuple(map(float, _interval(drawn)))
            over_samples = SampleSpread(float(drawn.mean()), float(spread), ends, parts)
            samples = len(found) - len(why)
            figures.append(scattered(quantity, friction, float(value), over_samples, samples))
    pressures = np.concatenate([batch["pressures"] for batch in batches])
    pressures = pressures[np.isfinite(pressures[:, 0])]
    band = _interval(pressures) if len(pressures) else np.full((2, len(x)), np.nan)
    counts = wanted.samples, len(found), len(why), why[0] if why else None
    return InputScatter(*counts, problem.pitches[0], x, band).findings(tuple(figures))


def _interval(values: np.ndarray) -> np.ndarray:
    """The central INTERVAL of values along the first axis: (2, …)."""
    return np.percentile(values, (50.0 * (1.0 - INTERVAL), 50.0 * (1.0 + INTERVAL)), axis=0)


def _by_input(found: Shares | None, inputs: tuple[str, ...]) -> dict | None:
    if found is None:
        return None
    columns = {name: values.tolist() for name, values in asdict(found).items()}
    return {
        name: {kind: values[i] for kind, values in columns.items()} for i, name in enumerate(inputs)
    }


def _applies(solved: Solved) -> bool:
    return solved.problem.scene.scatter is not None and "half_plane" in solved.plan.models


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=_applies,
    begin=begin,
    data=InputScatter,
    blocks=show.blocks,
    lines=show.lines,
)
