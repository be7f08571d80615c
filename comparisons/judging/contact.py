"""Contact of each model and stresses below it: the study every run has.

In: solved levels of each model. Out: figures of the finest one with their uncertainties, patches,
and what the levels took."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import Scale, plain
from comparisons.drawing import style
from comparisons.drawing.curves import distinct, hertz_text, joint_label
from comparisons.figures.figure import Column, Figure, Findings, Series, Statement, columns_of
from comparisons.figures.quantity import QUANTITIES as COMPARED
from comparisons.figures.quantity import WHOLE, Quantity
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.rule import EXTREMES, judged
from comparisons.judging.study import CONTACT as NAME
from comparisons.judging.study import SCATTER, Case, Run, Solved, Study
from comparisons.models.level import Level, Solution
from comparisons.models.problem import Problem
from comparisons.models.smooth import closed_form

if TYPE_CHECKING:
    from matplotlib.axes import Axes

QUANTITIES = COMPARED | {
    "contact_ratio": Quantity("contact length over Hertz 2a"),
    "von_mises_max": Quantity("largest von Mises stress", "Pa"),
    "contact_ratio_extent": Quantity("contact length over its extent"),
    "peak_position": Quantity("position of the peak pressure", "m"),
    "load_per_length": Quantity("load per length", "N/m"),
    "approach": Quantity("approach from first touch", "m"),
}
MARKERS = {"half_plane": "o", "finite_element": "x", "whole": "d"}  # of nodes
MOST_MARKED = 150  # nodes of a close-up: more would be a band
AT_HARDNESS = 1.0 - 1e-9  # times the hardness: a pressure held there
# What is read of the same field or patches is as uncertain.
AS_UNCERTAIN = {"von_mises_max": "tau1_max"}
AS_UNCERTAIN |= dict.fromkeys(("contact_ratio", "contact_ratio_extent"), "contact_length")
UNITS = {"pitch": "m", "seconds": "s", "expected_seconds": "s"}  # of what a level took
UNITS |= {"peak_memory": "byte", "expected_memory": "byte"}


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """Figures of every model at every friction coefficient."""
    figures, series, statements = [], [], []
    for name in solved.runs:
        for case in solved.cases:
            figures += _of(case, case.runs[name])
        levels = (level for case in solved.cases for level in case.runs[name].levels)
        converged = "yes" if all(level.converged for level in levels) else "no"
        statements.append(Statement("converged", converged, name))
        if (why := no_approach(solved.problem, name)) is not None:
            statements.append(Statement("no approach", why, name))
        series += _series(solved, name)
    return Findings(tuple(figures), tuple(series), tuple(statements))


def no_approach(problem: Problem, model: str) -> str | None:
    """Why there is no approach from first touch: a body has no datum; None where both have one."""
    if model == "half_plane":
        return "the displacement of a half-plane is known but for a constant"
    if problem.scene.body.thickness is None:
        return "the body is unbounded: the value would grow with the size of its mesh"
    if not problem.scene.roller.rigid:
        return "the elastic roller is unbounded: its share has no datum"
    return None


def _of(case: Case, run: Solution) -> Iterator[Figure]:
    """The figures of one model."""
    problem, level = case.problem, run.finest
    half_width, peak, stress = problem.hertz.half_width, peak_position(level), level.stress
    figures = judged(run, problem)
    # what is not compared [SI], and the positions [m] of largest values
    values = {
        "contact_ratio": level.contact_length / (2.0 * half_width),
        "contact_ratio_extent": level.contact_length / level.extent,
        "peak_position": peak,
        "load_per_length": level.solution.load,
    }
    if no_approach(problem, run.name) is None:
        values["approach"] = level.solution.approach - problem.first_touch
    places: dict[str, tuple[float, ...]] = {"peak_pressure": (peak,)}
    if stress is not None:
        values["von_mises_max"] = abs(stress.extremes["von_mises"].value)
        for name, key in EXTREMES.items():
            places[name] = (stress.extremes[key].x, stress.extremes[key].z)
    for name, figure in figures.items():
        hardness = problem.scene.body.hardness
        capped = name == "peak_pressure" and hardness and figure.value >= AT_HARDNESS * hardness
        yield replace(figure, place=places.get(name), notes=("capped",) if capped else ())
    # what no sequence of levels is known of: a load that finite elements find, an approach
    worst = max(figures.values(), key=lambda figure: figure.numerical)
    exact = problem.scene.load.kind != "approach"
    for name, value in values.items():
        scale = QUANTITIES[name].size(value, problem.hertz)
        uncertainty = Uncertainty(figures.get(AS_UNCERTAIN.get(name), worst).uncertainty.parts)
        if name == "peak_position":
            scale = half_width
            uncertainty = Uncertainty({"discretisation": level.grid.pitch / half_width})
        elif name == "load_per_length" and exact:
            uncertainty = Uncertainty()
        stated = scale, uncertainty
        yield Figure(NAME, name, run.name, value, case.at, None, *stated, place=places.get(name))


def _series(solved: Solved, name: str) -> Iterator[Series]:
    """Patches of contact, and what each level took beside what the laws of cost said."""
    run = solved.runs[name]
    level = run.finest
    for (at, finest), case in zip(solved.contacts(name), solved.cases, strict=False):
        length = judged(case.runs[name], case.problem)["contact_length"]
        edges = (length.numerical * length.scale,) * len(finest.patches)
        start, stop = (Column(tuple(ends), "m", edges) for ends in finest.patches.T.tolist())
        yield Series("patches", {"start": start, "stop": stop}, name, at)
    took = [
        {
            "pitch": level.grid.pitch,
            "unknowns": level.unknowns,
            "seconds": sum(level.seconds.values()),
            "expected_seconds": level.expected_seconds,
            "peak_memory": level.peak_memory,
            "expected_memory": level.expected_memory,
        }
        for level in run.levels
    ]
    yield Series("levels", columns_of(took, UNITS), run.name, is_account=True)
    for name, counts, unit in (
        ("seconds", run.seconds, "s"),
        ("iterations", level.solution.iterations, ""),
    ):
        columns = {"stage": Column(tuple(counts)), name: Column(tuple(counts.values()), unit)}
        yield Series(name, columns, run.name, is_account=True)


def peak_position(level: Level) -> float:
    """Position [m] of a level's highest pressure."""
    return float(level.grid.x[level.solution.pressure.argmax()])


