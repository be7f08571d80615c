"""Scatter of the half-plane's figures over samples of a scene's uncertain inputs.

A sample is a point of the unit cube, which stands for a scene with other inputs. It is solved by
the half-plane on its coarsest pressure elements, whose error is in every sample alike; figures are
scaled to the finest. Shares of the variance are those of `comparisons.studies.scatter.shares`.
Where the approach is prescribed, the load of a sample is that of the endless layer at its approach,
scaled as the finite elements' load of the scene is to the layer's.

In: a scene with [scatter], and the solved half-plane. Out: figures with their spread; how many
samples there were; the band that pressures lie in; a table, and sentences."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ndtr, ndtri

from analytic.contact.problem import ContactError
from analytic.surface.stylus import opened, with_noise
from comparisons.common.errors import InputError, one_line
from comparisons.common.numbers import percent, with_unit
from comparisons.common.tasks import LATER, Here, Tasks
from comparisons.drawing.blocks import Block, Note
from comparisons.drawing.tables import figure_table
from comparisons.figures.figure import Figure, Findings, SampleSpread, Series, Statement, columns_of
from comparisons.figures.quantity import QUANTITIES, error_text, label
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.rule import values_of
from comparisons.judging.study import SCATTER as NAME
from comparisons.judging.study import Run, Solved, Study
from comparisons.models.model import scene_model
from comparisons.models.posing import load_on_layer, problem_of
from comparisons.models.problem import Problem
from comparisons.scenes.scene import Scene
from comparisons.scenes.studies.scatter import CUT_OFF, FIELDS, Spread
from comparisons.scenes.surface import SceneSurface
from comparisons.studies.scatter.shares import central, designs, shares

TOGETHER = 16  # samples of a task: what an interrupted run may lose
DESIGN, SHARES = "Sobol, scrambled", "Saltelli et al. 2010"
SAMPLES = "samples"  # series of their numbers
LISTED = 2  # inputs of a figure in the table
SMALL = 1.0 / 3.0  # a model error over what the inputs do, to be called small
SHORT = {"youngs_modulus": "E", "poissons_ratio": "ν", "_": " "}
NOTE = """The half-plane on its coarsest pressure elements, {solutions} times with inputs drawn from
the scene's [scatter] (Sobol's sequence), scaled to the finest: mean, central 95 %, and the
first-order share of each input in the variance, the largest first (Saltelli et al. 2010). Shares
that do not add up to 1 belong to inputs that act together.{failures} In the pictures of pressures
the same 95 % are a band."""


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
    x, by = problem.grid(problem.pitches[0]).x, _tasks(solved, tasks)
    cost = scene_model("half_plane", problem).cost(problem, 1)
    scale = None
    if problem.scene.load.kind == "approach":
        on_layer = load_on_layer(problem.scene, problem.surface)
        scale = problem.hertz.load_per_length / on_layer
    for key, points in _batches(_points(problem)).items():
        sampled_scene = problem.scene, problem.surface, points, x, scale
        by.add(key, _solve_batch, *sampled_scene, seconds=TOGETHER * cost.seconds, urgency=LATER)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    problem, wanted = solved.problem, solved.problem.scene.scatter
    points, by = _points(problem), _tasks(solved, tasks)
    batches = [by.result(key) for key in _batches(points)]
    coarsest, _ = _nominal(problem)
    nothing = [[np.nan] * len(of_friction) for of_friction in coarsest.values()]
    values = np.array([one or nothing for found, *_ in batches for one in found])
    pressures = np.concatenate([found for _, found, _ in batches])
    failures = [text for *_, texts in batches for text in texts]
    columns = zip(wanted.inputs.values(), np.moveaxis(points, -1, 0), strict=True)
    scores = np.stack([values_at(spread, 1.0, column) for spread, column in columns], axis=-1)
    figures = []
    for number, case in enumerate(solved.cases):
        coarse, finest = coarsest[case.friction], case.runs["half_plane"].finest
        nominal = values_of(finest, case.problem)
        for place, (quantity, value) in enumerate(nominal.items()):
            scale = value / coarse[quantity] if coarse[quantity] else 1.0
            drawn = scale * values[:, number, place]
            if np.isfinite(drawn).any():
                parts = shares(drawn.reshape(len(points), -1), scores, wanted.seed)
                named = None if parts is None else parts.by_input(wanted.inputs)
                figures.append(_scattered(quantity, case.at, value, drawn, named))
    counts = {"samples": wanted.samples, "solutions": len(values), "failed": len(failures)}
    counts["pitch"] = problem.pitches[0]
    said = [Statement("design", DESIGN), Statement("shares", SHARES)]
    said += [Statement("first failure", text) for text in failures[:1]]
    series = Series(SAMPLES, columns_of([counts], {"pitch": "m"}))
    known = pressures[np.isfinite(pressures[:, 0])]
    band = central(known) if len(known) else np.full((2, pressures.shape[1]), np.nan)
    data = PressureBand(problem.pitches[0], problem.grid(problem.pitches[0]).x, band)
    return Findings(tuple(figures), (series,), tuple(said), data)


def _scattered(
    quantity: str, at: Mapping[str, float], nominal: float, drawn: np.ndarray, parts: dict | None
) -> Figure:
    """A figure of the half-plane [SI] with every input as the scene has it, on the finest pressure
    elements, and its spread over the samples, nan without a solution. Their mean is as sure as
    their deviation over the root of their number."""
    known, scale = drawn[np.isfinite(drawn)], abs(nominal) or 1.0
    deviation = float(known.std(ddof=1)) if known.size > 1 else 0.0
    ends = tuple(central(known).tolist())
    return Figure(
        study=NAME,
        quantity=quantity,
        source="half_plane",
        value=float(nominal),
        at=at,
        scale=scale,
        uncertainty=Uncertainty({"sampling": deviation / known.size**0.5 / scale}),
        spread=SampleSpread(float(known.mean()), deviation, ends, parts),
    )


def _points(problem: Problem) -> np.ndarray:
    wanted = problem.scene.scatter
    return designs(wanted.samples, len(wanted.inputs), wanted.seed)


def _batches(points: np.ndarray) -> dict[str, np.ndarray]:
    """The points of all designs (n, d), so many together, by the name of their task."""
    every = points.reshape(-1, points.shape[-1])
    starts = range(0, len(every), TOGETHER)
    return {f"{NAME}-{start}": every[start : start + TOGETHER] for start in starts}


def _tasks(solved: Solved, tasks: Tasks) -> Tasks:
    """Tasks that solve samples: the run's, or by workers from outside."""
    if solved.opens is None:
        return tasks
    return tasks.held(NAME, NAME, lambda: Tasks(solved.opens, math.inf, tasks.kept))


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
    levels = scene_model("half_plane", problem).solve(Here(), problem, 1)
    figures = {friction: values_of(level, problem) for friction, level in levels.items()}
    return figures, levels[problem.scene.load.friction[0]].solution.pressure


