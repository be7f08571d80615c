"""One point of a map, solved by both models: what a worker does.

Both models are refined until the model error of the half-plane is well above its numerical
uncertainty, never by the clock, so that a point has the same answer wherever it is computed. The
uncertainty is that of a run's comparison."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from comparisons.common.tasks import Here
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import MODELS
from comparisons.grid.points import SOLVED, Point, failed
from comparisons.judging.rule import judged, values_of
from comparisons.models.level import Level, Solution
from comparisons.models.model import Model, scene_model
from comparisons.models.plan import Plan, make_plan
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from meshes.block import MeshError

TOLERANCES = (0.01, 0.02, 0.05, 0.10)  # that a map shows
SHARE = 1.0 / 3.0  # of an error, or of the first tolerance, that may be numerical
# Levels of a rough surface beyond the scene's own: on three, two points of 64 were found to have
# 2.1 +- 0.4 per cent, which is 1.3 on five.
ROUGH_MORE = 1
MOST_UNKNOWNS = 250_000  # of a level
GROWTH = 2.3  # of unknowns from one level to the next
DECIMALS = 9  # of relative differences: the digits that rounding does not reach
FIGURES = 10  # significant, of the models' own values

Runs = dict[str, Solution]


def solve_point(point: Point) -> dict:
    """What is found at a point of a map: the model error of the half-plane in each quantity, and
    both models' values, in the digits that do not depend on the machine."""
    problem = problem_of(point.scene)
    plan = make_plan(problem, MODELS)
    friction = problem.largest_friction
    for runs in _refined(problem, plan, friction):
        for run in runs.values():
            if not run.finest.converged:
                return failed(f"{run.name}: the contact did not converge")
        both = runs["half_plane"], problem.under(friction), runs["finite_element"]
        errors = judged(*both)
        if not is_open(errors[point.asked]):
            break
    values = {name: values_of(run.finest, problem) for name, run in runs.items()}
    finest, quantities = runs["finite_element"].finest, {}
    for name, error in errors.items():
        unsure, of_models = error.numerical, {m: _significant(values[m][name]) for m in MODELS}
        quantities[name] = of_models | {
            "difference": round(error.value, DECIMALS),
            "uncertainty": round(unsure, DECIMALS) if np.isfinite(unsure) else None,  # not known
        }
    return {
        "status": SOLVED,
        "half_width": _significant(problem.hertz.half_width),
        "hertz_peak_pressure": _significant(problem.hertz.peak_pressure),
        "friction": _significant(friction),
        "levels": len(runs["finite_element"].levels),
        "unknowns": finest.unknowns,
        "quantities": quantities,
    }


def is_open(error: Figure) -> bool:
    """Whether another level is worth its time: the uncertainty would show in a map."""
    return error.numerical > SHARE * max(abs(error.value), TOLERANCES[0])


def _significant(value: float) -> float:
    return float(f"{value:.{FIGURES}g}")


def _refined(problem: Problem, plan: Plan, friction: float) -> Iterator[Runs]:
    """Both models on the first levels, then with one more each time, while there may be."""
    half_plane: list[Level] = []
    finite_element: list[Level] = []
    plane, elements = (scene_model(name, problem) for name in MODELS)
    least = len(problem.pitches) + (ROUGH_MORE if problem.scene.profile is not None else 0)
    here = Here()

    def solved(model: Model, number: int) -> Level:
        return model.solve(here, problem, number)[friction]

    check = solved(replace(elements, half_block=True), 1) if plan.domain_check else None
    for number in range(1, problem.most_levels + 1):
        try:
            finite_element.append(solved(elements, number))
        except MeshError:
            if number <= least:
                raise
            break  # what is finer than the scene asks for need not be possible
        half_plane.append(solved(plane, number))
        if number >= least:
            yield {
                "half_plane": Solution("half_plane", tuple(half_plane)),
                "finite_element": Solution("finite_element", tuple(finite_element), check),
            }
            if GROWTH * finite_element[-1].unknowns > MOST_UNKNOWNS:
                break
