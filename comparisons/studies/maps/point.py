"""One point of a map, solved by both models: what a worker does.

Both models are refined until the half-plane's own error is told from the numerical one, never by
the clock, so that a point has the same answer wherever and whenever it is computed.
"""

from collections.abc import Iterator
from dataclasses import asdict
from time import perf_counter

from comparisons.common.errors import one_line
from comparisons.common.progress import Stages
from comparisons.common.quantities import MODELS
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import Plan, make_plan
from comparisons.models.problem import Problem, problem_of
from comparisons.models.window import Window, window_of
from comparisons.scenes.resolve import resolve_tables
from comparisons.studies.maps.model_error import PointError, model_errors
from comparisons.studies.maps.request import Asked
from fem.solver.communicator import each_alone
from meshes.block import MeshError

SOLVED, FAILED = "solved", "failed"
NOT_CONVERGED = "the contact did not converge"
TOLERANCES = (0.01, 0.02, 0.05, 0.10)  # that a map shows
SHARE = 1.0 / 3.0  # of an error, or the first tolerance, that may be numerical
# Levels of a rough surface beyond the scene's own: with three, two points of 64 were told
# 2.1 +- 0.4 per cent that are 1.3 on five.
ROUGH_MORE = 1
MOST_UNKNOWNS = 250_000  # of a level
GROWTH = 2.3  # of unknowns from one level to the next
DECIMALS = 9  # of relative differences: the digits that rounding does not reach
FIGURES = 10  # decimal, of the models' own values


def solve_point(asked: Asked) -> dict:
    """The figures of a point, or why there are none; and the `seconds` that it took.

    Refusals and what solvers and numbers run into are answers; what is wrong with the program or
    the machine is raised.
    """
    began = perf_counter()
    if asked.why is not None:
        found = failed(asked.why)
    else:
        try:
            with each_alone():
                found = _solved(asked)
        except (ValueError, ArithmeticError, RuntimeError) as error:
            found = failed(str(error) or type(error).__name__)
    return {"found": found, "seconds": perf_counter() - began}


def failed(why: str) -> dict:
    """The answer of a point that has none."""
    return {"status": FAILED, "why": one_line(why)}


def _solved(asked: Asked) -> dict:
    scene = resolve_tables(asked.tables, name="point", folder=asked.folder, source=asked.source)
    problem = problem_of(scene)
    plan = make_plan(problem, MODELS)
    window = window_of(problem) if plan.stress else None
    friction = max(scene.friction)
    for runs in _refined(problem, plan, window):
        for run in runs:
            if not run.finest.solution.converged:
                return failed(f"{run.name}: {NOT_CONVERGED}")
        errors = model_errors(*runs, problem, friction, window)
        if not is_open(errors[asked.quantity]):
            break
    return {
        "status": SOLVED,
        "half_width": _figures(problem.hertz.half_width),
        "hertz_peak_pressure": _figures(problem.hertz.peak_pressure),
        "friction": _figures(friction),
        "levels": len(runs[1].levels),
        "unknowns": runs[1].finest.unknowns,
        "quantities": {name: _rounded(error) for name, error in errors.items()},
    }


def _refined(
    problem: Problem, plan: Plan, window: Window | None
) -> Iterator[tuple[ModelRun, ModelRun]]:
    """Both models on the first levels, then with one more each time, while there may be."""
    from comparisons.models.finite_element.level import finite_element_level
    from comparisons.models.finite_element.mesh import Refinement
    from comparisons.models.half_plane import half_plane_level

    def finite_elements(pitch: float, half_block: bool = False) -> Level:
        return finite_element_level(problem, plan, Refinement(pitch, half_block), window, Stages())

    one: list[Level] = []
    other: list[Level] = []
    pitch = problem.pitches[0]
    least = len(problem.pitches) + (ROUGH_MORE if problem.scene.profile is not None else 0)
    check = finite_elements(pitch, half_block=True) if plan.domain_check else None
    for number in range(1, problem.scene.resolution.most + 1):
        try:
            other.append(finite_elements(pitch))
        except MeshError:
            if number <= least:
                raise
            break  # what is finer than the scene asks for need not be possible
        one.append(half_plane_level(problem, plan, pitch, window, Stages()))
        if number >= least:
            yield (
                ModelRun("half_plane", tuple(one)),
                ModelRun("finite_element", tuple(other), check),
            )
            if GROWTH * other[-1].unknowns > MOST_UNKNOWNS:
                break
        pitch *= 0.5


def is_open(error: PointError) -> bool:
    """Whether the error is not told from the numerical one as well as a map can show it."""
    told = SHARE * max(abs(error.difference), TOLERANCES[0])
    return error.uncertainty is None or error.uncertainty > told


def _rounded(error: PointError) -> dict:
    plain = asdict(error)
    for name in ("difference", "uncertainty"):
        if plain[name] is not None:
            plain[name] = round(plain[name], DECIMALS)
    return plain | {name: _figures(plain[name]) for name in ("half_plane", "finite_element")}


def _figures(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.{FIGURES}g}")