def _solve_batch(
    here: Here,
    scene: Scene,
    surface: SceneSurface,
    points: np.ndarray,
    places: np.ndarray,
    scale: float | None,
) -> tuple[list[list | None], np.ndarray, list[str]]:
    """Results of the half-plane at points (n, d): figures (f, q) by friction coefficient and
    quantity, None without a solution; pressures (n, k) [Pa] at x (k,) [m], then nan; and why there
    is none. `scale` of the layer's load where the approach is prescribed, else None."""
    here.callback("half-plane: uncertain inputs")
    figures, pressures, failures = [], np.full((len(points), len(places)), np.nan), []
    for number, point in enumerate(points):
        try:
            one = sampled(scene, surface, point)
            load = None if scale is None else scale * load_on_layer(*one)
            problem = problem_of(*one, load)
            by_friction, pressure = _nominal(problem)
            x = problem.grid(problem.pitches[0]).x
            pressures[number] = np.interp(places, x, pressure, 0.0, 0.0)
            figures.append([list(of_friction.values()) for of_friction in by_friction.values()])
        except (InputError, ContactError, ArithmeticError, ValueError) as error:
            failures.append(one_line(str(error)))
            figures.append(None)
    return figures, pressures, failures


def blocks(run: Run) -> list[Block]:
    findings = run.findings[NAME]
    [counts] = findings.table(SAMPLES).rows()
    why = findings.said("first failure")
    failures = f" {counts['failed']} had no solution, the first because: {why}."
    note = NOTE.format(solutions=counts["solutions"], failures=failures if why else "")
    table = figure_table(findings.figures, QUANTITIES, beside=SPREAD)
    return [Block("inputs", (table, Note(note)), "Uncertain inputs")]


def largest_shares(figure: Figure, most: int = LISTED) -> list[str]:
    """The inputs with the largest total shares of the variance, each with its first-order one."""
    parts = sorted((figure.spread.shares or {}).items(), key=lambda part: -part[1]["total"])
    shares = []
    for name, part in parts[:most]:
        for long, short in SHORT.items():
            name = name.replace(long, short)
        size = percent(max(part["first"], 0.0), uncertainty=part["first_uncertainty"])
        shares.append(f"{name} {size}")
    return shares


# Columns of the table beside the figures themselves, by their heads.
SPREAD = {
    "mean": lambda figure: _in_unit(figure, figure.spread.mean),
    "central 95 %": lambda figure: _in_unit(figure, *figure.spread.interval),
    "of nominal": lambda figure: f"±{percent(figure.by_inputs)}",
    "by input": lambda figure: ", ".join(largest_shares(figure)),
}


def _in_unit(figure: Figure, *values: float) -> str:
    unit = QUANTITIES[figure.quantity].unit
    return " to ".join(with_unit(value, unit) for value in values)


def lines(run: Run) -> list[tuple[str, str]]:
    """Lines: what the inputs do to each judged figure at the friction coefficient that decides."""
    said = []
    for figure in run.figures.of(study=NAME, friction=run.deciding_friction):
        if figure.quantity in run.problem.scene.tolerances:
            most = ", ".join(largest_shares(figure, 1))
            text = f"{label(figure.quantity)} ±{percent(figure.by_inputs)}, most by {most}"
            said.append(("inputs", text))
    return said


def remark(run: Run, error: Figure) -> str:
    """How a model error compares with what inputs do to its figure, where that is more than its
    tolerance: a model error below that is not what a user would see first."""
    quantity = error.quantity
    figure = run.figures.one(study=NAME, quantity=quantity, friction=error.friction)
    if figure is None or figure.by_inputs <= error.tolerance:
        return ""
    size, moved = abs(error.value), figure.by_inputs
    if size + error.numerical < SMALL * moved:
        how = "is small beside it"
    elif size - error.numerical > moved:
        how = "is larger"
    else:
        how = "is of that size"
    shown = error_text(error.value, error.numerical)
    inputs = f"Your inputs move the {label(quantity)} by ±{percent(moved)}"
    return f"{inputs}: the half-plane's model error of {shown} {how}."


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: (
        solved.problem.scene.scatter is not None and "half_plane" in solved.plan.models
    ),
    begin=begin,
    blocks=blocks,
    lines=lines,
    remark=remark,
)
