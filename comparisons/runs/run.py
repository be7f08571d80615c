"""One scene from start to end: plan, both models level by level, comparison, files."""

import math
from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from importlib import import_module
from pathlib import Path

from analytic.contact.problem import ContactError
from comparisons.common.errors import InputError, SceneError, SolverError, address_space
from comparisons.common.mpi import is_several
from comparisons.common.progress import ProgressCallback, Stages, no_progress, within
from comparisons.common.provenance import digest, revision
from comparisons.common.tasks import Opens, Preparation, ProcessEnded, Tasks, tasks_here
from comparisons.figures.verdict import Comparison
from comparisons.models.forecast import forecast
from comparisons.models.level import Level, ModelRun
from comparisons.models.level_cache import level_cache
from comparisons.models.plan import Plan, make_plan
from comparisons.models.problem import Problem, problem_of
from comparisons.models.running_in import run_in_scene
from comparisons.models.window import Window, window_of
from comparisons.results.field_files import AUTOMATIC
from comparisons.results.outcome import Outcome
from comparisons.results.record import record_of
from comparisons.results.result_json import result_of
from comparisons.runs.refinement import refined
from comparisons.runs.write import write_files
from comparisons.scenes.scene import ResolvedScene
from comparisons.studies.answers.answer import Answer
from comparisons.studies.bulge import bulges
from comparisons.studies.contact import compared, pair_histories
from comparisons.studies.coupling import Coupling, couplings
from comparisons.studies.model_error.error_budget import ErrorBudget, announce_effects, error_budget
from comparisons.studies.quiescent_zone import quiescent_zones
from comparisons.studies.scatter.figures import InputScatter
from comparisons.studies.statistics.figures import LoadRow
from fem.solver.communicator import is_alone
from fem.solver.mumps import FemError
from meshes.block import MeshError

# Modules that write what was solved, those first that others would import at once.
REPORT = (
    *("PIL.Image", "pyparsing", "matplotlib.axes", "matplotlib.figure"),
    *("matplotlib.backends.backend_svg", "jinja2", "comparisons.report.page"),
)
Answers = Mapping[str, tuple[Answer, ...]]  # by name, on each resolution
SOLVED = 0.9  # share of a run's time after which all is solved: for progress alone
LEAST_ADDRESS_SPACE = 10**9  # bytes, of finite elements: libraries, threads, and a small scene
GOES_ON = "finished levels are kept, the same command goes on from there"


def run(
    scene: ResolvedScene,
    out: Path | None,
    models: tuple[str, ...],
    callback: ProgressCallback = no_progress,
    fields: str = AUTOMATIC,
    opens: Opens | None = None,
    answers: Answers | None = None,
) -> Outcome:
    """Solve a scene, compare, judge, and leave everything in `out`, or nothing anywhere (None).

    models    of half_plane, finite_element
    callback  gets each stage as it begins
    fields    format of the stress fields, as `write_files` takes it
    opens     workers for the samples of the scene's [scatter]; None: this machine's cores
    answers   from outside, read before; by default the scene's are read from their files
    Raises InputError for a scene that cannot be solved or a folder that cannot be written, and
    SolverError where the finite elements find no solution or a process ends amid a task,
    MemoryError where the process may not have what they take; nothing is written then."""
    stages = Stages(callback)
    _check_processes(scene, models)
    _check_address_space(models)
    try:
        if scene.running_in is not None:
            with stages.stage("running-in", "running the surface in"):
                scene = run_in_scene(scene)
        with stages.stage("set-up", "finding the reach of the contact"):
            problem = _problem(scene, models, callback)
        plan = make_plan(problem, models)
        callback(forecast(problem, plan).text)
        return solve(problem, plan, out, callback, fields, opens, answers)
    except (ContactError, MeshError) as error:
        raise SceneError(f"{scene.source}: {error}") from error
    except ProcessEnded as error:
        left = "" if out is None else f"; {GOES_ON}"
        raise SolverError(f"{scene.source}: {error}{left}") from error
    except FemError as error:
        remedy = "a lighter load"
        if scene.finite_element.plastic:
            remedy += ", a higher body.yield_stress or body.hardening_modulus"
        raise SolverError(
            f"{scene.source}: the finite elements found no solution: {error}; what may help is "
            f"{remedy}, or finer pressures (resolution.pitch)"
        ) from error


def _check_processes(scene: ResolvedScene, models: tuple[str, ...]) -> None:
    """Raise SceneError for what only one process can solve where there are several."""
    settings, several = scene.finite_element, is_several() and not is_alone()
    finite = settings.deformation == "finite"
    name = "deformation" if finite else "plastic"
    if several and "finite_element" in models and (finite or settings.plastic):
        raise SceneError(
            f"{scene.source}: finite_element.{name}: is solved on one process; allowed without "
            "mpirun"
        )


def _check_address_space(models: tuple[str, ...]) -> None:
    """Raise MemoryError where the finite elements' libraries would fail, each in its own words."""
    allowed = address_space()
    if "finite_element" in models and allowed is not None and allowed < LEAST_ADDRESS_SPACE:
        least = LEAST_ADDRESS_SPACE / 1e9
        raise MemoryError(f"finite elements take at least {least:.3g} GB of address space")


def _problem(scene: ResolvedScene, models: tuple[str, ...], callback: ProgressCallback) -> Problem:
    if scene.load.kind != "approach":
        return problem_of(scene)
    if "finite_element" not in models:
        raise SceneError(
            f"{scene.source}: load.approach: takes finite elements to find its load; "
            "allowed with the half-plane alone is per_length or hertz_peak_pressure"
        )
    from comparisons.models.finite_element.level import problem_of_approach

    return problem_of_approach(scene, callback)


