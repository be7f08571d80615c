"""One point of a map, solved by both models: what a worker does.

Both models are refined until the model error of the half-plane is well above its numerical
uncertainty, never by the clock, so that a point has the same answer wherever it is computed.

The uncertainty is that of a run's comparison. For temperatures both models have the half-plane's
pressures: the error is the half-space's for heat alone, and the roller a disc where the finite
elements have its circle.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from time import perf_counter

import numpy as np

from comparisons.campaigns.maps.request import PointRequest
from comparisons.campaigns.points import SOLVED, failed
from comparisons.common.progress import Stages
from comparisons.figures.quantity import HEAT_QUANTITIES, MODELS
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import Plan, make_plan
from comparisons.models.problem import Problem, problem_of
from comparisons.models.window import Window, window_of
from comparisons.studies.comparison import differences_of
from comparisons.studies.contact import values_of
from fem.solver.communicator import each_alone
from meshes.block import MeshError

NOT_CONVERGED = "the contact did not converge"
TOLERANCES = (0.01, 0.02, 0.05, 0.10)  # that a map shows
SHARE = 1.0 / 3.0  # of an error, or of the first tolerance, that may be numerical
# Levels of a rough surface beyond the scene's own: on three, two points of 64 were found to have
# 2.1 +- 0.4 per cent, which is 1.3 on five.
ROUGH_MORE = 1
MOST_UNKNOWNS = 250_000  # of a level
GROWTH = 2.3  # of unknowns from one level to the next
DECIMALS = 9  # of relative differences: the digits that rounding does not reach
FIGURES = 10  # significant, of the models' own values


@dataclass(frozen=True)
class PointError:
    """The model error of the half-plane in one quantity at a point of a map."""

    # half_plane, finite_element: values on the finest level [SI]; None of a norm of both
    half_plane: float | None
    finite_element: float | None
    difference: float  # of these over the finite elements' value; or the norm
    uncertainty: float | None  # numerical, of the difference; None: unknown

    @property
    def is_open(self) -> bool:
        """Whether another level is worth its time: the uncertainty would show in a map."""
        most = SHARE * max(abs(self.difference), TOLERANCES[0])
        return self.uncertainty is None or self.uncertainty > most

    def as_dict(self) -> dict[str, float | None]:
        """In the digits that do not depend on the machine."""
        known = self.uncertainty is not None
        return {
            "half_plane": _significant(self.half_plane),
            "finite_element": _significant(self.finite_element),
            "difference": round(self.difference, DECIMALS),
            "uncertainty": round(self.uncertainty, DECIMALS) if known else None,
        }


def solve_point(point: PointRequest) -> dict:
    """What was `found` at a point, or why nothing was; and the `seconds` that it took. What is
    refused, and what solvers and numbers run into, is an answer; what is wrong with the program or
    the machine is raised."""
    began = perf_counter()
    if point.why is not None:
        found = failed(point.why)
    else:
        try:
            with each_alone():
                found = _solved(point)
        except (ValueError, ArithmeticError, RuntimeError) as error:
            found = failed(str(error) or type(error).__name__)
    return {"found": found, "seconds": perf_counter() - began}


def _solved(point: PointRequest) -> dict:
    scene, problem = point.scene, problem_of(point.scene)
    plan, heats = make_plan(problem, MODELS), point.quantity in HEAT_QUANTITIES
    window = window_of(problem) if plan.stress and not heats else None
    friction = max(scene.load.friction)
    for runs in _refined(problem, plan, window, heats):
        for run in runs:
            if not run.finest.solution.converged:
                return failed(f"{run.name}: {NOT_CONVERGED}")
        given = *runs, problem, friction, window
        errors = heat_errors(*runs, problem) if heats else model_errors(*given)
        if not errors[point.quantity].is_open:
            break
    return {
        "status": SOLVED,
        "half_width": _significant(problem.hertz.half_width),
        "hertz_peak_pressure": _significant(problem.hertz.peak_pressure),
        "friction": _significant(friction),
        "levels": len(runs[1].levels),
        "unknowns": runs[1].finest.unknowns,
        "quantities": {name: error.as_dict() for name, error in errors.items()},
    }


def _refined(
    problem: Problem, plan: Plan, window: Window | None, heats: bool
) -> Iterator[tuple[ModelRun, ModelRun]]:
    """Both models on the first levels, then with one more each time, while there may be; of heat
    both with the half-plane's pressures."""
    from comparisons.models.finite_element.bodies import BodyCache
    from comparisons.models.finite_element.level import LevelOptions, finite_element_level
    from comparisons.models.finite_element.mesh import Refinement
    from comparisons.models.half_plane import half_plane_level

    def solved(pitch: float, half_block: bool = False) -> Level:
        if heats:
            return half_plane_level(problem, pitch, window, Stages())
        refinement, body_cache = Refinement(pitch, half_block), bodies(pitch)
        return finite_element_level(
            problem, plan, refinement, window, Stages(), body_cache, LevelOptions(fields=False)
        )

    @lru_cache(maxsize=1)  # the latest pitch's alone: the far-boundary check is on its mesh
    def bodies(pitch: float) -> BodyCache:
        return BodyCache()

    half_plane: list[Level] = []
    finite_element: list[Level] = []
    pitch = problem.pitches[0]
    least = len(problem.pitches) + (ROUGH_MORE if problem.scene.profile is not None else 0)
    check = solved(pitch, half_block=True) if plan.domain_check else None
    for number in range(1, problem.most_levels + 1):
        try:
            finite_element.append(solved(pitch))
        except MeshError:
            if number <= least:
                raise
            break  # what is finer than the scene asks for need not be possible
        half_plane.append(half_plane_level(problem, pitch, window, Stages()))
        if number >= least:
            yield (
                ModelRun("half_plane", tuple(half_plane)),
                ModelRun("finite_element", tuple(finite_element), check),
            )
            if GROWTH * finite_element[-1].unknowns > MOST_UNKNOWNS:
                break
        pitch *= 0.5


def heat_errors(
    half_plane: ModelRun, finite_element: ModelRun, problem: Problem
) -> dict[str, PointError]:
    from comparisons.studies.heat.study import heat_figures

    without = set() if problem.scene.finite_element.roller_shape == "circle" else {"roller"}
    runs = {run.name: run for run in (half_plane, finite_element)}
    figures, _ = heat_figures(problem, runs, without)
    return {
        each.quantity: PointError(*each.values.values(), each.difference, each.uncertainty)
        for each in figures
    }


def model_errors(
    half_plane: ModelRun,
    finite_element: ModelRun,
    problem: Problem,
    friction: float,
    window: Window | None,
) -> dict[str, PointError]:
    values = [values_of(run.finest, problem, friction) for run in (half_plane, finite_element)]
    errors = differences_of(half_plane, finite_element, problem, friction, window)
    return {
        name: PointError(
            *(of_model.get(name) for of_model in values),
            error.value,
            error.numerical if np.isfinite(error.numerical) else None,
        )
        for name, error in errors.items()
    }


def _significant(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.{FIGURES}g}")
