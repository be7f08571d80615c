"""What a scene's uncertain inputs do to the half-plane's figures: their spread over samples.

A sample is a point of the unit cube, which stands for a scene with other inputs. It is solved by
the half-plane on its coarsest pressure elements, whose error is in every sample alike; figures are
scaled to the finest. Shares of the variance are those of `comparisons.studies.scatter.shares`.

In: a scene with [scatter], and the solved half-plane. Out: figures with their spread; how many
samples there were; the band that pressures lie in."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ndtr, ndtri

from analytic.contact.problem import ContactError
from analytic.surface.stylus import opened, with_noise
from comparisons.common.errors import InputError, one_line
from comparisons.common.progress import Stages, no_progress
from comparisons.common.tasks import LATER, Here, Tasks
from comparisons.figures.figure import Figure, Findings, SampleSpread, Series, Statement, columns_of
from comparisons.figures.uncertainty import Uncertainty
from comparisons.models.half_plane import expected_of, half_plane_level
from comparisons.models.problem import Problem, problem_of
from comparisons.models.window import window_of
from comparisons.scenes.scene import Scene
from comparisons.scenes.studies.scatter import CUT_OFF, FIELDS, Spread
from comparisons.scenes.surface import SceneSurface
from comparisons.studies.contact import values_of
from comparisons.studies.scatter.shares import INTERVAL, Shares, designs, shares
from comparisons.studies.study import SCATTER as NAME
from comparisons.studies.study import Solved

TOGETHER = 16  # samples of a task: what an interrupted run may lose
DESIGN, SHARES = "Sobol, scrambled", "Saltelli et al. 2010"
SAMPLES = "samples"  # series of their numbers


@dataclass(frozen=True)
class PressureBand:
    """The pressures of the samples, for pictures."""

    pitch: float  # [m] of the pressure elements
    x: np.ndarray = field(repr=False)  # (k,) [m]
    band: np.ndarray = field(repr=False)  # (2, k) [Pa], 2.5th and 97.5th percentile at each x


def begin(solved: Solved, tasks: Tasks) -> None:
    """Make the samples known, before anything is solved."""
    if solved.runs:
        return
    problem = solved.problem
    x = problem.grid(problem.pitches[0]).x
    cost, by = expected_of(len(x)).seconds * TOGETHER, _tasks(solved, tasks)
    for key, points in _batches(_points(problem)).items():
        sampled_scene = problem.scene, problem.surface, points, x
        by.add(key, _solve_batch, *sampled_scene, seconds=cost, urgency=LATER)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    problem, wanted = solved.problem, solved.problem.scene.scatter
    points, by = _points(problem), _tasks(solved, tasks)
    batches = [by.result(key) for key in _batches(points)]
    answers = [answer for batch in batches for answer in batch["figures"]]
    failures = [answer for answer in answers if isinstance(answer, str)]
    columns = zip(wanted.inputs.values(), np.moveaxis(points, -1, 0), strict=True)
    scores = np.stack([values_at(spread, 1.0, column) for spread, column in columns], axis=-1)
    figures, finest = [], solved.runs["half_plane"].finest
    for number, (friction, coarse) in enumerate(_nominal(problem)[0].items()):
        for quantity, value in values_of(finest, problem, friction).items():
            values = [np.nan if isinstance(a, str) else a[number][quantity] for a in answers]
            values = np.array(values).reshape(len(points), -1)
            if coarse[quantity]:
                values *= value / coarse[quantity]
            drawn = values[np.isfinite(values)]
            if drawn.size:
                parts = _by_input(shares(values, scores, wanted.seed), tuple(wanted.inputs))
                spread = _spread(drawn, parts)
                samples = len(answers) - len(failures)
                figures.append(scattered(quantity, friction, float(value), spread, samples))
    counts = {"samples": wanted.samples, "solutions": len(answers), "failed": len(failures)}
    counts["pitch"] = problem.pitches[0]
    said = [Statement("design", DESIGN), Statement("shares", SHARES)]
    said += [Statement("first failure", text) for text in failures[:1]]
    series = Series(SAMPLES, columns_of([counts], {"pitch": "m"}))
    return Findings(tuple(figures), (series,), tuple(said), _band(problem, batches))


def scattered(
    quantity: str, friction: float, nominal: float, spread: SampleSpread, samples: int
) -> Figure:
    """A figure of the half-plane [SI] with every input as the scene has it, on the finest pressure
    elements, and its spread over so many samples. Their mean is as sure as their deviation over the
    root of their number."""
    scale = abs(nominal) or 1.0
    error = spread.deviation / max(1, samples) ** 0.5
    return Figure(
        study=NAME,
        quantity=quantity,
        source="half_plane",
        value=nominal,
        at={"friction": friction},
        scale=scale,
        uncertainty=Uncertainty({"sampling": error / scale}),
        spread=spread,
    )


def by_inputs(figure: Figure) -> float:
    """Half the interval of a figure's spread, relative."""
    low, high = figure.spread.interval
    return 0.5 * (high - low) / figure.scale


def _points(problem: Problem) -> np.ndarray:
    wanted = problem.scene.scatter
    return designs(wanted.samples, len(wanted.inputs), wanted.seed)


