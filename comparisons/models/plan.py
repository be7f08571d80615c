"""The steps that a scene needs, and what its levels will take by the laws of cost: decided before
anything is meshed or solved, printed and recorded.

A skipped step never changes a figure that is asked for."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from analytic.surface.roughness import shortest_wavelength
from comparisons.common.numbers import significant, with_unit
from comparisons.figures.quantity import MODELS
from comparisons.models.assumptions import assumptions_of
from comparisons.models.level import Solution, flowing_contact
from comparisons.models.model import scene_model
from comparisons.models.problem import Problem
from comparisons.scenes.scene import sections_of

LONGER = (4, 2)  # times as long increments of plastic flow, of their check


@dataclass(frozen=True)
class Plan:
    """Steps of a run."""

    models: tuple[str, ...]  # of MODELS
    coupling: bool  # solve the half-plane with and without normal-tangential coupling
    effects: bool  # compute effects beside the scene's own where their estimates ask for it
    domain_check: bool  # repeat the coarsest finite-element level on a block of half the size
    increments_check: bool  # repeat that level with longer increments of plastic flow
    assumptions: tuple[str, ...]  # of the models of this run
    skipped: dict[str, str]  # by step that the run skips, the reason

    @property
    def compares(self) -> bool:
        return set(self.models) == set(MODELS)


def make_plan(problem: Problem, models: tuple[str, ...]) -> Plan:
    """The plan that computes what the scene asks for and nothing else."""
    scene, settings = problem.scene, problem.scene.finite_element
    half_plane, finite_elements = (name in models for name in MODELS)
    uncoupled = [no_coupling(problem, friction) for friction in scene.load.friction]
    # a disc is held by what the scene says
    endless = not scene.roller.rigid and settings.roller_body == "half-plane"
    unbounded = scene.body.thickness is None or scene.body.width is None or endless
    compares = half_plane and finite_elements
    coupling = half_plane and not all(uncoupled)
    effects = compares and bool(scene.budget.effects) and bool(scene.tolerances)
    no_traction = scene.stress is not None and not any(scene.load.friction)
    no_statistics = scene.statistics is not None and not half_plane
    steps = [
        *((name not in models, f"{name} model", "not asked for") for name in MODELS),
        (scene.profile is None, "refinement under asperities", "the surface is smooth"),
        *(
            (getattr(scene, name) is None, section.STEP, f"the scene has no [{name}]")
            for name, section in sections_of(type(scene)).items()
            if section.STEP is not None
        ),
        (no_traction, "stresses of the sliding traction", "there is no friction"),
        (no_statistics, "statistics of rough contact", "they need the half-plane"),
        (scene.body.hardness is None, "hardness", "the body has no hardness"),
    ]
    if half_plane:
        steps.append((not coupling, "coupling", uncoupled[-1]))
    if finite_elements:
        shared = "it is the body's block with another modulus, or the same"
        unasked = "not asked for (budget.effects)" if scene.tolerances else "no quantity is judged"
        steps += [
            (scene.roller.rigid, "mesh of the roller", "it is rigid"),
            (problem.shares_factor, "factorisation of the roller's block", shared),
            (not effects, "effects beside the scene's own finite elements", unasked),
            (not unbounded, "check of the far boundary", "the body's boundaries are its own"),
            (not settings.plastic, "check of the increments of flow", "no body flows"),
        ]
    steps.append((not compares, "comparison", "it needs both models"))
    return Plan(
        models,
        coupling,
        effects,
        domain_check=finite_elements and unbounded,
        increments_check=finite_elements and settings.plastic,
        assumptions=assumptions_of(problem),
        skipped={step: because for needless, step, because in steps if needless},
    )


def no_coupling(problem: Problem, friction: float) -> str | None:
    """Why there is no normal-tangential coupling, or None if there is."""
    if friction == 0.0:
        return "there is no friction"
    if problem.dundurs_beta == 0.0:
        return "the bodies have equal constants: Dundurs' beta is 0"
    if problem.scene.periodic:
        return "the operator of a periodic surface has none"
    return None


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
        """Forecast in one line."""
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
    """Forecast of a plan's levels, without effects and checks. Elements that flow are expected in
    the contact of the nearest analytic operator, as far as flow may spread it, others as if
    contact were all over the stretch of pressures, which it never exceeds."""
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
    """Seconds for flow on the first two levels, at small strains with the check of its increments,
    for every friction coefficient, by the laws of cost."""
    switches = {"finite_element.plastic": True, "finite_element.deformation": "linear"}
    flowing = problem.under(problem.largest_friction)
    flowing = replace(flowing, scene=flowing.scene.unchecked(switches))
    model = scene_model("finite_element", flowing)
    levels = (model, 1), (model, 2), *((replace(model, times=times), 1) for times in LONGER)
    seconds = sum(one.cost(flowing, number, patches).seconds for one, number in levels)
    return len(problem.scene.load.friction) * seconds


def time_with_flow(problem: Problem, patches: np.ndarray) -> float:
    """Seconds for all levels of both models, and for flow, in contact on `patches` (k, 2) [m]."""
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
