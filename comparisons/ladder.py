"""Both models on ever finer levels, until every judged quantity is resolved or the budget spent."""

from time import perf_counter

from comparisons.checkpoint import Checkpoint
from comparisons.compare import uncertainties
from comparisons.level import Level, ModelRun, Window
from comparisons.plan import Plan
from comparisons.problem import Problem
from comparisons.stages import Listener, Stages, silent

SHARE_OF_TOLERANCE = 1.0 / 3.0  # discretisation uncertainty that ends the refinement
MOST_LEVELS = 8
GROWTH_OF_TIME = 3.5  # of a level over the one before, at most


def refined(
    problem: Problem,
    plan: Plan,
    window: Window | None,
    checkpoint: Checkpoint,
    listener: Listener,
) -> tuple[dict[str, ModelRun], str]:
    """The runs of the plan's models, and why their refinement stopped.

    Levels that `checkpoint` has from a run that was stopped are not computed again.
    """
    began = perf_counter()
    levels: dict[str, list[Level]] = {name: [] for name in plan.models}
    halved: Level | None = None
    planned = len(problem.pitches)
    for count in range(1, MOST_LEVELS + 1):
        before = perf_counter()
        pitch = problem.pitches[0] / 2.0 ** (count - 1)
        coarser = planned - count
        for name, done in levels.items():
            kept = f"{name}-{count}"
            level = checkpoint.load(kept)
            if level is None:
                level = _solve(name, problem, plan, pitch, coarser, window, listener)
                checkpoint.save(kept, level)
            done.append(level)
        if count == 1 and plan.domain_check:
            listener("finite elements: far boundary at half the distance")
            halved = checkpoint.load("finite_element-halved")
            if halved is None:
                halved = _solve(
                    "finite_element", problem, plan, pitch, coarser, window, silent, halved=True
                )
                checkpoint.save("finite_element-halved", halved)
        if count < planned:
            continue
        runs = {
            name: ModelRun(name, tuple(done), halved if name == "finite_element" else None)
            for name, done in levels.items()
        }
        open_questions = unresolved(problem, runs)
        if not open_questions:
            return runs, "every judged quantity is resolved"
        left_open = f"{', '.join(open_questions)} not resolved to a third of the tolerance"
        seconds = perf_counter() - began + GROWTH_OF_TIME * (perf_counter() - before)
        spent = _spent(problem, runs, planned - count - 1, seconds)
        if spent is not None:
            return runs, f"{left_open}: {spent}"
    return runs, f"{left_open} after {MOST_LEVELS} levels"


def unresolved(problem: Problem, runs: dict[str, ModelRun]) -> list[str]:
    """Judged quantities whose discretisation uncertainty is above its share of the tolerance."""
    names = set()
    for run_of_model in runs.values():
        for friction in problem.scene.friction:
            for name, doubt in uncertainties(run_of_model, problem, friction).items():
                tolerance = problem.scene.tolerance.get(name)
                if tolerance and doubt.discretisation > SHARE_OF_TOLERANCE * tolerance:
                    names.add(name)
    return sorted(names)


def _spent(problem: Problem, runs: dict[str, ModelRun], coarser: int, seconds: float) -> str | None:
    """Why one more level, which would end after `seconds`, exceeds the budget; or None."""
    budget = problem.scene.budget
    if seconds > budget.time:
        return f"a finer level would exceed {budget.time:g} s (budget.time)"
    if "finite_element" in runs:
        from comparisons.finite_element import Refinement, expected_memory

        finest = runs["finite_element"].finest
        block = problem.scene.finite_element.block
        refinement = Refinement(0.5 * finest.grid.pitch, coarser, block)
        if expected_memory(problem, refinement, finest.patches) > budget.memory:
            return f"a finer level would exceed {budget.memory:g} bytes (budget.memory)"
    return None


def _solve(
    name: str,
    problem: Problem,
    plan: Plan,
    pitch: float,
    coarser: int,
    window: Window | None,
    listener: Listener,
    halved: bool = False,
) -> Level:
    """One level of one model; what the other model alone needs is not imported."""
    if name == "half_plane":
        from comparisons.half_plane import half_plane_level

        return half_plane_level(problem, plan, pitch, window, Stages(listener))
    from comparisons.finite_element import Refinement, finite_element_level

    refinement = Refinement(pitch, coarser, problem.scene.finite_element.block, halved)
    return finite_element_level(problem, plan, refinement, window, Stages(listener))