def _batches(points: np.ndarray) -> dict[str, np.ndarray]:
    """The points of all designs (n, d), so many together, by the name of their task."""
    every = points.reshape(-1, points.shape[-1])
    starts = range(0, len(every), TOGETHER)
    return {f"{NAME}-{start}": every[start : start + TOGETHER] for start in starts}


def _tasks(solved: Solved, tasks: Tasks) -> Tasks:
    """Those that solve samples: the run's, or by workers from outside."""
    if solved.opens is None:
        return tasks
    return tasks.held(NAME, NAME, lambda: Tasks(solved.opens, math.inf, tasks.kept))


def _spread(drawn: np.ndarray, parts: dict | None) -> SampleSpread:
    deviation = drawn.std(ddof=1) if drawn.size > 1 else 0.0
    ends = tuple(map(float, _interval(drawn)))
    return SampleSpread(float(drawn.mean()), float(deviation), ends, parts)


def _band(problem: Problem, batches: list[dict]) -> PressureBand:
    x = problem.grid(problem.pitches[0]).x
    pressures = np.concatenate([batch["pressures"] for batch in batches])
    pressures = pressures[np.isfinite(pressures[:, 0])]
    band = _interval(pressures) if len(pressures) else np.full((2, len(x)), np.nan)
    return PressureBand(problem.pitches[0], x, band)


def _interval(values: np.ndarray) -> np.ndarray:
    """The central INTERVAL of values along the first axis: (2, …)."""
    return np.percentile(values, (50.0 * (1.0 - INTERVAL), 50.0 * (1.0 + INTERVAL)), axis=0)


def _by_input(of_figure: Shares | None, inputs: tuple[str, ...]) -> dict | None:
    if of_figure is None:
        return None
    columns = {name: values.tolist() for name, values in asdict(of_figure).items()}
    return {
        name: {kind: values[i] for kind, values in columns.items()} for i, name in enumerate(inputs)
    }


def values_at(spread: Spread, nominal: float, share: ArrayLike) -> np.ndarray:
    """The input's values at which its distribution reaches `share`, from 0 to 1; the scene's
    `nominal` value is the mean of what is normal."""
    if spread.range:
        low, high = spread.range
        return low + share * (high - low)
    left_out = ndtr(-CUT_OFF)
    return nominal + spread.size(nominal) * ndtri(left_out + share * (1.0 - 2.0 * left_out))


def sampled(scene: Scene, surface: SceneSurface, point: np.ndarray) -> tuple[Scene, SceneSurface]:
    """Scene and surface with their uncertain inputs at a point (d,) of the unit cube, in their
    order. Of the noise the point chooses the seed. Noise comes before the tip, which rounds what
    it makes too sharp, as a stylus would have."""
    spreads = scene.scatter.inputs
    at = dict(zip(spreads, point, strict=True))

    def value(name: str, nominal: float) -> float:
        return float(values_at(spreads[name], nominal, at[name])) if name in at else nominal

    fields = {
        f"{section}.{field}": value(name, getattr(getattr(scene, section), field))
        for name, (section, field) in FIELDS.items()
        if name in at and name != "friction"
    }
    fields["load.friction"] = tuple(value("friction", mu) for mu in scene.load.friction)
    fields[f"load.{scene.load.kind}"] = value("load", scene.load.value)
    scene = scene.unchecked(fields)
    moved, profile = value("position", surface.position) - surface.position, surface.profile
    if profile is None:
        return scene, surface
    if "noise" in at:
        rng = np.random.default_rng(int(at["noise"] * 2.0**32))
        size, correlation_length = spreads["noise"].deviation, scene.scatter.correlation_length
        profile = with_noise(profile, size, correlation_length or 0.0, rng)
    if "tip_radius" in at:
        profile = opened(profile, value("tip_radius", 0.0))
    position = surface.position + moved
    return scene, replace(surface, profile=profile.shifted(moved), position=position)


def _nominal(problem: Problem) -> tuple[dict[float, dict[str, float]], np.ndarray]:
    """Figures of the half-plane on the coarsest level, by friction coefficient and quantity, and
    the pressure (n,) [Pa] at its nodes."""
    scene = problem.scene
    window = None if scene.stress is None else window_of(problem)
    stages = Stages(no_progress)
    level = half_plane_level(problem, problem.pitches[0], window, stages, fields=False)
    figures = {friction: values_of(level, problem, friction) for friction in scene.load.friction}
    return figures, level.solution.pressure


def _solve_batch(
    here: Here, scene: Scene, surface: SceneSurface, points: np.ndarray, places: np.ndarray
) -> dict[str, object]:
    """What the half-plane finds at points (n, d): `figures`, at each a dictionary by quantity for
    every friction coefficient, or why there is none; and its `pressures` (n, k) [Pa] at places
    (k,) [m], nan without a solution."""
    here.callback("half-plane: uncertain inputs")
    answers, pressures = [], np.full((len(points), len(places)), np.nan)
    for number, point in enumerate(points):
        try:
            problem = problem_of(*sampled(scene, surface, point))
            by_friction, pressure = _nominal(problem)
            x = problem.grid(problem.pitches[0]).x
            pressures[number] = np.interp(places, x, pressure, 0.0, 0.0)
            answers.append(tuple(by_friction.values()))
        except (InputError, ContactError, ArithmeticError, ValueError) as error:
            answers.append(one_line(str(error)))
    return {"figures": tuple(answers), "pressures": pressures}