def seen(run: Run, room: float) -> tuple[float, float]:
    """Ends [m] of what pictures show: all contact under the friction that decides and, where they
    meet, Hertz's; beside it `room`, a share of half its length."""
    half_width, levels = run.problem.hertz.half_width, run.levels(run.deciding_friction).values()
    first = float(min(level.patches[0, 0] for level in levels))
    last = float(max(level.patches[-1, 1] for level in levels))
    if first < half_width and last > -half_width:
        first, last = min(first, -half_width), max(last, half_width)
    beside = 0.5 * room * (last - first)
    return first - beside, last + beside


def closed(level: Level) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and pressures with the feet of the first and last hat; of a periodic surface from one
    end of the period to the other."""
    grid, pressure = level.grid, level.solution.pressure
    ends = (pressure[:0], pressure[:1]) if grid.periodic else (np.zeros(1), np.zeros(1))
    return grid.hats, np.concatenate([ends[0], pressure, ends[1]])


def draw_pressures(
    axes: "Axes", run: Run, across: tuple[float, float], unit: Scale, nodes: bool = False
) -> None:
    """Every model's pressures and Hertz's over `across` [m], x in `unit`, with the load in words
    and what uncertain inputs do; at the friction coefficient that decides.

    nodes  whether the nodes of the pressures are marked, where they stand apart"""
    hertz, friction = run.problem.hertz, run.deciding_friction
    several = len(run.problem.scene.load.friction) > 1
    sliding = f", μ = {plain(friction)}" if several else ""
    curves = {}
    for name, level in run.levels(friction).items():
        x, pressure = closed(level)
        shown = style.near(x, across, level.grid.pitch)
        curves[name] = x[shown] / unit.factor, pressure[shown] / hertz.peak_pressure
    for names, (x, pressure) in distinct(curves).items():
        axes.plot(
            x,
            pressure,
            label=joint_label(names, sliding if WHOLE in names else ""),
            marker=MARKERS[names[0]] if nodes and len(x) <= MOST_MARKED else None,
            markersize=3.2,
            markerfacecolor="none",
            **style.LINES[names[0]],
        )
    if (spread := run.data(SCATTER)) is not None:
        x, (low, high) = spread.x, spread.band / hertz.peak_pressure
        shown = style.near(x, across, spread.pitch)
        axes.fill_between(x[shown] / unit.factor, low[shown], high[shown], **style.BAND)
    smooth = closed_form(run.problem)
    if smooth is not None:
        ends = np.clip([-0.5 * smooth.contact_length, 0.5 * smooth.contact_length], *across)
        x = np.union1d(np.linspace(*across, 600), ends)
        pressure = smooth.pressure(x) / hertz.peak_pressure
        axes.plot(x / unit.factor, pressure, label=smooth.label, **style.REFERENCE)
    axes.set_ylabel("p/p₀")
    look = {"transform": axes.transAxes, "va": "top", "bbox": style.BEHIND_WORDS}
    axes.text(0.008, 0.97, hertz_text(run.problem), **look)


STUDY = Study(NAME, QUANTITIES, solve)
