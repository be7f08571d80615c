"""One scene from start to end: plan, both models level by level, comparison, files."""

from collections.abc import Iterator
from pathlib import Path
from time import perf_counter

from analytic.contact import ContactError
from comparisons.compare import compare, uncertainties
from comparisons.errors import SceneError
from comparisons.level import Level, ModelRun, Window
from comparisons.outcome import Outcome
from comparisons.plan import Plan, make_plan
from comparisons.problem import Problem, problem_of
from comparisons.record import digest, record_of
from comparisons.result import peak_memory, result_of
from comparisons.scene import ResolvedScene
from comparisons.stages import Listener, Stages, silent
from comparisons.window import window_of
from comparisons.write import write_files
from meshes.errors import MeshError

SHARE_OF_TOLERANCE = 1.0 / 3.0  # discretisation uncertainty that ends the refinement
MOST_LEVELS = 8
GROWTH_OF_COST = 3.0  # time and memory of a level over those of the one before, at most


def run(
    scene: ResolvedScene,
    out: Path,
    models: tuple[str, ...],
    listener: Listener = silent,
) -> Outcome:
    """Solve a scene, compare, judge, and leave everything in `out`.

    models    of half_plane, finite_element
    listener  is told each stage as it begins
    Raises InputError for a scene that cannot be solved or a folder that cannot be written;
    nothing is written then.
    """
    stages = Stages(listener)
    try:
        with stages.stage("set-up", "finding the reach of the contact"):
            problem = _problem(scene, models, listener)
        return solve(problem, make_plan(problem, models), out, listener)
    except (ContactError, MeshError) as error:
        raise SceneError(f"{scene.name}: {error}") from error


def _problem(scene: ResolvedScene, models: tuple[str, ...], listener: Listener) -> Problem:
    if scene.load.kind != "approach":
        return problem_of(scene)
    if "finite_element" not in models:
        raise SceneError(
            f"{scene.name}: load.approach: takes finite elements to find its load; "
            "allowed with the half-plane alone is per_length or hertz_peak_pressure"
        )
    from comparisons.approach import problem_of_approach

    return problem_of_approach(scene, listener)


def solve(problem: Problem, plan: Plan, out: Path, listener: Listener = silent) -> Outcome:
    """Carry out a plan; `run` with a plan of one's own."""
    window = window_of(problem) if plan.stress else None
    runs, stop = _refined(problem, plan, window, listener)
    comparisons = ()
    if plan.compares:
        comparisons = tuple(
            row
            for friction in problem.scene.friction
            for row in compare(
                runs["half_plane"], runs["finite_element"], problem, friction, window
            )
        )
    result = result_of(problem, plan, runs, comparisons, stop)
    hashes = {
        f"{name}_pressure": digest(level_run.finest.solution.pressure)
        for name, level_run in runs.items()
    }
    outcome = Outcome(
        problem=problem,
        plan=plan,
        window=window,
        runs=runs,
        comparisons=comparisons,
        result=result,
        record=record_of(problem.scene, plan.models, hashes),
        directory=out,
    )
    write_files(outcome, listener)
    return outcome


def _refined(
    problem: Problem, plan: Plan, window: Window | None, listener: Listener
) -> tuple[dict[str, ModelRun], str]:
    """Both models on ever finer levels, and why the refinement stopped."""
    began = perf_counter()
    levels: dict[str, list[Level]] = {name: [] for name in plan.models}
    runs: dict[str, ModelRun] = {}
    planned = len(problem.pitches)
    for count, pitch in enumerate(_pitches(problem), start=1):
        before = perf_counter()
        _add_level(problem, plan, window, pitch, planned - count, levels, listener)
        runs = {name: ModelRun(name, tuple(done)) for name, done in levels.items()}
        if count == 1 and plan.domain_check:
            halved = _halved(problem, plan, window, levels["finite_element"][0], listener)
        if count < planned:
            continue
        if plan.domain_check:
            done = tuple(levels["finite_element"])
            runs["finite_element"] = ModelRun("finite_element", done, halved)
        open_questions = unresolved(problem, runs)
        if not open_questions:
            return runs, "every judged quantity is resolved"
        budget = problem.scene.budget
        last, spent = perf_counter() - before, perf_counter() - began
        left_open = f"{', '.join(open_questions)} not resolved to a third of the tolerance"
        if spent + GROWTH_OF_COST * last > budget.time:
            return runs, f"{left_open}: the budget of {budget.time:g} s is spent (budget.time)"
        if GROWTH_OF_COST * peak_memory() > budget.memory:
            return runs, (
                f"{left_open}: a finer level would exceed {budget.memory:g} bytes (budget.memory)"
            )
    return runs, f"{left_open} after {MOST_LEVELS} levels"


def _pitches(problem: Problem) -> Iterator[float]:
    """The planned pitches, then half of the last again and again."""
    yield from problem.pitches
    for k in range(1, MOST_LEVELS - len(problem.pitches) + 1):
        yield problem.pitches[-1] / 2.0**k


def _add_level(
    problem: Problem,
    plan: Plan,
    window: Window | None,
    pitch: float,
    coarser: int,
    levels: dict[str, list[Level]],
    listener: Listener,
) -> None:
    if "half_plane" in levels:
        from comparisons.half_plane import half_plane_level

        levels["half_plane"].append(
            half_plane_level(problem, plan, pitch, window, Stages(listener))
        )
    if "finite_element" in levels:
        from comparisons.finite_element import Refinement, finite_element_level

        refinement = Refinement(pitch, coarser, problem.scene.finite_element.block)
        levels["finite_element"].append(
            finite_element_level(problem, plan, refinement, window, Stages(listener))
        )


def _halved(
    problem: Problem, plan: Plan, window: Window | None, first: Level, listener: Listener
) -> Level:
    """The coarsest finite-element level on a block of half the size."""
    from comparisons.finite_element import Refinement, finite_element_level

    block = 0.5 * problem.scene.finite_element.block
    refinement = Refinement(first.grid.pitch, len(problem.pitches) - 1, block)
    listener("finite elements: far boundary at half the distance")
    return finite_element_level(problem, plan, refinement, window, Stages(silent))


def unresolved(problem: Problem, runs: dict[str, ModelRun]) -> list[str]:
    """Judged quantities whose discretisation uncertainty is above its share of the tolerance."""
    names = []
    for run_of_model in runs.values():
        for friction in problem.scene.friction:
            for name, doubt in uncertainties(run_of_model, problem, friction).items():
                tolerance = problem.scene.tolerance.get(name)
                if tolerance and doubt.discretisation > SHARE_OF_TOLERANCE * tolerance:
                    names.append(name)
    return sorted(set(names))
