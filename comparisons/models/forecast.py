"""What the levels of a run will take, by the laws of cost, before anything is meshed or solved."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from analytic.surface.roughness import shortest_wavelength
from comparisons.common.numbers import significant, with_unit
from comparisons.figures.quantity import MODELS
from comparisons.models.level import Solution, flowing_contact
from comparisons.models.model import scene_model
from comparisons.models.plan import LONGER, Plan
from comparisons.models.problem import Problem


@dataclass(frozen=True)
class PlannedLevel:
    """One level of all models of a plan: `elements` of pressure of a `pitch` [m], displacements'
    `unknowns`, seconds, and bytes at the peak."""

    pitch: float
    elements: int
    unknowns: int
    seconds: float
    memory: float


@dataclass(frozen=True)
class Forecast:
    """The levels that a scene's budget allows if nothing ends refinement earlier; at least one."""

    levels: tuple[PlannedLevel, ...]
    asked: int  # levels to begin with
    # pressure elements to the shortest wave on the last of them; None for smooth bodies
    per_wave: float | None
    ends: str  # why there are no more

    @property
    def text(self) -> str:
        """In one line."""
        begin = self.levels[: self.asked]
        count = "1 level" if len(begin) == 1 else f"{len(begin)} levels"
        few = f" of {self.asked} asked for" if len(begin) < self.asked else ""
        text = f"{count}{few} ({_size(begin)})"
        if len(self.levels) > len(begin):
            text += f", up to {len(self.levels)} where a figure needs them ({_size(self.levels)})"
        if self.per_wave is not None:
            text += f" with {significant(self.per_wave, 2)} pressure elements to the shortest wave"
        return f"{text}; {self.ends}"


def forecast(problem: Problem, plan: Plan) -> Forecast:
    """Of a plan's levels, without its effects and checks. Finite elements that flow are expected in
    the contact of the nearest analytic operator, as far as flow may spread it, others as if contact
    were all over the stretch of pressures, which it never exceeds."""
    scene, levels, total, ends = problem.scene, [], 0.0, ""
    plastic = scene.finite_element.plastic
    patches = flowing_contact(problem) if plastic else None
    for number in range(1, problem.most_levels + 1):
        pitch = problem.pitch_of(number)
        elements = problem.grid(pitch).count
        models = (scene_model(name, problem) for name in plan.models)
        costs = [model.cost(problem, number, patches) for model in models]
        seconds, memory = sum(cost.seconds for cost in costs), max(cost.memory for cost in costs)
        total += seconds
        if levels and total > problem.time:
            ends = f"the budget of {with_unit(scene.budget.time, 's', 3)} ends it (budget.time)"
            break
        if levels and memory > scene.budget.memory:
            memory = with_unit(scene.budget.memory, "byte", 3)
            ends = f"the budget of {memory} ends it (budget.memory)"
            break
        unknowns = max(cost.unknowns for cost in costs)
        levels.append(PlannedLevel(pitch, elements, unknowns, seconds, memory))
    wave = None if scene.profile is None else shortest_wavelength(problem.surface.profile)
    per_wave = None if wave is None or np.isinf(wave) else float(wave / levels[-1].pitch)
    return Forecast(
        levels=tuple(levels),
        asked=len(problem.pitches),
        per_wave=per_wave,
        ends=ends or f"{len(levels)} levels are the most",
    )


def with_one_more(problem: Problem, runs: Mapping[str, Solution]) -> tuple[float, float]:
    """Seconds of all levels that the models have and of one more of each, and memory [bytes] of the
    largest of these."""
    time = sum(level.expected_seconds for run in runs.values() for level in run.levels)
    memory = 0.0
    for name, run in runs.items():
        finer = scene_model(name, problem).cost(problem, len(run.levels) + 1, run.finest.patches)
        time, memory = time + finer.seconds, max(memory, finer.memory)
    return time, memory


def flow_seconds(problem: Problem, patches: np.ndarray) -> float:
    """Of flow on the first two levels, at small strains with the check of its increments, for every
    friction coefficient, by the laws of cost."""
    switches = {"finite_element.plastic": True, "finite_element.deformation": "linear"}
    flowing = problem.under(problem.largest_friction)
    flowing = replace(flowing, scene=flowing.scene.unchecked(switches))
    model = scene_model("finite_element", flowing)
    levels = (model, 1), (model, 2), *((replace(model, times=times), 1) for times in LONGER)
    seconds = sum(one.cost(flowing, number, patches).seconds for one, number in levels)
    return len(problem.scene.load.friction) * seconds


def time_with_flow(problem: Problem, patches: np.ndarray) -> float:
    """Of the levels asked for of both models, and of flow [s], in contact on `patches` (k, 2)
    [m]."""
    seconds_of_parts = (
        scene_model(name, problem).cost(problem, number, patches).seconds
        for name in MODELS
        for number in range(1, len(problem.pitches) + 1)
    )
    return sum(seconds_of_parts) + flow_seconds(problem, patches)


def _size(levels: tuple[PlannedLevel, ...]) -> str:
    """Unknowns of the last one, largest memory."""
    memory = max(level.memory for level in levels)
    unknowns = significant(float(levels[-1].unknowns), 2)
    return f"{unknowns} unknowns, {with_unit(memory, 'byte', 2)}"
