"""Does a body that flows shake down under a roller that comes again and again, and what surface
does it leave?

In: a scene with [cycles]. Out: plastic strain, work and residual stress pass by pass, whether they
settle, Melan's limit beside it, and the surfaces that are left."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from analytic.exact.shakedown import shakedown_limit
from comparisons.common.numbers import percent, percent_as_written, significant, with_unit
from comparisons.common.tasks import NEEDED, Tasks
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Column, Figure, Findings, Series, Statement
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import Uncertainty
from comparisons.studies.study import Solved
from comparisons.studies.subsurface.cycles.endless import peak_over_shear, yield_in_shear
from comparisons.studies.subsurface.cycles.level import (
    cycled_problem,
    expected_seconds,
    is_endless,
    solved_level,
    travel_of,
)
from comparisons.studies.subsurface.cycles.passes import CycledLevel
from comparisons.studies.subsurface.cycles.surfaces import (
    FLATTENED,
    LeftSurfaces,
    left_surfaces,
)

NAME = "cycles"
SOURCE = "finite_element"
QUANTITIES = {
    "flow_first": Quantity("plastic strain that the first pass adds"),
    "flow_last": Quantity("plastic strain that the last pass adds"),
    "net_last": Quantity("change of plastic strain by the last pass"),
    "passes_to_shakedown": Quantity("passes to shakedown"),
    "residual_stress": Quantity("largest residual compression σx", "Pa"),
    "plastic_work_first": Quantity("plastic work of the first pass", "J/m"),
    "plastic_work_last": Quantity("plastic work of the last pass", "J/m"),
    "loss_first": Quantity("loss of the first pass over its length", "J/m^2"),
    "loss_last": Quantity("loss of the last pass over its length", "J/m^2"),
    "energy_balance": Quantity("work that is not accounted for, over the plastic work"),
    "peak_last": Quantity("peak pressure in the last pass", "Pa"),
    "length_last": Quantity("contact length in the last pass", "m"),
    "peak_over_shear": Quantity("Hertz's peak pressure over k = Y/√3"),
    "shakedown_limit": Quantity("the same, at Melan's limit"),
    "carried": Quantity("the same, carried by the residual stresses left"),
    "peak_reloaded": Quantity("peak pressure of the half-plane", "Pa"),
    "length_reloaded": Quantity("contact length of the half-plane", "m"),
    "ra": Quantity("Ra of the stretch pressed", "m"),
    "shape_rms": Quantity("shape pressed once against run in, rms", "m"),
    "bearing_rms": Quantity("their bearing curves, rms", "m"),
    "lowered_rms": Quantity("what one pass changes of the shape, rms", "m"),
}
LONGEST = 600.0  # seconds that rolling over a trace may take
STEADY = 0.95  # of the plastic strain of a quarter of the passes before: it falls no more
ONE_WAY = 0.1  # of a pass's plastic strain, to and fro: what stays of it goes on one way
VERDICT = "shakedown"
Outcome = Literal["elastic", "shakes down", "settling", "cycles", "ratchets"]


@dataclass(frozen=True)
class CycleStudy:
    """For pictures and files: the levels, coarse to fine, and of the finest what is left."""

    levels: tuple[CycledLevel, ...]
    left: LeftSurfaces | None  # None of an endless body, which stays smooth


def needs(solved: Solved) -> str | None:
    if SOURCE not in solved.plan.models:
        return "takes the finite elements"
    problem = solved.problem
    if travel_of(problem):
        seconds = expected_seconds(problem)
        if seconds > LONGEST:
            most = with_unit(LONGEST, "s", 2)
            return (
                f"rolling over this trace would take about {with_unit(seconds, 's', 2)}, more than "
                f"{most}: take fewer cycles.passes, a shorter cycles.travel or cycles.levels = 1"
            )
    return None


def planned(solved: Solved) -> str:
    cycles = solved.problem.scene.cycles
    seconds = with_unit(expected_seconds(solved.problem), "s", 2)
    return f"take about {seconds} more, {cycles.passes} passes on {cycles.levels} levels"


def begin(solved: Solved, tasks: Tasks) -> None:
    """Make the levels known, before anything is solved."""
    if solved.runs:
        return
    problem = solved.problem
    numbers = range(1, problem.scene.cycles.levels + 1)
    seconds = expected_seconds(problem)
    for number in numbers:
        share = 4.0**number / sum(4.0**earlier for earlier in numbers)
        tasks.add(
            _key(number), solved_level, problem, number, seconds=share * seconds, urgency=NEEDED
        )


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    problem, cycles = solved.problem, solved.problem.scene.cycles
    levels = tuple(tasks.result(_key(number)) for number in range(1, cycles.levels + 1))
    left: list[LeftSurfaces] = []
    if not is_endless(problem):
        posed, travel = cycled_problem(problem), travel_of(problem)
        left = [left_surfaces(posed, level, travel) for level in levels]
    at = {"friction": max(problem.scene.load.friction)}
    figures = [*_of_passes(solved, levels, at), *_of_limits(solved, levels, at)]
    figures += _of_surfaces(left, at)
    said = Statement(VERDICT, verdict(solved, levels[-1]), SOURCE, at)
    series, data = _series(solved, levels, at), CycleStudy(levels, left[-1] if left else None)
    return Findings(tuple(figures), (series,), (said,), data)


def _key(number: int) -> str:
    return f"cycles-{number}"


def outcome(level: CycledLevel, share: float) -> tuple[Outcome, int]:
    """What becomes of the body, and of what settles the pass in which it does, else the last."""
    flow, net = level.passes.flow, level.passes.net
    count = len(flow)
    if not flow[0]:
        return "elastic", 0
    settled = np.flatnonzero(flow <= share * flow[0])
    if len(settled):
        return "shakes down", int(settled[0]) + 1
    earlier = count - 1 - max(1, count // 4)
    if earlier < 1 or flow[-1] < STEADY * flow[earlier]:
        return "settling", count
    return ("ratchets" if net[-1] > ONE_WAY * flow[-1] else "cycles"), count


def verdict(solved: Solved, level: CycledLevel) -> str:
    """In a sentence, with what to do next."""
    problem, cycles = solved.problem, solved.problem.scene.cycles
    what, count = outcome(level, cycles.share)
    adds = f"each pass adds a plastic strain of {significant(level.passes.flow[-1], 2)}"
    limit = ""
    if is_endless(problem):
        over, most = peak_over_shear(problem), shakedown_limit(max(problem.scene.load.friction))[0]
        allowed = with_unit(most * yield_in_shear(problem), "Pa", 3)
        limit = f"; p0 = {over:.3g} k with k = Y/√3, Melan's limit {most:.3g} k, {allowed}"
    if what == "elastic":
        return f"nothing flows, not even in the first pass{limit}"
    if what == "shakes down":
        share = percent_as_written(cycles.share)
        return (
            f"shakes down: from pass {count} on a pass adds less than {share} of the first one's "
            f"plastic strain{limit}"
        )
    if what == "settling":
        return (
            f"is still settling after {count} pass{'es' * (count > 1)}: the last one adds "
            f"{percent(level.passes.flow[-1] / level.passes.flow[0])} of the first one's "
            f"plastic strain{limit}; next: cycles.passes = {4 * count}"
        )
    way = "further each time" if what == "ratchets" else "to and fro in a closed cycle"
    return f"does not shake down in {count} passes: {adds}, {way}{limit}; next: less load"


def _figure(
    quantity: str,
    values: list[float],
    at: Mapping[str, float],
    source: str = SOURCE,
    place: tuple[float, ...] | None = None,
    increments: float = 0.0,
) -> Figure:
    """Of values by level, and what increments leave of the last; of one level alone the
    uncertainty is not known."""
    scale, stated = abs(values[-1]) or 1.0, None
    if len(values) > 1:
        refined = grid_convergence(values, 1.0)
        parts = {"discretisation": refined.uncertainty, "increments": increments}
        stated = Uncertainty({name: part / scale for name, part in parts.items() if part}, refined)
    return Figure(
        study=NAME,
        quantity=quantity,
        source=source,
        value=float(values[-1]),
        at=at,
        scale=scale,
        uncertainty=stated,
        place=place,
        levels=tuple(map(float, values)),
    )


def _of_passes(
    solved: Solved, levels: tuple[CycledLevel, ...], at: Mapping[str, float]
) -> Iterator[Figure]:
    work = "loss" if is_endless(solved.problem) else "plastic_work"
    finest = levels[-1].passes
    off = np.abs(finest.plastic_work - finest.flowed)
    off = {f"{work}_first": off[0], f"{work}_last": off[-1]}
    read = {
        "flow_first": lambda passes: passes.flow[0],
        "flow_last": lambda passes: passes.flow[-1],
        "net_last": lambda passes: passes.net[-1],
        "residual_stress": lambda passes: -passes.residual[-1],
        f"{work}_first": lambda passes: passes.plastic_work[0],
        f"{work}_last": lambda passes: passes.plastic_work[-1],
        "peak_last": lambda passes: passes.peak[-1],
        "length_last": lambda passes: passes.length[-1],
        "energy_balance": lambda passes: np.abs(passes.balance).max(),
    }
    for name, value in read.items():
        place = (float(finest.residual_depth[-1]),) if name == "residual_stress" else None
        values = [value(level.passes) for level in levels]
        yield _figure(name, values, at, place=place, increments=off.get(name, 0.0))
    share = solved.problem.scene.cycles.share
    reached = [outcome(level, share) for level in levels]
    counts = [float(count) for what, count in reached if what == "shakes down"]
    if reached[-1][0] == "shakes down":
        yield _figure("passes_to_shakedown", counts, at)


def _of_limits(
    solved: Solved, levels: tuple[CycledLevel, ...], at: Mapping[str, float]
) -> Iterator[Figure]:
    problem = solved.problem
    if not is_endless(problem):
        return
    known = {"peak_over_shear": peak_over_shear(problem)}
    known["shakedown_limit"] = shakedown_limit(at["friction"])[0]
    for name, value in known.items():
        yield Figure(NAME, name, "scene", value, at, scale=value, uncertainty=Uncertainty())
    yield _figure("carried", [level.carried for level in levels], at)


def _of_surfaces(left: list[LeftSurfaces], at: Mapping[str, float]) -> Iterator[Figure]:
    """By level, of those surfaces that all levels have."""
    names = [name for name in (left[-1].by_name if left else ()) if name in left[0].by_name]
    for name in names:
        surfaces = [one.by_name[name] for one in left]
        yield _figure("peak_reloaded", [one.peak for one in surfaces], at, name)
        yield _figure("length_reloaded", [one.length for one in surfaces], at, name)
        yield _figure("ra", [one.ra for one in surfaces], at, name)
    if names:
        yield _figure("lowered_rms", [one.lowered_rms for one in left], at)
    if FLATTENED in names:
        yield _figure("shape_rms", [one.rms for one in left], at)
        yield _figure("bearing_rms", [one.bearing_rms for one in left], at)


def _series(solved: Solved, levels: tuple[CycledLevel, ...], at: Mapping[str, float]) -> Series:
    """The passes on the finest level, as uncertain as they differ from the coarser one."""
    finest = levels[-1].passes
    work = "J/m^2" if is_endless(solved.problem) else "J/m"
    units = {"flow": "", "net": "", "plastic_work": work, "residual": "Pa", "residual_depth": "m"}
    units |= {"peak": "Pa", "length": "m"}
    columns = {"pass": Column(tuple(range(1, len(finest.flow) + 1)))}
    for name, unit in units.items():
        values = getattr(finest, name)
        moved = values if len(levels) < 2 else values - getattr(levels[-2].passes, name)
        unsure = tuple(float(size) for size in 3.0 * np.abs(moved))
        columns[name] = Column(tuple(map(float, values)), unit, unsure)
    return Series("passes", columns, SOURCE, at)
