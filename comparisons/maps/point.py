"""One point of a map, solved by both models: what a worker does.

Nothing here refines by the clock or by the memory that happens to be free, so that a point has
the same answer wherever and whenever it is computed.
"""

from dataclasses import asdict
from pathlib import Path
from time import perf_counter

from comparisons.errors import one_line
from comparisons.level import ModelRun
from comparisons.maps.own_error import OwnError, own_errors
from comparisons.maps.request import Asked
from comparisons.plan import MODELS, Plan, make_plan
from comparisons.problem import Problem, problem_of
from comparisons.resolve import resolve_tables
from comparisons.stages import Stages
from comparisons.window import window_of
from fem.communicator import each_alone

SOLVED, FAILED = "solved", "failed"
NOT_CONVERGED = "the contact did not converge"
DECIMALS = 9  # of relative differences: the digits that rounding does not reach
FIGURES = 10  # decimal, of the models' own values


def solve_point(asked: Asked) -> dict:
    """The figures of a point, or why there are none; and the `seconds` that it took.

    Errors of solvers and refusals are answers; what ends the whole work is raised: OSError,
    MemoryError.
    """
    began = perf_counter()
    if asked.why is not None:
        found = failed(asked.why)
    else:
        try:
            found = _solved(asked.tables, asked.folder, asked.source)
        except (OSError, MemoryError):
            raise
        except Exception as error:
            found = failed(str(error) or type(error).__name__)
    return {"found": found, "seconds": perf_counter() - began}


def failed(why: str) -> dict:
    """The answer of a point that has none."""
    return {"status": FAILED, "why": one_line(why)}


def _solved(tables: dict, folder: Path, source: str) -> dict:
    with each_alone():
        return _figures_of(
            problem_of(resolve_tables(tables, name="point", folder=folder, source=source))
        )


def _figures_of(problem: Problem) -> dict:
    scene = problem.scene
    plan = make_plan(problem, MODELS)
    window = window_of(problem) if plan.stress else None
    runs = _runs(problem, plan, window)
    for run in runs:
        if not all(level.solution.converged for level in run.levels):
            return failed(f"{run.name}: {NOT_CONVERGED}")
    friction = max(scene.friction)
    errors = own_errors(*runs, problem, friction, window)
    return {
        "status": SOLVED,
        "half_width": _figures(problem.hertz.half_width),
        "hertz_peak_pressure": _figures(problem.hertz.peak_pressure),
        "friction": _figures(friction),
        "unknowns": runs[1].finest.unknowns,
        "quantities": {name: _rounded(error) for name, error in errors.items()},
    }


def _runs(problem: Problem, plan: Plan, window: object) -> tuple[ModelRun, ModelRun]:
    """The planned levels of both models."""
    from comparisons.finite_element import finite_element_level
    from comparisons.finite_element_mesh import Refinement
    from comparisons.half_plane import half_plane_level

    def finite_elements(pitch: float, halved: bool = False) -> object:
        return finite_element_level(problem, plan, Refinement(pitch, halved), window, Stages())

    pitches = problem.pitches
    one = tuple(half_plane_level(problem, plan, pitch, window, Stages()) for pitch in pitches)
    other = tuple(map(finite_elements, pitches))
    halved = finite_elements(pitches[0], halved=True) if plan.domain_check else None
    return ModelRun("half_plane", one), ModelRun("finite_element", other, halved)


def _rounded(error: OwnError) -> dict:
    plain = asdict(error)
    for name in ("difference", "uncertainty"):
        if plain[name] is not None:
            plain[name] = round(plain[name], DECIMALS)
    return plain | {name: _figures(plain[name]) for name in ("half_plane", "finite_element")}


def _figures(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.{FIGURES}g}")
