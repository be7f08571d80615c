"""What the levels of a run will take, by the laws of cost, before anything is meshed or solved."""

from dataclasses import dataclass, replace

import numpy as np

from analytic.surface.roughness import shortest_wavelength
from comparisons.common.numbers import significant, with_unit
from comparisons.figures.quantity import MODELS
from comparisons.models.half_plane import expected_with
from comparisons.models.level import ExpectedCost, flowing_contact
from comparisons.models.plan import LONGER, Plan, make_plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window, window_of


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
    # [s] of flow beside finite elements that have none, where it may be found; None: it cannot
    flow: float | None = None
    leaves_out_flow: bool = False  # the budget is too small for it
    # [s] of the same at finite strain, where small ones are not enough; None: it cannot be found
    finite_flow: float | None = None

    @property
    def seconds_asked(self) -> float:
        """Of the levels to begin with and of flow, one after the other."""
        return sum(level.seconds for level in self.levels[: self.asked]) + self.seconds_of_flow

    @property
    def seconds_of_flow(self) -> float:
        """Beside finite elements that have none."""
        return 0.0 if self.leaves_out_flow else (self.flow or 0.0) + (self.finite_flow or 0.0)

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
        if self.flow is not None:
            more = "would take" if self.leaves_out_flow else "takes"
            text += f"; flow, where it is beyond doubt, {more} {with_unit(self.flow, 's', 2)} more"
            text += " and is left out (budget.time)" * self.leaves_out_flow
        if self.finite_flow is not None and not self.leaves_out_flow:
            text += f"; at finite strain, where that matters, {with_unit(self.finite_flow, 's', 2)}"
            text += " more"
        return f"{text}; {self.ends}"


def forecast(problem: Problem, plan: Plan) -> Forecast:
    """Of a plan's levels, without its effects and checks. Finite elements that flow are expected in
    the contact of the nearest analytic operator, as far as flow may spread it, others as if contact
    were all over the stretch of pressures, which it never exceeds."""
    scene, levels, total, ends = problem.scene, [], 0.0, ""
    window = window_of(problem) if plan.stress else None
    may_flow = scene.finite_element.plastic or problem.flows
    flowing = flowing_contact(problem) if may_flow else None
    patches = flowing if scene.finite_element.plastic else np.array([problem.extent])
    for number in range(problem.most_levels):
        pitch = problem.pitches[0] / 2.0**number
        elements = problem.grid(pitch).count
        how = plan, pitch, patches, window
        costs = [expected_level(name, problem, *how) for name in plan.models]
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
    asked, settings, flow, finite_flow = len(problem.pitches), scene.finite_element, None, None
    if problem.flows and plan.effects and not settings.plastic:
        flow = flow_seconds(problem, flowing)
    if plan.effects and (flow or (settings.plastic and settings.deformation == "linear")):
        finite_flow = flow_seconds(problem, flowing, "finite")
    return Forecast(
        levels=tuple(levels),
        asked=asked,
        per_wave=per_wave,
        ends=ends or f"{len(levels)} levels are the most",
        flow=flow,
        finite_flow=finite_flow,
        leaves_out_flow=flow is not None and time_with_flow(problem, plan, flowing) > problem.time,
    )


def expected_level(
    model: str,
    problem: Problem,
    plan: Plan,
    pitch: float,
    patches: np.ndarray,
    window: Window | None = None,
) -> ExpectedCost:
    """Of a model on pressure elements of a pitch [m], in contact on `patches` (k, 2) [m]; of the
    half-plane with the stresses on a window."""
    contacts = len(problem.scene.load.friction) if problem.friction_moves(model) else 1
    if model == "half_plane":
        cost = expected_with(problem, pitch, window)
    else:
        from comparisons.models.finite_element.cost import expected
        from comparisons.models.finite_element.mesh import Refinement

        cost = expected(problem, plan, Refinement(pitch), patches)
    return replace(cost, seconds=contacts * cost.seconds)


def flow_seconds(problem: Problem, patches: np.ndarray, deformation: str = "linear") -> float:
    """Of flow on the first two levels, at small strains with the check of its increments, for every
    friction coefficient, by the laws of cost."""
    from comparisons.models.finite_element.cost import expected
    from comparisons.models.finite_element.mesh import Refinement
    from fem.nonlinear.press_plastic import TRAVEL

    switches = {"finite_element.plastic": True, "finite_element.deformation": deformation}
    flowing = replace(problem, scene=problem.scene.unchecked(switches))
    plan, coarsest = make_plan(flowing, MODELS), problem.pitches[0]
    refinements = [Refinement(coarsest), Refinement(0.5 * coarsest)]
    if deformation == "linear":
        refinements += [Refinement(coarsest, travel=times * TRAVEL) for times in LONGER]
    seconds = sum(expected(flowing, plan, one, patches).seconds for one in refinements)
    return len(problem.scene.load.friction) * seconds


def time_with_flow(problem: Problem, plan: Plan, patches: np.ndarray) -> float:
    """Of the levels asked for, and of flow [s], in contact on `patches` (k, 2) [m]."""
    seconds_of_parts = (
        expected_level(name, problem, plan, pitch, patches).seconds
        for name in plan.models
        for pitch in problem.pitches
    )
    return sum(seconds_of_parts) + flow_seconds(problem, patches)


def _cost(levels: tuple[PlannedLevel, ...]) -> str:
    """Unknowns of the last one, seconds of all, largest memory."""
    seconds = sum(level.seconds for level in levels)
    memory = max(level.memory for level in levels)
    unknowns = significant(float(levels[-1].unknowns), 2)
    return f"{unknowns} unknowns, {with_unit(seconds, 's', 2)}, {with_unit(memory, 'byte', 2)}"
