"""What the levels of a run will take, by the laws of cost, before anything is meshed or solved."""

from dataclasses import dataclass, replace

import numpy as np

from analytic.surface.roughness import shortest_wavelength
from comparisons.common.numbers import significant, with_unit
from comparisons.models.half_plane import expected_of
from comparisons.models.level import ExpectedCost
from comparisons.models.plan import Plan
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
        text = f"planned: {count}{few} ({_cost(begin)})"
        if len(self.levels) > len(begin):
            text += f", up to {len(self.levels)} where a figure needs them ({_cost(self.levels)})"
        if self.per_wave is not None:
            text += f" with {significant(self.per_wave, 2)} pressure elements to the shortest wave"
        return f"{text}; {self.ends}"


def forecast(problem: Problem, plan: Plan) -> Forecast:
    """Of a plan's levels, without its effects and far-boundary check; as if contact were all over
    the stretch of pressures, which it never exceeds."""
    scene, levels, total, ends = problem.scene, [], 0.0, ""
    for number in range(problem.most_levels):
        pitch = problem.pitches[0] / 2.0**number
        elements = problem.grid(pitch).count
        everywhere = np.array([problem.extent])
        costs = [expected_level(name, problem, plan, pitch, everywhere) for name in plan.models]
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
    asked = len(problem.pitches)
    return Forecast(tuple(levels), asked, per_wave, ends or f"{len(levels)} levels are the most")


def expected_level(
    model: str, problem: Problem, plan: Plan, pitch: float, patches: np.ndarray
) -> ExpectedCost:
    """Of a model on pressure elements of a pitch [m], in contact on `patches` (k, 2) [m]."""
    contacts = len(problem.scene.load.friction) if problem.friction_moves(model) else 1
    if model == "half_plane":
        cost = expected_of(problem.grid(pitch).count)
    else:
        from comparisons.models.finite_element.cost import expected
        from comparisons.models.finite_element.mesh import Refinement

        cost = expected(problem, plan, Refinement(pitch), patches)
    return replace(cost, seconds=contacts * cost.seconds)


def _cost(levels: tuple[PlannedLevel, ...]) -> str:
    """Unknowns of the last one, seconds of all, largest memory."""
    seconds = sum(level.seconds for level in levels)
    memory = max(level.memory for level in levels)
    unknowns = significant(float(levels[-1].unknowns), 2)
    return f"{unknowns} unknowns, {with_unit(seconds, 's', 2)}, {with_unit(memory, 'byte', 2)}"