def solve(
    problem: Problem,
    plan: Plan,
    out: Path | None,
    callback: ProgressCallback = no_progress,
    fields: str = AUTOMATIC,
    opens: Opens | None = None,
    answers: Answers | None = None,
) -> Outcome:
    """Carry out a plan, as `run` does with the plan that suits the problem."""
    window = window_of(problem) if plan.stress else None
    if problem.scene.answers and answers is None:
        from comparisons.studies.answers.readers.files import read_answers

        answers = read_answers(problem, window)
    cache = level_cache(out, problem.scene, plan, LoadRow)
    try:
        told, memory = within(callback, 0.0, SOLVED), problem.scene.budget.memory
        there = _for_finite_elements() if "finite_element" in plan.models else ()
        here = [revision, *(partial(import_module, name) for name in REPORT if out is not None)]
        with tasks_here(told, memory, cache, here, there) as tasks:
            by_others = tasks if opens is None else Tasks(opens, math.inf, cache)
            scattered = _announce_scatter(problem, plan, by_others)
            counted = None
            if problem.scene.statistics is not None and "half_plane" in plan.models:
                from comparisons.studies.statistics.study import announce_statistics

                counted = announce_statistics(problem, tasks)
            runs, stop, moved, rows, budget = solved(problem, plan, window, tasks)
            scatter = scattered and scattered(runs["half_plane"].finest)
            statistics = counted and counted(runs)
    except KeyboardInterrupt:
        raise _interrupted(out) from None
    except (ContactError, FemError, InputError, MeshError):
        cache.discard()
        raise
    result = result_of(problem, plan, runs, rows, stop, moved, budget, scatter)
    result["quiescent_zone"] = quiescent_zones(problem, runs, window)
    result["bulge"] = bulges(problem, runs, window)
    result["statistics"] = statistics and statistics.as_dict()
    hashes = {f"{n}_pressure": digest(run.finest.solution.pressure) for n, run in runs.items()}
    run_in = problem.scene.run_in
    if run_in is not None:
        hashes["run_in_profile"] = digest(run_in.profile.x, run_in.profile.height)
    compared_answers = ()
    if answers:
        from comparisons.studies.answers.compare import compare_answers

        given = problem, plan, runs, window, answers, scatter
        compared_answers = compare_answers(*given)
        result["answers"] = {each.name: each.as_dict() for each in compared_answers}
        hashes |= {f"answer_{n}": [each.sha256 for each in a] for n, a in answers.items()}
    heat = None
    if problem.scene.heat is not None:
        from comparisons.studies.heat.study import heat_study

        heat = heat_study(problem, runs, window, told)
        result["heat"] = heat.as_dict()
    outcome = Outcome(
        problem=problem,
        plan=plan,
        window=window,
        runs=runs,
        comparisons=rows,
        result=result,
        record=record_of(problem.scene, runs, hashes),
        directory=out,
        couplings=moved,
        budget=budget,
        pairs=pair_histories(problem, runs, window) if plan.compares else (),
        scatter=scatter,
        statistics=statistics,
        answers=compared_answers,
        heat=heat,
    )
    try:
        if out is not None:
            write_files(outcome, within(callback, SOLVED, 1.0), fields)
    except KeyboardInterrupt:
        raise _interrupted(out) from None
    cache.discard()
    return outcome


def _announce_scatter(
    problem: Problem, plan: Plan, tasks: Tasks
) -> Callable[[Level], InputScatter] | None:
    """Begin with the samples of uncertain inputs; what is returned waits. None without any."""
    if problem.scene.scatter is None or "half_plane" not in plan.models:
        return None
    from comparisons.studies.scatter.study import announce_scatter

    return announce_scatter(problem, tasks)


def _for_finite_elements() -> list[Preparation]:
    from fem.solver.compilation import load_dolfinx
    from meshes.build import start_worker

    level = partial(import_module, "comparisons.models.finite_element.level")
    return [start_worker, load_dolfinx, level]


def solved(
    problem: Problem, plan: Plan, window: Window | None, tasks: Tasks
) -> tuple[
    dict[str, ModelRun], str, tuple[Coupling, ...], tuple[Comparison, ...], ErrorBudget | None
]:
    """The runs of a plan's models and why their refinement stopped, the half-plane's couplings, the
    comparison, and the error budget; of the last three what the plan asks for."""

    @lru_cache
    def moved(levels: int) -> tuple[Coupling, ...]:
        return couplings(problem, half_planes[levels], window, tasks.callback)

    def coupled(half_plane: ModelRun) -> tuple[Coupling, ...]:
        half_planes[len(half_plane.levels)] = half_plane
        return moved(len(half_plane.levels)) if plan.coupling else ()

    def announce(half_plane: ModelRun) -> Callable[[], None]:
        return announce_effects(problem, plan, window, half_plane, coupled(half_plane), tasks)

    half_planes: dict[int, ModelRun] = {}
    ahead = announce if plan.compares else None
    runs, stop = refined(problem, plan, window, tasks, ahead)
    found = coupled(runs["half_plane"]) if "half_plane" in runs else ()
    if not plan.compares:
        return runs, stop, found, (), None
    rows = compared(problem, runs, window)
    budget = error_budget(problem, plan, window, runs, rows, found, tasks)
    return runs, stop, found, rows, budget


def _interrupted(out: Path | None) -> KeyboardInterrupt:
    """With how to go on, where levels are cached."""
    return KeyboardInterrupt(*([] if out is None else [GOES_ON]))
