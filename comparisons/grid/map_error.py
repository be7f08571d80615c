"""The model error of the half-plane at the points of a map, and what the points say together.

A point takes the levels that a run would take until the quantity that is shown is known to a third
of the first tolerance: by the laws of cost, never by the clock, so that it has the same result
wherever it is computed. The points of a map's content lie row by row, y outside, x inside."""

import numpy as np

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import is_within
from comparisons.figures.quantity import MODELS
from comparisons.grid.points import SOLVED, Point, failed
from comparisons.judging.rule import judged, values_of
from comparisons.judging.study import unsolved
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.runs.refinement import refined
from comparisons.scenes.sections import BudgetSection

TOLERANCES = (0.01, 0.02, 0.05, 0.10)  # that a map shows
# Levels of a rough surface beyond the scene's own: on three, two points of 64 were found to have
# 2.1 +- 0.4 per cent, which is 1.3 on five.
ROUGH_MORE = 1
DECIMALS = 9  # of relative differences: the digits that rounding does not reach
FIGURES = 10  # significant, of the models' own values
# What is known of the model error of the half-plane at a point.
SIGNIFICANT, BELOW, INCONCLUSIVE = "significant", "below tolerance", "inconclusive"


def solve_point(point: Point) -> dict:
    """Results at a point of a map: the model error of the half-plane in each quantity under
    the largest friction, and both models' values, in the digits that do not depend on the
    machine."""
    scene = point.scene
    changes: dict[str, object] = {f"tolerance.{name}": None for name in scene.tolerances}
    changes |= {f"tolerance.{point.asked}": TOLERANCES[0], "budget": BudgetSection()}
    changes["resolution.levels"] = scene.resolution.levels + ROUGH_MORE * bool(scene.profile)
    changes["load.friction"] = (max(scene.load.friction),)
    problem = problem_of(scene.unchecked(changes))
    [case] = refined(unsolved(problem, make_plan(problem, MODELS)), Tasks()).cases
    for run in case.runs.values():
        if not run.finest.converged:
            return failed(f"{run.name}: the contact did not converge")
    values = {name: values_of(run.finest, problem) for name, run in case.runs.items()}
    half_plane, finite_elements = (case.runs[name] for name in MODELS)
    quantities = {}
    for name, error in judged(half_plane, case.problem, finite_elements).items():
        unsure, of_models = error.numerical, {m: _significant(values[m][name]) for m in MODELS}
        quantities[name] = of_models | {
            "difference": round(error.value, DECIMALS),
            "uncertainty": round(unsure, DECIMALS) if np.isfinite(unsure) else None,  # not known
        }
    return {
        "status": SOLVED,
        "half_width": _significant(problem.hertz.half_width),
        "hertz_peak_pressure": _significant(problem.hertz.peak_pressure),
        "friction": _significant(case.friction),
        "levels": len(finite_elements.levels),
        "unknowns": finite_elements.finest.unknowns,
        "quantities": quantities,
    }


def _significant(value: float) -> float:
    return float(f"{value:.{FIGURES}g}")


def significance(answer: dict, quantity: str) -> dict:
    """How the model error at a solved point compares with its numerical uncertainty: significant,
    it is larger; below tolerance, both together are within the first one; else inconclusive."""
    if answer["status"] != SOLVED:
        return {}
    error = answer["quantities"].get(quantity)
    if error is None or error["uncertainty"] is None:
        return {"error": INCONCLUSIVE}
    if abs(error["difference"]) > error["uncertainty"]:
        return {"error": SIGNIFICANT}
    least = TOLERANCES[0]
    agrees = is_within(error["difference"], error["uncertainty"], -least, least)
    return {"error": BELOW if agrees else INCONCLUSIVE}


def of_points(content: dict, name: str) -> np.ndarray:
    """(ny, nx) the relative `difference` with its sign, or the `uncertainty`, of the quantity that
    is shown, nan where it is unknown."""
    shown = content["quantity"]
    entries = (point.get("quantities", {}).get(shown) or {} for point in content["points"])
    values = np.array([entry.get(name) for entry in entries], dtype=float)
    return values.reshape(len(content["y"]["values"]), len(content["x"]["values"]))


def points_within(content: dict, tolerance: float) -> int:
    """How many points have a model error that is within a tolerance with all its uncertainty."""
    largest = np.abs(of_points(content, "difference")) + of_points(content, "uncertainty")
    return int(np.count_nonzero(largest <= tolerance))
